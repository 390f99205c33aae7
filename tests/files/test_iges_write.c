/* test_iges_write.c - what is written as IGES is read again. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "iges_made.h"

static void written_is_read_again(void **state)
{
	struct model a, b;
	struct report_store store;
	struct text t = { 0 };
	const struct made_file f = { .global = "1H,,1H;,,,,,,,,,,,.5,6,1HM;" };
	(void)state;
	assert_int_equal(read_made(&a, &f, standard, &store), ST_OK);
	free(a.entities[0].name);
	a.entities[0].name =
	        strdup("a name that is longer than a line of parameters; with, \"all\" "
	               "kinds of characters in it");
	a.entities[1].geometry.points[1] = -1.2345678901234567e-200;
	a.entities[1].geometry.points[2] = 1e22;
	iges_format(&a, &t);
	assert_false(t.failed);
	model_init(&b);
	assert_true(iges_recognise(t.s, t.n));
	if (iges_parse(&b, t.s, t.n, "y.igs", NULL, &store.report) != ST_OK)
		fail_msg("%s", store.error);
	assert_int_equal(b.n, 3);
	assert_int_equal(b.n_skipped, 0);
	assert_int_equal(b.entities[2].points.n, 1);
	assert_memory_equal(b.entities[2].points.values, a.entities[2].points.values,
	                    3 * sizeof(double));
	assert_string_equal(b.unit, "m");
	assert_true(b.scale == 0.5 && b.unit_in_mm == 1000);
	const struct curve *c = &a.entities[0].curve, *d = &b.entities[0].curve;
	assert_string_equal(b.entities[0].name, a.entities[0].name);
	assert_memory_equal(c->knots, d->knots, 6 * sizeof(double));
	assert_memory_equal(c->domain, d->domain, sizeof c->domain);
	for (int i = 0; i < 12; i++)
		assert_true(fabs(c->points[i] - d->points[i]) <= 1e-15 * fabs(c->points[i]));
	const struct surface *s = &a.entities[1].geometry, *r = &b.entities[1].geometry;
	assert_memory_equal(s->points, r->points, 16 * sizeof(double));
	assert_memory_equal(s->knots[0], r->knots[0], 4 * sizeof(double));
	assert_memory_equal(b.entities[1].color, a.entities[1].color, sizeof b.entities[1].color);
	for (const char *line = t.s; *line; line = strchr(line, '\n') + 1)
		assert_int_equal(strchr(line, '\n') - line, 80);
	model_finish(&a);
	model_finish(&b);
	text_finish(&t);
}

/* a as read, b as read of what is written of a. */
static void read_and_again(struct model *a, struct model *b, const struct made_entity *entities)
{
	const struct made_file f = { 0 };
	struct report_store store;
	struct text t = { 0 };
	assert_int_equal(read_made(a, &f, entities, &store), ST_OK);
	iges_format(a, &t);
	assert_false(t.failed);
	model_init(b);
	assert_int_equal(iges_parse(b, t.s, t.n, "y.igs", NULL, NULL), ST_OK);
	text_finish(&t);
}

/* Curves on a surface stay on it, with name, color and group; lists of points stay one. */
static void curves_on_surfaces_and_points_are_kept(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 142, 0, "142,0,3,5,0,1,0,1,9;", 0, 3 },
		{ 128, 0, SQUARE },
		{ 126, 0,
		  "126,2,2,0,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,.5,.25,0.,1.,1.,0.,0.,1.;" },
		{ 106, 2, "106,2,3,1.,2.,3.,.1,.2,.3,4.,5.,6.;", 0, 0, NULL, "OFFSETS" },
		{ 406, 15, "406,1,4Hknot;" },
		{ 402, 7, "402,2,1,7,0,1,13;" },
		{ 406, 15, "406,1,5Hlines;" },
	};
	struct model a, b;
	(void)state;
	read_and_again(&a, &b, entities);
	const struct model *both[] = { &a, &b };
	for (int i = 0; i < 2; i++) {
		const struct entity *last = &both[i]->entities[both[i]->n - 1], *points = last - 1;
		assert_int_equal(both[i]->n_skipped, 0);
		assert_int_equal(last->kind, ENTITY_CURVE_ON_SURFACE);
		assert_string_equal(last->name, "knot");
		assert_true(last->has_color && last->color[1] == 1);
		assert_string_equal(entity_get_attribute(last, "group"), "lines");
		assert_int_equal(both[i]->entities[last->surface].kind, ENTITY_SURFACE);
		assert_true(vec3_length(vec3_sub(curve_point(&last->curve, 0.5),
		                                 vec3(0.5, 0.375, 0))) < 1e-15);
		assert_true(vec3_length(vec3_sub(curve_point(&last->space, 0.5),
		                                 vec3(0.5, 0.375, 0))) < 1e-6);
		assert_int_equal(points->kind, ENTITY_POINTS);
		assert_string_equal(points->name, "OFFSETS");
		assert_int_equal(points->points.n, 3);
		assert_true(points->points.values[5] == 0.3 && points->points.values[7] == 5);
	}
	model_finish(&a);
	model_finish(&b);
}

