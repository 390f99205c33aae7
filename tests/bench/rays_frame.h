/* rays_frame.h - the view by our own rays. */
#ifndef BATTEN_BENCH_RAYS_FRAME_H
#define BATTEN_BENCH_RAYS_FRAME_H

#include "ray_scene.h"
#include "rays_view.h"

enum { TILE = 32, TILES = (SIZE / TILE) * (SIZE / TILE) };

struct frame {
	const struct ray_scene *scene;
	const struct view *view;
	float *image, *depth;
	struct ray_hit *hits; /* of all pixels, or NULL */
	size_t rays[TILES];
};

/* In packets, tiles by so many threads, or a ray a call; how many rays. */
size_t frame_run(struct frame *f, int threads);
size_t frame_singles(const struct ray_scene *s, const struct view *v, float *image);

#endif
