/* ray_packet.c - packets of RAY_LANES rays through Embree's tree to our leaves and back. */
#include <math.h>
#include <string.h>

#include "curvature.h"
#include "ray_single.h"

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

static void single_on_leaf(const struct RTCIntersectFunctionNArguments *args)
{
	struct single *q = (struct single *)args->context;
	struct RTCRayHit *ray = (struct RTCRayHit *)args->rayhit;

	if (!args->valid[0] || !single_trace(q, args->primID))
		return;
	ray->ray.tfar = q->far;
	ray->hit.primID = args->primID;
	ray->hit.geomID = args->geomID;
	ray->hit.instID[0] = args->context->instID[0];
}

static void single_on_shade(const struct RTCOccludedFunctionNArguments *args)
{
	struct single *q = (struct single *)args->context;

	if (args->valid[0] && single_trace(q, args->primID))
		((struct RTCRay *)args->ray)->tfar = -INFINITY;
}

static bool is_single(const struct RTCIntersectContext *c)
{
	return ((const struct ray_call *)c)->single;
}

static void packet_on_leaf(const struct RTCIntersectFunctionNArguments *args)
{
	if (is_single(args->context)) {
		single_on_leaf(args);
		return;
	}
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
	if (is_single(args->context)) {
		single_on_shade(args);
		return;
	}
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

static void found_hit(const struct ray_scene *s, const struct ray_found *f, double shift,
                      struct ray_hit *out)
{
	const struct ray_cut *cut = &s->cut;

	if (f->leaf < 0) {
		*out = (struct ray_hit){ .surface = -1, .t = INFINITY };
		return;
	}
	const struct ray_patch *patch = &cut->patches[cut->leaves[f->leaf].patch];
	double u = fmin(fmax(f->a, 0), 1), v = fmin(fmax(f->b, 0), 1);

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
		packet_intersect(valid, s->tree, &p.call.context, &h);
		for (size_t i = 0; i < count; i++) {
			struct ray_found found;

			packet_found(&p, (int)i, &found);
			found_hit(s, &found, start.shift.x[i],
			          &hits[order ? order[first + i] : first + i]);
		}
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
		packet_occluded(valid, s->tree, &p.call.context, &r);
		for (size_t i = 0; i < count; i++)
			out[order ? order[first + i] : first + i] = r.tfar[i] == -INFINITY;
	}
}

/* In scene units and brought near the scene; false where there is nothing between near and far. */
static bool single_start(struct single *q, const struct ray_scene *s, const struct ray *r,
                         bool nearest, struct RTCRay *out)
{
	const struct ray_cut *cut = &s->cut;
	struct vec3 o = vec3_sub(r->origin, cut->center), d = r->direction;
	double shift = fmax(-vec3_dot(o, d) - 1.5 * cut->scale, 0), scale = 1 / cut->scale;
	struct vec3 n1, n2;

	o = vec3_scale(vec3_along(o, shift, d), scale);
	ray_planes(d, &n1, &n2);
	ray_call_init(&q->call, s, nearest, true);
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
	q->found.leaf = -1;
	q->near = (float)q->neard - 2 * RAY_NOISE;
	q->far = (float)q->found.t + 2 * RAY_NOISE;
	*out = (struct RTCRay){
		.org_x = (float)o.x,
		.org_y = (float)o.y,
		.org_z = (float)o.z,
		.dir_x = q->d[0],
		.dir_y = q->d[1],
		.dir_z = q->d[2],
		.tnear = fmaxf(q->near, 0),
		.tfar = q->far,
		.mask = UINT32_MAX,
	};
	return r->near < r->far;
}

static void single_hit(const struct ray_scene *s, const struct ray *r, struct ray_hit *out)
{
	struct RTCRayHit h = { .hit = { .geomID = RTC_INVALID_GEOMETRY_ID,
		                        .instID = { RTC_INVALID_GEOMETRY_ID } } };
	struct single q;

	if (single_start(&q, s, r, true, &h.ray))
		rtcIntersect1(s->tree, &q.call.context, &h);
	found_hit(s, &q.found, q.shift, out);
}

static bool single_blocked(const struct ray_scene *s, const struct ray *r)
{
	struct RTCRay ray;
	struct single q;

	if (!single_start(&q, s, r, false, &ray))
		return false;
	rtcOccluded1(s->tree, &q.call.context, &ray);
	return ray.tfar == -INFINITY;
}

const struct ray_kernel RAY_KERNEL = {
	.level = LEVEL,
	.lanes = RAY_LANES,
	.intersect = packet_on_leaf,
	.occluded = packet_on_shade,
	.hits = packet_hits,
	.blocked = packet_blocked,
	.hit = single_hit,
	.is_blocked = single_blocked,
};
