/* image.c - scene, camera, samples and tiles of the workers that look at surfaces. */
#include "image.h"

#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "picture.h"
#include "worker_image.h"

enum { PICTURE_SIDE = 32767 }; /* Cairo's limit */

/* The scene, of what the trims leave if they count. */
static enum status make_scene(struct image *im, struct work *w)
{
	const struct trim **trims = calloc(w->n_surfaces, sizeof *trims);

	if (!trims)
		return ST_RESOURCE;
	for (int i = 0; work_flag(w, "trimmed") && i < w->n_surfaces; i++)
		trims[i] = &w->entities[i]->trim;
	enum status st = ray_scene_create_trimmed(&im->scene, w->surfaces, trims, w->n_surfaces,
	                                          w->memory, &w->report);
	free((void *)trims);
	return st;
}

enum status image_init(struct image *im, struct work *w, const char *view, int width, int height,
                       int samples, const struct exr_channel *channels, int n_channels)
{
	memset(im, 0, sizeof *im);
	if (work_flag(w, "png") && (width > PICTURE_SIDE || height > PICTURE_SIDE))
		return report_error(&w->report, ST_PARAMETER,
		                    "--size %dx%d is larger than a picture can be, expected %d at "
		                    "most; make it smaller or leave --png out",
		                    width, height, PICTURE_SIDE);
	work_phase(w, "preparing", 0, 1);
	enum status st = make_scene(im, w);
	if (st != ST_OK)
		return st;

	st = camera_fit_surfaces(&im->camera, view, w->surfaces, w->n_surfaces, width, height,
	                         &w->report);
	if (st != ST_OK) {
		image_finish(im);
		return st;
	}
	memcpy(im->channels, channels, n_channels * sizeof *channels);
	im->exr = (struct exr_image){
		.width = width,
		.height = height,
		.tile = IMAGE_TILE,
		.channels = im->channels,
		.n_channels = n_channels,
	};
	im->samples = samples;
	im->center = samples / 2 * samples + samples / 2;
	work_phase(w, "preparing", 1, 1);
	return ST_OK;
}

void image_finish(struct image *im)
{
	ray_scene_destroy(im->scene);
	im->scene = NULL;
}

/* Pixels in blocks of 4 x 4, so that a packet's rays go close together. */
static void tile_order(struct image_tile *t)
{
	enum { BLOCK = 4 };
	size_t n = 0;

	for (int by = 0; by < t->height; by += BLOCK)
		for (int bx = 0; bx < t->width; bx += BLOCK)
			for (int y = by; y < by + BLOCK && y < t->height; y++)
				for (int x = bx; x < bx + BLOCK && x < t->width; x++)
					t->pixel[n++] = (uint32_t)(y * t->width + x);
}

enum status image_tile_init(struct image_tile *t, const struct image *im, size_t unit)
{
	memset(t, 0, sizeof *t);
	t->image = im;
	t->unit = unit;
	t->stats = (struct image_stats){ .near = INFINITY, .far = -INFINITY };
	exr_tile_window(&im->exr, unit, &t->x, &t->y, &t->width, &t->height);
	t->n = (size_t)t->width * t->height;
	t->pixel = malloc(t->n * sizeof *t->pixel);
	t->rays = malloc(t->n * sizeof *t->rays);
	t->hits = malloc(t->n * sizeof *t->hits);
	float *planes = calloc(t->n * im->exr.n_channels, sizeof *planes);
	t->planes[0] = planes;
	if (!t->pixel || !t->rays || !t->hits || !planes) {
		image_tile_finish(t);
		return ST_RESOURCE;
	}
	for (int c = 1; c < im->exr.n_channels; c++)
		t->planes[c] = planes + c * t->n;
	tile_order(t);
	return ST_OK;
}

void image_tile_finish(struct image_tile *t)
{
	free(t->pixel);
	free(t->rays);
	free(t->hits);
	free(t->planes[0]);
	memset(t, 0, sizeof *t);
}

