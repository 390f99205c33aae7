/* trim_test.c - is a point, or a box, on the part that the loops leave? By the crossings of loops
 * with the line from the point in the direction of u, loop by loop. */
#include <stdlib.h>
#include <string.h>

#include "trim_pieces.h"

enum { BANDS_MAX = 4096, ENTRIES_A_PIECE = 16 };

static int band_of(const struct trim_test *x, double v)
{
	const double *d = x->domain[1];
	double at = (v - d[0]) / (d[1] - d[0]) * x->bands;
	return at > 0 ? at < x->bands ? (int)at : x->bands - 1 : 0;
}

/* How many entries the bands' lists need together. */
static int64_t count_entries(const struct trim_test *x)
{
	int64_t n = 0;
	for (int i = 0; i < x->pieces.n; i++) {
		const struct trim_piece *p = &x->pieces.pieces[i];
		n += band_of(x, p->v[1]) - band_of(x, p->v[0]) + 1;
	}
	return n;
}

static enum status fill_bands(struct trim_test *x)
{
	const int n = x->pieces.n;
	x->bands = n < 1 ? 1 : n < BANDS_MAX ? n : BANDS_MAX;
	while (x->bands > 1 && count_entries(x) > (int64_t)ENTRIES_A_PIECE * n)
		x->bands /= 2;
	x->first = calloc((size_t)x->bands + 2, sizeof *x->first);
	x->list = malloc((count_entries(x) + 1) * sizeof *x->list);
	if (!x->first || !x->list)
		return ST_RESOURCE;
	/* first[b + 1] counts, then runs from the band's begin to its end */
	int *count = x->first + 1;
	for (int i = 0; i < n; i++) {
		const struct trim_piece *p = &x->pieces.pieces[i];
		for (int b = band_of(x, p->v[0]); b <= band_of(x, p->v[1]); b++)
			count[b + 1]++;
	}
	for (int b = 0; b < x->bands; b++)
		count[b + 1] += count[b];
	for (int i = 0; i < n; i++) {
		const struct trim_piece *p = &x->pieces.pieces[i];
		for (int b = band_of(x, p->v[0]); b <= band_of(x, p->v[1]); b++)
			x->list[count[b]++] = i;
	}
	return ST_OK;
}

enum status trim_test_create(struct trim_test **out, const struct trim *t, const struct surface *s)
{
	struct trim_test *x = calloc(1, sizeof *x);
	*out = NULL;
	if (!x)
		return ST_RESOURCE;
	memcpy(x->domain, s->domain, sizeof x->domain);
	x->outer = calloc((size_t)t->n + 1, sizeof *x->outer);
	enum status st = x->outer ? trim_pieces_init(&x->pieces, t, s->domain) : ST_RESOURCE;
	for (int i = 0; st == ST_OK && i < t->n; i++) {
		x->outer[i] = t->loops[i].outer;
		x->any_outer |= x->outer[i];
	}
	if (st == ST_OK)
		st = fill_bands(x);
	if (st == ST_OK)
		*out = x;
	else
		trim_test_destroy(x);
	return st;
}

void trim_test_destroy(struct trim_test *x)
{
	if (!x)
		return;
	trim_pieces_finish(&x->pieces);
	free(x->outer);
	free(x->first);
	free(x->list);
	free(x);
}

/* The piece's u at v; v lies between its ends. */
static double piece_u(const struct trim_piece *p, double v)
{
	double uv[2], d[2];
	trim_piece_point(p, trim_piece_find(p, 1, v), uv, d);
	return fmin(fmax(uv[0], p->lo_u), p->hi_u);
}

/* Does the line from (u, v) to larger u cross the piece? */
static inline bool piece_crosses(const struct trim_piece *p, double u, double v)
{
	if (!(v >= p->v[0] && v < p->v[1]) || u >= p->hi_u)
		return false;
	return u < p->lo_u || u < piece_u(p, v);
}

/* Whether one is inside after the loops looked at: of `outer` in any, of inner ones in none. */
struct state {
	bool outer, inner;
};

static inline void state_add(struct state *s, const struct trim_test *x, int loop, bool odd)
{
	if (x->outer[loop])
		s->outer |= odd;
	else
		s->inner |= odd;
}

static inline bool state_inside(const struct state *s, const struct trim_test *x)
{
	return (s->outer || !x->any_outer) && !s->inner;
}

