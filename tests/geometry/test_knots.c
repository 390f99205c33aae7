/* test_knots.c - checks, spans, breaks and the laws of basis functions. */
#include <math.h>
#include <string.h>

#include "cmocka_all.h"
#include "knots.h"
#include "shapes.h"

static void checks_table(void **state)
{
	static const struct {
		const char *name;
		int order, n;
		double knots[16];
		enum status expected;
		const char *word; /* in the sentence */
	} rows[] = {
		{ "line", 2, 2, { 0, 0, 1, 1 }, ST_OK, "" },
		{ "unclamped", 3, 4, { 0, 1, 2, 3, 4, 5, 6 }, ST_OK, "" },
		{ "as often as the order", 3, 6, { 0, 0, 0, 1, 1, 1, 2, 2, 2 }, ST_OK, "" },
		{ "order 1", 1, 2, { 0, 1, 2 }, ST_INPUT, "order 1, expected 2 to 26" },
		{ "order 27", 27, 2, { 0 }, ST_INPUT, "order 27" },
		{ "order below 0", -4, 2, { 0 }, ST_INPUT, "order -4" },
		{ "few points", 4, 3, { 0, 0, 0, 1, 1, 1, 1 }, ST_INPUT, "3 control points" },
		{ "fall", 2, 3, { 0, 0, 2, 1, 3 }, ST_INPUT, "knot 4 is 1 after 2" },
		{ "nan", 2, 3, { 0, 0, NAN, 1, 1 }, ST_INPUT, "knot 3 is nan" },
		{ "infinite", 2, 2, { 0, 0, 1, INFINITY }, ST_INPUT, "knot 4 is inf" },
		{ "too often", 2, 5, { 0, 0, 1, 1, 1, 2, 2 }, ST_INPUT, "more than 2 times" },
		{ "no length", 2, 2, { 1, 2, 2, 3 }, ST_INPUT, "no usable length" },
		{ "too long", 2, 2, { -1e308, -1e308, 1e308, 1e308 }, ST_INPUT, "no usable" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct report_store store;
		report_store_init(&store);
		enum status st = knots_check(rows[i].order, rows[i].n, rows[i].knots,
		                             "surface 3, u", &store.report);
		if (st != rows[i].expected)
			fail_msg("%s: status %d", rows[i].name, st);
		if (st != ST_OK && (!strstr(store.error, rows[i].word) ||
		                    strncmp(store.error, "surface 3, u: ", 14) != 0))
			fail_msg("%s: said '%s'", rows[i].name, store.error);
	}
}

static void spans_table(void **state)
{
	/* order 3, 7 points: the domain is 1 .. 5 with a double knot at 3 */
	static const double k[] = { 0, 0.5, 1, 2, 3, 3, 4, 5, 5.5, 6 };
	static const struct {
		double t;
		int right, left;
	} rows[] = {
		{ 0, 2, 2 }, { 1, 2, 2 },   { 1.5, 2, 2 }, { 2, 3, 2 }, { 2.9, 3, 3 }, { 3, 5, 3 },
		{ 4, 6, 5 }, { 4.5, 6, 6 }, { 5, 6, 6 },   { 9, 6, 6 }, { -9, 2, 2 },
	};
	double breaks[9];
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		assert_int_equal(knots_span(3, 7, k, rows[i].t), rows[i].right);
		assert_int_equal(knots_span_left(3, 7, k, rows[i].t), rows[i].left);
	}
	const double domain[2] = { 2, 4 };
	assert_int_equal(knots_domain_span(3, 7, k, domain, 4), 5);
	assert_int_equal(knots_domain_span(3, 7, k, domain, 7), 5);
	assert_int_equal(knots_domain_span(3, 7, k, domain, 2), 3);
	assert_int_equal(knots_domain_span(3, 7, k, domain, 0), 3);
	assert_int_equal(knots_multiplicity(3, 7, k, 3), 2);
	assert_int_equal(knots_multiplicity(3, 7, k, 3.5), 0);
	for (double t = -1; t <= 7; t += 0.25) {
		int count = 0;
		for (int i = 0; i < 10; i++)
			count += k[i] == t;
		assert_int_equal(knots_multiplicity(3, 7, k, t), count);
	}
	assert_int_equal(knots_breaks(3, 7, k, 1, 5, breaks), 5);
	assert_true(breaks[0] == 1 && breaks[2] == 3 && breaks[3] == 4 && breaks[4] == 5);
	assert_int_equal(knots_breaks(3, 7, k, 2.5, 3, breaks), 2);
	assert_true(breaks[0] == 2.5 && breaks[1] == 3);
	assert_true(knots_greville(3, k, 2) == 2.5);
}

