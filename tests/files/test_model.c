/* test_model.c - lists of a model, entities found by what the user calls them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "model.h"

static void add_line(struct model *m, const char *name, int de, bool used)
{
	struct entity e;
	entity_init(&e, ENTITY_CURVE);
	assert_int_equal(curve_init(&e.curve, 2, 2), ST_OK);
	for (int i = 0; i < 4; i++)
		e.curve.knots[i] = i / 2;
	curve_set_point(&e.curve, 0, vec3(0, 0, 0), 1);
	curve_set_point(&e.curve, 1, vec3(de, 2, 3), 1);
	assert_int_equal(curve_check(&e.curve, "line", NULL), ST_OK);
	assert_int_equal(model_set_text(&e.name, name), ST_OK);
	e.de = de;
	e.used = used;
	assert_int_equal(model_add(m, &e), ST_OK);
	assert_null(e.curve.knots);
}

static void add_plane(struct model *m, int de, int face)
{
	struct entity e;
	entity_init(&e, ENTITY_SURFACE);
	assert_int_equal(surface_init(&e.geometry, (int[]){ 2, 2 }, (int[]){ 2, 2 }), ST_OK);
	for (int i = 0; i < 4; i++) {
		e.geometry.knots[0][i] = e.geometry.knots[1][i] = i / 2;
		surface_set_point(&e.geometry, i / 2, i % 2, vec3(i / 2, i % 2, 0), 1);
	}
	assert_int_equal(surface_check(&e.geometry, "plane", NULL), ST_OK);
	e.de = de;
	assert_int_equal(entity_add_face(&e, face), ST_OK);
	assert_int_equal(model_add(m, &e), ST_OK);
	assert_null(e.faces);
}

static void make_model(struct model *m)
{
	model_init(m);
	add_line(m, "keel", 1, false);
	add_line(m, "part", 3, true);
	add_line(m, "twin", 5, false);
	add_line(m, "twin", 7, false);
	add_plane(m, 9, 21);
	assert_int_equal(entity_add_face(&m->entities[0], 21), ST_INTERNAL);
	assert_int_equal(model_set_text(&m->file, "a.igs"), ST_OK);
	model_number(m);
}

static void find_by_every_name(void **state)
{
	static const struct {
		const char *selector;
		int de; /* 0: an error that holds `text` */
		const char *text;
	} rows[] = {
		{ "1", 1, NULL },
		{ "2", 5, NULL },
		{ "4", 9, NULL },
		{ "keel", 1, NULL },
		{ "part", 3, NULL },
		{ "D3", 3, NULL },
		{ "D21", 9, NULL },
		{ "twin", 0, "several entities named 'twin'" },
		{ "0", 0, "numbers 1 to 4" },
		{ "5", 0, "names like 'keel'" },
		{ "-1", 0, "numbers 1 to 4" },
		{ "D2", 0, "no entity 'D2'" },
		{ "", 0, "no entity ''" },
		{ "99999999999999999999", 0, "no entity" },
	};
	struct model m;
	(void)state;
	make_model(&m);
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct entity *e = NULL;
		struct report_store store;
		report_store_init(&store);
		enum status st = model_find(&m, rows[i].selector, &e, &store.report);
		assert_int_equal(st, rows[i].de ? ST_OK : ST_INPUT);
		if (rows[i].de)
			assert_int_equal(e->de, rows[i].de);
		else if (!strstr(store.error, rows[i].text))
			fail_msg("'%s': %s", rows[i].selector, store.error);
	}
	model_finish(&m);
}

static void skipped_are_gathered(void **state)
{
	struct model m;
	(void)state;
	model_init(&m);
	assert_int_equal(model_skip(&m, 144, 5, "trims"), ST_OK);
	assert_int_equal(model_skip(&m, 144, 9, "trims"), ST_OK);
	assert_int_equal(model_skip(&m, 142, 11, "trims"), ST_OK);
	assert_int_equal(model_skip(&m, 144, 13, "broken"), ST_OK);
	assert_int_equal(m.n_skipped, 3);
	assert_int_equal(m.skipped[0].count, 2);
	assert_int_equal(m.skipped[0].first_de, 5);
	assert_string_equal(m.skipped[2].reason, "broken");
	for (int i = 0; i < 5000; i++) {
		char reason[32];
		snprintf(reason, sizeof reason, "fault %d", i);
		assert_int_equal(model_skip(&m, 126, i, reason), ST_OK);
	}
	int n = 0;
	for (int i = 0; i < m.n_skipped; i++)
		n += m.skipped[i].count;
	assert_int_equal(n, 5004);
	assert_true(m.n_skipped < 1000);
	model_finish(&m);
}

