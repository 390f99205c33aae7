/* test_tessellate.c - triangles of surfaces: near enough, without gaps, with the surface's normals. */
#include "cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include "construct.h"
#include "mesh_look.h"
#include "refine.h"
#include "tessellate.h"

static const double pi = 3.14159265358979323846;

static struct tessellate_limits limits_of(double chord, double degrees)
{
	return (struct tessellate_limits){
		.chord = chord, .angle = degrees * pi / 180, .join = 1e-6, .orient = true
	};
}

static void make_mesh(struct mesh *m, const struct surface *s, int n, double chord, double degrees)
{
	struct tessellate_face faces[8] = { { 0 } };
	struct tessellate_limits l = limits_of(chord, degrees);
	assert_in_range(n, 1, 8);
	for (int i = 0; i < n; i++)
		faces[i].surface = &s[i];
	assert_int_equal(tessellate(m, faces, n, &l, NULL, NULL), ST_OK);
	assert_true(m->n_triangles > 0);
	assert_int_equal(m->n_parts, n);
}

static struct vec3 corner(const struct mesh *m, int t, int k)
{
	return m->points[m->triangles[t][k].point];
}

static struct vec3 cross_of(const struct mesh *m, int t)
{
	struct vec3 a = corner(m, t, 0);
	return vec3_cross(vec3_sub(corner(m, t, 1), a), vec3_sub(corner(m, t, 2), a));
}

static double area_of(const struct mesh *m)
{
	double sum = 0;
	for (int t = 0; t < m->n_triangles; t++)
		sum += 0.5 * vec3_length(cross_of(m, t));
	return sum;
}

static double volume_of(const struct mesh *m)
{
	double sum = 0;
	for (int t = 0; t < m->n_triangles; t++)
		sum += vec3_dot(corner(m, t, 0), cross_of(m, t)) / 6;
	return sum;
}

static int open_edges(const struct mesh *m)
{
	struct mesh_looks looks;
	assert_int_equal(mesh_look(&looks, m), ST_OK);
	assert_int_equal(looks.multiple + looks.turned, 0);
	const int n = looks.open;
	mesh_looks_finish(&looks);
	return n;
}

/* What holds of every mesh: areas above zero, unit normals on the triangles' side. */
static void check_mesh(const struct mesh *m, double most_turn)
{
	for (int t = 0; t < m->n_triangles; t++) {
		struct vec3 c = cross_of(m, t);
		struct vec3 a = vec3_sub(corner(m, t, 1), corner(m, t, 0));
		assert_true(vec3_length(c) > 1e-6 * vec3_dot(a, a));
		for (int k = 0; k < 3; k++) {
			struct vec3 n = m->normals[m->triangles[t][k].normal];
			assert_true(fabs(vec3_length(n) - 1) < 1e-12);
			assert_true(vec3_dot(n, vec3_unit(c)) > cos(most_turn));
		}
	}
}

static void a_sphere_is_closed(void **state)
{
	(void)state;
	static const double chord[] = { 0.3, 0.03, 0.003 };
	for (int i = 0; i < 3; i++) {
		struct surface s;
		struct mesh m;
		assert_int_equal(make_sphere(&s, vec3(0, 0, 0), 2), ST_OK);
		make_mesh(&m, &s, 1, chord[i], 30);
		assert_int_equal(open_edges(&m), 0);
		check_mesh(&m, 1);
		/* the middle of a triangle is its farthest point from the sphere */
		for (int t = 0; t < m.n_triangles; t++) {
			struct vec3 c =
			        vec3_scale(vec3_add(corner(&m, t, 0),
			                            vec3_add(corner(&m, t, 1), corner(&m, t, 2))),
			                   1.0 / 3);
			assert_true(2 - vec3_length(c) < 1.001 * chord[i]);
		}
		for (int k = 0; k < m.n_points; k++)
			assert_true(fabs(vec3_length(m.points[k]) - 2) < 1e-14);
		for (int t = 0; t < m.n_triangles; t++)
			for (int k = 0; k < 3; k++) {
				struct vec3 n = m.normals[m.triangles[t][k].normal];
				struct vec3 p = vec3_scale(corner(&m, t, k), 0.5);
				assert_true(vec3_length(vec3_sub(n, p)) < 1e-7);
			}
		/* one normal a point: seam and poles are smooth */
		assert_int_equal(m.n_normals, m.n_points);
		assert_int_equal(m.n_triangles, 2 * m.n_points - 4); /* Euler */
		mesh_finish(&m);
		surface_finish(&s);
	}
}

