/* test_iges.c - IGES entity by entity, well formed and not; headers, lines, writing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "iges.h"
#include "iges_maker.h"
#include "mutate.h"

/* tables of entities that mostly end after the parameters */
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

enum { MADE_MAX = 8 };

static enum status read_made(struct model *m, const struct made_file *f,
                             const struct made_entity *entities, struct report_store *store)
{
	struct text t = { 0 };
	int n = 0;
	while (n < MADE_MAX && entities[n].type)
		n++;
	make_iges(&t, f, entities, n);
	assert_false(t.failed);
	/* a block of just that size, so that sanitizers see reading beyond it */
	char *bytes = malloc(t.n);
	assert_non_null(bytes);
	memcpy(bytes, t.s, t.n);
	report_store_init(store);
	model_init(m);
	assert_true(iges_recognise(bytes, t.n));
	enum status st = iges_parse(m, bytes, t.n, "x.igs", NULL, &store->report);
	text_finish(&t);
	free(bytes);
	return st;
}

static void assert_point(size_t row, struct vec3 found, struct vec3 expected)
{
	if (!(vec3_length(vec3_sub(found, expected)) <= 1e-12 * (1 + vec3_length(expected))))
		fail_msg("row %zu: %.17g %.17g %.17g, expected %.17g %.17g %.17g", row, found.x,
		         found.y, found.z, expected.x, expected.y, expected.z);
}

#define KNOTS4 "0.,0.,1.,1.,"
#define SQUARE                                                                                     \
	"128,1,1,1,1,0,0,1,0,0," KNOTS4 KNOTS4                                                     \
	"1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.;"
#define QUARTER                                                                                    \
	"126,2,2,1,0,0,0,0.,0.,0.,1.,1.,1.,1.,.7071067811865476,1.,"                               \
	"1.,0.,0.,1.,1.,0.,0.,1.,0.,0.,1.,0.,0.,1.;"
#define MOVE   "124,1.,0.,0.,10.,0.,1.,0.,20.,0.,0.,1.,30.;"
#define TURN   "124,0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.;" /* x to y */
#define MIRROR "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,-1.,0.;"

