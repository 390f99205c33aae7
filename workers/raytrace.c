/* raytrace.c - rays against the surfaces themselves: shadows, mirrors, stripes. */
#include <stdlib.h>
#include <string.h>

#include "color_image.h"
#include "environment.h"
#include "worker_image.h"

/* clang-format off */
static const struct param raytrace_params[] = {
	PARAM_ROW_VIEW(NULL),
	PARAM_ROW_SIZE("1024x768"),
	PARAM_ROW_SAMPLES("3"),
	PARAM_ROW_TRIMMED,
	LOOK_ROWS,
	{ .name = "shadows", .type = PARAM_FLAG, .def = "yes",
	  .help = "surfaces keep the light from each other" },
	{ .name = "mirror", .type = PARAM_REAL, .def = "0.35", .min = 0, .max = 1,
	  .help = "part of the light that the surface mirrors, seen from straight above" },
	{ .name = "depth", .type = PARAM_INTEGER, .def = "3", .min = 0, .max = 32,
	  .help = "how often a ray is mirrored at most" },
	ENVIRONMENT_ROWS,
	PARAM_ROW_PNG,
	{ .name = NULL },
};
/* clang-format on */

static const struct worker_output raytrace_outputs[] = {
	{ ".trace.exr", "image", NULL },
	{ ".trace.png", "picture", "png" },
	{ NULL, NULL, NULL },
};

/*
 * Rays that leave a surface begin this part of the scene's diagonal away from it, a tenth of a
 * pixel or so: surfaces that join only to the tolerance of a CAD system cast no shadows on each
 * other there. (Hits are exact enough for a distance a million times smaller.)
 */
static const double leave = 1e-4;

struct raytrace {
	struct image image;
	struct look look;
	struct environment environment;
	bool shadows;
	double mirror, near;
	int depth;
};

/* The rays of one sample on their way through a tile. */
struct wave {
	struct ray *rays;     /* owned, n */
	struct ray_hit *hits; /* owned, n */
	uint32_t *pixel;      /* owned, n */
	struct tint *weight;  /* owned, n: what of this ray's light reaches the eye */
	size_t n;             /* rays of this generation */

	struct ray *to_light; /* owned, n */
	size_t *asks;         /* owned: which hit a ray to the light belongs to */
	bool *blocked;        /* owned */
	bool *lit;            /* owned, of each hit */
};

static void raytrace_end(struct work *w)
{
	struct raytrace *s = w->state;

	if (!s)
		return;
	look_finish(&s->look);
	image_finish(&s->image);
	free(s);
	w->state = NULL;
}

static enum status raytrace_begin(struct work *w)
{
	struct raytrace *s = calloc(1, sizeof *s);
	int width, height;

	if (!s)
		return ST_RESOURCE;
	w->state = s;
	work_size(w, "size", &width, &height);
	enum status st = image_init(&s->image, w, work_has(w, "view") ? work_text(w, "view") : NULL,
	                            width, height, (int)work_integer(w, "samples"), color_channels,
	                            N_COLOR_CHANNELS);
	if (st == ST_OK)
		work_units_are_tiles(w, &s->image.exr);
	if (st == ST_OK)
		st = look_init(&s->look, w, &s->image.camera);
	if (st == ST_OK)
		st = environment_init(&s->environment, w, &s->look);
	if (st != ST_OK)
		return st;

	struct box box = ray_scene_box(s->image.scene);
	s->near = leave * box_diagonal(&box);
	s->shadows = work_flag(w, "shadows");
	s->mirror = work_real(w, "mirror");
	s->depth = (int)work_integer(w, "depth");
	return ST_OK;
}

static size_t raytrace_units(const struct work *w)
{
	const struct raytrace *s = w->state;

	return image_units(&s->image);
}

static void wave_finish(struct wave *v)
{
	free(v->rays);
	free(v->hits);
	free(v->pixel);
	free(v->weight);
	free(v->to_light);
	free(v->asks);
	free(v->blocked);
	free(v->lit);
}

static enum status wave_init(struct wave *v, size_t n)
{
	*v = (struct wave){
		.rays = malloc(n * sizeof *v->rays),
		.hits = malloc(n * sizeof *v->hits),
		.pixel = malloc(n * sizeof *v->pixel),
		.weight = malloc(n * sizeof *v->weight),
		.to_light = malloc(n * sizeof *v->to_light),
		.asks = malloc(n * sizeof *v->asks),
		.blocked = malloc(n * sizeof *v->blocked),
		.lit = malloc(n * sizeof *v->lit),
	};
	return v->rays && v->hits && v->pixel && v->weight && v->to_light && v->asks &&
	                       v->blocked && v->lit
	               ? ST_OK
	               : ST_RESOURCE;
}

