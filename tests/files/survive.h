/* survive.h - damaged in any way, a file is read or refused with one sentence; sanitizers watch. */
#ifndef BATTEN_TEST_SURVIVE_H
#define BATTEN_TEST_SURVIVE_H

#include "model.h"
#include "mutate.h"

/* Reads n bytes into an empty model. */
typedef enum status survive_read(struct model *m, const char *bytes, size_t n,
                                 const struct report *r);

/* Reads `times` damaged copies of those bytes: of them more than `good` can be read and more than `bad`
 * cannot. */
static inline void survive(survive_read *read, const char *bytes, size_t n, uint64_t seed,
                           int times, int good, int bad)
{
	for (int k = 0; k < times; k++) {
		struct model m;
		struct report_store store;
		size_t left = 0;
		char *damaged = mutate(bytes, n, &seed, &left);
		assert_non_null(damaged);
		report_store_init(&store);
		model_init(&m);
		const enum status st = read(&m, damaged, left, &store.report);
		assert_true(st == ST_OK || st == ST_INPUT);
		assert_int_equal(store.n_errors, st != ST_OK);
		st == ST_OK ? good-- : bad--;
		model_finish(&m);
		free(damaged);
	}
	assert_true(good < 0 && bad < 0);
}

#endif
