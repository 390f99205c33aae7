/* ray_packet.c - packets of RAY_LANES rays through Embree's tree to our leaves and back. */
#include <math.h>
#include <string.h>

#include "curvature.h"
#include "ray_newton.h"

#if RAY_LANES == 16
#define RAY_KERNEL ray_kernel_16
#define LEVEL      "x86-64-v4"
typedef struct RTCRay16 packet_ray;
typedef struct RTCRayHit16 packet_hit;
#define packet_intersect rtcIntersect16
#define packet_occluded  rtcOccluded16
#elif RAY_LANES == 8
#define RAY_KERNEL       ray_kernel_8
#define LEVEL            "x86-64-v3"
typedef struct RTCRay8 packet_ray;
typedef struct RTCRayHit8 packet_hit;
#define packet_intersect rtcIntersect8
#define packet_occluded  rtcOccluded8
#else
#define RAY_KERNEL       ray_kernel_4
#define LEVEL            "x86-64"
typedef struct RTCRay4 packet_ray;
typedef struct RTCRayHit4 packet_hit;
#define packet_intersect rtcIntersect4
#define packet_occluded  rtcOccluded4
#endif

/* Fields of Embree's packets of n rays: blocks of n values, in the order of struct RTCRay. */
enum { RAY_TFAR = 8, RAY_ID = 10, RAY_FIELDS = 12 };
enum { HIT_PRIMITIVE = 5, HIT_GEOMETRY = 6, HIT_INSTANCE = 7 };

/* Lanes of the packet that Embree asks about; it may cut packets into narrower ones. */
static vi packet_mask(const int *valid, const uint32_t *ray, unsigned n)
{
	vi act = { 0 };

	if (n == LANES) { /* the packet itself, lanes in place */
		memcpy(&act, valid, sizeof act);
		return act;
	}
	for (unsigned i = 0; i < n; i++)
		act[ray[RAY_ID * n + i] % LANES] = valid[i] ? -1 : 0;
	return act;
}

static void packet_on_leaf(const struct RTCIntersectFunctionNArguments *args)
{
	struct packet *p = (struct packet *)args->context;
	unsigned n = args->N;
	float *ray = (float *)args->rayhit;
	uint32_t *id = (uint32_t *)args->rayhit, *hit = id + (size_t)RAY_FIELDS * n;
	vi act = packet_mask(args->valid, id, n);
	vi ok = leaf_trace(p, args->primID, act);

	if (!any(ok))
		return;
	for (unsigned i = 0; i < n; i++) {
		unsigned lane = id[RAY_ID * n + i] % LANES;

		if (!ok[lane])
			continue;
		ray[RAY_TFAR * n + i] = p->far[lane];
		hit[HIT_PRIMITIVE * n + i] = args->primID;
		hit[HIT_GEOMETRY * n + i] = args->geomID;
		hit[HIT_INSTANCE * n + i] = args->context->instID[0];
	}
}