bool trim_test_state(const struct trim_test *x, double u, double v)
{
	const int band = band_of(x, v);
	struct state s = { false, false };
	for (int i = x->first[band]; i < x->first[band + 1];) {
		const int loop = x->pieces.pieces[x->list[i]].loop;
		bool odd = false;
		for (; i < x->first[band + 1]; i++) {
			const struct trim_piece *p = &x->pieces.pieces[x->list[i]];
			if (p->loop != loop)
				break;
			odd ^= piece_crosses(p, u, v);
		}
		state_add(&s, x, loop, odd);
	}
	return state_inside(&s, x);
}

int trim_test_step(const struct trim_test *x, int piece, double u, double v)
{
	const int band = band_of(x, v), own = x->pieces.pieces[piece].loop;
	struct state left = { false, false }, right = left;
	bool own_odd = false;
	for (int i = x->first[band]; i < x->first[band + 1];) {
		const int loop = x->pieces.pieces[x->list[i]].loop;
		bool odd = false;
		for (; i < x->first[band + 1]; i++) {
			const int k = x->list[i];
			const struct trim_piece *p = &x->pieces.pieces[k];
			if (p->loop != loop)
				break;
			if (k == piece || !(v >= p->v[0] && v < p->v[1]) || u > p->hi_u)
				continue;
			/* pieces in one place are passed one after the other */
			double at = u < p->lo_u ? INFINITY : piece_u(p, v);
			odd ^= at > u || (at == u && k > piece);
		}
		if (loop == own) {
			own_odd = odd;
			continue;
		}
		state_add(&left, x, loop, odd);
		state_add(&right, x, loop, odd);
	}
	state_add(&left, x, own, !own_odd);
	state_add(&right, x, own, own_odd);
	return state_inside(&left, x) - state_inside(&right, x);
}

/* Parameters of one piece that are being gathered. */
struct places {
	double *at; /* owned */
	int n, room;
};

static enum status places_add(struct places *p, double t)
{
	if (p->n == p->room) {
		const int room = p->room ? 2 * p->room : 8;
		double *more = reallocarray(p->at, room, sizeof *more);
		if (!more)
			return ST_RESOURCE;
		p->at = more;
		p->room = room;
	}
	p->at[p->n++] = t;
	return ST_OK;
}

/* Where the difference of two pieces' u, off[0] and off[1] at v[0] and v[1], changes its sign. */
static double place_between(const struct trim_piece *p, const struct trim_piece *q,
                            const double v[2], const double off[2])
{
	double lo = v[0], hi = v[1], a = off[0], b = off[1], at = lo;
	/* false position; the side that stays counts half each time (Illinois) */
	for (int i = 0, stays = 0; i < 40 && hi - lo > 1e-15 * (v[1] - v[0]); i++) {
		at = lo + (hi - lo) * (a / (a - b));
		if (!(at > lo && at < hi))
			at = (lo + hi) / 2;
		const double x = piece_u(p, at) - piece_u(q, at);
		if (x == 0 || fabs(x) < 1e-15 * fabs(off[0] - off[1]))
			break;
		if ((x > 0) == (a > 0)) {
			lo = at;
			a = x;
			b = stays == 1 ? b / 2 : b;
			stays = 1;
		} else {
			hi = at;
			b = x;
			a = stays == -1 ? a / 2 : a;
			stays = -1;
		}
	}
	return at;
}

/* Where p crosses or touches q at v[0] <= v <= v[1]. */
static enum status places_of_pair(struct places *out, const struct trim_piece *p,
                                  const struct trim_piece *q, const double v[2], double near)
{
	enum { PARTS = 12 };
	const double own[2] = { piece_u(p, v[0]), piece_u(p, v[1]) };
	/* a level q is wherever its ends are */
	const bool level = q->v[0] == q->v[1];
	const double its[2] = { level ? q->lo_u : piece_u(q, v[0]),
		                level ? q->hi_u : piece_u(q, v[1]) };
	if (fmax(own[0], own[1]) < fmin(its[0], its[1]) - near ||
	    fmin(own[0], own[1]) > fmax(its[0], its[1]) + near)
		return ST_OK;
	if (level || v[0] == v[1])
		return places_add(out, trim_piece_find(p, 1, v[0]));
	/* those of opposite slopes meet once */
	const bool once = (!p->points && !q->points) || (own[1] - own[0]) * (its[1] - its[0]) <= 0;
	const int parts = once ? 1 : PARTS;
	double at[2] = { v[0], v[0] }, off[2] = { 0, 0 };
	enum status st = ST_OK;
	for (int i = 0; i <= parts && st == ST_OK; i++) {
		at[1] = i < parts ? v[0] + (v[1] - v[0]) * i / parts : v[1];
		off[1] = i == 0       ? own[0] - its[0]
		         : i == parts ? own[1] - its[1]
		                      : piece_u(p, at[1]) - piece_u(q, at[1]);
		if (fabs(off[1]) <= near)
			st = places_add(out, trim_piece_find(p, 1, at[1]));
		else if (off[0] * off[1] < 0)
			st = places_add(out, trim_piece_find(p, 1, place_between(p, q, at, off)));
		at[0] = at[1];
		off[0] = off[1];
	}
	return st;
}

