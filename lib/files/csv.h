/* csv.h - points as columns of numbers: x y z, or u v. */
#ifndef BATTEN_CSV_H
#define BATTEN_CSV_H

#include "model.h"
#include "text.h"

/* True where the first line that is neither empty nor a comment holds two or three numbers, or is a
 * line of names with such a line behind it. */
bool csv_recognise(const char *bytes, size_t n);

/*
 * One list of points. Columns are parted by a comma or semicolon, or by tabs and blanks; a first
 * line of names may say which of them are x y z or u v; '#' begins a comment; D exponents count.
 * Errors: ST_INPUT "FILE:LINE:COLUMN: found X, expected Y", ST_RESOURCE, ST_CANCELLED.
 */
enum status csv_parse(struct model *m, const char *bytes, size_t n, const char *name,
                      const struct progress *p, const struct report *r);

/* All lists of points of a model, one after the other, with a line of names. Errors: ST_INPUT (no
 * points, or some in space and some in u, v), ST_RESOURCE. */
enum status csv_write(const struct model *m, const char *path, const struct report *r);

#endif
