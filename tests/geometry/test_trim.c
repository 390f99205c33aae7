/* test_trim.c - points, boxes and areas of trimmed surfaces. */
#include "cmocka_all.h"
#include "trim_shapes.h"

static struct trim_test *prepare(const struct trim *t, const struct surface *s)
{
	struct trim_test *x;
	assert_int_equal(trim_test_create(&x, t, s), ST_OK);
	return x;
}

/* A closed curve of any order and shape about (0.5, 0.5); it may cross itself. */
static struct curve any_loop(int order, int n, bool rational, uint64_t *seed)
{
	struct curve c;
	assert_int_equal(curve_init(&c, order, n), ST_OK);
	shape_fill_knots(c.knots, order, n, KNOTS_UNEVEN);
	for (int i = 0; i < n; i++) {
		double angle = 2 * M_PI * i / (n - 1), r = 0.1 + 0.38 * shape_random(seed);
		if (i < n - 1)
			curve_set_point(&c, i, vec3(0.5 + r * cos(angle), 0.5 + r * sin(angle), 0),
			                rational ? 0.3 + 2 * shape_random(seed) : 1);
	}
	memcpy(c.points + 4 * (size_t)(n - 1), c.points, 4 * sizeof *c.points);
	assert_int_equal(curve_check(&c, "loop", NULL), ST_OK);
	return c;
}

/* Parity of crossings of the curve's polygon, and the distance of the point from it. */
static bool polygon_inside(const struct vec3 *p, int n, double u, double v, double *distance)
{
	bool odd = false;
	*distance = INFINITY;
	for (int i = 0; i < n; i++) {
		struct vec3 a = p[i], b = p[(i + 1) % n], d = vec3_sub(b, a), at = vec3(u, v, 0);
		double l = vec3_dot(d, d), t = l > 0 ? vec3_dot(vec3_sub(at, a), d) / l : 0;
		struct vec3 foot = vec3_along(a, fmin(fmax(t, 0), 1), d);
		*distance = fmin(*distance, vec3_length(vec3_sub(at, foot)));
		if ((a.y <= v) != (b.y <= v))
			odd ^= u < a.x + (v - a.y) / (b.y - a.y) * (b.x - a.x);
	}
	return odd;
}

static void points_agree_with_polygons(void **state)
{
	enum { SIDES = 10000, POINTS = 300 };
	static struct vec3 polygon[SIDES];
	struct surface s = shape_plane(1, 1);
	int tested = 0;
	(void)state;
	for (uint64_t k = 0; k < 24; k++) {
		uint64_t seed = k;
		struct trim t = { 0 };
		struct trim_loop l = { .outer = true };
		struct curve c = any_loop(2 + (int)k % 5, 12 + (int)k, k % 2, &seed);
		double side = 0;
		for (int i = 0; i < SIDES; i++) {
			polygon[i] = curve_point(&c, (double)i / SIDES);
			if (i)
				side = fmax(side,
				            vec3_length(vec3_sub(polygon[i], polygon[i - 1])));
		}
		trim_put(&l, c);
		trim_close(&t, l);
		struct trim_test *x = prepare(&t, &s);
		for (int i = 0; i < POINTS; i++) {
			double u = shape_random(&seed), v = shape_random(&seed), distance;
			if (i % 3 == 0) { /* near the curve */
				struct vec3 p = polygon[(int)(u * SIDES)];
				u = p.x + 1e-3 * (shape_random(&seed) - 0.5);
				v = p.y + 1e-3 * (shape_random(&seed) - 0.5);
			}
			bool in = polygon_inside(polygon, SIDES, u, v, &distance);
			if (distance < side) /* the polygon cuts corners */
				continue;
			assert_int_equal(trim_test_inside(x, u, v), in);
			tested++;
		}
		trim_test_destroy(x);
		trim_finish(&t);
	}
	assert_true(tested > 12 * POINTS);
	surface_finish(&s);
}

