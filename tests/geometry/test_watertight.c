/* test_watertight.c - laws of closed shapes made of many faces, at tolerances from fine to coarse. */
#include "cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include "construct.h"
#include "mesh_look.h"
#include "refine.h"
#include "tessellate.h"
#include "trim_shapes.h"

static const double pi = 3.14159265358979323846;

enum { FACES_MAX = 16 };

/* Faces of one shape. */
struct shape {
	struct surface surfaces[FACES_MAX];
	struct trim trims[FACES_MAX];
	int n;
};

static struct surface *add_quad(struct shape *x, struct vec3 o, struct vec3 u, struct vec3 v)
{
	const struct vec3 corners[4] = { o, vec3_add(o, u), vec3_add(o, v),
		                         vec3_add(o, vec3_add(u, v)) };
	assert_in_range(x->n, 0, FACES_MAX - 1);
	assert_int_equal(make_bilinear(&x->surfaces[x->n], corners), ST_OK);
	return &x->surfaces[x->n++];
}

/* A block a x b x c; sides turned in and out as they come. */
static void add_block(struct shape *x, double a, double b, double c)
{
	const struct vec3 o = { 0, 0, 0 }, i = { a, 0, 0 }, j = { 0, b, 0 }, k = { 0, 0, c };
	add_quad(x, o, i, j);
	add_quad(x, k, i, j);
	add_quad(x, o, j, k);
	add_quad(x, i, k, j);
	add_quad(x, o, i, k);
	add_quad(x, j, k, i);
}

static void block(struct shape *x)
{
	add_block(x, 2, 3, 5);
}

/* Thinner than the distance within which borders join. */
static void plate(struct shape *x)
{
	add_block(x, 1, 2, 2e-5);
}

/* One side in three parts: the long borders beside them are parted. */
static void parted_block(struct shape *x)
{
	add_block(x, 2, 3, 5);
	surface_finish(&x->surfaces[--x->n]);
	add_quad(x, vec3(0, 3, 0), vec3(0, 0, 5), vec3(0.5, 0, 0));
	add_quad(x, vec3(0.5, 3, 0), vec3(0, 0, 2), vec3(1.5, 0, 0));
	add_quad(x, vec3(0.5, 3, 2), vec3(0, 0, 3), vec3(1.5, 0, 0));
}

/* Every side moved a little: borders meet within 1e-4 only. */
static void loose_block(struct shape *x)
{
	add_block(x, 2, 3, 5);
	for (int k = 0; k < x->n; k++) {
		const double by = 2e-5 * (k + 1);
		const double m[3][4] = { { 1, 0, 0, k % 3 == 0 ? by : 0 },
			                 { 0, 1, 0, k % 3 == 1 ? by : 0 },
			                 { 0, 0, 1, k % 3 == 2 ? -by : 0 } };
		surface_transform(&x->surfaces[k], m);
	}
}

/* A disc of radius r about 0 0 z, trimmed out of a square; its circle begins at `turn`. */
static void add_disc(struct shape *x, double z, double r, double turn)
{
	const int k = x->n;
	add_quad(x, vec3(-2 * r, -2 * r, z), vec3(4 * r, 0, 0), vec3(0, 4 * r, 0));
	trim_add_ellipse(&x->trims[k], true, 0.5, 0.5, 0.25, 0.25, turn);
}

static void add_turned(struct shape *x, struct vec3 a, struct vec3 b)
{
	struct curve line;
	assert_int_equal(make_line(&line, a, b), ST_OK);
	assert_int_equal(make_revolution(&x->surfaces[x->n++], &line, vec3(0, 0, 0), vec3(0, 0, 1),
	                                 0, 2 * pi),
	                 ST_OK);
	curve_finish(&line);
}

/* Circles that begin elsewhere than the seam. */
static void drum(struct shape *x)
{
	add_turned(x, vec3(1, 0, 0), vec3(1, 0, 2));
	add_disc(x, 0, 1, 0.3);
	add_disc(x, 2, 1, 4);
}

