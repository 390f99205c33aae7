/* trim_area.c - area of what trimming loops leave of a surface.
 *
 * The spans are cells; in each the area is, by Green's theorem, a sum of integrals along v of
 * F(u, v), the integral of |Su x Sv| over u from the cell's left side: along every piece of loop in
 * the cell, with the sign of what it bounds and cut where another piece crosses it, and along the
 * right side where that is inside. All integrands are smooth. A cell is quartered until its quarters agree with it.
 */
#include <stdlib.h>
#include <string.h>

#include "gauss.h"
#include "trim_pieces.h"

enum { AREA_DEPTH = 10 };

static const double rounding = 1e-16;

struct cell {
	double lo[2], hi[2];
	const int *pieces; /* borrowed: those that may meet it */
	int n;
};

struct area {
	const struct surface *s;
	const struct trim_test *test;
	double error;
	enum status st;
};

static double density(const struct surface *s, double u, double v)
{
	struct vec3 p, du, dv;
	surface_tangents(s, u, v, &p, &du, &dv);
	return vec3_length(vec3_cross(du, dv));
}

/* F: from the cell's left side to u. */
static double to_left(const struct area *a, const struct cell *c, double u, double v)
{
	const double h = 0.5 * (u - c->lo[0]);
	double sum = 0;
	for (int i = 0; i < GAUSS; i++)
		sum += gauss_weight[i] * density(a->s, c->lo[0] + h * (1 + gauss_node[i]), v);
	return sum * h;
}

