/* test_level_stop.c - tracing is given up when asked to, wherever it is, and nothing of it stays. */
#include "arbitrary.h"
#include "level_check.h"

/* Says stop at the time `at`, and counts how often it was asked before and afterwards. */
struct asker {
	size_t asked, at, after;
};

static bool ask(void *data)
{
	struct asker *a = data;
	const bool stop = ++a->asked > a->at;
	a->after += a->asked > a->at + 1;
	return stop;
}

/* Degree 9, weights far apart: work for seconds in some of its patches. */
static struct surface hard(void)
{
	enum { N = 11 };
	uint64_t seed = 3;
	struct surface s = shape_surface((const int[2]){ 10, 10 }, (const int[2]){ N, N }, true,
	                                 KNOTS_CLAMPED, 7);
	for (int k = 0; k < N * N; k++)
		surface_set_point(&s, k / N, k % N, surface_get_point(&s, k / N, k % N, NULL),
		                  pow(1e4, any_number(&seed) - 0.5));
	return s;
}

static const struct level_field fields[] = {
	{ .kind = LEVEL_PLANE, .direction = { 0.1, 0.2, 1 }, .value = 0.05 },
	{ .kind = LEVEL_ISOPHOTE, .direction = { 0.1, 0.2, 1 }, .value = 0.7 },
	{ .kind = LEVEL_REFLECTION,
	  .direction = { 0.1, 0.2, 1 },
	  .point = { 1, 2, 20 },
	  .eye = { 3, 4, 30 } },
	{ .kind = LEVEL_CURVATURE, .quantity = QUANTITY_GAUSSIAN, .value = 0.05 },
	{ .kind = LEVEL_CURVATURE, .quantity = QUANTITY_KMAX, .value = 0.05 },
};

/* Stopped after 0, 1, 10, 100, .. questions the patch that asks most gives its text back as it was; asked one more
 * time it would have been done. */
static void test_everywhere(void **state)
{
	(void)state;
	struct surface s = wavy();
	for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
		struct level *l;
		struct text begun = { 0 };
		size_t most = 0, patch = 0;
		assert_int_equal(level_create(&l, &s, &fields[i], 1e-5, NULL), ST_OK);
		for (size_t p = 0; p < level_patches(l); p += 7) {
			struct asker a = { .at = SIZE_MAX - 1 };
			const struct level_stop stop = { ask, &a };
			struct text bytes = { 0 };
			assert_int_equal(level_patch(l, p, &stop, &bytes), ST_OK);
			const bool found = bytes.n > 0;
			text_finish(&bytes);
			if (found && a.asked > most) {
				most = a.asked;
				patch = p;
			}
		}
		assert_true(most > 3);
		text_add(&begun, "before");
		for (size_t at = 0; at < most; at = at * 10 + (at == 0)) {
			struct asker a = { .at = at };
			const struct level_stop stop = { ask, &a };
			assert_int_equal(level_patch(l, patch, &stop, &begun), ST_CANCELLED);
			assert_int_equal(a.after, 0);
			assert_string_equal(begun.s, "before");
		}
		struct asker a = { .at = most };
		const struct level_stop stop = { ask, &a };
		assert_int_equal(level_patch(l, patch, &stop, &begun), ST_OK);
		assert_true(begun.n > strlen("before"));
		text_finish(&begun);
		level_destroy(l);
	}
	surface_finish(&s);
}

/* Where all would take long it is left early. */
static void test_hard(void **state)
{
	(void)state;
	struct surface s = hard();
	for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
		struct level *l;
		size_t stopped = 0;
		assert_int_equal(level_create(&l, &s, &fields[i], 1e-4, NULL), ST_OK);
		for (size_t p = 0; p < level_patches(l); p += 5) {
			struct asker a = { .at = 4 };
			const struct level_stop stop = { ask, &a };
			struct text bytes = { 0 };
			const enum status st = level_patch(l, p, &stop, &bytes);
			assert_int_equal(st, a.asked > a.at ? ST_CANCELLED : ST_OK);
			assert_int_equal(a.after, 0);
			assert_true(st == ST_OK || bytes.n == 0);
			stopped += st == ST_CANCELLED;
			text_finish(&bytes);
		}
		assert_true(stopped > 0 || fields[i].kind == LEVEL_PLANE);
		level_destroy(l);
	}
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_everywhere),
		cmocka_unit_test(test_hard),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
