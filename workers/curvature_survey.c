/* curvature_survey.c - one quantity over the whole grid with the areas it stands for. */
#include "curvature_survey.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"

enum {
	POINTS = GRID_BIT(GRID_POINT_X) | GRID_BIT(GRID_POINT_Y) | GRID_BIT(GRID_POINT_Z),
	STRIP = 32, /* rows worked on together */
};

/* Curvatures below this, in 1 / size of the surface, are rounding. */
static const double curvature_rounding = 1e-9;

char *curvature_unit(const struct work *w, enum quantity q)
{
	return text_print("1/%s%s", w->file_unit ? w->file_unit : "length",
	                  quantity_table[q].power == 2 ? "²" : "");
}

char *curvature_title(enum quantity q)
{
	char *title = strdup(quantity_table[q].title);
	if (title)
		title[0] = (char)toupper((unsigned char)title[0]);
	return title;
}

char *curvature_name(const struct work *w)
{
	const struct entity *e = w->entities[0];
	return e->name && *e->name ? text_print("surface %d, %s", e->number, e->name)
	                           : text_print("surface %d", e->number);
}

/* Rows of points and values, rising v. */
struct strip {
	int first, count, width;
	double *channels[N_GRID_CHANNELS]; /* those asked for are owned */
};

static void strip_finish(struct strip *p)
{
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		free(p->channels[c]);
}

static enum status strip_init(struct strip *p, const struct grid *g, unsigned what, int first,
                              int count, int width)
{
	*p = (struct strip){ .first = first, .count = count, .width = width };
	for (int c = 0; c < N_GRID_CHANNELS; c++) {
		if (!(what & GRID_BIT(c)))
			continue;
		p->channels[c] = malloc((size_t)count * width * sizeof(double));
		if (!p->channels[c])
			return ST_RESOURCE;
	}
	return grid_rows(g, what, first, count, 0, width, p->channels);
}

static struct vec3 strip_point(const struct strip *p, int column, int row)
{
	size_t i = (size_t)(row - p->first) * p->width + column;
	return vec3(p->channels[GRID_POINT_X][i], p->channels[GRID_POINT_Y][i],
	            p->channels[GRID_POINT_Z][i]);
}

static int clamp(int i, int n)
{
	return i < 0 ? 0 : i < n ? i : n - 1;
}

/* Area about a sample, by differences of its neighbours: half of a cell at the borders. */
static double strip_area(const struct strip *p, int column, int row, int nv)
{
	struct vec3 du = vec3_sub(strip_point(p, clamp(column + 1, p->width), row),
	                          strip_point(p, clamp(column - 1, p->width), row));
	struct vec3 dv = vec3_sub(strip_point(p, column, clamp(row + 1, nv)),
	                          strip_point(p, column, clamp(row - 1, nv)));
	return vec3_length(vec3_cross(du, dv)) / 4;
}

static enum status survey_rows(struct curvature_survey *s, const struct curvature_grid *lines,
                               int first, int count)
{
	const struct grid *g = lines->grid;
	struct strip p;
	int from = clamp(first - 1, s->nv), to = clamp(first + count, s->nv);
	enum status st = strip_init(&p, g, POINTS | GRID_BIT((unsigned)s->shown), from,
	                            to - from + 1, s->nu);
	for (int row = first; row < first + count && st == ST_OK; row++)
		for (int column = 0; column < s->nu; column++) {
			size_t i = (size_t)(s->nv - 1 - row) * s->nu + column;
			size_t k = (size_t)(row - from) * s->nu + column;
			s->values[i] = (float)p.channels[s->shown][k];
			s->areas[i] = (float)strip_area(&p, column, row, s->nv);
			if (!lines->trim)
				continue;
			s->shade[i] = 1;
			if (!trim_test_inside(lines->trim, lines->u[column], lines->v[row]))
				s->values[i] = s->areas[i] = s->shade[i] = NAN;
		}
	strip_finish(&p);
	return st;
}

static enum status survey(struct curvature_survey *s, const struct curvature_grid *lines)
{
	for (int row = 0; row < s->nv; row += STRIP) {
		int count = row + STRIP < s->nv ? STRIP : s->nv - row;
		if (work_cancelled(s->w))
			return ST_CANCELLED;
		work_phase(s->w, "drawing", row, s->nv);
		enum status st = survey_rows(s, lines, row, count);
		if (st != ST_OK)
			return st;
	}
	return ST_OK;
}

enum status curvature_survey_init(struct curvature_survey *s, struct work *w,
                                  const struct curvature_grid *lines, enum quantity shown,
                                  enum colormap_scale scale)
{
	const int nu = lines->nu, nv = lines->nv;
	size_t n = (size_t)nu * nv;
	const struct quantity_row *row = &quantity_table[shown];
	*s = (struct curvature_survey){ .w = w, .nu = nu, .nv = nv, .shown = shown };
	s->values = malloc(n * sizeof *s->values);
	s->areas = malloc(n * sizeof *s->areas);
	s->shade = lines->trim ? malloc(n * sizeof *s->shade) : NULL;
	bool room = s->values && s->areas && (s->shade || !lines->trim);
	enum status st = room ? survey(s, lines) : ST_RESOURCE;
	if (st == ST_OK) {
		double size = surface_size(w->surfaces[0]);
		double rounding = size > 0 ? curvature_rounding / pow(size, row->power) : 0;
		/* a grid of one line has no areas */
		st = colormap_fit(&s->map, row->is_signed, scale, rounding, s->values,
		                  nu > 1 && nv > 1 ? s->areas : NULL, n);
	}
	if (st != ST_OK)
		curvature_survey_finish(s);
	return st;
}

void curvature_survey_finish(struct curvature_survey *s)
{
	free(s->values);
	free(s->areas);
	free(s->shade);
	*s = (struct curvature_survey){ .values = NULL };
}

enum status curvature_survey_write(void *data, const char *path, const struct report *r)
{
	const struct curvature_survey *s = data;
	const struct surface *surface = s->w->surfaces[0];
	double axes[4] = { surface->domain[0][0], surface->domain[0][1], surface->domain[1][0],
		           surface->domain[1][1] };
	char *title = curvature_title(s->shown), *unit = curvature_unit(s->w, s->shown);
	char *name = curvature_name(s->w);
	char *note = name ? text_print("%s, %d × %d samples", name, s->nu, s->nv) : NULL;
	enum status st = ST_RESOURCE;
	if (title && unit && note) {
		struct picture_map m = {
			.width = s->nu,
			.height = s->nv,
			.values = s->values,
			.shade = s->shade,
			.weights = s->nu > 1 && s->nv > 1 ? s->areas : NULL,
			.title = title,
			.note = note,
			.symbol = quantity_table[s->shown].channel,
			.unit = unit,
			.axes = axes,
			.map = s->map,
		};
		st = picture_map(path, &m, THEME_LIGHT, r);
	}
	free(title);
	free(unit);
	free(name);
	free(note);
	return st;
}