double image_depth(const struct image *im, struct vec3 p)
{
	return vec3_dot(vec3_sub(p, im->camera.eye), im->camera.ahead);
}

void image_tile_shoot(struct image_tile *t, int sample)
{
	const struct image *im = t->image;
	double fx = (sample % im->samples + 0.5) / im->samples;
	double fy = (sample / im->samples + 0.5) / im->samples;

	for (size_t i = 0; i < t->n; i++) {
		int x = t->x + (int)(t->pixel[i] % t->width);
		int y = t->y + (int)(t->pixel[i] / t->width);
		struct ray *r = &t->rays[i];

		camera_ray(&im->camera, x + fx, y + fy, &r->origin, &r->direction);
		r->near = 0;
		r->far = INFINITY;
	}
	ray_scene_hits(im->scene, t->rays, t->n, true, t->hits);
	t->stats.rays += t->n;
	if (sample != im->center)
		return;
	for (size_t i = 0; i < t->n; i++)
		if (t->hits[i].surface >= 0) {
			double depth = image_depth(im, t->hits[i].point);

			t->stats.pixels++;
			t->stats.near = fmin(t->stats.near, depth);
			t->stats.far = fmax(t->stats.far, depth);
		}
}

enum status image_tile_put(const struct image_tile *t, struct work *w)
{
	struct text bytes = { 0 };
	enum status st = exr_pack(&t->image->exr, t->unit, (const float *const *)t->planes, &bytes);

	if (st == ST_OK) {
		text_add_bytes(&bytes, &t->stats, sizeof t->stats);
		st = bytes.failed ? ST_RESOURCE : work_put(w, t->unit, bytes.s, bytes.n);
	}
	text_finish(&bytes);
	return st;
}

enum status image_gather(const struct image *im, struct work *w, json_t **figures)
{
	struct image_stats all = { .near = INFINITY, .far = -INFINITY };

	for (size_t i = 0; i < image_units(im); i++) {
		struct image_stats s;
		enum status st = work_read_end(w, i, &s, sizeof s);

		if (st != ST_OK)
			return st;
		all.pixels += s.pixels;
		all.rays += s.rays;
		all.near = fmin(all.near, s.near);
		all.far = fmax(all.far, s.far);
	}
	*figures = json_object();
	if (!*figures)
		return ST_RESOURCE;
	int trimmed = 0;
	for (int i = 0; i < w->n_surfaces; i++)
		trimmed += ray_scene_trim(im->scene, i) != NULL;
	json_set_int(*figures, "surfaces", w->n_surfaces);
	json_set_int(*figures, "trimmed", trimmed);
	json_set_int(*figures, "leaves", (int64_t)ray_scene_leaves(im->scene));
	json_set_int(*figures, "width", im->exr.width);
	json_set_int(*figures, "height", im->exr.height);
	json_set_int(*figures, "pixels", (int64_t)all.pixels);
	json_set_int(*figures, "rays", (int64_t)all.rays);
	json_set_number(*figures, "depth_min", all.near);
	json_set_number(*figures, "depth_max", all.far);
	return ST_OK;
}

static enum status write_picture(void *data, const char *path, const struct report *r)
{
	const struct exr_picture *p = data;
	const float *rgba[4] = { exr_plane(p, "R"), exr_plane(p, "G"), exr_plane(p, "B"),
		                 exr_plane(p, "A") };

	return picture_image(path, p->width, p->height, rgba, THEME_LIGHT, r);
}

enum status image_output(const struct image *im, struct work *w, const char *extension,
                         const char *png, json_t *figures)
{
	struct exr_picture picture = { 0 };
	enum status st = work_figures(w, figures);

	if (st == ST_OK)
		st = work_image(w, extension, &im->exr, 0);
	if (st == ST_OK && png)
		st = exr_read(&picture, work_made(w, extension), &w->report);
	if (st == ST_OK && png)
		st = work_output(w, png, write_picture, &picture);
	exr_picture_finish(&picture);
	return st;
}
