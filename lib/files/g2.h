/* g2.h - SINTEF GoTools' .g2 files: spline curves, spline surfaces, point clouds. What of them is read
 * and written: docs/formats.md. */
#ifndef BATTEN_G2_H
#define BATTEN_G2_H

#include "model.h"
#include "text.h"

/* True where the bytes begin with the header of a .g2 object. */
bool g2_recognise(const char *bytes, size_t n);

/*
 * Every spline and point cloud is read; other classes are counted in m->skipped with their reason.
 * Errors: ST_INPUT "FILE:LINE:COLUMN: found X, expected Y" or nothing could be read, ST_RESOURCE,
 * ST_CANCELLED.
 */
enum status g2_parse(struct model *m, const char *bytes, size_t n, const char *name,
                     const struct progress *p, const struct report *r);

/* Curves, surfaces, points in space; of a curve on a surface its curve in space. What has none is
 * left out: g2_holds tells. out->failed where memory ran out. */
void g2_format(const struct model *m, struct text *out);
bool g2_holds(const struct entity *e);

/* Write as a whole file; that trims are left out is a warning. Errors: ST_INPUT (no such folder, not
 * writable), ST_RESOURCE. */
enum status g2_write(const struct model *m, const char *path, const struct report *r);

#endif
