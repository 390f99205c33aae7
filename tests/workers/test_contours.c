/* test_contours.c - the contours worker against circles, an annulus, and Wigley's hull by formula. */
#include "bodies.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"

/* Wigley's hull: y = (B/2) (1 - (2x/L)^2) (1 - (z/T)^2), z from -T to 0. */
static const double length = 100, beam = 10, draught = 6.25;

static char *contours;

/* One side of the hull, exact as a biquadratic patch. */
static struct surface wigley(double side)
{
	static const double x[3] = { 0.5, 0, -0.5 }, fx[3] = { 0, 2, 0 };
	static const double z[3] = { -1, -0.5, 0 }, fz[3] = { 0, 1, 1 };
	struct surface s;
	assert_int_equal(surface_init(&s, (int[2]){ 3, 3 }, (int[2]){ 3, 3 }), ST_OK);
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			surface_set_point(&s, i, j,
			                  vec3(length * x[i], side * beam / 2 * fx[i] * fz[j],
			                       draught * z[j]),
			                  1);
	for (int d = 0; d < 2; d++) {
		for (int i = 3; i < 6; i++)
			s.knots[d][i] = 1;
		s.domain[d][1] = 1;
	}
	return s;
}

static int enter(void **state)
{
	static struct place place;
	*state = &place;
	place_enter(&place);
	body_write("sphere.base", NULL, body_sphere(vec3(0, 0, 0), 2));
	body_write("torus.base", NULL, body_torus(vec3(1, 2, 3), 20, 5));
	bodies_write("wigley.base", NULL, (struct surface[]){ wigley(1), wigley(-1) }, 2);
	body_write("half.base", NULL, wigley(-1));
	const struct vec3 p = vec3(1, 1, 1);
	body_write("point.base", NULL, body_corners(p, p, p, p));
	return 0;
}

/* A result read back: its model, its figures, the row of each plane. */
struct result {
	struct model m;
	json_t *figures, *levels;
};

static struct result result_read(const char *path)
{
	struct result r;
	assert_int_equal(model_read(&r.m, path, NULL, NULL), ST_OK);
	r.figures = figures_of(&r.m);
	r.levels = json_object_get(r.figures, "levels");
	assert_non_null(r.levels);
	return r;
}

static void result_finish(struct result *r)
{
	json_decref(r->figures);
	model_finish(&r->m);
}

static json_t *row(const struct result *r, int i, const char *kind, double value, int branches,
                   int closed)
{
	json_t *o = json_array_get(r->levels, (size_t)i);
	assert_non_null(o);
	assert_string_equal(json_text(o, "kind", ""), kind);
	near(json_number(o, "value", NAN), value, 1e-12 * length);
	assert_int_equal(json_int(o, "branches", -1), branches);
	assert_int_equal(json_int(o, "closed", -1), closed);
	assert_int_equal(json_int(o, "undecided", -1), 0);
	return o;
}

static void expect_section(const json_t *o, double area, struct vec3 centroid, double tolerance)
{
	const json_t *c = json_object_get(o, "centroid");
	near(json_number(o, "area", NAN), area, tolerance);
	assert_int_equal(json_array_size(c), 3);
	near(json_number_value(json_array_get(c, 0)), centroid.x, tolerance);
	near(json_number_value(json_array_get(c, 1)), centroid.y, tolerance);
	near(json_number_value(json_array_get(c, 2)), centroid.z, tolerance);
}

