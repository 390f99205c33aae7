/* test_view.c - pictures of the view against what is known of them; cameras and picks by their laws. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "ray_scene.h"
#include "view_place.h"

static unsigned pixels[SIDE * SIDE], other[SIDE * SIDE];

static unsigned at(double x, double y)
{
	return pixels[(int)y * SIDE + (int)x];
}

/* How much of the picture is not ground, px; pixels at the rim count by their share. */
static double covered(const struct view_state *s, unsigned full)
{
	const unsigned ground = color_bytes(theme_color(s->theme, TOKEN_VIEW));
	double sum = 0;
	for (int i = 0; i < SIDE * SIDE; i++)
		sum += fmin(1, (double)color_apart(pixels[i], ground) / color_apart(full, ground));
	return sum;
}

/* A sphere's silhouette is a disc, whatever the view and the projection. */
static void sphere_covers_a_disc(void **state)
{
	static const char *const views[] = { "front", "top", "30,20", "10,-70" };
	(void)state;
	for (size_t k = 0; k < sizeof views / sizeof *views; k++) {
		struct world *w = place_world();
		const int id = place_sphere(w, 2, LOOK_MAP);
		struct view_state s = place_state(w, views[k]);
		place_bare(w, id);
		s.quantity = QUANTITY_MEAN; /* one color but for the rim's shade */
		place_draw(w, &s, pixels);
		const double pixel = 2 * s.camera.half / SIDE;
		const double area = M_PI * 4 / (pixel * pixel);
		/* lines at the rim stand half a px beyond it at most */
		const unsigned full = at(SIDE / 2 + 20, SIDE / 2 + 31); /* off the seam */
		assert_true(fabs(covered(&s, full) - area) < 0.01 * area);
		world_destroy(w);
	}
}

static double linear(unsigned byte)
{
	return rgb_to_linear(byte / 255.0);
}

/* In the middle the normal looks at the eye: the light's formula gives the color. */
static void sphere_is_lit_as_by_formula(void **state)
{
	(void)state;
	struct world *w = place_world();
	const int id = place_sphere(w, 2, LOOK_SHADED);
	struct view_state s = place_state(w, "30,20");
	struct sight *sight = world_sight(w);
	sight->light_azimuth = 70;
	sight->light_incidence = 50;
	sight->specular = (struct rgb){ 0, 0, 0 };
	world_touch(w);
	place_bare(w, id);
	place_draw(w, &s, pixels);
	const struct vec3 n = vec3_scale(s.camera.ahead, -1);
	const struct vec3 light = { sin(50 * M_PI / 180) * cos(70 * M_PI / 180),
		                    sin(50 * M_PI / 180) * sin(70 * M_PI / 180),
		                    cos(50 * M_PI / 180) };
	const struct vec3 sky = vec3_unit(vec3_add(s.camera.up, vec3(0, 0, 1)));
	const double facing = 0.72 / sqrt(0.72 * 0.72 + 0.62 * 0.62 + 0.5 * 0.5);
	const double expected = 0.3 * (0.7 + 0.3 * vec3_dot(n, sky)) + 0.4 * facing +
	                        0.5 * fmax(vec3_dot(n, light), 0);
	const unsigned c = at(SIDE / 2.0, SIDE / 2.0);
	static const unsigned base[3] = { 0xC3, 0xCC, 0xD4 };
	for (int k = 0; k < 3; k++) {
		double got = linear(c >> (16 - 8 * k) & 255) / linear(base[k]);
		assert_true(fabs(got - expected) < 0.01);
	}
	world_destroy(w);
}

