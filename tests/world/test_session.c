/* test_session.c - a world kept and found again, and sessions that are damaged. */
#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base.h"
#include "file.h"
#include "open.h"
#include "path.h"

static void restart(struct place *p)
{
	world_destroy(p->world);
	assert_int_equal(world_create(&p->world, p->folder), ST_OK);
	report_store_init(&p->said);
	assert_int_equal(world_restore_session(p->world, &p->said.report), ST_OK);
}

/* The bytes of a thing's geometry. */
static char *bytes_of(const struct world *w, const struct Ful *f)
{
	struct model m;
	struct text t = { 0 };

	assert_int_equal(world_model(w, &f->id, 1, &m, NULL), ST_OK);
	base_format(&m, &t);
	model_finish(&m);
	return text_take(&t);
}

static void write_points(const struct place *p, const char *text)
{
	char *path = place_path(p, "points.csv");
	FILE *f = fopen(path, "w");

	assert_non_null(f);
	fputs(text, f);
	fclose(f);
	free(path);
}

/* A reader that must not be asked at the start. */
static enum status never_ends(void *data, struct model *out, const char *path,
                              const struct progress *p, const struct report *r)
{
	(void)path;
	(void)p;
	model_init(out);
	++*(int *)data;
	return report_error(r, ST_INPUT, "it would never end");
}

/* Foreign files are read again where they are the same; one that has changed is left to the user. */
static void test_foreign_file(void **state)
{
	struct place *p = *state;
	int asked = 0;

	write_points(p, "1,2,3\n4,5,6\n");
	assert_int_equal(world_open(p->world, "points.csv", NULL, NULL, NULL), ST_OK);
	assert_int_equal(world_keep_session(p->world, NULL), ST_OK);
	restart(p);
	assert_int_equal(world_count(p->world), 1);
	assert_int_equal(world_keep_session(p->world, NULL), ST_OK);
	write_points(p, "1,2,3\n4,5,6\n7,8,9\n");
	world_destroy(p->world);
	assert_int_equal(world_create(&p->world, p->folder), ST_OK);
	world_set_reader(p->world, never_ends, &asked);
	assert_int_equal(world_restore_session(p->world, &p->said.report), ST_OK);
	assert_int_equal(world_count(p->world), 0);
	assert_int_equal(asked, 0);
	assert_non_null(strstr(p->said.warning, "has changed since"));
	assert_int_equal(world_open(p->world, "points.csv", NULL, NULL, NULL), ST_INPUT);
	assert_int_equal(asked, 1);
}

static void test_round_trip(void **state)
{
	struct place *p = *state;
	const struct report *r = &p->said.report;
	struct entity e;
	int line;

	place_spheres(p, "two.base", 2);
	place_diagonal(p, "diagonal.base");
	assert_int_equal(world_open(p->world, "two.base", "2", NULL, r), ST_OK);
	assert_int_equal(world_open(p->world, "diagonal.base", "1", NULL, r), ST_OK);
	const int ball = world_find(p->world, "two-2", r)->id;
	place_sphere(&e, 0.1);
	assert_int_equal(world_replace(p->world, "edit", ball, &e, r), ST_OK);
	place_line(&e, 1.0 / 3);
	assert_int_equal(world_add(p->world, "line", "rod", &e, &line, r), ST_OK);
	struct display d = world_by_id(p->world, line)->display;
	d.line = LINE_DOTTED;
	d.porcupine = true;
	d.has_color = true;
	d.color = (struct rgb){ 0.25, 0.5, 1 };
	assert_int_equal(world_set_display(p->world, line, &d), ST_OK);
	struct sight *s = world_sight(p->world);
	s->has_camera = true;
	s->camera = (struct camera){ .kind = CAMERA_PERSPECTIVE, .eye = { 1, 2, 3 }, .half = 0.5 };
	s->bell = false;
	s->split = SPLIT_SIDE;
	s->has_beside = true;
	s->beside = (struct camera){ .eye = { 4, 5, 6 }, .half = 0.25 };
	assert_int_equal(world_set_default(p->world, "curvature", "grid", "64x32"), ST_OK);
	char *map = place_path(p, "two.base"); /* any file that is there */
	assert_int_equal(world_show(p->world, &(struct overlay){ .kind = OVERLAY_MAP,
	                                                         .thing = ball,
	                                                         .file = map,
	                                                         .quantity = QUANTITY_KMIN,
	                                                         .range_given = true,
	                                                         .lo = -2,
	                                                         .hi = 2 }),
	                 ST_OK);
	assert_int_equal(world_show(p->world, &(struct overlay){ .kind = OVERLAY_LINES,
	                                                         .thing = ball,
	                                                         .file = "/gone.isophote" }),
	                 ST_OK);
	assert_int_equal(world_keep_mark(p->world, &(struct mark){ ball, 0.125, 3 }), ST_OK);
	char *before[8];
	const int n = world_count(p->world);
	for (int k = 0; k < n; k++)
		before[k] = bytes_of(p->world, world_at(p->world, k));

	assert_int_equal(world_keep_session(p->world, r), ST_OK);
	restart(p);
	assert_int_equal(world_count(p->world), n);
	for (int k = 0; k < n; k++) {
		char *after = bytes_of(p->world, world_at(p->world, k));
		assert_string_equal(after, before[k]);
		free(after);
		free(before[k]);
	}
	assert_int_equal(world_find(p->world, "two-2", r)->id, ball);
	assert_int_equal(world_sight(p->world)->split, SPLIT_SIDE);
	assert_true(world_sight(p->world)->has_beside);
	assert_true(world_sight(p->world)->beside.eye.z == 6);
	assert_false(world_by_id(p->world, ball)->saved);
	assert_true(world_find(p->world, "diagonal", r)->saved);
	assert_int_equal(world_find(p->world, "diagonal", r)->on,
	                 world_find(p->world, "diagonal-surface", r)->id);
	assert_int_equal(world_current(p->world, false)->id, ball);
	assert_ptr_equal(world_find(p->world, "two.base#2", r), world_by_id(p->world, ball));
	assert_int_equal(world_current(p->world, true)->id, line);
	assert_string_equal(world_by_id(p->world, line)->unit, "m");
	const struct display *shown = &world_by_id(p->world, line)->display;
	assert_int_equal(shown->line, LINE_DOTTED);
	assert_true(shown->porcupine && shown->has_color && shown->color.g == 0.5);
	assert_true(world_sight(p->world)->has_camera && world_sight(p->world)->camera.eye.y == 2);
	assert_false(world_sight(p->world)->bell);
	assert_string_equal(world_default(p->world, "curvature", "grid"), "64x32");
	assert_int_equal(world_overlays(p->world), 1);
	assert_true(world_overlay(p->world, 0)->range_given &&
	            world_overlay(p->world, 0)->lo == -2);
	assert_int_equal(world_marks(p->world), 1);
	assert_non_null(strstr(p->said.warning, "/gone.isophote"));
	assert_null(world_undo_name(p->world));

	/* a new thing gets a number that none had */
	place_line(&e, 1);
	int fresh;
	assert_int_equal(world_add(p->world, "line", NULL, &e, &fresh, r), ST_OK);
	assert_true(fresh > line);
	free(map);
}