/* Which hits the light reaches. */
static void wave_light(const struct raytrace *s, struct wave *v, struct image_tile *t)
{
	size_t n = 0;

	for (size_t i = 0; i < v->n; i++) {
		const struct ray_hit *h = &v->hits[i];

		v->lit[i] = h->surface >= 0 &&
		            vec3_dot(look_side(h->normal, v->rays[i].direction), s->look.light) > 0;
		if (!v->lit[i] || !s->shadows)
			continue;
		v->to_light[n] = (struct ray){ h->point, s->look.light, s->near, INFINITY };
		v->asks[n++] = i;
	}
	ray_scene_blocked(s->image.scene, v->to_light, n, v->blocked);
	t->stats.rays += n;
	for (size_t k = 0; k < n; k++)
		v->lit[v->asks[k]] = !v->blocked[k];
}

static void pixel_add(struct image_tile *t, uint32_t p, struct tint weight, struct tint c)
{
	t->planes[R][p] += weight.r * c.r;
	t->planes[G][p] += weight.g * c.g;
	t->planes[B][p] += weight.b * c.b;
}

/* Add the light of one generation to the pixels; what is mirrored becomes the next. */
static void wave_shade(const struct raytrace *s, struct wave *v, struct image_tile *t, bool last)
{
	size_t next = 0;

	for (size_t i = 0; i < v->n; i++) {
		const struct ray_hit h = v->hits[i];
		const struct ray r = v->rays[i];
		struct tint weight = v->weight[i];
		uint32_t p = v->pixel[i];

		if (h.surface < 0) {
			pixel_add(t, p, weight, environment_color(&s->environment, r.direction));
			continue;
		}
		struct vec3 n = look_side(h.normal, r.direction);
		struct vec3 to_eye = vec3_scale(r.direction, -1);
		double facing = fmin(fmax(vec3_dot(n, to_eye), 0), 1);
		/* Schlick, An Inexpensive BRDF Model (1994) */
		double mirrored =
		        s->mirror > 0 ? s->mirror + (1 - s->mirror) * pow(1 - facing, 5) : 0;
		struct tint c =
		        look_shade(&s->look, s->look.colors[h.surface], n, to_eye, v->lit[i]);
		float stays = (float)(1 - mirrored), goes = (float)mirrored;

		pixel_add(t, p,
		          (struct tint){ weight.r * stays, weight.g * stays, weight.b * stays }, c);
		struct tint share = { weight.r * goes, weight.g * goes, weight.b * goes };
		struct vec3 d = vec3_unit(vec3_along(r.direction, 2 * facing, n));
		if (share.r + share.g + share.b < 1e-4f)
			continue;
		if (last) {
			pixel_add(t, p, share, environment_color(&s->environment, d));
			continue;
		}
		v->rays[next] = (struct ray){ h.point, d, s->near, INFINITY };
		v->pixel[next] = p;
		v->weight[next++] = share;
	}
	v->n = next;
}

/* The primary hits of a sample; rays that hit nothing leave the ground to be seen. */
static void wave_begin(const struct raytrace *s, struct wave *v, struct image_tile *t, bool center)
{
	float share = 1.0f / (float)(s->image.samples * s->image.samples);

	v->n = 0;
	for (size_t i = 0; i < t->n; i++) {
		if (!color_place(t, i, center, share))
			continue;
		v->rays[v->n] = t->rays[i];
		v->hits[v->n] = t->hits[i];
		v->pixel[v->n] = t->pixel[i];
		v->weight[v->n++] = (struct tint){ share, share, share };
	}
}

static enum status raytrace_unit(struct work *w, size_t unit)
{
	const struct raytrace *s = w->state;
	struct image_tile t;
	struct wave v = { 0 };
	enum status st = image_tile_init(&t, &s->image, unit);

	if (st == ST_OK)
		st = wave_init(&v, t.n);
	for (int k = 0; st == ST_OK && k < s->image.samples * s->image.samples; k++) {
		image_tile_shoot(&t, k);
		wave_begin(s, &v, &t, k == s->image.center);
		for (int depth = 0; v.n > 0; depth++) {
			if (depth > 0) {
				ray_scene_hits(s->image.scene, v.rays, v.n, false, v.hits);
				t.stats.rays += v.n;
			}
			wave_light(s, &v, &t);
			wave_shade(s, &v, &t, depth == s->depth);
		}
		if (work_cancelled(w))
			st = ST_CANCELLED;
	}
	if (st == ST_OK)
		st = image_tile_put(&t, w);
	wave_finish(&v);
	image_tile_finish(&t);
	return st;
}

static enum status raytrace_finish(struct work *w)
{
	const struct raytrace *s = w->state;

	return color_finish(&s->image, w, ".trace.exr", ".trace.png");
}

const struct worker worker = {
	.name = "raytrace",
	.title = "ray traced image",
	.version = 4,
	.help = "The surfaces themselves ray traced, no triangles: shadows, mirrors, and light "
	        "stripes that show where a surface is not fair.",
	.scene = true,
	.units_are_output = true,
	.params = raytrace_params,
	.outputs = raytrace_outputs,
	.begin = raytrace_begin,
	.units = raytrace_units,
	.unit = raytrace_unit,
	.finish = raytrace_finish,
	.end = raytrace_end,
};
