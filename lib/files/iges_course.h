/* iges_course.h - how a parameter of the file runs over ours. Private to this folder.
 *
 * The standard measures arcs by their angle, composites by the parameters of their parts, and ruled
 * surfaces of form 0 by relative arc length. A NURBS curve of the same shape runs otherwise.
 */
#ifndef BATTEN_IGES_COURSE_H
#define BATTEN_IGES_COURSE_H

#include "iges_reader.h"

/* Linear, or an arc as the rational quadratic of that half angle. */
struct iges_stretch {
	double file[2], own[2];
	double half; /* 0: linear */
};

/* A rising map of parameters. A zeroed one is that of equal parameters. */
struct iges_course {
	struct iges_stretch *stretches; /* owned, one after the other */
	int n, room;
	struct curve even;   /* order > 0: by arc length of this curve instead, owned; 0 to 1 */
	double *at, *length; /* owned, n_at: its parameters, lengths up to them */
	int n_at;
};

void iges_course_finish(struct iges_course *c);

/* Are all parameters equal, or those of two courses, within rounding? */
bool iges_course_same(const struct iges_course *a, const struct iges_course *b);
bool iges_course_equal(const struct iges_course *c);

/* Our parameter, and its derivative, at one of the file. Beyond its ends a course begins anew. */
double iges_course_own(const struct iges_course *c, double t, double *rate);

/* The other way, for what lies between its ends. */
double iges_course_file(const struct iges_course *c, double own);

/* That of curve `de`, as iges_curve makes it. Errors: ST_INPUT, ST_RESOURCE, ST_CANCELLED. */
enum status iges_course_curve(struct iges *g, int de, struct iges_course *out);

/* Added: an angle with the knots of n points of order 3. Errors: ST_RESOURCE. */
enum status iges_course_angle(const double *knots, int n, struct iges_course *out);

/* Relative arc length of c, which runs from 0 to 1. Errors: ST_RESOURCE, ST_INPUT (no length). */
enum status iges_course_even(const struct curve *c, struct iges_course *out);

/* Both parameters from 0 to 1; and turned about as well. */
void iges_course_unit(struct iges_course *c, bool turned);

/*
 * Run the curve, from 0 to 1 both, at the file's pace: cubics within `tolerance`; *error is what was
 * reached. Errors: ST_RESOURCE.
 */
enum status iges_course_apply(const struct iges_course *c, const struct curve *from,
                              double tolerance, struct curve *out, double *error);

/* The courses of u and v on surface `de`, as iges_surface makes it; *known: the standard gives it
 * parameters. Errors: ST_INPUT, ST_RESOURCE, ST_CANCELLED; out[] need not be finished then. */
enum status iges_surface_courses(struct iges *g, int de, struct iges_course out[2], bool *known);

/* iges_ruled.c: that of u of a 118; `c` stands behind the type number. Errors: likewise. */
enum status iges_ruled_course(struct iges_cursor *c, struct iges_course *u);

/*
 * A curve in the file's u, v brought into ours: lines of one parameter stay lines, others become
 * cubics within `tolerance` in space. Errors: ST_RESOURCE.
 */
enum status iges_course_bring(const struct iges_course course[2], const struct surface *s,
                              double tolerance, struct curve *c);

#endif
