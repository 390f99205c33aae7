/* bench.h - what the benchmarks share: clocks, medians, and the lines that report.py collects. */
#ifndef BATTEN_BENCH_H
#define BATTEN_BENCH_H

#include <stdbool.h>
#include <stddef.h>

enum { BENCH_PEERS = 3 };

/* Seconds: CPU time of this process, and the clock on the wall. */
double bench_cpu(void);
double bench_wall(void);

/* Sorts x. */
double bench_median(double *x, size_t n);

/* calloc of doubles that ends the program where there is no memory. */
double *bench_room(size_t n);
_Noreturn void bench_fail(const char *what);

/* One line of the table. */
struct bench_row {
	const char *row;     /* which goal it is, "1" */
	const char *what;    /* what was measured, "points, wave10" */
	const char *unit;    /* of ours, the peers' and the target */
	double ours, target; /* target 0: none */
	bool less;           /* less is better */
	struct bench_peer {
		const char *name; /* NULL: no such peer */
		double value;
	} peer[BENCH_PEERS];
};

/* Print it: row | what | ours | target | peers | ratio to the better peer | met or not. */
void bench_print(const struct bench_row *row);

/* One thing to time; `run` gives a checksum. A side without `run` is left out. Where adding up
 * would cost as much as what is timed, `sum` does it afterwards. */
struct bench_side {
	const char *name;
	double (*run)(void *data);
	double (*sum)(void *data); /* may be NULL */
	void *data;
	double cpu, wall, check; /* medians, and the last checksum */
};

/* All sides in turn, `rounds` times, at most 15. */
void bench_alternate(struct bench_side *sides, int n, int rounds);

#endif