/* u (or t) and v, and where they lead on entity `de`. */
static void entities_become_nurbs(void **state)
{
	static const double h = 0.70710678118654752;
	const struct {
		struct made_entity entities[MADE_MAX];
		int de;
		double u, v;
		struct vec3 p;
	} rows[] = {
		{ { { 110, 0, "110,1.,2.,3.,5.,2.,3.;" } }, 1, 0.25, 0, { 2, 2, 3 } },
		{ { { 100, 0, "100,7.,1.,1.,3.,1.,1.,3.;" } },
		  1,
		  M_PI / 4,
		  0,
		  { 1 + 2 * h, 1 + 2 * h, 7 } },
		{ { { 100, 0, "100,0.,0.,0.,2.,0.,2.,0.;" } }, 1, M_PI, 0, { -2, 0, 0 } },
		{ { { 100, 0, "100,0.,0.,0.,0.,-1.,1.,0.;" } }, 1, 1.75 * M_PI, 0, { h, -h, 0 } },
		{ { { 104, 1, "104,.25,0.,1.,0.,0.,-1.,4.,2.,0.,-2.,0.;" } },
		  1,
		  -1,
		  0,
		  { 0, 1, 4 } },
		{ { { 106, 11, "106,1,3,9.,0.,0.,1.,0.,1.,1.;" } }, 1, 0.75, 0, { 1, 0.5, 9 } },
		{ { { 106, 12, "106,2,2,0.,0.,0.,1.,2.,3.;" } }, 1, 0.5, 0, { 0.5, 1, 1.5 } },
		{ { { 106, 13, "106,3,2,0.,0.,0.,9.,9.,9.,1.,2.,3.,9.,9.,9.;" } },
		  1,
		  0.5,
		  0,
		  { 0.5, 1, 1.5 } },
		{ { { 106, 63, "106,1,4,1.,0.,0.,2.,0.,2.,2.,0.,0.;" } },
		  1,
		  1. / 6,
		  0,
		  { 1, 0, 1 } },
		{ { { 112, 0,
		      "112,3,2,3,2,0.,1.,3.,0.,1.,0.,0.,0.,0.,1.,0.,2.,0.,0.,0.,"
		      "1.,1.,0.,0.,1.,2.,0.,0.,2.,0.,0.,0.,3.,1.,0.,0.,5.,2.,0.,0.,2.,0.,0.,0.;" } },
		  1,
		  2,
		  0,
		  { 2, 3, 2 } },
		{ { { 126, 0, QUARTER } }, 1, 0.5, 0, { h, h, 0 } },
		{ { { 126, 0,
		      "126,3,2,0,0,1,0,0.,1.,2.,3.,4.,5.,6.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,0.,"
		      "0.,3.,0.,0.,2.,4.;" } },
		  1,
		  3,
		  0,
		  { 1.5, 0, 0 } },
		{ { { 102, 0, "102,2,3,5;" },
		    { 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		    { 110, 0, "110,1.,0.,0.,1.,1.,0.;" } },
		  1,
		  1.5,
		  0,
		  { 1, 0.5, 0 } },
		{ { { 118, 1, "118,3,5,0,0;" },
		    { 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		    { 110, 0, "110,0.,1.,0.,1.,1.,4.;" } },
		  1,
		  0.5,
		  0.5,
		  { 0.5, 0.5, 1 } },
		{ { { 118, 1, "118,3,5,1,0;" },
		    { 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		    { 110, 0, "110,1.,1.,4.,0.,1.,0.;" } },
		  1,
		  0.5,
		  0.5,
		  { 0.5, 0.5, 1 } },
		{ { { 120, 0, "120,3,5,0.,1.5707963267948966;" },
		    { 110, 0, "110,0.,0.,0.,0.,0.,1.;" },
		    { 110, 0, "110,2.,0.,0.,2.,0.,4.;" } },
		  1,
		  0.5,
		  M_PI / 4,
		  { 2 * h, 2 * h, 2 } },
		{ { { 122, 0, "122,3,0.,0.,5.;" }, { 110, 0, "110,0.,0.,0.,2.,0.,0.;" } },
		  1,
		  0.5,
		  0.2,
		  { 1, 0, 1 } },
		{ { { 128, 0, SQUARE } }, 1, 0.25, 0.75, { 0.25, 0.75, 0 } },
		{ { { 140, 0, "140,0.,0.,1.,2.,3;" }, { 128, 0, SQUARE } },
		  1,
		  0.5,
		  0.5,
		  { 0.5, 0.5, 2 } },
		{ { { 140, 0, "140,0.,0.,-1.,2.,3;" }, { 128, 0, SQUARE } },
		  1,
		  0.5,
		  0.5,
		  { 0.5, 0.5, -2 } },
		/* planes: parameters are lengths; x of the plane z = 5 is the world's */
		{ { { 108, 1, "108,0.,0.,2.,10.,3,0.,0.,0.,0.;" },
		    { 100, 0, "100,5.,1.,1.,3.,1.,3.,1.;" } },
		  1,
		  2.5,
		  -0.5,
		  { 2.5, -0.5, 5 } },
		{ { { 190, 1, "190,3,5,7;" },
		    { 116, 0, "116,1.,0.,0.;" },
		    { 123, 0, "123,0.,0.,1.;" },
		    { 123, 0, "123,0.,3.,0.;" },
		    { 144, 0, "144,1,1,0,11;" },
		    { 142, 0, "142,0,1,0,13,2;" },
		    { 100, 0, "100,0.,0.,0.,2.,0.,2.,0.;" } },
		  1,
		  1,
		  0.5,
		  { 0.5, 1, 0 } },
		{ { { 108, 0, "108,1.,0.,0.,0.;" },
		    { 143, 0, "143,0,1,1,5;" },
		    { 141, 0, "141,0,0,1,1,7,1,0;" },
		    { 106, 12, "106,2,3,0.,0.,0.,0.,2.,0.,0.,0.,3.;" } },
		  1,
		  1,
		  2,
		  { 0, 1, 2 } },
		/* 124: one, two in a row, one that turns left into right */
		{ { { 128, 0, SQUARE, 3 }, { 124, 0, MOVE } },
		  1,
		  0.25,
		  0.75,
		  { 10.25, 20.75, 30 } },
		{ { { 128, 0, SQUARE, 3 }, { 124, 0, TURN, 5 }, { 124, 10, MOVE } },
		  1,
		  1,
		  0,
		  { 10, 21, 30 } },
		{ { { 128, 0, SQUARE, 3 }, { 124, 0, MOVE, 5 }, { 124, 1, MIRROR } },
		  1,
		  1,
		  0,
		  { 11, 20, -30 } },
		{ { { 102, 0, "102,1,3;", 5 },
		    { 110, 0, "110,0.,0.,0.,1.,0.,0.;", 7 },
		    { 124, 0, MOVE },
		    { 124, 0, TURN } },
		  1,
		  1,
		  0,
		  { 10, 21, 30 } },
		/* numbers as files have them */
		{ { { 110, 0, "110, 1.D0 ,2.0E+00,3,,2D0,3.E-0;" } }, 1, 0, 0, { 1, 2, 3 } },
		{ { { 110, 0, "110,1.,2.,3.,5.,2.,3.,0,0; and a comment, 1;2" } },
		  1,
		  1,
		  0,
		  { 5, 2, 3 } },
		/* a face leads to its surface */
		{ { { 128, 0, SQUARE }, { 144, 0, "144,1,1,0,5;" }, { 142, 0, "142,0,1,0,0,2;" } },
		  3,
		  0.25,
		  0.75,
		  { 0.25, 0.75, 0 } },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct model m;
		struct report_store store;
		struct made_file f = { 0 };
		struct entity *e = NULL;
		char selector[16];
		if (read_made(&m, &f, rows[i].entities, &store) != ST_OK)
			fail_msg("row %zu: %s", i, store.error);
		snprintf(selector, sizeof selector, "D%d", rows[i].de);
		if (model_find(&m, selector, &e, NULL) != ST_OK)
			fail_msg("row %zu: %s", i, m.n_skipped ? m.skipped[0].reason : "not there");
		double u = rows[i].u;
		if (e->kind == ENTITY_CURVE && u < 0) /* a share of the domain */
			u = 0.5 * (e->curve.domain[0] + e->curve.domain[1]);
		assert_point(i,
		             e->kind == ENTITY_CURVE ? curve_point(&e->curve, u)
		                                     : surface_point(&e->geometry, u, rows[i].v),
		             rows[i].p);
		model_finish(&m);
	}
}

/* 114 over [0,2] x [0,1]: z = s t with s, t from each patch's corner; extra row and column. */
static void power_surfaces_leave_out_the_extra_patches(void **state)
{
	struct text t = { 0 };
	text_add(&t, "114,3,1,2,1,0.,1.,2.,0.,1.");
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 2; j++)
			for (int k = 0; k < 48; k++) {
				double x = i == 2 || j == 1 ? 99 : 0;
				if (x == 0 && (k == 0 || k == 1))
					x = k == 0 ? i : 1; /* x = i + s */
				if (x == 0 && k == 16 + 4)
					x = 1; /* y = t */
				if (x == 0 && k == 32 + 4)
					x = i; /* z = i t + s t */
				if (x == 0 && k == 32 + 5)
					x = 1;
				text_addf(&t, ",%g", x);
			}
	text_add(&t, ";");
	const struct made_entity entities[MADE_MAX] = { { 114, 0, t.s } };
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	const struct surface *s = &m.entities[0].geometry;
	assert_true(s->domain[0][1] == 2 && s->domain[1][1] == 1);
	assert_point(0, surface_point(s, 0.5, 0.5), vec3(0.5, 0.5, 0.25));
	assert_point(1, surface_point(s, 1.5, 0.25), vec3(1.5, 0.25, 0.375));
	model_finish(&m);
	text_finish(&t);
}

#define CURVE(order, knots, weights, rest)                                                         \
	"126,1," order ",0,0,1,0," knots weights "0.,0.,0.,1.,0.,0." rest

/* Entity 1 is bad for that reason; the square beside it is read. */
static void one_bad_entity_costs_one_entity(void **state)
{
	static const struct {
		struct made_entity bad[5];
		const char *reason;
	} rows[] = {
		{ { { 126, 0, CURVE("1", "0.,1.,0.,1.,", "1.,1.,", ",0.,1.;") } }, "knot" },
		{ { { 126, 0, CURVE("1", "0.,0.,0.,0.,", "1.,1.,", ",0.,1.;") } }, "knot" },
		{ { { 126, 0, CURVE("1", KNOTS4, "1.,0.,", ",0.,1.;") } }, "weight" },
		{ { { 126, 0, CURVE("1", KNOTS4, "1.,-1.,", ",0.,1.;") } }, "weight" },
		{ { { 126, 0, CURVE("1", KNOTS4, "1.,1.E999,", ",0.,1.;") } }, "expected" },
		{ { { 126, 0, CURVE("26", KNOTS4, "1.,1.,", ",0.,1.;") } },
		  "degree 26, expected 1 to 25" },
		{ { { 126, 0, CURVE("0", KNOTS4, "1.,1.,", ",0.,1.;") } }, "degree 0" },
		{ { { 126, 0, CURVE("1", KNOTS4, "1.,1.,", ";") } }, NULL },
		{ { { 126, 0, CURVE("1", KNOTS4, "1.,1.,", "") } }, "no end" },
		{ { { 126, 0, CURVE("1", KNOTS4, "1.,abc,", ",0.,1.;") } },
		  "'abc' where a number" },
		{ { { 126, 0, CURVE("1", KNOTS4, "1.,3Habc,", ",0.,1.;") } }, "where a number" },
		{ { { 126, 0, CURVE("1", KNOTS4, "1.,,", ",0.,1.;") } }, "leaves numbers out" },
		{ { { 126, 0, "126,1,1;" } }, "ends too early" },
		{ { { 126, 0, "126,999999999,3,0,0,1,0,0.;" } }, "expected 1 to" },
		{ { { 126, 0, "126,1.5,3,0,0,1,0,0.;" } }, "whole" },
		{ { { 128, 0, "128,60000,60000,3,3,0,0,1,0,0,0.;" } }, "expected 1 to" },
		{ { { 128, 0, "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.;" } }, "ends too early" },
		{ { { 126, 0, "110,0.,0.,0.,1.,1.,1.;" } }, "do not begin with its type" },
		{ { { 110, 1, "110,0.,0.,0.,1.,1.,1.;" } }, "without ends" },
		{ { { 110, 0, "110,0.,0.,0.,1.,1.,1.;", 99 } }, "directory entry 99" },
		{ { { 110, 0, "110,0.,0.,0.,1.,1.,1.;", 1 } }, "type 124 is expected" },
		{ { { 110, 0, "110,0.,0.,0.,1.,1.,1.;", 3 },
		    { 124, 0, MOVE, 5 },
		    { 124, 0, TURN, 3 } },
		  "circle" },
		{ { { 100, 0, "100,0.,0.,0.,0.,0.,0.,0.;" } }, "radius 0" },
		{ { { 102, 0, "102,1,1;" } }, "circle" },
		{ { { 102, 0, "102,1,3;" }, { 102, 0, "102,1,1;" } }, "circle" },
		{ { { 102, 0, "102,1,99;" } }, "directory entry 99" },
		{ { { 102, 0, "102,2,3,5;" },
		    { 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		    { 110, 0, "110,8.,0.,0.,9.,0.,0.;" } },
		  "begins 7 from the end" },
		{ { { 106, 12, "106,2,100000,0.,0.,0.,1.,2.,3.;" } }, "points" },
		{ { { 108, 0, "108,0.,0.,1.,5.,0;" } }, "without bounds" },
		{ { { 108, 0, "108,0.,0.,0.,5.,0;" } }, "no plane's" },
		{ { { 108, 1, "108,0.,0.,1.,0.,3;" }, { 110, 0, "110,0.,0.,0.,1.,0.,0.;" } },
		  "no area" },
		{ { { 108, -1, "108,0.,0.,1.,0.,3;" }, { 110, 0, "110,0.,0.,0.,1.,1.,0.;" } },
		  "hole" },
		{ { { 120, 0, "120,3,3,0.,1.;" }, { 110, 0, "110,0.,0.,0.,0.,0.,0.;" } },
		  "axis has no length" },
		{ { { 140, 0, "140,0.,0.,1.,2.,1;" } }, "circle" },
		{ { { 140, 0, "140,0.,0.,1.,2.,3;" }, { 110, 0, "110,0.,0.,0.,1.,0.,0.;" } },
		  "where a surface is expected" },
		{ { { 144, 0, "144,77,1,0,0;" } }, "surface D77 is not there" },
		{ { { 144, 0, "144,3,1,0,0;" }, { 110, 0, "110,0.,0.,0.,1.,1.,1.;" } },
		  "D3 is of a type that is not read" },
		{ { { 144, 0, "144,3,1,0,0;" }, { 128, 0, "128,1;" } }, "D3 cannot be read" },
		{ { { 144, 0, "144,3,1,0,0;" }, { 128, 0, SQUARE } },
		  "directory entry 0, which is not there; the surface under it is read" },
		{ { { 144, 0, "144,3,1,0,5;" }, { 128, 0, SQUARE }, { 142, 0, "142,0,3,0,0,0;" } },
		  "neither a curve in u,v nor one in space" },
		{ { { 144, 0, "144,3,1,0,5;" },
		    { 128, 0, SQUARE },
		    { 142, 0, "142,0,3,7,0,0;" },
		    { 110, 0, "110,0.,0.,0.,1.,0.,0.;" } },
		  "does not close" },
		{ { { 144, 0, "144,3,1,0,5;" },
		    { 128, 0, SQUARE },
		    { 142, 0, "142,0,3,0,7,0;" },
		    { 100, 0, "100,5.,0.,0.,1.,0.,1.,0.;" } },
		  "up to 5 from the surface" },
		{ { { 510, 0, "510,3,1,1,5;" },
		    { 128, 0, SQUARE },
		    { 508, 0, "508,1,0,7,9,1,0;" },
		    { 504, 0, "504,0;" } },
		  "edge 9 of D7" },
		{ { { 514, 0, "514,1,3,1;" }, { 110, 0, "110,0.,0.,0.,1.,1.,1.;" } },
		  "D3, which is no face" },
		{ { { 186, 0, "186,3,1,0;" }, { 110, 0, "110,0.,0.,0.,1.,1.,1.;" } },
		  "D3, which is no shell" },
		{ { { 408, 0, "408,3,0.,0.,0.,1.;" }, { 308, 0, "308,0,1HA,1,1;" } },
		  "contains itself" },
		{ { { 408, 0, "408,3,0.,0.,0.,1.;" },
		    { 308, 0, "308,0,1HA,1,5;" },
		    { 402, 1, "402,1,1;" } },
		  "contains itself" },
		{ { { 408, 0, "408,3,0.,0.,0.,0.;" }, { 308, 0, "308,0,1HA,0;" } }, "scaled by 0" },
		{ { { 408, 0, "408,3,0.,0.,0.,1.;" }, { 110, 0, "110,0.,0.,0.,1.,1.,1.;" } },
		  "defines no subfigure" },
		{ { { 402, 3, "402,0;" } }, "other than groups" },
		{ { { 508, 0, "508,0;" } }, "no face uses" },
		{ { { 5001, 0, "5001,1;" } }, "does not know" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct made_entity entities[MADE_MAX] = { 0 };
		struct made_file f = { 0 };
		struct model m;
		struct report_store store;
		struct entity *e;
		int n = 0;
		for (; n < 5 && rows[i].bad[n].type; n++)
			entities[n] = rows[i].bad[n];
		entities[n] = (struct made_entity){ 128, 0, SQUARE };
		char selector[16];
		snprintf(selector, sizeof selector, "D%d", 2 * n + 1);
		if (read_made(&m, &f, entities, &store) != ST_OK)
			fail_msg("row %zu: %s", i, store.error);
		assert_int_equal(model_find(&m, selector, &e, NULL), ST_OK);
		assert_int_equal(e->kind, ENTITY_SURFACE);
		bool said = false;
		for (int k = 0; k < m.n_skipped; k++)
			said |= rows[i].reason && m.skipped[k].first_de == 1 &&
			        m.skipped[k].type == entities[0].type &&
			        strstr(m.skipped[k].reason, rows[i].reason);
		if (rows[i].reason ? !said : m.n_skipped)
			fail_msg("row %zu: %s", i,
			         m.n_skipped ? m.skipped[0].reason : "nothing skipped");
		model_finish(&m);
	}
}

/* Stated ranges of a curve with the knots 0 0 1 2 2, and what is taken. */
static void ranges_bound_the_domain(void **state)
{
	static const struct {
		const char *range;
		double from, to;
		const char *warning;
	} rows[] = {
		{ ",0.,2.;", 0, 2, NULL },
		{ ",.5,1.5;", 0.5, 1.5, NULL },
		{ ",0.,2.0000000000001;", 0, 2, NULL },
		{ ",-1.,1.;", 0, 1, "beyond the knots" },
		{ ",1.5,.5;", 0, 2, "makes no sense" },
		{ ",1.,1.;", 0, 2, "makes no sense" },
		{ ",7.,9.;", 0, 2, "makes no sense" },
		{ ";", 0, 2, "no parameter range" },
		{ ",0.;", 0, 2, "no parameter range" },
		{ ",,;", 0, 2, "no parameter range" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct text t = { 0 };
		text_addf(&t,
		          "126,2,1,0,0,1,0,0.,0.,1.,2.,2.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,0.,0.%s",
		          rows[i].range);
		const struct made_entity entities[MADE_MAX] = { { 126, 0, t.s } };
		struct made_file f = { 0 };
		struct model m;
		struct report_store store;
		assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
		const double *domain = m.entities[0].curve.domain;
		if (domain[0] != rows[i].from || domain[1] != rows[i].to)
			fail_msg("row %zu: %g to %g", i, domain[0], domain[1]);
		assert_int_equal(m.n_warnings, rows[i].warning != NULL);
		if (rows[i].warning)
			assert_non_null(strstr(m.warnings[0], rows[i].warning));
		model_finish(&m);
		text_finish(&t);
	}
}

static void headers_and_their_faults(void **state)
{
	static const struct {
		const char *global, *unit;
		double mm, scale;
		const char *warning;
	} rows[] = {
		{ "1H,,1H;,,,,,32,38,6,308,15,,1.,6,1HM;", "m", 1000, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,,2;", "mm", 1, 1, NULL },
		{ ",,,,,,,,,,,,1.D0,10,2HCM;", "cm", 10, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,.125,4,2HFT;", "ft", 304.8, 0.125, "scale of 0.125" },
		{ "1H,,1H;,,,,,,,,,,,1.,3,5Hcubit;", "cubit", 0, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,1.,3,2HMM;", "mm", 1, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,1.,,4HINCH;", "in", 25.4, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,1.,2,1HM;", "mm", 1, 1, "flag is taken" },
		{ "1H,,1H;,,,,,,,,,,,1.,77,;", "in", 25.4, 1, "standard's default" },
		{ "1H,,1H;;", "in", 25.4, 1, "standard's default" },
		{ "1H,,1H;,,,,,,,,,,,2,2HMM,1;", "mm", 1, 2, "in the place of the unit flag" },
		{ "1H,,1H;,,5Hx,y;z,,,,,,,,,1.,6,1HM;", "m", 1000, 1, NULL },
		{ "1H,,1H;,,3Hshort,,,,,,,,,1.,2,2HMM;", "mm", 1, 1, "not as long as it says" },
		{ "1H,,1H;,,999999Hlong,,,,,,,,,1.,2,2HMM;", "in", 25.4, 1,
		  "not as long as it says" },
		{ "1H,,1H;,,,,,,,,,,,-3.,2,2HMM;", "mm", 1, 1, "no positive number" },
		{ "1H1,1H,,,,", "in", 25.4, 1, "standard's default" },
		{ "garbage", "in", 25.4, 1, "standard's default" },
		{ "", "in", 25.4, 1, "no header" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		const struct made_entity entities[MADE_MAX] = { { 128, 0, SQUARE } };
		struct made_file f = { .global = rows[i].global };
		struct model m;
		struct report_store store;
		bool said = !rows[i].warning;
		assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
		if ((!m.unit || strcmp(m.unit, rows[i].unit) != 0 || m.unit_in_mm != rows[i].mm ||
		     m.scale != rows[i].scale))
			fail_msg("row %zu: %s %g scale %g", i, m.unit ? m.unit : "-", m.unit_in_mm,
			         m.scale);
		for (int k = 0; k < m.n_warnings; k++)
			said |= rows[i].warning && strstr(m.warnings[k], rows[i].warning);
		if (!said || (!rows[i].warning && m.n_warnings))
			fail_msg("row %zu: %s", i, m.n_warnings ? m.warnings[0] : "no warning");
		model_finish(&m);
	}
}

static const struct made_entity standard[MADE_MAX] = {
	{ 126, 0, QUARTER, 3, 2, "00010000", "ARC", 7 },
	{ 124, 0, MOVE },
	{ 128, 0,
	  "128,1,1,1,1,0,0,1,0,0," KNOTS4 KNOTS4 "1.,1.,1.,1.,0.123456789012345,0.,0.,1.,0.,0.,0.,"
	  "1.,0.,1.,1.,0.,0.,1.,0.,1.,0,2,7,9;",
	  0, -11, "01000000", "HULL" },
	{ 406, 15, "406,1,17Hbow; port, side 1;" },
	{ 406, 5, "406,5,1,2,3,4,5;" },
	{ 314, 0, "314,25.,50.,100.,4Hblue;" },
	{ 116, 0, "116,1.,2.,3.,0;", 3 },
};

static void assert_standard(const struct model *m, const char *what)
{
	if (m->n != 3)
		fail_msg("%s: %d entities, %s", what, m->n,
		         m->n_skipped ? m->skipped[0].reason : "");
	const struct entity *arc = &m->entities[0], *hull = &m->entities[1],
	                    *point = &m->entities[2];
	assert_int_equal(arc->number, 1);
	assert_int_equal(arc->de, 1);
	assert_string_equal(arc->name, "ARC.7");
	assert_true(arc->has_color && arc->color[0] == 1 && arc->color[1] == 0);
	assert_true(arc->curve.rational);
	assert_point(0, curve_point(&arc->curve, 0), vec3(11, 20, 30));
	assert_int_equal(hull->number, 2);
	assert_string_equal(hull->name, "bow; port, side 1");
	assert_true(hull->has_color && hull->color[0] == 0.25 && hull->color[2] == 1);
	assert_true(surface_get_point(&hull->geometry, 0, 0, NULL).x == 0.123456789012345);
	assert_int_equal(point->number, 3);
	assert_int_equal(point->kind, ENTITY_POINTS);
	assert_true(point->points.values[0] == 11);
}

static void files_as_programs_write_them(void **state)
{
	static const struct {
		const char *what;
		struct made_file file;
	} rows[] = {
		{ "plain", { 0 } },
		{ "CRLF", { .line_end = "\r\n" } },
		{ "lone CR", { .line_end = "\r" } },
		{ "lines of 80 without ends", { .line_end = "" } },
		{ "empty lines between", { .line_end = "\n\n" } },
		{ "blanks behind", { .line_end = "  \n" } },
		{ "columns beyond 80", { .line_end = " REV 3\n" } },
		{ "numbers cut at line ends", { .columns = 7 } },
		{ "one character a line", { .columns = 1 } },
		{ "sequence numbers from 100", { .sequence = 100 } },
		{ "no pointers back", { .no_back_pointers = true } },
		{ "wrong pointers to the data", { .bad_data_pointers = true } },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct model m;
		struct report_store store;
		if (read_made(&m, &rows[i].file, standard, &store) != ST_OK)
			fail_msg("%s: %s", rows[i].what, store.error);
		assert_standard(&m, rows[i].what);
		model_finish(&m);
	}
}

static void whole_files_refused(void **state)
{
	static const struct {
		struct made_file file;
		struct made_entity entities[MADE_MAX];
		const char *sentence;
	} rows[] = {
		{ { .no_terminate = true }, { { 128, 0, SQUARE } }, "cut short" },
		{ { .letter = 'C' }, { { 128, 0, SQUARE } }, "compressed" },
		{ { .letter = 'B' }, { { 128, 0, SQUARE } }, "binary" },
		{ { 0 }, { { 0 } }, "no entities" },
		{ { 0 }, { { 144, 0, "144,7,1,0,0;" } }, "first thing skipped is D1 of type 144" },
		{ { 0 }, { { 126, 0, "126;" } }, "first thing skipped is D1 of type 126" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct model m;
		struct report_store store;
		assert_int_equal(read_made(&m, &rows[i].file, rows[i].entities, &store), ST_INPUT);
		assert_int_equal(store.n_errors, 1);
		if (!strstr(store.error, rows[i].sentence))
			fail_msg("row %zu: %s", i, store.error);
		model_finish(&m);
	}
	assert_false(iges_recognise("", 0));
	assert_false(iges_recognise("batten base 1\n", 14));
}

/* Curves that others are made of keep their entry but get no number. */
static void parts_are_not_counted(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 128, 0, SQUARE },
		{ 142, 0, "142,0,3,9,11,2;" },
		{ 144, 0, "144,3,1,0,5;" },
		{ 126, 0, QUARTER },
		{ 102, 0, "102,1,13;" },
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 110, 0, "110,0.,0.,0.,2.,0.,0.;" },
	};
	static const int numbers[] = { 1, 2, 0, 0, 0, 3 };
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	struct entity *e;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(m.n, 6);
	for (int i = 0; i < 6; i++)
		assert_int_equal(m.entities[i].number, numbers[i]);
	assert_int_equal(m.entities[1].trims, 1);
	assert_int_equal(model_find(&m, "D13", &e, NULL), ST_OK);
	assert_int_equal(e->number, 0);
	assert_int_equal(model_find(&m, "D7", &e, NULL), ST_OK);
	assert_int_equal(e->number, 2);
	model_finish(&m);
}

static void written_is_read_again(void **state)
{
	struct model a, b;
	struct report_store store;
	struct text t = { 0 };
	const struct made_file f = { .global = "1H,,1H;,,,,,,,,,,,.5,6,1HM;" };
	(void)state;
	assert_int_equal(read_made(&a, &f, standard, &store), ST_OK);
	free(a.entities[0].name);
	a.entities[0].name =
	        strdup("a name that is longer than a line of parameters; with, \"all\" "
	               "kinds of characters in it");
	a.entities[1].geometry.points[1] = -1.2345678901234567e-200;
	a.entities[1].geometry.points[2] = 1e22;
	iges_format(&a, &t);
	assert_false(t.failed);
	model_init(&b);
	assert_true(iges_recognise(t.s, t.n));
	if (iges_parse(&b, t.s, t.n, "y.igs", NULL, &store.report) != ST_OK)
		fail_msg("%s", store.error);
	assert_int_equal(b.n, 2);
	assert_int_equal(b.n_skipped, 0);
	assert_string_equal(b.unit, "m");
	assert_true(b.scale == 0.5 && b.unit_in_mm == 1000);
	const struct curve *c = &a.entities[0].curve, *d = &b.entities[0].curve;
	assert_string_equal(b.entities[0].name, a.entities[0].name);
	assert_memory_equal(c->knots, d->knots, 6 * sizeof(double));
	assert_memory_equal(c->domain, d->domain, sizeof c->domain);
	for (int i = 0; i < 12; i++)
		assert_true(fabs(c->points[i] - d->points[i]) <= 1e-15 * fabs(c->points[i]));
	const struct surface *s = &a.entities[1].geometry, *r = &b.entities[1].geometry;
	assert_memory_equal(s->points, r->points, 16 * sizeof(double));
	assert_memory_equal(s->knots[0], r->knots[0], 4 * sizeof(double));
	assert_memory_equal(b.entities[1].color, a.entities[1].color, sizeof b.entities[1].color);
	for (const char *line = t.s; *line; line = strchr(line, '\n') + 1)
		assert_int_equal(strchr(line, '\n') - line, 80);
	model_finish(&a);
	model_finish(&b);
	text_finish(&t);
}

/* Programs that overlook U0 .. V1 must see the part that is meant: it is written alone. */
static void only_what_is_meant_is_written(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 128, 0,
		  "128,2,1,1,1,0,0,1,0,0,0.,0.,1.,2.,2.," KNOTS4
		  "1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,"
		  "1.,0.,0.,1.,0.,1.,1.,0.,2.,1.,3.,.5,1.75,0.,1.;" },
		{ 126, 0,
		  "126,2,1,0,0,1,0,0.,0.,1.,2.,2.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,1.,0.,.5,1.75;" },
	};
	const struct made_file f = { 0 };
	struct model a, b;
	struct report_store store;
	struct text t = { 0 };
	(void)state;
	assert_int_equal(read_made(&a, &f, entities, &store), ST_OK);
	iges_format(&a, &t);
	assert_false(t.failed);
	model_init(&b);
	assert_int_equal(iges_parse(&b, t.s, t.n, "y.igs", NULL, NULL), ST_OK);
	const struct surface *s = &b.entities[0].geometry;
	const struct curve *c = &b.entities[1].curve;
	assert_true(s->knots[0][1] == 0.5 && s->knots[0][s->n[0]] == 1.75);
	assert_true(c->knots[1] == 0.5 && c->knots[c->n] == 1.75);
	for (double u = 0.5; u <= 1.75; u += 0.25) {
		assert_point(0, surface_point(s, u, 0.5),
		             surface_point(&a.entities[0].geometry, u, 0.5));
		assert_point(1, curve_point(c, u), curve_point(&a.entities[1].curve, u));
	}
	model_finish(&a);
	model_finish(&b);
	text_finish(&t);
}

static void a_missing_unit_is_told(void **state)
{
	static const struct made_entity entities[MADE_MAX] = { { 128, 0, SQUARE } };
	const struct made_file f = { 0 };
	char folder[] = "/tmp/batten-test-XXXXXX", path[64];
	struct model m;
	struct report_store store;
	(void)state;
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/x.igs", folder);
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(iges_write(&m, path, &store.report), ST_OK);
	assert_int_equal(store.n_warnings, 0);
	assert_int_equal(model_set_text(&m.unit, NULL), ST_OK);
	assert_int_equal(iges_write(&m, path, &store.report), ST_OK);
	assert_int_equal(store.n_warnings, 1);
	model_finish(&m);
	assert_int_equal(model_read(&m, path, NULL, &store.report), ST_OK);
	assert_string_equal(m.unit, "mm");
	model_finish(&m);
	unlink(path);
	rmdir(folder);
}

static void stops_when_told(void **state)
{
	const struct made_file f = { 0 };
	struct text parameters = { 0 }, t = { 0 };
	atomic_bool stop;
	struct progress p = { .stop = &stop };
	struct model m;
	(void)state;
	atomic_init(&stop, true);
	text_add(&parameters, "106,2,100000");
	for (int i = 0; i < 100000; i++)
		text_addf(&parameters, ",%d.,2.,3.", i);
	text_add(&parameters, ";");
	const struct made_entity entities[] = { { 106, 12, parameters.s } };
	make_iges(&t, &f, entities, 1);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", &p, NULL), ST_CANCELLED);
	model_finish(&m);
	atomic_store(&stop, false);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", &p, NULL), ST_OK);
	assert_int_equal(m.entities[0].curve.n, 100000);
	model_finish(&m);
	text_finish(&t);
	text_finish(&parameters);
}

/* Composites of composites, each naming the next four times: 4^14 curves if nobody counted. */
static void entities_that_multiply_are_stopped(void **state)
{
	enum { DEPTH = 14 };
	static char parameters[DEPTH][64];
	struct made_entity entities[DEPTH + 1];
	const struct made_file f = { 0 };
	struct model m;
	struct text t = { 0 };
	(void)state;
	for (int i = 0; i < DEPTH; i++) {
		int next = 2 * i + 3;
		snprintf(parameters[i], sizeof parameters[i], "102,4,%d,%d,%d,%d;", next, next,
		         next, next);
		entities[i] = (struct made_entity){ 102, 0, parameters[i] };
	}
	entities[DEPTH] = (struct made_entity){ 110, 0, "110,0.,0.,0.,0.,0.,0.;" };
	make_iges(&t, &f, entities, DEPTH + 1);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", NULL, NULL), ST_OK);
	assert_true(m.n_skipped > 0);
	assert_non_null(strstr(m.skipped[0].reason, "too many times"));
	model_finish(&m);
	text_finish(&t);
}

#define DISK   "100,0.,.5,.5,.9,.5,.9,.5;" /* of radius 0.4 */
#define DISK_L M_PI * 0.16

/* Faces in every dress, with the area that is left, and where the middle of the surface lies. */
static const struct {
	struct made_entity entities[MADE_MAX + 2];
	double area;
	struct vec3 p;
} faces[] = {
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, DISK } },
	  DISK_L,
	  { 0.5, 0.5, 0 } },
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,0,7,2;" },
	    { 100, 0, DISK } },
	  DISK_L,
	  { 0.5, 0.5, 0 } },
	/* both courses, that in u,v somewhere else */
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,9,7,1;" },
	    { 100, 0, DISK },
	    { 100, 0, "100,0.,.5,.5,.6,.5,.6,.5;" } },
	  DISK_L,
	  { 0.5, 0.5, 0 } },
	/* no outer loop: the whole domain is meant */
	{ { { 144, 0, "144,3,0,1,0,5;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, DISK } },
	  1 - DISK_L,
	  { 0.5, 0.5, 0 } },
	/* a lost inner loop costs itself */
	{ { { 144, 0, "144,3,1,1,5,99;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, DISK } },
	  DISK_L,
	  { 0.5, 0.5, 0 } },
	{ { { 143, 0, "143,0,3,1,5;" },
	    { 128, 0, SQUARE },
	    { 141, 0, "141,0,0,3,1,7,1,0;" },
	    { 100, 0, DISK } },
	  DISK_L,
	  { 0.5, 0.5, 0 } },
	/* two loops that are not told apart, the inner one first */
	{ { { 143, 0, "143,1,3,2,5,7;" },
	    { 128, 0, SQUARE },
	    { 141, 0, "141,1,2,3,1,9,1,1,9;" },
	    { 141, 0, "141,1,2,3,1,11,1,1,11;" },
	    { 100, 0, "100,0.,.5,.5,.6,.5,.6,.5;" },
	    { 100, 0, DISK } },
	  DISK_L - M_PI * 0.01,
	  { 0.5, 0.5, 0 } },
	{ { { 510, 0, "510,3,1,1,5;" },
	    { 128, 0, SQUARE },
	    { 508, 0, "508,1,0,7,1,0,0;" },
	    { 504, 0, "504,1,9,11,1,11,1;" },
	    { 100, 0, DISK },
	    { 502, 0, "502,1,.9,.5,0.;" } },
	  DISK_L,
	  { 0.5, 0.5, 0 } },
	/* a 124 on the face, on its shell, on the solid */
	{ { { 144, 0, "144,3,1,0,5;", 9 },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,0,7,2;" },
	    { 100, 0, DISK },
	    { 124, 0, MOVE } },
	  DISK_L,
	  { 10.5, 20.5, 30 } },
	{ { { 510, 0, "510,3,1,1,5;" },
	    { 128, 0, SQUARE },
	    { 508, 0, "508,1,0,7,1,1,1,0,9;" },
	    { 504, 0, "504,1,9,0,0,0,0;" },
	    { 100, 0, DISK },
	    { 514, 0, "514,1,1,1;", 15 },
	    { 186, 0, "186,11,1,0;", 17 },
	    { 124, 0, MOVE },
	    { 124, 0, TURN } },
	  DISK_L,
	  { -20.5, 10.5, 30 } },
	/* a cylinder of radius 1 and height 1, cut at half its height, by curves in space only */
	{ { { 143, 0, "143,0,3,1,5;" },
	    { 122, 0, "122,7,1.,0.,1.;" },
	    { 141, 0, "141,0,0,3,4,7,1,0,9,1,0,11,2,0,13,1,0;" },
	    { 100, 0, "100,0.,0.,0.,1.,0.,0.,1.;" },
	    { 110, 0, "110,0.,1.,0.,0.,1.,.5;" },
	    { 100, 0, "100,.5,0.,0.,1.,0.,0.,1.;" },
	    { 110, 0, "110,1.,0.,.5,1.,0.,0.;" } },
	  M_PI / 4,
	  { 0.70710678118654752, 0.70710678118654752, 0.5 } },
	/* all around a closed one: the seam runs up and down */
	{ { { 143, 0, "143,0,3,1,5;" },
	    { 122, 0, "122,7,1.,0.,1.;" },
	    { 141, 0, "141,0,0,3,4,9,1,0,7,1,0,9,2,0,11,2,0;" },
	    { 100, 0, "100,0.,0.,0.,1.,0.,1.,0.;" },
	    { 110, 0, "110,1.,0.,.5,1.,0.,0.;" },
	    { 100, 0, "100,.5,0.,0.,1.,0.,1.,0.;" } },
	  M_PI,
	  { -1, 0, 0.5 } },
};
enum { N_FACES = sizeof faces / sizeof faces[0] };

static void read_face(struct model *m, size_t row)
{
	struct made_file f = { 0 };
	struct report_store store;
	struct text t = { 0 };
	int n = 0;
	while (n < MADE_MAX + 2 && faces[row].entities[n].type)
		n++;
	make_iges(&t, &f, faces[row].entities, n);
	report_store_init(&store);
	model_init(m);
	if (iges_parse(m, t.s, t.n, "x.igs", NULL, &store.report) != ST_OK)
		fail_msg("row %zu: %s", row, store.error);
	text_finish(&t);
}

static const struct entity *trimmed(const struct model *m, size_t row)
{
	for (int i = 0; i < m->n; i++)
		if (m->entities[i].trim.n)
			return &m->entities[i];
	fail_msg("row %zu: no trims: %s", row,
	         m->n_skipped ? m->skipped[0].reason : "nothing skipped");
	return NULL;
}

static void assert_area(size_t row, const struct entity *e, double expected)
{
	double area, error;
	assert_int_equal(trim_area(&e->trim, &e->geometry, 1e-8, &area, &error), ST_OK);
	if (!(fabs(area - expected) <= 2e-6 * expected))
		fail_msg("row %zu: area %.12g, expected %.12g", row, area, expected);
}

static void faces_become_trims(void **state)
{
	(void)state;
	for (size_t i = 0; i < N_FACES; i++) {
		struct model m;
		read_face(&m, i);
		const struct entity *e = trimmed(&m, i);
		const double(*d)[2] = e->geometry.domain;
		assert_int_equal(e->number, 1);
		assert_int_equal(e->de, 3);
		assert_int_equal(e->n_faces, 1);
		assert_int_equal(e->faces[0], 1);
		assert_point(i,
		             surface_point(&e->geometry, 0.5 * (d[0][0] + d[0][1]),
		                           0.5 * (d[1][0] + d[1][1])),
		             faces[i].p);
		assert_area(i, e, faces[i].area);
		model_finish(&m);
	}
}

static void trims_are_written_and_read_again(void **state)
{
	(void)state;
	for (size_t i = 0; i < N_FACES; i++) {
		struct model a, b;
		struct text t = { 0 };
		struct report_store store;
		read_face(&a, i);
		struct entity *e = (struct entity *)trimmed(&a, i);
		assert_int_equal(model_set_text(&e->name, "bow"), ST_OK);
		e->has_color = true;
		e->color[1] = 0.5;
		iges_format(&a, &t);
		assert_false(t.failed);
		report_store_init(&store);
		model_init(&b);
		if (iges_parse(&b, t.s, t.n, "y.igs", NULL, &store.report) != ST_OK)
			fail_msg("row %zu: %s", i, store.error);
		const struct entity *again = trimmed(&b, i);
		assert_int_equal(b.n_skipped, 0);
		assert_string_equal(again->name, "bow");
		assert_true(again->has_color && again->color[1] == 0.5);
		assert_int_equal(again->trim.n, e->trim.n);
		for (int k = 0; k < e->trim.n; k++) {
			const struct trim_loop *x = &e->trim.loops[k], *y = NULL;
			for (int l = 0; l < e->trim.n; l++)
				if (again->trim.loops[l].outer == x->outer)
					y = &again->trim.loops[l];
			assert_non_null(y);
			assert_int_equal(x->n, y->n);
			for (int c = 0; c < x->n; c++) {
				assert_int_equal(x->curves[c].n, y->curves[c].n);
				for (int p = 0; p < 4 * x->curves[c].n; p++)
					assert_true(fabs(x->curves[c].points[p] -
					                 y->curves[c].points[p]) <= 1e-12);
			}
		}
		assert_area(i, again, faces[i].area);
		model_finish(&a);
		model_finish(&b);
		text_finish(&t);
	}
}

/* A surface that two faces share comes twice; its number stays. */
static void shared_surfaces_keep_every_trim(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 128, 0, SQUARE },
		{ 144, 0, "144,1,1,0,7;" },
		{ 144, 0, "144,1,0,1,0,7;", 0, 0, NULL, "HOLE" },
		{ 142, 0, "142,0,1,9,0,1;" },
		{ 100, 0, DISK },
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
	};
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	struct entity *e;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(m.entities[0].n_faces, 2);
	assert_area(0, &m.entities[0], DISK_L);
	assert_int_equal(model_find(&m, "D5", &e, NULL), ST_OK);
	assert_int_equal(e->number, 3);
	assert_string_equal(e->name, "HOLE");
	assert_area(1, e, 1 - DISK_L);
	assert_int_equal(model_find(&m, "2", &e, NULL), ST_OK);
	assert_int_equal(e->de, 11);
	model_finish(&m);
}

/* A subfigure of a subfigure, placed twice: surfaces by the first instance in their own place. */
static void instances_show_subfigures(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 128, 0, SQUARE },
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 308, 0, "308,0,4Hpart,2,1,3;" },
		{ 408, 0, "408,5,1.,0.,0.,2.;" },
		{ 308, 0, "308,1,5Hwhole,1,13;" },
		{ 408, 0, "408,9,0.,0.,5.,1.;" },
		{ 402, 7, "402,1,7;" },
		{ 408, 0, "408,9,0.,0.,0.,;", 0 },
	};
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	struct entity *e;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(m.n_skipped, 0);
	assert_int_equal(m.n_warnings, 0);
	assert_int_equal(m.n, 5);
	assert_int_equal(model_find(&m, "1", &e, NULL), ST_OK);
	assert_point(0, surface_point(&e->geometry, 1, 1), vec3(3, 2, 5));
	assert_int_equal(m.entities[1].number, 0);
	assert_int_equal(m.entities[2].de, 15);
	assert_point(1, surface_point(&m.entities[2].geometry, 1, 1), vec3(3, 2, 0));
	assert_point(2, curve_point(&m.entities[3].curve, 1), vec3(3, 0, 5));
	assert_point(3, curve_point(&m.entities[4].curve, 1), vec3(3, 0, 0));
	model_finish(&m);
}

