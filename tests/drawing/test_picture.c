/* test_picture.c - pictures: pixels, same bytes, exact paths, full disks. */
#include "picture.h"

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>
#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>

#include "file.h"
#include "stroke.h"
#include "text.h"

static char *name_in(void **state, const char *name)
{
	return text_print("%s/%s", (char *)*state, name);
}

static unsigned pixel(cairo_surface_t *s, int x, int y)
{
	const unsigned char *row =
	        cairo_image_surface_get_data(s) + (size_t)y * cairo_image_surface_get_stride(s);
	unsigned p;
	memcpy(&p, row + 4 * (size_t)x, sizeof p);
	return p & 0xFFFFFF;
}

static void test_image(void **state)
{
	/* black, white, beyond white, half light, half covered white, nothing, not a number */
	static const float color[] = { 0, 1, 7, 0.5f, 0.5f, 0, NAN };
	static const float alpha[] = { 1, 1, 1, 1, 0.5f, 0, 1 };
	static const unsigned light[] = { 0x000000, 0xFFFFFF, 0xFFFFFF, 0xBCBCBC,
		                          0xF6F7F8, 0xEDEFF1, 0x000000 };
	static const unsigned dark[] = { 0x000000, 0xFFFFFF, 0xFFFFFF, 0xBCBCBC,
		                         0xBCBCBC, 0x14171A, 0x000000 };
	const float *const planes[4] = { color, color, color, alpha };
	char *path = name_in(state, "image.tmp");
	for (int theme = 0; theme < 2; theme++) {
		assert_int_equal(picture_image(path, 7, 1, planes, theme, NULL), ST_OK);
		cairo_surface_t *s = cairo_image_surface_create_from_png(path);
		assert_int_equal(cairo_image_surface_get_width(s), 7);
		for (int i = 0; i < 7; i++)
			assert_int_equal(pixel(s, i, 0), (theme == THEME_DARK ? dark : light)[i]);
		cairo_surface_destroy(s);
	}
	unlink(path);
	free(path);
}

/* The color of a palette's entry: that of the middle of a 512th of the map. */
static unsigned entry(const struct colormap *m, int i)
{
	struct rgb c = colormap_at(m, (i + 0.5) / 512);
	return (unsigned)lrint(255 * c.r) << 16 | (unsigned)lrint(255 * c.g) << 8 |
	       (unsigned)lrint(255 * c.b);
}

static bool shows(cairo_surface_t *s, unsigned color)
{
	for (int y = 0; y < cairo_image_surface_get_height(s); y++)
		for (int x = 0; x < cairo_image_surface_get_width(s); x++)
			if (pixel(s, x, y) == color)
				return true;
	return false;
}

/* Every value has its color, and the same map gives the same bytes. */
static void test_map(void **state)
{
	static const float values[] = { -1, 0, 1, -2, 2, NAN };
	static const double axes[] = { 0, 1, -3, 5 };
	struct picture_map m = {
		.width = 3,
		.height = 2,
		.values = values,
		.title = "Mean curvature",
		.note = "surface 3",
		.symbol = "H",
		.unit = "1/m",
		.axes = axes,
		.map = { .is_signed = true, .lo = -1, .hi = 1, .knee = 1 },
	};
	char *path = name_in(state, "map.tmp"), *again = name_in(state, "again");
	assert_int_equal(picture_map(path, &m, THEME_LIGHT, NULL), ST_OK);
	assert_int_equal(picture_map(again, &m, THEME_LIGHT, NULL), ST_OK);
	char *a, *b;
	size_t n_a, n_b;
	assert_int_equal(file_read(path, UINT64_MAX, &a, &n_a, NULL), ST_OK);
	assert_int_equal(file_read(again, UINT64_MAX, &b, &n_b, NULL), ST_OK);
	assert_int_equal(n_a, n_b);
	assert_memory_equal(a, b, n_a);
	free(a);
	free(b);
	cairo_surface_t *s = cairo_image_surface_create_from_png(path);
	const unsigned colors[] = { entry(&m.map, 0), entry(&m.map, 256), entry(&m.map, 511),
		                    0x0C2850,         0x571F05,           0x7C7F82 };
	for (int i = 0; i < 6; i++)
		assert_true(shows(s, colors[i]));
	int width = cairo_image_surface_get_width(s), height = cairo_image_surface_get_height(s);
	assert_true(width > 510 + 48 && height > 512 + 72);
	cairo_surface_destroy(s);

	/* a view: as large as asked for, the ground where nothing is */
	static const float shade[] = { 1, 1, 0.86f, NAN, NAN, NAN };
	m.axes = NULL;
	m.shade = shade;
	assert_int_equal(picture_map(path, &m, THEME_DARK, NULL), ST_OK);
	s = cairo_image_surface_create_from_png(path);
	/* the first row is seen, below it nothing is */
	assert_int_equal(pixel(s, 24, 72), entry(&m.map, 0));
	for (int i = 0; i < 3; i++)
		assert_int_equal(pixel(s, 24 + i, 73), 0x14171A);
	assert_true(cairo_image_surface_get_width(s) < width);
	cairo_surface_destroy(s);

	/* too large for a picture */
	struct report_store said;
	report_store_init(&said);
	m.width = 40000;
	m.height = 1;
	float *many = calloc(40000, sizeof *many);
	m.values = many;
	m.shade = NULL;
	assert_int_equal(picture_map(again, &m, THEME_DARK, &said.report), ST_RESOURCE);
	assert_non_null(strstr(said.error, "smaller size"));
	free(many);
	unlink(path);
	unlink(again);
	free(path);
	free(again);
}

