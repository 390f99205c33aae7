/* fuzz_part.c - bytes as a part file, behind a good header or not: no unit comes out that the
 * checksums do not vouch for, and units can be added. */
#include "part.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { UNITS = 4 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static void use(struct part *p)
{
	const char *bytes;
	size_t length;
	for (size_t unit = 0; unit < UNITS; unit++) {
		bool has = part_has(p, unit);
		if (has && part_get(p, unit, &bytes, &length, NULL) != ST_OK)
			abort();
		if (!has && (part_put(p, unit, "new", 3, NULL) != ST_OK ||
		             part_get(p, unit, &bytes, &length, NULL) != ST_OK || length != 3 ||
		             memcmp(bytes, "new", 3) != 0))
			abort();
	}
	if (part_count(p) != UNITS)
		abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	char path[64];
	struct part *p;
	snprintf(path, sizeof path, "/dev/shm/fuzz-%d.part", (int)getpid());
	if (n > 0 && data[0] & 1 && part_open(&p, path, "key", UNITS, NULL) == ST_OK)
		part_close(p);
	FILE *f = fopen(path, "a");
	if (!f)
		abort();
	fwrite(data, 1, n, f);
	fclose(f);
	if (part_open(&p, path, "key", UNITS, NULL) == ST_OK) {
		use(p);
		part_close(p);
	}
	unlink(path);
	return 0;
}
