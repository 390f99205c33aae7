/* project.c - curves in space brought down to a surface's u,v plane, and lifted from it. */
#include "project.h"

#include <stdlib.h>
#include <string.h>

#include "hermite.h"
#include "on_surface.h"
#include "refine.h"

enum {
	GRID_MAX = 96,   /* samples of the surface in a direction, at most */
	SEEDS = 8,       /* of them, the nearest are tried */
	STEPS_MAX = 40,  /* of Newton's method */
	HALVINGS = 6,    /* of one step that leads away */
	SPANS_LEAST = 8, /* of a curve that is followed */
};

static const double closed_within = 1e-9; /* of the size */
static const double at_pole = 1e-7;       /* length of a derivative times its range, of the size */
static const double settled = 1e-11;      /* of the size: a step that ends the search */
static const double aside = 1e-3;         /* of a span: where a direction at a pole is looked up */

struct projector {
	const struct surface *s; /* borrowed */
	double size, period[2];
	bool flat;              /* a parallelogram, linear in u and v */
	double down[3][4];      /* of a flat one: space to u, v, distance */
	double up[3][4];        /* u, v to space */
	int n[2];               /* grid, made when first needed */
	double *at[2];          /* owned, its parameters */
	struct vec3 *points;    /* owned, n[0] x n[1] */
	const struct curve *c;  /* being followed */
	double near;            /* distance within which its points are expected */
	double reach, farthest; /* beyond which it is given up; the largest found */
	bool failed;            /* no memory */
};

/* ---- parallelograms */

static void find_flat(struct projector *p)
{
	const struct surface *s = p->s;
	if (s->order[0] != 2 || s->order[1] != 2 || s->n[0] != 2 || s->n[1] != 2 || s->rational)
		return;
	const double *k[2] = { s->knots[0] + 1, s->knots[1] + 1 };
	struct vec3 o = surface_get_point(s, 0, 0, NULL);
	struct vec3 a = vec3_sub(surface_get_point(s, 1, 0, NULL), o);
	struct vec3 b = vec3_sub(surface_get_point(s, 0, 1, NULL), o);
	struct vec3 d = vec3_sub(surface_get_point(s, 1, 1, NULL), o);
	if (vec3_length(vec3_sub(d, vec3_add(a, b))) > 1e-13 * p->size)
		return;
	a = vec3_scale(a, 1 / (k[0][1] - k[0][0]));
	b = vec3_scale(b, 1 / (k[1][1] - k[1][0]));
	double aa = vec3_dot(a, a), ab = vec3_dot(a, b), bb = vec3_dot(b, b);
	double det = aa * bb - ab * ab;
	if (!(det > 1e-12 * aa * bb))
		return;
	const struct vec3 row[3] = {
		vec3_scale(vec3_along(vec3_scale(a, bb), -ab, b), 1 / det),
		vec3_scale(vec3_along(vec3_scale(b, aa), -ab, a), 1 / det),
		vec3_unit(vec3_cross(a, b)),
	};
	const double shift[3] = { k[0][0], k[1][0], 0 };
	for (int i = 0; i < 3; i++) {
		p->down[i][0] = row[i].x;
		p->down[i][1] = row[i].y;
		p->down[i][2] = row[i].z;
		p->down[i][3] = shift[i] - vec3_dot(row[i], o);
	}
	struct vec3 zero = vec3_along(vec3_along(o, -shift[0], a), -shift[1], b);
	const double up[3][4] = { { a.x, b.x, 0, zero.x },
		                  { a.y, b.y, 0, zero.y },
		                  { a.z, b.z, 0, zero.z } };
	memcpy(p->up, up, sizeof up);
	p->flat = true;
}

static enum status project_flat(const struct projector *p, const struct curve *c, struct curve *out,
                                double *distance)
{
	enum status st = curve_copy(out, c);
	if (st != ST_OK)
		return st;
	curve_transform(out, p->down);
	for (int i = 0; i < out->n; i++) {
		double *q = out->points + 4 * (size_t)i;
		*distance = fmax(*distance, fabs(q[2] / q[3]));
		q[2] = 0;
	}
	return ST_OK;
}

/* ---- nearest points */

static double inside(const struct projector *p, int d, double x)
{
	const double *domain = p->s->domain[d];
	if (p->period[d] > 0)
		x -= p->period[d] * floor((x - domain[0]) / p->period[d]);
	return fmin(fmax(x, domain[0]), domain[1]);
}

static struct vec3 point_at(const struct projector *p, struct vec3 uv)
{
	return surface_point(p->s, inside(p, 0, uv.x), inside(p, 1, uv.y));
}

