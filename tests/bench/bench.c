/* bench.c - what the benchmarks share. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROUNDS_MAX = 15, SIDES_MAX = 4 };

static double seconds(clockid_t clock)
{
	struct timespec t;
	clock_gettime(clock, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_cpu(void)
{
	return seconds(CLOCK_PROCESS_CPUTIME_ID);
}

double bench_wall(void)
{
	return seconds(CLOCK_MONOTONIC);
}

static int compare(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

double bench_median(double *x, size_t n)
{
	qsort(x, n, sizeof *x, compare);
	return x[n / 2];
}

_Noreturn void bench_fail(const char *what)
{
	fprintf(stderr, "benchmark: %s\n", what);
	exit(1);
}

double *bench_room(size_t n)
{
	double *p = calloc(n, sizeof *p);
	if (!p)
		bench_fail("out of memory");
	return p;
}

void bench_print(const struct bench_row *row)
{
	double best = 0;
	printf("row %s | %s | %.4g %s | ", row->row, row->what, row->ours, row->unit);
	if (row->target > 0)
		printf("%s %.4g", row->less ? "<=" : ">=", row->target);
	printf(" |");
	for (int k = 0; k < BENCH_PEERS; k++) {
		const struct bench_peer *p = &row->peer[k];
		if (!p->name || !(p->value > 0))
			continue;
		printf("%s %s %.4g", best > 0 ? "," : "", p->name, p->value);
		if (!(best > 0) || (row->less ? p->value < best : p->value > best))
			best = p->value;
	}
	printf(" | ");
	if (best > 0)
		printf("%.3g", row->less ? best / row->ours : row->ours / best);
	printf(" | ");
	if (row->target > 0)
		printf("%s", (row->less ? row->ours <= row->target : row->ours >= row->target)
		                     ? "met"
		                     : "not met");
	putchar('\n');
	fflush(stdout);
}

void bench_alternate(struct bench_side *sides, int n, int rounds)
{
	double cpu[SIDES_MAX][ROUNDS_MAX], wall[SIDES_MAX][ROUNDS_MAX];
	if (n > SIDES_MAX || rounds > ROUNDS_MAX)
		bench_fail("too many sides or rounds");
	for (int r = 0; r < rounds; r++)
		for (int k = 0; k < n; k++) {
			if (!sides[k].run)
				continue;
			const double begun = bench_wall(), start = bench_cpu();
			sides[k].check = sides[k].run(sides[k].data);
			cpu[k][r] = bench_cpu() - start;
			wall[k][r] = bench_wall() - begun;
			if (sides[k].sum)
				sides[k].check = sides[k].sum(sides[k].data);
		}
	for (int k = 0; k < n; k++) {
		if (!sides[k].run)
			continue;
		sides[k].cpu = bench_median(cpu[k], rounds);
		sides[k].wall = bench_median(wall[k], rounds);
	}
}