/* Plain Cox - de Boor recursion, for comparison. */
static double plain_basis(int order, const double *k, int i, double t, int s)
{
	if (order == 1)
		return i == s;
	double a = k[i + order - 1] - k[i], b = k[i + order] - k[i + 1], sum = 0;
	if (a > 0)
		sum += (t - k[i]) / a * plain_basis(order - 1, k, i, t, s);
	if (b > 0)
		sum += (k[i + order] - t) / b * plain_basis(order - 1, k, i + 1, t, s);
	return sum;
}

static double plain_derivative(int order, const double *k, int i, double t, int s, int d)
{
	if (d == 0)
		return plain_basis(order, k, i, t, s);
	double a = k[i + order - 1] - k[i], b = k[i + order] - k[i + 1], sum = 0;
	if (order == 1)
		return 0;
	if (a > 0)
		sum += (order - 1) / a * plain_derivative(order - 1, k, i, t, s, d - 1);
	if (b > 0)
		sum -= (order - 1) / b * plain_derivative(order - 1, k, i + 1, t, s, d - 1);
	return sum;
}

static void basis_agrees_with_recursion(void **state)
{
	double out[12 * 8];
	(void)state;
	for (int order = 2; order <= 8; order++)
		for (int how = 0; how < N_SHAPE_KNOTS; how++) {
			const int n = order + 6;
			double k[32];
			shape_fill_knots(k, order, n, how);
			for (int m = 0; m <= 20; m++) {
				double a = k[order - 1], b = k[n], t = a + (b - a) * m / 20;
				int s = knots_span(order, n, k, t);
				knots_basis(order, k, s, t, 9, out);
				for (int d = 0; d <= 9; d++) {
					double top = 0, expected[8];
					for (int j = 0; j < order; j++) {
						expected[j] = plain_derivative(
						        order, k, s - order + 1 + j, t, s, d);
						top = fmax(top, fabs(expected[j]));
					}
					for (int j = 0; j < order; j++)
						if (fabs(out[d * order + j] - expected[j]) >
						    1e-12 * top)
							fail_msg("order %d knots %d t %g d %d",
							         order, how, t, d);
				}
			}
		}
}

static void basis_sums_to_one(void **state)
{
	double out[2 * ORDER_MAX], k[4 * ORDER_MAX];
	(void)state;
	for (int order = ORDER_MIN; order <= ORDER_MAX; order++)
		for (int how = 0; how < N_SHAPE_KNOTS; how++) {
			const int n = 2 * order;
			shape_fill_knots(k, order, n, how);
			for (int m = 0; m <= 30; m++) {
				double t = k[order - 1] + (k[n] - k[order - 1]) * m / 30;
				double sum = 0, slopes = 0, steepest = 0;
				knots_basis(order, k, knots_span(order, n, k, t), t, 1, out);
				for (int j = 0; j < order; j++) {
					assert_true(out[j] >= 0);
					sum += out[j];
					slopes += out[order + j];
					steepest = fmax(steepest, fabs(out[order + j]));
				}
				assert_true(fabs(sum - 1) < 1e-14);
				assert_true(fabs(slopes) < 1e-13 * steepest);
			}
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(checks_table),
		cmocka_unit_test(spans_table),
		cmocka_unit_test(basis_agrees_with_recursion),
		cmocka_unit_test(basis_sums_to_one),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
