/* part.h - the part file: finished units of a computation, safe against a kill at any instant.
 *
 * A plain one holds them in the order they came, one with a front in the order of their numbers: it
 * becomes the output. What comes before its turn waits in a plain one beside it, PATH.ahead.
 *
 * Layout of a plain one, all numbers little-endian:
 *	"BATTENPT", u32 layout (1), u32 length of key, u64 units in all, key, u64 checksum of that
 * then one record a unit, in the order they came:
 *	u64 unit, u64 length, u64 checksum of the bytes, u64 checksum of these three, bytes
 * A record is written by one write; a torn one at the end is cut off when the file is opened again,
 * a unit whose bytes are damaged counts as missing.
 *
 * One with a front:
 *	"BATTENPT", an OpenEXR attribute `batten_part` (a string of 16 digits: the front's size),
 *	nothing, and at the front's end: key, u64 length of key, u64 units in all, u64 checksum of that
 * then the records in rising order, without gaps; with their third checksum that of the key is mixed.
 * What is written over the front in the end, an image's header and where its tiles lie, leaves
 * attribute and key: until it has its final name the file is both.
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

/* The same for one with a front. */
enum status part_open_ordered(struct part **out, const char *path, const char *key, size_t n_units,
                              const struct report *r);
void part_close(struct part *p);             /* NULL is fine; the file stays */
const char *part_file(const struct part *p); /* NULL once it has become the output */

bool part_has(const struct part *p, size_t unit);
size_t part_count(const struct part *p); /* units in the file */

uint64_t part_bytes(const struct part *p); /* that they take there */

/* Append one unit's bytes; a unit that is there already is left. Thread: any. */
enum status part_put(struct part *p, size_t unit, const void *bytes, size_t n,
                     const struct report *r);

/* Bytes of a unit in place of what *bytes held; checks the checksum. For many units one after the
 * other: their room is used again, where part_get keeps the whole file in memory. Thread: any.
 * Errors: ST_INPUT (not there, damaged), ST_RESOURCE. */
enum status part_read(struct part *p, size_t unit, struct text *bytes, const struct report *r);

/* The last n bytes of a unit in its place, which were checked when the file was opened. Thread: any. Errors: ST_INPUT (not there, shorter). */
enum status part_read_end(struct part *p, size_t unit, void *to, size_t n, const struct report *r);

/* Bytes of a unit, valid until the part is closed; checks the checksum. Of a plain file. Thread: any.
 * Errors: ST_INPUT (not there), ST_RESOURCE. */
enum status part_get(struct part *p, size_t unit, const char **bytes, size_t *n,
                     const struct report *r);

/*
 * The file as the output. What goes into the front: `part_front` bytes of room for it, the attribute
 * that must be the header's first, and where units lie in the file once all are there.
 */
uint64_t part_front(const struct part *p); /* 0: it has none */
const char *part_front_attribute(const struct part *p, size_t *n);
uint64_t part_place(const struct part *p, size_t unit);

/* Write and sync it; then the file is whole.
 * Errors: ST_INTERNAL (units are missing, no room), ST_RESOURCE. */
enum status part_write_front(struct part *p, const void *bytes, size_t n, const struct report *r);

/* Rename the file; part_remove then only closes. Gives errno: EXDEV where `to` is on another disk. */
int part_become(struct part *p, const char *to);

/* Copy it there. Gives errno. */
int part_copy(const struct part *p, const char *to);

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
	char *ahead;       /* owned; the one beside it, or NULL */
	const char *key;   /* in bytes; key_length, not ended by a zero */
	size_t key_length; /* bytes */
	size_t n_units;
	struct part_found {
		size_t unit, n;
		const char *bytes; /* in those above */
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
