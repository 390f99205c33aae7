/* test_world.c - opening, names, edits and their undo, saving. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "open.h"
#include "path.h"

/* What is open, as one line: names by blanks, the current surface and curve behind. */
static void assert_open(const struct place *p, const char *expected)
{
	char line[512] = "";

	for (int k = 0; k < world_count(p->world); k++) {
		strcat(line, world_at(p->world, k)->name);
		strcat(line, " ");
	}
	for (int curve = 0; curve < 2; curve++) {
		const struct Ful *f = world_current(p->world, curve);
		strcat(line, curve ? "," : "| ");
		strcat(line, f ? f->name : "-");
	}
	assert_string_equal(line, expected);
}

static double radius_of(const struct place *p, const char *name)
{
	const struct Ful *f = world_find(p->world, name, &p->said.report);

	assert_non_null(f);
	return surface_point(&f->entity.geometry, f->entity.geometry.domain[0][0], 0).x;
}

static void replace_radius(struct place *p, const char *name, double radius, const char *what)
{
	struct entity e;

	place_sphere(&e, radius);
	assert_int_equal(world_replace(p->world, what, world_find(p->world, name, NULL)->id, &e,
	                               &p->said.report),
	                 ST_OK);
}

static void test_open(void **state)
{
	struct place *p = *state;
	struct world *w = p->world;
	const struct report *r = &p->said.report;

	assert_open(p, "| -,-");
	place_spheres(p, "ball.base", 1);
	place_spheres(p, "three.base", 3);
	assert_int_equal(world_open(w, "ball.base", NULL, NULL, r), ST_OK);
	assert_int_equal(world_open(w, "three.base", NULL, NULL, r), ST_OK);
	assert_open(p, "ball three-1 three-2 three-3 | three-1,-");
	assert_int_equal(world_open(w, "three.base", "3,1", NULL, r), ST_OK);
	assert_open(p, "ball three-1 three-2 three-3 three-1-2 three-3-2 | three-1-2,-");
	assert_false(world_unsaved(w));
	assert_true(world_find(w, "ball", r)->alone);
	assert_false(world_find(w, "three-1", r)->alone);
	assert_string_equal(world_find(w, "ball", r)->unit, "m");
	assert_ptr_equal(world_find(w, "three.base#2", r), world_find(w, "three-2", r));
	assert_null(world_undo_name(w));
}

static void test_open_fails(void **state)
{
	struct place *p = *state;
	static const struct {
		const char *file, *entities, *says;
	} cases[] = {
		{ "missing.base", NULL, "missing.base" },
		{ "two.base", "3", "3" },
		{ "two.base", "1,x", "x" },
	};

	place_spheres(p, "two.base", 2);
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		report_store_init(&p->said);
		assert_int_equal(world_open(p->world, cases[k].file, cases[k].entities, NULL,
		                            &p->said.report),
		                 ST_INPUT);
		assert_non_null(strstr(p->said.error, cases[k].says));
		assert_int_equal(world_count(p->world), 0);
	}
	assert_null(world_find(p->world, "nobody", &p->said.report));
	assert_non_null(strstr(p->said.error, "'nobody' is not open"));
}

/* A day's work: all of it can be taken back, to the bit, and done again. */
static void test_many_edits(void **state)
{
	enum { EDITS = 10000 };
	struct place *p = *state;
	struct entity e;
	int id;

	place_line(&e, 1);
	assert_int_equal(world_add(p->world, "line", "rod", &e, &id, NULL), ST_OK);
	for (int k = 1; k <= EDITS; k++) {
		place_line(&e, 1 + k);
		assert_int_equal(world_replace(p->world, "stretch", id, &e, NULL), ST_OK);
	}
	for (int k = EDITS - 1; k >= 0; k--) {
		assert_int_equal(world_undo(p->world, NULL), ST_OK);
		const struct curve *c = &world_by_id(p->world, id)->entity.curve;
		assert_true(curve_get_point(c, 1, NULL).x == 1 + k);
	}
	assert_string_equal(world_undo_name(p->world), "line");
	for (int k = 0; k < EDITS; k++)
		assert_int_equal(world_redo(p->world, NULL), ST_OK);
	assert_null(world_redo_name(p->world));
	assert_true(curve_get_point(&world_by_id(p->world, id)->entity.curve, 1, NULL).x ==
	            1 + EDITS);
}