static void attributes_replace(void **state)
{
	struct model m;
	(void)state;
	model_init(&m);
	assert_null(model_get_attribute(&m, "worker"));
	assert_int_equal(model_set_attribute(&m, "worker", "fair 1"), ST_OK);
	assert_int_equal(model_set_attribute(&m, "input", "x"), ST_OK);
	assert_int_equal(model_set_attribute(&m, "worker", "fair 2"), ST_OK);
	assert_int_equal(m.n_attributes, 2);
	assert_string_equal(model_get_attribute(&m, "worker"), "fair 2");
	model_finish(&m);
	assert_int_equal(m.n_attributes, 0);
}

static void boxes(void **state)
{
	struct model m;
	struct box b;
	struct entity e;
	double values[] = { 1, 5, -2, 7 };
	(void)state;
	make_model(&m);
	assert_int_equal(entity_box(&m.entities[3], &b), ST_OK);
	assert_true(fabs(b.hi.x - 7) < 1e-8 && fabs(b.lo.x) < 1e-8 && fabs(b.hi.z - 3) < 1e-8);
	entity_init(&e, ENTITY_POINTS);
	e.points = (struct point_list){ .n = 2, .dimension = 2, .values = values };
	assert_int_equal(entity_box(&e, &b), ST_OK);
	assert_true(b.lo.x == -2 && b.hi.y == 7 && b.lo.z == 0 && b.hi.z == 0);
	model_finish(&m);
}

static void names_are_split(void **state)
{
	static const struct {
		const char *argument, *path, *selector;
	} rows[] = {
		{ "hull.igs", "hull.igs", NULL },
		{ "hull.igs#3", "hull.igs", "3" },
		{ "a#b/hull.igs#D15", "a#b/hull.igs", "D15" },
		{ "hull.igs#", "hull.igs", "" },
		{ "#1", "", "1" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		char *path, *selector;
		assert_int_equal(model_split_name(rows[i].argument, &path, &selector), ST_OK);
		assert_string_equal(path, rows[i].path);
		if (rows[i].selector)
			assert_string_equal(selector, rows[i].selector);
		else
			assert_null(selector);
		free(path);
		free(selector);
	}
}

static void bad_files_are_told(void **state)
{
	static const struct {
		const char *text, *sentence;
	} rows[] = {
		{ "", "is empty" },
		{ "solid teapot\n", "neither" },
		{ "batten base 2\n", "expected version 1" },
		{ "batten base 1\n", "expected 'type'" },
	};
	char folder[] = "/tmp/batten-test-XXXXXX", path[64], hash[64];
	struct model m;
	struct report_store store;
	(void)state;
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/x#1", folder);
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		assert_int_equal(file_write(path, rows[i].text, strlen(rows[i].text), NULL), ST_OK);
		report_store_init(&store);
		assert_int_equal(model_read(&m, path, NULL, &store.report), ST_INPUT);
		assert_int_equal(store.n_errors, 1);
		if (!strstr(store.error, rows[i].sentence))
			fail_msg("%s", store.error);
		assert_int_equal(m.n, 0);
	}
	/* a file that exists under the whole name wins over entity 1 of another */
	char *whole, *selector;
	assert_int_equal(model_split_name(path, &whole, &selector), ST_OK);
	assert_string_equal(whole, path);
	assert_null(selector);
	free(whole);
	unlink(path);
	snprintf(hash, sizeof hash, "%s/missing.igs", folder);
	report_store_init(&store);
	assert_int_equal(model_read(&m, hash, NULL, &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "missing.igs"));
	rmdir(folder);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(find_by_every_name), cmocka_unit_test(skipped_are_gathered),
		cmocka_unit_test(attributes_replace), cmocka_unit_test(boxes),
		cmocka_unit_test(names_are_split),    cmocka_unit_test(bad_files_are_told),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