/* K of a sphere is 1 / R^2 everywhere: the color of that value in the map given. */
static void map_has_the_color_of_its_value(void **state)
{
	static const struct {
		enum quantity quantity;
		double value; /* radius 2, normal outward */
	} cases[] = { { QUANTITY_GAUSSIAN, 0.25 }, { QUANTITY_MEAN, -0.5 },
		      { QUANTITY_ABSOLUTE, 1 },    { QUANTITY_KMIN, -0.5 },
		      { QUANTITY_NORMAL_U, -0.5 }, { QUANTITY_NORMAL_V, -0.5 } };
	(void)state;
	struct world *w = place_world();
	const int id = place_sphere(w, 2, LOOK_MAP);
	place_bare(w, id);
	struct view_state s = place_state(w, "front");
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		const bool is_signed = quantity_table[cases[k].quantity].is_signed;
		const struct colormap map = { .is_signed = is_signed,
			                      .lo = is_signed ? -0.8 : 0,
			                      .hi = 1.2,
			                      .by_hand = true };
		const struct overlay o = { .kind = OVERLAY_MAP,
			                   .thing = id,
			                   .quantity = cases[k].quantity,
			                   .range_given = true,
			                   .lo = map.lo,
			                   .hi = map.hi,
			                   .scale = COLORMAP_LINEAR };
		struct key key;
		assert_int_equal(world_show(w, &o), ST_OK);
		place_draw(w, &s, pixels);
		unsigned expected = color_bytes(colormap_color(&map, cases[k].value));
		assert_in_range(color_apart(at(SIDE / 2 + 5, SIDE / 2 + 5), expected), 0, 3);
		assert_true(view_key(place_view(), &key));
		assert_true(key.map.lo == map.lo && key.map.hi == map.hi);
	}
	world_destroy(w);
}

/* The mask of the picture is that of rays through the pixels' middles, but for a thin rim. */
static void mask_is_that_of_rays(void **state)
{
	static const char *const views[] = { "front", "40,35", "three-quarter:perspective@60" };
	(void)state;
	for (int k = 0; k < 6; k++) {
		struct world *w = place_world();
		const int id = k % 2 ? place_torus(w, LOOK_SHADED) : place_holed(w, LOOK_SHADED);
		const struct entity *e = &world_by_id(w, id)->entity;
		struct view_state s = place_state(w, k % 2 ? views[k / 2] : "30,50");
		const unsigned ground = color_bytes(theme_color(s.theme, TOKEN_VIEW));
		const struct surface *surface = &e->geometry;
		const struct trim *trim = &e->trim;
		struct ray_scene *rays;
		int wrong = 0, hit_count = 0, rim = 0;
		static bool is[SIDE * SIDE];
		assert_int_equal(
		        ray_scene_create_trimmed(&rays, &surface, &trim, 1, 0, &report_none),
		        ST_OK);
		place_draw(w, &s, pixels);
		for (int i = 0; i < SIDE * SIDE; i++) {
			struct ray r = { .near = 0, .far = INFINITY };
			struct ray_hit hit;
			camera_ray(&s.camera, i % SIDE + 0.5, i / SIDE + 0.5, &r.origin,
			           &r.direction);
			ray_scene_hits(rays, &r, 1, false, &hit);
			is[i] = hit.surface >= 0;
			hit_count += is[i];
		}
		for (int y = 2; y < SIDE - 2; y++)
			for (int x = 2; x < SIDE - 2; x++) {
				const int i = y * SIDE + x;
				const bool drawn = color_apart(pixels[i], ground) > 6;
				bool at_rim = false;
				for (int dy = -1; dy <= 1; dy++)
					for (int dx = -1; dx <= 1; dx++)
						at_rim |= is[i + dy * SIDE + dx] != is[i];
				rim += at_rim;
				wrong += !at_rim && drawn != is[i];
			}
		assert_true(hit_count > SIDE * SIDE / 10 && rim < hit_count / 4);
		assert_int_equal(wrong, 0);
		ray_scene_destroy(rays);
		world_destroy(w);
	}
}

/* Coarse while moving, and the same but for the rim. */
static void moving_is_coarse_but_the_same(void **state)
{
	(void)state;
	struct world *w = place_world();
	place_bare(w, place_torus(w, LOOK_SHADED));
	struct view_state s = place_state(w, "three-quarter");
	int far = 0;
	place_draw(w, &s, pixels);
	memcpy(other, pixels, sizeof other);
	s.moving = true;
	place_draw(w, &s, pixels);
	for (int i = 0; i < SIDE * SIDE; i++)
		far += color_apart(pixels[i], other[i]) > 24;
	assert_true(far < SIDE * SIDE / 40);
	s.moving = false;
	place_draw(w, &s, pixels);
	assert_memory_equal(pixels, other, sizeof other);
	world_destroy(w);
}

