/* test_level_sweep.c - every kind on random surfaces, counted by changes of sign on a grid. */
#include "arbitrary.h"
#include "level_check.h"
#include "level_grid.h"

/* A level is counted where a level this part of the range away on either side counts the same: there a
 * grid tells the truth. */
static const double apart = 0.004;

struct grid {
	struct vec3 *p, *n;       /* owned */
	double *f, *moved, *k[2]; /* owned; k: Gaussian and mean curvature */
	int *parent;              /* owned */
};

static void grid_init(struct grid *g)
{
	const size_t n = ROW * ROW;
	*g = (struct grid){ .p = malloc(sizeof *g->p * n),
		            .n = malloc(sizeof *g->n * n),
		            .f = malloc(sizeof *g->f * n),
		            .moved = malloc(sizeof *g->f * n),
		            .k = { malloc(sizeof *g->f * n), malloc(sizeof *g->f * n) },
		            .parent = malloc(sizeof *g->parent * EDGES) };
	assert_true(g->p && g->n && g->f && g->moved && g->k[0] && g->k[1] && g->parent);
}

static void grid_finish(struct grid *g)
{
	free(g->p);
	free(g->n);
	free(g->f);
	free(g->moved);
	free(g->k[0]);
	free(g->k[1]);
	free(g->parent);
}

static void grid_sample(struct grid *g, const struct surface *s, bool curvatures)
{
	for (int i = 0; i < ROW * ROW; i++) {
		const double u = in_range(s->domain[0], (double)(i / ROW) / GRID);
		const double v = in_range(s->domain[1], (double)(i % ROW) / GRID);
		struct surface_shape x;
		if (curvatures) {
			surface_shape(s, u, v, &x);
			g->p[i] = x.point;
			g->n[i] = x.normal;
			g->k[0][i] = x.value[QUANTITY_GAUSSIAN];
			g->k[1][i] = x.value[QUANTITY_MEAN];
			continue;
		}
		surface_tangents(s, u, v, &x.point, &x.du, &x.dv);
		g->p[i] = x.point;
		g->n[i] = vec3_unit(vec3_cross(x.du, x.dv));
	}
}

/* The field at node i, without its value. */
static double node(const struct grid *g, const struct level_field *f, int i)
{
	const struct vec3 p = g->p[i], n = g->n[i], l = vec3_unit(f->direction);
	const struct vec3 q = vec3_sub(f->point, p), d = vec3_sub(p, f->eye);
	const struct vec3 c = vec3_cross(n, l);
	switch (f->kind) {
	case LEVEL_PLANE:
		return vec3_dot(p, f->direction);
	case LEVEL_CYLINDER:
		return vec3_length(vec3_cross(q, l));
	case LEVEL_ISOPHOTE:
	case LEVEL_SILHOUETTE:
		return vec3_dot(n, l);
	case LEVEL_EYE:
		return vec3_dot(n, d);
	case LEVEL_HIGHLIGHT:
		return vec3_dot(vec3_unit(c), q);
	case LEVEL_REFLECTION:
		return vec3_dot(vec3_cross(vec3_along(d, -2 * vec3_dot(n, d), n), l), q);
	default:
		return g->k[f->quantity == QUANTITY_MEAN][i];
	}
}

static struct vec3 direction(uint64_t *seed)
{
	const double a = 2 * pi * any_number(seed), z = 2 * any_number(seed) - 1;
	return vec3(sqrt(1 - z * z) * cos(a), sqrt(1 - z * z) * sin(a), z);
}

/* A field that has a level on this surface: its value is on it, or its line is seen from a node. */
static struct level_field field(const struct grid *g, enum level_kind kind, enum quantity quantity,
                                uint64_t *seed)
{
	const int at = (int)(any_number(seed) * ROW * ROW);
	const struct vec3 p = g->p[at], n = g->n[at], away = direction(seed);
	struct level_field f = { .kind = kind,
		                 .quantity = quantity,
		                 .direction = direction(seed),
		                 .point = vec3_along(p, 3, away),
		                 .eye = vec3_along(p, 20, vec3_unit(vec3_along(away, 2, n))) };
	const struct vec3 d = vec3_unit(vec3_sub(p, f.eye));
	if (kind == LEVEL_HIGHLIGHT)
		f.direction.z *= 0.1;
	if (kind == LEVEL_SILHOUETTE)
		f.direction = vec3_cross(n, away);
	if (kind == LEVEL_EYE)
		f.eye = vec3_along(p, 30, vec3_unit(vec3_cross(n, away)));
	if (kind == LEVEL_REFLECTION)
		f.point = vec3_along(p, 12, vec3_along(d, -2 * vec3_dot(n, d), n));
	if (kind != LEVEL_SILHOUETTE && kind != LEVEL_EYE && kind != LEVEL_REFLECTION)
		f.value = node(g, &f, at);
	return f;
}

static size_t pieces_moved(const struct grid *g, double by)
{
	for (int i = 0; i < ROW * ROW; i++)
		g->moved[i] = g->f[i] + by;
	return grid_pieces(g->moved, g->parent);
}

