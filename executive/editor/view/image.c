/* image.c - an image result in place of the things, fitted into the view. */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "live.h"
#include "view_private.h"

void images_finish(struct view *v)
{
	for (int i = 0; i < v->n_images; i++) {
		plate_finish(&v->images[i].plate);
		free(v->images[i].file);
	}
	free(v->images);
	v->images = NULL;
	v->n_images = 0;
}

static struct image *find(struct view *v, const char *file)
{
	for (int i = 0; i < v->n_images; i++)
		if (!strcmp(v->images[i].file, file))
			return &v->images[i];
	struct image *all = reallocarray(v->images, (size_t)v->n_images + 1, sizeof *all);
	if (!all)
		return NULL;
	v->images = all;
	all[v->n_images] = (struct image){ .file = strdup(file) };
	return all[v->n_images].file ? &all[v->n_images++] : NULL;
}

static unsigned byte_of(double linear)
{
	if (!(linear > 0))
		return 0;
	return linear < 1 ? (unsigned)lrint(255 * rgb_from_linear(linear)) : 255;
}

/* Colors in linear light, multiplied by alpha, over the ground; what has not arrived is ground. */
static void paint(cairo_surface_t *surface, const struct exr_picture *p, struct rgb ground)
{
	const float *rgba[4] = { exr_plane(p, "R"), exr_plane(p, "G"), exr_plane(p, "B"),
		                 exr_plane(p, "A") };
	const double behind[3] = { rgb_to_linear(ground.r), rgb_to_linear(ground.g),
		                   rgb_to_linear(ground.b) };
	unsigned char *bytes = cairo_image_surface_get_data(surface);
	const int stride = cairo_image_surface_get_stride(surface);
	for (int y = 0; y < p->height; y++) {
		unsigned *row = (unsigned *)(void *)(bytes + (size_t)y * stride);
		for (int x = 0; x < p->width; x++) {
			const size_t i = (size_t)y * p->width + x;
			const double alpha = rgba[3] ? rgba[3][i] : 1;
			const double through = isnan(alpha) ? 1 : fmin(fmax(1 - alpha, 0), 1);
			row[x] = 255U << 24;
			for (int c = 0; c < 3; c++) {
				double own = isnan(alpha) ? 0 : rgba[c][i];
				row[x] |= byte_of(own + through * behind[c]) << (16 - 8 * c);
			}
		}
	}
	cairo_surface_mark_dirty(surface);
}

static void update(struct image *im, struct rgb ground)
{
	int64_t stamp[3] = { 0 };
	struct exr_picture p;
	file_stamp(im->file, stamp);
	if (!memcmp(stamp, im->stamp, sizeof stamp))
		return;
	memcpy(im->stamp, stamp, sizeof stamp);
	plate_finish(&im->plate);
	if (live_read(&p, im->file) != ST_OK)
		return;
	cairo_surface_t *surface =
	        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, p.width, p.height);
	if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS && exr_plane(&p, "R") &&
	    exr_plane(&p, "G") && exr_plane(&p, "B")) {
		paint(surface, &p, ground);
		plate_load(&im->plate, surface);
	}
	cairo_surface_destroy(surface);
	exr_picture_finish(&p);
}

bool images_draw(struct drawing *d)
{
	if (world_sight((struct world *)d->world)->no_image)
		return false;
	for (int k = 0; k < world_overlays(d->world); k++) {
		const struct overlay *o = world_overlay(d->world, k);
		if (o->kind != OVERLAY_IMAGE || !o->file)
			continue;
		struct image *im = find(d->view, o->file);
		if (!im)
			continue;
		update(im, d->ground);
		if (!im->plate.texture)
			continue;
		/* as large as fits, but no larger than its own pixels twice */
		double s = fmin((double)d->camera.width / im->plate.width,
		                (double)d->camera.height / im->plate.height);
		s = fmin(s, 2 * d->frame.scale);
		double w = round(s * im->plate.width), h = round(s * im->plate.height);
		plate_draw(d, &im->plate, round((d->camera.width - w) / 2),
		           round((d->camera.height - h) / 2), w, h);
		return true;
	}
	return false;
}