/* What is drawn follows the world: color, on and off, geometry, undo. */
static void drawing_follows_the_world(void **state)
{
	(void)state;
	struct world *w = place_world();
	const int id = place_sphere(w, 1, LOOK_SHADED);
	struct view_state s = place_state(w, "front");
	const unsigned ground = color_bytes(theme_color(s.theme, TOKEN_VIEW));
	struct display d = world_by_id(w, id)->display;
	place_draw(w, &s, other);
	d.on = false;
	assert_int_equal(world_set_display(w, id, &d), ST_OK);
	place_draw(w, &s, pixels);
	for (int i = 0; i < SIDE * SIDE; i++)
		assert_int_equal(pixels[i], ground);
	d.on = true;
	assert_int_equal(world_set_display(w, id, &d), ST_OK);
	struct entity smaller;
	entity_init(&smaller, ENTITY_SURFACE);
	assert_int_equal(make_sphere(&smaller.geometry, vec3(0, 0, 0), 0.3), ST_OK);
	assert_int_equal(world_replace(w, "shrink", id, &smaller, &report_none), ST_OK);
	place_draw(w, &s, pixels);
	assert_int_equal(at(SIDE / 2.0, SIDE / 4.0), ground);
	assert_int_equal(world_undo(w, &report_none), ST_OK);
	place_draw(w, &s, pixels);
	assert_memory_equal(pixels, other, sizeof other);
	world_destroy(w);
}

/* A line of w px crosses a row with that much ink. */
static void lines_are_as_wide_as_asked(void **state)
{
	static const double scales[] = { 1, 1.5, 2, 3 };
	(void)state;
	for (size_t k = 0; k < sizeof scales / sizeof *scales; k++) {
		struct world *w = place_world();
		struct curve c;
		assert_int_equal(make_line(&c, vec3(-1, 0, -1), vec3(0.7, 0, 1)), ST_OK);
		const int id = place_curve(w, &c);
		struct view_state s = place_state(w, "front");
		const double slope = 1.7 / 2; /* across to along the rows */
		const unsigned ground = color_bytes(theme_color(s.theme, TOKEN_VIEW));
		const unsigned ink = color_bytes(theme_color(s.theme, TOKEN_CURRENT));
		double sum = 0;
		(void)id;
		s.scale = scales[k];
		place_draw(w, &s, pixels);
		for (int y = SIDE / 2 - 10; y < SIDE / 2 + 10; y++)
			for (int x = 0; x < SIDE; x++) {
				/* the casing is nearly the ground's color */
				int c_apart = (int)(ground >> 8 & 255) -
				              (int)(pixels[y * SIDE + x] >> 8 & 255);
				sum += c_apart /
				       (double)((int)(ground >> 8 & 255) - (int)(ink >> 8 & 255));
			}
		double width = sum / 20 / sqrt(1 + slope * slope);
		assert_true(fabs(width - 2 * scales[k]) < 0.1 * scales[k]);
		world_destroy(w);
	}
}

static void project(const struct view_state *s, struct vec3 p, double *x, double *y)
{
	double depth;
	assert_true(camera_project(&s->camera, p, x, y, &depth));
}

static void assert_camera(const struct camera *c)
{
	assert_true(fabs(vec3_length(c->right) - 1) < 1e-12);
	assert_true(fabs(vec3_length(c->up) - 1) < 1e-12);
	assert_true(vec3_length(vec3_add(vec3_cross(c->right, c->up), c->ahead)) < 1e-12);
	assert_true(fabs(c->right.z) < 1e-9 && c->up.z > -1e-9);
}