/* A cubic B-spline (polynomial or not) of a zigzag. */
static void zigzag(struct curve *c, int order, int n, bool rational)
{
	assert_int_equal(curve_init(c, order, n), ST_OK);
	for (int i = 0; i < n + order; i++)
		c->knots[i] = i < order ? 0 : i < n ? i - order + 1 : n - order + 1;
	for (int i = 0; i < n; i++)
		curve_set_point(c, i, vec3(i, i % 2 * 3, i % 3), rational ? 1 + i % 4 : 1);
	assert_int_equal(curve_check(c, "zigzag", NULL), ST_OK);
}

/* Every point of the curve is met by its piece; cubics seen straight keep their spans. */
static void test_stroke(void **state)
{
	static const struct {
		const char *view;
		int order;
		bool rational;
		size_t pieces; /* 0: any */
		double error;
	} cases[] = {
		{ "three-quarter", 4, false, 9, 1e-6 },
		{ "front", 3, false, 10, 1e-6 },
		{ "top", 2, false, 11, 1e-6 },
		{ "three-quarter", 4, true, 0, 0.3 },
		{ "three-quarter", 6, false, 0, 0.3 },
		{ "three-quarter:perspective@60", 4, false, 0, 0.3 },
		{ "top:perspective@60", 4, true, 0, 0.3 },
	};
	(void)state;
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct curve c;
		struct box box;
		struct camera camera;
		struct stroke s = { 0 };
		zigzag(&c, cases[k].order, 12, cases[k].rational);
		assert_int_equal(curve_box(&c, 0, &box), ST_OK);
		assert_int_equal(camera_fit(&camera, cases[k].view, &box, 800, 600, NULL), ST_OK);
		assert_int_equal(stroke_add(&s, &camera, &c, false), ST_OK);
		if (cases[k].pieces)
			assert_int_equal(s.n, cases[k].pieces);
		else
			assert_true(s.n > 8 && s.n < 200);
		assert_true(s.pieces[0].begins);
		/* pieces are short, so a dense sampling of them comes near to every point */
		for (int i = 0; i <= 200; i++) {
			double t = c.domain[0] + (c.domain[1] - c.domain[0]) * i / 200, at[2],
			       depth;
			double best = INFINITY;
			assert_true(camera_project(&camera, curve_point(&c, t), &at[0], &at[1],
			                           &depth));
			for (size_t p = 0; p < s.n; p++)
				for (int j = 0; j <= 600; j++) {
					const double x = j / 600.0, y = 1 - x;
					double d[2];
					for (int a = 0; a < 2; a++)
						d[a] = y * y * y * s.pieces[p].p[0][a] +
						       3 * x * y * y * s.pieces[p].p[1][a] +
						       3 * x * x * y * s.pieces[p].p[2][a] +
						       x * x * x * s.pieces[p].p[3][a] - at[a];
					best = fmin(best, hypot(d[0], d[1]));
				}
			/* half the way between samples, and the error allowed */
			assert_true(best < 0.25 + cases[k].error);
			if (cases[k].pieces && i == 0)
				assert_true(best < 1e-9);
		}
		for (size_t p = 1; p < s.n; p++) {
			assert_false(s.pieces[p].begins);
			assert_true(hypot(s.pieces[p].p[0][0] - s.pieces[p - 1].p[3][0],
			                  s.pieces[p].p[0][1] - s.pieces[p - 1].p[3][1]) < 1e-6);
		}
		struct stroke joined = { 0 };
		assert_int_equal(stroke_add(&joined, &camera, &c, true), ST_OK);
		assert_true(joined.n <= s.n);
		assert_true(fabs(stroke_length(&joined) - stroke_length(&s)) <
		            0.01 * stroke_length(&s));
		stroke_finish(&joined);
		stroke_finish(&s);
		curve_finish(&c);
	}
}

static int count(const char *text, const char *what)
{
	int n = 0;
	for (const char *at = text; (at = strstr(at, what)); at++)
		n++;
	return n;
}

