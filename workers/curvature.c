/* curvature.c - curvatures of a surface on a grid of its parameters, and seen from a camera. */
#include <stdlib.h>
#include <string.h>

#include "curvature_survey.h"
#include "curvature_view.h"
#include "grid.h"
#include "image.h"
#include "json.h"
#include "number.h"
#include "worker_image.h"

enum {
	TILE = 64,
	PICTURE_SIDE_MAX = 16384,
	ALL_QUANTITIES = (1 << N_QUANTITIES) - 1,
};

struct state {
	int nu, nv;
	double *u, *v; /* owned */
	struct grid *grid;
	struct trim_test *trim; /* NULL: all of the surface counts */
	struct exr_channel channels[N_QUANTITIES];
	struct exr_image image; /* without attributes */
	enum quantity shown;
	enum colormap_scale scale;
	bool by_hand; /* the range is given */
	double range[2];
	struct curvature_view *view; /* NULL where none is asked for */
};

/* What stands behind the packed tile in a unit of the map. */
struct extremes {
	double lo[N_QUANTITIES], hi[N_QUANTITIES]; /* lo > hi: no value */
	double lo_uv[N_QUANTITIES][2], hi_uv[N_QUANTITIES][2];
	uint64_t undefined; /* samples without some value */
	uint64_t outside;   /* trimmed away */
};

static const struct param params[] = {
	PARAM_ROW_GRID("512x512"),
	PARAM_ROW_TRIMMED,
	{ .name = "quantity",
	  .type = PARAM_CHOICE,
	  .def = "K",
	  .choices = "K H kabs kmax kmin kn_u kn_v",
	  .help = "what the pictures show; the map holds all" },
	{ .name = "range",
	  .type = PARAM_TEXT,
	  .help = "values LO,HI at the ends of the color key" },
	{ .name = "scale",
	  .type = PARAM_CHOICE,
	  .choices = "linear arsinh",
	  .help = "scale of the color key; by itself arsinh where values crowd" },
	PARAM_ROW_PNG,
	PARAM_ROW_VIEW(NULL),
	PARAM_ROW_SIZE("1280x800"),
	{ .name = NULL },
};

static const struct worker_output outputs[] = {
	{ .extension = ".map.exr", .kind = "map" },
	{ .extension = ".map.png", .kind = "picture", .when = "png" },
	{ .extension = ".view.exr", .kind = "image", .when = "view" },
	{ .extension = ".view.png", .kind = "picture", .when = "view" },
	{ .extension = NULL },
};

static enum status read_range(struct state *s, const struct work *w)
{
	const char *text = work_text(w, "range"), *at = text, *end = text + strlen(text);
	s->by_hand = true;
	if (number_read(&at, end, &s->range[0]) && at < end && *at++ == ',' &&
	    number_read(&at, end, &s->range[1]) && at == end && isfinite(s->range[0]) &&
	    isfinite(s->range[1]) && s->range[0] < s->range[1])
		return ST_OK;
	return report_error(&w->report, ST_PARAMETER,
	                    "--range '%s': expected LO,HI with LO below HI", text);
}

static enum status read_parameters(struct state *s, const struct work *w)
{
	work_size(w, "grid", &s->nu, &s->nv);
	if (work_flag(w, "png") && (s->nu > PICTURE_SIDE_MAX || s->nv > PICTURE_SIDE_MAX))
		return report_error(&w->report, ST_PARAMETER,
		                    "--grid %dx%d: a picture has at most %d samples a side; "
		                    "take fewer or leave out --png",
		                    s->nu, s->nv, PICTURE_SIDE_MAX);
	int width, height;
	work_size(w, "size", &width, &height);
	if (work_has(w, "view") && (width > PICTURE_SIDE_MAX || height > PICTURE_SIDE_MAX))
		return report_error(&w->report, ST_PARAMETER,
		                    "--size %dx%d: expected at most %d pixels a side", width,
		                    height, PICTURE_SIDE_MAX);
	for (int q = 0; q < N_QUANTITIES; q++)
		if (!strcmp(work_text(w, "quantity"), quantity_table[q].channel))
			s->shown = q;
	s->scale = COLORMAP_AUTOMATIC;
	if (work_has(w, "scale"))
		s->scale =
		        strcmp(work_text(w, "scale"), "linear") ? COLORMAP_ARSINH : COLORMAP_LINEAR;
	return work_has(w, "range") ? read_range(s, w) : ST_OK;
}