static void test_curve_on_surface(void **state)
{
	struct place *p = *state;
	struct world *w = p->world;
	const struct report *r = &p->said.report;

	place_diagonal(p, "diagonal.base");
	assert_int_equal(world_open(w, "diagonal.base", "1", NULL, r), ST_OK);
	assert_int_equal(world_count(w), 2);
	const struct Ful *c = world_current(w, true), *s = world_current(w, false);
	assert_int_equal(c->on, s->id);

	/* saved, it takes its surface along, and is found again with it */
	assert_int_equal(world_rename(w, c->id, "keel", r), ST_OK);
	assert_int_equal(world_save(w, world_current(w, true)->id, NULL, r), ST_OK);
	assert_int_equal(world_open(w, "keel.base", NULL, NULL, r), ST_OK);
	assert_int_equal(world_count(w), 4);
	assert_string_equal(world_current(w, true)->name, "keel-2");

	/* its surface takes it out of the world, and undo brings both back */
	assert_int_equal(world_remove(w, "close", world_current(w, true)->on, r), ST_OK);
	assert_int_equal(world_count(w), 2);
	assert_int_equal(world_undo(w, r), ST_OK);
	assert_int_equal(world_count(w), 4);
	assert_string_equal(world_current(w, true)->name, "keel-2");

	struct entity e;
	entity_init(&e, ENTITY_CURVE_ON_SURFACE);
	assert_int_equal(world_add(w, "make", NULL, &e, NULL, r), ST_PARAMETER);
	assert_int_equal(world_count(w), 4);
}

static void test_edits(void **state)
{
	struct place *p = *state;
	struct world *w = p->world;
	const struct report *r = &p->said.report;
	struct entity e;
	int id;

	place_spheres(p, "ball.base", 1);
	assert_int_equal(world_open(w, "ball.base", NULL, NULL, r), ST_OK);
	replace_radius(p, "ball", 5, "grow");
	assert_true(world_unsaved(w));
	replace_radius(p, "ball", 6, "grow more");
	place_line(&e, 2);
	assert_int_equal(world_add(w, "line", NULL, &e, &id, r), ST_OK);
	assert_open(p, "ball curve | ball,curve");
	assert_string_equal(world_by_id(w, id)->unit, "m");
	assert_int_equal(world_rename(w, id, "rod", r), ST_OK);
	assert_string_equal(world_undo_name(w), "rename curve to rod");

	assert_int_equal(world_undo(w, r), ST_OK);
	assert_open(p, "ball curve | ball,curve");
	assert_int_equal(world_undo(w, r), ST_OK);
	assert_open(p, "ball | ball,-");
	assert_true(radius_of(p, "ball") == 6);
	assert_int_equal(world_undo(w, r), ST_OK);
	assert_true(radius_of(p, "ball") == 5);
	assert_string_equal(world_undo_name(w), "grow");
	assert_string_equal(world_redo_name(w), "grow more");
	assert_int_equal(world_undo(w, r), ST_OK);
	assert_true(radius_of(p, "ball") == 1);
	assert_false(world_unsaved(w)); /* as its file has it */
	assert_int_equal(world_undo(w, r), ST_PARAMETER);

	for (int k = 0; k < 4; k++)
		assert_int_equal(world_redo(w, r), ST_OK);
	assert_open(p, "ball rod | ball,rod");
	assert_true(radius_of(p, "ball") == 6);
	assert_int_equal(world_redo(w, r), ST_PARAMETER);

	/* a new edit ends what could be done again */
	assert_int_equal(world_undo(w, r), ST_OK);
	replace_radius(p, "ball", 9, "other");
	assert_null(world_redo_name(w));
}

