/* iges_format.c - writer of IGES 5.3: 126, 128, 116 and 106, their names (406 form 15) and colors (314);
 * trims are in iges_format_trims.c, groups in iges_format_groups.c. */
#include "iges_writer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "refine.h"

enum { DATA_COLUMNS = 64, SEQUENCE_MAX = 9999999, LINES_KEPT = 1 << 16 };

void iges_let_go(struct text *lines, FILE *to, size_t kept)
{
	if (!to || lines->n <= kept)
		return;
	fwrite(lines->s, 1, lines->n, to);
	text_reset(lines);
}

static void end_line(struct iges_writer *w)
{
	text_addf(&w->data, "%-*s%8dP%7d\n", DATA_COLUMNS, w->line.s ? w->line.s : "", w->de,
	          ++w->n_p);
	text_reset(&w->line);
	iges_let_go(&w->data, w->data_to, LINES_KEPT);
}

/* A parameter with its delimiter; it does not run over a line's end. */
static void put(struct iges_writer *w, const char *s, size_t n)
{
	if (w->line.n + n > DATA_COLUMNS)
		end_line(w);
	text_add_bytes(&w->line, s, n);
}

void iges_put_int(struct iges_writer *w, int x, char delimiter)
{
	char s[16];
	put(w, s, (size_t)snprintf(s, sizeof s, "%d%c", x, delimiter));
}

size_t iges_real_text(char out[IGES_REAL_SIZE], double x)
{
	char s[NUMBER_SIZE];
	size_t n = (size_t)number_write(s, x), m = 0;
	bool point = memchr(s, '.', n) != NULL;
	for (size_t i = 0; i < n; i++) {
		bool exponent = s[i] == 'e' || s[i] == 'E';
		if (exponent && !point)
			out[m++] = '.';
		point |= exponent;
		out[m++] = exponent ? 'E' : s[i];
	}
	if (!point)
		out[m++] = '.';
	out[m] = '\0';
	return m;
}

void iges_put_real(struct iges_writer *w, double x, char delimiter)
{
	char s[IGES_REAL_SIZE + 1];
	size_t n = iges_real_text(s, x);
	s[n++] = delimiter;
	put(w, s, n);
}

static void put_reals(struct iges_writer *w, const double *x, size_t n)
{
	for (size_t i = 0; i < n; i++)
		iges_put_real(w, x[i], ',');
}

/* A string runs over line ends, each of them full. What is no character becomes a blank. */
static void put_string(struct iges_writer *w, const char *s, char delimiter)
{
	char count[24];
	size_t n = strlen(s);
	put(w, count, (size_t)snprintf(count, sizeof count, "%zuH", n));
	for (; *s; s++)
		put(w, (unsigned char)*s < ' ' ? " " : s, 1);
	put(w, &delimiter, 1);
}

/* The two directory lines of an entity whose `lines` parameter lines end at the last one. */
static void put_entry(struct iges_writer *w, int type, int form, int lines, int color,
                      const char *status)
{
	text_addf(&w->directory, "%8d%8d%8d%8d%8d%8d%8d%8d%sD%7d\n", type, w->n_p - lines + 1, 0, 0,
	          0, 0, 0, 0, status, w->n_d + 1);
	text_addf(&w->directory, "%8d%8d%8d%8d%8d%8s%8s%8s%8dD%7d\n", type, 0, color, lines, form,
	          "", "", "", 0, w->n_d + 2);
	w->n_d += 2;
	iges_let_go(&w->directory, w->directory_to, LINES_KEPT);
}

static bool all_weights_equal(const double *points, size_t n)
{
	for (size_t i = 1; i < n; i++)
		if (points[4 * i + 3] != points[3])
			return false;
	return true;
}

static void put_point(struct iges_writer *w, const double *p)
{
	for (int k = 0; k < 3; k++)
		iges_put_real(w, p[3] == 1 ? p[k] : p[k] / p[3], ',');
}

/* Ends nearer than this part of the size are said to join. */
static const double closed_within = 1e-9;

static double curve_size(const struct curve *c)
{
	struct box b = box_empty();
	for (int i = 0; i < c->n; i++)
		box_add_point(&b, curve_get_point(c, i, NULL));
	return box_diagonal(&b);
}

/* The plane z = 0 is the only one told: its normal must then follow. */
static bool in_plane(const struct curve *c)
{
	for (int i = 0; i < c->n; i++)
		if (c->points[4 * (size_t)i + 2] != 0)
			return false;
	return true;
}

