/* view_map.c - curvatures over a surface's domain as textures, and the colors that all share. */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "grid.h"
#include "hash.h"
#include "live.h"
#include "view_private.h"

enum { OWN_SIDE = 256, WEIGHT_SIDE = 256, COLORS = 512, FIT_MOST = 1 << 20 };

static const char *const symbols[N_QUANTITIES] = {
	"K", "H", "|k|", "k max", "k min", "k u", "k v"
};

const struct overlay *overlay_of(const struct world *w, enum overlay_kind kind, int thing)
{
	for (int k = 0; k < world_overlays(w); k++) {
		const struct overlay *o = world_overlay(w, k);
		if (o->kind == kind && o->thing == thing)
			return o;
	}
	return NULL;
}

int map_quantity(const struct drawing *d, const struct overlay *o)
{
	if (d->state->quantity >= 0 && d->state->quantity < N_QUANTITIES)
		return d->state->quantity;
	return o ? (int)o->quantity : -1;
}

static void map_empty(struct map *m)
{
	for (int q = 0; q < N_QUANTITIES; q++) {
		free(m->values[q]);
		m->values[q] = NULL;
		if (m->texture[q])
			glDeleteTextures(1, &m->texture[q]);
		m->texture[q] = 0;
	}
	free(m->weights);
	free(m->file);
	m->weights = NULL;
	m->file = NULL;
	m->width = m->height = 0;
}

void maps_finish(struct view *v)
{
	for (int i = 0; i < v->n_maps; i++)
		map_empty(&v->maps[i]);
	free(v->maps);
	v->maps = NULL;
	v->n_maps = 0;
}

static struct map *find_map(struct view *v, int thing, bool add)
{
	for (int i = 0; i < v->n_maps; i++)
		if (v->maps[i].thing == thing)
			return &v->maps[i];
	struct map *all = add ? reallocarray(v->maps, (size_t)v->n_maps + 1, sizeof *all) : NULL;
	if (!all)
		return NULL;
	v->maps = all;
	all[v->n_maps] = (struct map){ .thing = thing };
	return &all[v->n_maps++];
}

/* Areas of the samples, by the cross product of differences; the grid need not be as fine. */
static void find_weights(struct map *m, const struct surface *s)
{
	const int nu = m->width < WEIGHT_SIDE ? m->width : WEIGHT_SIDE;
	const int nv = m->height < WEIGHT_SIDE ? m->height : WEIGHT_SIDE;
	double *area = calloc((size_t)nu * nv, sizeof *area);
	m->weights = malloc((size_t)m->width * m->height * sizeof *m->weights);
	for (int j = 0; j < nv && area && m->weights; j++)
		for (int i = 0; i < nu; i++) {
			struct vec3 p, du, dv;
			double a = (i + 0.5) / nu, b = (j + 0.5) / nv;
			surface_tangents(s, (1 - a) * s->domain[0][0] + a * s->domain[0][1],
			                 (1 - b) * s->domain[1][0] + b * s->domain[1][1], &p, &du,
			                 &dv);
			area[j * nu + i] = vec3_length(vec3_cross(du, dv));
		}
	for (int y = 0; y < m->height && area && m->weights; y++)
		for (int x = 0; x < m->width; x++) {
			int i = (int)((int64_t)x * nu / m->width);
			int j = (int)((int64_t)(m->height - 1 - y) * nv / m->height);
			m->weights[(size_t)y * m->width + x] = (float)area[j * nu + i];
		}
	free(area);
}

/* The surface's own values, where no result gives them. */
static enum status own_values(struct map *m, const struct surface *s)
{
	const size_t n = (size_t)OWN_SIDE * OWN_SIDE;
	double lines[2][OWN_SIDE], *out[N_GRID_CHANNELS] = { NULL };
	double *room = malloc(N_QUANTITIES * n * sizeof *room);
	struct grid *grid = NULL;
	enum status st = room ? ST_OK : ST_RESOURCE;
	for (int k = 0; k < 2; k++)
		grid_lines(s->domain[k][0], s->domain[k][1], OWN_SIDE, lines[k]);
	for (int q = 0; q < N_QUANTITIES && room; q++)
		out[q] = room + (size_t)q * n;
	if (st == ST_OK)
		st = grid_create(&grid, s, lines[0], OWN_SIDE, lines[1], OWN_SIDE);
	if (st == ST_OK)
		st = grid_rows(grid, (1U << N_QUANTITIES) - 1, 0, OWN_SIDE, 0, OWN_SIDE, out);
	m->width = m->height = OWN_SIDE;
	for (int q = 0; q < N_QUANTITIES && st == ST_OK; q++) {
		m->values[q] = malloc(n * sizeof **m->values);
		if (!m->values[q]) {
			st = ST_RESOURCE;
			break;
		}
		for (int j = 0; j < OWN_SIDE; j++)
			for (int i = 0; i < OWN_SIDE; i++)
				m->values[q][(size_t)(OWN_SIDE - 1 - j) * OWN_SIDE + i] =
				        (float)out[q][(size_t)j * OWN_SIDE + i];
	}
	grid_destroy(grid);
	free(room);
	return st;
}

