/* ray_packet.c - packets of RAY_LANES rays through the tree to the leaves and back. */
#include <math.h>
#include <string.h>

#include "curvature.h"
#include "ray_walk.h"

#if RAY_LANES == 16
#define RAY_KERNEL ray_kernel_16
#define LEVEL      "x86-64-v4"
#elif RAY_LANES == 8
#define RAY_KERNEL ray_kernel_8
#define LEVEL      "x86-64-v3"
#else
#define RAY_KERNEL ray_kernel_4
#define LEVEL      "x86-64"
#endif

static double within_one(double x)
{
	return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* Newton's last step may lead over a side of the patch by less than this. */
static const double beside_side = 2e-6;
static const double well_inside = 1e-5;

/*
 * Beyond a side that is one point the patch runs on with its other side up. What is found there has
 * the normal of the inside, which is taken a little way in.
 */
static struct vec3 turned_back(const struct surface *s, const struct ray_patch *p,
                               const struct ray_hit *h, double a, double b, struct vec3 normal)
{
	const double in[2] = { fmin(fmax(a, well_inside), 1 - well_inside),
		               fmin(fmax(b, well_inside), 1 - well_inside) };
	struct vec3 inside, limit;
	if (!surface_normal(s, (1 - in[0]) * p->u[0] + in[0] * p->u[1],
	                    (1 - in[1]) * p->v[0] + in[1] * p->v[1], &inside) ||
	    vec3_dot(inside, normal) >= 0)
		return normal;
	if (surface_normal(s, h->u, h->v, &limit) && vec3_dot(inside, limit) > 0)
		return limit;
	return inside;
}

static void found_hit(const struct ray_scene *s, const struct ray_found *f, double shift,
                      struct ray_hit *out)
{
	const struct ray_cut *cut = &s->cut;

	if (f->claim < 0) {
		*out = (struct ray_hit){ .surface = -1, .t = INFINITY };
		return;
	}
	const struct ray_leaf *leaf = &cut->leaves[f->claim & (CLAIM_BESIDE - 1)];
	const struct ray_patch *patch = &cut->patches[leaf->patch];
	double u = within_one(f->a), v = within_one(f->b);

	out->surface = patch->surface;
	out->t = shift + cut->scale * f->t;
	out->u = (1 - u) * patch->u[0] + u * patch->u[1];
	out->v = (1 - v) * patch->v[0] + v * patch->v[1];
	out->point = vec3_along(cut->center, cut->scale, f->point);
	double length = vec3_length(f->normal);
	struct vec3 limit;
	if (!(length * length > 0.0025 * f->area) &&
	    surface_normal(s->surfaces[out->surface], out->u, out->v, &limit))
		out->normal = limit;
	else
		out->normal = vec3_scale(f->normal, length > 0 ? 1 / length : 0);
	if (fmin(u, v) < beside_side || fmax(u, v) > 1 - beside_side)
		out->normal = turned_back(s->surfaces[out->surface], patch, out, u, v, out->normal);
}

/* The lanes that have a hit, of the first `count`. */
static vi packet_trace(struct packet *p, const struct ray_scene *s, const struct packet_start *a,
                       size_t count, bool coherent, bool nearest)
{
	vl wanted[2];
	vf o[3];

	packet_prepare(p, s, a, nearest);
	for (int h = 0; h < 2; h++)
		wanted[h] = a->near.v[h] < a->far.v[h];
	vi act = to_mask(wanted);
	for (size_t i = count; i < LANES; i++)
		act[i] = 0;
	for (int e = 0; e < 3; e++)
		o[e] = to_float(a->o[e].v);
	return packet_walk(p, o, act, coherent);
}

static void packet_hits(const struct ray_scene *s, const struct ray *rays, const uint32_t *order,
                        size_t n, bool coherent, struct ray_hit *hits)
{
	struct packet_start start;
	struct packet p;

	for (size_t first = 0; first < n; first += LANES) {
		size_t count = n - first < LANES ? n - first : LANES;

		packet_gather(s, order ? rays : rays + first, order ? order + first : NULL, count,
		              &start);
		packet_trace(&p, s, &start, count, coherent, true);
		for (size_t i = 0; i < count; i++) {
			struct ray_found found;

			packet_found(&p, (int)i, &found);
			found_hit(s, &found, start.shift.x[i],
			          &hits[order ? order[first + i] : first + i]);
		}
	}
}

static void packet_blocked(const struct ray_scene *s, const struct ray *rays, size_t n, bool *out)
{
	struct packet_start start;
	struct packet p;

	for (size_t first = 0; first < n; first += LANES) {
		size_t count = n - first < LANES ? n - first : LANES;

		packet_gather(s, rays + first, NULL, count, &start);
		vi hit = packet_trace(&p, s, &start, count, true, false);
		for (size_t i = 0; i < count; i++)
			out[first + i] = hit[i] != 0;
	}
}

/* In scene units and brought near the scene; false where there is nothing between near and far. */
static bool single_start(struct single *q, const struct ray_scene *s, const struct ray *r,
                         bool nearest)
{
	const struct ray_cut *cut = &s->cut;
	struct vec3 o = vec3_sub(r->origin, cut->center), d = r->direction;
	double shift = fmax(-vec3_dot(o, d) - 1.5 * cut->scale, 0), scale = 1 / cut->scale;
	struct vec3 n1, n2;

	o = vec3_scale(vec3_along(o, shift, d), scale);
	ray_planes(d, &n1, &n2);
	q->call = (struct ray_call){ s, nearest };
	const double at[4][3] = {
		{ o.x, o.y, o.z }, { d.x, d.y, d.z }, { n1.x, n1.y, n1.z }, { n2.x, n2.y, n2.z }
	};
	for (int e = 0; e < 3; e++) {
		q->o[e] = at[0][e];
		q->d[e] = (float)(q->dd[e] = at[1][e]);
		q->n1[e] = (float)(q->nd1[e] = at[2][e]);
		q->n2[e] = (float)(q->nd2[e] = at[3][e]);
	}
	q->k1 = (float)(q->kd1 = vec3_dot(n1, o));
	q->k2 = (float)(q->kd2 = vec3_dot(n2, o));
	q->kd = (float)(q->kdd = vec3_dot(d, o));
	q->shift = shift;
	q->neard = (r->near - shift) * scale;
	q->found.t = (r->far - shift) * scale;
	q->found.claim = -1;
	q->near = (float)q->neard - 2 * RAY_NOISE;
	q->far = (float)q->found.t + 2 * RAY_NOISE;
	return r->near < r->far;
}

static void single_hit(const struct ray_scene *s, const struct ray *r, struct ray_hit *out)
{
	struct single q;

	if (single_start(&q, s, r, true))
		single_walk(&q);
	found_hit(s, &q.found, q.shift, out);
}

static bool single_blocked(const struct ray_scene *s, const struct ray *r)
{
	struct single q;

	return single_start(&q, s, r, false) && single_walk(&q);
}

const struct ray_kernel RAY_KERNEL = {
	.level = LEVEL,
	.lanes = RAY_LANES,
	.hits = packet_hits,
	.blocked = packet_blocked,
	.hit = single_hit,
	.is_blocked = single_blocked,
};
