/* trim_chain.c - curves put one behind the other, and the gaps between them closed. */
#include <stdlib.h>

#include "refine.h"
#include "trim_mender.h"

/* Gaps below this, in sizes of the surface, are rounding and not told. */
static const double rounding = 1e-9;

void trim_curve_end(const struct curve *c, int end, double uv[2])
{
	const double *p = c->points + (end ? 4 * ((size_t)c->n - 1) : 0);
	uv[0] = p[0] / p[3];
	uv[1] = p[1] / p[3];
}

void trim_curve_set_end(struct curve *c, int end, const double uv[2])
{
	double *p = c->points + (end ? 4 * ((size_t)c->n - 1) : 0);
	p[0] = uv[0] * p[3];
	p[1] = uv[1] * p[3];
}

void trim_curve_move(struct curve *c, int d, double by)
{
	for (int i = 0; i < c->n; i++)
		c->points[4 * (size_t)i + d] += by * c->points[4 * (size_t)i + 3];
}

enum status trim_add_line(struct trim_loop *l, const double from[2], const double to[2])
{
	struct curve c;
	if (curve_init(&c, 2, 2) != ST_OK)
		return ST_RESOURCE;
	c.knots[2] = c.knots[3] = c.domain[1] = 1;
	curve_set_point(&c, 0, vec3(from[0], from[1], 0), 1);
	curve_set_point(&c, 1, vec3(to[0], to[1], 0), 1);
	return trim_loop_add(l, &c);
}

enum status trim_fail(const struct mender *m, const char *fault)
{
	return report_error(m->r, ST_INPUT, "%s: trimming loop %d %s", m->what, m->loop, fault);
}

/* Point in space of a place that may lie some periods off. */
static struct vec3 place(const struct mender *m, const double uv[2])
{
	double x[2];
	for (int d = 0; d < 2; d++) {
		const double *range = m->s->domain[d];
		x[d] = uv[d];
		if (m->closed[d] && (x[d] < range[0] || x[d] > range[1]))
			x[d] -= floor((x[d] - range[0]) / m->length[d]) * m->length[d];
		x[d] = fmin(fmax(x[d], range[0]), range[1]);
	}
	return surface_point(m->s, x[0], x[1]);
}

static double apart(const struct mender *m, const double a[2], const double b[2])
{
	return vec3_length(vec3_sub(place(m, a), place(m, b)));
}

/* A border that is shrunk to a point: from there any u (or v) is as near as any other. */
static bool at_pole(const struct mender *m, const double uv[2])
{
	for (int d = 0; d < 2; d++)
		for (int end = 0; end < 2; end++)
			if (fabs(uv[d] - m->s->domain[d][end]) <= m->near[d] &&
			    surface_degenerate(m->s, d, end, m->tolerance))
				return true;
	return false;
}

/* Whole periods that bring b nearest to a. */
static void periods(const struct mender *m, const double a[2], const double b[2], double shift[2])
{
	bool pole = at_pole(m, a) && at_pole(m, b);
	for (int d = 0; d < 2; d++)
		shift[d] = m->closed[d] && !pole
		                   ? round((a[d] - b[d]) / m->length[d]) * m->length[d]
		                   : 0;
}

/* Upper bound of the way between two places along the surface, some periods left out. */
static double way_between(const struct mender *m, const double a[2], const double b[2])
{
	double shift[2];
	periods(m, a, b, shift);
	return hypot((a[0] - b[0] - shift[0]) * m->speed[0],
	             (a[1] - b[1] - shift[1]) * m->speed[1]);
}

/* The next curve of a chain that ends at `at`: its index, and whether to turn it about; -1: none
 * is near enough. */
static int choose(const struct mender *m, const struct curve *c, const bool *used, int n, int next,
                  const double at[2], bool *turn)
{
	int best = -1;
	double least = INFINITY;
	for (int k = 0; k < n; k++) {
		const int i = (next + k) % n;
		for (int end = 0; end < 2 && !used[i]; end++) {
			double uv[2];
			trim_curve_end(&c[i], end, uv);
			if (apart(m, at, uv) > m->tolerance)
				continue;
			double way = way_between(m, at, uv);
			/* the file's own order where it will do */
			if (way >= least || (best >= 0 && least <= 4 * m->tolerance))
				continue;
			best = i;
			least = way;
			*turn = end;
		}
	}
	return best;
}

