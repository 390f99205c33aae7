/* test_base.c - the .base format: to the bit and back, and what is said of bad files. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base.h"
#include "survive.h"

static double awkward(uint64_t *seed)
{
	static const double special[] = {
		0.1,     -0.0,          1e-300, 5e-324, 1e300,
		1.0 / 3, 0.30000000001, 123456, -1e-9,  4503599627370497.5
	};
	uint64_t r = mutate_next(seed);
	if (r % 4 == 0)
		return special[r / 4 % 10];
	return ((double)(int64_t)mutate_next(seed) / 9223372036854775808.0) *
	       pow(10, (int)(r / 4 % 40) - 20);
}

static void fill_knots(double *knots, int n, int order, uint64_t *seed)
{
	double t = awkward(seed) * 1e-3;
	for (int i = 0; i < n + order; i++) {
		knots[i] = t;
		if (i >= order - 1 && i < n)
			t = fmax(nextafter(t, INFINITY), t + fabs(t) * 0.37 + 0.1);
	}
}

static void fill_points(double *points, size_t n, bool rational, uint64_t *seed)
{
	for (size_t i = 0; i < n; i++) {
		for (int k = 0; k < 3; k++)
			points[4 * i + k] = awkward(seed);
		points[4 * i + 3] = rational ? 0.1 + (double)(mutate_next(seed) % 1000) / 7 : 1;
	}
}

static void fill_curve(struct curve *c, int order, int n, uint64_t *seed)
{
	assert_int_equal(curve_init(c, order, n), ST_OK);
	fill_knots(c->knots, n, order, seed);
	fill_points(c->points, (size_t)n, order % 2, seed);
	c->domain[0] = c->knots[order - 1];
	c->domain[1] = c->knots[order - 1] + 0.7 * (c->knots[n] - c->knots[order - 1]);
	c->periodic = n % 2;
	assert_int_equal(curve_check(c, "curve", NULL), ST_OK);
}

static void fill_surface(struct surface *s, const int order[2], const int n[2], uint64_t *seed)
{
	assert_int_equal(surface_init(s, order, n), ST_OK);
	for (int d = 0; d < 2; d++) {
		fill_knots(s->knots[d], n[d], order[d], seed);
		s->domain[d][0] = s->knots[d][order[d] - 1];
		s->domain[d][1] = s->knots[d][n[d]];
	}
	fill_points(s->points, (size_t)n[0] * n[1], order[0] % 2, seed);
	s->periodic[1] = true;
	assert_int_equal(surface_check(s, "surface", NULL), ST_OK);
}

/* An outer loop of three curves, an inner one of one. */
static void fill_trim(struct trim *t, uint64_t *seed)
{
	for (int i = 0; i < 2; i++) {
		struct trim_loop l = { .outer = i == 0 };
		for (int j = 0; j < (i ? 1 : 3); j++) {
			struct curve c;
			fill_curve(&c, 2 + j, 5 + i, seed);
			assert_int_equal(trim_loop_add(&l, &c), ST_OK);
		}
		assert_int_equal(trim_add(t, &l), ST_OK);
	}
}

static void make_model(struct model *m, uint64_t seed)
{
	const int orders[2] = { 2 + (int)(seed % 5), 26 }, counts[2] = { 9, 27 };
	struct entity e;
	model_init(m);
	assert_int_equal(model_set_text(&m->unit, "in"), ST_OK);
	m->unit_in_mm = 25.4;
	m->scale = 0.125;
	assert_int_equal(model_set_attribute(m, "worker", "isophotes 1"), ST_OK);
	assert_int_equal(model_set_attribute(m, "odd \"name\"", "tab\there\nline\\ \x7f"), ST_OK);

	entity_init(&e, ENTITY_SURFACE);
	fill_surface(&e.geometry, orders, counts, &seed);
	assert_int_equal(model_set_text(&e.name, "hull # 1"), ST_OK);
	e.de = 15;
	e.source_type = 128;
	e.trims = 2;
	if (seed % 2)
		fill_trim(&e.trim, &seed);
	e.has_color = true;
	e.color[1] = 0.1f;
	assert_int_equal(entity_add_face(&e, 21), ST_OK);
	assert_int_equal(entity_add_face(&e, 33), ST_OK);
	assert_int_equal(model_add(m, &e), ST_OK);

	entity_init(&e, ENTITY_CURVE_ON_SURFACE);
	fill_curve(&e.curve, 4, 7, &seed);
	fill_curve(&e.space, 3, 12, &seed);
	e.surface = 0;
	assert_int_equal(entity_set_attribute(&e, "angle", "30"), ST_OK);
	assert_int_equal(entity_set_attribute(&e, "closed", "yes"), ST_OK);
	assert_int_equal(model_add(m, &e), ST_OK);

	entity_init(&e, ENTITY_CURVE);
	fill_curve(&e.curve, 2, 2, &seed);
	e.used = true;
	assert_int_equal(model_add(m, &e), ST_OK);

	for (int dimension = 2; dimension <= 3; dimension++) {
		entity_init(&e, ENTITY_POINTS);
		e.points = (struct point_list){ 5, dimension, calloc(15, sizeof(double)) };
		assert_non_null(e.points.values);
		for (int i = 0; i < 5 * dimension; i++)
			e.points.values[i] = awkward(&seed);
		assert_int_equal(model_add(m, &e), ST_OK);
	}
	model_number(m);
}

