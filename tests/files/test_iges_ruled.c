/* test_iges_ruled.c - ruled surfaces of IGES: how they run, and what is said of it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "iges_made.h"

#define STRAIGHT "110,0.,0.,0.,2.,0.,0.;"
#define ARC90    "100,1.,0.,0.,2.,0.,0.,2.;" /* z = 1, radius 2 */
#define WIDER90  "100,3.,0.,0.,4.,0.,0.,4.;" /* z = 3, radius 4 */

/* 118: points of v = 0 and v = 1 at u, and what is said. Form 0 by relative arc length; form 1 by
 * parameters, which of an arc are its angle. */
static void ruled_surfaces_run_as_the_standard_has_it(void **state)
{
	static const double turned = M_PI / 2 * 0.7, fifteen = M_PI / 12, half = M_PI / 4;
	/* 0.3 and 0.7 of the line; 0.3 of the arc, which goes down from 90 degrees, by its angle */
	const struct vec3 line3 = { 0.6, 0, 0 }, line7 = { 1.4, 0, 0 },
	                  arc3 = { 2 * sin(turned), 2 * cos(turned), 1 };
	const struct vec3 inner = { 2 * sin(half), 2 * cos(half), 1 },
	                  outer = { 4 * sin(half), 4 * cos(half), 3 };
	const struct {
		int form, turn;
		const char *a, *b;
		double u;
		struct vec3 p, q;
		bool rational, said;
	} rows[] = {
		{ 0, 0, STRAIGHT, HASTY, 0.5, { 1, 0, 0 }, { 1, 1, 0 }, false, true },
		{ 0, 1, STRAIGHT, HASTY, 0.25, { 0.5, 0, 0 }, { 1.5, 1, 0 }, false, true },
		{ 1, 0, STRAIGHT, HASTY, 0.5, { 1, 0, 0 }, { 0.5, 1, 0 }, false, false },
		{ 0, 0, STRAIGHT, ARC90, 0.3, line3, arc3, false, true },
		{ 1, 0, STRAIGHT, ARC90, 0.3, line3, arc3, false, true },
		{ 1, 1, STRAIGHT, ARC90, 0.7, line7, arc3, false, true },
		/* arcs of one angle: exact, and u their NURBS parameter */
		{ 0, 0, ARC90, WIDER90, 0.5, inner, outer, true, false },
		{ 1, 0, ARC90, WIDER90, 0.5, inner, outer, true, false },
		/* arcs from 90 by 270, and from 30 back by 30 degrees */
		{ 1,
		  1,
		  "100,0.,0.,0.,0.,1.,1.,0.;",
		  "100,0.,0.,0.,1.,0.,.8660254037844387,.5;",
		  0.5,
		  { cos(5 * half), sin(5 * half), 0 },
		  { cos(fifteen), sin(fifteen), 0 },
		  false,
		  true },
		/* a branch of a hyperbola by its angle, 60 degrees of it */
		{ 1,
		  0,
		  "110,0.,0.,0.,1.,0.,0.;",
		  "104,1.,0.,-1.,0.,0.,-1.,0.,1.,0.,2.,1.7320508075688772;",
		  0.25,
		  { 0.25, 0, 0 },
		  { 1 / cos(fifteen), tan(fifteen), 0 },
		  false,
		  true },
		/* two straight splines alike in their haste: exact in form 0 */
		{ 0, 0, HASTY, HASTY, 0.5, { 0.5, 1, 0 }, { 0.5, 1, 0 }, false, false },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		char parameters[32];
		snprintf(parameters, sizeof parameters, "118,3,5,%d,0;", rows[i].turn);
		const struct made_entity entities[MADE_MAX] = { { 118, rows[i].form, parameters },
			                                        { atoi(rows[i].a), 0, rows[i].a },
			                                        { atoi(rows[i].b), 0, rows[i].b } };
		const struct made_file f = { 0 };
		struct model m;
		struct report_store store;
		struct entity *e;
		if (read_made(&m, &f, entities, &store) != ST_OK)
			fail_msg("row %zu: %s", i, store.error);
		if (model_find(&m, "D1", &e, NULL) != ST_OK)
			fail_msg("row %zu: %s", i, m.skipped[0].reason);
		double within = rows[i].said ? 5e-6 : 1e-14;
		struct vec3 p = surface_point(&e->geometry, rows[i].u, 0);
		struct vec3 q = surface_point(&e->geometry, rows[i].u, 1);
		if (!(vec3_length(vec3_sub(p, rows[i].p)) <= within) ||
		    !(vec3_length(vec3_sub(q, rows[i].q)) <= within))
			fail_msg("row %zu: %.9g %.9g %.9g and %.9g %.9g %.9g", i, p.x, p.y, p.z,
			         q.x, q.y, q.z);
		assert_int_equal(e->geometry.rational, rows[i].rational);
		assert_int_equal(m.n_warnings, rows[i].said);
		if (rows[i].said)
			assert_non_null(strstr(m.warnings[0], "approximated"));
		model_finish(&m);
	}
}

