/* grid.c - values on a regular grid of parameters, in bulk. */
#include "grid.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "grid_kernel.h"
#include "parallel.h"
#include "pole.h"

/* Columns of one span of u. */
struct run {
	int span, first, count; /* columns first .. first + count - 1 */
	size_t lane;            /* where they begin, a multiple of GRID_PAD */
};

struct grid {
	const struct surface *s; /* borrowed */
	const struct grid_kernel *kernel;
	int nu, nv;
	double *u, *v;    /* owned */
	struct run *runs; /* owned */
	int n_runs;
	size_t lanes;
	double *basis_u;       /* owned: [derivative][function][lane] */
	double *basis_v;       /* owned: [row][derivative][function] */
	int *span_v;           /* owned: of each row */
	int *floor_row;        /* owned: of each row, which row of `floor` */
	_Atomic double *floor; /* owned: [different span of v][run]; below 0: not looked at yet */
	bool shrunk[2][2];     /* border d, end is one point: its limits are known */
	struct pole pole[2][2];
};

void grid_lines(double a, double b, int n, double *out)
{
	for (int i = 0; i < n; i++)
		out[i] = i == 0 ? a : i == n - 1 ? b : a + (b - a) * ((double)i / (n - 1));
}

static const struct grid_kernel *kernel_choose(void)
{
#ifdef GRID_LEVELS_X86
	static const struct grid_kernel *const kernels[] = { &grid_kernel_v4, &grid_kernel_v3 };
	for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
		if (!strcmp(vector_level(), kernels[i]->level))
			return kernels[i];
#endif
	return &grid_kernel_baseline;
}

void grid_destroy(struct grid *g)
{
	if (!g)
		return;
	free(g->u);
	free(g->v);
	free(g->runs);
	free(g->basis_u);
	free(g->basis_v);
	free(g->span_v);
	free(g->floor_row);
	free(g->floor);
	free(g);
}

static double *lines_copy(const double *x, int n)
{
	double *out = malloc(sizeof *out * n);
	if (out)
		memcpy(out, x, sizeof *x * n);
	return out;
}

static int span_of(const struct surface *s, int d, double t)
{
	return knots_domain_span(s->order[d], s->n[d], s->knots[d], s->domain[d], t);
}

static enum status columns_prepare(struct grid *g)
{
	const struct surface *s = g->s;
	const int order = s->order[0];
	double basis[3 * ORDER_MAX];
	g->runs = malloc(sizeof *g->runs * g->nu);
	if (!g->runs)
		return ST_RESOURCE;
	for (int i = 0; i < g->nu; i++) {
		const int span = span_of(s, 0, g->u[i]);
		if (g->n_runs == 0 || g->runs[g->n_runs - 1].span != span)
			g->runs[g->n_runs++] = (struct run){ span, i, 0, g->lanes };
		struct run *run = &g->runs[g->n_runs - 1];
		if (run->count++ % GRID_PAD == 0)
			g->lanes += GRID_PAD;
	}
	const size_t bytes = sizeof(double) * 3 * order * g->lanes;
	g->basis_u = aligned_alloc(64, (bytes + 63) / 64 * 64);
	if (!g->basis_u)
		return ST_RESOURCE;
	for (int k = 0; k < g->n_runs; k++) {
		const struct run *run = &g->runs[k];
		const int padded = (run->count + GRID_PAD - 1) / GRID_PAD * GRID_PAD;
		for (int i = 0; i < padded; i++) {
			/* Lanes that only fill up repeat the last column. */
			const int column = run->first + (i < run->count ? i : run->count - 1);
			knots_basis(order, s->knots[0], run->span, g->u[column], 2, basis);
			for (int a = 0; a < 3 * order; a++)
				g->basis_u[a * g->lanes + run->lane + i] = basis[a];
		}
	}
	return ST_OK;
}

