/* ray_packet.h - a packet of rays on its way through the tree. Private. */
#ifndef BATTEN_RAY_PACKET_H
#define BATTEN_RAY_PACKET_H

#include "ray_kernel.h"
#include "ray_lanes.h"

struct ray_call {
	const struct ray_scene *scene;
	bool nearest; /* else any hit will do */
};

/* The nearest hit of one ray so far, in scene units. */
struct ray_found {
	int64_t claim;             /* the leaf's, see ray_finish.h; -1: none */
	double t, a, b;            /* a, b: parameters in the patch [0, 1] */
	struct vec3 point, normal; /* normal: Su x Sv, not of unit length */
	double area;               /* |Su|^2 |Sv|^2, a little more */
};

/*
 * Everything in scene units. A ray is the line where two planes meet: n1 . x = k1, n2 . x = k2.
 * Doubles come as two halves. Results are those of the nearest hit so far.
 */
struct packet {
	struct ray_call call;
	vf d[3], n1[3], n2[3], k1, k2, kd; /* kd: d . origin */
	vf near, far;                      /* a little wider than the true ones */
	vd dd[3][2], nd1[3][2], nd2[3][2], kd1[2], kd2[2], kdd[2];
	vd neard[2], fard[2];         /* far: comes nearer with each hit */
	vl claim[2];                  /* of the leaf, see ray_finish.h; -1: none */
	vd a[2][2];                   /* parameters in the patch [0, 1]: u, v */
	vd point[3][2], normal[3][2]; /* normal: Su x Sv, not of unit length */
	vd area[2];                   /* |Su|^2 |Sv|^2, a little more */
};

#endif