static enum status file_values(struct map *m, const char *path)
{
	struct exr_picture p;
	enum status st = live_read(&p, path);
	if (st != ST_OK)
		return st;
	m->width = p.width;
	m->height = p.height;
	for (int c = 0; c < p.n_channels; c++)
		for (int q = 0; q < N_QUANTITIES; q++)
			if (!strcmp(p.names[c], quantity_table[q].channel)) {
				m->values[q] = p.planes[c];
				p.planes[c] = NULL;
			}
	exr_picture_finish(&p);
	return ST_OK;
}

/* Bring a map up to date; its values are missing where its file is not there or is none. */
static enum status update(struct map *m, const struct shape *x, const char *file)
{
	int64_t stamp[3] = { 0 };
	const bool same = (file && m->file && !strcmp(file, m->file)) || (!file && !m->file);
	m->used = true;
	if (file)
		file_stamp(file, stamp);
	else
		stamp[0] = x->revision;
	if (same && m->width && !memcmp(stamp, m->stamp, sizeof stamp))
		return ST_OK;
	map_empty(m);
	memcpy(m->stamp, stamp, sizeof stamp);
	m->changes++;
	enum status st = ST_OK;
	if (file) {
		m->file = strdup(file);
		st = m->file ? ST_OK : ST_RESOURCE;
		if (st == ST_OK && file_values(m, file) != ST_OK)
			m->width = m->height = 1; /* known to have no values until it changes */
	} else {
		st = own_values(m, &x->surface);
	}
	if (st == ST_OK && m->width > 1)
		find_weights(m, &x->surface);
	return st;
}

/* Values and areas of all maps with that quantity in one list. */
static size_t collect(const struct drawing *d, int quantity, float **values, float **weights)
{
	size_t all = 0, n = 0;
	for (int i = 0; i < d->view->n_maps; i++)
		if (d->view->maps[i].used && d->view->maps[i].values[quantity])
			all += (size_t)d->view->maps[i].width * d->view->maps[i].height;
	const size_t step = 1 + all / FIT_MOST;
	*values = malloc((all / step + d->view->n_maps + 1) * sizeof **values);
	*weights = malloc((all / step + d->view->n_maps + 1) * sizeof **weights);
	for (int i = 0; i < d->view->n_maps && *values && *weights; i++) {
		const struct map *m = &d->view->maps[i];
		if (!m->used || !m->values[quantity])
			continue;
		for (size_t k = 0; k < (size_t)m->width * m->height; k += step) {
			(*values)[n] = m->values[quantity][k];
			(*weights)[n++] = m->weights ? m->weights[k] : 1;
		}
	}
	return n;
}

static void shares(struct key *k, const float *values, const float *weights, size_t n)
{
	double below = 0, above = 0, nothing = 0, sum = 0;
	for (size_t i = 0; i < n; i++) {
		if (isnan(values[i])) {
			nothing += weights[i];
			continue;
		}
		sum += weights[i];
		below += values[i] < k->map.lo ? weights[i] : 0;
		above += values[i] > k->map.hi ? weights[i] : 0;
	}
	/* a pole is no place */
	k->nothing = nothing > 1e-6 * (sum + nothing);
	k->below = sum > 0 ? below / sum : 0;
	k->above = sum > 0 ? above / sum : 0;
}

static void load_colors(struct view *v)
{
	float rgb[COLORS][3];
	for (int i = 0; i < COLORS; i++) {
		struct rgb c = colormap_at(&v->key.map, (double)i / (COLORS - 1));
		rgb[i][0] = (float)c.r, rgb[i][1] = (float)c.g, rgb[i][2] = (float)c.b;
	}
	if (!v->colors)
		glGenTextures(1, &v->colors);
	glBindTexture(GL_TEXTURE_2D, v->colors);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB16, COLORS, 1, 0, GL_RGB, GL_FLOAT, rgb);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/* What the colors depend on, as one number. */
static uint64_t colors_of(const struct drawing *d, int quantity, const struct overlay *o)
{
	struct {
		int quantity;
		enum colormap_scale scale;
		double lo, hi;
		uint64_t maps;
	} x;
	memset(&x, 0, sizeof x);
	x.quantity = quantity;
	x.scale = o ? o->scale : COLORMAP_AUTOMATIC;
	x.lo = o && o->range_given ? o->lo : 0;
	x.hi = o && o->range_given ? o->hi : 0;
	for (int i = 0; i < d->view->n_maps; i++)
		if (d->view->maps[i].used)
			x.maps = x.maps * 31 + (uint64_t)d->view->maps[i].thing * 1000003 +
			         d->view->maps[i].changes;
	return checksum_bytes(&x, sizeof x) | 1;
}

