/* bench_images.c - what image files cost: the share of packing in a job's CPU time, and a killed job's
 * part file made whole. The argument names the folder of the workers. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"
#include "exr.h"
#include "iges.h"
#include "part.h"
#include "shapes.h"

enum { ROUNDS = 3, TILE = 64, PATH = 300 };

static char folder[] = "/tmp/batten-bench-XXXXXX";

static void place(char path[PATH], const char *name)
{
	snprintf(path, PATH, "%s/%s", folder, name);
}

static void make_hull(const char *path)
{
	struct model m;
	struct entity e;

	model_init(&m);
	entity_init(&e, ENTITY_SURFACE);
	e.geometry = shape_wave10();
	if (model_add(&m, &e) != ST_OK || iges_write(&m, path, NULL) != ST_OK)
		bench_fail("cannot write the surface");
	model_finish(&m);
}

/* CPU seconds of a worker run by hand on one thread. */
static double job_cpu(const char *workers, const char *worker, const char *option, const char *size)
{
	char program[PATH * 2], input[PATH], output[PATH];
	struct rusage used;
	int status;

	snprintf(program, sizeof program, "%s/batten-%s", workers, worker);
	place(input, "hull.igs");
	place(output, "out");
	const pid_t pid = fork();
	if (pid == 0) {
		const int silent = open("/dev/null", O_WRONLY | O_CLOEXEC);

		dup2(silent, STDOUT_FILENO);
		dup2(silent, STDERR_FILENO);
		execl(program, program, input, option, size, "-o", output, "--threads", "1",
		      "--force", (char *)NULL);
		_exit(127);
	}
	if (pid < 0 || wait4(pid, &status, 0, &used) < 0 || !WIFEXITED(status) ||
	    WEXITSTATUS(status))
		bench_fail("a worker fails");
	return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
	       1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/* All tiles of a picture packed again; units[i] (may be NULL) takes the bytes. CPU seconds. */
static double pack(const struct exr_picture *p, const struct exr_image *im, struct text *units)
{
	float *room = malloc(sizeof *room * TILE * TILE * im->n_channels);
	const float *planes[EXR_CHANNELS_MAX];
	struct text bytes = { 0 };
	double cpu = 0;

	if (!room)
		bench_fail("out of memory");
	for (size_t i = 0; i < exr_tiles(im); i++) {
		int x, y, w, h;

		exr_tile_window(im, i, &x, &y, &w, &h);
		for (int c = 0; c < im->n_channels; c++) {
			float *to = room + (size_t)c * TILE * TILE;

			planes[c] = to;
			for (int row = 0; row < h; row++)
				memcpy(to + (size_t)row * w,
				       p->planes[c] + (size_t)(y + row) * p->width + x,
				       sizeof *to * w);
		}
		text_reset(&bytes);
		const double start = bench_cpu();
		if (exr_pack(im, i, planes, units ? &units[i] : &bytes) != ST_OK)
			bench_fail("cannot pack");
		cpu += bench_cpu() - start;
	}
	free(room);
	text_finish(&bytes);
	return cpu;
}

/* A picture's layout, as the workers write it. */
static void layout(const struct exr_picture *p, struct exr_image *im, struct exr_channel *channels)
{
	for (int c = 0; c < p->n_channels; c++)
		channels[c] =
		        (struct exr_channel){ p->names[c], strlen(p->names[c]) == 1 &&
			                                           strchr("RGBA", p->names[c][0]) };
	*im = (struct exr_image){ .width = p->width,
		                  .height = p->height,
		                  .tile = TILE,
		                  .channels = channels,
		                  .n_channels = p->n_channels };
}

static void share(const char *workers, const char *worker, const char *option, const char *size,
                  const char *name)
{
	double job[ROUNDS], packing[ROUNDS];
	struct exr_channel channels[EXR_CHANNELS_MAX];
	struct exr_picture p;
	struct exr_image im;
	char path[PATH], what[120];

	place(path, name);
	for (int k = 0; k < ROUNDS; k++) {
		job[k] = job_cpu(workers, worker, option, size);
		if (exr_read(&p, path, NULL) != ST_OK)
			bench_fail("cannot read a result");
		layout(&p, &im, channels);
		packing[k] = pack(&p, &im, NULL);
		exr_picture_finish(&p);
	}
	const double of = bench_median(job, ROUNDS), part = bench_median(packing, ROUNDS);
	snprintf(what, sizeof what, "packing in a job's CPU time, %s %s", worker, size);
	bench_print(&(struct bench_row){ .row = "files",
	                                 .what = what,
	                                 .unit = "%",
	                                 .ours = 100 * part / of,
	                                 .target = 30,
	                                 .less = true });
	printf("  %d channels, %.2f of %.2f s\n", im.n_channels, part, of);
	unlink(path);
}

static enum status from_part(void *data, size_t i, const char **bytes, size_t *n)
{
	return part_get(data, i, bytes, n, NULL);
}

/* 1024 finished tiles that a killed job left, into a whole file. */
static void salvage(const char *workers)
{
	double wall[ROUNDS];
	struct exr_channel channels[EXR_CHANNELS_MAX];
	struct exr_picture p;
	struct exr_image im;
	struct part *part;
	char result[PATH], left[PATH], whole[PATH];

	place(result, "out.shade.exr");
	place(left, "left.part");
	place(whole, "whole.exr");
	job_cpu(workers, "shading", "--size", "2048x2048");
	if (exr_read(&p, result, NULL) != ST_OK)
		bench_fail("cannot read a result");
	layout(&p, &im, channels);
	const size_t n = exr_tiles(&im);
	struct text *units = calloc(n, sizeof *units);
	if (!units || part_open(&part, left, "bench", n, NULL) != ST_OK)
		bench_fail("cannot make a part file");
	pack(&p, &im, units);
	for (size_t i = 0; i < n; i++) {
		if (part_put(part, i, units[i].s, units[i].n, NULL) != ST_OK)
			bench_fail("cannot write a part file");
		text_finish(&units[i]);
	}
	part_close(part);
	for (int k = 0; k < ROUNDS; k++) {
		const double start = bench_wall();

		if (part_open(&part, left, "bench", n, NULL) != ST_OK || part_count(part) != n ||
		    exr_write(whole, &im, from_part, part, NULL) != ST_OK)
			bench_fail("cannot make a part file whole");
		part_close(part);
		wall[k] = 1e3 * (bench_wall() - start);
	}
	char what[80];
	snprintf(what, sizeof what, "a part file of %zu tiles made whole", n);
	bench_print(&(struct bench_row){ .row = "files",
	                                 .what = what,
	                                 .unit = "ms",
	                                 .ours = bench_median(wall, ROUNDS),
	                                 .target = 100,
	                                 .less = true });
	free(units);
	exr_picture_finish(&p);
	unlink(result);
	unlink(left);
	unlink(whole);
}

int main(int argc, char **argv)
{
	char hull[PATH];

	if (argc < 2)
		bench_fail("name the folder of the workers");
	if (!mkdtemp(folder))
		bench_fail("cannot make a folder");
	place(hull, "hull.igs");
	make_hull(hull);
	share(argv[1], "shading", "--size", "2000x2000", "out.shade.exr");
	share(argv[1], "raytrace", "--size", "2000x2000", "out.trace.exr");
	share(argv[1], "curvature", "--grid", "2000x2000", "out.map.exr");
	salvage(argv[1]);
	unlink(hull);
	rmdir(folder);
	return 0;
}