static void packet_on_shade(const struct RTCOccludedFunctionNArguments *args)
{
	struct packet *p = (struct packet *)args->context;
	unsigned n = args->N;
	float *ray = (float *)args->ray;
	const uint32_t *id = (const uint32_t *)args->ray;
	vi ok = leaf_trace(p, args->primID, packet_mask(args->valid, id, n));

	if (!any(ok))
		return;
	for (unsigned i = 0; i < n; i++)
		if (ok[id[RAY_ID * n + i] % LANES])
			ray[RAY_TFAR * n + i] = -INFINITY;
}

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
                           const struct packet_start *a, bool coherent, bool nearest)
{
	rtcInitIntersectContext(&p->context);
	p->context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
	                            : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
	p->scene = s;
	p->nearest = nearest;
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
		p->leaf[h] = (vl){ 0 } - 1;
	}
	for (int e = 0; e < 3; e++) {
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

static void packet_ray_set(const struct packet *p, const struct packet_start *a, packet_ray *r)
{
	vf o[3], zero = { 0 };

	for (int e = 0; e < 3; e++)
		o[e] = to_float(a->o[e].v);
	vf near = pick(p->near > 0, p->near, zero);
	memcpy(r->org_x, &o[0], sizeof o[0]);
	memcpy(r->org_y, &o[1], sizeof o[0]);
	memcpy(r->org_z, &o[2], sizeof o[0]);
	memcpy(r->tnear, &near, sizeof near);
	memcpy(r->dir_x, &p->d[0], sizeof zero);
	memcpy(r->dir_y, &p->d[1], sizeof zero);
	memcpy(r->dir_z, &p->d[2], sizeof zero);
	memcpy(r->time, &zero, sizeof zero);
	memcpy(r->tfar, &p->far, sizeof zero);
	for (unsigned i = 0; i < LANES; i++) {
		r->mask[i] = UINT32_MAX;
		r->id[i] = i;
		r->flags[i] = 0;
	}
}

static double at_lane(const vd x[2], int lane)
{
	return x[lane / HALF][lane % HALF];
}

static void packet_result(const struct packet *p, const struct packet_start *a, int lane,
                          struct ray_hit *out)
{
	const struct ray_cut *cut = &p->scene->cut;
	int64_t leaf = p->leaf[lane / HALF][lane % HALF];

	if (leaf < 0) {
		*out = (struct ray_hit){ .surface = -1, .t = INFINITY };
		return;
	}
	const struct ray_patch *patch = &cut->patches[cut->leaves[leaf].patch];
	double u = fmin(fmax(at_lane(p->a[0], lane), 0), 1);
	double v = fmin(fmax(at_lane(p->a[1], lane), 0), 1);
	struct vec3 point = vec3(at_lane(p->point[0], lane), at_lane(p->point[1], lane),
	                         at_lane(p->point[2], lane));
	struct vec3 normal = vec3(at_lane(p->normal[0], lane), at_lane(p->normal[1], lane),
	                          at_lane(p->normal[2], lane));

	out->surface = patch->surface;
	out->t = a->shift.x[lane] + cut->scale * at_lane(p->fard, lane);
	out->u = (1 - u) * patch->u[0] + u * patch->u[1];
	out->v = (1 - v) * patch->v[0] + v * patch->v[1];
	out->point = vec3_along(cut->center, cut->scale, point);
	double length = vec3_length(normal), area = at_lane(p->area, lane);
	struct vec3 limit;
	if (!(length * length > 0.0025 * area) &&
	    surface_normal(p->scene->surfaces[out->surface], out->u, out->v, &limit))
		out->normal = limit;
	else
		out->normal = vec3_scale(normal, length > 0 ? 1 / length : 0);
}

static void packet_hits(const struct ray_scene *s, const struct ray *rays, const uint32_t *order,
                        size_t n, bool coherent, struct ray_hit *hits)
{
	struct packet_start start;
	struct packet p;
	packet_hit h __attribute__((aligned(64)));
	int valid[LANES] __attribute__((aligned(64)));

	for (size_t first = 0; first < n; first += LANES) {
		size_t count = n - first < LANES ? n - first : LANES;

		packet_gather(s, order ? rays : rays + first, order ? order + first : NULL, count,
		              &start);
		packet_prepare(&p, s, &start, coherent, true);
		packet_ray_set(&p, &start, &h.ray);
		for (unsigned i = 0; i < LANES; i++) {
			valid[i] = i < count && start.near.x[i] < start.far.x[i] ? -1 : 0;
			h.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
			h.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
		}
		packet_intersect(valid, s->tree, &p.context, &h);
		for (size_t i = 0; i < count; i++)
			packet_result(&p, &start, (int)i,
			              &hits[order ? order[first + i] : first + i]);
	}
}

static void packet_blocked(const struct ray_scene *s, const struct ray *rays, const uint32_t *order,
                           size_t n, bool *out)
{
	struct packet_start start;
	struct packet p;
	packet_ray r __attribute__((aligned(64)));
	int valid[LANES] __attribute__((aligned(64)));

	for (size_t first = 0; first < n; first += LANES) {
		size_t count = n - first < LANES ? n - first : LANES;

		packet_gather(s, order ? rays : rays + first, order ? order + first : NULL, count,
		              &start);
		packet_prepare(&p, s, &start, true, false);
		packet_ray_set(&p, &start, &r);
		for (unsigned i = 0; i < LANES; i++)
			valid[i] = i < count && start.near.x[i] < start.far.x[i] ? -1 : 0;
		packet_occluded(valid, s->tree, &p.context, &r);
		for (size_t i = 0; i < count; i++)
			out[order ? order[first + i] : first + i] = r.tfar[i] == -INFINITY;
	}
}

const struct ray_kernel RAY_KERNEL = {
	.level = LEVEL,
	.lanes = RAY_LANES,
	.intersect = packet_on_leaf,
	.occluded = packet_on_shade,
	.hits = packet_hits,
	.blocked = packet_blocked,
};