/* Both sides of a circle, a hair away, also level with where it turns and where its arcs join. */
static void points_at_a_hair_from_a_circle(void **state)
{
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (int k = 0; k < 20; k++) {
		struct trim t = { 0 };
		double r = 0.05 + 0.02 * k;
		trim_add_ellipse(&t, k % 2, 0.5, 0.5, r, r, k % 3 ? 0.1 * k : 0);
		struct trim_test *x = prepare(&t, &s);
		for (int i = 0; i < 720; i++) {
			double a = M_PI * i / 360, c = cos(a), d = sin(a);
			double in = r - 2e-12, out = r + 2e-12;
			assert_int_equal(trim_test_inside(x, 0.5 + in * c, 0.5 + in * d), k % 2);
			assert_int_equal(trim_test_inside(x, 0.5 + out * c, 0.5 + out * d),
			                 !(k % 2));
		}
		/* lines through the topmost, lowest and joining points to the bit */
		for (int i = 0; i <= 100; i++) {
			double u = i / 100.0;
			for (int j = -1; j <= 1; j += 2)
				if (fabs(u - 0.5) > 1e-5)
					assert_int_equal(trim_test_inside(x, u, 0.5 + j * r),
					                 !(k % 2));
			bool in = fabs(u - 0.5)<r - 1e-12, out = fabs(u - 0.5)> r + 1e-12;
			if (in || out)
				assert_int_equal(trim_test_inside(x, u, 0.5), in == k % 2);
		}
		trim_test_destroy(x);
		trim_finish(&t);
	}
	surface_finish(&s);
}

static void the_whole_border_trims_nothing(void **state)
{
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (int turned = 0; turned < 2; turned++) {
		struct trim t = { 0 };
		trim_add_box(&t, true, 0, 0, 1, 1);
		for (int i = 0; turned && i < 4; i++) {
			struct curve *c = t.loops[0].curves;
			if (i < 2) {
				struct curve x = c[i];
				c[i] = c[3 - i];
				c[3 - i] = x;
			}
		}
		for (int i = 0; turned && i < 4; i++)
			curve_reverse(&t.loops[0].curves[i]);
		struct trim_test *x = prepare(&t, &s);
		for (int i = 0; i <= 16; i++)
			for (int j = 0; j <= 16; j++)
				assert_true(trim_test_inside(x, i / 16.0, j / 16.0));
		assert_int_equal(trim_test_box(x, (double[2]){ 0, 0 }, (double[2]){ 1, 1 }), 1);
		trim_test_destroy(x);
		trim_finish(&t);
	}
	/* half of it: the common line belongs to one of the two at least, the border to its half */
	struct trim left = { 0 }, right = { 0 };
	trim_add_box(&left, true, 0, 0, 0.375, 1);
	trim_add_box(&right, true, 0.375, 0, 1, 1);
	struct trim_test *x = prepare(&left, &s), *y = prepare(&right, &s);
	for (int i = 0; i <= 64; i++)
		for (int j = 0; j <= 16; j++) {
			double u = i / 64.0, v = j / 16.0;
			assert_int_equal(trim_test_inside(x, u, v), u < 0.375);
			assert_int_equal(trim_test_inside(y, u, v), u >= 0.375);
		}
	trim_test_destroy(x);
	trim_test_destroy(y);
	trim_finish(&left);
	trim_finish(&right);
	surface_finish(&s);
}

