/* reading_child.h - foreign geometry files are parsed by a child, so that one that crashes its reader or
 * never ends takes nothing along. */
#ifndef BATTEN_READING_CHILD_H
#define BATTEN_READING_CHILD_H

#include "world.h"

struct reading_child {
	const char *program; /* borrowed; NULL: the batten beside this program */
};

/*
 * As model_read, for world_set_reader; data: a struct reading_child. Our own format is read here, all else by
 * `batten import`, which hands it over as .base in a file without a name. Told to stop, the child is killed.
 * Errors: the child's class and sentence; ST_INPUT where it crashed, ST_CANCELLED.
 * Thread: any.
 */
world_reader reading_child;

#endif