static void put_curve(struct iges_writer *w, const struct curve *c)
{
	bool planar = in_plane(c);
	const int head[] = { c->n - 1,
		             c->order - 1,
		             planar,
		             curve_closed(c, closed_within * curve_size(c)),
		             all_weights_equal(c->points, (size_t)c->n),
		             c->periodic };
	for (size_t i = 0; i < sizeof head / sizeof head[0]; i++)
		iges_put_int(w, head[i], ',');
	put_reals(w, c->knots, (size_t)c->n + c->order);
	for (int i = 0; i < c->n; i++)
		iges_put_real(w, c->points[4 * (size_t)i + 3], ',');
	for (int i = 0; i < c->n; i++)
		put_point(w, c->points + 4 * (size_t)i);
	put_reals(w, c->domain, 2);
	put_reals(w, (const double[]){ 0, 0 }, 2);
	iges_put_real(w, planar ? 1 : 0, ',');
}

static void put_surface(struct iges_writer *w, const struct surface *s)
{
	size_t n = (size_t)s->n[0] * s->n[1];
	double tolerance = closed_within * surface_size(s);
	const int head[] = { s->n[0] - 1,
		             s->n[1] - 1,
		             s->order[0] - 1,
		             s->order[1] - 1,
		             surface_closed(s, 0, tolerance),
		             surface_closed(s, 1, tolerance),
		             all_weights_equal(s->points, n),
		             s->periodic[0],
		             s->periodic[1] };
	for (size_t i = 0; i < sizeof head / sizeof head[0]; i++)
		iges_put_int(w, head[i], ',');
	for (int d = 0; d < 2; d++)
		put_reals(w, s->knots[d], (size_t)s->n[d] + s->order[d]);
	for (int j = 0; j < s->n[1]; j++)
		for (int i = 0; i < s->n[0]; i++)
			iges_put_real(w, s->points[4 * ((size_t)i * s->n[1] + j) + 3], ',');
	for (int j = 0; j < s->n[1]; j++)
		for (int i = 0; i < s->n[0]; i++)
			put_point(w, s->points + 4 * ((size_t)i * s->n[1] + j));
	put_reals(w, s->domain[0], 4);
}

int iges_begin(struct iges_writer *w, int type)
{
	w->from = w->n_p;
	w->de = w->n_d + 1;
	iges_put_int(w, type, ',');
	return w->de;
}

/* What stands behind the parameters: no associations, a name or none. */
void iges_end_form(struct iges_writer *w, int type, int form, int color, int name,
                   const char *status)
{
	iges_put_int(w, 0, ',');
	iges_put_int(w, name != 0, name ? ',' : ';');
	if (name)
		iges_put_int(w, name, ';');
	end_line(w);
	put_entry(w, type, form, w->n_p - w->from, color, status);
}

void iges_end(struct iges_writer *w, int type, int color, int name, const char *status)
{
	iges_end_form(w, type, 0, color, name, status);
}

/* The part as a number of percent with the fewest digits that read back as the same float. */
static double percent(float part)
{
	char digits[32];
	double x = 100.0 * part;
	for (int n = 6; n <= 9; n++) {
		snprintf(digits, sizeof digits, "%.*g", n, 100.0 * part);
		x = strtod(digits, NULL);
		if ((float)(x / 100) == part)
			break;
	}
	return x;
}

/* Helper entities, written before those that point to them. */
static int put_color(struct iges_writer *w, const float color[3])
{
	int de = iges_begin(w, 314);
	for (int i = 0; i < 3; i++)
		iges_put_real(w, percent(color[i]), i < 2 ? ',' : ';');
	end_line(w);
	put_entry(w, 314, 0, w->n_p - w->from, 0, "00000200");
	return de;
}

int iges_put_name(struct iges_writer *w, const char *name)
{
	int de = iges_begin(w, 406);
	iges_put_int(w, 1, ',');
	put_string(w, name, ';');
	end_line(w);
	put_entry(w, 406, 15, w->n_p - w->from, 0, "00010300");
	return de;
}

const struct curve *iges_curve_of(const struct entity *e)
{
	if (e->kind == ENTITY_CURVE)
		return &e->curve;
	return e->kind == ENTITY_CURVE_ON_SURFACE && e->space.order ? &e->space : NULL;
}

/* Readers that overlook the range U0 .. V1 must see what is meant too: a part is cut out. */
static enum status curve_meant(struct curve *out, const struct curve *c)
{
	if (c->domain[0] == c->knots[c->order - 1] && c->domain[1] == c->knots[c->n])
		return curve_copy(out, c);
	return curve_part(out, c, c->domain[0], c->domain[1]);
}

static enum status surface_meant(struct surface *out, const struct surface *s)
{
	bool whole = true;
	for (int d = 0; d < 2; d++)
		whole &= s->domain[d][0] == s->knots[d][s->order[d] - 1] &&
		         s->domain[d][1] == s->knots[d][s->n[d]];
	return whole ? surface_copy(out, s) : surface_part(out, s, s->domain);
}

