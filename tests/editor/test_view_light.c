/* test_view_light.c - the sun and its ray, drawn while the light is being set. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "view_place.h"

static unsigned pixels[SIDE * SIDE], other[SIDE * SIDE];

/* The sun stands at 0.6 of the box's diagonal from its middle; a dashed ray goes there, a disc lies about it
 * with rays of its own, and nothing else differs from the picture without. */
static void the_ray_goes_to_the_sun(void **state)
{
	static const double lights[][2] = { { 0, 60 }, { 180, 60 }, { 0, 120 }, { 180, 20 } };
	enum { NEAR = 3, SUN = 16 };
	struct world *w = place_world();

	(void)state;
	place_sphere(w, 1, LOOK_SHADED);
	struct view_state s = place_state(w, "front");
	s.camera.half *= 2.5;
	for (size_t k = 0; k < sizeof lights / sizeof *lights; k++) {
		struct sight *sight = world_sight(w);
		const double a = lights[k][0] * M_PI / 180, i = lights[k][1] * M_PI / 180;
		const double away = 0.6 * sqrt(12), pixel = 2 * s.camera.half / SIDE;
		const double x = sin(i) * cos(a), y = -cos(i); /* on the screen, y down */
		const double far = away / pixel, rim = 1 / pixel + 2;
		int disc = 0, dash = 0, gap = 0;

		sight->light_azimuth = lights[k][0];
		sight->light_incidence = lights[k][1];
		world_touch(w);
		s.light = false;
		place_draw(w, &s, other);
		s.light = true;
		place_draw(w, &s, pixels);
		for (int row = 0; row < SIDE; row++)
			for (int column = 0; column < SIDE; column++) {
				const double px = column + 0.5 - SIDE / 2.0,
				             py = row + 0.5 - SIDE / 2.0;
				const double along = px * x + py * y, off = fabs(px * y - py * x);
				const double sun = hypot(px - far * x, py - far * y);
				const bool changed = color_apart(pixels[row * SIDE + column],
				                                 other[row * SIDE + column]) > 40;
				if (changed && sun > SUN && (off > NEAR || along < -NEAR))
					fail_msg("light %g,%g: something at %d,%d", lights[k][0],
					         lights[k][1], column, row);
				disc += changed && sun < 5;
				if (off < 0.5 && along > rim && along < far - SUN) {
					dash += changed;
					gap += !changed;
				}
			}
		assert_true(disc > 60);
		assert_true(dash > 6 && gap > 6);
	}
	world_destroy(w);
}

static int all_tests(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_ray_goes_to_the_sun),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void)
{
	return place_tests(all_tests);
}
