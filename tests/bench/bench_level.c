/* bench_level.c - time the tracer on the shapes with known answers; prints a row each. */
#include <stdio.h>
#include <time.h>

#include "../geometry/level_shapes.h"

enum { RUNS = 5 };

struct row {
	const char *name;
	enum level_kind kind;
	struct vec3 direction;
	double value, tolerance;
	int many; /* values value + k step */
	double step;
	double target; /* ms */
	size_t known;  /* pieces, counted elsewhere by changes of sign on a grid */
	struct vec3 point, eye;
};

static const struct row rows[] = {
	{ "50 planes, 1e-6",
	  LEVEL_PLANE,
	  { 0, 0, 1 },
	  -0.784,
	  1e-6,
	  50,
	  0.032,
	  30,
	  900,
	  { 0, 0, 0 },
	  { 0, 0, 0 } },
	{ "50 planes, 1e-4",
	  LEVEL_PLANE,
	  { 0, 0, 1 },
	  -0.784,
	  1e-4,
	  50,
	  0.032,
	  18,
	  900,
	  { 0, 0, 0 },
	  { 0, 0, 0 } },
	{ "silhouette, 1e-6",
	  LEVEL_SILHOUETTE,
	  { 0.8, 0.36, 0.48 },
	  0,
	  1e-6,
	  1,
	  0,
	  4,
	  12,
	  { 0, 0, 0 },
	  { 0, 0, 0 } },
	{ "silhouette from an eye, 1e-6",
	  LEVEL_EYE,
	  { 0, 0, 0 },
	  0,
	  1e-6,
	  1,
	  0,
	  7,
	  9,
	  { 0, 0, 0 },
	  { 30, 18, 14 } },
	{ "10 cylinders, 1e-6",
	  LEVEL_CYLINDER,
	  { 1, 0, 0 },
	  0.3,
	  1e-6,
	  10,
	  0.45,
	  6,
	  20,
	  { 0, 5, 0 },
	  { 0, 0, 0 } },
	{ "isophote 35 degrees, 1e-6",
	  LEVEL_ISOPHOTE,
	  { 0, 0, 1 },
	  0.81915204428899178,
	  1e-6,
	  1,
	  0,
	  10,
	  85,
	  { 0, 0, 0 },
	  { 0, 0, 0 } },
	{ "isophote 50 degrees, 1e-6",
	  LEVEL_ISOPHOTE,
	  { 0, 0, 1 },
	  0.64278760968653933,
	  1e-6,
	  1,
	  0,
	  15,
	  84,
	  { 0, 0, 0 },
	  { 0, 0, 0 } },
};

static double cpu_ms(void)
{
	struct timespec t;
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* Counts of one run, summed over the planes. */
struct sum {
	size_t branches, closed, undecided, points;
	double length, max_error;
};

static void sum_add(struct sum *sum, const struct level_result *x)
{
	sum->branches += x->n_branches;
	sum->closed += x->n_closed;
	sum->undecided += x->n_undecided;
	sum->length += x->length;
	sum->max_error = fmax(sum->max_error, x->max_error);
	for (size_t i = 0; i < x->n_branches; i++)
		sum->points += x->branches[i].uv.n;
}

/* From the surface on; what is prepared for the first value serves all. */
static enum status run(const struct surface *s, const struct row *row, struct sum *sum)
{
	struct level_field field = { .kind = row->kind,
		                     .direction = row->direction,
		                     .value = row->value,
		                     .point = row->point,
		                     .eye = row->eye };
	struct level *first = NULL;
	enum status st = level_create(&first, s, &field, row->tolerance, NULL);
	*sum = (struct sum){ 0 };
	for (int k = 0; st == ST_OK && k < row->many; k++) {
		struct level_result x = { 0 };
		struct level *l = NULL;
		st = level_create_like(&l, first, row->value + k * row->step, NULL);
		if (st == ST_OK)
			st = shape_trace_level(l, &x, NULL);
		sum_add(sum, &x);
		level_result_finish(&x);
		level_destroy(l);
	}
	level_destroy(first);
	return st;
}

int main(void)
{
	struct surface s;
	if (shape_make(&s, 4, 30, shape_wavy) != ST_OK)
		return 1;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		const struct row *row = &rows[i];
		double ms[RUNS];
		struct sum sum;
		for (int k = 0; k < RUNS; k++) {
			double start = cpu_ms();
			if (run(&s, row, &sum) != ST_OK)
				return 1;
			ms[k] = cpu_ms() - start;
		}
		qsort(ms, RUNS, sizeof *ms, compare);
		printf("%-28s %4zu pieces (known: %zu), %4zu closed, %zu undecided, error %.2g, length %.9g, "
		       "%zu points, %.1f ms (target %.0f: %.2f of it)\n",
		       row->name, sum.branches, row->known, sum.closed, sum.undecided,
		       sum.max_error, sum.length, sum.points, ms[RUNS / 2], row->target,
		       ms[RUNS / 2] / row->target);
	}
	surface_finish(&s);
	return 0;
}
