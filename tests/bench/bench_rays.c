/* bench_rays.c - rays against surfaces, beside Embree's triangles of the same surfaces.
 *
 * One view of 1024 x 1024 pixels, a ray each and a shadow ray for each lit hit, in blocks of 4 x 4.
 * Peers take turns round by round; figures are medians over CPU time of one thread. The teapot is
 * read from $BATTEN_DATA, where that is set.
 */
#include <embree3/rtcore.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "bezier.h"
#include "construct.h"
#include "model.h"
#include "parallel.h"
#include "ray_scene.h"
#include "rays_pov.h"

enum { SIZE = 1024, TILE = 32, ROUNDS = 5, PACKET = 16, SURFACES_MAX = 64 };

struct scene {
	const char *name;
	const struct surface *surfaces[SURFACES_MAX]; /* borrowed */
	int n;
	double goal; /* part of the speed of triangles 32x32; 0: none */
};

struct view {
	struct vec3 eye, ahead, right, up, light;
	double size;
};

/* The peer: triangles with interpolated normals. */
struct mesh {
	RTCDevice device;
	RTCScene scene;
	float *normals;    /* owned, 3 a vertex */
	uint32_t *corners; /* Embree's, 3 a triangle */
	size_t bytes;
};

static struct vec3 view_direction(const struct view *v, int x, int y)
{
	double a = 0.4 * ((x + 0.5) / SIZE - 0.5), b = 0.4 * (0.5 - (y + 0.5) / SIZE);

	return vec3_unit(vec3_along(vec3_along(v->ahead, a, v->right), b, v->up));
}

static struct view view_fit(const struct box *box)
{
	struct view v = { .ahead = vec3_unit(vec3(-0.35, 0.8, -0.5)),
		          .light = vec3_unit(vec3(-0.5, -0.6, 0.65)),
		          .size = box_diagonal(box) };

	v.eye = vec3_along(box_center(box), -1.5 * v.size, v.ahead);
	v.right = vec3_unit(vec3_cross(v.ahead, vec3(0, 0, 1)));
	v.up = vec3_cross(v.right, v.ahead);
	return v;
}

/* ---- the peer ---- */

static bool mesh_memory(void *data, ssize_t bytes, bool post)
{
	(void)post;
	*(size_t *)data += (size_t)bytes;
	return true;
}

/* Every Bezier span as n x n pairs of triangles; tight: no ray slips between two. */
static void mesh_build(struct mesh *m, const struct scene *s, int n, bool tight)
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

static void mesh_finish(struct mesh *m)
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

static size_t mesh_frame(const struct mesh *m, const struct view *v, float *image, float *depth)
{
	size_t rays = 0;

	for (int y = 0; y < SIZE; y += 4)
		for (int x = 0; x < SIZE; x += 4)
			rays += mesh_block(m, v, x, y, image, depth);
	return rays;
}

/* One ray a call. */
static size_t mesh_singles(const struct mesh *m, const struct view *v, float *image)
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

/* ---- ours ---- */

static size_t scene_singles(const struct ray_scene *s, const struct view *v, float *image)
{
	size_t rays = 0;

	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++, rays++) {
			struct ray r = { v->eye, view_direction(v, x, y), 0, INFINITY };
			struct ray_hit h;
			float *pixel = &image[(size_t)y * SIZE + x];

			ray_scene_hit(s, &r, &h);
			*pixel = h.surface >= 0 ? 0.1f : 0;
			if (h.surface < 0)
				continue;
			double slope = vec3_dot(h.normal, v->light);
			if (vec3_dot(h.normal, r.direction) > 0)
				slope = -slope;
			if (slope <= 0)
				continue;
			r = (struct ray){ h.point, v->light, 1e-4 * v->size, INFINITY };
			rays++;
			if (!ray_scene_is_blocked(s, &r))
				*pixel += 0.9f * (float)slope;
		}
	return rays;
}

struct frame {
	const struct ray_scene *scene;
	const struct view *view;
	float *image, *depth;
	struct ray_hit *hits; /* of all pixels, or NULL */
	size_t rays[(SIZE / TILE) * (SIZE / TILE)];
};

static enum status frame_tile(void *data, size_t unit, int thread)
{
	struct frame *f = data;
	const struct view *v = f->view;
	int x0 = (int)(unit % (SIZE / TILE)) * TILE, y0 = (int)(unit / (SIZE / TILE)) * TILE;
	enum { N = TILE * TILE };
	struct ray rays[N];
	struct ray_hit hits[N];
	size_t pixel[N], asks[N], n = 0, lit = 0;
	float slope[N];
	bool blocked[N];

