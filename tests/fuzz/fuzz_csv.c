/* fuzz_csv.c - libFuzzer target: any bytes are points in columns or refused with one sentence. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "csv.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct model m;
	struct report_store said;
	report_store_init(&said);
	model_init(&m);
	csv_recognise((const char *)data, n);
	enum status st = csv_parse(&m, (const char *)data, n, "fuzz", NULL, &said.report);
	if ((st == ST_OK) != (said.n_errors == 0))
		abort();
	if (st == ST_OK) {
		const struct point_list *l = &m.entities[0].points;
		if (m.n != 1 || l->n < 1 || l->dimension < 2 || l->dimension > 3)
			abort();
		for (int i = 0; i < l->n * l->dimension; i++)
			if (!isfinite(l->values[i]))
				abort();
	}
	model_finish(&m);
	return 0;
}
