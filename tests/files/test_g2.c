/* test_g2.c - .g2 files: splines both ways, what is skipped, what is said of faults. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "g2.h"
#include "survive.h"

static enum status parse(struct model *m, const char *text, size_t n, struct report_store *store)
{
	report_store_init(store);
	model_init(m);
	return g2_parse(m, text, n, "a.g2", NULL, &store->report);
}

/* A biquadratic patch, linear in v: u runs fastest in the file. */
static const char patch[] = "200 1 0 4 255 0 51 255\n3 0\n3 3\n0 0 0 1 1 1\n2 2\n0 0 2 2\n"
                            "0 0 0\n1 0 1\n2 0 0\n0 3 0\n1 3 1\n2 3 0\n\n";
static const char arc[] = "100 1 0 0\n2 1\n3 3\n0 0 0 1 1 1\n1 0 1\n1 1 1\n0 2 2\n";

static void a_surface_is_read(void **state)
{
	(void)state;
	struct model m;
	struct report_store store;
	assert_true(g2_recognise(patch, sizeof patch - 1));
	assert_int_equal(parse(&m, patch, sizeof patch - 1, &store), ST_OK);
	assert_int_equal(m.n, 1);
	const struct entity *e = &m.entities[0];
	assert_int_equal(e->kind, ENTITY_SURFACE);
	assert_int_equal(e->number, 1);
	assert_true(e->has_color && e->color[0] == 1 && e->color[1] == 0 && e->color[2] == 0.2f);
	assert_int_equal(e->geometry.n[0], 3);
	assert_int_equal(e->geometry.order[1], 2);
	assert_true(e->geometry.domain[1][1] == 2 && !e->geometry.rational);
	struct vec3 p = surface_point(&e->geometry, 0.5, 2);
	assert_true(p.x == 1 && p.y == 3 && p.z == 0.5);
	model_finish(&m);
}

/* Homogeneous coefficients: the quarter circle keeps its radius; 2 dimensions mean z = 0. */
static void a_rational_curve_is_read(void **state)
{
	(void)state;
	struct model m;
	struct report_store store;
	assert_int_equal(parse(&m, arc, sizeof arc - 1, &store), ST_OK);
	for (int k = 0; k <= 8; k++) {
		struct vec3 p = curve_point(&m.entities[0].curve, k / 8.0);
		assert_true(fabs(p.x * p.x + p.y * p.y - 1) < 1e-15 && p.z == 0);
	}
	model_finish(&m);
}

static void what_is_not_read_is_named(void **state)
{
	(void)state;
	struct model m;
	struct report_store store;
	struct text t = { 0 };
	text_add(&t, "250 1 0 0\n3\n0 0 0\n0 0 1\n1 0 0\n0\n0\n\n");
	text_add(&t, "292 1 0 0\n3\n0 0 0\n1\n0 0 1\n1 0 0\n0\n0 1 0 6.28\n0\n");
	text_add(&t, arc);
	text_add(&t, "250 1 0 0\n3\n0 0 0\n0 0 1\n1 0 0\n0\n0\n");
	/* knots that fall cost this curve alone */
	text_add(&t, "100 1 0 0\n3 0\n2 2\n0 0 1 -1\n0 0 0\n1 1 1\n");
	text_add(&t, "400 1 0 0\n2\n1 2 3\n4 5 6\n");
	assert_int_equal(parse(&m, t.s, t.n, &store), ST_OK);
	assert_int_equal(m.n, 2);
	assert_int_equal(m.entities[0].kind, ENTITY_CURVE);
	assert_int_equal(m.entities[1].kind, ENTITY_POINTS);
	assert_true(m.entities[1].points.n == 2 && m.entities[1].points.values[5] == 6);
	assert_int_equal(m.n_skipped, 3);
	assert_true(m.skipped[0].type == 250 && m.skipped[0].count == 2);
	assert_non_null(strstr(m.skipped[0].reason, "Plane"));
	assert_int_equal(m.skipped[1].type, 292);
	assert_int_equal(m.skipped[2].type, 100);
	model_finish(&m);
	text_finish(&t);
}