static void boxes_agree_with_their_points(void **state)
{
	struct surface s = shape_plane(1, 1);
	int seen[3] = { 0 };
	(void)state;
	for (uint64_t k = 0; k < 8; k++) {
		uint64_t seed = 100 + k;
		struct trim t = { 0 };
		struct trim_loop l = { .outer = true };
		trim_put(&l, any_loop(4, 14, k % 2, &seed));
		trim_close(&t, l);
		trim_add_ellipse(&t, false, 0.45, 0.55, 0.05, 0.02, 0);
		struct trim_test *x = prepare(&t, &s);
		for (int i = 0; i < 2000; i++) {
			double size = pow(10, -3 * shape_random(&seed)) / 2, lo[2], hi[2];
			for (int d = 0; d < 2; d++) {
				lo[d] = (1 - size) * shape_random(&seed);
				hi[d] = lo[d] + size;
			}
			int box = trim_test_box(x, lo, hi), in = 0;
			for (int j = 0; j < 36; j++)
				in += trim_test_inside(x, lo[0] + j % 6 / 5.0 * size,
				                       lo[1] + j / 6 / 5.0 * size);
			seen[box + 1]++;
			if (box)
				assert_int_equal(in, box > 0 ? 36 : 0);
		}
		trim_test_destroy(x);
		trim_finish(&t);
	}
	for (int i = 0; i < 3; i++)
		assert_true(seen[i] > 500);
	/* a box that a circle passes by, though not that of its arc */
	struct trim t = { 0 };
	trim_add_ellipse(&t, true, 0.5, 0.5, 0.25, 0.25, 0);
	struct trim_test *x = prepare(&t, &s);
	assert_int_equal(trim_test_box(x, (double[2]){ 0.7, 0.7 }, (double[2]){ 0.74, 0.74 }), -1);
	assert_int_equal(trim_test_box(x, (double[2]){ 0.6, 0.6 }, (double[2]){ 0.67, 0.67 }), 1);
	trim_test_destroy(x);
	trim_finish(&t);
	surface_finish(&s);
}

static double area_of(const struct trim *t, const struct surface *s, double accuracy)
{
	double area, error;
	assert_int_equal(trim_area(t, s, accuracy, &area, &error), ST_OK);
	assert_true(error <= 10 * accuracy * area + 1e-15);
	return area;
}

static void areas_of_plane_figures(void **state)
{
	struct surface s = shape_plane(3, 2);
	(void)state;
	for (int k = 0; k < 6; k++) {
		struct trim t = { 0 };
		double turn = 0.3 * k;
		/* a u of 1 is 3 long, a v 2 */
		trim_add_ellipse(&t, true, 0.5, 0.5, 0.45, 0.45, turn);
		assert_float_equal(area_of(&t, &s, 1e-11), 6 * M_PI * 0.45 * 0.45, 1e-10);
		trim_add_ellipse(&t, false, 0.55, 0.45, 0.2, 0.1, turn);
		assert_float_equal(area_of(&t, &s, 1e-11), 6 * M_PI * (0.45 * 0.45 - 0.2 * 0.1),
		                   1e-10);
		trim_finish(&t);
		trim_add_box(&t, false, 0.25, 0.25, 0.75, 0.5);
		assert_float_equal(area_of(&t, &s, 1e-11), 6 - 6 * 0.125, 1e-10);
		trim_finish(&t);
	}
	surface_finish(&s);
}

static void areas_add_up(void **state)
{
	const int order[2] = { 4, 3 }, n[2] = { 9, 7 };
	struct surface s = shape_surface(order, n, true, KNOTS_UNEVEN, 5);
	double error, whole = surface_area(&s, 1e-10, &error);
	struct trim t = { 0 };
	(void)state;
	assert_true(area_of(&t, &s, 1e-10) == whole);
	trim_add_box(&t, true, 0, 0, 1, 1);
	assert_float_equal(area_of(&t, &s, 1e-9), whole, 2e-9 * whole);
	trim_finish(&t);
	for (int k = 0; k < 3; k++) {
		double in, out;
		uint64_t seed = k;
		for (int outer = 0; outer < 2; outer++) {
			struct trim_loop l = { .outer = outer };
			uint64_t again = seed;
			struct curve c = any_loop(4, 9, k % 2, &again);
			trim_put(&l, c);
			trim_close(&t, l);
			*(outer ? &in : &out) = area_of(&t, &s, 1e-8);
			trim_finish(&t);
		}
		assert_float_equal(in + out, whole, 4e-8 * whole);
	}
	surface_finish(&s);
}