static enum status curvature_begin(struct work *w)
{
	const struct surface *surface = w->surfaces[0];
	struct state *s = w->state = calloc(1, sizeof *s);
	if (!s)
		return ST_RESOURCE;
	enum status st = read_parameters(s, w);
	if (st != ST_OK)
		return st;
	s->u = malloc(s->nu * sizeof *s->u);
	s->v = malloc(s->nv * sizeof *s->v);
	if (!s->u || !s->v)
		return ST_RESOURCE;
	grid_lines(surface->domain[0][0], surface->domain[0][1], s->nu, s->u);
	grid_lines(surface->domain[1][0], surface->domain[1][1], s->nv, s->v);
	for (int q = 0; q < N_QUANTITIES; q++)
		s->channels[q].name = quantity_table[q].channel;
	s->image = (struct exr_image){ .width = s->nu,
		                       .height = s->nv,
		                       .tile = TILE,
		                       .channels = s->channels,
		                       .n_channels = N_QUANTITIES };
	st = grid_create(&s->grid, surface, s->u, s->nu, s->v, s->nv);
	if (st == ST_OK && work_flag(w, "trimmed") && w->entities[0]->trim.n)
		st = trim_test_create(&s->trim, &w->entities[0]->trim, surface);
	if (st == ST_OK && work_has(w, "view"))
		st = curvature_view_create(&s->view, w);
	if (!s->view)
		work_units_are_tiles(w, &s->image);
	return st;
}

static void curvature_end(struct work *w)
{
	struct state *s = w->state;
	if (!s)
		return;
	curvature_view_destroy(s->view);
	grid_destroy(s->grid);
	trim_test_destroy(s->trim);
	free(s->u);
	free(s->v);
	free(s);
}

static size_t curvature_units(const struct work *w)
{
	const struct state *s = w->state;
	return exr_tiles(&s->image) + (s->view ? curvature_view_tiles(s->view) : 0);
}

static void extremes_init(struct extremes *e)
{
	memset(e, 0, sizeof *e);
	for (int q = 0; q < N_QUANTITIES; q++) {
		e->lo[q] = INFINITY;
		e->hi[q] = -INFINITY;
	}
}

static void extremes_add(struct extremes *e, int q, double lo, const double lo_uv[2], double hi,
                         const double hi_uv[2])
{
	if (lo < e->lo[q]) {
		e->lo[q] = lo;
		memcpy(e->lo_uv[q], lo_uv, sizeof e->lo_uv[q]);
	}
	if (hi > e->hi[q]) {
		e->hi[q] = hi;
		memcpy(e->hi_uv[q], hi_uv, sizeof e->hi_uv[q]);
	}
}

/* What the trim takes away of a tile has no values. */
static void trim_tile(struct extremes *e, const struct state *s, int from, int first, int width,
                      int height, double *const *values)
{
	const double lo[2] = { s->u[from], s->v[first] };
	const double hi[2] = { s->u[from + width - 1], s->v[first + height - 1] };
	int left = trim_test_box(s->trim, lo, hi);
	if (left > 0)
		return;
	for (int row = 0; row < height; row++)
		for (int column = 0; column < width; column++) {
			if (left == 0 &&
			    trim_test_inside(s->trim, s->u[from + column], s->v[first + row]))
				continue;
			for (int q = 0; q < N_QUANTITIES; q++)
				values[q][(size_t)row * width + column] = NAN;
			e->outside++;
		}
}

/* The values of a tile, rows of rising v, become planes with v upward, and their extremes. */
static void take_tile(struct extremes *e, const struct state *s, int from, int first, int width,
                      int height, double *const *values, float *const *planes)
{
	for (int row = 0; row < height; row++)
		for (int column = 0; column < width; column++) {
			double uv[2] = { s->u[from + column], s->v[first + row] };
			size_t in = (size_t)row * width + column;
			size_t out = (size_t)(height - 1 - row) * width + column;
			bool missing = false;
			for (int q = 0; q < N_QUANTITIES; q++) {
				double value = values[q][in];
				planes[q][out] = (float)value;
				missing |= isnan(value);
				extremes_add(e, q, value, uv, value, uv);
			}
			e->undefined += missing;
		}
}

