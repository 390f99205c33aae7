/* level_kind.c - fields that are products of several forms: cylinders, and what an eye sees.
 *
 * All are polynomials in X = (w S, w) and the normal N, whose third axis lies along the field's
 * direction. With D = X - e w for the eye e, Q = q w - X for the line through q along z:
 *   cylinder     x^2 + y^2 - r^2 w^2                    of X - q w
 *   eye          N . D
 *   highlight    g = (N x z) . Q, or g^2 - d^2 |N x z|^2 w^2 at distance d
 *   reflection   N.N (D x z) . Q - 2 (N . D) (N x z) . Q
 * In the last the reflected ray, N.N D - 2 (N . D) N, meets the line as a whole line;
 * (D x z) . Q is w (D x z) . (q - e).
 * Source of the highlight line: Beier and Chen, Highlight-line algorithm for realtime surface
 * quality assessment, CAD 26 (1994).
 */
#include "level_term.h"

#include <math.h>
#include <string.h>

/* All points about the axis lie inside the circle, or all beyond one line that touches it. */
static bool circle_excludes(const struct tracer *t, double radius)
{
	const struct level_surface *s = t->level->surface;
	size_t count = bezier_patch_size(&s->net) / 4;
	double mx = 0, my = 0;
	double error = 3 * form_moved_bound(t, s->point).error + 3 * radius * s->of_weights.error;
	bool inside = true;
	for (size_t i = 0; i < count; i++) {
		const double *p = t->points + 4 * i;
		double x =
		        vec3_dot(vec3(p[0], p[1], p[2]), vec3_of(s->frame[0])) - s->point[0] * p[3];
		double y =
		        vec3_dot(vec3(p[0], p[1], p[2]), vec3_of(s->frame[1])) - s->point[1] * p[3];
		double r = radius * p[3] - error;
		inside = inside && r > 0 && x * x + y * y < r * r * (1 - 1e-12);
		mx += x;
		my += y;
	}
	if (inside)
		return true;
	double l = hypot(mx, my);
	if (!(l > 0))
		return false;
	mx /= l;
	my /= l;
	for (size_t i = 0; i < count; i++) {
		const double *p = t->points + 4 * i;
		double x =
		        vec3_dot(vec3(p[0], p[1], p[2]), vec3_of(s->frame[0])) - s->point[0] * p[3];
		double y =
		        vec3_dot(vec3(p[0], p[1], p[2]), vec3_of(s->frame[1])) - s->point[1] * p[3];
		if (!(mx * x + my * y - radius * p[3] > error))
			return false;
	}
	return true;
}

static bool cylinder_make(struct tracer *t, struct form *f)
{
	const struct level_surface *s = t->level->surface;
	double r = t->level->value;
	struct form x[4];
	if (circle_excludes(t, r))
		return false;
	form_points(t, s->point, x);
	form_add_square(f, x[0], 1);
	form_add_square(f, x[1], 1);
	form_add_square(f, x[3], -r * r);
	return true;
}

static bool eye_make(struct tracer *t, struct form *f)
{
	struct form d[4];
	form_points(t, t->level->surface->eye, d);
	for (int k = 0; k < 3; k++)
		form_add_product(f, form_normal(t, k), d[k], 1);
	return true;
}

static bool highlight_make(struct tracer *t, struct form *f)
{
	const struct level_surface *s = t->level->surface;
	double away = t->level->value;
	struct form x[4], nx = form_normal(t, 0), ny = form_normal(t, 1);
	form_points(t, s->point, x); /* -Q */
	int m = nx.m + x[0].m, n = nx.n + x[0].n;
	struct form fresh, *g = f;
	if (away != 0) {
		fresh = form_new(t, m, n);
		g = &fresh;
	}
	form_add_product(g, nx, x[1], 1);
	form_add_product(g, ny, x[0], -1);
	if (away == 0)
		return true;
	struct form h = form_new(t, 2 * nx.m, 2 * nx.n), w = form_new(t, 2 * x[3].m, 2 * x[3].n);
	form_add_square(&h, nx, 1);
	form_add_square(&h, ny, 1);
	form_add_square(&w, x[3], 1);
	form_add_square(f, *g, 1);
	form_add_product(f, h, w, -away * away);
	form_scale(g->c, m, n, s->binomial, true);
	double *side = f->c + t->n_field;
	for (size_t i = 0; i < t->n_side; i++)
		side[i] = away < 0 ? -g->c[i] : g->c[i];
	t->side_error = g->b.error;
	return true;
}

static bool reflection_make(struct tracer *t, struct form *f)
{
	const struct level_surface *s = t->level->surface;
	const double *gap = s->gap;
	struct form d[4], q[2], normal[3];
	form_points(t, s->eye, d);
	for (int k = 0; k < 3; k++)
		normal[k] = form_normal(t, k);
	int m = d[0].m, n = d[0].n, nm = normal[0].m, nn = normal[0].n;
	struct form across = form_new(t, m, n), a = form_new(t, 2 * m, 2 * n);
	struct form square = form_new(t, 2 * nm, 2 * nn);
	struct form b = form_new(t, nm + m, nn + n), c = form_new(t, nm + m, nn + n);
	for (int k = 0; k < 2; k++) {
		q[k] = form_new(t, m, n);
		for (size_t i = 0; i < form_count(m, n); i++)
			q[k].c[i] = gap[k] * d[3].c[i] - d[k].c[i];
		q[k].b = bound_sum(d[k].b, gap[k], d[3].b);
	}
	for (size_t i = 0; i < form_count(m, n); i++)
		across.c[i] = d[1].c[i] * gap[0] - d[0].c[i] * gap[1];
	across.b = bound_sum(bound_sum(across.b, gap[0], d[1].b), gap[1], d[0].b);
	form_add_product(&a, across, d[3], 1);
	for (int k = 0; k < 3; k++) {
		form_add_square(&square, normal[k], 1);
		form_add_product(&b, normal[k], d[k], 1);
	}
	form_add_product(&c, normal[1], q[0], 1);
	form_add_product(&c, normal[0], q[1], -1);
	form_add_product(f, square, a, 1);
	form_add_product(f, b, c, -2);
	return true;
}

