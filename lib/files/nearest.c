/* nearest.c - nearest points on a surface: seeds from a grid, then downhill; parallelograms. */
#include "nearest.h"

#include <stdlib.h>
#include <string.h>

enum {
	GRID_MAX = 96,  /* samples of the surface in a direction, at most */
	SEEDS = 8,      /* of them, the nearest are tried */
	STEPS_MAX = 40, /* of Newton's method */
	HALVINGS = 6,   /* of one step that leads away */
};

static const double at_pole = 1e-7;  /* length of a derivative times its range, of the size */
static const double half_way = 0.25; /* of the way to where feet are not single, squared */
static const double settled = 1e-11; /* of the size: a step that ends the search */

void projector_find_flat(struct projector *p)
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

static double inside(const struct projector *p, int d, double x)
{
	const double *domain = p->s->domain[d];
	if (p->period[d] > 0)
		x -= p->period[d] * floor((x - domain[0]) / p->period[d]);
	return fmin(fmax(x, domain[0]), domain[1]);
}

struct vec3 projector_point(const struct projector *p, struct vec3 uv)
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
			if (vec3_length(vec3_sub(x, projector_point(p, next))) < best)
				break;
		}
		if (k == HALVINGS)
			return best;
		double moved = fabs(next.x - uv->x) * vec3_length(du) +
		               fabs(next.y - uv->y) * vec3_length(dv);
		*uv = next;
		if (moved <= settled * p->size)
			return vec3_length(vec3_sub(x, projector_point(p, next)));
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

double projector_search(struct projector *p, struct vec3 x, double enough, struct vec3 *uv)
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

double projector_nearest(struct projector *p, struct vec3 x, struct vec3 guess, struct vec3 *uv)
{
	*uv = guess;
	double d = descend(p, x, uv);
	if (d > p->near) {
		struct vec3 other = *uv;
		double e = projector_search(p, x, p->near, &other);
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

/* Off its border a foot moves freely. */
static bool is_free(const struct projector *p, struct vec3 uv)
{
	bool free = true;
	for (int d = 0; d < 2; d++) {
		double w = d ? uv.y : uv.x;
		const double *domain = p->s->domain[d];
		free &= p->period[d] > 0 || (w > domain[0] && w < domain[1]);
	}
	return free;
}

struct vec3 projector_bring_down(const struct projector *p, struct vec3 uv, struct vec3 x,
                                 struct vec3 d)
{
	struct vec3 s[9];
	double out[2];
	surface_derivatives(p->s, inside(p, 0, uv.x), inside(p, 1, uv.y), 2, s);
	const struct vec3 du = s[3], dv = s[1], r = vec3_sub(x, s[0]);
	double aa = vec3_dot(du, du), ab = vec3_dot(du, dv), bb = vec3_dot(dv, dv);
	double a = aa - vec3_dot(r, s[6]), b = ab - vec3_dot(r, s[4]), c = bb - vec3_dot(r, s[2]);
	double det = a * c - b * b;
	/* beside the surface the foot moves by what its bending makes of the way; on a border, at a
	 * pole, or farther than its radius, as if it were flat */
	if (is_free(p, uv) && det > half_way * (aa * bb - ab * ab) &&
	    aa * bb - ab * ab > 1e-14 * aa * bb) {
		double ar = vec3_dot(du, d), br = vec3_dot(dv, d);
		return vec3((ar * c - br * b) / det, (br * a - ar * b) / det, 0);
	}
	solve(p, du, dv, d, out);
	return vec3(out[0], out[1], 0);
}

int projector_free_parameter(const struct projector *p, struct vec3 uv)
{
	struct vec3 q, du, dv;
	const double *u = p->s->domain[0], *v = p->s->domain[1];
	surface_tangents(p->s, inside(p, 0, uv.x), inside(p, 1, uv.y), &q, &du, &dv);
	if (vec3_length(du) * (u[1] - u[0]) <= at_pole * p->size)
		return 0;
	return vec3_length(dv) * (v[1] - v[0]) <= at_pole * p->size ? 1 : -1;
}