static void cameras_obey_their_laws(void **state)
{
	static const char *const views[] = { "three-quarter", "top", "front:perspective", "-20,60",
		                             "12,-34:perspective@60" };
	(void)state;
	struct world *w = place_world();
	place_torus(w, LOOK_SHADED);
	for (size_t k = 0; k < sizeof views / sizeof *views; k++) {
		struct view_state s = place_state(w, views[k]), before = s;
		double x0, y0, x1, y1;
		/* there and back */
		project(&s, vec3(0, 0, 0), &x0, &y0);
		view_rotate(&s, w, 25, 7);
		assert_camera(&s.camera);
		project(&s, vec3(0, 0, 0), &x1, &y1);
		assert_true(hypot(x1 - x0, y1 - y0) < 1e-6); /* its middle stays */
		view_rotate(&s, w, -25, 0);
		view_rotate(&s, w, 0, -7);
		if (k != 1) /* at the top it stops */
			assert_true(vec3_length(vec3_sub(s.camera.eye, before.camera.eye)) < 1e-9);
		/* never over the top */
		view_rotate(&s, w, 0, 400);
		assert_camera(&s.camera);
		assert_true(s.camera.ahead.z < -1 + 1e-9);
		/* what is near goes to the right */
		s = before;
		struct vec3 near = vec3_along(vec3(0, 0, 0), -2, s.camera.ahead);
		project(&s, near, &x0, &y0);
		view_rotate(&s, w, 1, 0);
		project(&s, near, &x1, &y1);
		assert_true(k == 1 || x1 > x0);
		/* pan moves what is in the middle with the mouse */
		s = before;
		project(&s, s.pivot, &x0, &y0);
		view_pan(&s, 13, -5);
		project(&s, before.pivot, &x1, &y1);
		assert_true(hypot(x1 - x0 - 13, y1 - y0 + 5) < 1e-6);
		/* zoom keeps what is under the cursor */
		struct vec3 o, d;
		camera_ray(&s.camera, 70, 150, &o, &d);
		struct vec3 there = vec3_along(o, 20, d); /* still before the eye */
		view_zoom(&s, w, 1.7, 70, 150);
		project(&s, there, &x1, &y1);
		assert_true(hypot(x1 - 70, y1 - 150) < 1e-6);
		view_zoom(&s, w, 1 / 1.7, 70, 150);
		/* the other projection: the middle is as large */
		s = before;
		const double pixel = camera_pixel(&s.camera, vec3(0, 0, 0));
		view_project(&s, w, CAMERA_PERSPECTIVE);
		view_project(&s, w, CAMERA_ORTHOGRAPHIC);
		assert_true(fabs(camera_pixel(&s.camera, vec3(0, 0, 0)) / pixel - 1) < 1e-6);
		/* fit keeps the direction */
		s = before;
		view_zoom(&s, w, 9, 10, 10);
		assert_int_equal(view_fit(&s, w, NULL, SIDE, SIDE, &report_none), ST_OK);
		assert_true(vec3_length(vec3_sub(s.camera.ahead, before.camera.ahead)) < 1e-6);
		assert_true(vec3_length(vec3_sub(s.camera.eye, before.camera.eye)) < 1e-3);
	}
	world_destroy(w);
}

/* A point of a surface, seen, is picked with its own u, v in one of the layers. */
static void picks_find_surface_points(void **state)
{
	static const char *const views[] = { "three-quarter", "top", "-60,30:perspective" };
	enum { STEPS = 9, LAYERS = 6 };
	(void)state;
	struct world *w = place_world();
	const int torus = place_torus(w, LOOK_SHADED), holed = place_holed(w, LOOK_WIRE);
	for (size_t k = 0; k < sizeof views / sizeof *views; k++) {
		struct view_state s = place_state(w, views[k]);
		int found = 0, tried = 0;
		for (int i = 0; i < STEPS * STEPS; i++) {
			const struct surface *t = &world_by_id(w, torus)->entity.geometry;
			double u = 2 * M_PI * (i / STEPS + 0.37) / STEPS;
			double v = 2 * M_PI * (i % STEPS + 0.61) / STEPS, x, y;
			struct vec3 p = surface_point(t, u, v), n, o, d;
			project(&s, p, &x, &y);
			camera_ray(&s.camera, x, y, &o, &d);
			assert_true(surface_normal(t, u, v, &n));
			if (fabs(vec3_dot(n, d)) < 0.2) /* at the rim u, v are ill defined */
				continue;
			tried++;
			for (int skip = 0; skip < LAYERS; skip++) {
				struct pick pick;
				assert_int_equal(
				        view_pick(place_view(), w, &s, x, y, false, skip, &pick),
				        ST_OK);
				if (!pick.thing)
					break;
				found += pick.thing == torus && fabs(pick.u - u) < 1e-6 &&
				         fabs(pick.v - v) < 1e-6 &&
				         vec3_length(vec3_sub(pick.point, p)) < 1e-7;
			}
		}
		assert_true(tried > 40);
		assert_int_equal(found, tried);
	}
	/* through the hole there is nothing, beside it the square */
	struct view_state s = place_state(w, "top");
	struct pick pick;
	double x, y;
	project(&s, vec3(0.1, 0.2, 0), &x, &y);
	assert_int_equal(view_pick(place_view(), w, &s, x, y, false, 0, &pick), ST_OK);
	assert_int_equal(pick.thing, 0);
	project(&s, vec3(0.6, 0.6, 0), &x, &y);
	assert_int_equal(view_pick(place_view(), w, &s, x, y, false, 0, &pick), ST_OK);
	assert_int_equal(pick.thing, holed);
	assert_true(fabs(pick.u - 0.8) < 1e-6 && fabs(pick.v - 0.8) < 1e-6);
	world_destroy(w);
}

