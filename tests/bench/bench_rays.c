/* bench_rays.c - rays against surfaces, beside Embree's triangles of the same surfaces.
 *
 * One view of 1024 x 1024 pixels, a ray each and a shadow ray for each lit hit, in blocks of 4 x 4.
 * Peers take turns round by round; figures are medians over CPU time of one thread. The teapot is
 * read from $BATTEN_DATA, where that is set.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "construct.h"
#include "model.h"
#include "rays_frame.h"
#include "rays_mesh.h"
#include "rays_pov.h"

enum { ROUNDS = 5 };

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

/* How far the hits of a view lie from surface and ray, against the model's size. */
static void report_errors(const struct scene *s, const struct frame *f)
{
	size_t n = 0;
	double *error = bench_room((size_t)SIZE * SIZE);

	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++) {
			const struct ray_hit *h = &f->hits[(size_t)y * SIZE + x];

			if (h->surface < 0)
				continue;
			struct vec3 on_ray =
			        vec3_along(f->view->eye, h->t, view_direction(f->view, x, y));
			struct vec3 on_surface = surface_point(s->surfaces[h->surface], h->u, h->v);
			error[n++] = vec3_length(vec3_sub(on_ray, on_surface)) / f->view->size;
		}
	if (!n)
		bench_fail("no ray hits");
	print_row(s->name, "median error of a hit / size", "", bench_median(error, n), 1e-8, true);
	printf("  the worst %.1e\n", error[n - 1]);
	free(error);
}

/* Pixels that one of surface and fine triangles covers, and the other does not. */
static void report_mask(const struct scene *s, const struct frame *f, const float *mesh_depth,
                        int steps)
{
	size_t wrong = 0;
	char what[80];

	for (size_t p = 0; p < (size_t)SIZE * SIZE; p++)
		wrong += (f->hits[p].surface >= 0) != (bool)isfinite(mesh_depth[p]);
	snprintf(what, sizeof what, "pixels of the mask other than of triangles %dx%d", steps,
	         steps);
	print_row(s->name, what, "per million", (double)wrong * 1e6 / (SIZE * SIZE), 5, true);
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
			                  : frame_singles(scene, view, image);
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

	if (!image || !depth || !hits)
		bench_fail("out of memory");
	double start, creating[ROUNDS];
	for (int round = 0; round < ROUNDS; round++) {
		start = bench_cpu();
		if (ray_scene_create(&scene, s->surfaces, s->n, 0, NULL) != ST_OK)
			bench_fail("cannot prepare a scene");
		creating[round] = bench_cpu() - start;
		if (round + 1 < ROUNDS)
			ray_scene_destroy(scene);
	}
	prepare[2] = bench_median(creating, ROUNDS);
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
	double threads[ROUNDS], clock[ROUNDS]; /* two of them against one, round by round */
	for (int round = 0; round < ROUNDS; round++) {
		threads[round] = 2 * ours[round] / both[round];
		clock[round] = wall[round] / two[round];
	}
	double speed = (double)rays / bench_median(ours, ROUNDS) / 1e6;
	double peer[2];
	for (int k = 0; k < 2; k++)
		peer[k] = (double)mesh_rays[k] / bench_median(theirs[k], ROUNDS) / 1e6;
	printf("%s: %zu leaves\n", s->name, ray_scene_leaves(scene));
	/* on a machine with other work to do, CPU time says what wall time cannot */
	double middle = bench_median(threads, ROUNDS); /* sorts */
	printf("  2 threads / 1: by CPU time %.2f to %.2f, by the clock %.2f\n", threads[0],
	       threads[ROUNDS - 1], bench_median(clock, ROUNDS));
	print_rows(s, speed, peer);
	print_row(s->name, "2 threads / 1, CPU time", "x", middle, 1.85, false);
	print_row(s->name, "memory / triangles 128x128", "",
	          (double)ray_scene_memory(scene) / (double)mesh[1].bytes, 0.1, true);
	print_row(s->name, "preparing / triangles 128x128", "", prepare[2] / prepare[1], 0.1, true);
	run_singles(s, scene, &mesh[0], &view, image);
	run_pov(s, &view, (double)rays / speed / 1e6);
	for (int k = 0; k < 2; k++)
		mesh_finish(&mesh[k]);
	frame.hits = hits;
	frame_run(&frame, 1);
	report_errors(s, &frame);
	/* of surfaces with many spans that takes much memory and time */
	if (accuracy || s->n > 1) {
		int fine = s->n > 1 ? 256 : 128;

		mesh_build(&mesh[0], s, fine, true);
		mesh_frame(&mesh[0], &view, image, depth);
		report_mask(s, &frame, depth, fine);
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

/* `--accuracy` compares every mask with fine triangles (takes memory and time). */
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