static void faults_are_named(void **state)
{
	(void)state;
	static const struct {
		const char *text, *said;
	} rows[] = {
		{ "100 1 0 0\n3 0\n2 2\n0 0 1\n", "a.g2:5:1: found the end of the file" },
		{ "100 1 0 0\n3 0\n2 2\n0 0 1 1\n0 0 zero\n1 1 1\n", "a.g2:5:5: found 'zero'" },
		{ "100 1 0 0\n4 0\n", "a.g2:2:1: found '4', expected dimension" },
		{ "100 1 0 0\n3 0\n999999999 2\n0 0 1 1\n", "number of coefficients" },
		{ "200 1 0 0\n3 0\n2 2\n0 0 1 1\n99 2\n", "coefficients" },
		{ "100 1 0 0\n3 0\n2 2\n0 0 1 1\n0 0 0\n1 1 1\nhello\n",
		  "a.g2:7:1: found 'hello'" },
		{ "200 1 0 2000000000\n", "found '2000000000', expected number of auxiliary" },
		{ "292 1 0 0\n3\n", "a Disc is not read" },
		{ "250 1 0 0\n3\n", "a Plane: its numbers describe nothing" },
		{ "250 1 0 0\n1.8e32\n0 0 1\n0 0 1\n1 0 0\n1\n0 2\n0 4\n0\n",
		  "a Plane: its numbers describe nothing" },
		{ "250 1 0 0\n3\n0 0 1\n0 0 1\n1 0 0\n2.2e23\n0 2\n0 4\n0\n",
		  "a Plane: its numbers describe nothing" },
		{ "250 1 0 0\n3\nabc\n", "found 'abc'" },
		{ "100 1 0 0\n3 0\n2 2\n0 0 1 -1\n0 0 0\n1 1 1\n", "the curve" },
	};
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct model m;
		struct report_store store;
		assert_int_equal(parse(&m, rows[i].text, strlen(rows[i].text), &store), ST_INPUT);
		if (!strstr(store.error, rows[i].said))
			fail_msg("'%s' in place of '%s'", store.error, rows[i].said);
		assert_int_equal(store.n_errors, 1);
		model_finish(&m);
	}
	assert_false(g2_recognise("100 1 0\n", 8));
	assert_false(g2_recognise("105 1 0 0\n", 10));
	assert_false(g2_recognise("1.5 2 3 4\n", 10));
}

