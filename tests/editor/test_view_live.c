/* test_view_live.c - results of running jobs in the view: part files as they grow. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "construct.h"
#include "level_look.h"
#include "part.h"
#include "view_place.h"

static unsigned pixels[SIDE * SIDE], other[SIDE * SIDE];

static int differ(void)
{
	int n = 0;
	for (int i = 0; i < SIDE * SIDE; i++)
		n += color_apart(pixels[i], other[i]) > 60;
	return n;
}

enum { ANGLES = 3 };

static void put_angle(struct part *part, const struct surface *s, int k)
{
	const double degrees = 50 + 20 * k;
	const struct level_field field = { .kind = LEVEL_ISOPHOTE,
		                           .direction = { 0, 0, 1 },
		                           .value = cos(degrees * M_PI / 180) };
	struct text block = { 0 };
	struct level *l;
	level_head_add(&block, &(struct level_head){ LEVEL_ISOPHOTE, degrees });
	assert_int_equal(level_create(&l, s, &field, 1e-6, &report_none), ST_OK);
	for (size_t p = 0; p < level_patches(l); p++)
		assert_int_equal(level_patch(l, p, NULL, &block), ST_OK);
	assert_int_equal(part_put(part, (size_t)k, block.s, block.n, &report_none), ST_OK);
	level_destroy(l);
	text_finish(&block);
}

/* Lines are drawn of the units that there are, without a change of the world. */
static void lines_come_while_their_job_runs(void **state)
{
	(void)state;
	char folder[] = "/tmp/batten-view-XXXXXX", path[64];
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/1.part", folder);
	struct world *w = place_world();
	const int id = place_sphere(w, 2, LOOK_SHADED);
	const struct surface *s = &world_by_id(w, id)->entity.geometry;
	place_bare(w, id);
	const struct overlay o = { .kind = OVERLAY_LINES, .thing = id, .file = path, .job = 1 };
	assert_int_equal(world_show(w, &o), ST_OK);
	struct view_state v = place_state(w, "front");
	const unsigned revision = world_revision(w);
	place_draw(w, &v, other); /* not there yet */
	struct part *part;
	assert_int_equal(part_open(&part, path, "worker=isophotes\n", ANGLES, &report_none), ST_OK);
	for (int k = 0; k < ANGLES; k++) {
		put_angle(part, s, k);
		place_draw(w, &v, pixels);
		/* from the front a circle of latitude is a level line through most of the picture */
		const double z = 2 * cos((50 + 20 * k) * M_PI / 180);
		const double pixel = 2 * v.camera.half / SIDE;
		const int row = (int)lround(SIDE / 2.0 - z / pixel);
		int dark = 0;
		for (int x = SIDE / 4; x < 3 * SIDE / 4; x++)
			for (int y = row - 2; y <= row + 2; y++)
				dark += color_apart(pixels[y * SIDE + x], other[y * SIDE + x]) > 60;
		assert_in_range(dark, SIDE / 3, 2 * SIDE);
		assert_in_range(differ(), SIDE / 2, 6 * SIDE); /* with labels */
		memcpy(other, pixels, sizeof other);
		place_draw(w, &v, pixels);
		assert_int_equal(differ(), 0);
	}
	assert_int_equal(world_revision(w), revision);
	part_remove(part);
	rmdir(folder);
	world_destroy(w);
}

/* Two places beside each other keep their own pictures. */
static void places_do_not_mix(void **state)
{
	static unsigned again[SIDE * SIDE];
	(void)state;
	struct world *w = place_world();
	place_torus(w, LOOK_SHADED);
	struct view_state a = place_state(w, "front"), b = place_state(w, "top");
	b.place = 1;
	place_draw(w, &a, pixels);
	place_draw(w, &b, other);
	assert_true(differ() > SIDE);
	place_draw(w, &a, again);
	assert_memory_equal(again, pixels, sizeof again);
	place_draw(w, &b, again);
	assert_memory_equal(again, other, sizeof again);
	a.place = VIEW_PLACES + 3; /* none: the first is taken */
	place_draw(w, &a, again);
	assert_memory_equal(again, pixels, sizeof again);
	world_destroy(w);
}

static int all_tests(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(lines_come_while_their_job_runs),
		cmocka_unit_test(places_do_not_mix),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void)
{
	return place_tests(all_tests);
}
