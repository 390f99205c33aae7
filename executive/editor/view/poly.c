/* poly.c - curves made into chords no farther from them than asked. */
#include "poly.h"

#include <stdlib.h>

#include "refine.h"

enum {
	DEPTH_MAX = 12,      /* halvings of a piece */
	TRIMMED_PIECES = 32, /* of a span, so that small holes are not stepped over */
	BISECTIONS = 44,     /* until the place where a trim begins is known to the digit */
};

void poly_finish(struct poly *p)
{
	free(p->v);
	free(p->t);
	*p = (struct poly){ .v = NULL };
}

void poly_reset(struct poly *p, struct vec3 origin)
{
	p->n = 0;
	p->open = p->failed = false;
	p->origin = origin;
}

static void append(struct poly *p, struct poly_vertex v, double t)
{
	if (p->n == p->room) {
		const int room = p->room ? 2 * p->room : 16;
		struct poly_vertex *more = reallocarray(p->v, (size_t)room, sizeof *more);
		if (more)
			p->v = more;
		double *places = reallocarray(p->t, (size_t)room, sizeof *places);
		if (places)
			p->t = places;
		if (!more || !places) {
			p->failed = true;
			return;
		}
		p->room = room;
	}
	p->v[p->n] = v;
	p->t[p->n++] = t;
}

void poly_add(struct poly *p, struct vec3 at, double t)
{
	struct poly_vertex v = { (float)(at.x - p->origin.x), (float)(at.y - p->origin.y),
		                 (float)(at.z - p->origin.z), -1 };
	if (!p->open)
		append(p, v, t);
	p->open = true;
	v.part = 0;
	append(p, v, t);
}

void poly_end(struct poly *p)
{
	if (p->open && !p->failed) {
		struct poly_vertex v = p->v[p->n - 1];
		v.part = -1;
		append(p, v, p->t[p->n - 1]);
	}
	p->open = false;
}

static double distance(struct vec3 p, struct vec3 a, struct vec3 b)
{
	struct vec3 d = vec3_sub(b, a), e = vec3_sub(p, a);
	double l = vec3_dot(d, d), s = l > 0 ? vec3_dot(e, d) / l : 0;
	return vec3_length(vec3_along(e, -fmin(fmax(s, 0), 1), d));
}

/* Points behind t0 up to t1. */
static void add_between(struct poly *p, const struct poly_line *line, double t0, struct vec3 a,
                        double t1, struct vec3 b, int depth)
{
	double step = (t1 - t0) / 4;
	struct vec3 q[3];
	double away = 0;
	for (int i = 0; i < 3; i++) {
		q[i] = line->point(line->data, t0 + (i + 1) * step);
		away = fmax(away, distance(q[i], a, b));
	}
	if (away > line->tolerance && depth < DEPTH_MAX) {
		add_between(p, line, t0, a, t0 + 2 * step, q[1], depth + 1);
		add_between(p, line, t0 + 2 * step, q[1], t1, b, depth + 1);
		return;
	}
	poly_add(p, b, t1);
}

static void add_piece(struct poly *p, const struct poly_line *line, double t0, double t1)
{
	struct vec3 a = line->point(line->data, t0), b = line->point(line->data, t1);
	if (!p->open)
		poly_add(p, a, t0);
	if (line->segments)
		poly_add(p, b, t1);
	else
		add_between(p, line, t0, a, t1, b, 0);
}

/* Where it begins or ends to count, between t0 and t1. */
static double find_change(const struct poly_line *line, double t0, double t1, bool in)
{
	for (int i = 0; i < BISECTIONS; i++) {
		double middle = t0 + (t1 - t0) / 2;
		if (line->inside(line->data, middle) == in)
			t0 = middle;
		else
			t1 = middle;
	}
	return t0 + (t1 - t0) / 2;
}

static void add_span(struct poly *p, const struct poly_line *line, double t0, double t1, int pieces)
{
	if (!line->inside) {
		for (int i = 0; i < pieces; i++)
			add_piece(p, line, t0 + (t1 - t0) * i / pieces,
			          i + 1 == pieces ? t1 : t0 + (t1 - t0) * (i + 1) / pieces);
		return;
	}
	if (pieces < TRIMMED_PIECES && !line->segments)
		pieces = TRIMMED_PIECES;
	double at = t0;
	bool in = line->inside(line->data, t0);
	for (int i = 0; i < pieces; i++) {
		double next = i + 1 == pieces ? t1 : t0 + (t1 - t0) * (i + 1) / pieces;
		bool now = line->inside(line->data, next);
		if (now != in) {
			double change = find_change(line, at, next, in);
			if (in) {
				add_piece(p, line, at, change);
				poly_end(p);
			} else {
				add_piece(p, line, change, next);
			}
		} else if (in) {
			add_piece(p, line, at, next);
		}
		at = next;
		in = now;
	}
}

