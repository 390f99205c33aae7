/* iges.h - IGES 5.3 (and older) files read into a model. */
#ifndef BATTEN_IGES_H
#define BATTEN_IGES_H

#include "model.h"
#include "text.h"

/* True where the first line that is not empty is one that IGES files begin with. */
bool iges_recognise(const char *bytes, size_t n);

/*
 * Every entity that can be read becomes NURBS in the file's unit, entity 124 applied; everything
 * else is counted in m->skipped with its reason. One bad entity costs that entity.
 * Errors: ST_INPUT (no entity could be read, no terminate record), ST_RESOURCE, ST_CANCELLED.
 */
enum status iges_parse(struct model *m, const char *bytes, size_t n, const char *name,
                       const struct progress *p, const struct report *r);

/* The same from an open file of n bytes that can be read anywhere in (not a pipe), which is not kept in
 * memory. */
enum status iges_read(struct model *m, int fd, size_t n, const char *name, const struct progress *p,
                      const struct report *r);

/* What can be written: curves, surfaces and points in space. */
bool iges_holds(const struct entity *e);

/* The surfaces and curves of a model as entities 128 (with trims: 144 on it) and 126, each the part
 * that its domain means; curves on a surface of it as 142, points as 116 and 106 form 2.
 * No time, no host in the header. Without a unit millimetres are stated, with a warning. */
void iges_format(const struct model *m, struct text *out);
enum status iges_write(const struct model *m, const char *path, const struct report *r);

#endif