static void picks_reach_curves_and_points(void **state)
{
	(void)state;
	struct world *w = place_world();
	struct curve c;
	assert_int_equal(make_arc(&c, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 0, 1), 1.5, 0.2, 2.9),
	                 ST_OK);
	const int sphere = place_sphere(w, 1, LOOK_SHADED), arc = place_curve(w, &c);
	struct display d = world_by_id(w, arc)->display;
	d.net = true;
	assert_int_equal(world_set_display(w, arc, &d), ST_OK);
	struct view_state s = place_state(w, "front");
	const struct curve *own = &world_by_id(w, arc)->entity.curve;
	for (int i = 1; i < 20; i++) {
		double t = 0.2 + 2.7 * i / 20, x, y;
		struct pick pick;
		/* 5 px off it across, the nearest point is the same */
		struct vec3 p = curve_point(own, t), off = vec3_unit(p);
		project(&s, vec3_along(p, 5 * camera_pixel(&s.camera, p), off), &x, &y);
		assert_int_equal(view_pick(place_view(), w, &s, x, y, false, 0, &pick), ST_OK);
		assert_int_equal(pick.thing, arc);
		assert_false(pick.is_point);
		assert_true(fabs(pick.u - t) < 1e-4);
		project(&s, vec3_along(p, 11 * camera_pixel(&s.camera, p), off), &x, &y);
		assert_int_equal(view_pick(place_view(), w, &s, x, y, false, 0, &pick), ST_OK);
		assert_int_equal(pick.thing, 0);
	}
	for (int i = 0; i < own->n; i++) {
		double weight, x, y;
		struct pick pick;
		project(&s, curve_get_point(own, i, &weight), &x, &y);
		assert_int_equal(view_pick(place_view(), w, &s, x + 3, y - 3, true, 0, &pick),
		                 ST_OK);
		assert_true(pick.is_point && pick.thing == arc && pick.index == i);
		assert_int_equal(view_pick(place_view(), w, &s, x + 3, y - 3, false, 0, &pick),
		                 ST_OK);
		assert_false(pick.is_point);
	}
	struct pick pick;
	assert_int_equal(view_pick(place_view(), w, &s, SIDE / 2.0, SIDE / 2.0, false, 0, &pick),
	                 ST_OK);
	assert_int_equal(pick.thing, sphere);
	world_destroy(w);
}

/* An empty world, a world of points in u, v, a size of one px. */
static void little_is_drawn_too(void **state)
{
	(void)state;
	struct world *w = place_world();
	struct view_state s = place_state(w, "front");
	const unsigned ground = color_bytes(theme_color(s.theme, TOKEN_VIEW));
	bool more;
	struct pick pick;
	place_draw(w, &s, pixels);
	for (int i = 0; i < SIDE * SIDE; i++)
		assert_int_equal(pixels[i], ground);
	assert_int_equal(view_draw(place_view(), w, &s, 0, 0, 1, 1, &more, &report_none), ST_OK);
	assert_int_equal(view_draw(place_view(), w, &s, 0, 0, 0, 5, &more, &report_none), ST_OK);
	assert_int_equal(view_pick(place_view(), w, &s, 3, 3, true, 0, &pick), ST_OK);
	assert_int_equal(pick.thing, 0);
	view_rotate(&s, w, 3, 4);
	view_zoom(&s, w, 2, 10, 10);
	view_pan(&s, 3, 4);
	world_destroy(w);
}

static int all_tests(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(sphere_covers_a_disc),
		cmocka_unit_test(sphere_is_lit_as_by_formula),
		cmocka_unit_test(map_has_the_color_of_its_value),
		cmocka_unit_test(mask_is_that_of_rays),
		cmocka_unit_test(moving_is_coarse_but_the_same),
		cmocka_unit_test(drawing_follows_the_world),
		cmocka_unit_test(lines_are_as_wide_as_asked),
		cmocka_unit_test(cameras_obey_their_laws),
		cmocka_unit_test(picks_find_surface_points),
		cmocka_unit_test(picks_reach_curves_and_points),
		cmocka_unit_test(little_is_drawn_too),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void)
{
	return place_tests(all_tests);
}