static void a_torus_is_closed(void **state)
{
	(void)state;
	struct surface s;
	struct mesh m;
	assert_int_equal(make_torus(&s, vec3(0, 0, 0), 3, 1), ST_OK);
	make_mesh(&m, &s, 1, 1e-3, 15);
	assert_int_equal(open_edges(&m), 0);
	assert_int_equal(m.n_triangles, 2 * m.n_points);
	check_mesh(&m, 0.3);
	assert_true(fabs(volume_of(&m) - 6 * pi * pi) < 0.01 * 6 * pi * pi);
	assert_true(fabs(area_of(&m) - 12 * pi * pi) < 0.01 * 12 * pi * pi);
	assert_in_range(m.n_triangles, 2000, 60000);
	mesh_finish(&m);
	surface_finish(&s);
}

/* The angle alone: a large chord tolerance, normals still near. */
static void the_angle_holds(void **state)
{
	(void)state;
	struct surface s;
	struct mesh m;
	assert_int_equal(make_torus(&s, vec3(0, 0, 0), 3, 1), ST_OK);
	make_mesh(&m, &s, 1, 0.05, 10);
	for (int t = 0; t < m.n_triangles; t++)
		for (int k = 0; k < 3; k++) {
			struct vec3 a = m.normals[m.triangles[t][k].normal];
			struct vec3 b = m.normals[m.triangles[t][(k + 1) % 3].normal];
			assert_true(vec3_dot(a, b) > cos(10.01 * pi / 180));
		}
	mesh_finish(&m);
	surface_finish(&s);
}

static void flat_is_two_triangles(void **state)
{
	(void)state;
	const struct vec3 corners[4] = { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 3, 0 }, { 4, 3, 0 } };
	struct surface s;
	struct mesh m;
	assert_int_equal(make_bilinear(&s, corners), ST_OK);
	make_mesh(&m, &s, 1, 1e-6, 1);
	assert_int_equal(m.n_triangles, 2);
	assert_true(fabs(area_of(&m) - 12) < 1e-14);
	mesh_finish(&m);
	surface_finish(&s);
}

/* A cone has no normal at its tip; each triangle there gets the one beside it. */
static void a_cone_has_a_tip(void **state)
{
	(void)state;
	struct curve line;
	struct surface s;
	struct mesh m;
	assert_int_equal(make_line(&line, vec3(0, 0, 1), vec3(1, 0, 0)), ST_OK);
	assert_int_equal(make_revolution(&s, &line, vec3(0, 0, 0), vec3(0, 0, 1), 0, 2 * pi),
	                 ST_OK);
	make_mesh(&m, &s, 1, 1e-3, 15);
	check_mesh(&m, 1); /* next to the tip edges shorter than the tolerance may turn more */
	int ring = 0;      /* what is open is the circle below */
	for (int k = 0; k < m.n_points; k++)
		ring += fabs(m.points[k].z) < 1e-12;
	assert_int_equal(open_edges(&m), ring);
	assert_true(fabs(area_of(&m) - pi * sqrt(2)) < 0.01);
	mesh_finish(&m);
	surface_finish(&s);
	curve_finish(&line);
}

/* A sphere in four parts whose borders do not end at the same points and run either way. */
static void parts_join(void **state)
{
	(void)state;
	struct surface whole, s[4];
	struct mesh m;
	assert_int_equal(make_sphere(&whole, vec3(1, 2, 3), 2), ST_OK);
	const double u0 = 0, u1 = 2 * pi, v0 = -pi / 2, v1 = pi / 2;
	const double range[4][2][2] = {
		{ { u0, u1 }, { v0, 0.3 } },
		{ { u0, 1 }, { 0.3, v1 } },
		{ { 1, 4 }, { 0.3, v1 } },
		{ { 4, u1 }, { 0.3, v1 } },
	};
	for (int i = 0; i < 4; i++)
		assert_int_equal(surface_part(&s[i], &whole, range[i]), ST_OK);
	surface_reverse(&s[2], 0);
	assert_int_equal(surface_exchange(&s[2]), ST_OK); /* and so its normal stays */
	surface_reparametrise(&s[3], 1, 0, 1e-3);
	make_mesh(&m, s, 4, 0.01, 20);
	assert_int_equal(open_edges(&m), 0);
	check_mesh(&m, 0.5);
	assert_true(fabs(area_of(&m) - 16 * pi) < 0.02 * 16 * pi);
	mesh_finish(&m);
	for (int i = 0; i < 4; i++)
		surface_finish(&s[i]);
	surface_finish(&whole);
}

