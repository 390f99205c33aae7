/* test_iges_faces.c - faces of IGES files: their loops, in every dress. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "iges_made.h"

/* Faces in every dress, with the area that is left, and where the middle of the surface lies. */
static const struct {
	struct made_entity entities[MADE_MAX + 2];
	double area;
	struct vec3 p;
	const char *said; /* among the warnings */
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
	/* loops in u,v alone, by the parameters of the standard: length and angle of a revolution */
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 120, 0, "120,9,11,0.,3.141592653589793;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, "100,0.,.5,1.5707963267948966,.8,1.5707963267948966,.8,1.5707963267948966;" },
	    { 110, 0, "110,0.,0.,0.,0.,0.,1.;" },
	    { 110, 0, "110,2.,0.,0.,2.,0.,4.;" } },
	  M_PI * 1.2 * 0.6,
	  { 0, 2, 2 } },
	/* an offset of it, half as large again */
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 140, 0, "140,0.,1.,0.,1.,13;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, "100,0.,.5,1.5707963267948966,.8,1.5707963267948966,.8,1.5707963267948966;" },
	    { 110, 0, "110,0.,0.,0.,0.,0.,1.;" },
	    { 110, 0, "110,2.,0.,0.,2.,0.,4.;" },
	    { 120, 0, "120,9,11,0.,3.141592653589793;" } },
	  M_PI * 1.2 * 0.9,
	  { 0, 3, 2 } },
	/* both parameters angles: latitudes from -90 degrees by 0.5 to 2, longitudes 0.3 to 1.1 */
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 120, 0, "120,9,11,0.,2.;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 106, 63,
	      "106,1,5,0.,5.21238898038469,.3,6.71238898038469,.3,6.71238898038469,1.1,"
	      "5.21238898038469,1.1,5.21238898038469,.3;" },
	    { 110, 0, "110,0.,0.,0.,0.,0.,1.;" },
	    { 100, 0, "100,0.,0.,0.,0.,-1.,0.,1.;", 13 },
	    { 124, 0, "124,1.,0.,0.,0.,0.,0.,-1.,0.,0.,1.,0.,0.;" } },
	  0.8 * (0.87758256189037271 + 0.41614683654714239), /* cos 0.5 - cos 2 */
	  { 0.54030230586813972, 0.84147098480789651, 0 } },
	/* a share of the angle along a cylinder of half a turn, or ruled of quarters */
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 122, 0, "122,9,1.,0.,2.;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, "100,0.,.5,.5,.75,.5,.75,.5;" },
	    { 100, 0, "100,0.,0.,0.,1.,0.,-1.,0.;" } },
	  M_PI * 0.25 * M_PI * 0.5,
	  { 0, 1, 1 } },
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 118, 1, "118,9,11,0,0;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, "100,0.,.5,.5,.75,.5,.75,.5;" },
	    { 100, 0, "100,0.,0.,0.,1.,0.,0.,1.;" },
	    { 100, 0, "100,3.,0.,0.,1.,0.,0.,1.;" } },
	  M_PI * 0.25 * M_PI / 2 * 0.75,
	  { 0.70710678118654752, 0.70710678118654752, 1.5 } },
	/* ruled by arc length: made to run so, and exact where both sides are hasty alike */
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 118, 0, "118,9,11,0,0;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, "100,0.,.5,.5,.75,.5,.75,.5;" },
	    { 110, 0, "110,0.,0.,0.,2.,0.,0.;" },
	    { 126, 0, HASTY } },
	  M_PI * 0.5 * 0.25,
	  { 1, 0.5, 0 } },
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 118, 0, "118,9,11,0,0;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, "100,0.,.5,.5,.75,.5,.75,.5;" },
	    { 126, 0, HASTY },
	    { 126, 0, HASTY, 13 },
	    { 124, 0, MOVE_UP } },
	  M_PI * 0.5 * 0.25,
	  { 0.5, 1, 0.5 } },
	/* 114: powers of u and v as they stand; 108: lengths, where the standard is silent */
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 114, 0,
	      "114,3,1,1,1,0.,1.,0.,1.,0.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,"
	      "0.,0.,0.,0.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,"
	      "0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, DISK } },
	  DISK_L,
	  { 0.5, 0.5, 0 } },
	{ { { 144, 0, "144,3,1,0,5;" },
	    { 108, 1, "108,0.,0.,1.,0.,9;" },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, DISK },
	    { 106, 63, "106,1,5,0.,0.,0.,1.,0.,1.,1.,0.,1.,0.,0.;" } },
	  DISK_L,
	  { 0.5, 0.5, 0 } },
	/* two regions, and a hole in one of them: loops that nothing tells apart */
	{ { { 143, 0, "143,1,3,3,5,7,9;" },
	    { 128, 0, SQUARE },
	    { 141, 0, "141,1,2,3,1,11,1,1,11;" },
	    { 141, 0, "141,1,2,3,1,13,1,1,13;" },
	    { 141, 0, "141,1,2,3,1,15,1,1,15;" },
	    { 100, 0, "100,0.,.25,.5,.3,.5,.3,.5;" },
	    { 100, 0, "100,0.,.75,.5,.85,.5,.85,.5;" },
	    { 100, 0, "100,0.,.25,.5,.4,.5,.4,.5;" } },
	  M_PI *(0.0225 + 0.01 - 0.0025),
	  { 0.5, 0.5, 0 } },
	/* an island in the hole is left out; a loop named twice is one */
	{ { { 143, 0, "143,1,3,4,5,7,9,7;" },
	    { 128, 0, SQUARE },
	    { 141, 0, "141,1,2,3,1,11,1,1,11;" },
	    { 141, 0, "141,1,2,3,1,13,1,1,13;" },
	    { 141, 0, "141,1,2,3,1,15,1,1,15;" },
	    { 100, 0, "100,0.,.5,.5,.6,.5,.6,.5;" },
	    { 100, 0, DISK },
	    { 100, 0, "100,0.,.5,.5,.8,.5,.8,.5;" } },
	  M_PI *(0.16 - 0.09),
	  { 0.5, 0.5, 0 },
	  "within holes" },
	/* a ring whose outer loop is there twice, by other curves in the same place */
	{ { { 143, 0, "143,1,3,3,5,7,9;" },
	    { 128, 0, SQUARE },
	    { 141, 0, "141,1,2,3,1,11,1,1,11;" },
	    { 141, 0, "141,1,2,3,1,13,1,1,13;" },
	    { 141, 0, "141,1,2,3,1,15,1,1,15;" },
	    { 100, 0, DISK },
	    { 100, 0, "100,0.,.5,.5,.6,.5,.6,.5;" },
	    { 100, 0, DISK } },
	  M_PI * 0.15,
	  { 0.5, 0.5, 0 },
	  "there twice" },
	/* the outer loop stands second, in 510 and in 144 */
	{ { { 510, 0, "510,3,2,1,7,5;" },
	    { 128, 0, SQUARE },
	    { 508, 0, "508,1,0,9,1,1,1,0,11;" },
	    { 508, 0, "508,1,0,9,1,1,1,0,13;" },
	    { 504, 0, "504,0;" },
	    { 100, 0, DISK },
	    { 100, 0, "100,0.,.5,.5,.6,.5,.6,.5;" } },
	  M_PI * 0.15,
	  { 0.5, 0.5, 0 },
	  "lies within another" },
	{ { { 144, 0, "144,3,1,1,5,7;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,9,0,1;" },
	    { 142, 0, "142,0,3,11,0,1;" },
	    { 100, 0, "100,0.,.5,.5,.6,.5,.6,.5;" },
	    { 100, 0, DISK } },
	  M_PI * 0.15,
	  { 0.5, 0.5, 0 },
	  "lies within another" },
	/* the outer loop is an inner one, too */
	{ { { 144, 0, "144,3,1,1,5,5;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,7,0,1;" },
	    { 100, 0, DISK } },
	  DISK_L,
	  { 0.5, 0.5, 0 },
	  "names twice" },
	/* an inner loop outside the outer one */
	{ { { 144, 0, "144,3,1,1,5,7;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,3,9,0,1;" },
	    { 142, 0, "142,0,3,11,0,1;" },
	    { 100, 0, "100,0.,.3,.3,.4,.3,.4,.3;" },
	    { 100, 0, "100,0.,.7,.7,.8,.7,.8,.7;" } },
	  M_PI * 0.01,
	  { 0.5, 0.5, 0 },
	  "cut nothing" },
	/* edges in disorder, some the wrong way round */
	{ { { 143, 0, "143,0,3,1,5;" },
	    { 128, 0, SQUARE },
	    { 141, 0, "141,0,0,3,4,7,1,0,9,1,0,11,1,0,13,2,0;" },
	    { 110, 0, "110,.2,.2,0.,.8,.2,0.;" },
	    { 110, 0, "110,.8,.8,0.,.2,.8,0.;" },
	    { 110, 0, "110,.8,.8,0.,.8,.2,0.;" },
	    { 110, 0, "110,.2,.2,0.,.2,.8,0.;" } },
	  0.36,
	  { 0.5, 0.5, 0 },
	  "put in order" },
	/* no outer loop told on a closed surface: by its sense this one is a hole in all of it */
	{ { { 510, 0, "510,3,1,0,5;" },
	    { 122, 0, "122,11,1.,0.,2.;" },
	    { 508, 0, "508,1,0,7,1,1,1,0,9;" },
	    { 504, 0, "504,0;" },
	    { 106, 63, "106,1,5,0.,.4,.25,.4,.75,.6,.75,.6,.25,.4,.25;" },
	    { 100, 0, "100,0.,0.,0.,1.,0.,1.,0.;" } },
	  4 * M_PI - 0.4 * M_PI,
	  { -1, 0, 1 } },
	/* and here it goes over the seam */
	{ { { 510, 0, "510,3,1,0,5;" },
	    { 122, 0, "122,11,1.,0.,2.;" },
	    { 508, 0, "508,1,0,7,1,1,1,0,9;" },
	    { 504, 0, "504,0;" },
	    { 106, 63, "106,1,5,0.,.9,.25,1.1,.25,1.1,.75,.9,.75,.9,.25;" },
	    { 100, 0, "100,0.,0.,0.,1.,0.,1.,0.;" } },
	  0.4 * M_PI,
	  { -1, 0, 1 },
	  "cut at the seam" },
	/* pointers to the second directory lines */
	{ { { 144, 0, "144,4,1,0,6;" },
	    { 128, 0, SQUARE },
	    { 142, 0, "142,0,4,8,0,1;" },
	    { 100, 0, DISK } },
	  DISK_L,
	  { 0.5, 0.5, 0 },
	  "second directory line" },
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
		if (m->entities[i].kind == ENTITY_SURFACE && m->entities[i].trim.n)
			return &m->entities[i];
	fail_msg("row %zu: no trims: %s", row,
	         m->n_skipped ? m->skipped[0].reason : "nothing skipped");
	return NULL;
}

