/* fuzz_g2.c - libFuzzer target: any bytes are read or refused; what is read and written is read
 * again, and then stays the same. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "g2.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct model m, again;
	struct text t = { 0 }, second = { 0 };
	struct report_store said;
	report_store_init(&said);
	model_init(&m);
	g2_recognise((const char *)data, n);
	enum status st = g2_parse(&m, (const char *)data, n, "fuzz", NULL, &said.report);
	if ((st == ST_OK) != (said.n_errors == 0))
		abort();
	if (st == ST_OK) {
		g2_format(&m, &t);
		model_init(&again);
		if (t.s && !t.failed && g2_parse(&again, t.s, t.n, "again", NULL, NULL) == ST_OK) {
			g2_format(&again, &second);
			if (t.n != second.n || memcmp(t.s, second.s, t.n) != 0)
				abort();
		}
		model_finish(&again);
		text_finish(&t);
		text_finish(&second);
	}
	model_finish(&m);
	return 0;
}
