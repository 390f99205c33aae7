/* fuzz_iges.c - libFuzzer target: any bytes are read or refused; what is read can be written and
 * read again. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "iges.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static int shapes(const struct model *m)
{
	int k = 0;
	for (int i = 0; i < m->n; i++)
		k += m->entities[i].kind == ENTITY_CURVE || m->entities[i].kind == ENTITY_SURFACE;
	return k;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct model m, again;
	struct text t = { 0 };
	model_init(&m);
	if (iges_parse(&m, (const char *)data, n, "fuzz", NULL, NULL) == ST_OK && shapes(&m)) {
		iges_format(&m, &t);
		model_init(&again);
		if (!t.failed)
			iges_parse(&again, t.s, t.n, "again", NULL, NULL);
		model_finish(&again);
		text_finish(&t);
	}
	model_finish(&m);
	return 0;
}