enum status trim_chain(struct mender *m, const struct curve *c, int n, bool turn_first,
                       struct trim_loop *out, bool *whole)
{
	bool *used = calloc(n, sizeof *used), turn = turn_first;
	enum status st = used ? ST_OK : ST_RESOURCE;
	int next = 0, turned = 0, moved = 0;
	*whole = true;
	for (int k = 0; k < n && st == ST_OK; k++) {
		double at[2], start[2], shift[2] = { 0, 0 };
		int i = 0;
		if (k) {
			trim_curve_end(&out->curves[k - 1], 1, at);
			i = choose(m, c, used, n, next, at, &turn);
		}
		if (i < 0) {
			*whole = false;
			break;
		}
		struct curve one;
		st = curve_copy(&one, &c[i]);
		if (st != ST_OK)
			break;
		used[i] = true;
		moved += i != next;
		turned += turn;
		next = (i + 1) % n;
		if (turn)
			curve_reverse(&one);
		trim_curve_end(&one, 0, start);
		if (k)
			periods(m, at, start, shift);
		for (int d = 0; d < 2; d++)
			if (shift[d] != 0)
				trim_curve_move(&one, d, shift[d]);
		st = trim_loop_add(out, &one);
	}
	free(used);
	if (st == ST_OK && *whole) {
		m->turned += turned;
		m->moved += moved;
	}
	return st;
}

/* End and start that meet are made one, or joined by a line; `shift`: the start is that far off. */
static enum status join(struct mender *m, struct trim_loop *out, struct curve *a, struct curve *b,
                        const double shift[2])
{
	double end[2], start[2], middle[2], back[2];
	trim_curve_end(a, 1, end);
	trim_curve_end(b, 0, start);
	for (int d = 0; d < 2; d++)
		start[d] += shift[d];
	double gap = apart(m, end, start), way = way_between(m, end, start);
	if (way > rounding * surface_size(m->s)) {
		m->gaps += gap > rounding * surface_size(m->s);
		m->largest = fmax(m->largest, gap);
	}
	if (way > 4 * m->tolerance)
		return trim_add_line(out, end, start);
	for (int d = 0; d < 2; d++) {
		const double *range = m->s->domain[d];
		middle[d] = end[d] == start[d] ? end[d] : (end[d] + start[d]) / 2;
		for (int e = 0; e < 2; e++)
			if (end[d] == range[e] || start[d] == range[e])
				middle[d] = range[e];
		back[d] = middle[d] - shift[d];
	}
	trim_curve_set_end(a, 1, middle);
	trim_curve_set_end(b, 0, back);
	return ST_OK;
}

enum status trim_close_gaps(struct mender *m, struct trim_loop *l, double winds[2])
{
	struct trim_loop out = { .outer = l->outer };
	enum status st = ST_OK;
	double end[2], start[2], shift[2];
	trim_curve_end(&l->curves[l->n - 1], 1, end);
	trim_curve_end(&l->curves[0], 0, start);
	if (apart(m, end, start) > m->tolerance)
		return trim_fail(m, "does not close; expected each curve to start where one ends");
	periods(m, end, start, shift);
	const int n = l->n;
	for (int i = 0; i < n && st == ST_OK; i++) {
		struct curve *next = &l->curves[(i + 1) % n];
		const double none[2] = { 0, 0 };
		struct trim_loop line = { 0 };
		st = join(m, &line, &l->curves[i], next, i == n - 1 ? shift : none);
		struct curve one = { 0 };
		if (st == ST_OK)
			st = curve_copy(&one, &l->curves[i]);
		if (st == ST_OK)
			st = trim_loop_add(&out, &one);
		if (st == ST_OK && line.n)
			st = trim_loop_add(&out, &line.curves[0]);
		trim_loop_finish(&line);
	}
	/* the first curve's start was moved with the last join */
	if (st == ST_OK) {
		trim_curve_end(&l->curves[0], 0, start);
		trim_curve_set_end(&out.curves[0], 0, start);
	}
	for (int d = 0; d < 2; d++)
		winds[d] = round(shift[d] / m->length[d]);
	trim_loop_finish(l);
	*l = out;
	return st;
}
