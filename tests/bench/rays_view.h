/* rays_view.h - what the benchmark of rays looks at, and from where: one view, a ray a pixel and a
 * shadow ray for each lit hit. */
#ifndef BATTEN_BENCH_RAYS_VIEW_H
#define BATTEN_BENCH_RAYS_VIEW_H

#include "box.h"
#include "surface.h"

enum { SIZE = 1024, SURFACES_MAX = 64 };

struct scene {
	const char *name;
	const struct surface *surfaces[SURFACES_MAX]; /* borrowed */
	int n;
	double goal; /* part of the speed of triangles 32x32; 0: none */
};

struct view {
	struct vec3 eye, ahead, right, up, light;
	double size;
};

struct view view_fit(const struct box *box);

/* Of the ray through the middle of a pixel. */
struct vec3 view_direction(const struct view *v, int x, int y);

#endif
