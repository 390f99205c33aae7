/* test_colormap.c - ranges, scales and colors of maps; marks at round numbers. */
#include "colormap.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ticks.h"

static void near(double a, double b, double tolerance)
{
	if (!(fabs(a - b) <= tolerance))
		fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

static void same_color(struct rgb c, unsigned hex)
{
	near(255 * c.r, hex >> 16 & 255, 1e-9);
	near(255 * c.g, hex >> 8 & 255, 1e-9);
	near(255 * c.b, hex & 255, 1e-9);
}

static void test_stops(void **state)
{
	static const struct colormap both = { .is_signed = true, .lo = -3, .hi = 3 };
	static const struct colormap one = { .is_signed = false, .lo = 0, .hi = 8 };
	static const struct colormap uneven = { .is_signed = true, .lo = -1, .hi = 3 };
	static const struct colormap above_zero = { .is_signed = true, .lo = 1, .hi = 3 };
	static const struct {
		const struct colormap *map;
		double value;
		unsigned color;
	} cases[] = {
		{ &both, -3, 0x1F58A4 },       { &both, -1, 0xAFCBE0 },
		{ &both, 0, 0xE6E6E3 },        { &both, 2, 0xDA8544 },
		{ &both, 3, 0xA4460F },        { &both, -3.01, 0x0C2850 },
		{ &both, 3.01, 0x571F05 },     { &both, NAN, 0x7C7F82 },
		{ &both, INFINITY, 0x571F05 }, { &one, 0, 0x440154 },
		{ &one, 4, 0x21918C },         { &one, 8, 0xFDE725 },
		{ &one, -1e-9, 0x1D0226 },     { &one, 8.1, 0xFFF7C2 },
		{ &one, NAN, 0x7C7F82 },       { &uneven, 0, 0xE6E6E3 },
		{ &uneven, 3, 0xA4460F },      { &uneven, -1, 0xAFCBE0 },
		{ &above_zero, 1, 0x1F58A4 },  { &above_zero, 2, 0xE6E6E3 },
	};
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
		same_color(colormap_color(cases[i].map, cases[i].value), cases[i].color);
	/* half way in linear light, not in sRGB */
	struct rgb c = colormap_at(&one, 0.5 / 8);
	near(rgb_to_linear(c.g), (rgb_to_linear(1 / 255.0) + rgb_to_linear(0x2D / 255.0)) / 2,
	     1e-12);
}

static void test_scales(void **state)
{
	static const struct colormap maps[] = {
		{ true, -3, 3, .knee = 1 },
		{ true, -3, 3, .arsinh = true, .knee = 0.1 },
		{ false, 0.5, 1e6, .arsinh = true, .knee = 10 },
		{ false, 2, 7, .by_hand = true, .knee = 1 },
	};
	(void)state;
	for (size_t k = 0; k < sizeof maps / sizeof *maps; k++) {
		const struct colormap *m = &maps[k];
		double before = -INFINITY;
		near(colormap_position(m, m->lo), 0, 1e-15);
		near(colormap_position(m, m->hi), 1, 1e-15);
		for (int i = -2; i <= 22; i++) {
			double value = colormap_value(m, i / 20.0);
			near(colormap_position(m, value), i / 20.0, 1e-12);
			assert_true(value > before);
			before = value;
		}
	}
}

static struct colormap fit(bool is_signed, double rounding, const float *v, const float *w,
                           size_t n)
{
	struct colormap m;
	assert_int_equal(colormap_fit(&m, is_signed, COLORMAP_AUTOMATIC, rounding, v, w, n), ST_OK);
	assert_true(m.hi > m.lo && m.knee > 0 && !m.by_hand);
	return m;
}

static void test_range(void **state)
{
	enum { N = 1001 };
	float v[N], w[N];
	(void)state;
	for (int i = 0; i < N; i++) {
		v[i] = (float)((i * 617 % N) / 10.0); /* 0 .. 100, shuffled */
		w[i] = v[i] < 50 ? 1 : 0;
	}
	struct colormap m = fit(false, 0, v, NULL, N);
	near(m.lo, 0, 0); /* 2 is near enough to zero */
	near(m.hi, 98, 0.11);
	assert_false(m.arsinh);
	m = fit(true, 0, v, NULL, N);
	near(m.lo, -m.hi, 0);
	near(m.hi, 98, 0.11);
	m = fit(false, 0, v, w, N); /* areas count */
	near(m.hi, 49, 0.11);
	for (int i = 0; i < N; i++)
		v[i] += 1000;
	m = fit(false, 0, v, NULL, N);
	near(m.lo, 1002, 0.11);
	/* no value, infinite and without an area: left out */
	for (int i = 0; i < N; i++)
		v[i] = i % 4 == 0   ? NAN
		       : i % 4 == 1 ? INFINITY
		       : i % 4 == 2 ? 1e9f
		                    : (float)(i % 8);
	for (int i = 0; i < N; i++)
		w[i] = i % 4 == 2 ? 0 : 1;
	m = fit(false, 0, v, w, N);
	near(m.lo, 3, 0);
	near(m.hi, 7, 0);
}

/* The same everywhere, rounding only, nothing at all: still a map to look at. */
static void test_constant(void **state)
{
	enum { N = 100 };
	static const float values[] = { 4, -0.25f, 1e-30f, 12345 };
	float v[N];
	(void)state;
	for (int k = 0; k < 4; k++)
		for (int is_signed = 0; is_signed < 2; is_signed++) {
			for (int i = 0; i < N; i++)
				v[i] = (is_signed ? values[k] : fabsf(values[k])) *
				       (1 + 1e-7f * (i % 3));
			struct colormap m = fit(is_signed, 0, v, NULL, N);
			double at = colormap_position(&m, v[0]);
			assert_true(at > 0.05 && at < 0.95);
			assert_true(m.one && !m.arsinh);
		}
	for (int i = 0; i < N; i++)
		v[i] = 1e-17f * (float)(i % 5 - 2);
	struct colormap m = fit(true, 1e-9, v, NULL, N);
	near(m.hi, 1e-9, 0);
	near(colormap_position(&m, v[0]), 0.5, 1e-6);
	for (int i = 0; i < N; i++)
		v[i] = 0;
	fit(true, 0, v, NULL, N);
	fit(false, 0, v, NULL, N);
	v[3] = 8; /* one that differs */
	m = fit(true, 0, v, NULL, N);
	near(m.hi, 8, 0);
	for (int i = 0; i < N; i++)
		v[i] = NAN;
	m = fit(false, 0, v, NULL, N);
	near(m.lo, 0, 0);
	near(m.hi, 1, 0);
	fit(true, 0, v, NULL, 0);
}

static void test_crowded(void **state)
{
	enum { N = 1000 };
	float v[N];
	struct colormap m;
	(void)state;
	for (int i = 0; i < N; i++)
		v[i] = i % 20 == 0 ? 100.0f + i : 0.1f + (float)(i % 7) / 100;
	assert_true(fit(false, 0, v, NULL, N).arsinh);
	assert_true(fit(true, 0, v, NULL, N).arsinh);
	assert_int_equal(colormap_fit(&m, true, COLORMAP_LINEAR, 0, v, NULL, N), ST_OK);
	assert_false(m.arsinh);
	for (int i = 0; i < N; i++)
		v[i] = i;
	assert_false(fit(false, 0, v, NULL, N).arsinh);
	assert_int_equal(colormap_fit(&m, false, COLORMAP_ARSINH, 0, v, NULL, N), ST_OK);
	assert_true(m.arsinh);
	colormap_set_range(&m, -2, 5);
	assert_true(m.by_hand && m.arsinh && m.knee > 0 && m.knee < 5);
	near(m.lo, -2, 0);
	near(m.hi, 5, 0);
}

static void test_ticks_linear(void **state)
{
	static const struct {
		double lo, hi, gap;
		const char *texts;
	} cases[] = {
		{ 0, 1, 0.2, "0 0.2 0.4 0.6 0.8 1.0" },
		{ 0, 1, 0.21, "0 0.5 1.0" },
		{ -3.2, 3.2, 0.15, "−3 −2 −1 0 1 2 3" },
		{ -0.3, 2.1, 0.2, "0 0.5 1.0 1.5 2.0" },
		{ 0, 0.00765, 0.2, "0 0.002 0.004 0.006" },
		{ 0, 98000, 0.2, "0 20000 40000 60000 80000" },
		{ 0, 250000, 0.3, "0 1·10⁵ 2·10⁵" },
		{ -1e-9, 1e-9, 0.25, "−1.0·10⁻⁹ −5·10⁻¹⁰ 0 5·10⁻¹⁰ 1.0·10⁻⁹" },
		{ 1000.5, 1001.5, 0.3, "1000.5 1001.0 1001.5" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct ticks t;
		char all[TICKS_MAX * TICK_TEXT] = "";
		ticks_linear(&t, cases[i].lo, cases[i].hi, cases[i].gap);
		for (int k = 0; k < t.n; k++) {
			strcat(all, k ? " " : "");
			strcat(all, t.text[k]);
		}
		assert_string_equal(all, cases[i].texts);
	}
}

/* On every scale: rising, inside, apart, more than one. */
static void test_ticks_colormap(void **state)
{
	(void)state;
	for (int k = 0; k < 400; k++) {
		double hi = pow(10, (k % 40) / 2.0 - 10), lo = k / 200 ? -hi : 0;
		struct colormap m = { lo < 0, lo, hi, .arsinh = k / 100 % 2,
			              .knee = hi * pow(10, -1 - k % 4) };
		struct ticks t;
		const double gap = 0.14;
		ticks_colormap(&t, &m, gap);
		assert_true(t.n >= 2);
		for (int i = 0; i < t.n; i++) {
			double at = colormap_position(&m, t.value[i]);
			assert_true(at > -1e-6 && at < 1 + 1e-6);
			if (i)
				assert_true(at - colormap_position(&m, t.value[i - 1]) >
				            gap * 0.999);
		}
	}
}

static void test_numbers(void **state)
{
	static const struct {
		double x;
		const char *text;
	} cases[] = {
		{ 0, "0" },
		{ 1, "1" },
		{ -0.25, "−0.25" },
		{ 76480, "76500" },
		{ 158.3, "158" },
		{ 0.00123456, "0.00123" },
		{ 99.99, "100" },
		{ 5.82e-8, "5.82·10⁻⁸" },
		{ 5e-8, "5·10⁻⁸" },
		{ -1.5e12, "−1.5·10¹²" },
		{ 123456, "1.23·10⁵" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		char text[TICK_TEXT];
		number_for_reader(text, cases[i].x, 3);
		assert_string_equal(text, cases[i].text);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_stops),          cmocka_unit_test(test_scales),
		cmocka_unit_test(test_range),          cmocka_unit_test(test_constant),
		cmocka_unit_test(test_crowded),        cmocka_unit_test(test_ticks_linear),
		cmocka_unit_test(test_ticks_colormap), cmocka_unit_test(test_numbers),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