/* A block with a round hole through it: a ring. */
static void bored_block(struct shape *x)
{
	const struct vec3 i = { 4, 0, 0 }, j = { 0, 4, 0 }, k = { 0, 0, 1 };
	for (int z = 0; z < 2; z++) {
		const int face = x->n;
		add_quad(x, vec3(-2, -2, z), i, j);
		trim_add_box(&x->trims[face], true, 0, 0, 1, 1);
		trim_add_ellipse(&x->trims[face], false, 0.5, 0.5, 0.25, 0.25, 1 + z);
	}
	add_quad(x, vec3(-2, -2, 0), i, k);
	add_quad(x, vec3(-2, 2, 0), i, k);
	add_quad(x, vec3(-2, -2, 0), j, k);
	add_quad(x, vec3(2, -2, 0), j, k);
	add_turned(x, vec3(1, 0, 0), vec3(1, 0, 1));
}

/* A pipe with so thin a wall that its rims cross where they are cut coarsely. */
static void pipe(struct shape *x)
{
	for (int z = 0; z < 2; z++) {
		const int face = x->n;
		add_disc(x, 3 * z, 1, 0.2 + z);
		trim_add_ellipse(&x->trims[face], false, 0.5, 0.5, 0.99 / 4, 0.99 / 4, 0.9 - z);
	}
	add_turned(x, vec3(1, 0, 0), vec3(1, 0, 3));
	add_turned(x, vec3(0.99, 0, 0), vec3(0.99, 0, 3));
}

/* Two sheets over the same four straight borders: cut coarsely both have one diagonal. */
static void cushion(struct shape *x)
{
	struct surface *s = &x->surfaces[0];
	add_quad(x, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0));
	add_quad(x, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0));
	for (int d = 0; d < 2; d++) {
		struct surface raised;
		assert_int_equal(surface_elevate(&raised, s, d, 1), ST_OK);
		surface_finish(s);
		*s = raised;
	}
	surface_set_point(s, 1, 1, vec3(0.5, 0.5, 5), 1);
}

static void ball(struct shape *x)
{
	assert_int_equal(make_sphere(&x->surfaces[x->n++], vec3(0, 0, 0), 2), ST_OK);
}

/* Parts whose borders end at different points and run either way. */
static void ball_in_parts(struct shape *x)
{
	struct surface whole;
	const double range[4][2][2] = { { { 0, 2 * pi }, { -pi / 2, 0.3 } },
		                        { { 0, 1 }, { 0.3, pi / 2 } },
		                        { { 1, 4 }, { 0.3, pi / 2 } },
		                        { { 4, 2 * pi }, { 0.3, pi / 2 } } };
	assert_int_equal(make_sphere(&whole, vec3(0, 0, 0), 2), ST_OK);
	for (int i = 0; i < 4; i++)
		assert_int_equal(surface_part(&x->surfaces[x->n++], &whole, range[i]), ST_OK);
	surface_reverse(&x->surfaces[2], 0); /* and so it looks in */
	surface_finish(&whole);
}

static void ring(struct shape *x)
{
	assert_int_equal(make_torus(&x->surfaces[x->n++], vec3(0, 0, 0), 3, 1), ST_OK);
}

/* How far from the surface of the ball and of the ring. */
static double off_ball(struct vec3 p)
{
	return fabs(vec3_length(p) - 2);
}

static double off_ring(struct vec3 p)
{
	return fabs(hypot(hypot(p.x, p.y) - 3, p.z) - 1);
}

static const struct {
	const char *name;
	void (*make)(struct shape *x);
	int characteristic; /* of Euler: points - edges + triangles */
	double volume;
	double (*off)(struct vec3 p); /* NULL: not looked at */
} shapes[] = {
	{ "block", block, 2, 30, NULL },
	{ "plate", plate, 2, 4e-5, NULL },
	{ "parted block", parted_block, 2, 30, NULL },
	{ "loose block", loose_block, 2, 30, NULL },
	{ "drum", drum, 2, 6.28318530717958647692, NULL },
	{ "bored block", bored_block, 0, 16 - 3.14159265358979323846, NULL },
	{ "pipe", pipe, 0, 3 * 3.14159265358979323846 * (1 - 0.99 * 0.99), NULL },
	{ "cushion", cushion, 2, 5.0 / 9, NULL },
	{ "ball", ball, 2, 32 * 3.14159265358979323846 / 3, off_ball },
	{ "ball in parts", ball_in_parts, 2, 32 * 3.14159265358979323846 / 3, off_ball },
	{ "ring", ring, 0, 6 * 9.8696044010893586, off_ring },
};