/* Kept geometry that is no longer needed goes with the next keeping. */
static void test_sweep(void **state)
{
	struct place *p = *state;
	const struct report *r = &p->said.report;
	struct entity e;
	int id;

	place_line(&e, 1);
	assert_int_equal(world_add(p->world, "line", "rod", &e, &id, r), ST_OK);
	assert_int_equal(world_keep_session(p->world, r), ST_OK);
	assert_int_equal(world_save(p->world, id, NULL, r), ST_OK);
	assert_int_equal(world_keep_session(p->world, r), ST_OK);
	char *folder = place_path(p, ".batten/session"), *file = place_path(p, "rod.base");
	assert_int_equal(rmdir(folder), -1); /* session.json is there */
	char *session = path_join(folder, "session.json");
	assert_int_equal(unlink(session), 0);
	assert_int_equal(rmdir(folder), 0); /* and nothing else was */
	assert_true(path_exists(file));
	free(session);
	free(folder);
	free(file);
}

static void test_missing_files(void **state)
{
	struct place *p = *state;
	const struct report *r = &p->said.report;

	place_spheres(p, "two.base", 2);
	place_diagonal(p, "diagonal.base");
	assert_int_equal(world_open(p->world, "two.base", NULL, NULL, r), ST_OK);
	assert_int_equal(world_open(p->world, "diagonal.base", NULL, NULL, r), ST_OK);
	assert_int_equal(world_keep_session(p->world, r), ST_OK);
	char *path = place_path(p, "diagonal.base");
	assert_int_equal(unlink(path), 0);
	place_spheres(p, "two.base", 1);
	restart(p);
	assert_int_equal(world_count(p->world), 1);
	assert_string_equal(world_current(p->world, false)->name, "two-1");
	assert_null(world_current(p->world, true));
	assert_true(p->said.n_warnings >= 2);
	free(path);
}

static void test_damaged(void **state)
{
	struct place *p = *state;
	char *folder = place_path(p, ".batten/session"), *path = path_join(folder, "session.json");
	static const struct {
		const char *text;
		enum status st;
	} cases[] = {
		{ "", ST_INPUT },
		{ "[]", ST_INPUT },
		{ "{\"things\":[", ST_INPUT },
		{ "{}", ST_OK },
		{ "{\"things\":7,\"sight\":[],\"overlays\":{},\"marks\":\"x\",\"defaults\":[[1],2]}",
		  ST_OK },
		{ "{\"things\":[7,{},{\"kept\":\"../../x\"},{\"file\":9}],\"current\":[\"a\"]}",
		  ST_OK },
		{ "{\"things\":[{\"file\":\"/nowhere\",\"on\":-5,\"number\":1e99}],\"last_id\":-1}",
		  ST_OK },
	};

	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct world *w;
		assert_int_equal(folder_make(folder, 0777, NULL), ST_OK);
		assert_int_equal(file_write(path, cases[k].text, strlen(cases[k].text), NULL),
		                 ST_OK);
		assert_int_equal(world_create(&w, p->folder), ST_OK);
		assert_int_equal(world_restore_session(w, NULL), cases[k].st);
		assert_int_equal(world_count(w), 0);
		world_destroy(w);
	}
	free(path);
	free(folder);
}