	(void)thread;
	for (int by = 0; by < TILE; by += 4)
		for (int bx = 0; bx < TILE; bx += 4)
			for (int i = 0; i < 16; i++, n++) {
				int x = x0 + bx + i % 4, y = y0 + by + i / 4;

				pixel[n] = (size_t)y * SIZE + x;
				rays[n] = (struct ray){ v->eye, view_direction(v, x, y), 0,
					                INFINITY };
			}
	ray_scene_hits(f->scene, rays, N, true, hits);
	for (size_t i = 0; i < N; i++) {
		const struct ray_hit *h = &hits[i];

		f->image[pixel[i]] = h->surface >= 0 ? 0.1f : 0;
		f->depth[pixel[i]] = (float)h->t;
		if (f->hits)
			f->hits[pixel[i]] = *h;
		if (h->surface < 0)
			continue;
		double k = vec3_dot(h->normal, v->light);
		if (vec3_dot(h->normal, rays[i].direction) > 0)
			k = -k;
		if (k <= 0)
			continue;
		slope[lit] = (float)k;
		asks[lit] = pixel[i];
		rays[lit++] = (struct ray){ h->point, v->light, 1e-4 * v->size, INFINITY };
	}
	ray_scene_blocked(f->scene, rays, lit, blocked);
	for (size_t i = 0; i < lit; i++)
		if (!blocked[i])
			f->image[asks[i]] += 0.9f * slope[i];
	f->rays[unit] = N + lit;
	return ST_OK;
}

static size_t frame_run(struct frame *f, int threads)
{
	size_t rays = 0, tiles = sizeof f->rays / sizeof *f->rays;

	if (parallel_run(threads, tiles, NULL, frame_tile, f) != ST_OK)
		abort();
	for (size_t i = 0; i < tiles; i++)
		rays += f->rays[i];
	return rays;
}

/* ---- figures ---- */

static void report_accuracy(const struct scene *s, const struct frame *f, const float *mesh_depth,
                            int steps)
{
	size_t n = 0, wrong = 0;
	double *error = malloc(sizeof *error * SIZE * SIZE);

	if (!error)
		abort();
	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++) {
			size_t p = (size_t)y * SIZE + x;
			const struct ray_hit *h = &f->hits[p];

			wrong += (h->surface >= 0) != (bool)isfinite(mesh_depth[p]);
			if (h->surface < 0)
				continue;
			struct vec3 on_ray =
			        vec3_along(f->view->eye, h->t, view_direction(f->view, x, y));
			struct vec3 on_surface = surface_point(s->surfaces[h->surface], h->u, h->v);
			error[n++] = vec3_length(vec3_sub(on_ray, on_surface)) / f->view->size;
		}
	double middle = n ? bench_median(error, n) : 0; /* sorts */
	printf("  hits on surface and ray: median %.1e, worst %.1e of the size\n", middle,
	       n ? error[n - 1] : 0);
	printf("  mask against triangles %dx%d: %.1f pixels per million differ\n", steps, steps,
	       (double)wrong * 1e6 / (SIZE * SIZE));
	free(error);
}

static void print_row(const char *scene, const char *what, const char *unit, double value,
                      double target, bool less)
{
	char name[120];

	snprintf(name, sizeof name, "%s, %s", what, scene);
	bench_print(&(struct bench_row){ .row = "rays",
	                                 .what = name,
	                                 .unit = unit,
	                                 .ours = value,
	                                 .target = target,
	                                 .less = less });
}

/* Packets against the peer's; the goal is a part of its speed. */
static void print_rows(const struct scene *s, double speed, const double peer[2])
{
	const double least[2] = { s->goal, 0.9 };
	char name[120];

	for (int k = 0; k < 2; k++) {
		snprintf(name, sizeof name, "packets, %s", s->name);
		bench_print(&(struct bench_row){
		        .row = "rays",
		        .what = name,
		        .unit = "Mrays/s",
		        .ours = speed,
		        .target = s->goal > 0 ? least[k] * peer[k] : 0,
		        .peer = { { k ? "Embree 128x128" : "Embree 32x32", peer[k] } } });
	}
}

