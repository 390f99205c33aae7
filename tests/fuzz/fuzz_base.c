/* fuzz_base.c - libFuzzer target: any bytes are read or refused, and what is read is written and
 * read again the same. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct model m, again;
	struct text t = { 0 }, second = { 0 };
	model_init(&m);
	if (base_parse(&m, (const char *)data, n, "fuzz", NULL, NULL) == ST_OK) {
		base_format(&m, &t);
		model_init(&again);
		if (base_parse(&again, t.s, t.n, "again", NULL, NULL) != ST_OK)
			abort();
		base_format(&again, &second);
		if (t.n != second.n || memcmp(t.s, second.s, t.n) != 0)
			abort();
		model_finish(&again);
		text_finish(&t);
		text_finish(&second);
	}
	model_finish(&m);
	return 0;
}