/* A tube of square section: its edges are sharp, each with a normal to either side. */
static void sharp_edges_stay(void **state)
{
	(void)state;
	const struct vec3 square[5] = {
		{ 1, 1, 0 }, { -1, 1, 0 }, { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }
	};
	struct curve c;
	struct surface s;
	struct mesh m;
	assert_int_equal(make_polyline(&c, square, 5), ST_OK);
	assert_int_equal(make_cylinder(&s, &c, vec3(0, 0, 5)), ST_OK);
	make_mesh(&m, &s, 1, 1e-3, 10);
	assert_int_equal(m.n_triangles, 8);
	assert_int_equal(m.n_points, 8);
	assert_int_equal(m.n_normals, 16);
	assert_int_equal(open_edges(&m), 8);
	assert_true(fabs(area_of(&m) - 40) < 1e-12);
	check_mesh(&m, 1e-6);
	mesh_finish(&m);
	surface_finish(&s);
	curve_finish(&c);
}

static void add_circle(struct trim *t, double x, double y, double radius, bool outer)
{
	struct trim_loop *loops = realloc(t->loops, (size_t)(t->n + 1) * sizeof *loops);
	assert_non_null(loops);
	t->loops = loops;
	loops[t->n] = (struct trim_loop){ calloc(1, sizeof(struct curve)), 1, outer };
	assert_non_null(loops[t->n].curves);
	assert_int_equal(make_arc(loops[t->n].curves, vec3(x, y, 0), vec3(1, 0, 0), vec3(0, 1, 0),
	                          radius, 0, 2 * pi),
	                 ST_OK);
	t->n++;
}

static void drop(struct trim *t)
{
	for (int k = 0; k < t->n; k++) {
		curve_finish(t->loops[k].curves);
		free(t->loops[k].curves);
	}
	free(t->loops);
}

/* A square plate with a round hole, and the disc that fills it: together they close. */
static void trims_are_kept(void **state)
{
	(void)state;
	const struct vec3 corners[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } };
	const struct tessellate_limits l = limits_of(1e-5, 5);
	struct surface s;
	struct trim hole = { 0 }, disc = { 0 };
	struct mesh m;
	assert_int_equal(make_bilinear(&s, corners), ST_OK);
	add_circle(&hole, 0.4, 0.5, 0.25, false);
	add_circle(&disc, 0.4, 0.5, 0.25, true);
	const struct tessellate_face faces[2] = { { &s, &hole }, { &s, &disc } };
	const double area[2] = { 1 - pi / 16, pi / 16 };
	for (int i = 0; i < 2; i++) {
		assert_int_equal(tessellate(&m, &faces[i], 1, &l, NULL, NULL), ST_OK);
		assert_true(fabs(area_of(&m) - area[i]) < 2e-5);
		check_mesh(&m, 1e-6);
		mesh_finish(&m);
	}
	assert_int_equal(tessellate(&m, faces, 2, &l, NULL, NULL), ST_OK);
	assert_int_equal(open_edges(&m), 4); /* the square's own sides */
	assert_true(fabs(area_of(&m) - 1) < 1e-14);
	mesh_finish(&m);
	drop(&hole);
	drop(&disc);
	surface_finish(&s);
}

/* A trim across the sharp edge of a roof: the ridge is an edge of triangles on both sides. */
static void trims_cross_sharp_edges(void **state)
{
	(void)state;
	const struct vec3 profile[3] = { { 0, 0, 0 }, { 1, 0, 1 }, { 2, 0, 0 } };
	const struct tessellate_limits l = limits_of(1e-4, 5);
	struct curve c;
	struct surface s;
	struct trim t = { 0 };
	struct mesh m;
	assert_int_equal(make_polyline(&c, profile, 3), ST_OK);
	assert_int_equal(make_cylinder(&s, &c, vec3(0, 2, 0)), ST_OK);
	add_circle(&t, 0.5, 0.5, 0.3, true);
	const struct tessellate_face face = { &s, &t };
	assert_int_equal(tessellate(&m, &face, 1, &l, NULL, NULL), ST_OK);
	check_mesh(&m, 1e-6); /* no triangle runs over the ridge */
	/* du = 2 length of half the profile: sqrt(2), so the area is stretched by 2 sqrt(2) x 2 */
	assert_true(fabs(area_of(&m) - pi * 0.09 * 2 * sqrt(2) * 2) < 2e-3);
	mesh_finish(&m);
	drop(&t);
	surface_finish(&s);
	curve_finish(&c);
}