/* Programs that overlook U0 .. V1 must see the part that is meant: it is written alone. */
static void only_what_is_meant_is_written(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 128, 0,
		  "128,2,1,1,1,0,0,1,0,0,0.,0.,1.,2.,2.," KNOTS4
		  "1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,"
		  "1.,0.,0.,1.,0.,1.,1.,0.,2.,1.,3.,.5,1.75,0.,1.;" },
		{ 126, 0,
		  "126,2,1,0,0,1,0,0.,0.,1.,2.,2.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,1.,0.,.5,1.75;" },
	};
	struct model a, b;
	(void)state;
	read_and_again(&a, &b, entities);
	const struct surface *s = &b.entities[0].geometry;
	const struct curve *c = &b.entities[1].curve;
	assert_true(s->knots[0][1] == 0.5 && s->knots[0][s->n[0]] == 1.75);
	assert_true(c->knots[1] == 0.5 && c->knots[c->n] == 1.75);
	for (double u = 0.5; u <= 1.75; u += 0.25) {
		assert_point(0, surface_point(s, u, 0.5),
		             surface_point(&a.entities[0].geometry, u, 0.5));
		assert_point(1, curve_point(c, u), curve_point(&a.entities[1].curve, u));
	}
	model_finish(&a);
	model_finish(&b);
}

static void a_missing_unit_is_told(void **state)
{
	static const struct made_entity entities[MADE_MAX] = { { 128, 0, SQUARE } };
	const struct made_file f = { 0 };
	char folder[] = "/tmp/batten-test-XXXXXX", path[64];
	struct model m;
	struct report_store store;
	(void)state;
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/x.igs", folder);
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(iges_write(&m, path, &store.report), ST_OK);
	assert_int_equal(store.n_warnings, 0);
	assert_int_equal(model_set_text(&m.unit, NULL), ST_OK);
	assert_int_equal(iges_write(&m, path, &store.report), ST_OK);
	assert_int_equal(store.n_warnings, 1);
	model_finish(&m);
	assert_int_equal(model_read(&m, path, NULL, &store.report), ST_OK);
	assert_string_equal(m.unit, "mm");
	model_finish(&m);
	unlink(path);
	rmdir(folder);
}

/* Names of groups are an attribute of their members, a face's of the surface under it. */
static void groups_are_kept(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 128, 0, SQUARE },
		{ 144, 0, "144,3,1,0,7;" },
		{ 142, 0, "142,0,3,17,0,1;" },
		{ 402, 7, "402,2,5,1,0,1,11;" },
		{ 406, 15, "406,1,9Hfore ship;" },
		{ 402, 1, "402,1,17;", 0, 0, NULL, "AFT" },
		{ 402, 7, "402,1,1,0,1,11;" }, /* in one group twice */
	};
	struct made_entity all[MADE_MAX + 1];
	const struct made_file f = { 0 };
	struct model a, b;
	struct text t = { 0 };
	(void)state;
	memcpy(all, entities, sizeof entities);
	all[MADE_MAX] = (struct made_entity){ 100, 0, DISK };
	make_iges(&t, &f, all, MADE_MAX + 1);
	model_init(&a);
	assert_int_equal(iges_parse(&a, t.s, t.n, "x.igs", NULL, NULL), ST_OK);
	assert_int_equal(a.n, 3);
	assert_string_equal(entity_get_attribute(&a.entities[0], "group"), "fore ship");
	assert_string_equal(entity_get_attribute(&a.entities[1], "group"), "fore ship");
	assert_string_equal(entity_get_attribute(&a.entities[2], "group"), "AFT");
	text_reset(&t);
	iges_format(&a, &t);
	assert_false(t.failed);
	model_init(&b);
	assert_int_equal(iges_parse(&b, t.s, t.n, "y.igs", NULL, NULL), ST_OK);
	assert_int_equal(b.n_skipped, 0);
	int fore = 0, aft = 0;
	for (int i = 0; i < b.n; i++) {
		const char *group = entity_get_attribute(&b.entities[i], "group");
		fore += group && strcmp(group, "fore ship") == 0;
		aft += group && strcmp(group, "AFT") == 0;
	}
	assert_int_equal(fore, 2);
	assert_int_equal(aft, 1);
	text_finish(&t);
	model_finish(&a);
	model_finish(&b);
}

/* What goes to the disk piece by piece is what is made in memory. */
static void on_disk_as_in_memory(void **state)
{
	enum { POINTS = 3000 };
	char path[] = "/tmp/batten-iges-XXXXXX";
	struct model m;
	struct text t = { 0 };
	struct report_store store;
	char *bytes;
	size_t n;
	const int fd = mkstemp(path);
	(void)state;
	report_store_init(&store);
	model_init(&m);
	assert_true(fd >= 0);
	close(fd);
	assert_int_equal(model_set_text(&m.unit, "mm"), ST_OK);
	for (int i = 0; i < POINTS; i++) {
		struct entity e;
		entity_init(&e, ENTITY_POINTS);
		e.points = (struct point_list){ 1, 3, calloc(3, sizeof(double)) };
		assert_non_null(e.points.values);
		e.points.values[i % 3] = 0.1 * i;
		assert_int_equal(model_add(&m, &e), ST_OK);
	}
	iges_format(&m, &t);
	assert_false(t.failed);
	assert_int_equal(iges_write(&m, path, &store.report), ST_OK);
	assert_int_equal(file_read(path, 1 << 24, &bytes, &n, NULL), ST_OK);
	assert_int_equal(n, t.n);
	assert_memory_equal(bytes, t.s, n);
	unlink(path);
	assert_int_equal(iges_write(&m, "/nowhere/at/all/x.igs", &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "/nowhere/at/all/x.igs"));
	free(bytes);
	text_finish(&t);
	model_finish(&m);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(written_is_read_again),
		cmocka_unit_test(curves_on_surfaces_and_points_are_kept),
		cmocka_unit_test(only_what_is_meant_is_written),
		cmocka_unit_test(groups_are_kept),
		cmocka_unit_test(a_missing_unit_is_told),
		cmocka_unit_test(on_disk_as_in_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