enum status trim_test_crossings(const struct trim_test *x, int piece, const double t[2],
                                const int *others, int n_others, double **at, int *n)
{
	const struct trim_piece *p = &x->pieces.pieces[piece];
	const double near = 1e-12 * (x->domain[0][1] - x->domain[0][0]);
	struct places out = { 0 };
	enum status st = ST_OK;
	double a[2], b[2], d[2];
	trim_piece_point(p, t[0], a, d);
	trim_piece_point(p, t[1], b, d);
	const double lo = fmin(a[0], b[0]) - near, hi = fmax(a[0], b[0]) + near;
	const int from = x->first[band_of(x, a[1])], to = x->first[band_of(x, b[1]) + 1];
	if (to - from < n_others) {
		others = x->list + from;
		n_others = to - from;
	}
	for (int i = 0; i < n_others && st == ST_OK; i++) {
		const struct trim_piece *q = &x->pieces.pieces[others[i]];
		const double v[2] = { fmax(a[1], q->v[0]), fmin(b[1], q->v[1]) };
		if (others[i] != piece && v[0] <= v[1] && q->hi_u >= lo && q->lo_u <= hi)
			st = places_of_pair(&out, p, q, v, near);
	}
	*at = out.at;
	*n = out.n;
	return st;
}

bool trim_test_inside(const struct trim_test *x, double u, double v)
{
	return trim_test_state(x, fmin(fmax(u, x->domain[0][0]), x->domain[0][1]),
	                       fmin(fmax(v, x->domain[1][0]), x->domain[1][1]));
}

/* Does the piece, or what rounding leaves about it, meet the box? */
static bool piece_meets(const struct trim_piece *p, const double lo[2], const double hi[2],
                        const double near[2])
{
	double u[2] = { p->lo_u, p->hi_u };
	if (p->v[1] < lo[1] - near[1] || p->v[0] > hi[1] + near[1] || u[1] < lo[0] - near[0] ||
	    u[0] > hi[0] + near[0])
		return false;
	if (p->v[0] < p->v[1]) {
		double a = piece_u(p, fmin(fmax(p->v[0], lo[1] - near[1]), p->v[1]));
		double b = piece_u(p, fmax(fmin(p->v[1], hi[1] + near[1]), p->v[0]));
		u[0] = fmin(a, b);
		u[1] = fmax(a, b);
	}
	return u[1] >= lo[0] - near[0] && u[0] <= hi[0] + near[0];
}

int trim_test_box(const struct trim_test *x, const double lo[2], const double hi[2])
{
	const double near[2] = { 1e-12 * (x->domain[0][1] - x->domain[0][0]),
		                 1e-12 * (x->domain[1][1] - x->domain[1][0]) };
	const int from = x->first[band_of(x, lo[1] - near[1])];
	const int to = x->first[band_of(x, hi[1] + near[1]) + 1];
	for (int i = from; i < to; i++)
		if (piece_meets(&x->pieces.pieces[x->list[i]], lo, hi, near))
			return 0;
	return trim_test_inside(x, (lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2) ? 1 : -1;
}

bool trim_test_range(const struct trim_test *x, double range[2][2])
{
	memcpy(range, x->domain, sizeof x->domain);
	if (!x->any_outer)
		return true;
	double box[2][2] = { { INFINITY, -INFINITY }, { INFINITY, -INFINITY } };
	for (int i = 0; i < x->pieces.n; i++) {
		const struct trim_piece *p = &x->pieces.pieces[i];
		if (!x->outer[p->loop])
			continue;
		box[0][0] = fmin(box[0][0], p->lo_u);
		box[0][1] = fmax(box[0][1], p->hi_u);
		box[1][0] = fmin(box[1][0], p->v[0]);
		box[1][1] = fmax(box[1][1], p->v[1]);
	}
	for (int d = 0; d < 2; d++) {
		range[d][0] = fmax(range[d][0], box[d][0]);
		range[d][1] = fmin(range[d][1], box[d][1]);
	}
	return range[0][0] < range[0][1] && range[1][0] < range[1][1];
}
