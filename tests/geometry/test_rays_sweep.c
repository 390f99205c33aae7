/* test_rays_sweep.c - random surfaces of orders 2 to 8, rational and trimmed: what a ray finds in a
 * coherent packet, in a mixed one and by itself, and what it is told when it only asks whether
 * anything is in the way. `test-rays_sweep N`: N times as many surfaces. */
#include "box.h"
#include "cmocka_all.h"
#include "ray_shapes.h"
#include "trim_shapes.h"

enum { RAYS = 400, ORDER_LOW = 2, ORDER_HIGH = 8 };

struct sweep {
	struct ray_scene *scene;
	struct box box;
	uint64_t seed;
	struct ray rays[RAYS];
	struct ray_hit hits[RAYS];
	size_t n_hits, n_touching;
};

/* Through the box from without, close together or each its own way. */
static void rays_from_without(struct sweep *s, bool together)
{
	const double size = box_diagonal(&s->box);
	struct vec3 eye = vec3_along(box_center(&s->box), 2 * size, random_direction(&s->seed));
	for (int i = 0; i < RAYS; i++) {
		struct vec3 at = vec3_along(box_center(&s->box), size * shape_random(&s->seed) / 2,
		                            random_direction(&s->seed));
		if (!together)
			eye = vec3_along(at, 2 * size, random_direction(&s->seed));
		s->rays[i] = (struct ray){ eye, vec3_unit(vec3_sub(at, eye)), 0, INFINITY };
	}
}

/* From where the last ones hit, one way or many; some end before they may meet anything. */
static void rays_from_hits(struct sweep *s, bool together)
{
	const double size = box_diagonal(&s->box);
	struct vec3 d = random_direction(&s->seed);
	for (int i = 0; i < RAYS; i++) {
		struct ray *r = &s->rays[i];
		if (!together)
			d = random_direction(&s->seed);
		if (s->hits[i].surface >= 0)
			r->origin = s->hits[i].point;
		r->direction = d;
		r->near = 1e-4 * size;
		r->far = i % 4 ? INFINITY : size * shape_random(&s->seed);
	}
}

/* Of a hit and none, or of two hits far apart, one must only be touched, or at an end of the ray. */
static bool may_differ(const struct sweep *s, const struct ray *r, const struct ray_hit *a,
                       const struct ray_hit *b)
{
	const struct ray_hit *both[2] = { a, b };
	const double size = box_diagonal(&s->box);
	for (int k = 0; k < 2; k++) {
		const struct ray_hit *h = both[k];
		if (h->surface >= 0 &&
		    (fabs(vec3_dot(h->normal, r->direction)) < 1e-4 ||
		     fabs(h->t - r->near) < 1e-9 * size || fabs(h->t - r->far) < 1e-9 * size))
			return true;
	}
	return false;
}

static void check(struct sweep *s)
{
	struct ray_hit mixed[RAYS];
	bool blocked[RAYS];
	const double size = box_diagonal(&s->box);

	ray_scene_hits(s->scene, s->rays, RAYS, true, s->hits);
	ray_scene_hits(s->scene, s->rays, RAYS, false, mixed);
	ray_scene_blocked(s->scene, s->rays, RAYS, blocked);
	for (int i = 0; i < RAYS; i++) {
		const struct ray *r = &s->rays[i];
		const struct ray_hit *h = &s->hits[i];
		const bool hit = h->surface >= 0;
		struct ray_hit one;

		assert_int_equal(mixed[i].surface, h->surface);
		assert_memory_equal(&mixed[i].t, &h->t, sizeof *h - offsetof(struct ray_hit, t));
		ray_scene_hit(s->scene, r, &one);
		s->n_hits += hit;
		if (one.surface != h->surface ||
		    (hit &&
		     fabs(one.t - h->t) >
		             1e-11 * size / fmax(fabs(vec3_dot(h->normal, r->direction)), 1e-4))) {
			assert_true(may_differ(s, r, &one, h));
			s->n_touching++;
			continue;
		}
		if (blocked[i] != hit || ray_scene_is_blocked(s->scene, r) != hit) {
			assert_true(hit && may_differ(s, r, &one, h));
			s->n_touching++;
		}
	}
}

static struct trim some_holes(const struct surface *x, uint64_t *seed)
{
	struct trim t = { 0 };
	const double *u = x->domain[0], *v = x->domain[1];
	const double du = u[1] - u[0], dv = v[1] - v[0];
	trim_add_ellipse(&t, true, (u[0] + u[1]) / 2, (v[0] + v[1]) / 2, 0.46 * du, 0.43 * dv, 0.3);
	for (int k = 0; k < 4; k++)
		trim_add_ellipse(&t, false, u[0] + du * (0.35 + 0.3 * (k % 2)),
		                 v[0] + dv * (0.35 + 0.3 * (double)(k > 1)),
		                 du * (0.03 + 0.1 * shape_random(seed)), dv * 0.1, k);
	return t;
}

static void sweep_surface(struct sweep *s, const struct surface *x, const struct trim *t)
{
	assert_int_equal(ray_scene_create_trimmed(&s->scene, &x, &t, 1, 0, NULL), ST_OK);
	s->box = ray_scene_box(s->scene);
	for (int together = 0; together < 2; together++) {
		rays_from_without(s, together);
		check(s);
		rays_from_hits(s, together);
		check(s);
	}
	ray_scene_destroy(s->scene);
}

static void all_ways_find_the_same(void **state)
{
	static const enum shape_knots knots[] = { KNOTS_CLAMPED, KNOTS_OPEN, KNOTS_UNEVEN,
		                                  KNOTS_DOUBLE };
	const int times = *(const int *)*state;
	struct sweep *s = calloc(1, sizeof *s);
	assert_non_null(s);
	for (int k = 0; k < times; k++)
		for (int order = ORDER_LOW; order <= ORDER_HIGH; order++)
			for (int kind = 0; kind < 4; kind++) {
				s->seed = 1000003 * (uint64_t)k + 31 * (uint64_t)order + kind;
				const int other = ORDER_LOW + (order + 3 * kind + k) % 7;
				const bool rational = kind & 1;
				struct surface x = shape_surface(
				        (int[2]){ order, other },
				        (int[2]){ order + 2 + k % 3, other + 3 }, rational,
				        order > 3 && other > 3 ? knots[(order + kind) % 4]
				                               : KNOTS_CLAMPED,
				        s->seed);
				struct trim t = { 0 };
				if (kind & 2)
					t = some_holes(&x, &s->seed);
				sweep_surface(s, &x, &t);
				trim_finish(&t);
				surface_finish(&x);
			}
	assert_true(s->n_hits > (size_t)times * 7 * 4 * RAYS);
	assert_true(s->n_touching < s->n_hits / 10000);
	print_message("# %zu hits, %zu of rays that only touch\n", s->n_hits, s->n_touching);
	free(s);
}

int main(int argc, char **argv)
{
	int times = argc > 1 ? atoi(argv[1]) : 4;
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_prestate(all_ways_find_the_same, &times),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