/* Every point, by the angle, not at one place only; the error said is what is reached. */
static void ruled_surfaces_say_their_error(void **state)
{
	static const struct made_entity entities[MADE_MAX] = { { 118, 0, "118,3,5,0,0;" },
		                                               { 110, 0, STRAIGHT },
		                                               { 100, 0, ARC90 } };
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	struct entity *e;
	double worst = 0, said = 0;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(model_find(&m, "D1", &e, NULL), ST_OK);
	for (int i = 0; i <= 1000; i++) {
		double u = i / 1000.0, angle = M_PI / 2 * u;
		struct vec3 q = surface_point(&e->geometry, u, 1);
		worst = fmax(worst,
		             vec3_length(vec3_sub(q, vec3(2 * cos(angle), 2 * sin(angle), 1))));
	}
	assert_int_equal(m.n_warnings, 1);
	const char *number = strstr(m.warnings[0], "to within ");
	assert_non_null(number);
	said = strtod(number + strlen("to within "), NULL);
	if (!(said > 0 && said < 4e-6 && worst <= 1.05 * said))
		fail_msg("%g reached, %g said", worst, said);
	model_finish(&m);
}

/* Arc lengths are dear: a small file that wants those of two curves over and over is not given all. */
static void lengths_are_not_measured_for_ever(void **state)
{
	enum { SURFACES = 800 };
	static struct made_entity entities[SURFACES + 2];
	static const char curve[] =
	        "126,25,25,0,0,1,0,"
	        "0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,"
	        "1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,"
	        "1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,";
	char with_points[2048];
	struct text t = { 0 };
	struct model m;
	(void)state;
	int n = snprintf(with_points, sizeof with_points, "%s", curve);
	for (int i = 0; i < 26; i++)
		n += snprintf(with_points + n, sizeof with_points - (size_t)n, "%d.,0.,1.,", i);
	snprintf(with_points + n, sizeof with_points - (size_t)n, "0.,1.,0.,0.,1.;");
	entities[0] = (struct made_entity){ .type = 126, .parameters = with_points };
	entities[1] = (struct made_entity){ .type = 110, .parameters = STRAIGHT };
	for (int i = 0; i < SURFACES; i++)
		entities[i + 2] = (struct made_entity){ .type = 118, .parameters = "118,1,3,0,0;" };
	make_iges(&t, &(struct made_file){ 0 }, entities, SURFACES + 2);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", NULL, NULL), ST_OK);
	assert_true(m.n > 100);
	assert_int_equal(m.n_skipped, 1);
	assert_int_equal(m.n + m.skipped[0].count, SURFACES + 2);
	assert_string_equal(m.skipped[0].reason,
	                    "it and others refer to each other too many times");
	model_finish(&m);
	text_finish(&t);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(ruled_surfaces_run_as_the_standard_has_it),
		cmocka_unit_test(ruled_surfaces_say_their_error),
		cmocka_unit_test(lengths_are_not_measured_for_ever),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