/* Least squares a du + b dv = r; a direction that leads nowhere stays. */
static void solve(const struct projector *p, struct vec3 du, struct vec3 dv, struct vec3 r,
                  double out[2])
{
	double aa = vec3_dot(du, du), ab = vec3_dot(du, dv), bb = vec3_dot(dv, dv);
	double ar = vec3_dot(du, r), br = vec3_dot(dv, r), det = aa * bb - ab * ab;
	const double *u = p->s->domain[0], *v = p->s->domain[1];
	double least = at_pole * p->size;
	bool no_u = sqrt(aa) * (u[1] - u[0]) <= least, no_v = sqrt(bb) * (v[1] - v[0]) <= least;
	out[0] = out[1] = 0;
	if (no_u || no_v || !(det > 1e-14 * aa * bb)) {
		if (!no_u && (no_v || aa >= bb))
			out[0] = ar / aa;
		else if (!no_v)
			out[1] = br / bb;
		return;
	}
	out[0] = (ar * bb - br * ab) / det;
	out[1] = (br * aa - ar * ab) / det;
}

/* From *uv to the nearest point that downhill leads to; gives its distance. The residual is small
 * for curves that lie on the surface, so Gauss-Newton converges as Newton does. */
static double descend(const struct projector *p, struct vec3 x, struct vec3 *uv)
{
	struct vec3 q, du, dv;
	double best = INFINITY;
	for (int d = 0; d < 2; d++) {
		double *w = d ? &uv->y : &uv->x;
		if (p->period[d] == 0)
			*w = inside(p, d, *w);
	}
	for (int i = 0; i < STEPS_MAX; i++) {
		double step[2];
		surface_tangents(p->s, inside(p, 0, uv->x), inside(p, 1, uv->y), &q, &du, &dv);
		struct vec3 r = vec3_sub(x, q);
		best = vec3_length(r);
		solve(p, du, dv, r, step);
		/* a step out of the domain runs along its border */
		for (int d = 0; d < 2; d++) {
			double w = d ? uv->y : uv->x;
			const double *domain = p->s->domain[d];
			if (p->period[d] == 0 &&
			    ((w <= domain[0] && step[d] < 0) || (w >= domain[1] && step[d] > 0))) {
				struct vec3 other = d ? du : dv, none = vec3(0, 0, 0);
				solve(p, d ? other : none, d ? none : other, r, step);
			}
		}
		struct vec3 next = *uv;
		int k = 0;
		for (double part = 1; k < HALVINGS; k++, part *= 0.5) {
			next = vec3(uv->x + part * step[0], uv->y + part * step[1], 0);
			if (p->period[0] == 0)
				next.x = inside(p, 0, next.x);
			if (p->period[1] == 0)
				next.y = inside(p, 1, next.y);
			if (vec3_length(vec3_sub(x, point_at(p, next))) < best)
				break;
		}
		if (k == HALVINGS)
			return best;
		double moved = fabs(next.x - uv->x) * vec3_length(du) +
		               fabs(next.y - uv->y) * vec3_length(dv);
		*uv = next;
		if (moved <= settled * p->size)
			return vec3_length(vec3_sub(x, point_at(p, next)));
	}
	return best;
}

static enum status make_grid(struct projector *p)
{
	const struct surface *s = p->s;
	for (int d = 0; d < 2; d++) {
		double *breaks = calloc((size_t)s->n[d] + 2, sizeof *breaks);
		if (!breaks)
			return ST_RESOURCE;
		int spans = knots_breaks(s->order[d], s->n[d], s->knots[d], s->domain[d][0],
		                         s->domain[d][1], breaks) -
		            1;
		int each = s->order[d] - 1 > 2 ? s->order[d] - 1 : 2;
		p->n[d] = spans > GRID_MAX / each ? GRID_MAX : spans * each;
		p->at[d] = calloc((size_t)p->n[d], sizeof *p->at[d]);
		for (int i = 0; p->at[d] && i < p->n[d]; i++) {
			double x = (i + 0.5) * spans / p->n[d];
			int k = (int)x < spans ? (int)x : spans - 1;
			p->at[d][i] = breaks[k] + (x - k) * (breaks[k + 1] - breaks[k]);
		}
		free(breaks);
		if (!p->at[d])
			return ST_RESOURCE;
	}
	p->points = calloc((size_t)p->n[0] * p->n[1], sizeof *p->points);
	for (int i = 0; p->points && i < p->n[0]; i++)
		for (int j = 0; j < p->n[1]; j++)
			p->points[(size_t)i * p->n[1] + j] =
			        surface_point(s, p->at[0][i], p->at[1][j]);
	return p->points ? ST_OK : ST_RESOURCE;
}

