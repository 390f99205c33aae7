/* level_cell.c - halve a patch into cells until signs of coefficients tell what is in each.
 *
 * All coefficients of f of one sign, and beyond rounding: no curve. All differences in one direction
 * likewise: f is monotone there, the curve is a graph over the other direction, and the signs of f along the two
 * sides that the graph may leave by tell every arc. Sign tests are exact in floating point, and
 * halving is the same on both sides of a line, so neighbouring cells see the same ends.
 */
#include "level_form.h"
#include "level_private.h"

#include <math.h>
#include <string.h>

#include "level_isophote.h"

/* A patch with many undecided cells is not halved so far any more. */
enum { FEW_UNDECIDED = 256, MANY_UNDECIDED = 1024, DEPTH_AFTER_FEW = 11, DEPTH_AFTER_MANY = 7 };

/* A cell halved less often is a plateau where f counts as zero, and may be slender; a smaller one
 * is a plateau only where rounding leaves nothing of f. */
enum { LARGE_LEVELS = 16, SLENDER_LEVELS = 6 };

/* Where the error is above this part of f, f is made once more on cells of every so many levels, and on those that can
 * be decided. */
#define AGAIN_SHARE 1e-5
enum { AGAIN_LEVELS = 8, AGAIN_MAX = 4096 };

/* A side cleared of rounding has numbers below this part of the error. */
#define SIDE_ZERO 1e-6

/* Where normals are so near to 90 degrees, or as near as the tolerance is of the size, a flat face may be in the level but
 * for its last digits. */
#define LEVEL_SHARE 1e-4

/* Smaller cells are no plateau: they are about crossings. */
enum { PLATEAU_LEVELS = 24 };

/* It is where the change of f over a tolerance is nowhere above so many times the error; where it is below the second
 * somewhere, the cell is halved. */
#define LOOSE_TIMES 32
#define FIRM_TIMES  8

enum monotone { MONOTONE_NOT, MONOTONE_RISING, MONOTONE_FALLING };

static struct undecided *undecided_add(struct tracer *t, const struct cell *cell, bool flat)
{
	struct undecided *x = list_add(&t->undecided, sizeof *x);
	if (!x) {
		t->failed = true;
		return NULL;
	}
	for (int d = 0; d < 2; d++) {
		x->level[d] = cell->level[d];
		x->index[d] = (int)cell->index[d];
	}
	x->flat = flat;
	return x;
}

/* All differences in direction d are beyond rounding and of one sign. */
static enum monotone monotone_in(const struct tracer *t, const double *c, int d, double error)
{
	int m = t->level->degree[0], n = t->level->degree[1];
	size_t step = d == 0 ? (size_t)n + 1 : 1;
	int rows = d == 0 ? m : m + 1, columns = d == 0 ? n + 1 : n;
	double least = 2.0001 * error;
	bool rising = true, falling = true;
	for (int i = 0; i < rows && (rising || falling); i++) {
		const double *x = c + (size_t)i * (n + 1);
		for (int j = 0; j < columns; j++) {
			double change = x[j + step] - x[j];
			rising &= change > least;
			falling &= change < -least;
		}
	}
	return rising ? MONOTONE_RISING : falling ? MONOTONE_FALLING : MONOTONE_NOT;
}

/* Sum of second differences, as a measure of how far from linear f is. */
static double bend_in(const double *c, int m, int n, int d)
{
	size_t step = d == 0 ? (size_t)n + 1 : 1;
	int rows = d == 0 ? m - 1 : m + 1, columns = d == 0 ? n + 1 : n - 1;
	double sum = 0;
	for (int i = 0; i < rows; i++) {
		const double *x = c + (size_t)i * (n + 1);
		for (int j = 0; j < columns; j++)
			sum += fabs(x[j] - 2 * x[j + step] + x[j + 2 * step]);
	}
	return sum;
}

/* Change of f over the cell in direction d, in the patch's parameter. */
static double change_in(const double *c, int m, int n, int d)
{
	size_t row = (size_t)n + 1, last = row * (m + 1) - 1;
	if (d == 0)
		return fabs(c[row * m] - c[0]) + fabs(c[last] - c[n]);
	return fabs(c[n] - c[0]) + fabs(c[last] - c[row * m]);
}

static struct cell_range range_of(const struct cell *cell)
{
	struct cell_range r;
	for (int d = 0; d < 2; d++) {
		double size = ldexp(1, -cell->level[d]);
		r.lo[d] = cell->index[d] * size;
		r.hi[d] = (cell->index[d] + 1.0) * size;
	}
	return r;
}

/* The line that bounds a cell in direction d, below or above it. */
static int line_of(const struct cell *cell, int d, bool upper)
{
	return (int)((cell->index[d] + upper) << (LINE_BITS - cell->level[d]));
}

