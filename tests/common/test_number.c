/* test_number.c - numbers are read to the nearest double and written so that they read back. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "number.h"

static uint64_t random_state = 1989;

static uint64_t random_bits(void) /* SplitMix64 */
{
	uint64_t z = (random_state += 0x9e3779b97f4a7c15u);

	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return z ^ (z >> 31);
}

static double read_all(const char *s)
{
	const char *p = s, *end = s + strlen(s);
	double x;

	assert_true(number_read(&p, end, &x));
	assert_ptr_equal(p, end);
	return x;
}

static void reads_table(void **state)
{
	static const struct {
		const char *text;
		double value;
	} rows[] = {
		{ "0", 0 },
		{ "-0.", -0.0 },
		{ "+1.5", 1.5 },
		{ ".5", 0.5 },
		{ "1D3", 1000 },
		{ "1.d-3", 0.001 },
		{ "1e400", INFINITY },
		{ "1e-400", 0 },
		{ "4.9406564584124654e-324", 4.9406564584124654e-324 },
		{ "1.7976931348623157e308", DBL_MAX },
		{ "9007199254740993", 9007199254740992.0 },
		{ "9007199254740993.00000000000000000000000001", 9007199254740994.0 },
		{ "0.1000000000000000055511151231257827021181583404541015625", 0.1 },
		{ "00000000000000000000000000000000000001.25", 1.25 },
		{ "123456789012345678901234567890", 123456789012345678901234567890.0 },
	};

	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
		assert_true(read_all(rows[i].text) == rows[i].value);
	assert_true(signbit(read_all("-0.")));
}

static void refuses_what_is_no_number(void **state)
{
	static const char *const rows[] = { "", "-", ".", "e5", "nan", "inf", "+-1", "x", " 1" };
	double x;

	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		const char *p = rows[i];
		assert_false(number_read(&p, rows[i] + strlen(rows[i]), &x));
		assert_ptr_equal(p, rows[i]);
	}
	assert_false(number_parse("1 ", &x));
	assert_false(number_parse("1e999", &x));
}

static void an_exponent_needs_digits(void **state)
{
	const char *s = "2e+", *p = s;
	double x;

	(void)state;
	assert_true(number_read(&p, s + 3, &x));
	assert_true(x == 2);
	assert_ptr_equal(p, s + 1);
}

static void agrees_with_strtod(void **state)
{
	char s[64];

	(void)state;
	for (int i = 0; i < 300000; i++) {
		uint64_t digits = random_bits() >> (random_bits() % 60);
		int exponent = (int)(random_bits() % 60) - 40;
		snprintf(s, sizeof s, "%llue%d", (unsigned long long)digits, exponent);
		assert_true(read_all(s) == strtod(s, NULL));
	}
}

static void ties_round_to_even(void **state)
{
	char s[64];

	(void)state;
	/* halves between neighbouring doubles of 54 bits, and one unit beside them */
	for (int i = 0; i < 100000; i++) {
		uint64_t m = (UINT64_C(1) << 53) | (random_bits() >> 11);
		for (int d = -1; d <= 1; d++) {
			snprintf(s, sizeof s, "%llu",
			         (unsigned long long)((m << 1) + 1 + (uint64_t)d));
			assert_true(read_all(s) == strtod(s, NULL));
		}
	}
}

static void written_numbers_read_back(void **state)
{
	char s[NUMBER_SIZE];

	(void)state;
	for (int i = 0; i < 200000; i++) {
		uint64_t bits = random_bits();
		double x;
		memcpy(&x, &bits, sizeof x);
		if (!isfinite(x))
			continue;
		int n = number_write(s, x);
		assert_int_equal(n, strlen(s));
		assert_true(n < NUMBER_SIZE);
		double back = read_all(s);
		assert_memory_equal(&back, &x, sizeof x);
	}
}

static void writes_the_shortest(void **state)
{
	static const struct {
		double value;
		const char *text;
	} rows[] = {
		{ 0.1, "0.1" },
		{ 1, "1" },
		{ -0.0, "-0" },
		{ 1e15, "1e+15" },
		{ 123, "123" },
		{ 1e-7, "1e-07" },
		{ 0.30000000000000004, "0.30000000000000004" },
	};
	char s[NUMBER_SIZE];

	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		number_write(s, rows[i].value);
		assert_string_equal(s, rows[i].text);
	}
}

/* The quick way of few decimals gives what the C library's shortest digits are. */
static void few_decimals_are_as_printf_has_them(void **state)
{
	static const double divisors[] = { 1, 10, 100, 1000, 10000, 7 };
	char s[NUMBER_SIZE], other[40];

	(void)state;
	for (int i = 0; i < 60000; i++) {
		uint64_t bits = random_bits();
		double x = (double)(bits >> (14 + i % 50)) / divisors[i % 6] * (i % 2 ? 1 : -1);
		int digits = 15;
		do
			snprintf(other, sizeof other, "%.*g", digits, x);
		while (strtod(other, NULL) != x && ++digits <= 17);
		if (fabs(x) < 1e15 && x == trunc(x))
			snprintf(other, sizeof other, "%.0f", x);
		number_write(s, x);
		if (x != 0)
			assert_string_equal(s, other);
	}
}

/* Whatever its size a number has printf's digits, as few as read back. */
static void digits_are_as_printf_has_them(void **state)
{
	char s[NUMBER_SIZE], other[40];

	(void)state;
	for (int i = 0; i < 200000; i++) {
		uint64_t bits = random_bits();
		double x = ldexp((double)(bits >> 11), (int)(random_bits() % 80) - 85);
		int digits = 15;
		if (i % 3 == 0) { /* few digits, or next to few */
			snprintf(other, sizeof other, "%.*g", 1 + i % 17, x);
			x = strtod(other, NULL);
			if (i % 2)
				x = nextafter(x, i % 4 < 2 ? 0 : 1e9);
		}
		if (i % 5 == 0)
			x = -x;
		if (x == trunc(x))
			continue;
		do
			snprintf(other, sizeof other, "%.*g", digits, x);
		while (strtod(other, NULL) != x && ++digits <= 17);
		number_write(s, x);
		assert_string_equal(s, other);
	}
}

static void integers(void **state)
{
	int64_t x;

	(void)state;
	assert_true(number_parse_integer("-9223372036854775808", &x) && x == INT64_MIN);
	assert_true(number_parse_integer("9223372036854775807", &x) && x == INT64_MAX);
	assert_false(number_parse_integer("9223372036854775808", &x));
	assert_false(number_parse_integer("1.0", &x));
	assert_false(number_parse_integer("", &x));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(reads_table),
		cmocka_unit_test(refuses_what_is_no_number),
		cmocka_unit_test(an_exponent_needs_digits),
		cmocka_unit_test(agrees_with_strtod),
		cmocka_unit_test(ties_round_to_even),
		cmocka_unit_test(written_numbers_read_back),
		cmocka_unit_test(writes_the_shortest),
		cmocka_unit_test(few_decimals_are_as_printf_has_them),
		cmocka_unit_test(digits_are_as_printf_has_them),
		cmocka_unit_test(integers),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
