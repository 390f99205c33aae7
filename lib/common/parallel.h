/* parallel.h - the same work on many units by several threads. */
#ifndef BATTEN_PARALLEL_H
#define BATTEN_PARALLEL_H

#include <stdatomic.h>
#include <stddef.h>

#include "status.h"

/* Do one unit; thread is 0 .. n_threads - 1. Anything but ST_OK stops the run. */
typedef enum status parallel_unit(void *data, size_t unit, int thread);

/*
 * Call fn for units 0 .. n_units - 1, each once, in rising order of start, on n_threads threads
 * (the caller's is one of them). Stops early when *stop becomes true (may be NULL) or a unit fails.
 * Returns the failure of the lowest failed unit; ST_CANCELLED when stopped; ST_RESOURCE when
 * threads cannot be had.
 */
enum status parallel_run(int n_threads, size_t n_units, const atomic_bool *stop, parallel_unit *fn,
                         void *data);

/* Processors this process may use (affinity and cgroup quota respected), at least 1. */
int parallel_processors(void);

/* Vector level of this processor that the kernels use: "x86-64", "x86-64-v3", "x86-64-v4", or
 * the machine's name elsewhere. BATTEN_VECTOR_LEVEL lowers it. Same text for the whole process. */
const char *vector_level(void);

#endif
