/* test_level_umbilic.c - umbilics: where formulas have them, as on grids, in other forms; curves that pass one. */
#include "arbitrary.h"
#include "level_check.h"

static void trace(const struct surface *s, enum quantity quantity, double value,
                  struct level_result *x)
{
	const struct level_field f = { .kind = LEVEL_CURVATURE,
		                       .quantity = quantity,
		                       .value = value };
	struct level *l;
	assert_int_equal(level_create(&l, s, &f, 1e-5, NULL), ST_OK);
	assert_int_equal(shape_trace_level(l, x, NULL), ST_OK);
	level_destroy(l);
}

static struct surface stretched_ball(double a, double b, double c)
{
	const double stretch[3][4] = { { a / 2.5, 0, 0, 0 },
		                       { 0, b / 2.5, 0, 0 },
		                       { 0, 0, c / 2.5, 0 } };
	struct surface s = sphere();
	surface_transform(&s, stretch);
	return s;
}

/* Half axes 3, 2, 1: x^2 = a^2 (a^2 - b^2) / (a^2 - c^2), z^2 = c^2 (b^2 - c^2) / (a^2 - c^2), kmax = kmin =
 * -a c / b^3. Two of the four lie on the seam. */
static struct surface ellipsoid(void)
{
	return stretched_ball(3, 2, 1);
}

/* The graph of the sum of c[p][q] x^p y^q over a rectangle, bicubic, of spans x spans patches. */
static struct surface graph(const double c[4][4], const double x[2], const double y[2], int spans)
{
	struct surface s;
	const int n = 3 + spans;
	assert_int_equal(surface_init(&s, (int[2]){ 4, 4 }, (int[2]){ n, n }), ST_OK);
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < n + 4; i++)
			s.knots[d][i] = fmin(fmax((i - 3.0) / spans, 0), 1);
	for (int i = 0; i < n; i++)
		for (int j = 0; j < n; j++) {
			double e[2][4], z = 0; /* blossoms of 1, t, t^2, t^3 */
			for (int d = 0; d < 2; d++) {
				const double *k = s.knots[d] + (d ? j : i) + 1, *r = d ? y : x;
				const double a = in_range(r, k[0]), b = in_range(r, k[1]),
				             g = in_range(r, k[2]);
				e[d][0] = 1;
				e[d][1] = (a + b + g) / 3;
				e[d][2] = (a * b + b * g + g * a) / 3;
				e[d][3] = a * b * g;
			}
			for (int p = 0; p < 4; p++)
				for (int q = 0; q < 4; q++)
					z += c[p][q] * e[0][p] * e[1][q];
			surface_set_point(&s, i, j, vec3(e[0][1], e[1][1], z), 1);
		}
	assert_int_equal(surface_check(&s, "graph", NULL), ST_OK);
	return s;
}

static struct surface monkey(void) /* z = x^3 - 3 x y^2 */
{
	const double c[4][4] = { [3][0] = 1, [1][2] = -3 };
	return graph(c, (double[2]){ -1, 1.3 }, (double[2]){ -1.2, 1 }, 1);
}

static struct surface monkey_corner(void) /* its umbilic is the corner of four patches */
{
	const double c[4][4] = { [3][0] = 1, [1][2] = -3 };
	return graph(c, (double[2]){ -1, 1 }, (double[2]){ -1, 1 }, 2);
}

/* z = (x^2 / p + y^2 / q) / 2, p = 0.5 and q = 1: at x^2 = p (q - p), both 1 / (q W), W^2 = q / p */
static struct surface paraboloid(void)
{
	const double c[4][4] = { [2][0] = 1, [0][2] = 0.5 };
	return graph(c, (double[2]){ -1, 1 }, (double[2]){ -0.7, 1 }, 3);
}

/* z = x^2 / 2 + y^2 / 2 + 0.2 x^3: at the origin both are 1, with a slope of kmax and kmin that is larger than
 * their difference's: a lemon, through which a curve of either goes with a corner. */
static struct surface leaning(void)
{
	const double c[4][4] = { [2][0] = 0.5, [0][2] = 0.5, [3][0] = 0.2, [1][2] = 0.15 };
	return graph(c, (double[2]){ -0.3, 0.35 }, (double[2]){ -0.3, 0.4 }, 1);
}

/* `ends`: of curves of kmax and of kmin that have the umbilics' value. */
static const struct {
	struct surface (*make)(void);
	int n, halves, ends[2];
	double curvature, at[3]; /* |x|, |y|, |z| */
} forms[] = {
	{ ellipsoid, 4, 1, { 2, 2 }, -3.0 / 8, { 2.3717082451262845, 0, 0.61237243569579452 } },
	{ monkey, 1, -1, { 0, 0 }, 0, { 0, 0, 0 } },
	{ monkey_corner, 1, -1, { 0, 0 }, 0, { 0, 0, 0 } },
	{ paraboloid, 2, 1, { 2, 2 }, 0.70710678118654757, { 0.5, 0, 0.25 } },
	{ leaning, 1, 1, { 2, 2 }, 1, { 0, 0, 0 } },
};

