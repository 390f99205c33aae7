/* test_level_forms.c - every kind of field on weights far apart, any knots, and to tolerances in u,v. */
#include "arbitrary.h"
#include "level_check.h"
#include "level_grid.h"

/* What is zero along the curves, from the surface's own points and normals. */
static double field_value(const struct surface *s, const struct level_field *f, double u, double v)
{
	struct surface_shape x;
	surface_shape(s, u, v, &x);
	const struct vec3 l = vec3_unit(f->direction), away = vec3_sub(x.point, f->eye);
	struct vec3 c = vec3_sub(x.point, f->point), n = x.normal;
	switch (f->kind) {
	case LEVEL_PLANE:
		return vec3_dot(x.point, f->direction) - f->value;
	case LEVEL_ISOPHOTE:
		return vec3_dot(n, l) - f->value;
	case LEVEL_SILHOUETTE:
		return vec3_dot(n, l);
	case LEVEL_CYLINDER:
		return vec3_length(vec3_cross(c, l)) - f->value;
	case LEVEL_EYE:
		return vec3_dot(n, away);
	case LEVEL_CURVATURE:
		return x.value[f->quantity] - f->value;
	case LEVEL_REFLECTION:
		n = vec3_along(away, -2 * vec3_dot(away, n), n);
		return vec3_dot(vec3_cross(n, l), c);
	default:
		return vec3_dot(vec3_cross(n, l), c);
	}
}

static const struct {
	const char *name;
	struct level_field field;
} fields[] = {
	{ "plane", { .kind = LEVEL_PLANE, .direction = { 0.2, 0.1, 1 }, .value = 0.11 } },
	{ "isophote", { .kind = LEVEL_ISOPHOTE, .direction = { 0.1, 0.2, 1 }, .value = 0.8 } },
	{ "silhouette", { .kind = LEVEL_SILHOUETTE, .direction = { 1, 0.3, 0.2 } } },
	{ "cylinder",
	  { .kind = LEVEL_CYLINDER,
	    .direction = { 0, 1, 0.1 },
	    .point = { 0.4, 0, 0 },
	    .value = 0.33 } },
	{ "eye", { .kind = LEVEL_EYE, .eye = { 5, 4, 0.7 } } },
	{ "highlight",
	  { .kind = LEVEL_HIGHLIGHT, .direction = { 1, 0.2, 0.1 }, .point = { 0.5, 0.5, 4 } } },
	{ "reflection",
	  { .kind = LEVEL_REFLECTION,
	    .direction = { 1, 0.2, 0.1 },
	    .point = { 0.5, 0.5, 4 },
	    .eye = { 3, -4, 5 } } },
	{ "gaussian", { .kind = LEVEL_CURVATURE, .quantity = QUANTITY_GAUSSIAN, .value = 0.3 } },
	{ "mean", { .kind = LEVEL_CURVATURE, .quantity = QUANTITY_MEAN, .value = 0.33 } },
};
enum { N_FIELDS = sizeof fields / sizeof *fields };

static void trace(const struct surface *s, const struct level_field *f, double tolerance, double uv,
                  struct level_result *x)
{
	struct level *l;
	assert_int_equal(level_create(&l, s, f, tolerance, NULL), ST_OK);
	if (uv > 0)
		assert_int_equal(level_set_tolerance_uv(l, uv, NULL), ST_OK);
	assert_int_equal(shape_trace_level(l, x, NULL), ST_OK);
	level_destroy(l);
}

/* Heights over a square, gentle, with weights from 1 / 10^decades to 10^decades that change from point to
 * point. */
static struct surface weighted(enum shape_knots knots, double decades, uint64_t seed)
{
	const int order[2] = { 4, 4 }, n[2] = { 5, 6 }; /* curvature goes over knots */
	struct surface s = shape_surface(order, n, true, knots, seed);
	for (int i = 0; i < n[0]; i++)
		for (int j = 0; j < n[1]; j++) {
			const struct vec3 p = { i / 4.0, j / 5.0, 0.3 * any_number(&seed) };
			surface_set_point(&s, i, j, p,
			                  pow(10, decades * (2 * any_number(&seed) - 1)));
		}
	return s;
}