/* Part of a piece, from t[0] to t[1], that lies in the cell; false if none does. */
static bool clip(const struct trim_piece *p, const struct cell *c, double t[2])
{
	if (p->v[1] <= c->lo[1] || p->v[0] >= c->hi[1] || p->hi_u <= c->lo[0] || p->lo_u > c->hi[0])
		return false;
	t[0] = trim_piece_find(p, 1, c->lo[1]);
	t[1] = trim_piece_find(p, 1, c->hi[1]);
	if (p->lo_u < p->hi_u) {
		double a = trim_piece_find(p, 0, c->lo[0]), b = trim_piece_find(p, 0, c->hi[0]);
		t[0] = fmax(t[0], fmin(a, b));
		t[1] = fmin(t[1], fmax(a, b));
	}
	return t[0] < t[1];
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* Part of a piece that no other crosses. */
static double along_part(const struct area *a, const struct cell *c, int piece, double from,
                         double to)
{
	const struct trim_piece *p = &a->test->pieces.pieces[piece];
	const double h = 0.5 * (to - from);
	double uv[2], d[2], sum = 0;
	trim_piece_point(p, from + h, uv, d);
	const int step = trim_test_step(a->test, piece, uv[0], uv[1]);
	if (step == 0)
		return 0;
	for (int i = 0; i < GAUSS; i++) {
		trim_piece_point(p, from + h * (1 + gauss_node[i]), uv, d);
		sum += gauss_weight[i] * d[1] * to_left(a, c, uv[0], uv[1]);
	}
	return step * sum * h;
}

static double along_piece(struct area *a, const struct cell *c, int piece, const double t[2])
{
	double *at = NULL, sum = 0, from = t[0];
	int n = 0;
	if (trim_test_crossings(a->test, piece, t, c->pieces, c->n, &at, &n) != ST_OK)
		a->st = ST_RESOURCE;
	if (n)
		qsort(at, n, sizeof *at, compare);
	for (int i = 0; i <= n && a->st == ST_OK; i++) {
		const double to = i < n ? fmin(at[i], t[1]) : t[1];
		if (!(to > from))
			continue;
		sum += along_part(a, c, piece, from, to);
		from = to;
	}
	free(at);
	return sum;
}

/* The cell's right side from v0 to v1, where no loop crosses it. */
static double along_side(const struct area *a, const struct cell *c, double v0, double v1)
{
	const double h = 0.5 * (v1 - v0);
	double sum = 0;
	if (!(h > 0) || !trim_test_state(a->test, c->hi[0], v0 + h))
		return 0;
	for (int i = 0; i < GAUSS; i++)
		sum += gauss_weight[i] * to_left(a, c, c->hi[0], v0 + h * (1 + gauss_node[i]));
	return sum * h;
}

static double area_once(struct area *a, const struct cell *c)
{
	double sum = 0, from = c->lo[1], *breaks = malloc((c->n + 1) * sizeof *breaks);
	int n = 0;
	if (!breaks) {
		a->st = ST_RESOURCE;
		return 0;
	}
	for (int i = 0; i < c->n; i++) {
		const struct trim_piece *p = &a->test->pieces.pieces[c->pieces[i]];
		double t[2], uv[2], d[2];
		if (clip(p, c, t))
			sum += along_piece(a, c, c->pieces[i], t);
		if (p->lo_u > c->hi[0] || p->hi_u < c->hi[0])
			continue;
		trim_piece_point(p, trim_piece_find(p, 0, c->hi[0]), uv, d);
		breaks[n++] = fmin(fmax(uv[1], c->lo[1]), c->hi[1]);
	}
	qsort(breaks, n, sizeof *breaks, compare);
	breaks[n++] = c->hi[1];
	for (int i = 0; i < n; i++) {
		sum += along_side(a, c, from, breaks[i]);
		from = breaks[i];
	}
	free(breaks);
	return sum;
}

/* The pieces of a cell's list that may meet a part of it; into `list`. */
static void cell_select(const struct area *a, struct cell *part, const struct cell *from, int *list)
{
	part->pieces = list;
	part->n = 0;
	for (int i = 0; i < from->n; i++) {
		const struct trim_piece *p = &a->test->pieces.pieces[from->pieces[i]];
		if (p->v[1] >= part->lo[1] && p->v[0] <= part->hi[1] && p->hi_u >= part->lo[0] &&
		    p->lo_u <= part->hi[0])
			list[part->n++] = from->pieces[i];
	}
}

static double area_quartered(struct area *a, const struct cell *c, double whole, double tolerance,
                             int depth)
{
	struct cell quarter[4];
	double part[4], sum = 0;
	int *lists = malloc(((size_t)4 * c->n + 1) * sizeof *lists);
	if (!lists) {
		a->st = ST_RESOURCE;
		return 0;
	}
	for (int i = 0; i < 4; i++) {
		for (int d = 0; d < 2; d++) {
			const double middle = 0.5 * (c->lo[d] + c->hi[d]);
			bool upper = i >> d & 1;
			quarter[i].lo[d] = upper ? middle : c->lo[d];
			quarter[i].hi[d] = upper ? c->hi[d] : middle;
		}
		cell_select(a, &quarter[i], c, lists + (size_t)i * c->n);
		sum += part[i] = area_once(a, &quarter[i]);
	}
	if (depth == 0 || !(fabs(sum - whole) > tolerance) || !isfinite(sum) || a->st != ST_OK) {
		a->error += fabs(sum - whole);
	} else {
		sum = 0;
		for (int i = 0; i < 4; i++)
			sum += area_quartered(a, &quarter[i], part[i], 0.5 * tolerance, depth - 1);
	}
	free(lists);
	return sum;
}

/* Over all spans; tolerance < 0: roughly. `lists`: room for all pieces, three times. */
static double area_spans(struct area *a, double *const breaks[2], const int spans[2],
                         double tolerance, int *lists)
{
	const int n = a->test->pieces.n;
	double sum = 0;
	struct cell all = { .pieces = lists, .n = n };
	for (int i = 0; i < n; i++)
		lists[i] = i;
	for (int i = 0; i < spans[0] && a->st == ST_OK; i++) {
		struct cell column = {
			.lo = { breaks[0][i], -INFINITY },
			.hi = { breaks[0][i + 1], INFINITY },
		};
		cell_select(a, &column, &all, lists + n);
		for (int j = 0; j < spans[1] && a->st == ST_OK; j++) {
			struct cell c = { .lo = { column.lo[0], breaks[1][j] },
				          .hi = { column.hi[0], breaks[1][j + 1] } };
			cell_select(a, &c, &column, lists + 2 * (size_t)n);
			double whole = area_once(a, &c);
			sum += tolerance < 0 ? whole
			                     : area_quartered(a, &c, whole, tolerance, AREA_DEPTH);
		}
	}
	return sum;
}

enum status trim_area(const struct trim *t, const struct surface *s, double accuracy, double *area,
                      double *error)
{
	struct area a = { .s = s, .st = ST_RESOURCE };
	struct trim_test *test = NULL;
	double *breaks[2] = { NULL, NULL };
	int spans[2], *lists = NULL;
	if (t->n == 0) {
		*area = surface_area(s, accuracy, error);
		return isnan(*area) ? ST_RESOURCE : ST_OK;
	}
	if (trim_test_create(&test, t, s) != ST_OK)
		return ST_RESOURCE;
	a.test = test;
	lists = malloc(((size_t)3 * test->pieces.n + 1) * sizeof *lists);
	for (int d = 0; d < 2; d++) {
		breaks[d] = malloc(sizeof(double) * (s->n[d] + 2));
		if (!breaks[d] || !lists)
			goto out;
		spans[d] = knots_breaks(s->order[d], s->n[d], s->knots[d], s->domain[d][0],
		                        s->domain[d][1], breaks[d]) -
		           1;
	}
	a.st = ST_OK;
	double rough = area_spans(&a, breaks, spans, -1, lists);
	/* where next to nothing is left, rounding is no reason to go on */
	double least = fmax(accuracy * rough, rounding * surface_size(s) * surface_size(s));
	*area = area_spans(&a, breaks, spans, least / spans[0] / spans[1], lists);
	*error = a.error;
out:
	free(breaks[0]);
	free(breaks[1]);
	free(lists);
	trim_test_destroy(test);
	return a.st;
}
