/* fuzz_script.c - libFuzzer target: any line is taken apart or refused; its values are checked against
 * the rows they are meant for; and nothing is run. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "routine.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	char *line = malloc(n + 1);
	struct world *w = NULL;
	struct script_line l;

	if (!line || world_create(&w, "/tmp") != ST_OK)
		abort();
	if (n)
		memcpy(line, data, n);
	line[n] = 0;
	if (script_line_parse(&l, line, NULL) == ST_OK) {
		const struct argument_row *rows = l.routine ? l.routine->arguments : NULL;
		for (int k = 0; k < l.given.n; k++)
			for (const struct argument_row *row = rows; row && row->name; row++)
				if (!strcmp(row->name, l.given.name[k]))
					argument_check(row, l.given.value[k], w, NULL);
		script_line_finish(&l);
	}
	world_destroy(w);
	free(line);
	return 0;
}
