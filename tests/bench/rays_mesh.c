/* rays_mesh.c - Embree on triangles. */
#include "rays_mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bezier.h"

enum { PACKET = 16 };

static bool mesh_memory(void *data, ssize_t bytes, bool post)
{
	(void)post;
	*(size_t *)data += (size_t)bytes;
	return true;
}

void mesh_build(struct mesh *m, const struct scene *s, int n, bool tight)
{
	size_t spans = 0, vertex = 0, triangle = 0;
	struct bezier_net net[SURFACES_MAX];

	*m = (struct mesh){ .device = rtcNewDevice("threads=1,set_affinity=0") };
	rtcSetDeviceMemoryMonitorFunction(m->device, mesh_memory, &m->bytes);
	for (int i = 0; i < s->n; i++) {
		if (bezier_net_init(&net[i], s->surfaces[i]) != ST_OK)
			abort();
		spans += (size_t)net[i].spans[0] * net[i].spans[1];
	}
	size_t vertices = spans * (n + 1) * (n + 1), triangles = spans * n * n * 2;
	RTCGeometry g = rtcNewGeometry(m->device, RTC_GEOMETRY_TYPE_TRIANGLE);
	float *points = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
	                                        vertices);
	m->corners = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
	                                     triangles);
	m->normals = malloc(vertices * 3 * sizeof *m->normals);
	m->bytes += vertices * 3 * sizeof *m->normals;
	if (!points || !m->corners || !m->normals)
		abort();
	for (int k = 0; k < s->n; k++)
		for (int a = 0; a < net[k].spans[0]; a++)
			for (int b = 0; b < net[k].spans[1]; b++) {
				const double *u = net[k].breaks[0] + a, *v = net[k].breaks[1] + b;
				uint32_t base = (uint32_t)vertex;

				for (int i = 0; i <= n; i++)
					for (int j = 0; j <= n; j++, vertex++) {
						struct vec3 p, du, dv, c;

						surface_tangents(s->surfaces[k],
						                 u[0] + (u[1] - u[0]) * i / n,
						                 v[0] + (v[1] - v[0]) * j / n, &p,
						                 &du, &dv);
						c = vec3_unit(vec3_cross(du, dv));
						float *q = points + 3 * vertex;
						float *w = m->normals + 3 * vertex;
						q[0] = (float)p.x;
						q[1] = (float)p.y;
						q[2] = (float)p.z;
						w[0] = (float)c.x;
						w[1] = (float)c.y;
						w[2] = (float)c.z;
					}
				for (int i = 0; i < n; i++)
					for (int j = 0; j < n; j++) {
						uint32_t p = base + i * (n + 1) + j, q = p + n + 1;
						const uint32_t six[6] = { p,     q,     p + 1,
							                  q + 1, p + 1, q };

						memcpy(m->corners + 3 * triangle, six, sizeof six);
						triangle += 2;
					}
			}
	for (int i = 0; i < s->n; i++)
		bezier_net_finish(&net[i]);
	rtcCommitGeometry(g);
	m->scene = rtcNewScene(m->device);
	if (tight)
		rtcSetSceneFlags(m->scene, RTC_SCENE_FLAG_ROBUST);
	rtcAttachGeometry(m->scene, g);
	rtcReleaseGeometry(g);
	rtcCommitScene(m->scene);
}

void mesh_finish(struct mesh *m)
{
	rtcReleaseScene(m->scene);
	rtcReleaseDevice(m->device);
	free(m->normals);
}

static struct vec3 mesh_normal(const struct mesh *m, const struct RTCHit16 *h, int i)
{
	const uint32_t *c = m->corners + 3 * (size_t)h->primID[i];
	const float *p = m->normals + 3 * (size_t)c[0], *q = m->normals + 3 * (size_t)c[1];
	const float *r = m->normals + 3 * (size_t)c[2];
	float u = h->u[i], v = h->v[i], w = 1 - u - v;

	return vec3_unit(vec3((double)(w * p[0] + u * q[0] + v * r[0]),
	                      (double)(w * p[1] + u * q[1] + v * r[1]),
	                      (double)(w * p[2] + u * q[2] + v * r[2])));
}

static void mesh_ray(struct RTCRay16 *r, int i, struct vec3 o, struct vec3 d)
{
	r->org_x[i] = (float)o.x;
	r->org_y[i] = (float)o.y;
	r->org_z[i] = (float)o.z;
	r->dir_x[i] = (float)d.x;
	r->dir_y[i] = (float)d.y;
	r->dir_z[i] = (float)d.z;
	r->tnear[i] = 0;
	r->tfar[i] = INFINITY;
	r->time[i] = 0;
	r->mask[i] = UINT32_MAX;
	r->id[i] = 0;
	r->flags[i] = 0;
}

