/* work_input.c - geometry as jobs read it: under its hash, once. */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "file.h"
#include "hash.h"
#include "path.h"
#include "work_order.h"

enum status work_input_keep(const char *folder, const struct text *t, char **path,
                            const struct report *r)
{
	char hash[HASH_SIZE];

	*path = NULL;
	if (!t->failed) {
		hash_bytes(t->s, t->n, hash);
		char *name = text_print("inputs/%s.base", hash);
		*path = name ? path_join(folder, name) : NULL;
		free(name);
	}
	if (!*path)
		return report_error(r, ST_RESOURCE, "memory ran out");
	enum status st = ST_OK;
	if (!path_exists(*path))
		st = file_write(*path, t->s, t->n, r);
	else if (utimensat(AT_FDCWD, *path, NULL, 0))
		st = report_error(r, status_from_errno(errno), "cannot touch '%s': %s", *path,
		                  strerror(errno));
	if (st != ST_OK) {
		free(*path);
		*path = NULL;
	}
	return st;
}