static void test_forms(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
		struct surface s = forms[i].make();
		for (int q = 0; q < 2; q++) {
			struct level_result x;
			trace(&s, q ? QUANTITY_KMIN : QUANTITY_KMAX, forms[i].curvature, &x);
			assert_int_equal(x.n_umbilics, forms[i].n);
			for (size_t k = 0; k < x.n_umbilics; k++) {
				const struct level_umbilic *u = &x.umbilics[k];
				const struct vec3 p = surface_point(&s, u->at[0], u->at[1]);
				const double *at = forms[i].at;
				assert_int_equal(u->kind, LEVEL_UMBILIC_POINT);
				assert_int_equal(u->halves, forms[i].halves);
				assert_true(fabs(u->curvature - forms[i].curvature) < 1e-9);
				assert_true(distance(vec3(fabs(p.x), fabs(p.y), fabs(p.z)),
				                     vec3(at[0], at[1], at[2])) < 1e-9);
			}
			/* each is a mark of the curves of its value, and nothing else is */
			size_t named = 0;
			for (size_t k = 0; k < x.n_undecided; k++) {
				named += x.undecided[k].kind == LEVEL_UMBILIC;
				if (x.undecided[k].kind == LEVEL_UMBILIC)
					assert_int_equal(x.undecided[k].ends, forms[i].ends[q]);
			}
			assert_int_equal(named, forms[i].n);
			level_result_finish(&x);
		}
		surface_finish(&s);
	}
}

static struct surface spheroid(void)
{
	return stretched_ball(2.5, 2.5, 1);
}

static struct surface bowl(void) /* of revolution, its lowest point inside: a double one */
{
	const double c[4][4] = { [2][0] = 0.5, [0][2] = 0.5 };
	return graph(c, (double[2]){ -1, 1 }, (double[2]){ -1, 1 }, 1);
}

static const struct {
	struct surface (*make)(void);
	size_t n[N_LEVEL_UMBILIC_KINDS];
} others[] = {
	{ sphere, { 0, 1, 0 } }, { flat, { 0, 1, 0 } },     { cylinder, { 0, 0, 0 } },
	{ torus, { 0, 0, 0 } },  { spheroid, { 2, 0, 0 } }, /* its poles */
	{ bowl, { 0, 0, 1 } },
};

static void test_others(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
		struct surface s = others[i].make();
		struct level_result x;
		size_t n[N_LEVEL_UMBILIC_KINDS] = { 0 };
		trace(&s, QUANTITY_KMAX, 10, &x);
		assert_int_equal(x.n_branches + x.n_undecided, 0);
		for (size_t k = 0; k < x.n_umbilics; k++)
			n[x.umbilics[k].kind]++;
		assert_memory_equal(n, others[i].n, sizeof n);
		level_result_finish(&x);
		surface_finish(&s);
	}
}

/* (a, b) = (E M - F L, E N - G L) of the kernel's own derivatives. */
static void minors(const struct surface *s, double u, double v, double out[2])
{
	struct surface_shape x;
	surface_shape(s, u, v, &x);
	const double e = vec3_dot(x.du, x.du), f = vec3_dot(x.du, x.dv), g = vec3_dot(x.dv, x.dv);
	const double l = vec3_dot(x.duu, x.normal), m = vec3_dot(x.duv, x.normal),
	             n = vec3_dot(x.dvv, x.normal);
	out[0] = e * m - f * l;
	out[1] = e * n - g * l;
}

enum { CELLS = 60, STEPS = 12 };

/* How often (a, b) goes round zero along the border of a rectangle. */
static int turns(const struct surface *s, const double lo[2], const double hi[2])
{
	double sum = 0, from[2], to[2];
	minors(s, lo[0], lo[1], from);
	for (int k = 1; k <= 4 * STEPS; k++) {
		const double t = (double)(k % STEPS) / STEPS;
		const int side = k / STEPS % 4;
		const double x[4] = { t, 1, 1 - t, 0 }, y[4] = { 0, t, 1, 1 - t };
		minors(s, lo[0] + (hi[0] - lo[0]) * x[side], lo[1] + (hi[1] - lo[1]) * y[side], to);
		sum += atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
		memcpy(from, to, sizeof from);
	}
	return (int)lround(sum / (2 * pi));
}

