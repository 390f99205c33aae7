/* ray_start.h - packets and single rays made ready, and what a packet's lane has found. Private;
 * included by ray_packet.c only. */
#ifndef BATTEN_RAY_START_H
#define BATTEN_RAY_START_H

#include "ray_finish.h"

/* A packet's rays as arrays, in scene units and brought near the scene. */
struct packet_start {
	union {
		double x[LANES];
		vd v[2];
	} o[3], d[3], near, far, shift; /* shift: distance the origin was moved along, file units */
};

/* Lanes beyond n repeat the last ray. */
static void packet_gather(const struct ray_scene *s, const struct ray *rays, const uint32_t *order,
                          size_t n, struct packet_start *out)
{
	const struct ray_cut *cut = &s->cut;
	double scale = 1 / cut->scale;

	for (size_t i = 0; i < LANES; i++) {
		size_t k = i < n ? i : n - 1;
		const struct ray *r = &rays[order ? order[k] : k];

		out->o[0].x[i] = r->origin.x - cut->center.x;
		out->o[1].x[i] = r->origin.y - cut->center.y;
		out->o[2].x[i] = r->origin.z - cut->center.z;
		out->d[0].x[i] = r->direction.x;
		out->d[1].x[i] = r->direction.y;
		out->d[2].x[i] = r->direction.z;
		out->near.x[i] = r->near;
		out->far.x[i] = r->far;
	}
	for (int h = 0; h < 2; h++) {
		vd d[3] = { out->d[0].v[h], out->d[1].v[h], out->d[2].v[h] };
		vd o[3] = { out->o[0].v[h], out->o[1].v[h], out->o[2].v[h] };
		vd shift = -dotd(o, d) - 1.5 * cut->scale;

		shift = pickd(shift > 0, shift, filld(0));
		for (int e = 0; e < 3; e++)
			out->o[e].v[h] = (o[e] + shift * d[e]) * scale;
		out->near.v[h] = (out->near.v[h] - shift) * scale;
		out->far.v[h] = (out->far.v[h] - shift) * scale;
		out->shift.v[h] = shift;
	}
}

/*
 * The two planes of each ray. Source: Duff et al., Building an Orthonormal Basis, Revisited
 * (JCGT 2017).
 */
static void packet_prepare(struct packet *p, const struct ray_scene *s,
                           const struct packet_start *a, bool nearest)
{
	p->call = (struct ray_call){ s, nearest };
	for (int h = 0; h < 2; h++) {
		vd x = a->d[0].v[h], y = a->d[1].v[h], z = a->d[2].v[h];
		vd sign = pickd(z < 0, filld(-1), filld(1));
		vd k = -1 / (sign + z), xy = x * y * k;
		vd o[3] = { a->o[0].v[h], a->o[1].v[h], a->o[2].v[h] };
		vd d[3] = { x, y, z };
		vd n1[3] = { 1 + sign * x * x * k, sign * xy, -sign * x };
		vd n2[3] = { xy, sign + y * y * k, -y };

		for (int e = 0; e < 3; e++) {
			p->dd[e][h] = d[e];
			p->nd1[e][h] = n1[e];
			p->nd2[e][h] = n2[e];
		}
		p->kd1[h] = dotd(n1, o);
		p->kd2[h] = dotd(n2, o);
		p->kdd[h] = dotd(d, o);
		p->neard[h] = a->near.v[h];
		p->fard[h] = a->far.v[h];
		p->claim[h] = (vl){ 0 } - 1;
		p->area[h] = p->a[0][h] = p->a[1][h] = filld(0);
	}
	for (int e = 0; e < 3; e++) {
		memset(p->point[e], 0, sizeof p->point[e]);
		memset(p->normal[e], 0, sizeof p->normal[e]);
		p->d[e] = to_float(p->dd[e]);
		p->n1[e] = to_float(p->nd1[e]);
		p->n2[e] = to_float(p->nd2[e]);
	}
	p->k1 = to_float(p->kd1);
	p->k2 = to_float(p->kd2);
	p->kd = to_float(p->kdd);
	p->near = to_float(p->neard) - 2 * RAY_NOISE;
	p->far = to_float(p->fard) + 2 * RAY_NOISE;
}

/* The two planes of one ray. */
static void ray_planes(struct vec3 d, struct vec3 *n1, struct vec3 *n2)
{
	double sign = d.z < 0 ? -1 : 1, k = -1 / (sign + d.z), xy = d.x * d.y * k;

	*n1 = vec3(1 + sign * d.x * d.x * k, sign * xy, -sign * d.x);
	*n2 = vec3(xy, sign + d.y * d.y * k, -d.y);
}

static double at_lane(const vd x[2], int lane)
{
	return x[lane / HALF][lane % HALF];
}

static void packet_found(const struct packet *p, int lane, struct ray_found *out)
{
	out->claim = p->claim[lane / HALF][lane % HALF];
	out->t = at_lane(p->fard, lane);
	out->a = at_lane(p->a[0], lane);
	out->b = at_lane(p->a[1], lane);
	out->area = at_lane(p->area, lane);
	out->point = vec3(at_lane(p->point[0], lane), at_lane(p->point[1], lane),
	                  at_lane(p->point[2], lane));
	out->normal = vec3(at_lane(p->normal[0], lane), at_lane(p->normal[1], lane),
	                   at_lane(p->normal[2], lane));
}

#endif