/* The parameters of a curve or surface; false where there was no memory for them. */
static bool put_shape(struct iges_writer *w, const struct curve *curve,
                      const struct surface *surface)
{
	struct curve c = { 0 };
	struct surface s = { 0 };
	enum status st = curve ? curve_meant(&c, curve) : surface_meant(&s, surface);
	if (st == ST_OK && curve)
		put_curve(w, &c);
	else if (st == ST_OK)
		put_surface(w, &s);
	curve_finish(&c);
	surface_finish(&s);
	return st == ST_OK;
}

int iges_put_curve(struct iges_writer *w, const struct curve *c, const char *status)
{
	int de = iges_begin(w, 126);
	w->data.failed |= !put_shape(w, c, NULL);
	iges_end(w, 126, 0, 0, status);
	return de;
}

/* A point, or a list of them (106 form 2). */
static void put_points(struct iges_writer *w, const struct point_list *l, int color, int name)
{
	const bool one = l->n == 1;
	iges_begin(w, one ? 116 : 106);
	if (!one) {
		iges_put_int(w, 2, ',');
		iges_put_int(w, l->n, ',');
	}
	put_reals(w, l->values, (size_t)3 * (size_t)l->n);
	if (one)
		iges_put_int(w, 0, ','); /* no symbol */
	iges_end_form(w, one ? 116 : 106, one ? 0 : 2, color, name, "00000000");
}

/* Gives the directory entry of the shape, 0 for what is not written. */
static int put_entity(struct iges_writer *w, const struct entity *e)
{
	const struct curve *curve = iges_curve_of(e);
	if (!iges_holds(e))
		return 0;
	bool trimmed = e->kind == ENTITY_SURFACE && e->trim.n;
	int type = curve ? 126 : 128;
	int color = e->has_color ? -put_color(w, e->color) : 0;
	int name = e->name && e->name[0] ? iges_put_name(w, e->name) : 0;
	int de = w->n_d + 1;
	if (e->kind == ENTITY_POINTS) {
		put_points(w, &e->points, color, name);
	} else {
		iges_begin(w, type);
		w->data.failed |= !put_shape(w, curve, &e->geometry);
		iges_end(w, type, color, trimmed ? 0 : name, trimmed ? "00010000" : "00000000");
	}
	if (trimmed)
		w->data.failed |= iges_put_trims(w, e, de, color, name) != ST_OK;
	else
		iges_join_group(w, e, de);
	return de;
}

/* A curve on a surface that is written too. */
static void put_on_surface(struct iges_writer *w, const struct entity *e, int base)
{
	int color = e->has_color ? -put_color(w, e->color) : 0;
	int name = e->name && e->name[0] ? iges_put_name(w, e->name) : 0;
	int uv = iges_put_curve(w, &e->curve, "00010500");
	int space = iges_put_curve(w, &e->space, "00010000");
	int de = iges_put_curve_on_surface(w, base, uv, space, color, name, "00000000");
	iges_join_group(w, e, de);
}

static bool lies_on_one(const struct model *m, const struct entity *e)
{
	return e->kind == ENTITY_CURVE_ON_SURFACE && e->space.order && e->surface >= 0 &&
	       e->surface < m->n && m->entities[e->surface].kind == ENTITY_SURFACE;
}

static enum status put_entities(struct iges_writer *w, const struct model *m)
{
	int *shape = calloc((size_t)m->n + 1, sizeof *shape);
	if (!shape)
		return ST_RESOURCE;
	for (int i = 0; i < m->n; i++)
		if (!lies_on_one(m, &m->entities[i]))
			shape[i] = put_entity(w, &m->entities[i]);
	for (int i = 0; i < m->n; i++)
		if (lies_on_one(m, &m->entities[i]))
			put_on_surface(w, &m->entities[i], shape[m->entities[i].surface]);
	free(shape);
	return ST_OK;
}

bool iges_holds(const struct entity *e)
{
	return e->kind == ENTITY_CURVE || e->kind == ENTITY_SURFACE ||
	       (e->kind == ENTITY_CURVE_ON_SURFACE && e->space.order > 0) ||
	       (e->kind == ENTITY_POINTS && e->points.dimension == 3 && e->points.n > 0);
}

bool iges_put_model(struct iges_writer *w, const struct model *m)
{
	w->data.failed |= put_entities(w, m) != ST_OK;
	iges_put_groups(w);
	return !w->directory.failed && !w->data.failed && !w->line.failed &&
	       w->n_p <= SEQUENCE_MAX && w->n_d <= SEQUENCE_MAX;
}