/* Pieces on the grid; SIZE_MAX where a level beside it has more or fewer. */
static size_t expected(const struct grid *g, const struct level_field *f)
{
	double lo = INFINITY, hi = -INFINITY;
	/* through a normal along the line all distances go */
	for (int i = 0; f->kind == LEVEL_HIGHLIGHT && i < ROW * ROW; i++)
		if (vec3_length(vec3_cross(g->n[i], vec3_unit(f->direction))) < 0.2)
			return SIZE_MAX;
	for (int i = 0; i < ROW * ROW; i++) {
		g->f[i] = node(g, f, i) - f->value;
		lo = fmin(lo, g->f[i]);
		hi = fmax(hi, g->f[i]);
	}
	const size_t n = pieces_moved(g, 0);
	const double by = apart * (hi - lo);
	return n == pieces_moved(g, by) && n == pieces_moved(g, -by) ? n : SIZE_MAX;
}

static const struct {
	enum level_kind kind;
	enum quantity quantity;
} kinds[] = {
	{ LEVEL_PLANE, 0 },
	{ LEVEL_CYLINDER, 0 },
	{ LEVEL_ISOPHOTE, 0 },
	{ LEVEL_SILHOUETTE, 0 },
	{ LEVEL_EYE, 0 },
	{ LEVEL_HIGHLIGHT, 0 },
	{ LEVEL_REFLECTION, 0 },
	{ LEVEL_CURVATURE, QUANTITY_GAUSSIAN },
	{ LEVEL_CURVATURE, QUANTITY_MEAN },
};
enum { N_KINDS = sizeof kinds / sizeof *kinds };

static const struct {
	int order[2], n[2];
	bool rational;
	enum shape_knots knots;
	uint64_t seed;
} cases[] = {
	{ { 4, 4 }, { 6, 7 }, false, KNOTS_CLAMPED, 1 },
	{ { 4, 5 }, { 7, 6 }, true, KNOTS_UNEVEN, 2 },
	{ { 3, 3 }, { 5, 6 }, true, KNOTS_CLAMPED, 3 },
	{ { 4, 4 }, { 8, 8 }, false, KNOTS_DOUBLE, 4 },
	{ { 4, 5 }, { 7, 8 }, true, KNOTS_DOUBLE, 5 },
	{ { 3, 4 }, { 7, 6 }, false, KNOTS_OPEN, 6 },
};

static void test_sweep(void **state)
{
	(void)state;
	struct grid g;
	size_t counted = 0, all = 0;
	grid_init(&g);
	for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
		uint64_t seed = cases[c].seed;
		struct surface s = shape_surface(cases[c].order, cases[c].n, cases[c].rational,
		                                 cases[c].knots, cases[c].seed);
		/* where second derivatives jump curvatures do */
		const bool curvatures = cases[c].knots != KNOTS_DOUBLE && cases[c].order[0] > 3 &&
		                        cases[c].order[1] > 3;
		grid_sample(&g, &s, curvatures);
		for (int k = 0; k < N_KINDS; k++) {
			if (kinds[k].kind == LEVEL_CURVATURE && !curvatures)
				continue;
			const struct level_field f =
			        field(&g, kinds[k].kind, kinds[k].quantity, &seed);
			const size_t n = expected(&g, &f);
			struct level *l;
			struct level_result x;
			all++;
			if (n == SIZE_MAX)
				continue;
			counted++;
			assert_int_equal(level_create(&l, &s, &f, 1e-4, NULL), ST_OK);
			assert_int_equal(shape_trace_level(l, &x, NULL), ST_OK);
			level_destroy(l);
			if (x.n_branches != n || x.n_undecided)
				print_error("case %zu, kind %d: %zu pieces, on the grid %zu, %zu "
				            "undecided\n",
				            c, k, x.n_branches, n, x.n_undecided);
			assert_int_equal(x.n_branches, n);
			assert_int_equal(x.n_undecided, 0);
			level_result_finish(&x);
		}
		surface_finish(&s);
	}
	grid_finish(&g);
	assert_true(counted > 20);
}

/* Gaussian curvature with weights far apart: as on the grid, or said to be undecided. */
static void test_weights(void **state)
{
	(void)state;
	static const double ratio[] = { 100, 1000, 10000 };
	struct grid g;
	size_t sure = 0;
	grid_init(&g);
	for (int i = 0; i < 3; i++)
		for (uint64_t c = 3; c < (i < 2 ? 6 : 5); c++) {
			uint64_t seed = c;
			struct surface s =
			        shape_surface((const int[2]){ 4, 4 }, (const int[2]){ 5, 5 }, true,
			                      KNOTS_CLAMPED, c);
			for (int k = 0; k < 25; k++)
				surface_set_point(&s, k / 5, k % 5,
				                  surface_get_point(&s, k / 5, k % 5, NULL),
				                  pow(ratio[i], any_number(&seed) - 0.5));
			grid_sample(&g, &s, true);
			const struct level_field f = { .kind = LEVEL_CURVATURE,
				                       .quantity = QUANTITY_GAUSSIAN,
				                       .value = 0.05 };
			struct level *l;
			struct level_result x;
			for (int k = 0; k < ROW * ROW; k++)
				g.f[k] = node(&g, &f, k) - f.value;
			const size_t n = pieces_moved(&g, 0);
			assert_int_equal(level_create(&l, &s, &f, 1e-4, NULL), ST_OK);
			assert_int_equal(shape_trace_level(l, &x, NULL), ST_OK);
			level_destroy(l);
			assert_true(x.n_branches == n || x.n_undecided > 0);
			sure += x.n_branches == n && x.n_undecided == 0;
			level_result_finish(&x);
			surface_finish(&s);
		}
	grid_finish(&g);
	assert_true(sure >= 5);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_sweep),
		cmocka_unit_test(test_weights),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
