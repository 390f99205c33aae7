/* live.c - results, whole or as far as their job has come. */
#include "live.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "curvature.h"
#include "part.h"

enum { TILE = 64, SIDE_MAX = 65536, IMAGE_CHANNELS = 4 };

/* What the workers pack into a unit, and the parameter that has the size. */
#define X(name, channel, json, code, title, is_signed, power) { channel, false },
static const struct exr_channel map_channels[N_QUANTITIES] = { QUANTITY_MAP(X) };
#undef X
static const struct exr_channel scene_channels[] = {
	{ "R", true },    { "G", true },    { "B", true },    { "A", true },
	{ "Z", false },   { "N.X", false }, { "N.Y", false }, { "N.Z", false },
	{ "P.X", false }, { "P.Y", false }, { "P.Z", false },
};
static const struct producer {
	const char *worker, *size;
	const struct exr_channel *channels;
	int n_channels, shown; /* shown: the first so many are of use here */
} producers[] = {
	{ "curvature", "param.grid", map_channels, N_QUANTITIES, N_QUANTITIES },
	{ "raytrace", "param.size", scene_channels, 11, IMAGE_CHANNELS },
	{ "shading", "param.size", scene_channels, 11, IMAGE_CHANNELS },
};

/* The value of a line NAME=VALUE of a part file's key; false: there is none. */
static bool key_value(const struct part_glance *g, const char *name, char *out, size_t size)
{
	const size_t length = strlen(name);
	const char *at = g->key, *end = g->key + g->key_length;
	while (at < end) {
		const char *line = memchr(at, '\n', (size_t)(end - at));
		const size_t n = (size_t)((line ? line : end) - at);
		if (n > length && !memcmp(at, name, length) && at[length] == '=' &&
		    n - length <= size) {
			memcpy(out, at + length + 1, n - length - 1);
			out[n - length - 1] = 0;
			return true;
		}
		at += n + 1;
	}
	return false;
}

static const struct producer *find_producer(const struct part_glance *g, int *width, int *height)
{
	char worker[64], size[64], rest;
	if (!key_value(g, "worker", worker, sizeof worker))
		return NULL;
	for (size_t i = 0; i < sizeof producers / sizeof *producers; i++)
		if (!strcmp(worker, producers[i].worker) &&
		    key_value(g, producers[i].size, size, sizeof size) &&
		    sscanf(size, "%dx%d%c", width, height, &rest) == 2 && *width > 0 &&
		    *height > 0 && *width <= SIDE_MAX && *height <= SIDE_MAX)
			return &producers[i];
	return NULL;
}

/* Planes full of NaN, named as the file would have them. */
static enum status begin(struct exr_picture *out, const struct producer *from, int width,
                         int height)
{
	const size_t n = (size_t)width * height;
	*out = (struct exr_picture){ .width = width, .height = height };
	out->names = calloc((size_t)from->shown, sizeof *out->names);
	out->planes = calloc((size_t)from->shown, sizeof *out->planes);
	if (!out->names || !out->planes)
		return ST_RESOURCE;
	for (int c = 0; c < from->shown; c++) {
		out->n_channels = c + 1;
		out->names[c] = strdup(from->channels[c].name);
		out->planes[c] = malloc(n * sizeof **out->planes);
		if (!out->names[c] || !out->planes[c])
			return ST_RESOURCE;
		for (size_t i = 0; i < n; i++)
			out->planes[c][i] = NAN;
	}
	return ST_OK;
}

static enum status take_tile(struct exr_picture *out, const struct exr_image *im,
                             const struct part_found *unit)
{
	int x, y, w, h;
	float *room = malloc((size_t)im->n_channels * TILE * TILE * sizeof *room);
	float *planes[EXR_CHANNELS_MAX];
	if (!room)
		return ST_RESOURCE;
	exr_tile_window(im, unit->unit, &x, &y, &w, &h);
	for (int c = 0; c < im->n_channels; c++)
		planes[c] = room + (size_t)c * TILE * TILE;
	enum status st = exr_unpack(im, unit->unit, unit->bytes, unit->n, planes);
	for (int c = 0; c < out->n_channels && st == ST_OK; c++)
		for (int row = 0; row < h; row++)
			memcpy(out->planes[c] + (size_t)(y + row) * im->width + x,
			       planes[c] + (size_t)row * w, (size_t)w * sizeof **planes);
	free(room);
	return st == ST_RESOURCE ? st : ST_OK; /* a tile that is none counts as not come */
}

static enum status take_part(struct exr_picture *out, const struct part_glance *g)
{
	int width, height;
	const struct producer *from = find_producer(g, &width, &height);
	if (!from)
		return ST_INPUT;
	const struct exr_image im = { .width = width,
		                      .height = height,
		                      .tile = TILE,
		                      .channels = from->channels,
		                      .n_channels = from->n_channels };
	enum status st = begin(out, from, width, height);
	/* behind the tiles of a map come those of its view */
	for (size_t i = 0; i < g->n && st == ST_OK; i++)
		if (g->found[i].unit < exr_tiles(&im))
			st = take_tile(out, &im, &g->found[i]);
	if (st != ST_OK)
		exr_picture_finish(out);
	return st;
}

enum status live_read(struct exr_picture *out, const char *path)
{
	struct part_glance g;
	if (exr_read(out, path, &report_none) == ST_OK)
		return ST_OK;
	enum status st = part_look(&g, path, &report_none);
	if (st != ST_OK)
		return st;
	st = take_part(out, &g);
	part_glance_finish(&g);
	return st;
}

enum status live_lines(const char *path, level_take *take, void *data)
{
	struct part_glance g;
	enum status st = part_look(&g, path, &report_none);
	if (st != ST_OK)
		return st;
	for (size_t i = 0; i < g.n && st == ST_OK; i++)
		st = level_look(g.found[i].bytes, g.found[i].n, take, data);
	part_glance_finish(&g);
	return st;
}