static void assert_bits(const double *a, const double *b, size_t n)
{
	assert_memory_equal(a, b, n * sizeof *a);
}

static void assert_same_curve(const struct curve *a, const struct curve *b)
{
	assert_int_equal(a->order, b->order);
	assert_int_equal(a->n, b->n);
	assert_int_equal(a->rational, b->rational);
	assert_int_equal(a->periodic, b->periodic);
	assert_bits(a->domain, b->domain, 2);
	assert_bits(a->knots, b->knots, (size_t)a->n + a->order);
	assert_bits(a->points, b->points, (size_t)4 * a->n);
}

static void assert_same_surface(const struct surface *a, const struct surface *b)
{
	for (int d = 0; d < 2; d++) {
		assert_int_equal(a->order[d], b->order[d]);
		assert_int_equal(a->n[d], b->n[d]);
		assert_int_equal(a->periodic[d], b->periodic[d]);
		assert_bits(a->domain[d], b->domain[d], 2);
		assert_bits(a->knots[d], b->knots[d], (size_t)a->n[d] + a->order[d]);
	}
	assert_int_equal(a->rational, b->rational);
	assert_bits(a->points, b->points, (size_t)4 * a->n[0] * a->n[1]);
}

static void assert_same_trim(const struct trim *a, const struct trim *b)
{
	assert_int_equal(a->n, b->n);
	for (int i = 0; i < a->n; i++) {
		assert_int_equal(a->loops[i].outer, b->loops[i].outer);
		assert_int_equal(a->loops[i].n, b->loops[i].n);
		for (int j = 0; j < a->loops[i].n; j++)
			assert_same_curve(&a->loops[i].curves[j], &b->loops[i].curves[j]);
	}
}

static void assert_same_faces(const struct entity *a, const struct entity *b)
{
	assert_same_surface(&a->geometry, &b->geometry);
	assert_same_trim(&a->trim, &b->trim);
	assert_int_equal(!a->faces, !b->faces);
	if (!a->faces)
		return;
	assert_int_equal(a->faces->n, b->faces->n);
	for (int i = 0; i < a->faces->n; i++)
		assert_int_equal(a->faces->de[i], b->faces->de[i]);
}

static void assert_same_points(const struct point_list *a, const struct point_list *b)
{
	assert_int_equal(a->n, b->n);
	assert_int_equal(a->dimension, b->dimension);
	assert_bits(a->values, b->values, (size_t)a->n * a->dimension);
}

static void assert_same_curves(const struct entity *a, const struct entity *b)
{
	assert_same_curve(&a->curve, &b->curve);
	assert_int_equal(a->space.order, b->space.order);
	if (a->space.order)
		assert_same_curve(&a->space, &b->space);
}

static void assert_same_entity(const struct entity *a, const struct entity *b)
{
	assert_int_equal(a->kind, b->kind);
	assert_int_equal(a->number, b->number);
	assert_int_equal(a->used, b->used);
	assert_int_equal(a->de, b->de);
	assert_int_equal(a->source_type, b->source_type);
	assert_int_equal(a->trims, b->trims);
	assert_int_equal(a->surface, b->surface);
	assert_int_equal(a->has_color, b->has_color);
	assert_memory_equal(a->color, b->color, sizeof a->color);
	assert_int_equal(!a->name, !b->name);
	if (a->name)
		assert_string_equal(a->name, b->name);
	assert_int_equal(a->n_attributes, b->n_attributes);
	for (int i = 0; i < a->n_attributes; i++) {
		assert_string_equal(a->attributes[i].name, b->attributes[i].name);
		assert_string_equal(a->attributes[i].value, b->attributes[i].value);
	}
	if (a->kind == ENTITY_SURFACE)
		assert_same_faces(a, b);
	else if (a->kind == ENTITY_POINTS)
		assert_same_points(&a->points, &b->points);
	else
		assert_same_curves(a, b);
}