static void test_steps(void **state)
{
	struct place *p = *state;
	struct world *w = p->world;
	const struct report *r = &p->said.report;
	struct entity e;
	int id;

	place_spheres(p, "ball.base", 1);
	assert_int_equal(world_open(w, "ball.base", NULL, NULL, r), ST_OK);
	world_step_begin(w, "split");
	replace_radius(p, "ball", 2, "first");
	replace_radius(p, "ball", 3, "second");
	place_sphere(&e, 4);
	assert_int_equal(world_add(w, "third", "half", &e, &id, r), ST_OK);
	world_step_end(w, true);
	assert_string_equal(world_undo_name(w), "split");
	assert_open(p, "ball half | half,-");
	assert_int_equal(world_undo(w, r), ST_OK);
	assert_open(p, "ball | ball,-");
	assert_true(radius_of(p, "ball") == 1);
	assert_int_equal(world_redo(w, r), ST_OK);
	assert_true(radius_of(p, "ball") == 3);
	assert_true(radius_of(p, "half") == 4);

	/* an edit that fails half way leaves nothing */
	world_step_begin(w, "fails");
	replace_radius(p, "half", 7, "first");
	assert_int_equal(world_remove(w, "gone", world_find(w, "ball", r)->id, r), ST_OK);
	world_step_end(w, false);
	assert_open(p, "ball half | half,-");
	assert_true(radius_of(p, "half") == 4);
	assert_string_equal(world_undo_name(w), "split");

	/* added and removed in one step: there is nothing to see of it, either way */
	world_step_begin(w, "blink");
	place_sphere(&e, 8);
	assert_int_equal(world_add(w, "add", "brief", &e, &id, r), ST_OK);
	assert_int_equal(world_remove(w, "remove", id, r), ST_OK);
	world_step_end(w, true);
	assert_int_equal(world_undo(w, r), ST_OK);
	assert_open(p, "ball half | half,-");
	assert_int_equal(world_redo(w, r), ST_OK);
	assert_open(p, "ball half | half,-");
}

static void test_many_steps(void **state)
{
	struct place *p = *state;
	enum { EDITS = 600 };
	int undone = 0;

	place_spheres(p, "ball.base", 1);
	assert_int_equal(world_open(p->world, "ball.base", NULL, NULL, &p->said.report), ST_OK);
	for (int k = 0; k < EDITS; k++)
		replace_radius(p, "ball", k + 2, "grow");
	while (world_undo(p->world, NULL) == ST_OK)
		undone++;
	assert_int_equal(undone, EDITS);
	assert_true(radius_of(p, "ball") == 1);
	for (int k = 0; k < EDITS; k++)
		assert_int_equal(world_redo(p->world, NULL), ST_OK);
	assert_true(radius_of(p, "ball") == EDITS + 1);
}

static void test_names(void **state)
{
	struct place *p = *state;
	const struct report *r = &p->said.report;
	static const char *const wrong[] = { "",    ".hidden", "a/b", "a b",  "a,b",
		                             "a#1", "a\"",     "a\n", "two-2" };
	place_spheres(p, "two.base", 2);
	assert_int_equal(world_open(p->world, "two.base", NULL, NULL, r), ST_OK);
	const int id = world_find(p->world, "two-1", r)->id;
	for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
		assert_int_equal(world_rename(p->world, id, wrong[k], r), ST_PARAMETER);
	assert_null(world_undo_name(p->world));
	assert_int_equal(world_rename(p->world, id, "two-1", r), ST_OK);
	assert_int_equal(world_rename(p->world, 999, "x", r), ST_PARAMETER);
}

static void test_save(void **state)
{
	struct place *p = *state;
	struct world *w = p->world;
	const struct report *r = &p->said.report;
	char *path = place_path(p, "two-1.base");

	place_spheres(p, "two.base", 2);
	assert_int_equal(world_open(w, "two.base", NULL, NULL, r), ST_OK);
	const int id = world_find(w, "two-1", r)->id;
	replace_radius(p, "two-1", 4, "grow");
	assert_int_equal(world_save(w, id, NULL, r), ST_OK);
	assert_true(world_by_id(w, id)->saved);
	assert_string_equal(world_by_id(w, id)->file, path);
	assert_true(path_exists(path));

	/* what the file had before the edit, it has no longer */
	assert_int_equal(world_undo(w, r), ST_OK);
	assert_false(world_by_id(w, id)->saved);
	assert_int_equal(world_save(w, id, NULL, r), ST_OK); /* its own file */

	/* another's file is not overwritten */
	assert_int_equal(world_rename(w, id, "two", r), ST_OK);
	assert_int_equal(world_save(w, id, NULL, r), ST_PARAMETER);
	assert_non_null(strstr(p->said.error, "two.base"));
	assert_int_equal(world_save(w, id, "no/such/folder.base", r), ST_INPUT);
	assert_int_equal(world_save(w, 999, NULL, r), ST_PARAMETER);
	free(path);
}