bool level_kind_make(struct tracer *t, double *out)
{
	static bool (*const make[N_LEVEL_KINDS])(struct tracer *, struct form *) = {
		[LEVEL_CYLINDER] = cylinder_make,
		[LEVEL_EYE] = eye_make,
		[LEVEL_HIGHLIGHT] = highlight_make,
		[LEVEL_REFLECTION] = reflection_make,
	};
	const struct level *l = t->level;
	struct form f = { out, l->degree[0], l->degree[1], { 0, 0 } };
	memset(out, 0, sizeof *out * t->n_field);
	t->n_product = 0;
	if (!make[l->surface->kind](t, &f))
		return false;
	form_scale(out, f.m, f.n, l->surface->binomial, true);
	t->bound = f.b;
	return true;
}

/* In doubles: no kind has more forms than these. */
size_t level_kind_room(const struct level *l)
{
	const struct level_surface *s = l->surface;
	int m = s->net.order[0], n = s->net.order[1];
	size_t points = form_count(m, n), normals = level_normals_size(s) / 4;
	size_t both = form_count(s->degree[0] + m, s->degree[1] + n);
	return 8 * points + 2 * form_count(2 * m, 2 * n) + 3 * normals +
	       form_count(2 * s->degree[0], 2 * s->degree[1]) + 3 * both;
}

/* A number with its derivatives. */
struct jet {
	double f, u, v;
};

static struct jet jet_sum(struct jet a, double weight, struct jet b)
{
	return (struct jet){ a.f + weight * b.f, a.u + weight * b.u, a.v + weight * b.v };
}

static struct jet jet_product(struct jet a, struct jet b)
{
	return (struct jet){ a.f * b.f, a.u * b.f + a.f * b.u, a.v * b.f + a.f * b.v };
}

/* X - from w in the frame, component d. */
static struct jet jet_point(const struct level_surface *s, const struct field_jets *j,
                            const double from[3], int d)
{
	const double *r = s->frame[d];
	const double *x = j->x[0], *xu = j->x[1], *xv = j->x[2];
	return (struct jet){ r[0] * x[0] + r[1] * x[1] + r[2] * x[2] - from[d] * x[3],
		             r[0] * xu[0] + r[1] * xu[1] + r[2] * xu[2] - from[d] * xu[3],
		             r[0] * xv[0] + r[1] * xv[1] + r[2] * xv[2] - from[d] * xv[3] };
}

static struct jet jet_dot(const struct jet *a, const struct jet *b, int n)
{
	struct jet sum = { 0 };
	for (int d = 0; d < n; d++)
		sum = jet_sum(sum, 1, jet_product(a[d], b[d]));
	return sum;
}

void level_kind_at(const struct level *l, const struct field_jets *j, struct field_point *out)
{
	const struct level_surface *s = l->surface;
	const double *from =
	        s->kind == LEVEL_CYLINDER || s->kind == LEVEL_HIGHLIGHT ? s->point : s->eye;
	struct jet d[3], n[3], f, w = { j->x[0][3], j->x[1][3], j->x[2][3] };
	for (int k = 0; k < 3; k++) {
		d[k] = jet_point(s, j, from, k);
		n[k] = (struct jet){ j->n[0][k], j->n[1][k], j->n[2][k] };
	}
	if (s->kind == LEVEL_CYLINDER) {
		f = jet_sum(jet_dot(d, d, 2), -l->value * l->value, jet_product(w, w));
	} else if (s->kind == LEVEL_EYE) {
		f = jet_dot(n, d, 3);
	} else if (s->kind == LEVEL_HIGHLIGHT) {
		f = jet_sum(jet_product(n[0], d[1]), -1, jet_product(n[1], d[0]));
		if (l->value != 0) {
			struct jet r = jet_product(jet_dot(n, n, 2), jet_product(w, w));
			f = jet_sum(jet_product(f, f), -l->value * l->value, r);
		}
	} else {
		const double *g = s->gap;
		struct jet none = { 0 }, q[2];
		for (int k = 0; k < 2; k++)
			q[k] = jet_sum(jet_sum(none, g[k], w), -1, d[k]);
		struct jet across = jet_sum(jet_sum(none, g[0], d[1]), -g[1], d[0]);
		struct jet c = jet_sum(jet_product(n[1], q[0]), -1, jet_product(n[0], q[1]));
		f = jet_sum(jet_product(jet_dot(n, n, 3), jet_product(across, w)), -2,
		            jet_product(jet_dot(n, d, 3), c));
	}
	out->f = f.f;
	out->fu = f.u;
	out->fv = f.v;
}
