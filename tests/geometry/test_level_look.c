/* test_level_look.c - what blocks of traced patches show before they are joined. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "level_check.h"
#include "level_look.h"

struct seen {
	const struct surface *surface;
	double length, far,
	        wrong; /* largest distance from a sphere of radius 2.5, error of its angle */
	double value;
	int n;
};

static enum status take(void *data, const struct level_head *head, const struct curve *c)
{
	struct seen *s = data;
	struct vec3 last = curve_point(c, c->domain[0]);
	enum { STEPS = 64 };
	assert_int_equal(head->kind, LEVEL_ISOPHOTE);
	assert_true(head->value == s->value);
	for (int i = 1; i <= STEPS; i++) {
		struct vec3 p = curve_point(c, c->domain[1] * i / STEPS);
		s->length += vec3_length(vec3_sub(p, last));
		s->far = fmax(s->far, fabs(vec3_length(p) - 2.5));
		s->wrong = fmax(s->wrong, fabs(p.z / 2.5 - cos(s->value * M_PI / 180)));
		last = p;
	}
	s->n++;
	return ST_OK;
}

static void block_of(struct text *out, const struct surface *s, double degrees)
{
	const struct level_field field = { .kind = LEVEL_ISOPHOTE,
		                           .direction = { 0, 0, 1 },
		                           .value = cos(degrees * M_PI / 180) };
	struct level *l = NULL;
	level_head_add(out, &(struct level_head){ LEVEL_ISOPHOTE, degrees });
	assert_int_equal(level_create(&l, s, &field, 1e-6, &report_none), ST_OK);
	for (size_t p = 0; p < level_patches(l); p++)
		assert_int_equal(level_patch(l, p, NULL, out), ST_OK);
	level_destroy(l);
}

/* The strands of all patches make up the circles of latitude. */
static void strands_lie_where_the_curve_does(void **state)
{
	static const double angles[] = { 20, 60, 75, 135 };
	(void)state;
	struct surface s = sphere();
	for (size_t k = 0; k < sizeof angles / sizeof *angles; k++) {
		struct seen seen = { .value = angles[k] };
		struct text block = { 0 };
		block_of(&block, &s, angles[k]);
		assert_int_equal(level_look(block.s, block.n, take, &seen), ST_OK);
		assert_in_range(seen.n, 1, 1000);
		assert_true(seen.far < 1e-5 && seen.wrong < 1e-5);
		double whole = 2 * M_PI * 2.5 * sin(angles[k] * M_PI / 180);
		assert_true(fabs(seen.length / whole - 1) < 1e-3);
		text_finish(&block);
	}
	surface_finish(&s);
}

static enum status count(void *data, const struct level_head *head, const struct curve *c)
{
	(void)head;
	(void)c;
	++*(int *)data;
	return ST_OK;
}

/* Cut short anywhere, or with any byte another, nothing is read beyond the end. */
static void damage_is_no_harm(void **state)
{
	(void)state;
	struct surface s = sphere();
	struct text block = { 0 };
	int whole = 0, cut = 0;
	block_of(&block, &s, 60);
	assert_int_equal(level_look(block.s, block.n, count, &whole), ST_OK);
	for (size_t n = 0; n < block.n; n += n < 200 ? 1 : 37) {
		char *copy = malloc(n ? n : 1); /* its end is a wall under sanitizers */
		int some = 0;
		memcpy(copy, block.s, n);
		assert_int_equal(level_look(copy, n, count, &some), ST_OK);
		assert_in_range(some, cut, whole);
		cut = some;
		free(copy);
	}
	assert_int_equal(whole > cut, 1);
	for (size_t i = 0; i < 200; i++) {
		int some = 0;
		block.s[i] ^= (char)0xA5;
		assert_int_equal(level_look(block.s, block.n, count, &some), ST_OK);
		block.s[i] ^= (char)0xA5;
	}
	text_finish(&block);
	surface_finish(&s);
}

/* What has no head is none; what `take` says comes back. */
static enum status refuse(void *data, const struct level_head *head, const struct curve *c)
{
	(void)data;
	(void)head;
	(void)c;
	return ST_RESOURCE;
}

static void heads_and_refusals(void **state)
{
	(void)state;
	struct surface s = sphere();
	struct text block = { 0 };
	int some = 0;
	block_of(&block, &s, 60);
	const size_t head = level_head_size(block.s, block.n);
	assert_true(head > 0);
	assert_int_equal(level_head_size(block.s + head, block.n - head), 0);
	assert_int_equal(level_head_size("", 0), 0);
	assert_int_equal(level_look(block.s + head, block.n - head, count, &some), ST_OK);
	assert_int_equal(some, 0);
	assert_int_equal(level_look(block.s, block.n, refuse, NULL), ST_RESOURCE);
	text_finish(&block);
	surface_finish(&s);
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(strands_lie_where_the_curve_does),
		cmocka_unit_test(damage_is_no_harm),
		cmocka_unit_test(heads_and_refusals),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