/* What a job that comes to nothing hid is shown again, as it was. */
static void test_overlay_before(void **state)
{
	struct place *p = *state;
	struct world *w = p->world;
	struct overlay o = { .kind = OVERLAY_IMAGE, .file = "old.exr" };

	assert_int_equal(world_show(w, &o), ST_OK);
	o = (struct overlay){ .kind = OVERLAY_IMAGE, .file = "4.part", .job = 4 };
	assert_int_equal(world_show(w, &o), ST_OK);
	o = (struct overlay){ .kind = OVERLAY_IMAGE, .file = "5.part", .job = 5 };
	assert_int_equal(world_show(w, &o), ST_OK);
	o = *world_overlay(w, 0); /* shown in another way */
	o.file = "5.part";
	assert_int_equal(world_show(w, &o), ST_OK);
	assert_int_equal(world_overlays(w), 1);
	world_hide_job(w, OVERLAY_IMAGE, 0);
	assert_int_equal(world_overlays(w), 1);
	assert_string_equal(world_overlay(w, 0)->file, "old.exr");
	assert_int_equal(world_overlay(w, 0)->job, 0);
	world_hide_job(w, OVERLAY_IMAGE, 0);
	assert_int_equal(world_overlays(w), 0);
	o = (struct overlay){ .kind = OVERLAY_IMAGE, .file = "6.part", .job = 6 };
	assert_int_equal(world_show(w, &o), ST_OK);
	world_hide_job(w, OVERLAY_IMAGE, 0);
	assert_int_equal(world_overlays(w), 0);
}

static void test_overlays(void **state)
{
	struct place *p = *state;
	struct world *w = p->world;
	const struct report *r = &p->said.report;

	place_spheres(p, "two.base", 2);
	assert_int_equal(world_open(w, "two.base", NULL, NULL, r), ST_OK);
	const int id = world_at(w, 0)->id, other = world_at(w, 1)->id;
	struct overlay o = { .kind = OVERLAY_MAP, .thing = id, .file = "a.map.exr" };
	assert_int_equal(world_show(w, &o), ST_OK);
	o.quantity = QUANTITY_MEAN;
	assert_int_equal(world_show(w, &o), ST_OK);
	assert_int_equal(world_overlays(w), 1);
	assert_int_equal(world_overlay(w, 0)->quantity, QUANTITY_MEAN);
	o.thing = other;
	assert_int_equal(world_show(w, &o), ST_OK);
	o.kind = OVERLAY_LINES;
	assert_int_equal(world_show(w, &o), ST_OK);
	assert_int_equal(world_overlays(w), 3);
	const struct mark m = { id, 0.5, 0.25 };
	assert_int_equal(world_keep_mark(w, &m), ST_OK);
	assert_int_equal(world_keep_mark(w, &(struct mark){ 999, 0, 0 }), ST_PARAMETER);

	/* what was computed of another shape goes; renaming is none */
	assert_int_equal(world_rename(w, id, "renamed", r), ST_OK);
	assert_int_equal(world_undo(w, r), ST_OK);
	assert_int_equal(world_overlays(w), 3);
	replace_radius(p, "two-1", 9, "grow");
	assert_int_equal(world_overlays(w), 2);
	assert_int_equal(world_marks(w), 0);
	world_hide(w, OVERLAY_LINES, other);
	assert_int_equal(world_overlays(w), 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_open, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_open_fails, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_many_edits, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_curve_on_surface, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_edits, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_steps, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_many_steps, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_names, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_save, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_overlay_before, place_new, place_gone),
		cmocka_unit_test_setup_teardown(test_overlays, place_new, place_gone),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
