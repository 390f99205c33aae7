/* base.h - the .base text format: egeom and fgeom fields by name. Grammar: docs/formats.md.
 * read(write(x)) == x to the bit. Used for .isophote and other results in geometry form too. */
#ifndef BATTEN_BASE_H
#define BATTEN_BASE_H

#include "model.h"
#include "text.h"

/* True where the bytes begin as a .base file does. */
bool base_recognise(const char *bytes, size_t n);

/* Into a model that model_init has made; the caller finishes it, after a failure too. This holds of every
 * format's parser. p may be NULL. `name` is the file's in sentences.
 * Errors: ST_INPUT "FILE:LINE:COLUMN: found X, expected Y", ST_RESOURCE, ST_CANCELLED. */
enum status base_parse(struct model *m, const char *bytes, size_t n, const char *name,
                       const struct progress *p, const struct report *r);

/* The whole model as text; out->failed where memory ran out. */
void base_format(const struct model *m, struct text *out);

/* The same piece by piece, for models whose text is longer than memory: piece 0 is what stands before the
 * entities, piece k the kth entity. */
void base_format_piece(const struct model *m, int piece, struct text *out);

/* Write as a whole file. Errors: ST_INPUT (no such folder, not writable), ST_RESOURCE. */
enum status base_write(const struct model *m, const char *path, const struct report *r);

/* One entity alone with the model's unit: what `.batten/inputs/HASH.base` holds. */
void base_format_entity(const struct model *m, const struct entity *e, struct text *out);

#endif
