/* fuzz_help.c - libFuzzer target: any bytes are a help source or are refused with one sentence, and
 * what is one is written and read again the same. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "source.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static void write_all(const struct help_source *s, struct text *out)
{
	for (size_t k = 0; k < s->n; k++)
		help_text_write(&s->texts[k], out);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct help_source s = { 0 }, again = { 0 };
	struct text once = { 0 }, twice = { 0 };
	const char *text = n ? (const char *)data : ""; /* no bytes come as NULL */
	struct report_store store;

	report_store_init(&store);
	if (help_source_parse(&s, text, n, "fuzz", &store.report) != ST_OK) {
		if (store.n_errors != 1)
			abort();
		help_source_finish(&s);
		return 0;
	}
	write_all(&s, &once);
	if (help_source_parse(&again, once.n ? once.s : "", once.n, "again", NULL) != ST_OK)
		abort();
	write_all(&again, &twice);
	if (once.n != twice.n || (once.n && memcmp(once.s, twice.s, once.n) != 0))
		abort();
	text_finish(&once);
	text_finish(&twice);
	help_source_finish(&s);
	help_source_finish(&again);
	return 0;
}
