/* fuzz_part.c - libFuzzer target: units are put into a part file, the file is damaged, and no unit comes
 * out of it that was not put in; units can be added. Or any bytes are a part file.
 *
 * First byte odd: 4 bytes of damage (kind, place in two, how), then units: number, length, bytes. */
#include "part.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { UNITS = 4, DAMAGE = 5 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

struct unit {
	const uint8_t *bytes; /* NULL: not put */
	size_t n;
};

static void put_units(struct part *p, const uint8_t *data, size_t n, struct unit units[UNITS])
{
	for (size_t at = 0; at + 2 <= n;) {
		struct unit *u = &units[data[at] % UNITS];
		size_t length = data[at + 1] < n - at - 2 ? data[at + 1] : n - at - 2;
		if (part_put(p, data[at] % UNITS, data + at + 2, length, NULL) != ST_OK)
			abort();
		if (!u->bytes)
			*u = (struct unit){ data + at + 2, length };
		at += 2 + length;
	}
}

static void damage(const char *path, const uint8_t *how)
{
	int fd = open(path, O_RDWR | O_CLOEXEC);
	off_t end = lseek(fd, 0, SEEK_END), at = how[1] | how[2] << 8;
	unsigned char byte = 0;
	at = at < end ? at : end;
	switch (how[0] % 4) {
	case 1: /* cut short */
		if (ftruncate(fd, at) < 0)
			abort();
		break;
	case 2: /* a byte is another */
		if (pread(fd, &byte, 1, at) < 0)
			abort();
		byte ^= how[3];
		if (pwrite(fd, &byte, 1, at) != 1)
			abort();
		break;
	case 3: /* as after a power cut: the size is there, the bytes are not */
		if (ftruncate(fd, at) < 0 || ftruncate(fd, end) < 0)
			abort();
		break;
	}
	close(fd);
}

static void use(struct part *p, const struct unit *put)
{
	const char *bytes;
	size_t length;
	for (size_t unit = 0; unit < UNITS; unit++) {
		bool has = part_has(p, unit);
		if (has && part_get(p, unit, &bytes, &length, NULL) != ST_OK)
			abort();
		if (has && put &&
		    (!put[unit].bytes || put[unit].n != length ||
		     memcmp(bytes, put[unit].bytes, length) != 0))
			abort();
		if (!has && (part_put(p, unit, "new", 3, NULL) != ST_OK ||
		             part_get(p, unit, &bytes, &length, NULL) != ST_OK || length != 3 ||
		             memcmp(bytes, "new", 3) != 0))
			abort();
	}
	if (part_count(p) != UNITS)
		abort();
}

static void write_bytes(const char *path, const uint8_t *data, size_t n)
{
	FILE *f = fopen(path, "w");
	if (!f || fwrite(data, 1, n, f) != n || fclose(f) != 0)
		abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	char path[64];
	struct part *p;
	struct unit units[UNITS] = { 0 };
	bool damaged = n >= DAMAGE && data[0] & 1;
	snprintf(path, sizeof path, "/dev/shm/fuzz-%d.part", (int)getpid());
	if (damaged) {
		if (part_open(&p, path, "key", UNITS, NULL) != ST_OK)
			abort();
		put_units(p, data + DAMAGE, n - DAMAGE, units);
		part_close(p);
		damage(path, data + 1);
	} else {
		write_bytes(path, data, n);
	}
	enum status st = part_open(&p, path, "key", UNITS, NULL);
	/* what begins with other bytes is somebody else's file */
	if (st != ST_OK && damaged && !(!data[3] && data[2] < 8))
		abort();
	if (st == ST_OK) {
		use(p, damaged ? units : NULL);
		part_close(p);
	}
	unlink(path);
	return 0;
}