/* One arc's end: on a side across (the graph leaves by it) or on an end of the graph's range. */
struct place {
	bool across;  /* on the lower or upper side of the direction that f is monotone in */
	bool upper;   /* which of the two sides */
	double along; /* [0, 1] in the cell */
};

struct graph {
	struct tracer *t;
	const struct cell *cell;
	const double *c;
	int along; /* direction of the graph's variable; f is monotone in the other */
	bool rising;
};

/* Coefficients on the side of the cell where direction d is at its lower or upper end. */
static int side_get(const struct graph *g, int d, bool upper, double *out)
{
	int m = g->t->level->degree[0], n = g->t->level->degree[1];
	size_t row = (size_t)n + 1;
	const double *c = g->c + (!upper ? 0 : d == 0 ? row * m : (size_t)n);
	int count = d == 0 ? n : m;
	for (int i = 0; i <= count; i++)
		out[i] = c[d == 0 ? (size_t)i : row * i];
	return count;
}

static void arc_add(const struct graph *g, const struct place ends[2])
{
	struct tracer *t = g->t;
	int along = g->along, other = 1 - along;
	struct cell_range r = range_of(g->cell);
	double uv[2][2], side[FIELD_DEGREE_MAX + 1];
	int arc = (int)t->arcs.n;
	for (int e = 0; e < 2; e++) {
		struct arc_end *x = list_add(&t->ends, sizeof *x);
		double y = ends[e].upper, w = ends[e].along;
		if (!x) {
			t->failed = true;
			return;
		}
		if (!ends[e].across) {
			int n = side_get(g, along, ends[e].upper, side);
			w = ends[e].upper;
			y = side[0] >= 0 ? 0 : 1;
			root_single(side, n, &y);
		}
		uv[e][along] = r.lo[along] + (r.hi[along] - r.lo[along]) * w;
		uv[e][other] = r.lo[other] + (r.hi[other] - r.lo[other]) * y;
		x->d = ends[e].across ? other : along;
		x->upper = !ends[e].upper;
		x->line = line_of(g->cell, x->d, ends[e].upper);
		x->arc = arc;
		x->end = e;
		x->at = uv[e][1 - x->d];
	}
	level_arc_follow(t, &r, g->c, g->cell->error, along, g->rising, uv);
}

/*
 * Walk along the graph's variable through the places where f changes sign on the two sides. The
 * curve is between the sides while their signs differ.
 */
static void arcs_find(const struct graph *g)
{
	double side[2][FIELD_DEGREE_MAX + 1], root[2][FIELD_DEGREE_MAX + 2];
	int n[2], next[2] = { 0, 0 };
	bool positive[2], in;
	struct place ends[2] = { { 0 } };
	for (int k = 0; k < 2; k++) {
		int degree = side_get(g, 1 - g->along, k, side[k]);
		n[k] = roots_find(side[k], degree, root[k]);
		positive[k] = side[k][0] >= 0;
	}
	in = positive[0] != positive[1];
	for (;;) {
		int k = -1;
		if (next[0] < n[0] && next[1] < n[1]) {
			k = root[1][next[1]] < root[0][next[0]];
			/* the order of two that rounding made equal follows from the slope's sign */
			bool lower = positive[0] != (k == 0), upper = positive[1] != (k == 1);
			if (g->rising ? lower && !upper : !lower && upper)
				k = !k;
		} else if (next[0] < n[0] || next[1] < n[1]) {
			k = next[0] < n[0] ? 0 : 1;
		}
		if (k < 0) {
			if (in) {
				ends[1] = (struct place){ .upper = true };
				arc_add(g, ends);
			}
			return;
		}
		ends[in] = (struct place){ true, k, root[k][next[k]] };
		next[k]++;
		positive[k] = !positive[k];
		if (in)
			arc_add(g, ends);
		in = !in;
	}
}

/* Halve no further than this. */
static int deepest(const struct tracer *t)
{
	size_t found = t->undecided.n;
	return found < FEW_UNDECIDED    ? CELL_DEPTH_MAX
	       : found < MANY_UNDECIDED ? DEPTH_AFTER_FEW
	                                : DEPTH_AFTER_MANY;
}

/*
 * The zeros along a side are those of every f within the error, or their places are added as
 * undecided. `strip`: the cell, halved along the side.
 */