struct seed {
	double distance;
	struct vec3 uv;
};

/* The nearest samples of the grid, nearest first. */
static int find_seeds(const struct projector *p, struct vec3 x, struct seed out[SEEDS])
{
	int n = 0;
	for (int i = 0; i < p->n[0]; i++)
		for (int j = 0; j < p->n[1]; j++) {
			struct vec3 r = vec3_sub(x, p->points[(size_t)i * p->n[1] + j]);
			double d = vec3_dot(r, r);
			if (n == SEEDS && d >= out[n - 1].distance)
				continue;
			int k = n < SEEDS ? n++ : n - 1;
			for (; k > 0 && out[k - 1].distance > d; k--)
				out[k] = out[k - 1];
			out[k] = (struct seed){ d, vec3(p->at[0][i], p->at[1][j], 0) };
		}
	return n;
}

/* The nearest point of all that the grid leads to. */
static double search(struct projector *p, struct vec3 x, double enough, struct vec3 *uv)
{
	struct seed seeds[SEEDS];
	double best = INFINITY;
	if (!p->points && make_grid(p) != ST_OK) {
		p->failed = true;
		return best;
	}
	int n = find_seeds(p, x, seeds);
	for (int i = 0; i < n && best > enough; i++) {
		struct vec3 at = seeds[i].uv;
		double d = descend(p, x, &at);
		if (d < best) {
			best = d;
			*uv = at;
		}
	}
	return best;
}

/* The nearest point to x, near `guess` if there is one as good. */
static double nearest(struct projector *p, struct vec3 x, struct vec3 guess, struct vec3 *uv)
{
	*uv = guess;
	double d = descend(p, x, uv);
	if (d > p->near) {
		struct vec3 other = *uv;
		double e = search(p, x, p->near, &other);
		if (e < d) {
			*uv = other;
			d = e;
		}
	}
	if (p->period[0] > 0)
		uv->x += p->period[0] * round((guess.x - uv->x) / p->period[0]);
	if (p->period[1] > 0)
		uv->y += p->period[1] * round((guess.y - uv->y) / p->period[1]);
	p->near = fmax(p->near, 2 * d);
	return d;
}

/* ---- following a curve */

/* Derivative of the u,v curve: what the surface makes of it is the curve's own. */
static struct vec3 brought_down(const struct projector *p, struct vec3 uv, struct vec3 d)
{
	struct vec3 q, du, dv;
	double out[2];
	surface_tangents(p->s, inside(p, 0, uv.x), inside(p, 1, uv.y), &q, &du, &dv);
	solve(p, du, dv, d, out);
	return vec3(out[0], out[1], 0);
}

/* At a pole a parameter is free: it goes on as it came. -1 where there is none. */
static int free_parameter(const struct projector *p, struct vec3 uv)
{
	struct vec3 q, du, dv;
	const double *u = p->s->domain[0], *v = p->s->domain[1];
	surface_tangents(p->s, inside(p, 0, uv.x), inside(p, 1, uv.y), &q, &du, &dv);
	if (vec3_length(du) * (u[1] - u[0]) <= at_pole * p->size)
		return 0;
	return vec3_length(dv) * (v[1] - v[0]) <= at_pole * p->size ? 1 : -1;
}

static void follow(void *data, double a, double b, struct vec3 guess, struct hermite_node *n)
{
	struct projector *p = data;
	struct vec3 x[2];
	double inner = aside * (b - a), t = n->t;
	n->point = guess;
	if (p->farthest > p->reach)
		return;
	p->farthest = fmax(p->farthest, nearest(p, curve_point(p->c, t), guess, &n->point));
	int lost = free_parameter(p, n->point);
	if (lost >= 0) {
		struct vec3 beside;
		t += t - a < b - t ? inner : -inner;
		curve_derivatives(p->c, t, 1, x);
		nearest(p, x[0], guess, &beside);
		n->in = n->out = brought_down(p, beside, x[1]);
		if (lost == 0)
			n->point.x = beside.x + (n->t - t) * n->in.x;
		else
			n->point.y = beside.y + (n->t - t) * n->in.y;
		return;
	}
	/* at a break the side matters: a hair inside there */
	double in = n->t >= b ? b - 1e-9 * (b - a) : n->t, out = n->t <= a ? a : n->t;
	curve_derivatives(p->c, in, 1, x);
	n->in = brought_down(p, n->point, x[1]);
	curve_derivatives(p->c, out, 1, x);
	n->out = brought_down(p, n->point, x[1]);
}

