/* curvature_view.c - the curvatures of a surface as seen from a camera. */
#include "curvature_view.h"

#include <stdlib.h>

#include "curvature_survey.h"
#include "image.h"
#include "picture.h"
#include "worker_image.h"

enum {
	DEPTH = N_QUANTITIES,
	NORMAL_X,
	NORMAL_Y,
	NORMAL_Z,
	POINT_X,
	POINT_Y,
	POINT_Z,
	N_CHANNELS,
};

/* Those of N_QUANTITIES and above. */
static const char *const image_channels[] = { "Z", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z" };

static const float rim = 0.14f; /* darkening where the surface turns away */

struct curvature_view {
	const struct surface *surface; /* borrowed */
	struct image image;
};

enum status curvature_view_create(struct curvature_view **out, struct work *w)
{
	int width, height;
	struct exr_channel channels[N_CHANNELS] = { { .name = NULL } };
	for (int c = 0; c < N_CHANNELS; c++)
		channels[c].name = c < N_QUANTITIES ? quantity_table[c].channel
		                                    : image_channels[c - N_QUANTITIES];
	struct curvature_view *v = calloc(1, sizeof *v);
	if (!v)
		return ST_RESOURCE;
	v->surface = w->surfaces[0];
	work_size(w, "size", &width, &height);
	enum status st = image_init(&v->image, w, work_text(w, "view"), width, height, 1, channels,
	                            N_CHANNELS);
	if (st == ST_OK)
		*out = v;
	else
		free(v);
	return st;
}

void curvature_view_destroy(struct curvature_view *v)
{
	if (!v)
		return;
	image_finish(&v->image);
	free(v);
}

size_t curvature_view_tiles(const struct curvature_view *v)
{
	return image_units(&v->image);
}

/* Where nothing is: no value, infinitely far, normal and point zero. */
static void put_nothing(float *const *planes, size_t i)
{
	for (int q = 0; q < N_QUANTITIES; q++)
		planes[q][i] = NAN;
	planes[DEPTH][i] = INFINITY;
}

static void put_hit(const struct curvature_view *v, const struct ray_hit *hit, float *const *planes,
                    size_t i)
{
	struct surface_shape shape;
	struct vec3 p = hit->point, n = hit->normal;
	surface_shape(v->surface, hit->u, hit->v, &shape);
	for (int q = 0; q < N_QUANTITIES; q++)
		planes[q][i] = (float)shape.value[q];
	planes[DEPTH][i] = (float)image_depth(&v->image, p);
	planes[NORMAL_X][i] = (float)n.x;
	planes[NORMAL_Y][i] = (float)n.y;
	planes[NORMAL_Z][i] = (float)n.z;
	planes[POINT_X][i] = (float)p.x;
	planes[POINT_Y][i] = (float)p.y;
	planes[POINT_Z][i] = (float)p.z;
}

enum status curvature_view_tile(const struct curvature_view *v, size_t tile, struct text *out)
{
	struct image_tile t;
	enum status st = image_tile_init(&t, &v->image, tile);
	if (st != ST_OK)
		return st;
	image_tile_shoot(&t, 0);
	for (size_t i = 0; i < t.n; i++)
		if (t.hits[i].surface < 0)
			put_nothing(t.planes, t.pixel[i]);
		else
			put_hit(v, &t.hits[i], t.planes, t.pixel[i]);
	st = exr_pack(&v->image.exr, tile, (const float *const *)t.planes, out);
	image_tile_finish(&t);
	return st;
}

/* What the writers of the two files need. */
struct finish {
	const struct curvature_view *view;
	struct work *w;
	enum quantity shown;
	const struct colormap *map;
	struct exr_picture seen; /* owned; the image as written */
};

/* The surface grows a little darker towards its rim, so that its form can be seen. */
static void make_shade(const struct finish *f, float *shade)
{
	const struct camera *c = &f->view->image.camera;
	const float *n[3] = { exr_plane(&f->seen, "N.X"), exr_plane(&f->seen, "N.Y"),
		              exr_plane(&f->seen, "N.Z") };
	const float *depth = exr_plane(&f->seen, "Z");
	for (int y = 0; y < c->height; y++)
		for (int x = 0; x < c->width; x++) {
			size_t i = (size_t)y * c->width + x;
			struct vec3 origin, direction;
			camera_ray(c, x + 0.5, y + 0.5, &origin, &direction);
			double facing = fabs(vec3_dot(vec3(n[0][i], n[1][i], n[2][i]), direction));
			/* without a normal as dark as the rim */
			shade[i] = isinf(depth[i]) ? NAN : 1 - rim + rim * (float)fmax(facing, 0);
		}
}

static enum status write_picture(void *data, const char *path, const struct report *r)
{
	struct finish *f = data;
	const struct camera *c = &f->view->image.camera;
	float *shade = malloc((size_t)c->width * c->height * sizeof *shade);
	char *title = curvature_title(f->shown), *unit = curvature_unit(f->w, f->shown);
	char *note = curvature_name(f->w);
	enum status st = ST_RESOURCE;
	if (shade && title && unit && note) {
		make_shade(f, shade);
		struct picture_map m = {
			.width = c->width,
			.height = c->height,
			.values = exr_plane(&f->seen, quantity_table[f->shown].channel),
			.shade = shade,
			.title = title,
			.note = note,
			.symbol = quantity_table[f->shown].channel,
			.unit = unit,
			.map = *f->map,
		};
		st = picture_map(path, &m, THEME_LIGHT, r);
	}
	free(shade);
	free(title);
	free(unit);
	free(note);
	return st;
}

enum status curvature_view_finish(const struct curvature_view *v, struct work *w, size_t first,
                                  enum quantity shown, const struct colormap *map)
{
	struct finish f = { .view = v, .w = w, .shown = shown, .map = map };
	enum status st = work_image(w, ".view.exr", &v->image.exr, first);
	if (st == ST_OK)
		st = exr_read(&f.seen, work_made(w, ".view.exr"), &w->report);
	if (st == ST_OK)
		st = work_output(w, ".view.png", write_picture, &f);
	exr_picture_finish(&f.seen);
	return st;
}
