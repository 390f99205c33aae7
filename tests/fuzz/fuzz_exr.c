/* fuzz_exr.c - bytes as an OpenEXR image: read or refused with a sentence, never more. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "exr.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	char path[64];
	struct report_store said;
	struct exr_picture p;
	int fd = memfd_create("image", MFD_CLOEXEC);
	if (fd < 0 || write(fd, data, n) != (ssize_t)n)
		abort();
	snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
	report_store_init(&said);
	enum status st = exr_read(&p, path, &said.report);
	if ((st == ST_OK) != (said.n_errors == 0) || (st != ST_OK && p.planes))
		abort();
	/* pixels beyond what deflate can make of the file were refused before they were allocated */
	if (st == ST_OK && (double)p.width * p.height * p.n_channels > 1100.0 * n)
		abort();
	exr_picture_finish(&p);
	close(fd);
	return 0;
}
