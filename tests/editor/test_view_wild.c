/* test_view_wild.c - the view and surfaces that are too large, too small, too many. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "view_place.h"

static unsigned pixels[SIDE * SIDE];

/* Coordinates as files may have them: nothing is drawn wrong or for ever, and what is sound is drawn. */
static void wild_surfaces_do_no_harm(void **state)
{
	static const double sizes[] = { 1e-12, 1e-300, 1e12, 1e150, 1e300, INFINITY, NAN };
	(void)state;
	for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
		for (int all = 0; all < 2; all++) {
			struct world *w = place_world();
			struct vec3 corner[4] = {
				{ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0.1 }, { 1, 1, 0.3 }
			};
			for (int i = all ? 0 : 3; i < 4; i++)
				corner[i] = vec3_scale(corner[i], sizes[k]);
			struct surface s;
			struct pick pick;
			bool more;
			assert_int_equal(make_bilinear(&s, corner), ST_OK);
			place_surface(w, &s, NULL, LOOK_SHADED);
			const int sound = place_sphere(w, 1, LOOK_SHADED);
			struct view_state only = { .theme = THEME_LIGHT,
				                   .scale = 1,
				                   .quantity = -1,
				                   .hover_point = -1,
				                   .only = sound };
			if (view_fit(&only, w, "front", SIDE, SIDE, &report_none) == ST_OK)
				for (int i = 0; i < 3; i++)
					view_draw(place_view(), w, &only, 0, 0, SIDE, SIDE, &more,
					          &report_none);
			view_pick(place_view(), w, &only, SIDE / 2.0, SIDE / 2.0, true, 0, &pick);
			only.quantity = QUANTITY_MEAN;
			only.only = 0;
			only.moving = true; /* hundreds of thousands of triangles at rest */
			view_draw(place_view(), w, &only, 0, 0, SIDE, SIDE, &more, &report_none);
			world_destroy(w);
		}
}

/* As many control points as a scanned hull has, with their net. */
static void many_points_are_drawn(void **state)
{
	enum { N = 526, M = 13 };
	(void)state;
	struct world *w = place_world();
	struct surface s;
	assert_int_equal(surface_init(&s, (int[]){ 4, 4 }, (int[]){ N, M }), ST_OK);
	for (int d = 0; d < 2; d++) {
		const int n = s.n[d];
		for (int i = 0; i < n + 4; i++)
			s.knots[d][i] = fmin(fmax(i - 3, 0), n - 3);
		s.domain[d][1] = n - 3;
	}
	for (int i = 0; i < N; i++)
		for (int j = 0; j < M; j++)
			surface_set_point(&s, i, j, vec3(0.1 * i, j, 0.3 * sin(0.05 * i) * j), 1);
	const int id = place_surface(w, &s, NULL, LOOK_SHADED);
	struct display d = world_by_id(w, id)->display;
	d.net = true;
	assert_int_equal(world_set_display(w, id, &d), ST_OK);
	struct view_state v = place_state(w, "top");
	place_draw(w, &v, pixels);
	struct pick pick;
	double x, y, depth;
	assert_true(
	        camera_project(&v.camera, vec3(0.1 * 300, 6, 0.3 * sin(15) * 6), &x, &y, &depth));
	assert_int_equal(view_pick(place_view(), w, &v, x, y, true, 0, &pick), ST_OK);
	assert_true(pick.is_point && pick.thing == id);
	world_destroy(w);
}

/* Thousands of surfaces, a picture at a time. */
static void thousands_are_drawn(void **state)
{
	enum { ROWS = 40 };
	(void)state;
	struct world *w = place_world();
	for (int k = 0; k < ROWS * ROWS; k++) {
		const double x = k % ROWS, y = k / ROWS;
		const struct vec3 corner[4] = {
			{ x, y, 0 }, { x + 1, y, 0 }, { x, y + 1, 0 }, { x + 1, y + 1, 0 }
		};
		struct surface s;
		assert_int_equal(make_bilinear(&s, corner), ST_OK);
		place_bare(w, place_surface(w, &s, NULL, LOOK_SHADED));
	}
	struct view_state v = place_state(w, "top");
	const unsigned ground = color_bytes(theme_color(v.theme, TOKEN_VIEW));
	place_draw(w, &v, pixels);
	for (int y = 40; y < SIDE - 40; y++)
		for (int x = 40; x < SIDE - 40; x++)
			assert_true(color_apart(pixels[y * SIDE + x], ground) > 6);
	world_destroy(w);
}

static int all_tests(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(wild_surfaces_do_no_harm),
		cmocka_unit_test(many_points_are_drawn),
		cmocka_unit_test(thousands_are_drawn),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void)
{
	return place_tests(all_tests);
}