static void written_is_read_to_the_bit(void **state)
{
	(void)state;
	for (uint64_t seed = 1; seed <= 20; seed++) {
		struct model a, b;
		struct text t = { 0 }, again = { 0 };
		make_model(&a, seed);
		base_format(&a, &t);
		assert_false(t.failed);
		model_init(&b);
		assert_true(base_recognise(t.s, t.n));
		assert_int_equal(base_parse(&b, t.s, t.n, "a.base", NULL, NULL), ST_OK);
		assert_int_equal(a.n, b.n);
		assert_string_equal(a.unit, b.unit);
		assert_bits(&a.unit_in_mm, &b.unit_in_mm, 1);
		assert_bits(&a.scale, &b.scale, 1);
		assert_string_equal(model_get_attribute(&b, "odd \"name\""),
		                    model_get_attribute(&a, "odd \"name\""));
		for (int i = 0; i < a.n; i++)
			assert_same_entity(&a.entities[i], &b.entities[i]);
		base_format(&b, &again);
		assert_int_equal(t.n, again.n);
		assert_memory_equal(t.s, again.s, t.n);
		text_finish(&t);
		text_finish(&again);
		model_finish(&a);
		model_finish(&b);
	}
}

/* A job's input: the entity, and the surface that it refers to. */
static void one_entity_stands_alone(void **state)
{
	struct model a, b;
	struct text t = { 0 };
	(void)state;
	make_model(&a, 3);
	base_format_entity(&a, &a.entities[1], &t);
	model_init(&b);
	assert_int_equal(base_parse(&b, t.s, t.n, "a.base", NULL, NULL), ST_OK);
	assert_int_equal(b.n, 2);
	assert_int_equal(b.entities[0].number, 1);
	assert_int_equal(b.entities[0].surface, 1);
	assert_int_equal(b.entities[1].number, 0);
	assert_string_equal(b.unit, "in");
	assert_same_curve(&b.entities[0].curve, &a.entities[1].curve);
	assert_same_surface(&b.entities[1].geometry, &a.entities[0].geometry);
	model_finish(&b);
	text_reset(&t);
	base_format_entity(&a, &a.entities[2], &t);
	model_init(&b);
	assert_int_equal(base_parse(&b, t.s, t.n, "a.base", NULL, NULL), ST_OK);
	assert_int_equal(b.n, 1);
	assert_int_equal(b.entities[0].number, 1);
	model_finish(&b);
	model_finish(&a);
	text_finish(&t);
}

#define LINE "order 2 ncontpts 2 knots 0 0 1 1 contpts 0 0 0 1 1 1 1 1 "

