/* part_private.h - what the files of part.h know of each other: bytes on disk, and an open file. */
#ifndef BATTEN_PART_PRIVATE_H
#define BATTEN_PART_PRIVATE_H

#include <pthread.h>
#include <sys/uio.h>

#include "part.h"

enum {
	PART_MAGIC_SIZE = 8,
	PART_HEADER_SIZE = 24, /* of a plain file, before its key */
	PART_CHECKSUM_SIZE = 8,
	PART_RECORD_SIZE = 32,
	PART_LAYOUT = 1,
	PART_END_SIZE = 24, /* behind the key at the end of a front */
	PART_DIGITS = 16,   /* of the front's size in its attribute */
};
extern const char part_magic[PART_MAGIC_SIZE + 1];

/* What an OpenEXR file begins with, and the attribute by which one that was a part file is known: it
 * gives the front's size. Before it stand 8 bytes in both. */
enum { PART_EXR_MAGIC_SIZE = 4 };
extern const char part_exr_magic[PART_EXR_MAGIC_SIZE];
enum { PART_MARK_SIZE = sizeof "batten_part" + sizeof "string" + 4 };
extern const char part_mark[PART_MARK_SIZE];
enum { PART_BEGIN_SIZE = PART_MAGIC_SIZE + PART_MARK_SIZE + PART_DIGITS };

/* Where a unit's bytes lie in the file; at 0: not there. */
struct part_span {
	uint64_t at, n;
	bool hole; /* there is the room alone, the bytes are damaged */
};

struct part_block {
	char *bytes;
	size_t n;
};

struct part {
	char *path; /* owned */
	char *key;  /* owned */
	int fd;
	struct text
	        header; /* what the file begins with: the key and all, or a front's first bytes */
	struct text end_of_front;
	size_t n_units, count;
	struct part_span *spans; /* owned, n_units */
	size_t *order;           /* owned, n_units; the units of a plain file as they lie in it */
	size_t n_order;
	uint64_t end; /* behind the last whole record */
	struct part_block
	        *blocks; /* owned; older ones stay, their bytes are promised until the close */
	size_t n_blocks;
	pthread_mutex_t lock;

	uint64_t front;     /* bytes kept free for an image's header; 0: a plain file */
	uint64_t salt;      /* what the checksums of its records are mixed with */
	size_t next;        /* with a front: the unit whose place is the end */
	struct part *ahead; /* owned; units that came before their turn; NULL: none ever did */
	char *ahead_path;   /* owned */
	struct text moving; /* one of them on its way */
};

void part_put_u64(unsigned char *p, uint64_t x);
uint64_t part_get_u64(const char *bytes);

/* n bytes from `from` on; read, not mapped: a file that somebody cuts short must not kill us. */
bool part_read_at(int fd, char *to, size_t n, uint64_t from);

/* pwritev of everything at `at`; cut: a file cut short by a full disk is cut back. Gives errno. */
int part_write_at(int fd, struct iovec *v, int n_v, uint64_t at, bool cut);

/* A unit on its way into a file. */
struct part_unit {
	size_t unit, n;
	const void *bytes; /* borrowed */
	uint64_t sum;      /* their checksum: it is made once */
};

/* Its record at `at`, the bytes behind it. Gives errno. */
int part_write_record(const struct part *p, const struct part_unit *u, uint64_t at, bool cut);

/* The head of a record: checked by itself, its unit one of n_units. */
struct part_record {
	uint64_t unit, n, sum;
};
bool part_record_read(struct part_record *out, const char *bytes, uint64_t salt, uint64_t n_units);

/* Does a part file begin so? One cut short does, and one whose size reached the disk before a power
 * cut, but not its bytes: it begins with zeros. */
bool part_begins(const char *bytes, size_t n);

/* The size of the front that such a file has; 0: none. */
uint64_t part_front_size(const char *bytes, size_t n);

/* Header of a plain file; first bytes of a front, and its last. */
void part_header_make(struct text *out, const char *key, size_t n_units);
void part_front_make(struct text *begin, struct text *end, const char *key, size_t n_units,
                     uint64_t front);

/* Path of the file of units that came before their turn. Caller frees. */
char *part_ahead_path(const char *path);

/* Find the records behind the header, *file_size bytes in all; p->end is where the first torn one
 * begins. Errors: ST_RESOURCE. */
enum status part_scan(struct part *p, uint64_t size, uint64_t at, const struct report *r);

enum status part_fail(const struct report *r, const struct part *p, const char *what, int error);
enum status part_no_memory(const struct report *r, const char *path);
enum status part_cut_short(const struct report *r, const struct part *p);
enum status part_damaged(const struct report *r, const struct part *p, size_t unit);

/* With a front; p->lock is held. Put a unit at its place, or aside until it has one. */
enum status part_put_ordered(struct part *p, const struct part_unit *u, const struct report *r);
enum status part_put_unit(struct part *p, const struct part_unit *u, const struct report *r);
/* Find what is kept aside, and put in place what can be. */
enum status part_ahead_open(struct part *p, const struct report *r);
/* Read a unit in its place, and its checksum, which was compared. */
enum status part_read_checked(struct part *p, size_t unit, struct text *bytes, uint64_t *checked,
                              const struct report *r);
bool part_ahead_has(struct part *p, size_t unit);

#endif
