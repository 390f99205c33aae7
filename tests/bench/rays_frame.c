/* rays_frame.c - the view by our own rays. */
#include "rays_frame.h"

#include <math.h>
#include <stdlib.h>

#include "parallel.h"

size_t frame_singles(const struct ray_scene *s, const struct view *v, float *image)
{
	size_t rays = 0;

	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++, rays++) {
			struct ray r = { v->eye, view_direction(v, x, y), 0, INFINITY };
			struct ray_hit h;
			float *pixel = &image[(size_t)y * SIZE + x];

			ray_scene_hit(s, &r, &h);
			*pixel = h.surface >= 0 ? 0.1f : 0;
			if (h.surface < 0)
				continue;
			double slope = vec3_dot(h.normal, v->light);
			if (vec3_dot(h.normal, r.direction) > 0)
				slope = -slope;
			if (slope <= 0)
				continue;
			r = (struct ray){ h.point, v->light, 1e-4 * v->size, INFINITY };
			rays++;
			if (!ray_scene_is_blocked(s, &r))
				*pixel += 0.9f * (float)slope;
		}
	return rays;
}

static enum status frame_tile(void *data, size_t unit, int thread)
{
	struct frame *f = data;
	const struct view *v = f->view;
	int x0 = (int)(unit % (SIZE / TILE)) * TILE, y0 = (int)(unit / (SIZE / TILE)) * TILE;
	enum { N = TILE * TILE };
	struct ray rays[N];
	struct ray_hit hits[N];
	size_t pixel[N], asks[N], n = 0, lit = 0;
	float slope[N];
	bool blocked[N];

	(void)thread;
	for (int by = 0; by < TILE; by += 4)
		for (int bx = 0; bx < TILE; bx += 4)
			for (int i = 0; i < 16; i++, n++) {
				int x = x0 + bx + i % 4, y = y0 + by + i / 4;

				pixel[n] = (size_t)y * SIZE + x;
				rays[n] = (struct ray){ v->eye, view_direction(v, x, y), 0,
					                INFINITY };
			}
	ray_scene_hits(f->scene, rays, N, true, hits);
	for (size_t i = 0; i < N; i++) {
		const struct ray_hit *h = &hits[i];

		f->image[pixel[i]] = h->surface >= 0 ? 0.1f : 0;
		f->depth[pixel[i]] = (float)h->t;
		if (f->hits)
			f->hits[pixel[i]] = *h;
		if (h->surface < 0)
			continue;
		double k = vec3_dot(h->normal, v->light);
		if (vec3_dot(h->normal, rays[i].direction) > 0)
			k = -k;
		if (k <= 0)
			continue;
		slope[lit] = (float)k;
		asks[lit] = pixel[i];
		rays[lit++] = (struct ray){ h->point, v->light, 1e-4 * v->size, INFINITY };
	}
	ray_scene_blocked(f->scene, rays, lit, blocked);
	for (size_t i = 0; i < lit; i++)
		if (!blocked[i])
			f->image[asks[i]] += 0.9f * slope[i];
	f->rays[unit] = N + lit;
	return ST_OK;
}

size_t frame_run(struct frame *f, int threads)
{
	size_t rays = 0;

	if (parallel_run(threads, TILES, NULL, frame_tile, f) != ST_OK)
		abort();
	for (size_t i = 0; i < TILES; i++)
		rays += f->rays[i];
	return rays;
}
