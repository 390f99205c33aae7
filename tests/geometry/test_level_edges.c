/* test_level_edges.c - curves over knot lines: creases, rounded files, slivers. */
#include "arbitrary.h"
#include "level_check.h"

/* A fold along u = 0.5: planes go over it, isophotes end on it. */
static void test_crease(void **state)
{
	(void)state;
	struct surface s, r;
	struct level_result x;
	int on_crease = 0;
	assert_int_equal(shape_make(&s, 4, 14, shape_wavy), ST_OK);
	r = stretched(&s, 1.0);
	double at = surface_point(&r, 0.5, 0.2).x;
	for (int i = 0; i < r.n[0]; i++)
		for (int j = 0; j < r.n[1]; j++) {
			struct vec3 p = surface_get_point(&r, i, j, NULL);
			if (p.x > at)
				p.z += 0.5 * (p.x - at);
			surface_set_point(&r, i, j, p, 1);
		}
	struct count c = count_of(&r, LEVEL_PLANE, vec3(0, 1, 0), 4.1);
	assert_int_equal(c.branches, 1);
	assert_int_equal(shape_trace(&r, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(40), 1e-5, &x, NULL),
	                 ST_OK);
	assert_int_equal(x.n_undecided, 0);
	for (size_t b = 0; b < x.n_branches; b++) {
		const struct curve *uv = &x.branches[b].uv;
		for (int e = 0; e < 2; e++) {
			double u = curve_get_point(uv, e ? uv->n - 1 : 0, NULL).x;
			on_crease += !x.branches[b].closed && u == 0.5;
		}
		/* no piece goes over it */
		double first = curve_point(uv, 0.37 * uv->domain[1]).x;
		for (int k = 0; k < 100; k++)
			assert_true((curve_point(uv, uv->domain[1] * (k + 0.5) / 100).x > 0.5) ==
			            (first > 0.5));
	}
	assert_true(on_crease >= 4);
	level_result_finish(&x);
	surface_finish(&r);
	surface_finish(&s);
}

/* A fold whose angle fades out along it: pieces end on it where there is an angle, and go over it
 * where there is none. */
static void test_fading_crease(void **state)
{
	(void)state;
	struct surface s, r;
	int ends = 0, over = 0;
	assert_int_equal(shape_make(&s, 4, 14, shape_wavy), ST_OK);
	r = stretched(&s, 1.0);
	double at = surface_point(&r, 0.5, 0.2).x;
	for (int i = 0; i < r.n[0]; i++)
		for (int j = 0; j < 6; j++) {
			struct vec3 p = surface_get_point(&r, i, j, NULL);
			if (p.x > at)
				p.z += 0.1 * (6 - j) * (p.x - at);
			surface_set_point(&r, i, j, p, 1);
		}
	for (int degrees = 20; degrees < 60; degrees += 5) {
		struct level_result x;
		assert_int_equal(shape_trace(&r, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(degrees),
		                             1e-5, &x, NULL),
		                 ST_OK);
		assert_int_equal(x.n_undecided, 0);
		assert_true(x.max_error <= 1e-5);
		for (size_t b = 0; b < x.n_branches; b++) {
			const struct curve *uv = &x.branches[b].uv;
			for (int e = 0; e < 2 && !x.branches[b].closed; e++) {
				struct vec3 p = curve_get_point(uv, e ? uv->n - 1 : 0, NULL);
				if (p.x != 0.5)
					continue;
				ends++;
				assert_true(p.y < 0.55); /* control points from 6 on are at peace */
			}
			for (int k = 0; k + 1 < 100; k++)
				over += (curve_point(uv, uv->domain[1] * k / 100).x > 0.5) !=
				        (curve_point(uv, uv->domain[1] * (k + 1) / 100).x > 0.5);
		}
		level_result_finish(&x);
	}
	assert_true(ends > 5);
	assert_true(over > 5);
	surface_finish(&r);
	surface_finish(&s);
}

/* What files do to surfaces: few digits, a span that is nothing but rounding. */
static void test_files(void **state)
{
	(void)state;
	const double sliver[2] = { 0.25 + 1e-13, 0.25 + 1e-13 };
	const struct vec3 d = { 1, 2, 3 };
	struct surface s = torus(), r, q;
	uint64_t seed = 3;
	assert_int_equal(surface_copy(&r, &s), ST_OK);
	for (int i = 0; i < r.n[0]; i++)
		for (int j = 0; j < r.n[1]; j++) {
			double w;
			struct vec3 p = surface_get_point(&r, i, j, &w), off;
			off = vec3(any_number(&seed), any_number(&seed), any_number(&seed));
			surface_set_point(&r, i, j, vec3_along(p, 4e-7, off), w);
		}
	assert_int_equal(surface_insert(&q, &s, 0, sliver, 2), ST_OK);
	for (int degrees = 20; degrees < 170; degrees += 15) {
		struct count c = count_of(&s, LEVEL_ISOPHOTE, d, cosine(degrees));
		assert_int_equal(c.branches, 2);
		assert_int_equal(c.closed, 2);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, cosine(degrees)));
		assert_same(c, count_of(&q, LEVEL_ISOPHOTE, d, cosine(degrees)));
	}
	surface_finish(&q);
	surface_finish(&r);
	surface_finish(&s);
}

/* Patches far narrower than the tolerance: the same curves, with bounds as good as rounding of f allows. */
static void slivers_keep_the_tolerance(void **state)
{
	(void)state;
	static const struct {
		enum level_kind kind;
		struct vec3 direction;
		double value;
		size_t branches, closed;
	} fields[] = { { LEVEL_PLANE, { 0, 0, 1 }, 0.3, 18, 18 },
		       { LEVEL_ISOPHOTE, { 0, 0, 1 }, 0.81915204428899178, 85, 61 },
		       { LEVEL_SILHOUETTE, { 0.8, 0.36, 0.48 }, 0, 12, 0 } };
	static const struct {
		double width, bound;
	} slivers[] = { { 1e-5, 1.01e-5 }, { 1e-6, 1.01e-5 }, { 1e-8, 3e-4 } };
	struct surface s = wavy();
	for (size_t k = 0; k < sizeof slivers / sizeof *slivers; k++) {
		const double knots[2] = { 0.511, 0.511 + slivers[k].width };
		struct surface cut;
		assert_int_equal(surface_insert(&cut, &s, 0, knots, 2), ST_OK);
		for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
			struct level_result x;
			assert_int_equal(shape_trace(&cut, fields[i].kind, fields[i].direction,
			                             fields[i].value, 1e-5, &x, NULL),
			                 ST_OK);
			assert_int_equal(x.n_branches, fields[i].branches);
			assert_int_equal(x.n_closed, fields[i].closed);
			assert_int_equal(x.n_undecided, 0);
			assert_true(x.max_error <= slivers[k].bound);
			level_result_finish(&x);
		}
		surface_finish(&cut);
	}
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_crease),
		cmocka_unit_test(test_fading_crease),
		cmocka_unit_test(test_files),
		cmocka_unit_test(slivers_keep_the_tolerance),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