static void texts_and_their_faults(void **state)
{
	static const struct {
		const char *text, *sentence; /* NULL: good */
	} rows[] = {
		{ "batten base 1\ntype curve\n" LINE "end\n", NULL },
		{ "batten base 1 # a comment\r\ntype\tcurve # x\r\n" LINE "end", NULL },
		{ "batten base 1\nunit \"\" 0\nentities 1\ntype curve " LINE "end\n", NULL },
		{ "batten base 1\ntype points dimension 2 values 1 3 4 end", NULL },
		{ "batten base 1\ntype points dimension 2 values 2 3 4 end",
		  "a.base:2:38: found 'end', expected coordinate: a number" },
		{ "batten base 2\n", "a.base:1:13: found '2', expected version 1" },
		{ "batten base 1\n", "a.base:2:1: found the end of the file, expected 'type'" },
		{ "batten base 1\nentities 2\ntype curve " LINE "end\n", "cut short" },
		{ "batten base 1\ntype curve\n" LINE,
		  "found the end of the file, expected a field" },
		{ "batten base 1\ntype sphere\n", "a.base:2:6: found 'sphere', expected a type" },
		{ "batten base 1\ntype curve\ncolour 1 1 1\n",
		  "a.base:3:1: found 'colour', expected a field of a curve" },
		{ "batten base 1\ntype curve uknots 0 0 1 1", "expected a field that a curve has" },
		{ "batten base 1\ntype curve order 2 order 2", "expected the field 'order' once" },
		{ "batten base 1\ntype curve ncontpts 2", "expected the field 'order' before it" },
		{ "batten base 1\ntype curve order 27",
		  "a.base:2:18: found '27', expected order: a "
		  "whole number from 2 to 26" },
		{ "batten base 1\ntype curve order 2.0", "found '2.0'" },
		{ "batten base 1\ntype curve order 2 ncontpts 1", "from 2 to" },
		{ "batten base 1\ntype curve order 2 ncontpts 2000000000 knots",
		  "found '2000000000', expected number of control points" },
		{ "batten base 1\ntype surface order 2 2 ncontpts 40000 40000 uknots",
		  "expected number of control points" },
		{ "batten base 1\ntype surface order 2 2 ncontpts x 2", "found 'x'" },
		{ "batten base 1\ntype curve order 2 ncontpts 2 knots 0 0 nan 1", "found 'nan'" },
		{ "batten base 1\ntype curve order 2 ncontpts 2 knots 0 0 1e999 1",
		  "found '1e999'" },
		{ "batten base 1\ntype curve order 2 ncontpts 2 knots 0 0 0x1 1", "found '0x1'" },
		{ "batten base 1\ntype curve order 2 ncontpts 2 knots 0 1 0 1 contpts 0 0 0 1 1 1 1 1 "
		  "end",
		  "knot" },
		{ "batten base 1\ntype curve order 2 ncontpts 2 knots 0 0 1 1 contpts 0 0 0 1 1 1 1 0 "
		  "end",
		  "weight" },
		{ "batten base 1\ntype curve order 2 ncontpts 2 knots 0 0 1 1 end",
		  "expected the field 'contpts' of this curve" },
		{ "batten base 1\ntype curve name \"a\nb\" " LINE "end",
		  "a string in double quotes" },
		{ "batten base 1\ntype curve name \"a\\q\" " LINE "end",
		  "a string in double quotes" },
		{ "batten base 1\ntype curve name \"a\\x00\" " LINE "end",
		  "a string in double quotes" },
		{ "batten base 1\ntype curve name keel " LINE "end", "found 'keel'" },
		{ "batten base 1\ntype curve periodic maybe", "the field 'ncontpts' before it" },
		{ "batten base 1\ntype curve " LINE "periodic maybe end", "yes or no" },
		{ "batten base 1\ntype curve " LINE "domain 2 3 end", "domain" },
		{ "batten base 1\ntype curve_on_surface surface 1 " LINE "end", "which is none" },
		{ "batten base 1\ntype curve_on_surface surface 7 " LINE "end", "which is none" },
		{ "batten base 1\ntype curve_on_surface " LINE "space " LINE "space " LINE "end",
		  "'space' stands once" },
		{ "batten base 1\ntype curve_on_surface " LINE "space end", "the field 'order'" },
		{ "batten base 1\ntype curve " LINE "space " LINE "end", "'space' stands once" },
		{ "batten base 1\ntype surface loop outer curve " LINE "end end end",
		  "expected the field 'order' of this surface" },
		{ "batten base 1\ntype surface loop curve", "expected outer or inner" },
		{ "batten base 1\ntype surface loop inner end", "the first of the loop" },
		{ "batten base 1\ntype surface loop inner curve " LINE "end knots",
		  "expected 'curve' or 'end'" },
		{ "batten base 1\ntype surface loop inner curve name \"a\" " LINE "end",
		  "a field that a curve of a loop has" },
		{ "batten base 1\ntype surface loop inner curve " LINE "space",
		  "'space' stands once" },
		{ "batten base 1\ntype surface loop inner curve end", "the field 'order'" },
		{ "batten base 1\ntype curve loop inner", "expected a field that a curve has" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct model m;
		struct report_store store;
		report_store_init(&store);
		model_init(&m);
		enum status st = base_parse(&m, rows[i].text, strlen(rows[i].text), "a.base", NULL,
		                            &store.report);
		if (rows[i].sentence ? st != ST_INPUT || !strstr(store.error, rows[i].sentence)
		                     : st != ST_OK)
			fail_msg("row %zu: status %d, '%s'", i, st, store.error);
		assert_int_equal(store.n_errors, rows[i].sentence != NULL);
		model_finish(&m);
	}
}

static void stops_when_told(void **state)
{
	struct model m;
	struct text t = { 0 };
	atomic_bool stop;
	struct progress p = { .stop = &stop };
	(void)state;
	atomic_init(&stop, true);
	text_add(&t, "batten base 1\ntype points dimension 3 values 100000\n");
	for (int i = 0; i < 100000; i++)
		text_add(&t, "1 2 3\n");
	text_add(&t, "end\n");
	model_init(&m);
	assert_int_equal(base_parse(&m, t.s, t.n, "a.base", &p, NULL), ST_CANCELLED);
	model_finish(&m);
	model_init(&m);
	atomic_store(&stop, false);
	assert_int_equal(base_parse(&m, t.s, t.n, "a.base", &p, NULL), ST_OK);
	assert_int_equal(m.entities[0].points.n, 100000);
	model_finish(&m);
	text_finish(&t);
}

static enum status read_damaged(struct model *m, const char *bytes, size_t n,
                                const struct report *r)
{
	return base_parse(m, bytes, n, "a.base", NULL, r);
}

static void damaged_files_are_survived(void **state)
{
	struct model a;
	struct text t = { 0 };
	(void)state;
	make_model(&a, 5);
	base_format(&a, &t);
	survive(read_damaged, t.s, t.n, 7, 3000, 30, 300);
	model_finish(&a);
	text_finish(&t);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(written_is_read_to_the_bit),
		cmocka_unit_test(one_entity_stands_alone),
		cmocka_unit_test(texts_and_their_faults),
		cmocka_unit_test(stops_when_told),
		cmocka_unit_test(damaged_files_are_survived),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