static void test_circles(void **state)
{
	(void)state;
	run_well(contours, "sphere.base", "--plane", "0,0,5", "--from", "-1.5", "--spacing", "0.5",
	         "--count", "7", "--tolerance", "1e-6", NULL);
	struct result r = result_read("sphere.contour");
	assert_int_equal(json_array_size(r.levels), 7);
	for (int i = 0; i < 7; i++) {
		const double z = -1.5 + 0.5 * i, radius = sqrt(4 - z * z);
		json_t *o = row(&r, i, "plane", z, 1, 1);
		expect_section(o, M_PI * radius * radius, vec3(0, 0, z), 1e-5);
		near(json_number(o, "girth", NAN), 2 * M_PI * radius, 1e-5);
		near(json_number(o, "length", NAN), 2 * M_PI * radius, 1e-5);
	}
	assert_int_equal(json_int(r.figures, "branches", -1), 7);
	assert_true(json_number(r.figures, "max_error", NAN) <= 1e-6);
	assert_int_equal(r.m.n, 8);
	for (int i = 1; i < r.m.n; i++) {
		const struct entity *e = &r.m.entities[i];
		assert_string_equal(entity_get_attribute(e, "kind"), "plane");
		assert_string_equal(entity_get_attribute(e, "curve"), "1");
		const double z = strtod(entity_get_attribute(e, "value"), NULL);
		for (int k = 0; k <= 200; k++) {
			struct vec3 p = curve_point(&e->space, e->space.domain[1] * k / 200);
			near(p.z, z, 1e-6);
			near(vec3_length(p), 2, 1e-6);
		}
	}
	result_finish(&r);
}

/* A plane askew through the centre: a great circle. The way to give one plane by a point. */
static void test_askew(void **state)
{
	(void)state;
	run_well(contours, "sphere.base", "--plane", "1,2,2", "--point", "0.3,0.3,0.3",
	         "--tolerance", "1e-6", NULL);
	struct result r = result_read("sphere.contour");
	const double d = 0.5, radius = sqrt(4 - d * d);
	json_t *o = row(&r, 0, "plane", d, 1, 1);
	expect_section(o, M_PI * radius * radius, vec3(d / 3, 2 * d / 3, 2 * d / 3), 1e-5);
	result_finish(&r);
}

/* Through the torus: an annulus is a circle less its hole; two circles are their sum. */
static void test_holes(void **state)
{
	(void)state;
	run_well(contours, "torus.base", "--plane", "0,0,1", "--from", "5", "--tolerance", "1e-5",
	         NULL);
	struct result r = result_read("torus.contour");
	json_t *o = row(&r, 0, "plane", 5, 2, 2);
	const double outer = 20 + sqrt(21), inner = 20 - sqrt(21);
	expect_section(o, M_PI * (outer * outer - inner * inner), vec3(1, 2, 5), 1e-2);
	near(json_number(o, "girth", NAN), 2 * M_PI * 40, 1e-3);
	result_finish(&r);
	run_well(contours, "torus.base", "--plane", "1,0,0", "--from", "1", "--tolerance", "1e-5",
	         NULL);
	r = result_read("torus.contour");
	expect_section(row(&r, 0, "plane", 1, 2, 2), 2 * M_PI * 25, vec3(1, 2, 3), 1e-3);
	result_finish(&r);
}

static void test_cylinders(void **state)
{
	(void)state;
	run_well(contours, "sphere.base", "--cylinder", "0,0,1", "--from", "0.5", "--to", "1.5",
	         "--count", "3", "--tolerance", "1e-6", NULL);
	struct result r = result_read("sphere.contour");
	for (int i = 0; i < 3; i++) {
		const double radius = 0.5 + 0.5 * i;
		json_t *o = row(&r, i, "cylinder", radius, 2, 2);
		near(json_number(o, "length", NAN), 4 * M_PI * radius, 1e-5);
		assert_true(json_is_null(json_object_get(o, "area")));
	}
	result_finish(&r);
	/* off the axis, both in one: points lie on both surfaces */
	run_well(contours, "sphere.base", "--cylinder", "0,0,1", "--point", "0.4,0.3,9", "--from",
	         "0.8", "--tolerance", "1e-6", NULL);
	r = result_read("sphere.contour");
	row(&r, 0, "cylinder", 0.8, 2, 2);
	for (int i = 1; i < r.m.n; i++)
		for (int k = 0; k <= 200; k++) {
			const struct curve *c = &r.m.entities[i].space;
			struct vec3 p = curve_point(c, c->domain[1] * k / 200);
			near(hypot(p.x - 0.4, p.y - 0.3), 0.8, 2e-6);
			near(vec3_length(p), 2, 1e-6);
		}
	result_finish(&r);
}

