/* rays_pov.h - the same view by POV-Ray, from a scene written here. */
#ifndef BATTEN_BENCH_RAYS_POV_H
#define BATTEN_BENCH_RAYS_POV_H

#include "surface.h"

/* What POV-Ray is told to see: size x size pixels, one parallel light with shadows. */
struct pov_view {
	struct vec3 eye, ahead, right, up, light; /* right and up: as long as the picture is wide */
	int size;
};

/* CPU seconds of program `pov` for bicubic polynomial surfaces, each span 32 x 32 in triangles that
 * it makes once; below 0 where it fails or a surface is of another kind. */
double pov_seconds(const char *pov, const struct surface *const *surfaces, int n,
                   const struct pov_view *v);

#endif