/* Spans may be many more than it takes: leave out what the chords between others are near to. */
static void thin_out(struct poly *p, int first, double tolerance)
{
	enum { REACH = 32 };
	int n = first + 1;
	for (int anchor = first; anchor + 1 < p->n;) {
		int next = anchor + 1;
		for (int far = anchor + 2; far < p->n && far - anchor <= REACH; far++) {
			bool near = p->v[far].part >= 0 && p->v[anchor].part >= 0;
			for (int k = anchor + 1; k < far && near; k++)
				near = p->v[k].part >= 0 &&
				       distance(poly_at(p, k), poly_at(p, anchor),
				                poly_at(p, far)) <= tolerance;
			if (!near)
				break;
			next = far;
		}
		p->v[n] = p->v[next];
		p->t[n++] = p->t[next];
		anchor = next;
	}
	p->n = n;
}

void poly_add_line(struct poly *p, const struct poly_line *line)
{
	const double *b = line->breaks;
	const int first = p->n;
	if (line->segments)
		add_span(p, line, b[0], b[line->n_breaks - 1], line->segments);
	else
		for (int i = 0; i + 1 < line->n_breaks; i++)
			add_span(p, line, b[i], b[i + 1], 1);
	poly_end(p);
	if (!line->segments && !p->failed && p->n > first)
		thin_out(p, first, line->tolerance);
}

void poly_thin(struct poly *out, const struct poly *p, double tolerance)
{
	poly_reset(out, p->origin);
	for (int i = 0; i < p->n; i++)
		append(out, p->v[i], p->t[i]);
	if (!out->failed && out->n)
		thin_out(out, 0, tolerance);
}

double *poly_breaks(const struct curve *c, int *n)
{
	double *breaks = malloc(((size_t)c->n + 2) * sizeof *breaks);
	if (breaks)
		*n = knots_breaks(c->order, c->n, c->knots, c->domain[0], c->domain[1], breaks);
	return breaks;
}

static struct vec3 space_point(const void *data, double t)
{
	return curve_point(data, t);
}

static void add_by_breaks(struct poly *p, struct poly_line *line, const struct curve *c)
{
	double *breaks = poly_breaks(c, &line->n_breaks);
	line->breaks = breaks;
	if (breaks)
		poly_add_line(p, line);
	else
		p->failed = true;
	free(breaks);
}

void poly_add_curve(struct poly *p, const struct curve *c, int segments, double tolerance)
{
	struct poly_line line = {
		.point = space_point, .data = c, .segments = segments, .tolerance = tolerance
	};
	add_by_breaks(p, &line, c);
}

struct curve_on {
	const struct curve *uv;
	const struct surface *surface;
};

static double clamp_to(double x, const double range[2])
{
	return fmin(fmax(x, range[0]), range[1]);
}

static struct vec3 on_point(const void *data, double t)
{
	const struct curve_on *c = data;
	struct vec3 uv = curve_point(c->uv, t);
	return surface_point(c->surface, clamp_to(uv.x, c->surface->domain[0]),
	                     clamp_to(uv.y, c->surface->domain[1]));
}

void poly_add_curve_on(struct poly *p, const struct curve *uv, const struct surface *s,
                       int segments, double tolerance)
{
	struct curve_on on = { uv, s };
	struct poly_line line = {
		.point = on_point, .data = &on, .segments = segments, .tolerance = tolerance
	};
	add_by_breaks(p, &line, uv);
}

struct isoparametric {
	const struct curve *line;
	const struct trim_test *trim;
	int d;
	double t;
};

static struct vec3 isoparametric_point(const void *data, double t)
{
	const struct isoparametric *i = data;
	return curve_point(i->line, t);
}

static bool isoparametric_inside(const void *data, double t)
{
	const struct isoparametric *i = data;
	return trim_test_inside(i->trim, i->d ? t : i->t, i->d ? i->t : t);
}

void poly_add_isoparametric(struct poly *p, const struct surface *s, const struct trim_test *trim,
                            int d, double t, int segments, double tolerance)
{
	struct curve c = { 0 };
	struct isoparametric i = { &c, trim, d, t };
	struct poly_line line = { .point = isoparametric_point,
		                  .inside = trim ? isoparametric_inside : NULL,
		                  .data = &i,
		                  .segments = segments,
		                  .tolerance = tolerance };
	if (surface_isoparametric(&c, s, d, t) == ST_OK)
		add_by_breaks(p, &line, &c);
	else
		p->failed = true;
	curve_finish(&c);
}