/* Length of y = breadth (1 - (t / extent)^2) for t from 0 to extent, by Simpson's rule. */
static double parabola_length(double breadth, double extent)
{
	enum { STEPS = 2000 };
	double sum = 0;
	for (int i = 0; i <= STEPS; i++) {
		const double slope = 2 * breadth / extent * i / STEPS;
		sum += (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2) * sqrt(1 + slope * slope);
	}
	return sum * extent / (3 * STEPS);
}

/* Areas and girths of stations and waterlines, whole hull and half hull: the same. */
static void test_wigley(void **state)
{
	(void)state;
	static const char *const files[] = { "wigley", "half" };
	for (int f = 0; f < 2; f++) {
		char input[32], output[32];
		snprintf(input, sizeof input, "%s.base", files[f]);
		snprintf(output, sizeof output, "%s.contour", files[f]);
		run_well(contours, input, "--stations", "9", "--waterlines", "-5:-1:5",
		         "--buttocks", "1", "--tolerance", "1e-6", NULL);
		struct result r = result_read(output);
		assert_int_equal(json_array_size(r.levels), 15);
		for (int i = 0; i < 9; i++) {
			const double x = -40 + 10 * i, part = 1 - x * x / 2500;
			json_t *o = row(&r, i, "station", x, 1, 0);
			assert_int_equal(json_int(o, "number", -1), i + 1);
			expect_section(o, beam * part * draught * 2 / 3,
			               vec3(x, 0, -3 * draught / 8), 1e-4);
			near(json_number(o, "girth", NAN),
			     2 * parabola_length(beam / 2 * part, draught), 1e-5);
		}
		for (int i = 0; i < 5; i++) {
			const double z = -5 + i, part = 1 - z * z / (draught * draught);
			/* the halves meet at stem and stern; one half alone has its ends there */
			json_t *o = row(&r, 9 + i, "waterline", z, 1, f == 0);
			assert_int_equal(json_int(o, "number", -1), i);
			expect_section(o, beam * part * length * 2 / 3, vec3(0, 0, z), 1e-3);
			near(json_number(o, "girth", NAN),
			     4 * parabola_length(beam / 2 * part, length / 2), 1e-5);
		}
		row(&r, 14, "buttock", f == 0 ? beam / 4 : -beam / 4, 1, 0);
		result_finish(&r);
	}
}

/* Below a draught: F(z) = z - z^3 / 3 T^2 from -T to there. */
static void test_draught(void **state)
{
	(void)state;
	run_well(contours, "half.base", "--stations", "-30:30:3", "--draught", "-2", "--tolerance",
	         "1e-6", "--csv", "--svg", NULL);
	struct result r = result_read("half.contour");
	const double t = draught, d = -2;
	const double area = d - d * d * d / (3 * t * t) + 2 * t / 3;
	const double moment = d * d / 2 - d * d * d * d / (4 * t * t) - t * t / 4;
	for (int i = 0; i < 3; i++) {
		const double x = -30 + 30 * i, breadth = beam * (1 - x * x / 2500);
		expect_section(row(&r, i, "station", x, 1, 0), breadth * area,
		               vec3(x, 0, moment / area), 1e-4);
	}
	result_finish(&r);
	assert_int_equal(count_lines("half.sections.csv"), 4);
	size_t n;
	char *csv = slurp("half.sections.csv", &n), *svg = slurp("half.contour.svg", &n);
	assert_int_equal(strncmp(csv, "kind,number,value,branches,closed,length,area,", 46), 0);
	assert_non_null(strstr(csv, "\nstation,1,0,1,0,"));
	static const char *const words[] = { "Body plan", "Profile", "Half-breadth", "DWL" };
	for (size_t i = 0; i < sizeof words / sizeof *words; i++)
		assert_non_null(strstr(svg, words[i]));
	free(csv);
	free(svg);
}