static enum status map_tile(const struct state *s, size_t tile, struct text *out)
{
	int x, y, width, height;
	exr_tile_window(&s->image, tile, &x, &y, &width, &height);
	size_t n = (size_t)width * height;
	int first = s->nv - y - height; /* image rows go down, v goes up */
	double *values = malloc(N_QUANTITIES * n * sizeof *values);
	float *pixels = malloc(N_QUANTITIES * n * sizeof *pixels), *planes[N_QUANTITIES];
	double *channels[N_GRID_CHANNELS] = { NULL };
	enum status st = values && pixels ? ST_OK : ST_RESOURCE;
	for (int q = 0; q < N_QUANTITIES && st == ST_OK; q++) {
		channels[q] = values + q * n;
		planes[q] = pixels + q * n;
	}
	if (st == ST_OK)
		st = grid_rows(s->grid, ALL_QUANTITIES, first, height, x, width, channels);
	if (st == ST_OK) {
		struct extremes e;
		extremes_init(&e);
		if (s->trim)
			trim_tile(&e, s, x, first, width, height, channels);
		take_tile(&e, s, x, first, width, height, channels, planes);
		st = exr_pack(&s->image, tile, (const float *const *)planes, out);
		text_add_bytes(out, &e, sizeof e);
	}
	free(values);
	free(pixels);
	return st;
}

static enum status curvature_unit_do(struct work *w, size_t unit)
{
	const struct state *s = w->state;
	size_t n_map = exr_tiles(&s->image);
	struct text bytes = { 0 };
	enum status st = unit < n_map ? map_tile(s, unit, &bytes)
	                              : curvature_view_tile(s->view, unit - n_map, &bytes);
	if (st == ST_OK)
		st = work_put(w, unit, bytes.s, bytes.n);
	text_finish(&bytes);
	return st;
}

static void set_figure(json_t *o, int q, const char *end, double value, const double uv[2],
                       bool found)
{
	char name[64];
	snprintf(name, sizeof name, "%s_%s", quantity_table[q].channel, end);
	json_set_number(o, name, found ? value : NAN);
	strncat(name, "_uv", sizeof name - strlen(name) - 1);
	json_object_set_new(o, name, found ? json_pack("[f,f]", uv[0], uv[1]) : json_null());
}

static enum status state_figures(struct work *w)
{
	const struct state *s = w->state;
	struct extremes all;
	extremes_init(&all);
	for (size_t i = 0; i < exr_tiles(&s->image); i++) {
		struct extremes e;
		enum status st = work_read_end(w, i, &e, sizeof e);
		if (st != ST_OK)
			return st;
		for (int q = 0; q < N_QUANTITIES; q++)
			extremes_add(&all, q, e.lo[q], e.lo_uv[q], e.hi[q], e.hi_uv[q]);
		all.undefined += e.undefined;
		all.outside += e.outside;
	}
	json_t *figures = json_object();
	json_set_int(figures, "samples", (int64_t)s->nu * s->nv);
	json_set_int(figures, "outside", (int64_t)all.outside);
	json_set_int(figures, "undefined", (int64_t)(all.undefined - all.outside));
	for (int q = 0; q < N_QUANTITIES; q++) {
		bool found = all.lo[q] <= all.hi[q];
		set_figure(figures, q, "min", all.lo[q], all.lo_uv[q], found);
		set_figure(figures, q, "max", all.hi[q], all.hi_uv[q], found);
	}
	return work_figures(w, figures);
}

/* The map's picture and what is seen from the camera have one key. */
static enum status make_pictures(struct work *w)
{
	struct state *s = w->state;
	struct curvature_survey survey;
	const struct curvature_grid lines = { s->grid, s->trim, s->u, s->v, s->nu, s->nv };
	enum status st = curvature_survey_init(&survey, w, &lines, s->shown, s->scale);
	if (st != ST_OK)
		return st;
	if (s->by_hand)
		colormap_set_range(&survey.map, s->range[0], s->range[1]);
	if (work_flag(w, "png"))
		st = work_output(w, ".map.png", curvature_survey_write, &survey);
	if (st == ST_OK && s->view)
		st = curvature_view_finish(s->view, w, exr_tiles(&s->image), s->shown, &survey.map);
	curvature_survey_finish(&survey);
	return st;
}

static enum status curvature_finish(struct work *w)
{
	const struct state *s = w->state;
	enum status st = state_figures(w);
	if (st == ST_OK)
		st = work_image(w, ".map.exr", &s->image, 0);
	if (st == ST_OK && (s->view || work_flag(w, "png")))
		st = make_pictures(w);
	return st;
}

const struct worker worker = {
	.name = "curvature",
	.title = "curvature map",
	.version = 5,
	.help = "Gaussian, mean, absolute, principal and normal curvatures of a surface on a grid of its "
	        "parameters: image x is u, image y is v with v upward, both ends of the domain "
	        "included. With --view also as seen from a camera.",
	.scene = false,
	.units_are_output = true,
	.params = params,
	.outputs = outputs,
	.begin = curvature_begin,
	.units = curvature_units,
	.unit = curvature_unit_do,
	.finish = curvature_finish,
	.end = curvature_end,
};
