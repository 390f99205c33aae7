/* test_view_gaps.c - no ground shines through where rays meet surfaces: between neighbours, along seams. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "model.h"
#include "ray_scene.h"
#include "text.h"
#include "view_place.h"

enum { SURFACES_MAX = 64 };

static unsigned pixels[SIDE * SIDE];

struct shapes_read {
	struct world *world;
	struct ray_scene *rays;
};

/* Every surface of a file, shaded, without lines inside. False: the file is not here. */
static bool read_shapes(struct shapes_read *out, const char *folder, const char *name)
{
	const struct surface *surfaces[SURFACES_MAX];
	const struct trim *trims[SURFACES_MAX];
	struct model m;
	char *path = folder ? text_print("%s/%s", folder, name) : NULL;
	int n = 0;
	if (!path || model_read(&m, path, NULL, &report_none) != ST_OK) {
		free(path);
		return false;
	}
	free(path);
	out->world = place_world();
	for (int i = 0; i < m.n && n < SURFACES_MAX; i++) {
		if (m.entities[i].kind != ENTITY_SURFACE)
			continue;
		struct entity *e = &m.entities[i];
		int id = place_surface(out->world, &e->geometry, &e->trim, LOOK_SHADED);
		memset(&e->geometry, 0, sizeof e->geometry);
		memset(&e->trim, 0, sizeof e->trim);
		place_bare(out->world, id);
		const struct entity *kept = &world_by_id(out->world, id)->entity;
		surfaces[n] = &kept->geometry;
		trims[n++] = &kept->trim;
	}
	model_finish(&m);
	assert_true(n > 0);
	assert_int_equal(ray_scene_create_trimmed(&out->rays, surfaces, trims, n, 0, &report_none),
	                 ST_OK);
	return true;
}

/* How red the ground shines through. Surfaces are grey. */
static int red(unsigned p)
{
	return (int)(p >> 16 & 255) - (int)(p >> 8 & 255);
}

/* Rays meet surfaces in all of a pixel and some way round it. */
static bool is_inside(const struct ray_scene *rays, const struct camera *c, int i)
{
	static const double at[9][2] = { { 0, 0 },    { -1, -1 }, { 1, -1 },   { -1, 1 }, { 1, 1 },
		                         { -0.5, 0 }, { 0.5, 0 }, { 0, -0.5 }, { 0, 0.5 } };
	bool inside = true;
	for (int k = 0; k < 9 && inside; k++) {
		struct ray r = { .near = 0, .far = INFINITY };
		struct ray_hit hit;
		camera_ray(c, i % SIDE + 0.5 + at[k][0], i / SIDE + 0.5 + at[k][1], &r.origin,
		           &r.direction);
		ray_scene_hits(rays, &r, 1, false, &hit);
		inside = hit.surface >= 0;
	}
	return inside;
}

static int count_gaps(const struct shapes_read *x, const struct view_state *s, int *covered)
{
	int gaps = 0;
	place_draw(x->world, s, pixels);
	for (int i = 0; i < SIDE * SIDE; i++)
		if (red(pixels[i]) <= 6)
			++*covered;
		else
			gaps += is_inside(x->rays, &s->camera, i);
	return gaps;
}

/* Look at a border's point in the middle of the picture, that much larger. */
static void look_at_border(struct view_state *s, const struct world *w, int k, double zoom)
{
	const struct surface *f = &world_at(w, k / 4)->entity.geometry;
	const int d = k & 1, end = k >> 1 & 1;
	double uv[2], x, y, depth;
	uv[d] = f->domain[d][end];
	uv[1 - d] = 0.47 * f->domain[1 - d][0] + 0.53 * f->domain[1 - d][1];
	if (!camera_project(&s->camera, surface_point(f, uv[0], uv[1]), &x, &y, &depth))
		return;
	view_pan(s, SIDE / 2.0 - x, SIDE / 2.0 - y);
	view_zoom(s, w, zoom, SIDE / 2.0, SIDE / 2.0);
}

/* At rest and while it is moved. */
static void look_for_gaps(const struct shapes_read *x, double zoom, int step, int *covered)
{
	for (int k = 0; k < 4 * world_count(x->world); k += step) {
		struct view_state s = place_state(x->world, "35,25");
		look_at_border(&s, x->world, k, zoom);
		assert_int_equal(count_gaps(x, &s, covered), 0);
		s.moving = true;
		assert_int_equal(count_gaps(x, &s, covered), 0);
	}
}

static void no_ground_shines_through(void **state)
{
	static const struct {
		const char *folder, *name;
	} files[] = {
		{ "BATTEN_EXAMPLES", "hull.igs" },
		{ "BATTEN_EXAMPLES", "propeller.igs" },
		{ "BATTEN_EXAMPLES", "teapot.igs" },
		{ "BATTEN_DATA", "goteborg.iges" },
	};
	static const double zooms[] = { 1, 4, 40 };
	(void)state;
	for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
		struct shapes_read x;
		int covered = 0;
		if (!read_shapes(&x, getenv(files[k].folder), files[k].name))
			continue;
		struct sight *sight = world_sight(x.world);
		sight->has_background = true;
		sight->background = (struct rgb){ 1, 0, 0 };
		world_touch(x.world);
		const int borders = 4 * world_count(x.world);
		for (size_t z = 0; z < sizeof zooms / sizeof *zooms; z++)
			look_for_gaps(&x, zooms[z], zooms[z] > 1 ? 2 + borders / 3 : borders,
			              &covered);
		assert_true(covered > SIDE * SIDE);
		ray_scene_destroy(x.rays);
		world_destroy(x.world);
	}
}

static int all_tests(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(no_ground_shines_through),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void)
{
	return place_tests(all_tests);
}