static void test_same_bytes(void **state)
{
	(void)state;
	run_well(contours, "wigley.base", "--stations", "20", "--waterlines", "9", "--buttocks",
	         "4", "--svg", "--csv", "--threads", "1", "-o", "one", NULL);
	run_well(contours, "wigley.base", "--stations", "20", "--waterlines", "9", "--buttocks",
	         "4", "--svg", "--csv", "--threads", "4", "-o", "four", NULL);
	assert_same_file("one.contour", "four.contour");
	assert_same_file("one.contour.svg", "four.contour.svg");
	assert_same_file("one.sections.csv", "four.sections.csv");
}

/* Killed after its first unit, started again: the same bytes as at one go. */
static void test_killed(void **state)
{
	(void)state;
	static const char parameters[] = "\"plane\":\"1,2,3\",\"count\":\"400\"";
	struct peer p;
	write_job("1.json", "contours", "torus.base", "whole", "1.part", parameters, "");
	write_job("2.json", "contours", "torus.base", "twice", "2.part", parameters, "");
	struct ran r = run_hand(contours, "--job", "1.json", NULL);
	assert_int_equal(r.exit_status, 0);
	ran_finish(&r);
	peer_start(&p, contours, NULL);
	peer_send(&p, MESSAGE_START, "job", "2.json");
	assert_true(peer_until(&p, MESSAGE_UNIT));
	kill(p.pid, SIGKILL);
	peer_drain(&p);
	assert_int_equal(peer_end(&p), 128 + SIGKILL);
	assert_false(there("twice.contour"));
	peer_start(&p, contours, NULL);
	peer_send(&p, MESSAGE_START, "job", "2.json");
	assert_true(peer_until(&p, MESSAGE_DONE));
	assert_int_equal(peer_end(&p), 0);
	assert_same_file("whole.contour", "twice.contour");
}

static void test_wrong(void **state)
{
	static const struct refusal wrong[] = {
		{ "sphere.base", { "--plane", "0,0,0" }, 2, "direction" },
		{ "sphere.base", { "--plane", "1,0,0", "--cylinder", "1,0,0" }, 2, "one of them" },
		{ "sphere.base", { "--stations", "0" }, 2, "FROM:TO:COUNT" },
		{ "sphere.base", { "--stations", "3x" }, 2, "FROM:TO:COUNT" },
		{ "sphere.base", { "--stations", "1:2" }, 2, "FROM:TO:COUNT" },
		{ "sphere.base", { "--waterlines", "2:1:3" }, 2, "exchange" },
		{ "sphere.base", { "--buttocks", "1001" }, 2, "1000" },
		{ "sphere.base", { "--stations", "600", "--buttocks", "600" }, 2, "1200" },
		{ "sphere.base", { "--stations", "3", "--from", "1" }, 2, "--from" },
		{ "sphere.base", { "--from", "1", "--point", "0,0,1" }, 2, "twice" },
		{ "sphere.base", { "--to", "1" }, 2, "--from" },
		{ "sphere.base", { "--from", "1", "--to", "0" }, 2, "above" },
		{ "sphere.base", { "--from", "0", "--to", "1" }, 2, "--spacing" },
		{ "sphere.base", { "--from", "0", "--count", "2" }, 2, "--spacing" },
		{ "sphere.base", { "--from", "0", "--spacing", "0" }, 2, "spacing" },
		{ "sphere.base", { "--cylinder", "0,0,1", "--from", "0" }, 2, "radius" },
		{ "sphere.base", { "--tolerance", "0" }, 2, "tolerance" },
		{ "point.base", { "--stations", "3" }, 1, "point" },
	};
	(void)state;
	expect_refusals(contours, wrong, sizeof wrong / sizeof *wrong, "wrong.contour");
}

int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_circles),    cmocka_unit_test(test_askew),
		cmocka_unit_test(test_holes),      cmocka_unit_test(test_cylinders),
		cmocka_unit_test(test_wigley),     cmocka_unit_test(test_draught),
		cmocka_unit_test(test_same_bytes), cmocka_unit_test(test_killed),
		cmocka_unit_test(test_wrong),
	};
	if (argc < 2)
		return 2;
	contours = realpath(argv[1], NULL); /* tests work in another folder */
	int rc = cmocka_run_group_tests(tests, enter, bodies_leave);
	free(contours);
	return rc;
}