static const struct {
	int order[2], n[2];
	bool rational;
	enum shape_knots knots;
	uint64_t seed;
} cases[] = {
	{ { 4, 4 }, { 6, 6 }, false, KNOTS_CLAMPED, 1 },
	{ { 4, 5 }, { 6, 6 }, true, KNOTS_UNEVEN, 2 },
	{ { 5, 4 }, { 5, 5 }, true, KNOTS_CLAMPED, 3 },
	{ { 6, 3 }, { 6, 3 }, false, KNOTS_CLAMPED, 4 },
	{ { 4, 4 }, { 7, 6 }, false, KNOTS_OPEN, 5 },
};
enum { N_CASES = sizeof cases / sizeof *cases };

static struct surface any(size_t i)
{
	return shape_surface(cases[i].order, cases[i].n, cases[i].rational, cases[i].knots,
	                     cases[i].seed);
}

/* In each cell of a grid the sum of what is found is the number of turns round it. */
static void test_grid(void **state)
{
	(void)state;
	size_t found = 0;
	for (size_t i = 0; i < N_CASES; i++) {
		struct surface s = any(i);
		struct level_result x;
		trace(&s, QUANTITY_KMIN, 1e3, &x);
		found += x.n_umbilics;
		for (int c = 0; c < CELLS * CELLS; c++) {
			const double lo[2] = { in_range(s.domain[0], (double)(c / CELLS) / CELLS),
				               in_range(s.domain[1], (double)(c % CELLS) / CELLS) };
			const double hi[2] = { in_range(s.domain[0], (c / CELLS + 1.0) / CELLS),
				               in_range(s.domain[1], (c % CELLS + 1.0) / CELLS) };
			int sum = 0;
			for (size_t k = 0; k < x.n_umbilics; k++) {
				const double *at = x.umbilics[k].at;
				assert_int_equal(x.umbilics[k].kind, LEVEL_UMBILIC_POINT);
				if (at[0] >= lo[0] && at[0] < hi[0] && at[1] >= lo[1] &&
				    at[1] < hi[1])
					sum += x.umbilics[k].halves;
			}
			const int expected = turns(&s, lo, hi);
			if (sum != expected)
				print_error("case %zu, cell %d: %d halves, on the grid %d\n", i, c,
				            sum, expected);
			assert_int_equal(sum, expected);
		}
		level_result_finish(&x);
		surface_finish(&s);
	}
	assert_true(found > 20);
}

/* The same points of space, with the same index: exchanged parameters turn both the directions and the way round. */
static void assert_same_points(const struct surface *s, const struct level_result *x,
                               const struct surface *r)
{
	struct level_result y;
	trace(r, QUANTITY_KMAX, 1e3, &y);
	assert_int_equal(y.n_umbilics, x->n_umbilics);
	for (size_t i = 0; i < x->n_umbilics; i++) {
		const struct level_umbilic *a = &x->umbilics[i];
		const struct vec3 p = surface_point(s, a->at[0], a->at[1]);
		bool there = false;
		for (size_t k = 0; k < y.n_umbilics && !there; k++) {
			const struct level_umbilic *b = &y.umbilics[k];
			there = distance(p, surface_point(r, b->at[0], b->at[1])) < 1e-7 &&
			        b->kind == a->kind && b->halves == a->halves &&
			        fabs(fabs(a->curvature) - fabs(b->curvature)) < 1e-6;
		}
		assert_true(there);
	}
	level_result_finish(&y);
}

static void test_laws(void **state)
{
	(void)state;
	for (size_t i = 0; i < N_CASES; i++) {
		struct surface s = any(i), r;
		struct level_result x;
		uint64_t seed = i + 1;
		double knots[4];
		trace(&s, QUANTITY_KMAX, 1e3, &x);
		const double *at = x.umbilics[x.n_umbilics / 2].at;
		/* a line through one of them, too */
		knots[0] = at[0];
		assert_int_equal(surface_insert(&r, &s, 0, knots, 1), ST_OK);
		assert_same_points(&s, &x, &r);
		surface_finish(&r);
		for (int k = 0; k < 3; k++)
			knots[k] = in_range(s.domain[1], 0.3 * (k + any_number(&seed)));
		knots[3] = fmax(at[1], knots[2]);
		assert_int_equal(surface_insert(&r, &s, 1, knots, 4), ST_OK);
		assert_same_points(&s, &x, &r);
		surface_finish(&r);
		assert_int_equal(surface_elevate(&r, &s, i % 2, 1), ST_OK);
		assert_same_points(&s, &x, &r);
		assert_int_equal(surface_exchange(&r), ST_OK);
		assert_same_points(&s, &x, &r);
		surface_finish(&r);
		level_result_finish(&x);
		surface_finish(&s);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_forms),
		cmocka_unit_test(test_others),
		cmocka_unit_test(test_grid),
		cmocka_unit_test(test_laws),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
