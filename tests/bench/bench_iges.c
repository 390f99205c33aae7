/* bench_iges.c - IGES files to splines in memory, beside Open CASCADE where it was found. The files
 * are written here: 200 surfaces, 20 curves. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bench.h"
#include "fit.h"
#include "iges.h"
#include "model.h"
#include "peer.h"
#include "shapes.h"

enum { SURFACES = 200, CURVES = 20, CURVE_POINTS = 2000, ROUNDS = 7 };

static void add(struct model *m, struct entity *e)
{
	if (model_add(m, e) != ST_OK)
		bench_fail("out of memory");
}

static void make_surfaces(struct model *m)
{
	for (int k = 0; k < SURFACES; k++) {
		struct entity e;
		entity_init(&e, ENTITY_SURFACE);
		e.geometry = k % 2 ? shape_rat20()
		                   : shape_surface((const int[2]){ 4, 4 }, (const int[2]){ 30, 30 },
		                                   false, KNOTS_CLAMPED, k + 1);
		add(m, &e);
	}
}

static void make_curves(struct model *m)
{
	struct vec3 *p = (struct vec3 *)bench_room((size_t)3 * CURVE_POINTS);
	for (int k = 0; k < CURVES; k++) {
		struct entity e;
		entity_init(&e, ENTITY_CURVE);
		for (int i = 0; i < CURVE_POINTS; i++) {
			const double t = (5 * i + k) / 9999.0, r = 5 + sin(40 * M_PI * t);
			p[i] = vec3(r * cos(20 * M_PI * t), r * sin(20 * M_PI * t),
			            10 * t + 0.3 * cos(60 * M_PI * t) + k);
		}
		if (fit_curve(&e.curve, p, CURVE_POINTS, 4, FIT_CHORD, NULL) != ST_OK)
			bench_fail("no curve through the points");
		add(m, &e);
	}
	free(p);
}

static double read_ours(void *data)
{
	struct model m;
	if (model_read(&m, data, NULL, NULL) != ST_OK)
		bench_fail("cannot read what was written");
	const int n = m.n;
	model_finish(&m);
	return n;
}

#ifdef HAVE_OCCT
static double read_theirs(void *data)
{
	return peer_occt.read_iges(data);
}
#endif

static int compare(const char *what, const char *folder, void (*make)(struct model *), int n)
{
	struct bench_side sides[2] = { { .name = "batten", .run = read_ours } };
	struct model m;
	struct stat info;
	char path[4096];
	model_init(&m);
	if (model_set_text(&m.unit, "mm") != ST_OK)
		bench_fail("out of memory");
	m.unit_in_mm = 1;
	make(&m);
	snprintf(path, sizeof path, "%s/bench.igs", folder);
	if (iges_write(&m, path, NULL) != ST_OK || stat(path, &info) < 0)
		bench_fail("cannot write the file");
	model_finish(&m);
	const double megabytes = (double)info.st_size * 1e-6;
	sides[0].data = sides[1].data = path;
#ifdef HAVE_OCCT
	sides[1].name = peer_occt.name;
	sides[1].run = read_theirs;
#endif
	bench_alternate(sides, 2, ROUNDS);
	unlink(path);
	struct bench_row row = { .row = "19",
		                 .what = what,
		                 .unit = "MB/s",
		                 .ours = megabytes / sides[0].cpu,
		                 .target = 150 };
	if (sides[1].run)
		row.peer[0] = (struct bench_peer){ sides[1].name, megabytes / sides[1].cpu };
	bench_print(&row);
	printf("  %.1f MB, %.0f read", megabytes, sides[0].check);
	if (sides[1].run)
		printf(", %s %.0f", sides[1].name, sides[1].check);
	putchar('\n');
	return sides[0].check != n;
}

int main(void)
{
	char folder[] = "/tmp/batten-bench-XXXXXX";
	if (!mkdtemp(folder))
		bench_fail("cannot make a folder");
	const int wrong = compare("IGES 128 to memory", folder, make_surfaces, SURFACES) +
	                  compare("IGES 126 to memory", folder, make_curves, CURVES);
	rmdir(folder);
	return wrong;
}