/* As many pieces as on a grid, on the curve, within the tolerance. */
static void test_weights(void **state)
{
	(void)state;
	double *f = malloc(sizeof *f * ROW * ROW);
	int *parent = malloc(sizeof *parent * EDGES);
	size_t found = 0;
	assert_true(f && parent);
	for (int k = 0; k < N_FIELDS; k++) {
		/* weights stand in curvatures to the twelfth power, too much for doubles */
		const double decades = fields[k].field.kind == LEVEL_CURVATURE ? 0.3 : 2;
		struct surface s =
		        weighted(k % 2 ? KNOTS_UNEVEN : KNOTS_OPEN, decades, 7 + (uint64_t)k);
		struct level_result x;
		for (int i = 0; i < ROW * ROW; i++)
			f[i] = field_value(&s, &fields[k].field,
			                   in_range(s.domain[0], (double)(i / ROW) / GRID),
			                   in_range(s.domain[1], (double)(i % ROW) / GRID));
		const size_t expected = grid_pieces(f, parent);
		trace(&s, &fields[k].field, 1e-5, 0, &x);
		if (x.n_branches != expected || x.n_undecided || !(x.max_error <= 2e-5))
			print_error("%s: %zu pieces, on the grid %zu, %zu undecided, error %g\n",
			            fields[k].name, x.n_branches, expected, x.n_undecided,
			            x.max_error);
		assert_int_equal(x.n_branches, expected);
		assert_int_equal(x.n_undecided, 0);
		assert_true(x.max_error <= 2e-5); /* the tolerance, and what rounding adds to it */
		found += x.n_branches;
		for (size_t b = 0; b < x.n_branches; b++)
			check_curves(&s, &x.branches[b]);
		level_result_finish(&x);
		surface_finish(&s);
	}
	assert_true(found > N_FIELDS);
	free(f);
	free(parent);
}

/* The tolerance in u,v is met, measured by f over its slope, though that in space asks for little. */
static void test_tolerance_uv(void **state)
{
	(void)state;
	const double tolerance = 1e-7, step = 1e-5;
	struct surface s = shape_surface((const int[2]){ 4, 4 }, (const int[2]){ 7, 7 }, false,
	                                 KNOTS_UNEVEN, 3);
	for (int k = 0; k < N_FIELDS; k++) {
		const struct level_field *f = &fields[k].field;
		struct level_result x, rough;
		trace(&s, f, 1e-2, tolerance, &x);
		trace(&s, f, 1e-2, 0, &rough);
		assert_int_equal(x.n_branches, rough.n_branches);
		assert_true(x.max_error_uv <= 1.1 * tolerance);
		assert_true(x.n_branches == 0 || rough.max_error_uv > 1.1 * tolerance);
		for (size_t b = 0; b < x.n_branches; b++)
			for (int i = 0; i < 100; i++) {
				const struct curve *c = &x.branches[b].uv;
				const struct vec3 p =
				        curve_point(c, c->domain[1] * (i + 0.37) / 100);
				double du = field_value(&s, f, p.x + step, p.y) -
				            field_value(&s, f, p.x - step, p.y);
				double dv = field_value(&s, f, p.x, p.y + step) -
				            field_value(&s, f, p.x, p.y - step);
				double off = fabs(field_value(&s, f, p.x, p.y)) * 2 * step /
				             hypot(du, dv);
				if (isfinite(off)) /* not beside the border */
					assert_true(off <= 1.2 * tolerance);
			}
		level_result_finish(&x);
		level_result_finish(&rough);
	}
	surface_finish(&s);
}

static void test_wrong_uv(void **state)
{
	(void)state;
	struct surface s = sphere();
	struct level *l;
	const double wrong[] = { 0, -1, NAN };
	assert_int_equal(level_create(&l, &s, &fields[0].field, 1e-5, NULL), ST_OK);
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
		assert_int_equal(level_set_tolerance_uv(l, wrong[i], NULL), ST_PARAMETER);
	level_destroy(l);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_weights),
		cmocka_unit_test(test_tolerance_uv),
		cmocka_unit_test(test_wrong_uv),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