static void finish(struct shape *x)
{
	for (int k = 0; k < x->n; k++) {
		surface_finish(&x->surfaces[k]);
		trim_finish(&x->trims[k]);
	}
}

static void cut(struct mesh *m, const struct shape *x, const struct tessellate_limits *l,
                const struct report *r)
{
	struct tessellate_face faces[FACES_MAX];
	for (int k = 0; k < x->n; k++)
		faces[k] = (struct tessellate_face){ &x->surfaces[k], &x->trims[k] };
	assert_int_equal(tessellate(m, faces, x->n, l, NULL, r), ST_OK);
}

static struct vec3 corner(const struct mesh *m, int t, int k)
{
	return m->points[m->triangles[t][k % 3].point];
}

static double volume_of(const struct mesh *m)
{
	double sum = 0;
	for (int t = 0; t < m->n_triangles; t++)
		sum += vec3_dot(corner(m, t, 0), vec3_cross(corner(m, t, 1), corner(m, t, 2))) / 6;
	return sum;
}

static void check_edges(const struct mesh *m, double (*off)(struct vec3 p), double chord)
{
	for (int t = 0; t < m->n_triangles; t++)
		for (int k = 0; k < 3; k++)
			for (int i = 1; i < 4; i++)
				assert_true(off(vec3_add(vec3_scale(corner(m, t, k), 0.25 * i),
				                         vec3_scale(corner(m, t, k + 1),
				                                    1 - 0.25 * i))) <
				            1.0001 * chord);
}

static void closed_shapes_are_closed(void **state)
{
	static const double chords[] = { 0.003, 0.03, 0.3, 3, 300 };
	(void)state;
	for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
		struct shape x = { 0 };
		shapes[s].make(&x);
		for (size_t i = 0; i < sizeof chords / sizeof *chords; i++) {
			const struct tessellate_limits l = {
				.chord = chords[i], .angle = pi / 8, .join = 3e-4, .orient = true
			};
			struct report_store store;
			struct mesh_looks looks;
			struct mesh m;
			report_store_init(&store);
			cut(&m, &x, &l, &store.report);
			assert_int_equal(mesh_look(&looks, &m), ST_OK);
			if (looks.open + looks.multiple + looks.turned + store.n_warnings)
				fail_msg("%s within %g: %d open, %d multiple, %d turned, %zu left",
				         shapes[s].name, chords[i], looks.open, looks.multiple,
				         looks.turned, store.n_warnings);
			/* closed: three edges a triangle, each twice */
			assert_int_equal(m.n_triangles % 2, 0);
			if (m.n_points - m.n_triangles / 2 != shapes[s].characteristic)
				fail_msg("%s within %g: %d points, %d triangles", shapes[s].name,
				         chords[i], m.n_points, m.n_triangles);
			assert_true(volume_of(&m) > 0);
			if (i == 0)
				assert_true(fabs(volume_of(&m) / shapes[s].volume - 1) < 0.01);
			if (shapes[s].off)
				check_edges(&m, shapes[s].off, chords[i]);
			mesh_looks_finish(&looks);
			mesh_finish(&m);
		}
		finish(&x);
	}
}

/* Volumes come nearer to the true one as the square of the distance between points. */
static void volumes_converge(void **state)
{
	(void)state;
	for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
		double off[2];
		struct shape x = { 0 };
		if (!shapes[s].off)
			continue;
		shapes[s].make(&x);
		for (int i = 0; i < 2; i++) {
			const struct tessellate_limits l = {
				.chord = i ? 0.002 : 0.02, .angle = pi, .join = 1e-4, .orient = true
			};
			struct mesh m;
			cut(&m, &x, &l, NULL);
			off[i] = fabs(volume_of(&m) - shapes[s].volume);
			mesh_finish(&m);
		}
		assert_true(off[1] < off[0] / 5);
		finish(&x);
	}
}