/* Elementary classes by points of theirs: at what parameters, old and new dress, both directions. */
static void elementary_ones_become_splines(void **state)
{
	static const double h = 0.70710678118654752;
	static const struct {
		const char *text;
		double u, v;
		struct vec3 p;
	} rows[] = {
		{ "120 1 0 0\n3\n1 2 3\n0 0 2\n1\n-1 3\n0\n", 1, 0, { 1, 2, 5 } },
		{ "120 1 0 0\n3\n1 2 3\n0 0 2\n11\n-1 3\n0 1\n1\n", 0.25, 0, { 1, 2, 7 } },
		{ "120 1 0 0\n2\n1 2\n1 1\n1\n0 1\n", 0.5, 0, { 1.5, 2.5, 0 } },
		{ "130 1 0 0\n3\n2\n1 0 0\n0 0 3\n5 0 1\n0 6.2831853\n", M_PI / 2, 0, { 1, 2, 0 } },
		{ "130 1 0 0\n3\n2\n1 0 0\n0 0 1\n1 0 0\n0 3.14159265358979312\n11\n0 1\n",
		  0.25,
		  0,
		  { 1 - 2 * h, 2 * h, 0 } },
		{ "130 1 0 0\n2\n2\n1 0\n0 0\n0 1\n0 3.14159265358979312\n0\n",
		  M_PI / 2,
		  0,
		  { -1, 0, 0 } },
		{ "140 1 0 0\n3\n2\n1\n0 0 0\n0 0 1\n0 1 0\n0 3.14159265358979312\n0\n",
		  M_PI / 2,
		  0,
		  { -1, 0, 0 } },
		{ "250 1 0 0\n3\n0 0 1\n0 0 1\n1 0 0\n1\n0 2\n0 4\n0\n", 1, 3, { 1, 3, 1 } },
		{ "250 1 0 0\n3\n0 0 1\n0 0 1\n1 0 0\n11\n0 2\n0 4\n0 1\n0 1\n1\n",
		  0.75,
		  0.5,
		  { 1, 3, 1 } },
		{ "260 1 0 0\n3\n2\n0 0 0\n0 0 1\n1 0 0\n1\n0 6.28318530717958623\n-1 1\n0\n",
		  M_PI / 2,
		  0.5,
		  { 0, 2, 0.5 } },
		{ "270 1 0 0\n3\n2\n0 0 0\n0 0 1\n1 0 0\n0 6.28318530717958623\n"
		  "-1.57079632679489656 1.57079632679489656\n0\n",
		  M_PI,
		  0,
		  { -2, 0, 0 } },
		{ "280 1 0 0\n3\n2\n0 0 0\n0 0 1\n1 0 0\n0.78539816339744828\n1\n"
		  "0 6.28318530717958623\n-2 1\n0\n",
		  M_PI / 2,
		  1,
		  { 0, 3, 1 } },
		{ "290 1 0 0\n3\n5\n1\n0 0 0\n0 0 1\n1 0 0\n1\n0 6.28318530717958623\n"
		  "0 6.28318530717958623\n10\n0 1\n0 1\n",
		  0.25,
		  0.5,
		  { 0, 4, 0 } },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct model m;
		struct report_store store;
		struct text t = { 0 };
		text_addf(&t, "%s%s", rows[i].text, arc); /* what follows is found */
		if (parse(&m, t.s, t.n, &store) != ST_OK || m.n != 2)
			fail_msg("row %zu: %s", i, m.n_skipped ? m.skipped[0].reason : store.error);
		const struct entity *e = &m.entities[0];
		struct vec3 p = e->kind == ENTITY_CURVE
		                        ? curve_point(&e->curve, rows[i].u)
		                        : surface_point(&e->geometry, rows[i].u, rows[i].v);
		if (!(vec3_length(vec3_sub(p, rows[i].p)) <= 1e-14))
			fail_msg("row %zu: %.17g %.17g %.17g", i, p.x, p.y, p.z);
		model_finish(&m);
		text_finish(&t);
	}
}

/* On them to rounding, all over: the distance from what they are. */
static void elementary_ones_are_exact(void **state)
{
	static const char text[] = "260 1 0 0\n3\n2\n1 2 3\n0 0 1\n1 0 0\n1\n0.3 4\n-1 1\n0\n"
	                           "270 1 0 0\n3\n2\n1 2 3\n0 0 1\n1 0 0\n0 5\n-1 1.2\n0\n"
	                           "290 1 0 0\n3\n5\n2\n1 2 3\n0 0 1\n1 0 0\n1\n0 5\n0.5 6\n0\n";
	struct model m;
	struct report_store store;
	(void)state;
	assert_int_equal(parse(&m, text, sizeof text - 1, &store), ST_OK);
	assert_int_equal(m.n, 3);
	for (int k = 0; k < 3 * 400; k++) {
		const struct surface *s = &m.entities[k / 400].geometry;
		double u = k % 20 / 19.0, v = k / 20 % 20 / 19.0;
		struct vec3 p =
		        surface_point(s, s->domain[0][0] + u * (s->domain[0][1] - s->domain[0][0]),
		                      s->domain[1][0] + v * (s->domain[1][1] - s->domain[1][0]));
		double r = hypot(p.x - 1, p.y - 2), z = p.z - 3;
		double off = k < 400 ? r - 2 : k < 800 ? hypot(r, z) - 2 : hypot(r - 5, z) - 2;
		assert_true(fabs(off) < 1e-14);
	}
	model_finish(&m);
}

static void same_surface(const struct surface *a, const struct surface *b)
{
	for (int d = 0; d < 2; d++) {
		assert_int_equal(a->order[d], b->order[d]);
		assert_int_equal(a->n[d], b->n[d]);
		assert_memory_equal(a->knots[d], b->knots[d],
		                    sizeof(double) * (a->n[d] + a->order[d]));
	}
	assert_memory_equal(a->domain, b->domain, sizeof a->domain);
	assert_memory_equal(a->points, b->points, sizeof(double) * 4 * a->n[0] * a->n[1]);
}

