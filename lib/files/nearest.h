/* nearest.h - nearest points on a surface. Private to this folder. */
#ifndef BATTEN_NEAREST_H
#define BATTEN_NEAREST_H

#include "curve.h"
#include "surface.h"

struct projector {
	const struct surface *s; /* borrowed */
	double size, period[2];
	bool flat;              /* a parallelogram, linear in u and v */
	double down[3][4];      /* of a flat one: space to u, v, distance */
	double up[3][4];        /* u, v to space */
	int n[2];               /* grid, made when first needed */
	double *at[2];          /* owned, its parameters */
	struct vec3 *points;    /* owned, n[0] x n[1] */
	const struct curve *c;  /* being followed */
	double near;            /* distance within which its points are expected */
	double reach, farthest; /* beyond which it is given up; the largest found */
	bool failed;            /* no memory */
};

/* Set flat, down and up where the surface is a parallelogram; s and size are set already. */
void projector_find_flat(struct projector *p);

/* The point at u, v, which may lie some turns off on a closed surface. */
struct vec3 projector_point(const struct projector *p, struct vec3 uv);

/* The nearest point of all that a grid leads to, the search over once one is as near as `enough`;
 * gives its distance. Sets p->failed where there is no memory. */
double projector_search(struct projector *p, struct vec3 x, double enough, struct vec3 *uv);

/* The nearest point to x, near `guess` if there is one as good; gives its distance. */
double projector_nearest(struct projector *p, struct vec3 x, struct vec3 guess, struct vec3 *uv);

/* How the foot of x, at uv, moves where x moves by d. */
struct vec3 projector_bring_down(const struct projector *p, struct vec3 uv, struct vec3 x,
                                 struct vec3 d);

/* At a pole a parameter is free: 0 or 1; -1 where there is none. */
int projector_free_parameter(const struct projector *p, struct vec3 uv);

#endif
