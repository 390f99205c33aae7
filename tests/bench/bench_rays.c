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
#include <time.h>

#include "bezier.h"
#include "construct.h"
#include "model.h"
#include "parallel.h"
#include "ray_scene.h"

enum { SIZE = 1024, TILE = 32, ROUNDS = 5, PACKET = 16, SURFACES_MAX = 64 };

struct scene {
	const char *name;
	const struct surface *surfaces[SURFACES_MAX]; /* borrowed */
	int n;
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

static double cpu_seconds(void)
{
	struct timespec t;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double wall_seconds(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

static double median(double *x, size_t n)
{
	qsort(x, n, sizeof *x, compare);
	return x[n / 2];
}

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

/* ---- ours ---- */

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
	double middle = n ? median(error, n) : 0; /* sorts */
	printf("  hits on surface and ray: median %.1e, worst %.1e of the size\n", middle,
	       n ? error[n - 1] : 0);
	printf("  mask against triangles %dx%d: %.1f pixels per million differ\n", steps, steps,
	       (double)wrong * 1e6 / (SIZE * SIZE));
	free(error);
}

static void run(const struct scene *s, bool accuracy)
{
	static const int steps[2] = { 32, 128 };
	struct ray_scene *scene;
	struct mesh mesh[2];
	double ours[ROUNDS], wall[ROUNDS], two[ROUNDS], both[ROUNDS], theirs[2][ROUNDS], prepare[3];
	size_t rays = 0, mesh_rays[2] = { 0 };
	float *image = malloc(sizeof *image * SIZE * SIZE);
	float *depth = malloc(sizeof *depth * SIZE * SIZE);
	struct ray_hit *hits = malloc(sizeof *hits * SIZE * SIZE);

	double start = cpu_seconds();
	if (!image || !depth || !hits ||
	    ray_scene_create(&scene, s->surfaces, s->n, 0, NULL) != ST_OK)
		abort();
	prepare[2] = cpu_seconds() - start;
	struct box box = ray_scene_box(scene);
	struct view view = view_fit(&box);
	struct frame frame = { .scene = scene, .view = &view, .image = image, .depth = depth };
	for (int k = 0; k < 2; k++) {
		start = cpu_seconds();
		mesh_build(&mesh[k], s, steps[k], false);
		prepare[k] = cpu_seconds() - start;
	}
	for (int round = 0; round < ROUNDS; round++) {
		start = cpu_seconds();
		double begun = wall_seconds();
		rays = frame_run(&frame, 1);
		wall[round] = wall_seconds() - begun;
		ours[round] = cpu_seconds() - start;
		begun = wall_seconds();
		start = cpu_seconds();
		frame_run(&frame, 2);
		two[round] = wall_seconds() - begun;
		both[round] = cpu_seconds() - start;
		for (int k = 0; k < 2; k++) {
			start = cpu_seconds();
			mesh_rays[k] = mesh_frame(&mesh[k], &view, image, depth);
			theirs[k][round] = cpu_seconds() - start;
		}
	}
	double speed = (double)rays / median(ours, ROUNDS) / 1e6;
	double peer[2];
	for (int k = 0; k < 2; k++)
		peer[k] = (double)mesh_rays[k] / median(theirs[k], ROUNDS) / 1e6;
	printf("%s: %zu leaves, %.2f Mrays/s; triangles %dx%d %.2f (ratio %.2f), %dx%d %.2f "
	       "(ratio %.2f)\n",
	       s->name, ray_scene_leaves(scene), speed, steps[0], steps[0], peer[0],
	       speed / peer[0], steps[1], steps[1], peer[1], speed / peer[1]);
	/* on a machine with other work to do, CPU time says what wall time cannot */
	printf("  2 threads / 1: %.2f by the clock, %.2f by CPU time; memory / triangles %dx%d: %.3f; prepare: %.3f\n",
	       median(wall, ROUNDS) / median(two, ROUNDS),
	       2 * median(ours, ROUNDS) / median(both, ROUNDS), steps[1], steps[1],
	       (double)ray_scene_memory(scene) / (double)mesh[1].bytes, prepare[2] / prepare[1]);
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
	struct surface wavy, torus;
	struct model model;
	struct scene teapot = { 0 };

	make_wavy(&wavy);
	if (make_torus(&torus, vec3(0, 0, 0), 2, 0.7) != ST_OK)
		return 1;
	if (read_teapot(&model, &teapot)) {
		run(&teapot, accuracy);
		model_finish(&model);
	} else {
		printf("teapot: left out, BATTEN_DATA is not set\n");
	}
	run(&(struct scene){ .name = "wavy20", .surfaces = { &wavy }, .n = 1 }, accuracy);
	run(&(struct scene){ .name = "torus (rational)", .surfaces = { &torus }, .n = 1 },
	    accuracy);
	surface_finish(&wavy);
	surface_finish(&torus);
	return 0;
}