static void written_is_read_to_the_bit(void **state)
{
	(void)state;
	struct model m, again;
	struct report_store store;
	struct text t = { 0 }, second = { 0 };
	struct entity e;
	model_init(&m);
	entity_init(&e, ENTITY_SURFACE);
	assert_int_equal(make_torus(&e.geometry, vec3(0.1, -1.0 / 3, 7), 3, 1.7), ST_OK);
	e.has_color = true;
	e.color[1] = 0.4f;
	assert_int_equal(model_add(&m, &e), ST_OK);
	entity_init(&e, ENTITY_CURVE);
	assert_int_equal(
	        make_arc(&e.curve, vec3(0, 0, 0.7), vec3(1, 0, 0), vec3(0, 1, 0), 0.3, 0.1, 4),
	        ST_OK);
	assert_int_equal(model_add(&m, &e), ST_OK);
	g2_format(&m, &t);
	assert_int_equal(parse(&again, t.s, t.n, &store), ST_OK);
	assert_int_equal(again.n, 2);
	same_surface(&m.entities[0].geometry, &again.entities[0].geometry);
	assert_true(again.entities[0].color[1] == 0.4f);
	assert_memory_equal(m.entities[1].curve.points, again.entities[1].curve.points,
	                    sizeof(double) * 4 * m.entities[1].curve.n);
	g2_format(&again, &second);
	assert_string_equal(t.s, second.s);
	model_finish(&again);
	model_finish(&m);
	text_finish(&t);
	text_finish(&second);
}

/* Of a domain that is a part of the knots', that part alone is written. */
static void a_part_is_written_as_such(void **state)
{
	(void)state;
	struct model m, again;
	struct report_store store;
	struct text t = { 0 };
	struct entity e;
	model_init(&m);
	entity_init(&e, ENTITY_SURFACE);
	assert_int_equal(make_sphere(&e.geometry, vec3(1, 2, 3), 2), ST_OK);
	e.geometry.domain[0][0] = 0.5;
	e.geometry.domain[1][1] = 1;
	assert_int_equal(model_add(&m, &e), ST_OK);
	g2_format(&m, &t);
	assert_int_equal(parse(&again, t.s, t.n, &store), ST_OK);
	const struct surface *a = &m.entities[0].geometry, *b = &again.entities[0].geometry;
	assert_memory_equal(a->domain, b->domain, sizeof a->domain);
	for (int i = 0; i <= 5; i++)
		for (int j = 0; j <= 5; j++) {
			double u = a->domain[0][0] + (a->domain[0][1] - a->domain[0][0]) * i / 5;
			double v = a->domain[1][0] + (a->domain[1][1] - a->domain[1][0]) * j / 5;
			struct vec3 p = surface_point(a, u, v), q = surface_point(b, u, v);
			assert_true(vec3_length(vec3_sub(p, q)) < 4e-15);
		}
	model_finish(&again);
	model_finish(&m);
	text_finish(&t);
}

static enum status read_damaged(struct model *m, const char *bytes, size_t n,
                                const struct report *r)
{
	g2_recognise(bytes, n);
	return g2_parse(m, bytes, n, "a.g2", NULL, r);
}

static void damaged_files_are_survived(void **state)
{
	(void)state;
	struct text t = { 0 };
	text_add(&t, patch);
	text_add(&t, arc);
	text_add(&t, "400 1 0 0\n2\n1 2 3\n4 5 6\n");
	survive(read_damaged, t.s, t.n, 3, 3000, 30, 300);
	text_finish(&t);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_surface_is_read),
		cmocka_unit_test(a_rational_curve_is_read),
		cmocka_unit_test(what_is_not_read_is_named),
		cmocka_unit_test(elementary_ones_become_splines),
		cmocka_unit_test(elementary_ones_are_exact),
		cmocka_unit_test(faults_are_named),
		cmocka_unit_test(written_is_read_to_the_bit),
		cmocka_unit_test(a_part_is_written_as_such),
		cmocka_unit_test(damaged_files_are_survived),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