static void a_lone_curve_on_surface_is_one(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 142, 0, "142,0,3,0,5,2;" },
		{ 122, 0, "122,7,1.,0.,1.;" },
		{ 100, 0, "100,.5,0.,0.,1.,0.,0.,1.;" },
		{ 100, 0, "100,0.,0.,0.,1.,0.,0.,1.;" },
	};
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	const struct entity *e = &m.entities[m.n - 1];
	assert_int_equal(e->kind, ENTITY_CURVE_ON_SURFACE);
	assert_int_equal(e->number, 2);
	for (int i = 0; i <= 4; i++) {
		double t = e->space.domain[0] + (e->space.domain[1] - e->space.domain[0]) * i / 4;
		struct vec3 p = curve_point(&e->space, t);
		assert_true(fabs(hypot(p.x, p.y) - 1) < 1e-5 && fabs(p.z - 0.5) < 1e-5);
		assert_true(fabs(curve_point(&e->curve, t).y - 0.5) < 1e-5);
	}
	model_finish(&m);
}

static void damaged_files_are_survived(void **state)
{
	struct text t = { 0 };
	uint64_t seed = 11;
	int good = 0, bad = 0;
	const struct made_file f = { 0 };
	const struct made_entity more[] = {
		standard[0],
		standard[1],
		standard[2],
		standard[3],
		standard[4],
		standard[5],
		standard[6],
		{ 102, 0, "102,2,17,19;" },
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 100, 0, "100,0.,1.,1.,1.,0.,2.,1.;" },
		{ 120, 0, "120,17,19,0.,1.5;" },
		{ 118, 1, "118,17,19,0,0;" },
		{ 144, 0, "144,5,1,0,27;" },
		{ 142, 0, "142,0,5,17,19,2;" },
		{ 108, 0, "108,0.,0.,1.,0.,0;" },
		{ 143, 0, "143,0,29,1,33;" },
		{ 141, 0, "141,0,0,29,2,17,1,0,19,1,0;" },
		{ 112, 0, "112,3,2,3,1,0.,1.,0.,1.,0.,0.,0.,0.,1.,0.,2.,0.,0.,0.,0.,0.,0.,0.;" },
		{ 140, 0, "140,0.,0.,1.,.1,5;" },
		{ 510, 0, "510,5,1,1,41;" },
		{ 508, 0, "508,1,0,43,1,1,1,0,47;" },
		{ 504, 0, "504,1,47,0,0,0,0;" },
		{ 514, 0, "514,1,39,1;", 3 },
		{ 100, 0, DISK },
		{ 308, 0, "308,0,1Ha,2,5,45;" },
		{ 408, 0, "408,49,1.,2.,3.,2.;", 3 },
	};
	(void)state;
	make_iges(&t, &f, more, sizeof more / sizeof more[0]);
	for (int i = 0; i < 400; i++) {
		struct model m;
		struct report_store store;
		size_t n = 0;
		char *bytes = mutate(t.s, t.n, &seed, &n);
		assert_non_null(bytes);
		report_store_init(&store);
		model_init(&m);
		enum status st = iges_recognise(bytes, n)
		                         ? iges_parse(&m, bytes, n, "x.igs", NULL, &store.report)
		                         : ST_INPUT;
		assert_true(st == ST_OK || st == ST_INPUT);
		st == ST_OK ? good++ : bad++;
		if (st == ST_OK)
			assert_int_equal(store.n_errors, 0);
		model_finish(&m);
		free(bytes);
	}
	assert_true(good > 50 && bad > 20);
	text_finish(&t);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(entities_become_nurbs),
		cmocka_unit_test(power_surfaces_leave_out_the_extra_patches),
		cmocka_unit_test(one_bad_entity_costs_one_entity),
		cmocka_unit_test(ranges_bound_the_domain),
		cmocka_unit_test(headers_and_their_faults),
		cmocka_unit_test(files_as_programs_write_them),
		cmocka_unit_test(whole_files_refused),
		cmocka_unit_test(parts_are_not_counted),
		cmocka_unit_test(written_is_read_again),
		cmocka_unit_test(only_what_is_meant_is_written),
		cmocka_unit_test(a_missing_unit_is_told),
		cmocka_unit_test(stops_when_told),
		cmocka_unit_test(entities_that_multiply_are_stopped),
		cmocka_unit_test(faces_become_trims),
		cmocka_unit_test(trims_are_written_and_read_again),
		cmocka_unit_test(shared_surfaces_keep_every_trim),
		cmocka_unit_test(instances_show_subfigures),
		cmocka_unit_test(a_lone_curve_on_surface_is_one),
		cmocka_unit_test(damaged_files_are_survived),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