static void run_singles(const struct scene *s, const struct ray_scene *scene,
                        const struct mesh *mesh, const struct view *view, float *image)
{
	double t[2][ROUNDS];
	size_t rays[2];
	char name[120];

	for (int round = 0; round < ROUNDS; round++)
		for (int side = 0; side < 2; side++) {
			double start = bench_cpu();
			rays[side] = side ? mesh_singles(mesh, view, image)
			                  : scene_singles(scene, view, image);
			t[side][round] = bench_cpu() - start;
		}
	double ours = (double)rays[0] / bench_median(t[0], ROUNDS) / 1e6;
	double peer = (double)rays[1] / bench_median(t[1], ROUNDS) / 1e6;
	snprintf(name, sizeof name, "a ray a call, %s", s->name);
	bench_print(&(struct bench_row){ .row = "rays",
	                                 .what = name,
	                                 .unit = "Mrays/s",
	                                 .ours = ours,
	                                 .target = s->goal > 0 ? 0.55 * peer : 0,
	                                 .peer = { { "Embree 32x32", peer } } });
}

/* The frame by POV-Ray, whole process; `ours` is our CPU time for it. */
static void run_pov(const struct scene *s, const struct view *v, double ours)
{
#ifdef POVRAY
	/* a picture is 0.4 wide at distance 1 */
	const struct pov_view view = {
		v->eye, v->ahead, vec3_scale(v->right, 0.4), vec3_scale(v->up, 0.4), v->light, SIZE
	};
	double seconds = pov_seconds(POVRAY, s->surfaces, s->n, &view);

	if (seconds > 0)
		print_row(s->name, "times faster than POV-Ray 32x32, CPU time", "x", seconds / ours,
		          12, false);
#else
	(void)s, (void)v, (void)ours;
#endif
}

static double run(const struct scene *s, bool accuracy)
{
	static const int steps[2] = { 32, 128 };
	struct ray_scene *scene;
	struct mesh mesh[2];
	double ours[ROUNDS], wall[ROUNDS], two[ROUNDS], both[ROUNDS], theirs[2][ROUNDS], prepare[3];
	size_t rays = 0, mesh_rays[2] = { 0 };
	float *image = malloc(sizeof *image * SIZE * SIZE);
	float *depth = malloc(sizeof *depth * SIZE * SIZE);
	struct ray_hit *hits = malloc(sizeof *hits * SIZE * SIZE);

	double start = bench_cpu();
	if (!image || !depth || !hits ||
	    ray_scene_create(&scene, s->surfaces, s->n, 0, NULL) != ST_OK)
		abort();
	prepare[2] = bench_cpu() - start;
	struct box box = ray_scene_box(scene);
	struct view view = view_fit(&box);
	struct frame frame = { .scene = scene, .view = &view, .image = image, .depth = depth };
	for (int k = 0; k < 2; k++) {
		start = bench_cpu();
		mesh_build(&mesh[k], s, steps[k], false);
		prepare[k] = bench_cpu() - start;
	}
	for (int round = 0; round < ROUNDS; round++) {
		start = bench_cpu();
		double begun = bench_wall();
		rays = frame_run(&frame, 1);
		wall[round] = bench_wall() - begun;
		ours[round] = bench_cpu() - start;
		begun = bench_wall();
		start = bench_cpu();
		frame_run(&frame, 2);
		two[round] = bench_wall() - begun;
		both[round] = bench_cpu() - start;
		for (int k = 0; k < 2; k++) {
			start = bench_cpu();
			mesh_rays[k] = mesh_frame(&mesh[k], &view, image, depth);
			theirs[k][round] = bench_cpu() - start;
		}
	}
	double speed = (double)rays / bench_median(ours, ROUNDS) / 1e6;
	double peer[2];
	for (int k = 0; k < 2; k++)
		peer[k] = (double)mesh_rays[k] / bench_median(theirs[k], ROUNDS) / 1e6;
	printf("%s: %zu leaves, %.2f Mrays/s; triangles %dx%d %.2f (ratio %.2f), %dx%d %.2f "
	       "(ratio %.2f)\n",
	       s->name, ray_scene_leaves(scene), speed, steps[0], steps[0], peer[0],
	       speed / peer[0], steps[1], steps[1], peer[1], speed / peer[1]);
	/* on a machine with other work to do, CPU time says what wall time cannot */
	printf("  2 threads / 1: %.2f by the clock, %.2f by CPU time; memory / triangles %dx%d: %.3f; prepare: %.3f\n",
	       bench_median(wall, ROUNDS) / bench_median(two, ROUNDS),
	       2 * bench_median(ours, ROUNDS) / bench_median(both, ROUNDS), steps[1], steps[1],
	       (double)ray_scene_memory(scene) / (double)mesh[1].bytes, prepare[2] / prepare[1]);
	print_rows(s, speed, peer);
	print_row(s->name, "2 threads / 1, CPU time", "x", 2 * ours[ROUNDS / 2] / both[ROUNDS / 2],
	          1.85, false);
	print_row(s->name, "memory / triangles 128x128", "",
	          (double)ray_scene_memory(scene) / (double)mesh[1].bytes, 0.1, true);
	print_row(s->name, "preparing / triangles 128x128", "", prepare[2] / prepare[1], 0.1, true);
	run_singles(s, scene, &mesh[0], &view, image);
	run_pov(s, &view, (double)rays / speed / 1e6);
	for (int k = 0; k < 2; k++)
		mesh_finish(&mesh[k]);
	if (accuracy) {
		int fine = s->n > 1 ? 256 : 128;

		frame.hits = hits;
		frame_run(&frame, 1);
		mesh_build(&mesh[0], s, fine, true);
		mesh_frame(&mesh[0], &view, image, depth);
		report_accuracy(s, &frame, depth, fine);
		mesh_finish(&mesh[0]);
	}
	ray_scene_destroy(scene);
	free(image);
	free(depth);
	free(hits);
	return speed;
}

