/* test_examples.c - the example shapes are what they say: closed, outward, fair, by their formulas. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "example.h"

static void make(example_make *make_shape, struct model *m)
{
	model_init(m);
	assert_int_equal(make_shape(m, NULL), ST_OK);
	for (int i = 0; i < m->n; i++)
		assert_int_equal(surface_check(&m->entities[i].geometry, m->entities[i].name, NULL),
		                 ST_OK);
}

static const struct surface *part(const struct model *m, const char *name)
{
	for (int i = 0; i < m->n; i++)
		if (strcmp(m->entities[i].name, name) == 0)
			return &m->entities[i].geometry;
	fail_msg("no surface '%s'", name);
	return NULL;
}

/* Volume that the surface's cone to `from` has, positive where N points away; Gauss' theorem. */
static double volume(const struct surface *s, struct vec3 from)
{
	enum { N = 160 };
	double sum = 0, h[2];
	for (int d = 0; d < 2; d++)
		h[d] = (s->domain[d][1] - s->domain[d][0]) / N;
	for (int i = 0; i < N; i++) {
		for (int j = 0; j < N; j++) {
			struct vec3 p, du, dv;
			surface_tangents(s, s->domain[0][0] + (i + 0.5) * h[0],
			                 s->domain[1][0] + (j + 0.5) * h[1], &p, &du, &dv);
			sum += vec3_dot(vec3_sub(p, from), vec3_cross(du, dv)) * h[0] * h[1] / 3;
		}
	}
	return sum;
}

static double model_volume(const struct model *m)
{
	double sum = 0;
	for (int i = 0; i < m->n; i++)
		sum += volume(&m->entities[i].geometry, vec3(0, 0, 0));
	return sum;
}

/* Point at t in [0, 1] of border `d` = lower (end 0) or upper (end 1). */
static struct vec3 border(const struct surface *s, int d, int end, double t)
{
	const double *along = s->domain[1 - d];
	double w = t == 1 ? along[1] : along[0] + t * (along[1] - along[0]);
	return d == 0 ? surface_point(s, s->domain[0][end], w)
	              : surface_point(s, w, s->domain[1][end]);
}

/* Borders agree, run the same way or, with `turned`, against each other. */
static void check_joined(const struct surface *a, int da, int ea, const struct surface *b, int db,
                         int eb, bool turned)
{
	for (int i = 0; i <= 200; i++) {
		double t = i / 200.0;
		struct vec3 gap =
		        vec3_sub(border(a, da, ea, t), border(b, db, eb, turned ? 1 - t : t));
		assert_true(vec3_length(gap) < 1e-12 * fmax(surface_size(a), 1));
	}
}

/* Point of the port side at height z on line v; false where the side does not reach it. */
static bool waterline_point(const struct surface *s, double v, double z, struct vec3 *p)
{
	double lo = 0, hi = 1;
	if (surface_point(s, 0, v).z > z || surface_point(s, 1, v).z < z)
		return false;
	for (int i = 0; i < 50; i++) {
		double mid = (lo + hi) / 2;
		*p = surface_point(s, mid, v);
		if (p->z < z)
			lo = mid;
		else
			hi = mid;
	}
	return true;
}

/* How often the curvature of the waterline at z changes its sign; the breadth may not wave. */
static int waterline_turns(const struct surface *side, double z)
{
	enum { N = 1200, STEP = 6 };
	struct vec3 p[N + 1];
	int n = 0, turns = 0, last = 0;
	for (int i = 0; i <= N; i++)
		n += waterline_point(side, (double)i / N, z, &p[n]);
	assert_true(n > N / 2);
	for (int i = STEP; i < n - STEP; i++) {
		struct vec3 a = vec3_sub(p[i], p[i - STEP]), b = vec3_sub(p[i + STEP], p[i]);
		double la = vec3_length(a), lb = vec3_length(b);
		double curvature = 2 * (a.x * b.y - a.y * b.x) / (la * lb * (la + lb));
		if (fabs(curvature) < 2e-5) /* radius 50 km: straight */
			continue;
		int sign = curvature > 0 ? 1 : -1;
		turns += last != 0 && sign != last;
		last = sign;
	}
	return turns;
}

