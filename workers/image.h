/* image.h - what the workers that look at surfaces share: scene, camera, samples, tiles, EXR.
 *
 * A unit is a tile. Its bytes are those of exr_pack with the tile's statistics behind them
 * (struct image_stats), so that figures need no pixel read again.
 *
 * 	begin:  image_init
 * 	unit:   image_tile_init, for every sample image_tile_shoot, fill planes, image_tile_put
 * 	finish: image_gather, image_output
 */
#ifndef BATTEN_IMAGE_H
#define BATTEN_IMAGE_H

#include "camera.h"
#include "exr.h"
#include "ray_scene.h"
#include "worker.h"

enum { IMAGE_TILE = 64, IMAGE_SAMPLES_MAX = 8 };

#define PARAM_ROW_SAMPLES(value)                                                                   \
	{                                                                                          \
		.name = "samples", .type = PARAM_INTEGER, .def = value, .min = 1,                  \
		.max = IMAGE_SAMPLES_MAX, .help = "rays across a pixel: 3 makes 3 x 3 of them"     \
	}

/* Of the workers whose surfaces may be trimmed. */
#define PARAM_ROW_TRIMMED                                                                          \
	{                                                                                          \
		.name = "trimmed", .type = PARAM_FLAG, .def = "yes",                               \
		.help = "leave out what the file's trimming loops cut away"                        \
	}

struct image {
	struct ray_scene *scene; /* owned */
	struct camera camera;
	struct exr_image exr;
	struct exr_channel channels[EXR_CHANNELS_MAX];
	int samples; /* a side of a pixel */
	int center;  /* the sample at, or nearest to, the pixel's centre */
};

/* Of a tile, or of all. */
struct image_stats {
	double pixels;    /* whose centre sample hit */
	double rays;      /* shot, of all kinds */
	double near, far; /* depths of those pixels along the view, file units; near > far: none */
};

/*
 * Prepare the scene of all the work's surfaces, trimmed where the parameter `trimmed` says so, and
 * a camera on it. view NULL: the default.
 * The channels' names are borrowed (string constants).
 * Errors: those of ray_scene_create and camera_fit.
 */
enum status image_init(struct image *im, struct work *w, const char *view, int width, int height,
                       int samples, const struct exr_channel *channels, int n_channels);
void image_finish(struct image *im); /* a zeroed one is fine */

static inline size_t image_units(const struct image *im)
{
	return exr_tiles(&im->exr);
}

/* A tile on its way. Ray i belongs to pixel pixel[i] (row x width of the tile + column); rays of
 * neighbouring pixels stand together. */
struct image_tile {
	const struct image *image;
	size_t unit;
	int x, y, width, height;
	size_t n;                        /* pixels */
	uint32_t *pixel;                 /* owned, n */
	struct ray *rays;                /* owned, n: of the sample shot last */
	struct ray_hit *hits;            /* owned, n */
	float *planes[EXR_CHANNELS_MAX]; /* n each, zero at first; one allocation */
	struct image_stats stats;        /* rays: add those you shoot yourself */
};

/* Errors: ST_RESOURCE. */
enum status image_tile_init(struct image_tile *t, const struct image *im, size_t unit);
void image_tile_finish(struct image_tile *t);

/* Shoot the primary rays of sample 0 .. samples x samples - 1; the centre sample's hits go into
 * the statistics. */
void image_tile_shoot(struct image_tile *t, int sample);

/* Depth of a point along the view. */
double image_depth(const struct image *im, struct vec3 p);

/* Pack the planes and hand the unit over. */
enum status image_tile_put(const struct image_tile *t, struct work *w);

/* In finish: statistics of all units, as figures: surfaces, trimmed (how many of them), leaves,
 * pixels, rays, width, height, depth_min, depth_max (null where nothing was hit). New reference, NULL for want of memory. */
enum status image_gather(const struct image *im, struct work *w, json_t **figures);

/* In finish: write the image under `extension` and, where png is not NULL, the picture of its
 * R G B A channels under that extension. Figures (stolen) are stated first. */
enum status image_output(const struct image *im, struct work *w, const char *extension,
                         const char *png, json_t *figures);

#endif