/* One map of colors for all things that show the quantity. */
static enum status find_colors(struct drawing *d, int quantity, const struct overlay *o)
{
	struct view *v = d->view;
	const uint64_t of = colors_of(d, quantity, o);
	v->key.theme = d->set;
	if (v->has_key && v->key_of == of)
		return ST_OK;
	float *values = NULL, *weights = NULL;
	const struct quantity_row *row = &quantity_table[quantity];
	size_t n = collect(d, quantity, &values, &weights);
	enum status st = values && weights ? ST_OK : ST_RESOURCE;
	v->key = (struct key){ .symbol = symbols[quantity], .theme = d->set };
	/* curvatures below this, in 1 / size, are rounding */
	double size = box_diagonal(&d->box);
	double zero = size > 0 ? 1e-9 / pow(size, row->power) : 0;
	if (st == ST_OK)
		st = colormap_fit(&v->key.map, row->is_signed, o ? o->scale : COLORMAP_AUTOMATIC,
		                  zero, values, weights, n);
	if (st == ST_OK && o && o->range_given && o->hi > o->lo)
		colormap_set_range(&v->key.map, o->lo, o->hi);
	if (st == ST_OK)
		shares(&v->key, values, weights, n);
	free(values);
	free(weights);
	if (st == ST_OK) {
		load_colors(v);
		v->has_key = true;
		v->key_of = of;
	}
	return st;
}

enum status maps_update(struct drawing *d)
{
	struct view *v = d->view;
	const struct overlay *first = NULL;
	int quantity = -1;
	enum status st = ST_OK;
	for (int i = 0; i < v->n_maps; i++)
		v->maps[i].used = false;
	for (int i = 0; i < d->n_shown && st == ST_OK; i++) {
		const struct Ful *f = d->things[i];
		const struct overlay *o = overlay_of(d->world, OVERLAY_MAP, f->id);
		const int q = map_quantity(d, o);
		if (f->entity.kind != ENTITY_SURFACE || f->display.look != LOOK_MAP || q < 0)
			continue;
		if (quantity < 0) {
			quantity = q;
			first = o;
		}
		struct map *m = find_map(v, f->id, true);
		st = m ? update(m, d->shown[i], o ? o->file : NULL) : ST_RESOURCE;
	}
	int n = 0;
	for (int i = 0; i < v->n_maps; i++)
		if (v->maps[i].used || world_by_id(d->world, v->maps[i].thing))
			v->maps[n++] = v->maps[i];
		else
			map_empty(&v->maps[i]);
	v->n_maps = n;
	d->has_map = quantity >= 0;
	v->has_key = v->has_key && d->has_map;
	if (st == ST_OK && d->has_map)
		st = find_colors(d, quantity, first);
	return st == ST_OK ? st : report_error(d->report, st, "cannot draw: memory ran out");
}

static void load_values(struct map *m, int q)
{
	static const float none = NAN;
	const bool is = m->values[q] != NULL;
	glGenTextures(1, &m->texture[q]);
	glBindTexture(GL_TEXTURE_2D, m->texture[q]);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, is ? m->width : 1, is ? m->height : 1, 0, GL_RED,
	             GL_FLOAT, is ? m->values[q] : &none);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void set_color(GLint at, struct rgb c)
{
	glUniform3f(at, (float)c.r, (float)c.g, (float)c.b);
}

bool map_use(struct drawing *d, int thing)
{
	const GLint *u = program_use(d->frame.programs, PROGRAM_SURFACE);
	const struct colormap *c = &d->view->key.map;
	struct map *m = find_map(d->view, thing, false);
	const int q = map_quantity(d, overlay_of(d->world, OVERLAY_MAP, thing));
	if (!m || q < 0)
		return false;
	if (!m->texture[q])
		load_values(m, q);
	const bool is = m->values[q] != NULL;
	const double lo = c->arsinh ? asinh(c->lo / c->knee) : c->lo;
	const double hi = c->arsinh ? asinh(c->hi / c->knee) : c->hi;
	glActiveTexture(GL_TEXTURE1);
	glBindTexture(GL_TEXTURE_2D, d->view->colors);
	glActiveTexture(GL_TEXTURE0);
	glBindTexture(GL_TEXTURE_2D, m->texture[q]);
	glUniform1i(u[UNIFORM_VALUES], 0);
	glUniform1i(u[UNIFORM_COLORS], 1);
	glUniform2i(u[UNIFORM_GRID], is ? m->width : 1, is ? m->height : 1);
	glUniform4f(u[UNIFORM_RANGE], (float)lo, (float)hi, c->arsinh ? (float)c->knee : 0, 0);
	set_color(u[UNIFORM_BELOW], colormap_below(c));
	set_color(u[UNIFORM_ABOVE], colormap_above(c));
	glUniform4f(u[UNIFORM_NOTHING], (float)colormap_nothing.r, (float)colormap_nothing.g,
	            (float)colormap_nothing.b, 1);
	return true;
}