static void test_lines(void **state)
{
	struct curve c;
	struct surface s;
	struct box box;
	struct camera camera;
	assert_int_equal(surface_init(&s, (int[]){ 2, 2 }, (int[]){ 2, 2 }), ST_OK);
	for (int i = 0; i < 4; i++) {
		s.knots[0][i] = s.knots[1][i] = i / 2;
		s.points[4 * i] = 11 * (i / 2);
		s.points[4 * i + 1] = 4 * (i % 2);
		s.points[4 * i + 3] = 1;
	}
	assert_int_equal(surface_check(&s, "square", NULL), ST_OK);
	zigzag(&c, 4, 12, false);
	assert_int_equal(surface_box(&s, 0, &box), ST_OK);
	assert_int_equal(camera_fit(&camera, "top", &box, 640, 400, NULL), ST_OK);
	const struct surface *surfaces[] = { &s };
	struct picture_curve curves[] = { { &c, { 1, 0, 0 }, 1.5, "45° < \"60\" & more" },
		                          { &c, { 0, 0, 1 }, 0.75, NULL } };
	struct picture_lines lines = { .camera = &camera,
		                       .surfaces = surfaces,
		                       .n_surfaces = 1,
		                       .curves = curves,
		                       .n_curves = 2,
		                       .title = "Isophotes" };
	char *path = name_in(state, "lines.tmp"), *a, *b;
	size_t n_a, n_b;
	assert_int_equal(picture_lines(path, PICTURE_SVG, &lines, THEME_LIGHT, NULL), ST_OK);
	assert_int_equal(file_read(path, UINT64_MAX, &a, &n_a, NULL), ST_OK);
	assert_int_equal(picture_lines(path, PICTURE_SVG, &lines, THEME_LIGHT, NULL), ST_OK);
	assert_int_equal(file_read(path, UINT64_MAX, &b, &n_b, NULL), ST_OK);
	assert_string_equal(a, b);
	assert_true(!strncmp(a, "<svg xmlns=", 11) && !strcmp(a + n_a - 7, "</svg>\n"));
	assert_int_equal(count(a, "class=\"curve\""), 2);
	assert_int_equal(count(a, "class=\"wire\""), 1);
	assert_int_equal(count(a, "stroke=\"#ff0000\""), 1);
	assert_non_null(strstr(a, ">45° &lt; \"60\" &amp; more</text>"));
	/* the border of a plane is four straight lines, corners at the margins */
	const char *border = strstr(a, "class=\"border\"");
	assert_non_null(strstr(border, "M38.4 "));
	assert_non_null(strstr(border, "l563.2 0"));
	assert_true(n_a < 6000);
	free(a);
	free(b);
	assert_int_equal(picture_lines(path, PICTURE_PNG, &lines, THEME_DARK, NULL), ST_OK);
	cairo_surface_t *png = cairo_image_surface_create_from_png(path);
	assert_int_equal(cairo_image_surface_get_width(png), 640);
	assert_int_equal(cairo_image_surface_get_height(png), 400);
	assert_int_equal(pixel(png, 639, 399), 0x14171A);
	cairo_surface_destroy(png);
	unlink(path);
	free(path);
	curve_finish(&c);
	surface_finish(&s);
}

static void test_failures(void **state)
{
	struct report_store said;
	static const float one[64 * 64] = { 0 };
	const float *const planes[4] = { one, one, one, one };
	report_store_init(&said);
	char *path = name_in(state, "no/such.png");
	assert_int_equal(picture_image(path, 64, 64, planes, THEME_DARK, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "such.png"));
	free(path);

	struct rlimit old, none;
	getrlimit(RLIMIT_FSIZE, &old);
	none = old;
	none.rlim_cur = 20;
	void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
	path = name_in(state, "full");
	struct camera camera;
	struct box box = { { 0, 0, 0 }, { 1, 1, 1 } };
	assert_int_equal(camera_fit(&camera, "top", &box, 640, 400, NULL), ST_OK);
	struct picture_lines lines = { .camera = &camera };
	for (int k = 0; k < 3; k++) {
		report_store_init(&said);
		setrlimit(RLIMIT_FSIZE, &none);
		enum status st =
		        k == 2 ? picture_image(path, 64, 64, planes, THEME_DARK, &said.report)
		               : picture_lines(path, k ? PICTURE_SVG : PICTURE_PNG, &lines,
		                               THEME_LIGHT, &said.report);
		setrlimit(RLIMIT_FSIZE, &old);
		assert_int_equal(st, ST_RESOURCE);
		assert_non_null(strstr(said.error, "make room"));
		assert_int_equal(access(path, F_OK), -1);
	}
	signal(SIGXFSZ, handler);
	free(path);
}

static int make_folder(void **state)
{
	char folder[] = "/tmp/test-picture-XXXXXX";
	*state = mkdtemp(folder) ? strdup(folder) : NULL;
	return *state ? 0 : -1;
}

/* Caches of the text libraries are given back, so that what is left is a leak of ours. */
static int clean_up(void **state)
{
	int rc = rmdir(*state);
	free(*state);
	pango_cairo_font_map_set_default(NULL);
	cairo_debug_reset_static_data();
	FcFini();
	return rc;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_image),    cmocka_unit_test(test_map),
		cmocka_unit_test(test_stroke),   cmocka_unit_test(test_lines),
		cmocka_unit_test(test_failures),
	};
	return cmocka_run_group_tests(tests, make_folder, clean_up);
}