/* What disagrees by more than `join` stays open, and it is said where. */
static void gaps_stay_and_are_found(void **state)
{
	const struct tessellate_limits l = {
		.chord = 0.01, .angle = pi / 8, .join = 1e-3, .orient = true
	};
	const double lift[3][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0.01 } };
	struct shape x = { 0 };
	struct mesh_looks looks;
	struct mesh m;
	(void)state;
	block(&x);
	surface_transform(&x.surfaces[1], lift); /* the lid */
	cut(&m, &x, &l, NULL);
	assert_int_equal(mesh_look(&looks, &m), ST_OK);
	assert_int_equal(looks.open, 8);
	assert_int_equal(looks.n_borders, 2);
	for (int k = 0; k < 2; k++) {
		assert_int_equal(looks.borders[k].edges, 4);
		assert_true(fabs(looks.borders[k].length - 10) < 1e-12);
		assert_true(fabs(looks.borders[k].width - 2 * 6 / 10.0) < 1e-12);
		assert_true(fabs(looks.borders[k].at.z - 5) < 0.011);
	}
	assert_true(m.gap < 1e-12);
	mesh_looks_finish(&looks);
	mesh_finish(&m);
	finish(&x);
}

/* Where one border leaves another at no vertex, they are one as far as they keep together. */
static void borders_that_part_ways_join_before(void **state)
{
	const struct tessellate_limits l = {
		.chord = 1e-3, .angle = pi / 8, .join = 1e-3, .orient = true
	};
	const double radius = 10, end = 0.1; /* y = x^2 / 20, about */
	struct curve low, high;
	struct shape x = { 0 };
	struct mesh_looks looks;
	struct mesh m;
	(void)state;
	add_quad(&x, vec3(0, -1, 0), vec3(1, 0, 0), vec3(0, 1, 0));
	assert_int_equal(
	        make_arc(&low, vec3(0, radius, 0), vec3(0, -1, 0), vec3(1, 0, 0), radius, 0, end),
	        ST_OK);
	assert_int_equal(make_line(&high, vec3(0, 1, 0), vec3(1, 1, 0)), ST_OK);
	assert_int_equal(make_ruled(&x.surfaces[x.n++], &low, &high), ST_OK);
	cut(&m, &x, &l, NULL);
	assert_int_equal(mesh_look(&looks, &m), ST_OK);
	assert_int_equal(looks.n_borders, 1);
	/* seven sides of about 1, and that of the arc's end, but for where the two are one */
	const double sides = 7 + hypot(1 - radius * sin(end), 1 - radius * (1 - cos(end)));
	const double together = sqrt(2 * radius * l.join);
	assert_true(fabs(looks.borders[0].length - (sides - 2 * together)) < 0.02);
	assert_true(m.gap > 0.9 * l.join && m.gap < 1.1 * l.join);
	mesh_looks_finish(&looks);
	mesh_finish(&m);
	curve_finish(&low);
	curve_finish(&high);
	finish(&x);
}

static void too_fine_is_said_at_once(void **state)
{
	const struct tessellate_limits l = { .chord = 1e-12, .angle = pi / 8, .join = 1e-4 };
	struct report_store store;
	struct mesh m;
	struct shape x = { 0 };
	(void)state;
	ball(&x);
	report_store_init(&store);
	const struct tessellate_face face = { &x.surfaces[0], NULL };
	assert_int_equal(tessellate(&m, &face, 1, &l, NULL, &store.report), ST_RESOURCE);
	assert_int_equal(store.n_errors, 1);
	assert_non_null(strstr(store.error, "give a larger tolerance"));
	finish(&x);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(closed_shapes_are_closed),
		cmocka_unit_test(volumes_converge),
		cmocka_unit_test(gaps_stay_and_are_found),
		cmocka_unit_test(borders_that_part_ways_join_before),
		cmocka_unit_test(too_fine_is_said_at_once),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
