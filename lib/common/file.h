/* file.h - whole files: read at once, or written so that they appear whole or not at all. */
#ifndef BATTEN_FILE_H
#define BATTEN_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "report.h"
#include "text.h"

/*
 * Read a whole file. *out is the caller's to free and has a zero byte behind its *n bytes.
 * Errors: ST_INPUT (missing, a folder, unreadable), ST_RESOURCE (larger than max, no memory).
 */
enum status file_read(const char *path, uint64_t max, char **out, size_t *n,
                      const struct report *r);

/* The same of files that begin as wanted: where the first `look` bytes (or all, if fewer) are not, *out
 * holds those alone. */
typedef bool file_wanted(const char *bytes, size_t n);
enum status file_read_wanted(const char *path, uint64_t max, size_t look, file_wanted *wanted,
                             char **out, size_t *n, const struct report *r);

/* Append all that comes of a descriptor until its end. Errors: ST_RESOURCE (unreadable, no memory). */
enum status file_read_open(int fd, struct text *t);

/*
 * A file on its way: written without a name on the same disk (where that cannot be, under a temporary
 * name in the same folder), put under its final name by commit (flushed, synced, renamed, folder
 * synced). Until then nothing is to be seen of it, and a process that is killed leaves nothing.
 */
struct whole_file {
	FILE *stream; /* write here, read again if you like; owned */
	char *path;   /* owned */
	char *temp;   /* owned; NULL while it has no name */
};

/* Errors: ST_INPUT (no such folder, not writable), ST_RESOURCE. */
enum status whole_file_create(struct whole_file *f, const char *path, const struct report *r);

/* Put the file in place, or on failure take it away. Ends f either way. Errors: ST_RESOURCE (full disk),
 * ST_INPUT (it may not stand there). */
enum status whole_file_commit(struct whole_file *f, const struct report *r);

/* Take the temporary file away. A zeroed or ended f is fine. */
void whole_file_abandon(struct whole_file *f);

/* Create, write n bytes, commit. Errors: of both. */
enum status file_write(const char *path, const void *bytes, size_t n, const struct report *r);

/* A file's time (nanoseconds), size (bytes) and i-node: one that has the same has not changed. False: it is
 * not there, and `stamp` is left as it is. */
bool file_stamp(const char *path, int64_t stamp[3]);

/* The mode bits that new files of this process are without. Thread: any. */
unsigned file_mask(void);

/* For the beginning of a program: where standard input, output or error are closed, something that gives and
 * takes nothing stands in for them. Else a file that is opened gets their number, and what is said
 * goes into it. */
void file_hold_standard(void);

/* Make a folder and those above it that are missing; mode as for mkdir. One that is there is fine.
 * Errors: ST_INPUT (a part of the path is no folder, not writable), ST_RESOURCE. */
enum status folder_make(const char *path, unsigned mode, const struct report *r);

#endif