static enum status rows_prepare(struct grid *g)
{
	const struct surface *s = g->s;
	const int order = s->order[1];
	int floors = 0;
	g->span_v = malloc(sizeof *g->span_v * g->nv);
	g->floor_row = malloc(sizeof *g->floor_row * g->nv);
	g->basis_v = malloc(sizeof *g->basis_v * 3 * order * g->nv);
	if (!g->span_v || !g->floor_row || !g->basis_v)
		return ST_RESOURCE;
	for (int j = 0; j < g->nv; j++) {
		g->span_v[j] = span_of(s, 1, g->v[j]);
		if (j == 0 || g->span_v[j] != g->span_v[j - 1])
			floors++;
		g->floor_row[j] = floors - 1;
		knots_basis(order, s->knots[1], g->span_v[j], g->v[j], 2,
		            g->basis_v + (size_t)3 * order * j);
	}
	g->floor = malloc(sizeof *g->floor * floors * g->n_runs);
	if (!g->floor)
		return ST_RESOURCE;
	for (size_t i = 0; i < (size_t)floors * g->n_runs; i++)
		atomic_init(&g->floor[i], -1);
	return ST_OK;
}

/*
 * |Su x Sv|^2 up to which points of row j, run k go the slow way. Found when first asked for, so that
 * the first rows need not wait for the whole surface; threads that meet here find the same.
 */
static double floor_of(const struct grid *g, int j, int k)
{
	_Atomic double *place = &g->floor[(size_t)g->floor_row[j] * g->n_runs + k];
	double floor = atomic_load_explicit(place, memory_order_relaxed);
	if (floor >= 0)
		return floor;
	const int span[2] = { g->runs[k].span, g->span_v[j] };
	const struct pole_scale scale = pole_scale_of(g->s, span);
	const double low = pole_near * scale.area;
	floor = scale.none ? INFINITY : low * low;
	atomic_store_explicit(place, floor, memory_order_relaxed);
	return floor;
}

/* A border that is one point has one normal and one pair of curvatures: found once. */
static void borders_prepare(struct grid *g)
{
	const struct surface *s = g->s;
	for (int d = 0; d < 2; d++)
		for (int end = 0; end < 2; end++) {
			double at[2];
			at[d] = s->domain[d][end];
			at[1 - d] = s->domain[1 - d][0];
			const int span[2] = { span_of(s, 0, at[0]), span_of(s, 1, at[1]) };
			const struct pole_scale scale = pole_scale_of(s, span);
			if (scale.none || !surface_degenerate(s, d, end, 1e-12 * scale.length))
				continue;
			g->shrunk[d][end] = true;
			pole_limits(s, at[0], at[1], &scale, &g->pole[d][end]);
		}
}

enum status grid_create(struct grid **out, const struct surface *s, const double *u, int nu,
                        const double *v, int nv)
{
	struct grid *g = calloc(1, sizeof *g);
	if (!g)
		return ST_RESOURCE;
	g->s = s;
	g->kernel = kernel_choose();
	g->nu = nu;
	g->nv = nv;
	g->u = lines_copy(u, nu);
	g->v = lines_copy(v, nv);
	enum status st = g->u && g->v ? columns_prepare(g) : ST_RESOURCE;
	if (st == ST_OK)
		st = rows_prepare(g);
	if (st != ST_OK) {
		grid_destroy(g);
		return st;
	}
	borders_prepare(g);
	*out = g;
	return ST_OK;
}

/* The point, normal and values on a border that is one point; false where there is none such. The
 * normal curvatures along u and v turn along the border and are not known beforehand. */
static bool shape_known(const struct grid *g, const double at[2], unsigned what,
                        struct surface_shape *out)
{
	if (what & (GRID_BIT(QUANTITY_NORMAL_U) | GRID_BIT(QUANTITY_NORMAL_V)))
		return false;
	for (int d = 0; d < 2; d++)
		for (int end = 0; end < 2; end++)
			if (g->shrunk[d][end] && at[d] == g->s->domain[d][end]) {
				out->point = surface_point(g->s, at[0], at[1]);
				shape_from_pole(out, &g->pole[d][end]);
				return true;
			}
	return false;
}

/* One point the slow way, for poles and their surroundings. */
static void point_alone(const struct grid *g, double u, double v, unsigned what,
                        double value[N_GRID_CHANNELS])
{
	struct surface_shape shape;
	if (!shape_known(g, (const double[2]){ u, v }, what, &shape))
		surface_shape(g->s, u, v, &shape);
	memcpy(value, shape.value, sizeof shape.value);
	value[GRID_POINT_X] = shape.point.x;
	value[GRID_POINT_Y] = shape.point.y;
	value[GRID_POINT_Z] = shape.point.z;
	value[GRID_NORMAL_X] = shape.normal.x;
	value[GRID_NORMAL_Y] = shape.normal.y;
	value[GRID_NORMAL_Z] = shape.normal.z;
}

