/* import_child.h - foreign files are parsed by a child, so that a bad one cannot take its reader
 * along. */
#ifndef BATTEN_IMPORT_CHILD_H
#define BATTEN_IMPORT_CHILD_H

#include <jansson.h>

#include "project.h"

/*
 * Run `batten import ARGUMENT --inputs` and give back its object: {"entities":[{"number","kind",
 * "name","path"}]}. Its sentences and progress go to standard error. New reference.
 * Errors: the child's class; ST_INTERNAL where it crashed; ST_CANCELLED on SIGINT.
 */
enum status import_child(const char *argument, const struct project *p, json_t **out,
                         const struct report *r);

#endif
