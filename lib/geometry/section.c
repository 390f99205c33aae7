/* section.c - plane figures by Green's theorem: integrals along the border give what is inside. */
#include "section.h"

#include <math.h>
#include <stdlib.h>

#include "bezier.h"
#include "gauss.h"

enum { HALVINGS = 12, WINDING_DEPTH = 60 };

/* What is added up along the border. */
struct sums {
	double area, girth;
	struct vec3 moment;
};

struct walk {
	struct vec3 normal, origin; /* origin: on the border, so that terms are small */
	const struct section_lid *lid;
	double accuracy, scale;
	struct sums sums;
	double closing;
};

static double above(const struct walk *w, struct vec3 p)
{
	return w->lid ? vec3_dot(p, w->lid->up) - w->lid->height : -1;
}

/* What is too high lies in the lid: the border then runs there and back, round nothing. */
static struct vec3 pressed(const struct walk *w, struct vec3 p)
{
	double high = above(w, p);
	return high > 0 ? vec3_along(p, -high, w->lid->up) : p;
}

static void sums_add(struct sums *to, struct sums x)
{
	to->area += x.area;
	to->girth += x.girth;
	to->moment = vec3_add(to->moment, x.moment);
}

static struct sums quadrature(const struct walk *w, const struct curve *c, double a, double b)
{
	struct sums s = { 0 };
	const double half = 0.5 * (b - a);
	for (int i = 0; i < GAUSS; i++) {
		struct vec3 d[2];
		curve_derivatives(c, a + half * (1 + gauss_node[i]), 1, d);
		const double weight = half * gauss_weight[i];
		if (above(w, d[0]) > 0)
			d[1] = vec3_along(d[1], -vec3_dot(d[1], w->lid->up), w->lid->up);
		else
			s.girth += weight * vec3_length(d[1]);
		struct vec3 r = vec3_sub(pressed(w, d[0]), w->origin);
		double turn = weight * vec3_dot(w->normal, vec3_cross(r, d[1]));
		s.area += turn / 2;
		s.moment = vec3_along(s.moment, turn / 3, r);
	}
	return s;
}

static bool settled(const struct walk *w, const struct sums *a, const struct sums *b)
{
	const double l = w->scale, e = w->accuracy;
	return fabs(a->girth - b->girth) <= e * l && fabs(a->area - b->area) <= e * l * l &&
	       vec3_length(vec3_sub(a->moment, b->moment)) <= e * l * l * l;
}

static void curve_walk(struct walk *w, struct sums *to, const struct curve *c, double a, double b,
                       struct sums whole, int depth)
{
	const double mid = 0.5 * (a + b);
	struct sums left = quadrature(w, c, a, mid), right = quadrature(w, c, mid, b), both = left;
	sums_add(&both, right);
	if (depth == 0 || settled(w, &both, &whole)) {
		sums_add(to, both);
		return;
	}
	curve_walk(w, to, c, a, mid, left, depth - 1);
	curve_walk(w, to, c, mid, b, right, depth - 1);
}

/* The border's kinks: ends of spans and where it comes through the lid, rising. */
static enum status breaks_make(const struct walk *w, const struct curve *c, double **out, int *n)
{
	double *t = NULL;
	int k = 0;
	enum status st = w->lid ? curve_crossings(c, w->lid->up, w->lid->height, &t, &k) : ST_OK;
	if (st != ST_OK)
		return st;
	double *b = malloc(sizeof *b * (c->n + 2 + (size_t)k));
	if (!b) {
		free(t);
		return ST_RESOURCE;
	}
	int m = knots_breaks(c->order, c->n, c->knots, c->domain[0], c->domain[1], b);
	for (int i = 0; i < k; i++) {
		int at = m++;
		for (; at > 0 && b[at - 1] > t[i]; at--)
			b[at] = b[at - 1];
		b[at] = t[i];
	}
	free(t);
	*out = b;
	*n = m;
	return ST_OK;
}

static enum status side_walk(struct walk *w, const struct section_side *side)
{
	double *b;
	int n;
	struct sums sums = { 0 };
	enum status st = breaks_make(w, side->curve, &b, &n);
	if (st != ST_OK)
		return st;
	for (int i = 0; i + 1 < n; i++)
		if (b[i] < b[i + 1])
			curve_walk(w, &sums, side->curve, b[i], b[i + 1],
			           quadrature(w, side->curve, b[i], b[i + 1]), HALVINGS);
	free(b);
	if (side->reversed) {
		sums.area = -sums.area;
		sums.moment = vec3_scale(sums.moment, -1);
	}
	sums_add(&w->sums, sums);
	return ST_OK;
}

/* A straight line from a to b, bent where it comes through the lid. */
static void line_walk(struct walk *w, struct vec3 a, struct vec3 b)
{
	const double ha = above(w, a), hb = above(w, b);
	struct vec3 p[3] = { a, a, b };
	if ((ha > 0) != (hb > 0))
		p[1] = vec3_along(a, ha / (ha - hb), vec3_sub(b, a));
	for (int i = 0; i < 2; i++) {
		if (!(above(w, vec3_scale(vec3_add(p[i], p[i + 1]), 0.5)) > 0))
			w->closing += vec3_length(vec3_sub(p[i + 1], p[i]));
		struct vec3 q = vec3_sub(pressed(w, p[i]), w->origin);
		struct vec3 r = vec3_sub(pressed(w, p[i + 1]), w->origin);
		const double turn = vec3_dot(w->normal, vec3_cross(q, r));
		w->sums.area += turn / 2;
		w->sums.moment = vec3_along(w->sums.moment, turn / 6, vec3_add(q, r));
	}
}

