/* test_iges_entities.c - IGES entity by entity, well formed and not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "iges_made.h"

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
		{ { { 104, 2, "104,4.,0.,-9.,0.,0.,-36.,5.,3.,0.,4.2426406871192852,2.;" } },
		  1,
		  M_PI / 8,
		  0,
		  { 3 / cos(M_PI / 8), 2 * tan(M_PI / 8), 5 } },
		{ { { 104, 3, "104,1.,0.,0.,0.,-2.,0.,5.,-1.,.5,3.,4.5;" } },
		  1,
		  2,
		  0,
		  { 2, 2, 5 } },
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
		{ { { 102, 0, "102,2,3,0;" }, { 110, 0, "110,0.,0.,0.,1.,0.,0.;" } }, "not there" },
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
		/* folded over itself: its normal turns about, no net is fine enough */
		{ { { 140, 0, "140,0.,0.,1.,2.,3;" },
		    { 128, 0,
		      "128,1,1,1,1,0,0,0,0,0," KNOTS4 KNOTS4
		      "1.,1.,16.,1.,0.,0.,0.,1.,5.,0.,0.,14.,0.,1.,1.,0.,0.,1.,0.,1.;" } },
		  "points looked at" },
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

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(entities_become_nurbs),
		cmocka_unit_test(power_surfaces_leave_out_the_extra_patches),
		cmocka_unit_test(one_bad_entity_costs_one_entity),
		cmocka_unit_test(ranges_bound_the_domain),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
