/* test_iges_places.c - surfaces that several faces share, instances, lone curves on surfaces. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "iges_made.h"

static void assert_area(const struct entity *e, double expected)
{
	double area, error;
	assert_int_equal(trim_area(&e->trim, &e->geometry, 1e-8, &area, &error), ST_OK);
	assert_true(fabs(area - expected) <= 2e-6 * expected);
}

/* A surface that two faces share comes twice; its number stays. */
static void shared_surfaces_keep_every_trim(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 128, 0, SQUARE },
		{ 144, 0, "144,1,1,0,7;" },
		{ 144, 0, "144,1,0,1,0,7;", 0, 0, NULL, "HOLE" },
		{ 142, 0, "142,0,1,9,0,1;" },
		{ 100, 0, DISK },
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
	};
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	struct entity *e;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(m.entities[0].faces->n, 2);
	assert_area(&m.entities[0], DISK_L);
	assert_int_equal(model_find(&m, "D5", &e, NULL), ST_OK);
	assert_int_equal(e->number, 3);
	assert_string_equal(e->name, "HOLE");
	assert_area(e, 1 - DISK_L);
	assert_int_equal(model_find(&m, "2", &e, NULL), ST_OK);
	assert_int_equal(e->de, 11);
	model_finish(&m);
}

/* A subfigure of a subfigure, placed twice: surfaces by the first instance in their own place. */
static void instances_show_subfigures(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 128, 0, SQUARE },
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 308, 0, "308,0,4Hpart,2,1,3;" },
		{ 408, 0, "408,5,1.,0.,0.,2.;" },
		{ 308, 0, "308,1,5Hwhole,1,13;" },
		{ 408, 0, "408,9,0.,0.,5.,1.;" },
		{ 402, 7, "402,1,7;" },
		{ 408, 0, "408,9,0.,0.,0.,;", 0 },
	};
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	struct entity *e;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(m.n_skipped, 0);
	assert_int_equal(m.n_warnings, 0);
	assert_int_equal(m.n, 5);
	assert_int_equal(model_find(&m, "1", &e, NULL), ST_OK);
	assert_point(0, surface_point(&e->geometry, 1, 1), vec3(3, 2, 5));
	assert_int_equal(m.entities[1].number, 0);
	assert_int_equal(m.entities[2].de, 15);
	assert_point(1, surface_point(&m.entities[2].geometry, 1, 1), vec3(3, 2, 0));
	assert_point(2, curve_point(&m.entities[3].curve, 1), vec3(3, 0, 5));
	assert_point(3, curve_point(&m.entities[4].curve, 1), vec3(3, 0, 0));
	model_finish(&m);
}

static void a_lone_curve_on_surface_is_one(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 142, 0, "142,0,3,0,5,2;" },
		{ 122, 0, "122,7,1.,0.,1.;" },
		{ 100, 0, "100,.5,0.,0.,1.,0.,0.,1.;" },
		{ 100, 0, "100,0.,0.,0.,1.,0.,0.,1.;" },
	};
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	const struct entity *e = &m.entities[m.n - 1];
	assert_int_equal(e->kind, ENTITY_CURVE_ON_SURFACE);
	assert_int_equal(e->number, 2);
	for (int i = 0; i <= 4; i++) {
		double t = e->space.domain[0] + (e->space.domain[1] - e->space.domain[0]) * i / 4;
		struct vec3 p = curve_point(&e->space, t);
		assert_true(fabs(hypot(p.x, p.y) - 1) < 1e-5 && fabs(p.z - 0.5) < 1e-5);
		assert_true(fabs(curve_point(&e->curve, t).y - 0.5) < 1e-5);
	}
	model_finish(&m);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(shared_surfaces_keep_every_trim),
		cmocka_unit_test(instances_show_subfigures),
		cmocka_unit_test(a_lone_curve_on_surface_is_one),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
