/* iges_made.h - made files read, and what tests of several ideas are about. Behind cmocka.h. */
#ifndef BATTEN_TEST_IGES_MADE_H
#define BATTEN_TEST_IGES_MADE_H

#include <stdlib.h>
#include <string.h>

#include "iges.h"
#include "iges_maker.h"

/* tables of entities that mostly end after the parameters */
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

enum { MADE_MAX = 8 };

static inline enum status read_made(struct model *m, const struct made_file *f,
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

static inline void assert_point(size_t row, struct vec3 found, struct vec3 expected)
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
#define MOVE "124,1.,0.,0.,10.,0.,1.,0.,20.,0.,0.,1.,30.;"
#define TURN "124,0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.;" /* x to y */
/* A straight curve whose speed grows: the point at t is (2 t^2, 1, 0). */
#define HASTY   "126,2,2,0,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,1.,0.,0.,1.,0.,2.,1.,0.,0.,1.;"
#define MOVE_UP "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,1.;"
#define MIRROR  "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,-1.,0.;"

/* A loop in space or in u,v. */
#define DISK   "100,0.,.5,.5,.9,.5,.9,.5;" /* of radius 0.4 */
#define DISK_L M_PI * 0.16

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

static inline void assert_standard(const struct model *m, const char *what)
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

#endif
