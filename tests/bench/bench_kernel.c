/* bench_kernel.c - speed and accuracy of evaluation: grids of curvatures and points, single points,
 * known surfaces and their poles; beside SISL where it was found, in turn with it in one run.
 * Times are CPU time of this process, medians; one thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#ifdef HAVE_SISL
#include <sisl.h>
#endif

#include "batch.h"
#include "parallel.h"
#include "shapes.h"

enum { LINES = 1000, RANDOM = 200000, RUNS = 9, CHECK = 201 };

/* One shape with all that both sides need. */
struct bench {
	const char *name;
	struct surface s;
	double *lines;                /* owned: LINES parameters for u and v */
	double *uv;                   /* owned: RANDOM pairs */
	double *out[N_GRID_CHANNELS]; /* owned: LINES x LINES each */
	double check;                 /* a sum over the last run's results */
#ifdef HAVE_SISL
	SISLSurf *peer;
	double *derivatives, *normals; /* owned: what s1506 fills */
#endif
};

typedef void action(struct bench *b);

static double cpu_seconds(void)
{
	struct timespec t;
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static void *need(size_t n)
{
	void *p = calloc(n, sizeof(double));
	if (!p) {
		fprintf(stderr, "bench-kernel: out of memory\n");
		exit(1);
	}
	return p;
}

static void grid_fill(struct bench *b, unsigned what)
{
	struct grid *g;
	if (grid_create(&g, &b->s, b->lines, LINES, b->lines, LINES) != ST_OK ||
	    grid_rows(g, what, 0, LINES, 0, LINES, b->out) != ST_OK) {
		fprintf(stderr, "bench-kernel: no memory for a grid\n");
		exit(1);
	}
	grid_destroy(g);
}

static double grid_sum(const struct bench *b, int channel)
{
	double sum = 0;
	for (int i = 0; i < LINES * LINES; i++)
		sum += b->out[channel][i];
	return sum;
}

static void our_curvatures(struct bench *b)
{
	grid_fill(b, GRID_BIT(QUANTITY_GAUSSIAN) | GRID_BIT(QUANTITY_MEAN) |
	                     GRID_BIT(QUANTITY_KMAX) | GRID_BIT(QUANTITY_KMIN));
}

static void our_points(struct bench *b)
{
	grid_fill(b, GRID_BIT(GRID_POINT_X) | GRID_BIT(GRID_POINT_Y) | GRID_BIT(GRID_POINT_Z));
}

static void our_random(struct bench *b)
{
	b->check = 0;
	for (int i = 0; i < RANDOM; i++) {
		struct vec3 p = surface_point(&b->s, b->uv[2 * i], b->uv[2 * i + 1]);
		b->check += p.x + p.y + p.z;
	}
}

static void our_shapes(struct bench *b)
{
	struct surface_shape p;
	b->check = 0;
	for (int i = 0; i < RANDOM; i++) {
		surface_shape(&b->s, b->uv[2 * i], b->uv[2 * i + 1], &p);
		b->check += p.value[QUANTITY_GAUSSIAN];
	}
}

static void our_batch(struct bench *b)
{
	if (surface_shapes(&b->s, b->uv, RANDOM,
	                   GRID_BIT(QUANTITY_GAUSSIAN) | GRID_BIT(QUANTITY_MEAN) |
	                           GRID_BIT(QUANTITY_KMAX) | GRID_BIT(QUANTITY_KMIN),
	                   b->out) != ST_OK)
		exit(1);
	b->check = 0;
	for (int i = 0; i < RANDOM; i++)
		b->check += b->out[QUANTITY_GAUSSIAN][i];
}

#ifdef HAVE_SISL
static SISLSurf *peer_surface(const struct surface *s)
{
	const int dim = s->rational ? 4 : 3;
	double *points = need((size_t)dim * s->n[0] * s->n[1]);
	for (int i = 0; i < s->n[0]; i++)
		for (int j = 0; j < s->n[1]; j++)
			memcpy(points + (size_t)dim * (j * s->n[0] + i),
			       s->points + (size_t)4 * (i * s->n[1] + j), sizeof(double) * dim);
	SISLSurf *out = newSurf(s->n[0], s->n[1], s->order[0], s->order[1], s->knots[0],
	                        s->knots[1], points, s->rational ? 2 : 1, 3, 1);
	free(points);
	return out;
}

/* K, H, kmax, kmin from S Su Sv Suu Suv Svv, the plain way. */
static void plain_curvatures(const double *d, double out[4])
{
	const double *u = d + 3, *v = d + 6;
	const double n[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
		              u[0] * v[1] - u[1] * v[0] };
	double first[3] = { 0 }, second[3] = { 0 }, area2 = 0;
	for (int c = 0; c < 3; c++) {
		first[0] += u[c] * u[c];
		first[1] += u[c] * v[c];
		first[2] += v[c] * v[c];
		area2 += n[c] * n[c];
		for (int k = 0; k < 3; k++)
			second[k] += n[c] * d[9 + 3 * k + c];
	}
	out[0] = (second[0] * second[2] - second[1] * second[1]) / (area2 * area2);
	out[1] = (first[0] * second[2] - 2 * first[1] * second[1] + first[2] * second[0]) /
	         (2 * area2 * sqrt(area2));
	const double half = sqrt(fmax(out[1] * out[1] - out[0], 0));
	out[2] = out[1] + half;
	out[3] = out[1] - half;
}

static void peer_curvatures(struct bench *b)
{
	int status;
	s1506(b->peer, 2, LINES, b->lines, LINES, b->lines, b->derivatives, b->normals, &status);
	b->check = 0;
	for (size_t i = 0; i < (size_t)LINES * LINES; i++) {
		double k[4];
		plain_curvatures(b->derivatives + 18 * i, k);
		b->check += k[0];
		for (int c = 0; c < 4; c++)
			b->out[c][i] = k[c];
	}
}

static void peer_points(struct bench *b)
{
	int status;
	s1506(b->peer, 0, LINES, b->lines, LINES, b->lines, b->derivatives, b->normals, &status);
}

static void peer_random(struct bench *b)
{
	int left[2] = { 0, 0 }, status;
	double p[3], normal[3];
	b->check = 0;
	for (int i = 0; i < RANDOM; i++) {
		s1421(b->peer, 0, b->uv + (size_t)2 * i, &left[0], &left[1], p, normal, &status);
		b->check += p[0] + p[1] + p[2];
	}
}

static void peer_shapes(struct bench *b)
{
	int left[2] = { 0, 0 }, status;
	double d[18], normal[3], k[4];
	b->check = 0;
	for (int i = 0; i < RANDOM; i++) {
		s1421(b->peer, 2, b->uv + (size_t)2 * i, &left[0], &left[1], d, normal, &status);
		plain_curvatures(d, k);
		b->check += k[0];
	}
}
#else
#define peer_curvatures NULL
#define peer_points     NULL
#define peer_random     NULL
#define peer_shapes     NULL
#endif

/* Medians of both sides, run in turn. */
static void compare_rates(const char *what, struct bench *b, double count, double target,
                          action *ours, action *peer)
{
	double t[2][RUNS];
	for (int r = 0; r < RUNS; r++)
		for (int side = 0; side < 2; side++) {
			action *run = side ? peer : ours;
			const double start = cpu_seconds();
			if (run)
				run(b);
			t[side][r] = cpu_seconds() - start;
		}
	for (int side = 0; side < 2; side++)
		qsort(t[side], RUNS, sizeof t[side][0], compare);
	const double mine = count / t[0][RUNS / 2] * 1e-6;
	printf("%-34s %-7s %7.1f M/s", what, b->name, mine);
	if (peer) {
		const double other = count / t[1][RUNS / 2] * 1e-6;
		printf("   SISL %6.1f M/s   ratio %5.1f", other, mine / other);
	}
	if (target > 0)
		printf("   target %g M/s", target);
	putchar('\n');
}

static void bench_init(struct bench *b, const char *name, struct surface s)
{
	uint64_t seed = 1989;
	*b = (struct bench){ .name = name, .s = s };
	b->lines = need(LINES);
	grid_lines(0, 1, LINES, b->lines);
	b->uv = need((size_t)2 * RANDOM);
	for (int i = 0; i < 2 * RANDOM; i++)
		b->uv[i] = shape_random(&seed);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		b->out[c] = need((size_t)LINES * LINES);
#ifdef HAVE_SISL
	b->peer = peer_surface(&s);
	b->derivatives = need((size_t)18 * LINES * LINES);
	b->normals = need((size_t)3 * LINES * LINES);
#endif
}

static void bench_finish(struct bench *b)
{
	surface_finish(&b->s);
	free(b->lines);
	free(b->uv);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		free(b->out[c]);
#ifdef HAVE_SISL
	freeSurf(b->peer);
	free(b->derivatives);
	free(b->normals);
#endif
}

/* Curvatures of the shapes with a formula, at a point on them; outward normals. */
static void exact_sphere(struct vec3 p, double *gaussian, double *mean)
{
	(void)p;
	*gaussian = 0.16;
	*mean = -0.4;
}

static void exact_torus(struct vec3 p, double *gaussian, double *mean)
{
	const double rho = hypot(p.x, p.y);
	*gaussian = (rho - 3) / rho;
	*mean = -(2 * rho - 3) / (2 * rho);
}

static void compare_errors(const char *name, struct surface s, double target,
                           void (*exact)(struct vec3, double *, double *))
{
	double lines[CHECK], ours[2] = { 0, 0 }, poles = 0, *out[N_GRID_CHANNELS];
	struct grid *g;
	unsigned what = GRID_BIT(QUANTITY_GAUSSIAN) | GRID_BIT(QUANTITY_MEAN) |
	                GRID_BIT(GRID_POINT_X) | GRID_BIT(GRID_POINT_Y) | GRID_BIT(GRID_POINT_Z);
	const bool sphere = surface_degenerate(&s, 1, 0, 1e-9);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		out[c] = need((size_t)CHECK * CHECK);
	grid_lines(0, 1, CHECK, lines);
	if (grid_create(&g, &s, lines, CHECK, lines, CHECK) != ST_OK ||
	    grid_rows(g, what, 0, CHECK, 0, CHECK, out) != ST_OK)
		exit(1);
	for (int i = 0; i < CHECK * CHECK; i++) {
		double k, h;
		exact(vec3(out[GRID_POINT_X][i], out[GRID_POINT_Y][i], out[GRID_POINT_Z][i]), &k,
		      &h);
		const double error[2] = { fabs(out[QUANTITY_GAUSSIAN][i] - k),
			                  fabs(out[QUANTITY_MEAN][i] - h) };
		const int row = i / CHECK;
		if (sphere && (row == 0 || row == CHECK - 1)) {
			poles = fmax(poles, error[0]);
			continue;
		}
		ours[0] = fmax(ours[0], error[0]);
		ours[1] = fmax(ours[1], error[1]);
	}
	printf("%-34s %-7s K %.1e H %.1e", "largest error of curvature", name, ours[0], ours[1]);
#ifdef HAVE_SISL
	SISLSurf *peer = peer_surface(&s);
	double theirs[2] = { 0, 0 };
	int left[2] = { 0, 0 }, status;
	for (int j = sphere; j < CHECK - sphere; j++)
		for (int i = 0; i < CHECK; i++) {
			double at[2] = { lines[i], lines[j] }, d[18], normal[3], c[4], k, h;
			s1421(peer, 2, at, &left[0], &left[1], d, normal, &status);
			plain_curvatures(d, c);
			exact(vec3(d[0], d[1], d[2]), &k, &h);
			theirs[0] = fmax(theirs[0], fabs(c[0] - k));
			theirs[1] = fmax(theirs[1], fabs(c[1] - h));
		}
	freeSurf(peer);
	printf("   SISL K %.1e H %.1e", theirs[0], theirs[1]);
#endif
	printf("   target %.0e\n", target);
	if (sphere)
		printf("%-34s %-7s K %.1e   target 1e-06\n", "error of the limit at the poles",
		       name, poles);
	grid_destroy(g);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		free(out[c]);
	surface_finish(&s);
}

int main(void)
{
	static const double grid_target[] = { 110, 34 }, point_target[] = { 240, 140 };
	static const double random_target[] = { 14, 8 }, shape_target[] = { 14, 6 };
	static const double known_sum[] = { -16329.3385, -12449.7708 };
	int wrong = 0;
	printf("vector level %s, one thread\n", vector_level());
	for (int k = 0; k < 2; k++) {
		struct bench b;
		bench_init(&b, k ? "rat20" : "wave10", k ? shape_rat20() : shape_wave10());
		const double cells = (double)LINES * LINES;
		compare_rates("K, H, kmax, kmin on 1000 x 1000", &b, cells, grid_target[k],
		              our_curvatures, peer_curvatures);
		our_curvatures(&b);
		const double sum = grid_sum(&b, QUANTITY_GAUSSIAN);
		printf("%-34s %-7s %.10g, known %.10g\n", "sum of K", b.name, sum, known_sum[k]);
		wrong += !(fabs(sum - known_sum[k]) < 1e-4);
		compare_rates("points on 1000 x 1000", &b, cells, point_target[k], our_points,
		              peer_points);
		compare_rates("random points, a call each", &b, RANDOM, random_target[k],
		              our_random, peer_random);
		compare_rates("random curvatures, a call each", &b, RANDOM, shape_target[k],
		              our_shapes, peer_shapes);
		compare_rates("random curvatures, one batch", &b, RANDOM, shape_target[k],
		              our_batch, peer_shapes);
		bench_finish(&b);
	}
	compare_errors("sphere", shape_sphere(2.5), 3e-13, exact_sphere);
	compare_errors("torus", shape_torus(3, 1), 1e-14, exact_torus);
	return wrong;
}