static void test_hull(void **state)
{
	(void)state;
	struct model m;
	make(example_hull, &m);
	assert_int_equal(m.n, 4);
	const struct surface *port = part(&m, "hull port"), *starboard = part(&m, "hull starboard");
	const struct surface *deck = part(&m, "deck"), *transom = part(&m, "transom");
	/* keel, stem; port is u from keel to deck, v from transom to stem; starboard has u turned */
	check_joined(port, 0, 0, starboard, 0, 1, false);
	check_joined(port, 1, 1, starboard, 1, 1, true);
	check_joined(port, 0, 1, deck, 1, 0, true);
	check_joined(starboard, 0, 0, deck, 1, 1, true);
	check_joined(port, 1, 0, transom, 1, 1, false);
	check_joined(starboard, 1, 0, transom, 1, 0, true);
	check_joined(transom, 0, 1, deck, 0, 1, true);
	for (int i = 0; i < m.n; i++) /* closed, so any point inside gives the same; all outward */
		assert_true(volume(&m.entities[i].geometry, vec3(60, 0, 6)) > 0);
	double all = model_volume(&m);
	assert_true(all > 0.6 * 142 * 19 * 11 && all < 0.9 * 142 * 19 * 11);
	/* under water two turns, in and out of the hollow behind the bulb; none above */
	static const double under[] = { 1, 2, 3, 4 }, above[] = { 7, 8, 9, 10, 11 };
	for (int i = 0; i < 4; i++)
		assert_int_equal(waterline_turns(port, under[i]), 2);
	for (int i = 0; i < 5; i++)
		assert_int_equal(waterline_turns(port, above[i]), 0);
	/* the stem crosses the centre plane at right angles */
	for (int i = 4; i <= 20; i++) {
		struct vec3 p, du, dv;
		surface_tangents(port, i / 20.0, port->domain[1][1], &p, &du, &dv);
		assert_true(fabs(p.y) < 1e-14 && fabs(vec3_unit(dv).y) > 1 - 1e-15);
	}
	model_finish(&m);
}

static void test_wigley(void **state)
{
	(void)state;
	struct model m;
	make(example_wigley, &m);
	for (int k = 0; k < 2; k++) {
		const struct surface *s = part(&m, k ? "wigley starboard" : "wigley port");
		for (int i = 0; i <= 400; i++) {
			struct vec3 p = surface_point(s, i % 21 / 20.0, i / 400.0);
			double x = p.x / 50, z = p.z / 6.25, y = 5 * (1 - x * x) * (1 - z * z);
			assert_true(fabs(fabs(p.y) - y) < 1e-14 && (k ? p.y <= 0 : p.y >= 0));
		}
	}
	assert_true(fabs(model_volume(&m) - 4.0 / 9 * 100 * 10 * 6.25) < 0.1);
	model_finish(&m);
}

static void test_teapot(void **state)
{
	(void)state;
	static const char *const rings[] = { "rim",      "upper body", "lower body",
		                             "lid knob", "lid",        "bottom" };
	struct model m;
	make(example_teapot, &m);
	assert_int_equal(m.n, 32);
	for (int i = 0; i < 32; i++)
		assert_true(volume(&m.entities[i].geometry, vec3(0, 0, 1.2)) > 0);
	for (int k = 0; k < 6; k++) {
		for (int i = 0; i < 4; i++) {
			char one[32], next[32];
			snprintf(one, sizeof one, "%s %d", rings[k], i + 1);
			snprintf(next, sizeof next, "%s %d", rings[k], (i + 1) % 4 + 1);
			check_joined(part(&m, one), 1, 1, part(&m, next), 1, 0, false);
		}
	}
	check_joined(part(&m, "rim 2"), 0, 1, part(&m, "upper body 2"), 0, 0, false);
	check_joined(part(&m, "upper body 3"), 0, 1, part(&m, "lower body 3"), 0, 0, false);
	check_joined(part(&m, "lower body 4"), 0, 1, part(&m, "bottom 4"), 0, 0, false);
	check_joined(part(&m, "lid knob 1"), 0, 1, part(&m, "lid 1"), 0, 0, false);
	check_joined(part(&m, "upper handle port"), 0, 1, part(&m, "lower handle port"), 0, 0,
	             false);
	check_joined(part(&m, "lower spout port"), 0, 1, part(&m, "upper spout port"), 0, 0, false);
	model_finish(&m);
}

