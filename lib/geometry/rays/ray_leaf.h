/* ray_leaf.h - what the surfaces of a scene are cut into. Private to the rays library.
 *
 * All lengths here are in scene units: the scene's centre is the origin, its half diagonal 1.
 */
#ifndef BATTEN_RAY_LEAF_H
#define BATTEN_RAY_LEAF_H

#include <stddef.h>
#include <stdint.h>

#include "bezier.h"
#include "box.h"
#include "trim.h"

/* One Bezier patch, exact: the double-precision finish runs on it. */
struct ray_patch {
	const double
	        *points; /* into ray_cut.points: order[0] x order[1] x 4, homogeneous, u outer */
	int order[2];
	int surface;
	bool rational;
	double u[2], v[2]; /* range of parameters: from, to */
};

/* Where loops of the surface's trim run. */
enum ray_trim {
	TRIM_NONE,   /* the surface has no trim */
	TRIM_INSIDE, /* not in the leaf, nor just beside it */
	TRIM_THROUGH,
};

/*
 * A part of a patch that bends little. Coefficient a[c][4 i + j] belongs to s^i t^j with s, t in
 * [-1, 1]; components x, y, z, w, where x, y, z are taken relative to w times the centre, so that
 * single precision does. Weights are divided by the one in the middle.
 */
struct ray_leaf {
	float a[4][16];
	float center[3];
	float reach;          /* bound on |point - center| */
	float rest;           /* sum of |a_ij| for i + j >= 2, and of error */
	float rest_s, rest_t; /* of i |a_ij|, of j |a_ij|, for the same: what slopes differ by */
	float bend;           /* of |a_ij| by the largest of i (i - 1), i j, j (j - 1) */
	float rest_w;         /* sum of the weights' |a_ij| for i + j >= 2 */
	float error;          /* bound on the distance of the coefficients from the true surface */
	float from[2],
	        step[2]; /* parameters in the patch [0,1]: from + step * (s + 1) / 2; exact */
	uint32_t patch;
	uint16_t rational;
	uint16_t trim; /* enum ray_trim */
} __attribute__((aligned(64)));

struct ray_bounds {
	float lo[3], hi[3];
};

struct ray_cut {
	struct ray_patch *patches; /* owned */
	size_t n_patches;
	double **points;          /* owned, and each of them; one a surface */
	struct trim_test **trims; /* owned, and each of them; NULL: no trim */
	int n_surfaces;
	struct ray_leaf *leaves;   /* owned, aligned to 64 bytes */
	struct ray_bounds *bounds; /* owned; boxes of the leaves, needed while the tree is built */
	size_t n_leaves, capacity;
	struct vec3 center; /* of the scene, in the file's unit */
	double scale;       /* half diagonal of the scene, in the file's unit */
	struct box box;
	size_t bytes, memory; /* taken; allowed, 0 for no limit */
};

/* Loops this near to a leaf, in leaves, count as in it: what a ray finds on a leaf may lie beside it
 * by a little. */
#define TRIM_BESIDE 1e-3

/* What single precision may be off by near the scene, in scene units. */
#define RAY_NOISE 4e-7f

/*
 * Cut the surfaces into patches and leaves.
 * Errors: ST_RESOURCE (no memory, more than `memory` bytes), ST_INPUT (nothing to see).
 */
enum status ray_cut_init(struct ray_cut *c, const struct surface *const *surfaces,
                         const struct trim *const *trims, int n, size_t memory,
                         const struct report *r);
void ray_cut_finish(struct ray_cut *c);

/* Cut one patch: append its leaves, but for those that are trimmed away. Errors: ST_RESOURCE. */
enum status ray_cut_patch(struct ray_cut *c, uint32_t patch);

#endif