static void side_confirm(struct tracer *t, const double *c, int n, int d, bool upper,
                         struct cell strip)
{
	bool above = true, below = true, rising = true, falling = true, zero = true;
	double e = strip.error;
	for (int i = 0; i <= n; i++) {
		above &= c[i] > e;
		below &= c[i] < -e;
		zero &= fabs(c[i]) < SIDE_ZERO * e;
		rising &= i == n || c[i + 1] - c[i] > 2.0001 * e;
		falling &= i == n || c[i + 1] - c[i] < -2.0001 * e;
	}
	if (above || below || rising || falling || zero || tracer_ends(t))
		return;
	int along = 1 - d;
	if (strip.level[along] >= deepest(t)) {
		strip.index[d] =
		        upper ? ((strip.index[d] + 1) << (CELL_DEPTH_MAX - strip.level[d])) - 1
		              : strip.index[d] << (CELL_DEPTH_MAX - strip.level[d]);
		strip.level[d] = CELL_DEPTH_MAX;
		struct undecided *x = undecided_add(t, &strip, false);
		if (x)
			x->graze = true;
		return;
	}
	double lower[FIELD_DEGREE_MAX + 1], rest[FIELD_DEGREE_MAX + 1];
	memcpy(rest, c, sizeof *c * (n + 1));
	form_split(rest, 0, n, 1, lower);
	strip.error += n * UNIT_ROUNDOFF * form_most(c, (size_t)n + 1);
	strip.level[along]++;
	strip.index[along] *= 2;
	side_confirm(t, lower, n, d, upper, strip);
	strip.index[along]++;
	side_confirm(t, rest, n, d, upper, strip);
}

/* Sides of a decided cell on lines where f has no derivative, or ends. */
static void sides_confirm(const struct graph *g)
{
	struct tracer *t = g->t;
	double side[FIELD_DEGREE_MAX + 1];
	for (int k = 0; k < 4; k++) {
		int d = k / 2, upper = k % 2;
		unsigned last = (1u << g->cell->level[d]) - 1;
		if (!t->bent[d][upper] || g->cell->index[d] != (upper ? last : 0))
			continue;
		int n = side_get(g, d, upper, side);
		side_confirm(t, side, n, d, upper, *g->cell);
	}
}

static bool cell_monotone(const struct tracer *t, const struct cell *cell, const double *c)
{
	return monotone_in(t, c, 0, cell->error) || monotone_in(t, c, 1, cell->error);
}

/* The least or the largest change of f over a tolerance in direction d. */
static void slopes_in(const struct tracer *t, const struct cell *cell, const double *c, int d,
                      double *least, double *most)
{
	const struct level *l = t->level;
	const int m = l->degree[0], n = l->degree[1];
	const size_t step = d == 0 ? (size_t)n + 1 : 1;
	const int rows = d == 0 ? m : m + 1, columns = d == 0 ? n + 1 : n;
	const double first = l->surface->shapes[t->patch].first[d];
	*least = INFINITY;
	*most = 0;
	for (int i = 0; i < rows; i++)
		for (int j = 0; j < columns; j++) {
			const double *x = c + (size_t)i * (n + 1) + j;
			*least = smaller(*least, fabs(x[step] - x[0]));
			*most = larger(*most, fabs(x[step] - x[0]));
		}
	const double times = ldexp(l->degree[d] * l->tolerance / first, cell->level[d]);
	*least *= times;
	*most *= times;
}

enum firmness { CELL_FIRM, CELL_MIXED, CELL_LOOSE };

/*
 * The normal is nearly at 90 degrees all over the cell, and f so flat that rounding leaves much of the tolerance, or more
 * than it: such a cell is a plateau, whatever the signs of f in it.
 */
static enum firmness cell_firmness(const struct tracer *t, const struct cell *cell, const double *c,
                                   double most)
{
	const struct level *l = t->level;
	const struct level_surface *s = l->surface;
	if ((s->kind != LEVEL_ISOPHOTE && s->kind != LEVEL_SILHOUETTE) || l->value != 0 ||
	    cell->level[0] + cell->level[1] >= PLATEAU_LEVELS)
		return CELL_FIRM;
	if (most > larger(LEVEL_SHARE, l->tolerance / s->net.size) * t->bound.size)
		return CELL_FIRM;
	double least[2], largest[2];
	for (int d = 0; d < 2; d++)
		slopes_in(t, cell, c, d, &least[d], &largest[d]);
	if (larger(largest[0], largest[1]) < LOOSE_TIMES * cell->error)
		return CELL_LOOSE;
	return larger(least[0], least[1]) < FIRM_TIMES * cell->error ? CELL_MIXED : CELL_FIRM;
}

