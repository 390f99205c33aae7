/* poly.h - polylines in space, many in one list: curves made into chords. Private to this folder. */
#ifndef BATTEN_VIEW_POLY_H
#define BATTEN_VIEW_POLY_H

#include <stdbool.h>

#include "curve.h"
#include "surface.h"
#include "trim.h"

/* A vertex, from the thing's origin. part < 0: it only keeps polylines apart; else the parameter's
 * place in its polyline's list of parameters. */
struct poly_vertex {
	float x, y, z, part;
};

/* Every polyline stands between two vertices that keep it apart, copies of its ends. */
struct poly {
	struct poly_vertex *v; /* owned */
	double *t;             /* owned, one a vertex: the curve's parameter */
	int n, room;
	struct vec3 origin;
	bool open;   /* a polyline has begun */
	bool failed; /* memory ran out: test once at the end */
};

void poly_finish(struct poly *p); /* a zeroed one is fine */
void poly_reset(struct poly *p, struct vec3 origin);

/* Points of a polyline one by one; poly_end ends it (nothing begun: nothing). */
void poly_add(struct poly *p, struct vec3 at, double t);
void poly_end(struct poly *p);
static inline struct vec3 poly_at(const struct poly *p, int i)
{
	return vec3(p->origin.x + p->v[i].x, p->origin.y + p->v[i].y, p->origin.z + p->v[i].z);
}

/* A line to be cut into chords, and which part of it counts. */
struct poly_line {
	struct vec3 (*point)(const void *data, double t);
	bool (*inside)(const void *data, double t); /* NULL: all of it */
	const void *data;
	const double *breaks; /* rising; smooth between */
	int n_breaks;
	int segments; /* chords of the same parameter length; 0: by tolerance */
	double tolerance;
};
void poly_add_line(struct poly *p, const struct poly_line *line);

/* The polylines of p with fewer points, none of those left out farther than tolerance. */
void poly_thin(struct poly *out, const struct poly *p, double tolerance);

/* A curve's breaks: fresh, n of them; NULL for want of memory. */
double *poly_breaks(const struct curve *c, int *n);

/* A curve in space. */
void poly_add_curve(struct poly *p, const struct curve *c, int segments, double tolerance);
/* A curve in u, v of a surface. */
void poly_add_curve_on(struct poly *p, const struct curve *uv, const struct surface *s,
                       int segments, double tolerance);
/* Isoparametric line d = t of what the trim leaves; trim NULL: all. */
void poly_add_isoparametric(struct poly *p, const struct surface *s, const struct trim_test *trim,
                            int d, double t, int segments, double tolerance);

#endif