static void test_naca(void **state)
{
	(void)state;
	struct model m;
	make(example_naca, &m);
	const struct surface *wing = part(&m, "wing"), *tip = part(&m, "tip");
	check_joined(wing, 0, 0, wing, 0, 1, false); /* sharp trailing edge */
	/* wing's u runs against the section's, over the lower side first */
	for (int i = 0; i <= 100; i++) {
		double t = i / 200.0;
		struct vec3 lower = surface_point(wing, t, 1),
		            upper = surface_point(wing, 1 - t, 1);
		assert_true(vec3_length(vec3_sub(surface_point(tip, t, 0), lower)) < 1e-12);
		assert_true(vec3_length(vec3_sub(surface_point(tip, t, 1), upper)) < 1e-12);
	}
	/* the root's NACA 2412, chord 2: published ordinates at 0.3 of the chord */
	int seen = 0;
	for (int i = 0; i <= 20000; i++) {
		struct vec3 p = surface_point(wing, i / 20000.0, 0);
		assert_true(p.y == 0 && p.x > -1e-3 && p.x < 2 + 1e-12);
		if (fabs(p.x - 0.6) < 2e-4) {
			assert_true(fabs(p.z / 2 - (p.z > 0 ? 0.0788 : -0.0412)) < 1e-4);
			seen |= p.z > 0 ? 1 : 2;
		}
	}
	assert_int_equal(seen, 3);
	for (int i = 0; i < 2; i++)
		assert_true(volume(&m.entities[i].geometry, vec3(2, 3, 0.2)) > 0);
	model_finish(&m);
}

static void test_propeller(void **state)
{
	(void)state;
	struct model m;
	make(example_propeller, &m);
	assert_int_equal(m.n, 4);
	const struct surface *blade = part(&m, "blade 1");
	check_joined(blade, 0, 0, blade, 0, 1, false); /* sharp trailing edge */
	assert_true(surface_degenerate(blade, 1, 1, 1e-14));
	/* sections lie on cylinders; chord and pitch of the published radius 0.7 */
	double s = 1 - sqrt(0.3 / 0.8), wide = 0;
	struct vec3 tail = surface_point(blade, 0, s);
	for (int i = 0; i <= 400; i++) {
		struct vec3 p = surface_point(blade, i / 400.0, s);
		assert_true(fabs(hypot(p.y, p.z) - 0.35) < 2e-5);
		double around = 0.35 * (atan2(-p.y, p.z) - atan2(-tail.y, tail.z));
		wide = fmax(wide, hypot(p.x - tail.x, around));
	}
	assert_true(fabs(wide - 0.4622) < 2e-3);
	assert_true(volume(blade, vec3(0, 0, 0.3)) > 0);
	assert_true(volume(part(&m, "hub"), vec3(0, 0, 0)) > 0);
	model_finish(&m);
}

static void test_bodies(void **state)
{
	(void)state;
	struct model m;
	make(example_sphere, &m);
	assert_true(fabs(model_volume(&m) / (4.0 / 3 * M_PI * 1000) - 1) < 1e-3);
	model_finish(&m);
	make(example_torus, &m);
	assert_true(fabs(model_volume(&m) / (2 * M_PI * M_PI * 10 * 16) - 1) < 1e-3);
	model_finish(&m);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_hull),      cmocka_unit_test(test_wigley),
		cmocka_unit_test(test_teapot),    cmocka_unit_test(test_naca),
		cmocka_unit_test(test_propeller), cmocka_unit_test(test_bodies),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