/* True where the cell is certain, and its arcs are done. */
static bool cell_decide(struct tracer *t, const struct cell *cell, const double *c)
{
	int m = t->level->degree[0], n = t->level->degree[1];
	enum monotone in[2] = { monotone_in(t, c, 0, cell->error),
		                monotone_in(t, c, 1, cell->error) };
	if (!in[0] && !in[1])
		return false;
	int d = in[0] ? 0 : 1;
	if (in[0] && in[1])
		d = ldexp(change_in(c, m, n, 0), cell->level[0]) >=
		                    ldexp(change_in(c, m, n, 1), cell->level[1])
		            ? 0
		            : 1;
	struct graph g = { t, cell, c, 1 - d, in[d] == MONOTONE_RISING };
	arcs_find(&g);
	sides_confirm(&g);
	return true;
}

void level_patch_undecided(struct tracer *t, bool flat)
{
	undecided_add(t, &(struct cell){ .error = 0 }, flat);
}

/* The array of cells at a depth, made when first needed. */
static double *scratch_at(struct tracer *t, int depth)
{
	if (!t->scratch[depth])
		t->scratch[depth] = level_room(t, t->n_field + t->n_side);
	return t->scratch[depth];
}

static void cell_search(struct tracer *t, double *c, struct cell cell, int depth);

/* Rounding is much of f in the cell, and f can be made once more. */
static bool cell_coarse(const struct cell *cell, double most)
{
	return cell->error > AGAIN_SHARE * most && cell->made < cell->level[0] + cell->level[1];
}

static bool cell_again(struct tracer *t, double *c, struct cell cell, int depth)
{
	const struct bound before = t->bound;
	struct bound b;
	if (t->n_again >= AGAIN_MAX || !level_isophote_again(t, &cell, c, &b))
		return false;
	t->n_again++;
	cell.made = cell.level[0] + cell.level[1];
	cell.error = b.error;
	t->bound = b;
	cell_search(t, c, cell, depth);
	t->bound = before;
	return true;
}

static void cell_search(struct tracer *t, double *c, struct cell cell, int depth)
{
	int m = t->level->degree[0], n = t->level->degree[1];
	double lo, hi;
	if (tracer_ends(t))
		return;
	form_range(c, t->n_field, &lo, &hi);
	double most = larger(-lo, hi);
	const int levels = cell.level[0] + cell.level[1];
	bool large = levels < LARGE_LEVELS;
	const bool coarse = cell_coarse(&cell, most);
	if (coarse && levels % AGAIN_LEVELS == 0 && cell_again(t, c, cell, depth))
		return;
	if (most <= cell.error || (large && most <= ZERO_SHARE * t->bound.size)) {
		undecided_add(t, &cell, true);
		return;
	}
	if (lo > cell.error || hi < -cell.error)
		return;
	bool one_side = true;
	if (t->n_side) {
		form_range(c + t->n_field, t->n_side, &lo, &hi);
		if (hi < -t->side_error)
			return;
		one_side = lo > t->side_error;
	}
	if (coarse && one_side && cell_monotone(t, &cell, c) && cell_again(t, c, cell, depth))
		return;
	if (levels > 0 && levels % AGAIN_LEVELS == 0 && level_isophote_clear(t, &cell))
		return;
	const enum firmness firmness = cell_firmness(t, &cell, c, most);
	if (firmness == CELL_LOOSE) {
		undecided_add(t, &cell, false);
		return;
	}
	if (firmness == CELL_FIRM && one_side && cell_decide(t, &cell, c))
		return;
	int limit = deepest(t),
	    d = bend_in(c, m, n, 0) * m * m >= bend_in(c, m, n, 1) * n * n ? 0 : 1;
	if (cell.level[d] > cell.level[1 - d] + (large ? SLENDER_LEVELS : 0))
		d = 1 - d;
	if (cell.level[d] >= limit)
		d = 1 - d;
	if (cell.level[d] >= limit) {
		undecided_add(t, &cell, false);
		return;
	}
	double *lower = scratch_at(t, depth);
	if (!lower)
		return;
	form_split(c, m, n, d, lower);
	if (t->n_side)
		form_split(c + t->n_field, t->level->side_degree[0], t->level->side_degree[1], d,
		           lower + t->n_field);
	/* as many means are taken one after another */
	cell.error += (d == 0 ? m : n) * UNIT_ROUNDOFF * most;
	cell.level[d]++;
	cell.index[d] *= 2;
	cell_search(t, lower, cell, depth + 1);
	cell.index[d]++;
	cell_search(t, c, cell, depth + 1);
}

void level_search(struct tracer *t, double *c)
{
	int degree = t->level->degree[0] + t->level->degree[1];
	if (t->n_side)
		t->side_error += CELL_DEPTH_MAX * degree * UNIT_ROUNDOFF *
		                 form_most(c + t->n_field, t->n_side);
	cell_search(t, c, (struct cell){ .error = t->bound.error }, 0);
}