/* The one file of that ending in a folder; NULL: there is none. */
static char *only_one(const char *folder, const char *ending)
{
	char *pattern = text_print("%s/*%s", folder, ending), *found = NULL;
	glob_t g;

	if (!glob(pattern, 0, NULL, &g) && g.gl_pathc == 1)
		found = strdup(g.gl_pathv[0]);
	globfree(&g);
	free(pattern);
	return found;
}

/* What cannot be read is not taken away by the next keeping: it may be all there is of something. */
static void test_damage_is_kept_aside(void **state)
{
	static const char *const damaged[] = { "{\"things\":[", "{\"version\":2,\"things\":[]}" };
	struct place *p = *state;
	struct entity e;
	int id;
	char *folder = place_path(p, ".batten/session"), *path = path_join(folder, "session.json");

	for (int k = 0; k < 2; k++) {
		place_line(&e, 1);
		assert_int_equal(world_add(p->world, "line", "rod", &e, &id, NULL), ST_OK);
		assert_int_equal(world_keep_session(p->world, NULL), ST_OK);
		assert_int_equal(file_write(path, damaged[k], strlen(damaged[k]), NULL), ST_OK);
		world_destroy(p->world);
		assert_int_equal(world_create(&p->world, p->folder), ST_OK);
		report_store_init(&p->said);
		assert_int_equal(world_restore_session(p->world, &p->said.report), ST_INPUT);
		assert_int_equal(p->said.n_errors, 1);
		assert_non_null(strstr(p->said.error, k ? "session-2'" : "session-1'"));
		assert_int_equal(world_keep_session(p->world, NULL), ST_OK);
		char *aside = text_print("%s-%d", folder, k + 1), *base = only_one(aside, ".base");
		assert_non_null(base);
		free(base);
		free(aside);
		restart(p);
		assert_int_equal(world_count(p->world), 0);
	}
	/* one thing of several */
	place_line(&e, 1);
	assert_int_equal(world_add(p->world, "line", "rod", &e, &id, NULL), ST_OK);
	assert_int_equal(world_keep_session(p->world, NULL), ST_OK);
	char *geometry = only_one(folder, ".base");
	char *kept = text_print("%s.damaged", geometry);
	assert_int_equal(file_write(geometry, "batten base 1\ncurve {", 21, NULL), ST_OK);
	restart(p);
	assert_int_equal(world_count(p->world), 0);
	assert_int_equal(world_keep_session(p->world, NULL), ST_OK);
	assert_true(path_exists(kept) && !path_exists(geometry));
	free(kept);
	free(geometry);
	free(path);
	free(folder);
}

/* Every byte of a session changed in one bit, or missing from there on. */
static void test_flips(void **state)
{
	struct place *p = *state;
	struct entity e;
	char *folder = place_path(p, ".batten/session"), *path = path_join(folder, "session.json");
	char *text;
	size_t n;
	int id;

	place_line(&e, 1);
	assert_int_equal(world_add(p->world, "line", "rod", &e, &id, NULL), ST_OK);
	assert_int_equal(world_keep_session(p->world, NULL), ST_OK);
	assert_int_equal(file_read(path, 1 << 20, &text, &n, NULL), ST_OK);
	for (size_t i = 0; i < n; i++) {
		const bool cut = i % 16 == 7;
		char *folder_now = text_print("%s-1", folder);
		struct world *w;
		text[i] = (char)(text[i] ^ 1 << i % 8);
		FILE *f = fopen(path, "w");
		assert_non_null(f);
		assert_int_equal(fwrite(text, 1, cut ? i : n, f), cut ? i : n);
		fclose(f);
		text[i] = (char)(text[i] ^ 1 << i % 8);
		assert_int_equal(world_create(&w, p->folder), ST_OK);
		const enum status st = world_restore_session(w, NULL);
		assert_true(st == ST_OK || st == ST_INPUT);
		assert_true(world_count(w) <= 1);
		world_destroy(w);
		if (st != ST_OK)
			assert_int_equal(rename(folder_now, folder), 0);
		free(folder_now);
	}
	free(text);
	free(path);
	free(folder);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_round_trip, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_foreign_file, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_sweep, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_missing_files, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_damaged, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_damage_is_kept_aside, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_flips, place_new, place_gone),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
