/* color_image.c - what shading and ray trace put into an image beside its colors. */
#include "color_image.h"

const struct exr_channel color_channels[N_COLOR_CHANNELS] = {
	{ "R", true },    { "G", true },    { "B", true },    { "A", true },
	{ "Z", false },   { "N.X", false }, { "N.Y", false }, { "N.Z", false },
	{ "P.X", false }, { "P.Y", false }, { "P.Z", false },
};

bool color_place(struct image_tile *t, size_t i, bool center, float share)
{
	const struct ray_hit *h = &t->hits[i];
	uint32_t p = t->pixel[i];

	if (center)
		t->planes[Z][p] = INFINITY;
	if (h->surface < 0)
		return false;
	t->planes[A][p] += share;
	if (!center)
		return true;
	t->planes[Z][p] = (float)image_depth(t->image, h->point);
	t->planes[NX][p] = (float)h->normal.x;
	t->planes[NY][p] = (float)h->normal.y;
	t->planes[NZ][p] = (float)h->normal.z;
	t->planes[PX][p] = (float)h->point.x;
	t->planes[PY][p] = (float)h->point.y;
	t->planes[PZ][p] = (float)h->point.z;
	return true;
}

enum status color_finish(const struct image *im, struct work *w, const char *extension,
                         const char *png)
{
	json_t *figures = NULL;
	enum status st = image_gather(im, w, &figures);

	return st == ST_OK
	               ? image_output(im, w, extension, work_flag(w, "png") ? png : NULL, figures)
	               : st;
}
