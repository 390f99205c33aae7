/* hermite.c - a function of one parameter as a piecewise cubic, halved where it must be. */
#include "hermite.h"

#include <stdlib.h>

/* more than these no curve of a face needs; a damaged one would take for ever */
enum { PIECES_MOST = 400 };
enum { LOOKS = 3 /* at quarters of a span */ };

/* Spans are not halved below this part of the whole. */
static const double least_span = 1e-3;

struct pieces {
	double *t;           /* owned; ends of spans */
	struct vec3 *points; /* owned; three a span and one */
	int n, room;         /* spans */
	double whole, worst;
};

static enum status add_span(struct pieces *p, const struct hermite_node *a,
                            const struct hermite_node *b)
{
	double h = b->t - a->t;
	if (p->n == p->room) {
		int room = p->room ? 2 * p->room : 8;
		double *t = reallocarray(p->t, (size_t)room + 1, sizeof *t);
		if (t)
			p->t = t;
		struct vec3 *q = reallocarray(p->points, 3 * (size_t)room + 1, sizeof *q);
		if (q)
			p->points = q;
		if (!t || !q)
			return ST_RESOURCE;
		p->room = room;
	}
	struct vec3 *q = p->points + 3 * (size_t)p->n;
	if (p->n == 0) {
		p->t[0] = a->t;
		q[0] = a->point;
	}
	q[1] = vec3_along(q[0], h / 3, a->out);
	q[2] = vec3_along(b->point, -h / 3, b->in);
	q[3] = b->point;
	p->t[++p->n] = b->t;
	return ST_OK;
}

/* The cubic between two nodes at the share s of its span. */
static struct vec3 cubic(const struct hermite_node *a, const struct hermite_node *b, double s)
{
	double h = b->t - a->t, r = 1 - s;
	struct vec3 p = vec3_scale(a->point, r * r * (1 + 2 * s));
	p = vec3_along(p, s * s * (3 - 2 * s), b->point);
	p = vec3_along(p, h * r * r * s, a->out);
	return vec3_along(p, -h * s * s * r, b->in);
}

static enum status fit_span(const struct hermite *h, const struct hermite_node *a,
                            const struct hermite_node *b, struct pieces *p)
{
	struct hermite_node middle = { 0 };
	double off = 0;
	for (int k = LOOKS; k > 0; k--) {
		int place = k == 1 ? 2 : k == 2 ? 1 : 3; /* the middle last, to be kept */
		double s = place / 4.0;
		struct vec3 candidate = cubic(a, b, s);
		middle = (struct hermite_node){ .t = a->t + s * (b->t - a->t) };
		h->at(h->data, a->t, b->t, candidate, &middle);
		off = fmax(off, h->off(h->data, &middle, candidate));
	}
	if (!(off > h->tolerance) || b->t - a->t <= least_span * p->whole || p->n >= PIECES_MOST) {
		p->worst = fmax(p->worst, off);
		return add_span(p, a, b);
	}
	enum status st = fit_span(h, a, &middle, p);
	return st == ST_OK ? fit_span(h, &middle, b, p) : st;
}

static enum status make_curve(const struct pieces *p, struct curve *out)
{
	enum status st = curve_init(out, 4, 3 * p->n + 1);
	if (st != ST_OK)
		return st;
	for (int i = 0; i <= p->n; i++)
		for (int k = 0; k < 3; k++)
			out->knots[1 + 3 * i + k] = p->t[i];
	out->knots[0] = out->domain[0] = p->t[0];
	out->knots[out->n + 3] = out->domain[1] = p->t[p->n];
	for (int i = 0; i < out->n; i++)
		curve_set_point(out, i, p->points[i], 1);
	return ST_OK;
}

enum status hermite_breaks(const struct curve *c, int least, double **out, int *n)
{
	double *b = calloc((size_t)c->n + 2, sizeof *b);
	if (!b)
		return ST_RESOURCE;
	int spans = knots_breaks(c->order, c->n, c->knots, c->domain[0], c->domain[1], b) - 1;
	int each = (least + spans - 1) / spans;
	*n = spans * each + 1;
	*out = calloc((size_t)*n, sizeof **out);
	for (int i = 0; *out && i < *n; i++) {
		int k = i / each < spans ? i / each : spans - 1;
		(*out)[i] = b[k] + (b[k + 1] - b[k]) * (i - k * each) / each;
	}
	free(b);
	return *out ? ST_OK : ST_RESOURCE;
}

enum status hermite_fit(const struct hermite *h, const double *breaks, int n, struct vec3 first,
                        struct curve *out, double *worst)
{
	struct pieces p = { .whole = breaks[n - 1] - breaks[0] };
	struct vec3 at = first;
	enum status st = ST_OK;
	for (int i = 0; i + 1 < n && st == ST_OK; i++) {
		struct hermite_node a = { .t = breaks[i] }, b = { .t = breaks[i + 1] };
		h->at(h->data, a.t, b.t, at, &a);
		if (i > 0)
			a.point = at;
		h->at(h->data, a.t, b.t, a.point, &b);
		at = b.point;
		st = fit_span(h, &a, &b, &p);
	}
	if (st == ST_OK)
		st = make_curve(&p, out);
	*worst = p.worst;
	free(p.t);
	free(p.points);
	return st;
}