static double off_surface(void *data, const struct hermite_node *n, struct vec3 candidate)
{
	struct projector *p = data;
	return vec3_length(vec3_sub(point_at(p, n->point), point_at(p, candidate)));
}

/* Breaks of a curve, and more between them where they are few. Fresh. */
static enum status curve_breaks(const struct curve *c, int least, double **out, int *n)
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

/* A border is taken where that moves the point by no more than the tolerance. */
static void snap(const struct projector *p, struct vec3 *uv, double tolerance)
{
	struct vec3 at = point_at(p, *uv);
	for (int d = 0; d < 2; d++) {
		const double *domain = p->s->domain[d];
		double *w = d ? &uv->y : &uv->x, was = *w, width = domain[1] - domain[0];
		double border = domain[0] + width * round((was - domain[0]) / width);
		*w = border;
		if (!(vec3_length(vec3_sub(at, point_at(p, *uv))) <= tolerance) ||
		    fabs(border - was) > 0.01 * width)
			*w = was;
	}
}

/* Does the line from a to b run along the curve within the tolerance? */
static bool along(const struct projector *p, const struct curve *c, struct vec3 a, struct vec3 b,
                  double tolerance)
{
	enum { SAMPLES = 4 };
	struct vec3 d = vec3_sub(b, a);
	const double *u = p->s->domain[0], *v = p->s->domain[1];
	double su = 1 / (u[1] - u[0]), sv = 1 / (v[1] - v[0]), last = 0;
	double l = d.x * d.x * su * su + d.y * d.y * sv * sv;
	if (!(l > 1e-20))
		return false;
	for (int i = 0; i + 1 < c->n; i += 3)
		for (int k = 1; k <= SAMPLES; k++) {
			double from = c->knots[i + 3], to = c->knots[i + 4];
			struct vec3 q = curve_point(c, from + (to - from) * k / SAMPLES);
			double s = ((q.x - a.x) * d.x * su * su + (q.y - a.y) * d.y * sv * sv) / l;
			if (s < last - 1e-6 || s > 1 + 1e-6)
				return false;
			last = s;
			struct vec3 r = vec3_sub(point_at(p, q), point_at(p, vec3_along(a, s, d)));
			if (!(vec3_length(r) <= tolerance))
				return false;
		}
	return true;
}

/* Replace c by a line if it is one, one of equal u or v if it is that. */
static enum status recognise_line(const struct projector *p, double tolerance, struct curve *c)
{
	struct vec3 a = curve_get_point(c, 0, NULL), b = curve_get_point(c, c->n - 1, NULL);
	const struct vec3 straight[2] = { a, b };
	snap(p, &a, tolerance);
	snap(p, &b, tolerance);
	const struct vec3 tries[][2] = {
		{ a, vec3(a.x, b.y, 0) },
		{ vec3(b.x, a.y, 0), b },
		{ a, vec3(b.x, a.y, 0) },
		{ vec3(a.x, b.y, 0), b },
		{ a, b },
		{ straight[0], straight[1] },
	};
	for (size_t i = 0; i < sizeof tries / sizeof tries[0]; i++)
		if (along(p, c, tries[i][0], tries[i][1], tolerance)) {
			double from = c->domain[0], to = c->domain[1];
			curve_finish(c);
			enum status st = curve_init(c, 2, 2);
			if (st != ST_OK)
				return st;
			c->knots[0] = c->knots[1] = c->domain[0] = from;
			c->knots[2] = c->knots[3] = c->domain[1] = to;
			curve_set_point(c, 0, tries[i][0], 1);
			curve_set_point(c, 1, tries[i][1], 1);
			return ST_OK;
		}
	return ST_OK;
}

/* Largest distance between points of equal parameter of c and what was made of it. */
static double measure(const struct projector *p, const struct curve *c, const struct curve *uv)
{
	enum { SAMPLES = 4 };
	double worst = 0;
	for (int i = 0; i + 1 < uv->n; i += 3)
		for (int k = 0; k <= SAMPLES; k++) {
			double t = uv->knots[i + 3] +
			           (uv->knots[i + 4] - uv->knots[i + 3]) * k / SAMPLES;
			struct vec3 q = point_at(p, curve_point(uv, t));
			worst = fmax(worst, vec3_length(vec3_sub(q, curve_point(c, t))));
		}
	return worst;
}

