/* worker_image.c - images made of units: a header before those that lie in order, or copies of them. */
#include <stdlib.h>

#include "worker_image.h"
#include "worker_private.h"

/* Bytes behind a chunk and before it in the part file, at most. */
enum { BESIDE_CHUNK = 1024 };

void work_units_are_tiles(struct work *w, const struct exr_image *image)
{
	double pixel = 0;
	for (int c = 0; c < image->n_channels; c++)
		pixel += image->channels[c].half ? 2 : 4;
	w->private->in_place = true;
	w->private->bytes_max =
	        pixel * image->width * image->height + BESIDE_CHUNK * (double)exr_tiles(image);
}

struct copying {
	struct work *work;
	const struct exr_image *image;
	size_t first;
	struct text chunk; /* owned; the last one read */
};

static enum status give_chunk(void *data, size_t i, const char **bytes, size_t *n)
{
	struct copying *c = data;
	work_phase(c->work, "writing", i, exr_tiles(c->image));
	enum status st = work_read(c->work, c->first + i, &c->chunk);
	*bytes = c->chunk.s;
	*n = c->chunk.n;
	return st;
}

static enum status copy(void *data, const char *path, const struct report *r)
{
	struct copying *c = data;
	return exr_write(path, c->image, give_chunk, c, r);
}

/* What the part file needs to be the image. *fits: there is room for it. */
static enum status make_front(const struct work *w, const struct exr_image *image, struct text *out,
                              bool *fits)
{
	const struct part *part = w->private->part;
	size_t n = exr_tiles(image), n_first;
	const char *first = part_front_attribute(part, &n_first);
	uint64_t *places = malloc(n * sizeof *places);
	if (!places)
		return ST_RESOURCE;
	for (size_t i = 0; i < n; i++)
		places[i] = part_place(part, i);
	enum status st = exr_front(image, first, n_first, places, out);
	free(places);
	*fits = out->n <= part_front(part);
	return st;
}

/* *done: the part file is the image now. It depends on the work alone whether it can be. */
static enum status become(struct work *w, const char *extension, const struct exr_image *image,
                          bool *done)
{
	struct work_private *p = w->private;
	struct text front = { 0 };
	*done = false;
	if (!p->in_place || part_front(p->part) == 0)
		return ST_OK;
	enum status st = make_front(w, image, &front, done);
	if (st == ST_OK && *done) {
		st = part_write_front(p->part, front.s, front.n, &w->report);
		if (st == ST_OK)
			st = outputs_add_part(w, extension);
	}
	text_finish(&front);
	return st;
}

enum status work_image(struct work *w, const char *extension, const struct exr_image *image,
                       size_t first)
{
	struct exr_image whole = *image;
	const struct work_attribute *a = work_attributes(w, &whole.n_attributes);
	struct exr_attribute *list = calloc((size_t)whole.n_attributes + 1, sizeof *list);
	bool done = false;
	if (!list)
		return ST_RESOURCE;
	for (int i = 0; i < whole.n_attributes; i++)
		list[i] = (struct exr_attribute){ a[i].name, a[i].value };
	whole.attributes = list;
	enum status st = become(w, extension, &whole, &done);
	if (st == ST_OK && !done) {
		struct copying c = { .work = w, .image = &whole, .first = first };
		st = work_output(w, extension, copy, &c);
		text_finish(&c.chunk);
	}
	free(list);
	return st;
}