/* Two squares in one surface that do not meet: there is an end to looking for the way between. */
static void a_broken_surface_ends(void **state)
{
	(void)state;
	struct surface s;
	struct mesh m;
	assert_int_equal(surface_init(&s, (const int[2]){ 2, 2 }, (const int[2]){ 4, 2 }), ST_OK);
	memcpy(s.knots[0], (const double[6]){ 0, 0, 1, 1, 2, 2 }, 6 * sizeof(double));
	memcpy(s.knots[1], (const double[4]){ 0, 0, 1, 1 }, 4 * sizeof(double));
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 2; j++)
			surface_set_point(&s, i, j, vec3(i, j, i / 2), 1);
	assert_int_equal(surface_check(&s, "broken", NULL), ST_OK);
	make_mesh(&m, &s, 1, 1e-3, 10);
	assert_true(m.n_triangles < 2000000);
	mesh_finish(&m);
	surface_finish(&s);
}

static void same_input_same_bytes(void **state)
{
	(void)state;
	struct surface s;
	struct mesh m[2];
	assert_int_equal(make_torus(&s, vec3(0.1, 0.2, 0.3), 2, 0.7), ST_OK);
	for (int i = 0; i < 2; i++)
		make_mesh(&m[i], &s, 1, 0.01, 20);
	assert_int_equal(m[0].n_points, m[1].n_points);
	assert_int_equal(m[0].n_triangles, m[1].n_triangles);
	assert_memory_equal(m[0].points, m[1].points, sizeof(struct vec3) * m[0].n_points);
	assert_memory_equal(m[0].triangles, m[1].triangles,
	                    sizeof *m[0].triangles * m[0].n_triangles);
	mesh_finish(&m[0]);
	mesh_finish(&m[1]);
	surface_finish(&s);
}

static void what_is_wrong_is_said(void **state)
{
	(void)state;
	struct surface s;
	struct mesh m;
	struct report_store store;
	atomic_bool stop = true;
	const struct tessellate_watch watch = { .stop = &stop };
	assert_int_equal(make_sphere(&s, vec3(0, 0, 0), 1), ST_OK);
	const struct tessellate_face face = { &s, NULL };
	struct tessellate_limits l = limits_of(0, 10);
	report_store_init(&store);
	assert_int_equal(tessellate(&m, &face, 1, &l, NULL, &store.report), ST_PARAMETER);
	assert_int_equal(store.n_errors, 1);
	l = limits_of(0.01, 10);
	assert_int_equal(tessellate(&m, &face, 1, &l, &watch, NULL), ST_CANCELLED);
	/* two loops that cross: the face is left out with a warning, not the others */
	struct trim t = { 0 };
	struct surface p;
	const struct vec3 corners[4] = { { 5, 0, 0 }, { 6, 0, 0 }, { 5, 1, 0 }, { 6, 1, 0 } };
	assert_int_equal(make_bilinear(&p, corners), ST_OK);
	add_circle(&t, 0.4, 0.5, 0.2, false);
	add_circle(&t, 0.5, 0.5, 0.2, false);
	const struct tessellate_face two[2] = { { &p, &t }, { &s, NULL } };
	report_store_init(&store);
	assert_int_equal(tessellate(&m, two, 2, &l, NULL, &store.report), ST_OK);
	assert_int_equal(store.n_warnings, 1);
	assert_true(m.parts[0].count == 0 && m.parts[1].count > 0);
	assert_int_equal(open_edges(&m), 0);
	mesh_finish(&m);
	drop(&t);
	surface_finish(&p);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(flat_is_two_triangles),   cmocka_unit_test(a_sphere_is_closed),
		cmocka_unit_test(a_torus_is_closed),       cmocka_unit_test(the_angle_holds),
		cmocka_unit_test(a_cone_has_a_tip),        cmocka_unit_test(parts_join),
		cmocka_unit_test(sharp_edges_stay),        cmocka_unit_test(trims_are_kept),
		cmocka_unit_test(trims_cross_sharp_edges), cmocka_unit_test(a_broken_surface_ends),
		cmocka_unit_test(same_input_same_bytes),   cmocka_unit_test(what_is_wrong_is_said),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