static struct vec3 side_end(const struct section_side *s, bool last)
{
	return curve_point(s->curve, s->curve->domain[s->reversed != last]);
}

/* Length of all sides, roughly, the part above the lid too. */
static double size_find(const struct walk *w, const struct section_side *sides, int n)
{
	struct walk whole = *w;
	double sum = 0;
	whole.lid = NULL;
	for (int i = 0; i < n; i++) {
		const struct curve *c = sides[i].curve;
		sum += quadrature(&whole, c, c->domain[0], c->domain[1]).girth;
	}
	return sum;
}

enum status section_measure(const struct section_side *sides, int n, struct vec3 normal,
                            const struct section_lid *lid, double accuracy, struct section *out)
{
	struct walk w = { .normal = normal, .lid = lid, .accuracy = accuracy };
	enum status st = ST_OK;
	*out = (struct section){ .centroid = { NAN, NAN, NAN } };
	if (n < 1)
		return ST_OK;
	w.origin = pressed(&w, side_end(&sides[0], false));
	w.scale = size_find(&w, sides, n);
	for (int i = 0; st == ST_OK && i < n; i++) {
		st = side_walk(&w, &sides[i]);
		line_walk(&w, side_end(&sides[i], true), side_end(&sides[(i + 1) % n], false));
	}
	if (st != ST_OK)
		return st;
	out->area = w.sums.area;
	out->girth = w.sums.girth;
	out->closing = w.closing;
	out->moment = vec3_along(w.sums.moment, w.sums.area, w.origin);
	if (w.sums.area != 0)
		out->centroid = vec3_along(w.origin, 1 / w.sums.area, w.sums.moment);
	return ST_OK;
}

/* The plane's axes, seen from the tip of its normal, and the place looked from. */
struct look {
	struct vec3 x, y, p;
};

static double angle(const double a[2], const double b[2])
{
	return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

/* Do all points lie on one side of p? Then so does the span, and its ends tell its angle. */
static bool one_side(const double (*q)[3], int n)
{
	double x = 0, y = 0;
	for (int i = 0; i < n; i++) {
		double l = hypot(q[i][0], q[i][1]);
		x += l > 0 ? q[i][0] / l : 0;
		y += l > 0 ? q[i][1] / l : 0;
	}
	for (int i = 0; i < n; i++)
		if (!(q[i][0] * x + q[i][1] * y > 0))
			return false;
	return true;
}

static double span_angle(const double (*q)[3], int n, int depth)
{
	double left[ORDER_MAX][3], right[ORDER_MAX][3];
	if (depth == 0 || one_side(q, n))
		return angle(q[0], q[n - 1]);
	for (int i = 0; i < n; i++)
		for (int d = 0; d < 3; d++)
			left[i][d] = q[i][d];
	for (int k = 0; k < n; k++)
		for (int d = 0; d < 3; d++) {
			right[n - 1 - k][d] = left[n - 1][d];
			for (int i = n - 1; i > k; i--)
				left[i][d] = 0.5 * (left[i - 1][d] + left[i][d]);
		}
	return span_angle((const double(*)[3])left, n, depth - 1) +
	       span_angle((const double(*)[3])right, n, depth - 1);
}

static enum status curve_angle(const struct look *l, const struct curve *c, double *out)
{
	struct bezier_chain chain;
	enum status st = bezier_chain_init(&chain, c);
	if (st != ST_OK)
		return st;
	*out = 0;
	for (int s = 0; s < chain.spans; s++) {
		double q[ORDER_MAX][3];
		const double *h = chain.points + (size_t)4 * c->order * s;
		for (int i = 0; i < c->order; i++, h += 4) {
			struct vec3 r = vec3_along(vec3(h[0], h[1], h[2]), -h[3], l->p);
			q[i][0] = vec3_dot(r, l->x);
			q[i][1] = vec3_dot(r, l->y);
			q[i][2] = h[3];
		}
		*out += span_angle((const double(*)[3])q, c->order, WINDING_DEPTH);
	}
	bezier_chain_finish(&chain);
	return ST_OK;
}

enum status section_winding(const struct section_side *sides, int n, struct vec3 normal,
                            struct vec3 p, int *out)
{
	struct vec3 a = fabs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
	struct look l = { .y = vec3_unit(vec3_cross(normal, a)), .p = p };
	l.x = vec3_cross(l.y, normal);
	double sum = 0;
	for (int i = 0; i < n; i++) {
		double turn;
		enum status st = curve_angle(&l, sides[i].curve, &turn);
		if (st != ST_OK)
			return st;
		sum += sides[i].reversed ? -turn : turn;
		struct vec3 q = vec3_sub(side_end(&sides[i], true), p);
		struct vec3 r = vec3_sub(side_end(&sides[(i + 1) % n], false), p);
		sum += angle((double[2]){ vec3_dot(q, l.x), vec3_dot(q, l.y) },
		             (double[2]){ vec3_dot(r, l.x), vec3_dot(r, l.y) });
	}
	*out = (int)lrint(sum / (2 * M_PI));
	return ST_OK;
}