/* The part of a sphere above a height is 2 pi r h; the loop is a line v = const. round the pole. */
static void area_of_a_cap(void **state)
{
	struct surface s = shape_sphere(2);
	(void)state;
	for (int k = 1; k < 4; k++) {
		struct trim t = { 0 };
		double v = 0.5 + 0.125 * k, z = surface_point(&s, 0, v).z;
		trim_add_box(&t, true, 0, v, 1, 1);
		assert_float_equal(area_of(&t, &s, 1e-10), 2 * M_PI * 2 * (2 - z), 1e-8);
		trim_finish(&t);
	}
	surface_finish(&s);
}

/* Two loops that share a line, faces side by side on one surface. */
static void neighbours_share_a_line(void **state)
{
	struct surface s = shape_plane(1, 1);
	struct trim t = { 0 };
	(void)state;
	trim_add_box(&t, true, 0.1, 0.1, 0.3, 0.9);
	trim_add_box(&t, true, 0.3, 0.1, 0.8, 0.9);
	assert_float_equal(area_of(&t, &s, 1e-12), 0.7 * 0.8, 1e-12);
	struct trim_test *x = prepare(&t, &s);
	for (int i = 11; i < 90; i++)
		assert_true(trim_test_inside(x, 0.3, i / 100.0));
	trim_test_destroy(x);
	trim_finish(&t);
	surface_finish(&s);
}

/* Loops that do not close, lie anywhere, are of any size: no crash, no hang, and boxes still tell the
 * truth of their points. */
static void nonsense_is_survived(void **state)
{
	const int order[2] = { 3, 3 }, n[2] = { 4, 4 };
	struct surface s = shape_surface(order, n, true, KNOTS_UNEVEN, 2);
	(void)state;
	for (uint64_t seed = 0; seed < 16; seed++) {
		uint64_t random = seed;
		struct trim t = { 0 };
		for (int i = 0; i < 3; i++) {
			struct trim_loop l = { .outer = shape_random(&random) < 0.5 };
			for (int j = 0; j < 3; j++) {
				struct curve c = any_loop(2 + (int)(seed % 5), 9, j % 2, &random);
				double big = seed % 4 ? 1 : pow(10, 300 * shape_random(&random));
				for (int k = 0; k < c.n; k++) {
					c.points[4 * k] *= big * 2 * shape_random(&random);
					c.points[4 * k + 1] -= shape_random(&random);
				}
				trim_put(&l, c);
			}
			trim_close(&t, l);
		}
		struct trim_test *x = prepare(&t, &s);
		double range[2][2], area, error;
		bool any = trim_test_range(x, range);
		for (int i = 0; i < 400; i++) {
			double u = shape_random(&random), v = shape_random(&random);
			double e = 0.05 * shape_random(&random);
			int box = trim_test_box(x, (double[2]){ u - e, v - e },
			                        (double[2]){ u + e, v + e });
			bool in = trim_test_inside(x, u, v);
			assert_true(box == 0 || (box > 0) == in);
			assert_true(!in || (any && u >= range[0][0] && u <= range[0][1] &&
			                    v >= range[1][0] && v <= range[1][1]));
		}
		assert_int_equal(trim_area(&t, &s, 1e-2, &area, &error), ST_OK);
		enum status st = trim_mend(&t, &s, 1e-6, "nonsense", NULL);
		assert_true(st == ST_OK || st == ST_INPUT);
		trim_test_destroy(x);
		trim_finish(&t);
	}
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(points_agree_with_polygons),
		cmocka_unit_test(points_at_a_hair_from_a_circle),
		cmocka_unit_test(the_whole_border_trims_nothing),
		cmocka_unit_test(boxes_agree_with_their_points),
		cmocka_unit_test(areas_of_plane_figures),
		cmocka_unit_test(areas_add_up),
		cmocka_unit_test(area_of_a_cap),
		cmocka_unit_test(neighbours_share_a_line),
		cmocka_unit_test(nonsense_is_survived),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