static void assert_said(const struct model *m, size_t row)
{
	bool said = !faces[row].said;
	for (int i = 0; i < m->n_warnings; i++)
		said |= faces[row].said && strstr(m->warnings[i], faces[row].said);
	if (!said)
		fail_msg("row %zu: '%s' is not said: %s", row, faces[row].said,
		         m->n_warnings ? m->warnings[0] : "nothing is");
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
		assert_int_equal(e->faces->n, 1);
		assert_int_equal(e->faces->de[0], 1);
		assert_point(i,
		             surface_point(&e->geometry, 0.5 * (d[0][0] + d[0][1]),
		                           0.5 * (d[1][0] + d[1][1])),
		             faces[i].p);
		assert_area(i, e, faces[i].area);
		assert_said(&m, i);
		model_finish(&m);
	}
}

static int outer_loops(const struct trim *t)
{
	int n = 0;
	for (int i = 0; i < t->n; i++)
		n += t->loops[i].outer;
	return n;
}

/* The outer loop may come first. */
static void assert_same_trim(const struct trim *a, const struct trim *b)
{
	assert_int_equal(a->n, b->n);
	for (int k = 0; k < a->n; k++) {
		const struct trim_loop *x = &a->loops[k], *y = NULL;
		for (int l = 0; l < b->n; l++)
			if (b->loops[l].outer == x->outer)
				y = &b->loops[l];
		assert_non_null(y);
		assert_int_equal(x->n, y->n);
		for (int c = 0; c < x->n; c++) {
			assert_int_equal(x->curves[c].n, y->curves[c].n);
			for (int p = 0; p < 4 * x->curves[c].n; p++)
				assert_true(fabs(x->curves[c].points[p] - y->curves[c].points[p]) <=
				            1e-12);
		}
	}
}

/* Regions that do not hang together come as several faces. */
static double total_area(const struct model *m)
{
	double sum = 0, area, error;
	for (int i = 0; i < m->n; i++)
		if (m->entities[i].kind == ENTITY_SURFACE && m->entities[i].trim.n) {
			assert_int_equal(trim_area(&m->entities[i].trim, &m->entities[i].geometry,
			                           1e-8, &area, &error),
			                 ST_OK);
			sum += area;
		}
	return sum;
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
		if (outer_loops(&e->trim) < 2)
			assert_same_trim(&again->trim, &e->trim);
		assert_true(fabs(total_area(&b) - faces[i].area) <= 2e-6 * faces[i].area);
		model_finish(&a);
		model_finish(&b);
		text_finish(&t);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(faces_become_trims),
		cmocka_unit_test(trims_are_written_and_read_again),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
