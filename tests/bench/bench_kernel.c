/* bench_kernel.c - speed and accuracy of evaluation and interpolation, beside the peers that are
 * installed, in turn with them in one run. CPU time, medians, one thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "batch.h"
#include "bench.h"
#include "fit.h"
#include "parallel.h"
#include "peer.h"
#include "shapes.h"

enum { LINES = 1000, RANDOM = 200000, ROUNDS = 7, FEW_ROUNDS = 3, CHECK = 201, SIDES = 3 };
enum { GRID_SIDE = 100, CURVE_POINTS = 10000 };

/* One shape, ours or handed to a peer. */
struct job {
	const struct peer *peer; /* NULL: ours */
	struct surface s;
	void *theirs;
	double *lines, *uv;           /* LINES parameters for u and v; RANDOM pairs */
	double *out[N_GRID_CHANNELS]; /* LINES x LINES each */
};

enum kind { GRID_CURVATURES, GRID_POINTS, POINTS, CURVATURES, BATCH, N_KINDS };

static const unsigned four = GRID_BIT(QUANTITY_GAUSSIAN) | GRID_BIT(QUANTITY_MEAN) |
                             GRID_BIT(QUANTITY_KMAX) | GRID_BIT(QUANTITY_KMIN);
static const unsigned xyz =
        GRID_BIT(GRID_POINT_X) | GRID_BIT(GRID_POINT_Y) | GRID_BIT(GRID_POINT_Z);

static double sum_of(const double *x, size_t n)
{
	double sum = 0;
	for (size_t i = 0; i < n; i++)
		sum += x[i];
	return sum;
}

static void grid_fill(struct job *j, unsigned what)
{
	struct grid *g;
	if (grid_create(&g, &j->s, j->lines, LINES, j->lines, LINES) != ST_OK ||
	    grid_rows(g, what, 0, LINES, 0, LINES, j->out) != ST_OK)
		bench_fail("out of memory");
	grid_destroy(g);
}

static double grid_curvatures(void *data)
{
	struct job *j = data;
	if (j->peer)
		j->peer->grid_curvatures(j->theirs, j->lines, LINES);
	else
		grid_fill(j, four);
	return 0;
}

static double grid_curvatures_sum(void *data)
{
	const struct job *j = data;
	return j->peer ? j->peer->grid_sum(j->theirs)
	               : sum_of(j->out[QUANTITY_GAUSSIAN], (size_t)LINES * LINES);
}

static double grid_points(void *data)
{
	struct job *j = data;
	if (j->peer)
		j->peer->grid_points(j->theirs, j->lines, LINES);
	else
		grid_fill(j, xyz);
	return 0;
}

static double grid_points_sum(void *data)
{
	const struct job *j = data;
	double sum = 0;
	if (j->peer)
		return j->peer->grid_sum(j->theirs);
	for (int c = GRID_POINT_X; c <= GRID_POINT_Z; c++)
		sum += sum_of(j->out[c], (size_t)LINES * LINES);
	return sum;
}

static double points(void *data)
{
	struct job *j = data;
	double sum = 0;
	if (j->peer)
		return j->peer->points(j->theirs, j->uv, RANDOM);
	for (int i = 0; i < RANDOM; i++) {
		struct vec3 p = surface_point(&j->s, j->uv[2 * i], j->uv[2 * i + 1]);
		sum += p.x + p.y + p.z;
	}
	return sum;
}

static double curvatures(void *data)
{
	struct job *j = data;
	struct surface_shape p;
	double sum = 0;
	if (j->peer)
		return j->peer->curvatures(j->theirs, j->uv, RANDOM);
	for (int i = 0; i < RANDOM; i++) {
		surface_shape(&j->s, j->uv[2 * i], j->uv[2 * i + 1], &p);
		sum += p.value[QUANTITY_GAUSSIAN];
	}
	return sum;
}