enum status projector_curve(struct projector *p, const struct curve *c, double tolerance,
                            double reach, struct curve *out, double *distance)
{
	double *breaks, worst;
	int n;
	struct vec3 first = { 0 };
	*distance = 0;
	if (p->flat)
		return project_flat(p, c, out, distance);
	enum status st = curve_breaks(c, SPANS_LEAST, &breaks, &n);
	if (st != ST_OK)
		return st;
	const struct hermite h = { follow, off_surface, p, tolerance };
	p->c = c;
	p->reach = reach;
	p->farthest = search(p, curve_point(c, c->domain[0]), tolerance, &first);
	p->near = fmax(tolerance, 2 * p->farthest);
	st = p->failed ? ST_RESOURCE : hermite_fit(&h, breaks, n, first, out, &worst);
	free(breaks);
	p->c = NULL;
	if (st == ST_OK && p->failed) {
		curve_finish(out);
		st = ST_RESOURCE;
	}
	if (st != ST_OK)
		return st;
	*distance = p->farthest > reach ? p->farthest : measure(p, c, out);
	if (*distance > reach)
		return ST_OK;
	return recognise_line(p, tolerance, out);
}

double projector_period(const struct projector *p, int d)
{
	return p->period[d];
}

enum status projector_create(struct projector **out, const struct surface *s)
{
	struct projector *p = calloc(1, sizeof *p);
	if (!p)
		return ST_RESOURCE;
	p->s = s;
	p->size = surface_size(s);
	find_flat(p);
	for (int d = 0; d < 2; d++)
		if (!p->flat && surface_closed(s, d, closed_within * p->size))
			p->period[d] = s->domain[d][1] - s->domain[d][0];
	*out = p;
	return ST_OK;
}

void projector_destroy(struct projector *p)
{
	if (!p)
		return;
	free(p->at[0]);
	free(p->at[1]);
	free(p->points);
	free(p);
}

/* ---- lifting */

struct lift {
	struct on_surface c;
};

static void lift_at(void *data, double a, double b, struct vec3 guess, struct hermite_node *n)
{
	const struct lift *l = data;
	struct vec3 x[2];
	(void)guess;
	double in = n->t >= b ? b - 1e-9 * (b - a) : n->t;
	on_surface_derivatives(&l->c, in, 1, x);
	n->in = x[1];
	on_surface_derivatives(&l->c, n->t, 1, x);
	n->out = x[1];
	n->point = x[0];
}

static double lift_off(void *data, const struct hermite_node *n, struct vec3 candidate)
{
	(void)data;
	return vec3_length(vec3_sub(n->point, candidate));
}

/* A line of one parameter, as the surface has it. False where uv is something else. */
static bool lift_line(const struct surface *s, const struct curve *uv, struct curve *out,
                      enum status *st)
{
	if (uv->order != 2 || uv->n != 2)
		return false;
	struct vec3 a = curve_point(uv, uv->domain[0]), b = curve_point(uv, uv->domain[1]);
	int d = a.x == b.x ? 0 : 1;
	double at = d ? a.y : a.x, from = d ? a.x : a.y, to = d ? b.x : b.y;
	const double *domain = s->domain[!d];
	if ((d && a.y != b.y) || from == to || fmin(from, to) < domain[0] ||
	    fmax(from, to) > domain[1] || at < s->domain[d][0] || at > s->domain[d][1])
		return false;
	struct curve whole;
	*st = surface_isoparametric(&whole, s, d, at);
	if (*st == ST_OK) {
		*st = curve_part(out, &whole, fmin(from, to), fmax(from, to));
		curve_finish(&whole);
	}
	if (*st == ST_OK) {
		if (from > to)
			curve_reverse(out);
		curve_reparametrise(out, uv->domain[0], uv->domain[1]);
	}
	return true;
}

enum status project_lift(const struct surface *s, const struct curve *uv, double tolerance,
                         struct curve *out)
{
	struct projector p = { .s = s, .size = surface_size(s) };
	enum status st;
	double *breaks, worst;
	int n;
	find_flat(&p);
	if (p.flat) {
		st = curve_copy(out, uv);
		if (st == ST_OK)
			curve_transform(out, p.up);
		return st;
	}
	if (lift_line(s, uv, out, &st))
		return st;
	st = curve_breaks(uv, SPANS_LEAST, &breaks, &n);
	if (st != ST_OK)
		return st;
	struct lift l = { { uv, s } };
	const struct hermite h = { lift_at, lift_off, &l, tolerance };
	st = hermite_fit(&h, breaks, n, vec3(0, 0, 0), out, &worst);
	free(breaks);
	return st;
}