/* The same with weights that differ a little. */
static void make_rational(struct surface *out, const struct surface *s)
{
	if (surface_copy(out, s) != ST_OK)
		abort();
	for (int i = 0; i < s->n[0]; i++)
		for (int j = 0; j < s->n[1]; j++)
			surface_set_point(out, i, j, surface_get_point(s, i, j, NULL),
			                  1 + 0.01 * ((i + 2 * j) % 5));
	if (surface_check(out, "rational", NULL) != ST_OK)
		abort();
}

/* 20 x 20 points, bicubic, z = 0.6 sin(2.2 x) cos(1.9 y). */
static void make_wavy(struct surface *s)
{
	enum { N = 20 };

	if (surface_init(s, (const int[2]){ 4, 4 }, (const int[2]){ N, N }) != ST_OK)
		abort();
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < N + 4; i++)
			s->knots[d][i] = i < 4 ? 0 : i >= N ? N - 3 : i - 3;
	for (int i = 0; i < N; i++)
		for (int j = 0; j < N; j++) {
			double x = -3 + 6.0 * i / (N - 1), y = -3 + 6.0 * j / (N - 1);

			surface_set_point(s, i, j, vec3(x, y, 0.6 * sin(2.2 * x) * cos(1.9 * y)),
			                  1);
		}
	if (surface_check(s, "wavy", NULL) != ST_OK)
		abort();
}

static bool read_teapot(struct model *m, struct scene *s)
{
	const char *folder = getenv("BATTEN_DATA");
	char path[4096];

	if (!folder)
		return false;
	snprintf(path, sizeof path, "%s/teapot_newell.igs", folder);
	if (model_read(m, path, NULL, NULL) != ST_OK)
		return false;
	s->name = "teapot";
	for (int i = 0; i < m->n && s->n < SURFACES_MAX; i++)
		if (m->entities[i].kind == ENTITY_SURFACE)
			s->surfaces[s->n++] = &m->entities[i].geometry;
	return true;
}

/* `--accuracy` compares the mask with fine triangles, too (takes memory and time). */
int main(int argc, char **argv)
{
	bool accuracy = argc > 1 && !strcmp(argv[1], "--accuracy");
	struct surface wavy, weighted, torus;
	struct model model;
	struct scene teapot = { .goal = 0.5 };

	make_wavy(&wavy);
	make_rational(&weighted, &wavy);
	if (make_torus(&torus, vec3(0, 0, 0), 2, 0.7) != ST_OK)
		return 1;
	if (read_teapot(&model, &teapot)) {
		run(&teapot, accuracy);
		model_finish(&model);
	} else {
		printf("teapot: left out, BATTEN_DATA is not set\n");
	}
	double plain = run(&(struct scene){ "wavy20", { &wavy }, 1, 0.9 }, accuracy);
	double rational =
	        run(&(struct scene){ "wavy20 with weights", { &weighted }, 1, 0 }, accuracy);
	print_row("wavy20", "rational / polynomial", "", rational / plain, 0.85, false);
	run(&(struct scene){ "torus (rational)", { &torus }, 1, 0 }, accuracy);
	surface_finish(&wavy);
	surface_finish(&weighted);
	surface_finish(&torus);
	return 0;
}