/* A peer has no such call: it takes the points one by one. */
static double batch(void *data)
{
	struct job *j = data;
	if (j->peer)
		return curvatures(j);
	if (surface_shapes(&j->s, j->uv, RANDOM, four, j->out) != ST_OK)
		bench_fail("out of memory");
	return sum_of(j->out[QUANTITY_GAUSSIAN], RANDOM);
}

static const struct {
	const char *row, *what;
	double (*run)(void *job), (*sum)(void *job);
	double count, target[2]; /* of wave10, rat20; M/s */
} kinds[N_KINDS] = {
	[GRID_CURVATURES] = { "",
	                      "K, H, kmax, kmin on 1000 x 1000",
	                      grid_curvatures,
	                      grid_curvatures_sum,
	                      (double)LINES *LINES,
	                      { 110, 34 } },
	[GRID_POINTS] = { "4",
	                  "points on 1000 x 1000",
	                  grid_points,
	                  grid_points_sum,
	                  (double)LINES *LINES,
	                  { 240, 140 } },
	[POINTS] = { "5", "random points, a call each", points, NULL, RANDOM, { 14, 8 } },
	[CURVATURES] = { "", "random curvatures, a call each", curvatures, NULL, RANDOM, { 0, 0 } },
	[BATCH] = { "6", "random curvatures, one batch", batch, NULL, RANDOM, { 14, 6 } },
};

static struct peer_net net_of(const struct surface *s)
{
	return (struct peer_net){ .order = { s->order[0], s->order[1] },
		                  .n = { s->n[0], s->n[1] },
		                  .rational = s->rational,
		                  .knots = { s->knots[0], s->knots[1] },
		                  .points = s->points };
}

static void job_init(struct job *j, struct surface s)
{
	uint64_t seed = 1989;
	*j = (struct job){ .s = s, .lines = bench_room(LINES), .uv = bench_room(2 * RANDOM) };
	grid_lines(0, 1, LINES, j->lines);
	for (int i = 0; i < 2 * RANDOM; i++)
		j->uv[i] = shape_random(&seed);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		j->out[c] = bench_room((size_t)LINES * LINES);
}

static void job_finish(struct job *j)
{
	surface_finish(&j->s);
	free(j->lines);
	free(j->uv);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		free(j->out[c]);
}

/* Counts in the unit of the row from the sides' seconds; ours is the first side. */
static void print_rates(struct bench_row row, const struct bench_side *sides, int n, double count)
{
	row.ours = row.less ? sides[0].cpu / count : count / sides[0].cpu;
	for (int k = 1; k < n; k++)
		row.peer[k - 1] =
		        (struct bench_peer){ sides[k].name, row.less ? sides[k].cpu / count
			                                             : count / sides[k].cpu };
	bench_print(&row);
	printf("  checksums %.10g", sides[0].check);
	for (int k = 1; k < n; k++)
		printf(", %s %.10g", sides[k].name, sides[k].check);
	printf("; wall / CPU %.2f\n", sides[0].wall / sides[0].cpu);
}

/* How many sums are not the known ones, or the peers'. */
static int rates(const char *name, struct surface s, int shape)
{
	static const double known[] = { -16329.3385, -12449.7708 };
	struct job jobs[SIDES];
	int n = 1, wrong = 0;
	job_init(&jobs[0], s);
	for (; peers[n - 1]; n++) {
		const struct peer_net net = net_of(&s);
		jobs[n] = jobs[0];
		jobs[n].peer = peers[n - 1];
		jobs[n].theirs = peers[n - 1]->surface(&net);
	}
	for (int k = 0; k < N_KINDS; k++) {
		struct bench_side sides[SIDES];
		char what[80];
		for (int i = 0; i < n; i++)
			sides[i] = (struct bench_side){ .name = i ? peers[i - 1]->name : "batten",
				                        .run = kinds[k].run,
				                        .sum = kinds[k].sum,
				                        .data = &jobs[i] };
		bench_alternate(sides, n, k == GRID_CURVATURES ? FEW_ROUNDS : ROUNDS);
		snprintf(what, sizeof what, "%s, %s", kinds[k].what, name);
		print_rates((struct bench_row){ .row = k == GRID_CURVATURES ? shape ? "2" : "1"
		                                       : *kinds[k].row      ? kinds[k].row
		                                                            : "-",
		                                .what = what,
		                                .unit = "M/s",
		                                .target = kinds[k].target[shape] },
		            sides, n, kinds[k].count * 1e-6);
		wrong += k == GRID_CURVATURES && !(fabs(sides[0].check - known[shape]) < 1e-4);
		for (int i = 1; i < n; i++)
			wrong += !(fabs(sides[i].check - sides[0].check) <
			           1e-7 * fabs(sides[0].check));
	}
	for (int i = 1; i < n; i++)
		jobs[i].peer->drop(jobs[i].theirs);
	job_finish(&jobs[0]);
	return wrong;
}

