/* shading.c - the surfaces seen from a camera: exact normals, one light, lines on them. */
#include <stdlib.h>
#include <string.h>

#include "color_image.h"
#include "look.h"
#include "worker_image.h"

/* clang-format off */
static const struct param shading_params[] = {
	PARAM_ROW_VIEW(NULL),
	PARAM_ROW_SIZE("1024x768"),
	PARAM_ROW_SAMPLES("3"),
	PARAM_ROW_TRIMMED,
	LOOK_ROWS,
	{ .name = "wire", .type = PARAM_SIZE, .min = 1, .max = 1000,
	  .help = "draw that many steps of isoparametric lines in u by v on each surface" },
	{ .name = "edges", .type = PARAM_FLAG, .def = "no",
	  .help = "draw the borders of the patches (the knot lines) and of what is trimmed" },
	{ .name = "line-width", .type = PARAM_REAL, .def = "1", .min = 0.1, .max = 100,
	  .unit = "px", .help = "width of the lines" },
	PARAM_ROW_PNG,
	{ .name = NULL },
};
/* clang-format on */

static const struct worker_output shading_outputs[] = {
	{ ".shade.exr", "image", NULL },
	{ ".shade.png", "picture", "png" },
	{ NULL, NULL, NULL },
};

/* Parameters at which lines run, rising; borders included. */
struct lines {
	double *at; /* owned */
	int n;
};

struct shading {
	struct image image;
	struct look look;
	double line_width;
	struct lines *wire, *edges; /* owned, 2 a surface: u, v; NULL: none */
};

static enum status lines_even(struct lines *l, const double domain[2], int steps)
{
	l->at = malloc(sizeof *l->at * (steps + 1));
	if (!l->at)
		return ST_RESOURCE;
	l->n = steps + 1;
	for (int i = 0; i <= steps; i++)
		l->at[i] = domain[0] + (domain[1] - domain[0]) * i / steps;
	return ST_OK;
}

static enum status lines_knots(struct lines *l, const struct surface *s, int d)
{
	l->at = malloc(sizeof *l->at * (s->n[d] + 2));
	if (!l->at)
		return ST_RESOURCE;
	l->n = knots_breaks(s->order[d], s->n[d], s->knots[d], s->domain[d][0], s->domain[d][1],
	                    l->at);
	return ST_OK;
}

static void lines_destroy(struct lines *l, int n)
{
	for (int i = 0; l && i < n; i++)
		free(l[i].at);
	free(l);
}

static enum status read_lines(struct shading *s, struct work *w)
{
	bool wire = work_has(w, "wire"), edges = work_flag(w, "edges");
	int steps[2] = { 1, 1 };
	enum status st = ST_OK;

	s->line_width = work_real(w, "line-width");
	if (wire) {
		work_size(w, "wire", &steps[0], &steps[1]);
		s->wire = calloc(2 * (size_t)w->n_surfaces, sizeof *s->wire);
	}
	if (edges)
		s->edges = calloc(2 * (size_t)w->n_surfaces, sizeof *s->edges);
	if ((wire && !s->wire) || (edges && !s->edges))
		return ST_RESOURCE;
	for (int i = 0; st == ST_OK && i < 2 * w->n_surfaces; i++) {
		const struct surface *f = w->surfaces[i / 2];

		if (wire)
			st = lines_even(&s->wire[i], f->domain[i % 2], steps[i % 2]);
		if (st == ST_OK && edges)
			st = lines_knots(&s->edges[i], f, i % 2);
	}
	return st;
}

static void shading_end(struct work *w)
{
	struct shading *s = w->state;

	if (!s)
		return;
	lines_destroy(s->wire, 2 * w->n_surfaces);
	lines_destroy(s->edges, 2 * w->n_surfaces);
	look_finish(&s->look);
	image_finish(&s->image);
	free(s);
	w->state = NULL;
}

static enum status shading_begin(struct work *w)
{
	struct shading *s = calloc(1, sizeof *s);
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
		st = read_lines(s, w);
	return st;
}

static size_t shading_units(const struct work *w)
{
	const struct shading *s = w->state;

	return image_units(&s->image);
}

/* How much of a sample, `away` pixels from a line, the line covers. */
static double line_cover(double away, double width, int samples)
{
	return fmin(fmax((0.5 * width - away) * samples + 0.5, 0), 1);
}

/* The same for the lines next to t; `gradient` is parameters a pixel. */
static double lines_cover(const struct lines *l, double t, double gradient, double width,
                          int samples)
{
	int lo = 0, hi = l->n - 1;

	while (hi - lo > 1) {
		int middle = (lo + hi) / 2;

		if (l->at[middle] <= t)
			lo = middle;
		else
			hi = middle;
	}
	/* of a line on the border all its width lies inside */
	double below = line_cover((t - l->at[lo]) / gradient, lo == 0 ? 2 * width : width, samples);
	double above =
	        line_cover((l->at[hi] - t) / gradient, hi == l->n - 1 ? 2 * width : width, samples);
	/* lines that run together say nothing: they fade */
	double room = ((l->at[hi] - l->at[lo]) / gradient / width - 2) / 3;

	return fmax(below, above) * fmin(fmax(room, 0), 1);
}