/* Prepare the strip of row j in run k. */
static void strip_set(const struct grid *g, int j, int k, unsigned what, struct grid_strip *strip)
{
	const struct surface *s = g->s;
	const int ku = s->order[0], kv = s->order[1];
	const struct run *run = &g->runs[k];
	const double *basis = g->basis_v + (size_t)3 * kv * j;
	const double *p =
	        s->points + 4 * ((size_t)(run->span - ku + 1) * s->n[1] + g->span_v[j] - kv + 1);
	/* Lengths are taken from a control point near by: the heaviest in v, and in u the one
	 * towards the nearer end of the surface, where a pole may be. */
	int heavy = 0;
	for (int i = 1; i < kv; i++)
		if (basis[i] > basis[heavy])
			heavy = i;
	const int side = 2 * run->span > s->n[0] + ku ? ku - 1 : 0;
	const double *o = p + 4 * ((size_t)s->n[1] * side + heavy);
	for (int c = 0; c < 3; c++)
		strip->center[c] = o[c] / o[3];
	strip->order = ku;
	strip->rational = s->rational;
	strip->stride = g->lanes;
	for (int d = 0; d < 3; d++)
		strip->basis[d] = g->basis_u + (size_t)d * ku * g->lanes;
	strip->floor = what & grid_first ? floor_of(g, j, k) : 0;
	g->kernel->net(strip, p, (size_t)4 * s->n[1], kv, basis);
}

/* Redo those of n lanes (columns from `column`) that the kernel has left. */
static void lanes_mend(const struct grid *g, int j, int column, size_t n, unsigned what,
                       double floor, struct grid_block *b, size_t skip)
{
	for (size_t i = skip; i < skip + n; i++) {
		if (b->area2[i] > floor)
			continue;
		double value[N_GRID_CHANNELS];
		point_alone(g, g->u[column + (int)(i - skip)], g->v[j], what, value);
		for (int c = 0; c < N_GRID_CHANNELS; c++)
			b->channel[c][i] = value[c];
	}
}

/* Columns a .. b - 1 of row j, all in run k; out + at is where column a goes. */
static void strip_rows(const struct grid *g, int j, int k, int a, int b, unsigned what, size_t at,
                       struct grid_strip *strip, struct grid_block *block,
                       double *const out[N_GRID_CHANNELS])
{
	const struct run *run = &g->runs[k];
	strip_set(g, j, k, what, strip);
	while (a < b) {
		/* Whole groups of lanes, of which the first `skip` were not asked for. */
		const size_t skip = (size_t)(a - run->first) % GRID_PAD;
		const size_t lane = run->lane + (a - run->first) - skip;
		size_t n = (skip + (b - a) + GRID_PAD - 1) / GRID_PAD * GRID_PAD;
		if (n > GRID_BLOCK)
			n = GRID_BLOCK;
		const size_t width = n - skip < (size_t)(b - a) ? n - skip : (size_t)(b - a);
		if (g->kernel->block(strip, what, lane, n, block) > 0)
			lanes_mend(g, j, a, width, what, strip->floor, block, skip);
		for (int c = 0; c < N_GRID_CHANNELS; c++)
			if (what & GRID_BIT(c))
				memcpy(out[c] + at, block->channel[c] + skip,
				       sizeof(double) * width);
		a += (int)width;
		at += width;
	}
}

enum status grid_rows(const struct grid *g, unsigned what, int first, int count, int from,
                      int width, double *const out[N_GRID_CHANNELS])
{
	const size_t size = (sizeof(struct grid_block) + 63) / 64 * 64;
	struct grid_block *block = aligned_alloc(64, size);
	struct grid_strip strip;
	if (!block)
		return ST_RESOURCE;
	for (int j = 0; j < count; j++)
		for (int k = 0; k < g->n_runs; k++) {
			const struct run *run = &g->runs[k];
			const int a = run->first > from ? run->first : from;
			const int end = run->first + run->count;
			const int b = end < from + width ? end : from + width;
			if (a < b)
				strip_rows(g, first + j, k, a, b, what,
				           (size_t)j * width + (a - from), &strip, block, out);
		}
	free(block);
	return ST_OK;
}