/* ---- interpolation ---- */

struct fit_job {
	const struct peer *peer;
	const struct vec3 *p;
	const double *flat;
};

static double fit_grid(void *data)
{
	const struct fit_job *j = data;
	struct surface s;
	if (j->peer)
		return j->peer->interpolate_surface(j->flat, GRID_SIDE);
	if (fit_surface(&s, j->p, GRID_SIDE, GRID_SIDE, (const int[2]){ 4, 4 }, FIT_CHORD, NULL) !=
	    ST_OK)
		bench_fail("no surface through the points");
	surface_finish(&s);
	return (double)GRID_SIDE * GRID_SIDE;
}

static double fit_line(void *data)
{
	const struct fit_job *j = data;
	struct curve c;
	if (j->peer)
		return j->peer->interpolate_curve(j->flat, CURVE_POINTS);
	if (fit_curve(&c, j->p, CURVE_POINTS, 4, FIT_CHORD, NULL) != ST_OK)
		bench_fail("no curve through the points");
	curve_finish(&c);
	return CURVE_POINTS;
}

static struct vec3 grid_point(int i)
{
	const int a = i / GRID_SIDE, b = i % GRID_SIDE;
	return vec3(10.0 * a / 99, 10.0 * b / 99,
	            sin(0.11 * a) * cos(0.07 * b) + 0.2 * sin(0.0013 * a * b));
}

static struct vec3 curve_place(int i)
{
	const double t = i / 9999.0, r = 5 + sin(40 * M_PI * t);
	return vec3(r * cos(20 * M_PI * t), r * sin(20 * M_PI * t),
	            10 * t + 0.3 * cos(60 * M_PI * t));
}

static void interpolation(void)
{
	static const struct {
		const char *what;
		struct vec3 (*place)(int i);
		double (*run)(void *data);
	} cases[] = {
		{ "bicubic through 100 x 100 points", grid_point, fit_grid },
		{ "cubic through 10,000 points", curve_place, fit_line },
	};
	struct vec3 *p = (struct vec3 *)bench_room((size_t)3 * CURVE_POINTS);
	for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
		struct bench_side sides[SIDES];
		struct fit_job jobs[SIDES];
		int n = 0;
		for (int i = 0; i < CURVE_POINTS; i++)
			p[i] = cases[c].place(i);
		do {
			jobs[n] = (struct fit_job){ n ? peers[n - 1] : NULL, p, (double *)p };
			sides[n] = (struct bench_side){ .name = n ? peers[n - 1]->name : "batten",
				                        .run = cases[c].run,
				                        .data = &jobs[n] };
		} while (peers[n++]);
		bench_alternate(sides, n, 15);
		print_rates((struct bench_row){ .row = "7",
		                                .what = cases[c].what,
		                                .unit = "ms",
		                                .target = 0.5,
		                                .less = true },
		            sides, n, 1e-3);
	}
	free(p);
}

/* ---- accuracy ---- */

/* Curvatures of the shapes with a formula, at a point on them; outward normals. */
static void exact_sphere(const double p[3], double kh[2])
{
	(void)p;
	kh[0] = 0.16;
	kh[1] = -0.4;
}