static size_t mesh_block(const struct mesh *m, const struct view *v, int x0, int y0, float *image,
                         float *depth)
{
	struct RTCRayHit16 r __attribute__((aligned(64)));
	struct RTCRay16 s __attribute__((aligned(64)));
	int valid[PACKET] __attribute__((aligned(64)));
	float slope[PACKET];
	size_t rays = PACKET;
	struct RTCIntersectContext context;

	rtcInitIntersectContext(&context);
	context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
	for (int i = 0; i < PACKET; i++) {
		mesh_ray(&r.ray, i, v->eye, view_direction(v, x0 + i % 4, y0 + i / 4));
		r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
		r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
		valid[i] = -1;
	}
	rtcIntersect16(valid, m->scene, &context, &r);
	for (int i = 0; i < PACKET; i++) {
		size_t p = (size_t)(y0 + i / 4) * SIZE + x0 + i % 4;
		bool hit = r.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;

		valid[i] = 0;
		image[p] = hit ? 0.1f : 0;
		depth[p] = hit ? r.ray.tfar[i] : INFINITY;
		mesh_ray(&s, i, vec3(0, 0, 0), v->light);
		if (!hit)
			continue;
		struct vec3 d = vec3((double)r.ray.dir_x[i], (double)r.ray.dir_y[i],
		                     (double)r.ray.dir_z[i]);
		struct vec3 n = mesh_normal(m, &r.hit, i);
		if (vec3_dot(n, d) > 0)
			n = vec3_scale(n, -1);
		slope[i] = (float)vec3_dot(n, v->light);
		if (slope[i] <= 0)
			continue;
		struct vec3 o = vec3_along(v->eye, (double)r.ray.tfar[i], d);
		mesh_ray(&s, i, vec3_along(o, 1e-3 * v->size, n), v->light);
		valid[i] = -1;
		rays++;
	}
	rtcOccluded16(valid, m->scene, &context, &s);
	for (int i = 0; i < PACKET; i++)
		if (valid[i] && s.tfar[i] > 0)
			image[(size_t)(y0 + i / 4) * SIZE + x0 + i % 4] += 0.9f * slope[i];
	return rays;
}

size_t mesh_frame(const struct mesh *m, const struct view *v, float *image, float *depth)
{
	size_t rays = 0;

	for (int y = 0; y < SIZE; y += 4)
		for (int x = 0; x < SIZE; x += 4)
			rays += mesh_block(m, v, x, y, image, depth);
	return rays;
}

size_t mesh_singles(const struct mesh *m, const struct view *v, float *image)
{
	struct RTCIntersectContext context;
	size_t rays = 0;

	rtcInitIntersectContext(&context);
	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++, rays++) {
			struct RTCRayHit16 wide; /* for what shading takes from it */
			struct vec3 d = view_direction(v, x, y);
			struct RTCRayHit r = { .ray = { (float)v->eye.x, (float)v->eye.y,
				                        (float)v->eye.z, 0, (float)d.x, (float)d.y,
				                        (float)d.z, 0, INFINITY, UINT32_MAX, 0, 0 },
				               .hit = { .geomID = RTC_INVALID_GEOMETRY_ID,
				                        .instID = { RTC_INVALID_GEOMETRY_ID } } };
			float *pixel = &image[(size_t)y * SIZE + x];

			rtcIntersect1(m->scene, &context, &r);
			*pixel = 0;
			if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
				continue;
			wide.hit.primID[0] = r.hit.primID;
			wide.hit.u[0] = r.hit.u;
			wide.hit.v[0] = r.hit.v;
			struct vec3 n = mesh_normal(m, &wide.hit, 0);
			if (vec3_dot(n, d) > 0)
				n = vec3_scale(n, -1);
			double slope = vec3_dot(n, v->light);
			*pixel = 0.1f;
			if (slope <= 0)
				continue;
			struct vec3 o = vec3_along(vec3_along(v->eye, (double)r.ray.tfar, d),
			                           1e-3 * v->size, n);
			struct RTCRay s = { (float)o.x,
				            (float)o.y,
				            (float)o.z,
				            0,
				            (float)v->light.x,
				            (float)v->light.y,
				            (float)v->light.z,
				            0,
				            INFINITY,
				            UINT32_MAX,
				            0,
				            0 };
			rtcOccluded1(m->scene, &context, &s);
			rays++;
			if (s.tfar > 0)
				*pixel += 0.9f * (float)slope;
		}
	return rays;
}
