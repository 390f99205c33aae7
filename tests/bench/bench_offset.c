/* bench_offset.c - the surface at a distance from another, beside the peers that are installed, in
 * turn with them in one run. CPU time, medians, one thread; errors are found on points that nobody's
 * check knows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "construct.h"
#include "curvature.h"
#include "peer.h"
#include "shapes.h"

enum { SIDES = BENCH_PEERS + 1, ROUNDS = 7, CHECK = 97 };

static const double distance = 0.1, tolerance = 1e-3;

/* One side's result, kept from the last round. */
struct job {
	const struct peer *peer; /* NULL: ours */
	const struct surface *s;
	void *theirs, *found;  /* the surface; its offset */
	struct surface offset; /* ours */
	double stated;         /* error that ours says it has */
};

static void job_drop(struct job *j)
{
	surface_finish(&j->offset);
	j->offset = (struct surface){ .points = NULL };
	if (j->found)
		j->peer->drop(j->found);
	j->found = NULL;
}

static double run(void *data)
{
	struct job *j = data;
	job_drop(j);
	if (j->peer) {
		j->found = j->peer->offset(j->theirs, distance, tolerance);
		return j->found != NULL;
	}
	if (make_offset(&j->offset, j->s, distance, tolerance, &j->stated, NULL) != ST_OK)
		bench_fail("no offset");
	return 1;
}

static struct vec3 point_of(const struct job *j, double u, double v)
{
	double kh[2], p[3] = { NAN, NAN, NAN };
	if (!j->peer)
		return surface_point(&j->offset, u, v);
	j->peer->curvature(j->found, u, v, kh, p);
	return vec3(p[0], p[1], p[2]);
}

/* Largest distance from the exact offset at the same parameters. */
static double error_of(const struct job *j)
{
	double worst = 0;
	for (int i = 0; i < CHECK * CHECK; i++) {
		const double u = (i / CHECK + 0.5) / CHECK, v = (i % CHECK + 0.5) / CHECK;
		struct vec3 normal;
		if (!surface_normal(j->s, u, v, &normal))
			bench_fail("no normal");
		const struct vec3 exact = vec3_along(surface_point(j->s, u, v), distance, normal);
		worst = fmax(worst, vec3_length(vec3_sub(point_of(j, u, v), exact)));
	}
	return worst;
}

int main(void)
{
	struct surface s = shape_wave10();
	const struct peer_net net = { .order = { s.order[0], s.order[1] },
		                      .n = { s.n[0], s.n[1] },
		                      .knots = { s.knots[0], s.knots[1] },
		                      .points = s.points };
	struct job jobs[SIDES] = { { .s = &s } };
	struct bench_side sides[SIDES] = { { .name = "batten", .run = run, .data = &jobs[0] } };
	int n = 1;
	for (; peers[n - 1]; n++) {
		jobs[n] = (struct job){ .peer = peers[n - 1],
			                .s = &s,
			                .theirs = peers[n - 1]->surface(&net) };
		sides[n] = (struct bench_side){ .name = peers[n - 1]->name,
			                        .run = run,
			                        .data = &jobs[n] };
	}
	bench_alternate(sides, n, ROUNDS);

	struct bench_row row = { .row = "17",
		                 .what = "offset surface, wave10, 0.1 within 1e-3",
		                 .unit = "ms",
		                 .ours = 1e3 * sides[0].cpu,
		                 .target = 5,
		                 .less = true };
	double error[SIDES];
	for (int k = 0; k < n; k++) {
		error[k] = k && !jobs[k].found ? INFINITY : error_of(&jobs[k]);
		if (k && error[k] <= tolerance) /* to miss it quickly is no feat */
			row.peer[k - 1] = (struct bench_peer){ sides[k].name, 1e3 * sides[k].cpu };
	}
	bench_print(&row);
	bench_print(&(struct bench_row){ .row = "17",
	                                 .what = "its points, of 56 x 56",
	                                 .unit = "points",
	                                 .ours = jobs[0].offset.n[0] * jobs[0].offset.n[1],
	                                 .target = 56 * 56,
	                                 .less = true });
	printf("  batten: %d x %d points, order %d, error %.2g (stated %.2g)\n",
	       jobs[0].offset.n[0], jobs[0].offset.n[1], jobs[0].offset.order[0], error[0],
	       jobs[0].stated);
	for (int k = 1; k < n; k++) {
		int poles[2];
		if (!jobs[k].found)
			continue;
		jobs[k].peer->poles(jobs[k].found, poles);
		printf("  %s: %d x %d points, error %.2g, %.3g ms%s\n", sides[k].name, poles[0],
		       poles[1], error[k], 1e3 * sides[k].cpu,
		       error[k] <= tolerance ? "" : ": misses the tolerance, not compared");
	}
	for (int k = 0; k < n; k++) {
		job_drop(&jobs[k]);
		if (jobs[k].theirs)
			jobs[k].peer->drop(jobs[k].theirs);
	}
	surface_finish(&s);
	return !(error[0] <= tolerance);
}