static void exact_torus(const double p[3], double kh[2])
{
	const double rho = hypot(p[0], p[1]);
	kh[0] = (rho - 3) / rho;
	kh[1] = -(2 * rho - 3) / (2 * rho);
}

typedef void exact_values(const double p[3], double kh[2]);

/* Largest error of K over points that are not poles, and over poles; how many have no value. */
struct errors {
	double plain, pole;
	int none;
};

static void errors_add(struct errors *e, exact_values *exact, const double p[3], double k,
                       bool found, bool pole)
{
	double kh[2];
	exact(p, kh);
	double *worst = pole ? &e->pole : &e->plain;
	if (found)
		*worst = fmax(*worst, fabs(k - kh[0]));
	e->none += !found;
}

static void accuracy(const char *name, struct surface s, double target, exact_values *exact)
{
	double lines[CHECK], *out[N_GRID_CHANNELS];
	struct grid *g;
	struct errors ours = { 0 }, theirs[SIDES] = { { 0 } };
	const bool poles = surface_degenerate(&s, 1, 0, 1e-9);
	char what[80];
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		out[c] = bench_room((size_t)CHECK * CHECK);
	grid_lines(0, 1, CHECK, lines);
	if (grid_create(&g, &s, lines, CHECK, lines, CHECK) != ST_OK ||
	    grid_rows(g, four | xyz, 0, CHECK, 0, CHECK, out) != ST_OK)
		bench_fail("out of memory");
	for (int i = 0; i < CHECK * CHECK; i++) {
		const double p[3] = { out[GRID_POINT_X][i], out[GRID_POINT_Y][i],
			              out[GRID_POINT_Z][i] };
		const int row = i / CHECK;
		errors_add(&ours, exact, p, out[QUANTITY_GAUSSIAN][i],
		           isfinite(out[QUANTITY_GAUSSIAN][i]),
		           poles && (row == 0 || row == CHECK - 1));
	}
	for (int k = 0; peers[k]; k++) {
		const struct peer_net net = net_of(&s);
		void *peer = peers[k]->surface(&net);
		for (int i = 0; i < CHECK * CHECK; i++) {
			const int row = i / CHECK;
			double kh[2], p[3] = { 0 };
			const bool found =
			        peers[k]->curvature(peer, lines[i % CHECK], lines[row], kh, p);
			errors_add(&theirs[k], exact, p, kh[0], found,
			           poles && (row == 0 || row == CHECK - 1));
		}
		peers[k]->drop(peer);
	}
	struct bench_row row = { .row = "20",
		                 .what = what,
		                 .unit = "",
		                 .ours = ours.plain,
		                 .target = target,
		                 .less = true };
	snprintf(what, sizeof what, "largest error of K, %s", name);
	for (int k = 0; peers[k]; k++)
		row.peer[k] = (struct bench_peer){ peers[k]->name, theirs[k].plain };
	bench_print(&row);
	if (poles) {
		row = (struct bench_row){ .row = "21",
			                  .what = "error of K at the poles of a sphere",
			                  .unit = "",
			                  .ours = ours.pole,
			                  .target = 1e-6,
			                  .less = true };
		bench_print(&row);
		for (int k = 0; peers[k]; k++)
			printf("  %s: %d of %d without a value, error of the others %.2g\n",
			       peers[k]->name, theirs[k].none, 2 * CHECK, theirs[k].pole);
	}
	grid_destroy(g);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		free(out[c]);
	surface_finish(&s);
}

int main(void)
{
	printf("vector level %s, one thread\n", vector_level());
	for (int k = 0; peers[k]; k++)
		printf("peer %s %s\n", peers[k]->name, peers[k]->version ? peers[k]->version : "");
	const int wrong = rates("wave10", shape_wave10(), 0) + rates("rat20", shape_rat20(), 1);
	interpolation();
	accuracy("sphere", shape_sphere(2.5), 3e-13, exact_sphere);
	accuracy("torus", shape_torus(3, 1), 1e-14, exact_torus);
	if (wrong)
		printf("%d sums are not what they must be\n", wrong);
	return wrong != 0;
}
