/* part.h - the part file: finished units of a computation, safe against a kill at any instant.
 *
 * Layout, all numbers little-endian:
 *	"BATTENPT", u32 layout (1), u32 length of key, u64 units in all, key, u64 checksum of that
 * then one record a unit, in the order they came:
 *	u64 unit, u64 length, u64 checksum of the bytes, u64 checksum of these three, bytes
 * A record is written by one write; a torn one at the end is cut off when the file is opened again,
 * a unit whose bytes are damaged counts as missing.
 */
#ifndef BATTEN_PART_H
#define BATTEN_PART_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "report.h"
#include "text.h"

struct part; /* opaque; an open part file */

/*
 * Open or make the part file of a computation with that key (text: worker, version, input hash,
 * parameters, vector level) and that many units. A file with another key is begun anew, and a
 * warning says so; a file that is no part file is left alone.
 * Errors: ST_RESOURCE, ST_INPUT (folder missing, not writable, in use by another process, not a
 * part file).
 */
enum status part_open(struct part **out, const char *path, const char *key, size_t n_units,
                      const struct report *r);
void part_close(struct part *p); /* NULL is fine; the file stays */

bool part_has(const struct part *p, size_t unit);
size_t part_count(const struct part *p); /* units in the file */

/* Append one unit's bytes; a unit that is there already is left. Thread: any. */
enum status part_put(struct part *p, size_t unit, const void *bytes, size_t n,
                     const struct report *r);

/* Bytes of a unit in place of what *bytes held; checks the checksum. For many units one after the
 * other: their room is used again, where part_get keeps the whole file in memory. Thread: any.
 * Errors: ST_INPUT (not there, damaged), ST_RESOURCE. */
enum status part_read(struct part *p, size_t unit, struct text *bytes, const struct report *r);

/* The last n bytes of a unit, which nothing checks: who uses them reads the unit, too, before it
 * believes them. Thread: any. Errors: ST_INPUT (not there, shorter). */
enum status part_read_end(struct part *p, size_t unit, void *to, size_t n, const struct report *r);

/* Bytes of a unit, valid until the part is closed; checks the checksum. Thread: any.
 * Errors: ST_INPUT (not there), ST_RESOURCE. */
enum status part_get(struct part *p, size_t unit, const char **bytes, size_t *n,
                     const struct report *r);

/* Close and take the file away. */
void part_remove(struct part *p);

/*
 * Take over the units that another part file of the same computation has: shards come together.
 * That file is only read. Errors: ST_INPUT (missing, in use, of another computation), ST_RESOURCE.
 */
enum status part_merge(struct part *into, const char *path, const struct report *r);

/* A part file as another process has written it so far. */
struct part_glance {
	char *bytes;       /* owned; the whole file */
	const char *key;   /* in bytes; key_length, not ended by a zero */
	size_t key_length; /* bytes */
	size_t n_units;
	struct part_found {
		size_t unit, n;
		const char *bytes; /* in bytes above */
	} * found;                 /* owned; in the order they came */
	size_t n;
};

/* Read what there is, whole records only; the writer is not hindered.
 * Errors: ST_INPUT (missing, no part file), ST_RESOURCE. */
enum status part_look(struct part_glance *out, const char *path, const struct report *r);
void part_glance_finish(struct part_glance *g); /* a zeroed one is fine */

/* Take away the file at `path` if it is a part file that nobody uses. */
void part_discard(const char *path);

#endif