/* How fast u and v change over the image, in parameters a pixel. */
static bool hit_gradients(const struct shading *s, const struct surface *f, const struct ray *r,
                          const struct ray_hit *h, double out[2])
{
	const struct camera *c = &s->image.camera;
	struct vec3 p, du, dv;

	surface_tangents(f, h->u, h->v, &p, &du, &dv);
	struct vec3 n = vec3_cross(du, dv);
	double area = vec3_dot(n, n), slope = vec3_dot(n, r->direction);
	if (!(area > 0) || !(fabs(slope) > 0))
		return false;

	double pixel = camera_pixel(c, h->point);
	const struct vec3 dual[2] = { vec3_scale(vec3_cross(dv, n), 1 / area),
		                      vec3_scale(vec3_cross(n, du), 1 / area) };
	for (int d = 0; d < 2; d++) {
		/* a step across the image slides along the ray until it is in the tangent plane */
		struct vec3 g = vec3_along(dual[d], -vec3_dot(dual[d], r->direction) / slope, n);

		out[d] = pixel * hypot(vec3_dot(g, c->right), vec3_dot(g, c->up));
		if (!(out[d] > 0))
			return false;
	}
	return true;
}

/* Does a loop of its trim run through the line's width on the side of the point that is left? */
static bool on_loop(const struct shading *s, const struct ray_hit *h, const double gradient[2])
{
	const struct trim_test *trim = ray_scene_trim(s->image.scene, h->surface);
	double lo[2], hi[2];

	for (int d = 0; d < 2; d++) {
		double t = d ? h->v : h->u, reach = s->line_width * gradient[d];

		lo[d] = t - reach;
		hi[d] = t + reach;
	}
	return trim && trim_test_box(trim, lo, hi) == 0;
}

static double hit_lines(const struct shading *s, const struct work *w, const struct ray *r,
                        const struct ray_hit *h)
{
	double gradient[2], cover = 0;

	if ((!s->wire && !s->edges) || !hit_gradients(s, w->surfaces[h->surface], r, h, gradient))
		return 0;
	for (int d = 0; d < 2; d++) {
		double t = d ? h->v : h->u;
		int i = 2 * h->surface + d;

		if (s->wire)
			cover = fmax(cover, 0.6 * lines_cover(&s->wire[i], t, gradient[d],
			                                      s->line_width, s->image.samples));
		if (s->edges)
			cover = fmax(cover, 0.85 * lines_cover(&s->edges[i], t, gradient[d],
			                                       s->line_width, s->image.samples));
	}
	if (s->edges && cover < 0.85 && on_loop(s, h, gradient))
		cover = 0.85;
	return cover;
}

static void shade_sample(const struct shading *s, const struct work *w, struct image_tile *t,
                         bool center)
{
	float share = 1.0f / (float)(s->image.samples * s->image.samples);

	for (size_t i = 0; i < t->n; i++) {
		const struct ray_hit *h = &t->hits[i];
		uint32_t p = t->pixel[i];

		if (!color_place(t, i, center, share))
			continue;

		const struct ray *r = &t->rays[i];
		struct vec3 n = look_side(h->normal, r->direction);
		struct tint c = look_shade(&s->look, s->look.colors[h->surface], n,
		                           vec3_scale(r->direction, -1), true);
		float paper = share * (1 - (float)hit_lines(s, w, r, h));

		t->planes[R][p] += paper * c.r;
		t->planes[G][p] += paper * c.g;
		t->planes[B][p] += paper * c.b;
	}
}

static enum status shading_unit(struct work *w, size_t unit)
{
	const struct shading *s = w->state;
	struct image_tile t;
	enum status st = image_tile_init(&t, &s->image, unit);

	for (int k = 0; st == ST_OK && k < s->image.samples * s->image.samples; k++) {
		image_tile_shoot(&t, k);
		shade_sample(s, w, &t, k == s->image.center);
		if (work_cancelled(w))
			st = ST_CANCELLED;
	}
	if (st == ST_OK)
		st = image_tile_put(&t, w);
	image_tile_finish(&t);
	return st;
}

static enum status shading_finish(struct work *w)
{
	const struct shading *s = w->state;

	return color_finish(&s->image, w, ".shade.exr", ".shade.png");
}

const struct worker worker = {
	.name = "shading",
	.title = "shaded image",
	.version = 4,
	.help = "The surfaces seen from a camera with one light: color, depth, exact normals and "
	        "points of every pixel.",
	.scene = true,
	.units_are_output = true,
	.params = shading_params,
	.outputs = shading_outputs,
	.begin = shading_begin,
	.units = shading_units,
	.unit = shading_unit,
	.finish = shading_finish,
	.end = shading_end,
};
