/* iges_writer.h - what the files of the IGES writer share: sections being written. */
#ifndef BATTEN_IGES_WRITER_H
#define BATTEN_IGES_WRITER_H

#include "iges.h"

struct iges_writer {
	struct text directory, data; /* whole lines */
	struct text line;            /* data columns of the P line begun */
	int n_d, n_p;                /* lines in them */
	int de;                      /* of the entity at hand */
	int from;                    /* P lines before it */
};

/* One entity: begin, its numbers, end with its color (0, or minus a 314) and status number. Gives
 * its directory entry. Names are properties, written before. */
int iges_begin(struct iges_writer *w, int type);
void iges_put_int(struct iges_writer *w, int x, char delimiter);
void iges_end(struct iges_writer *w, int type, int color, int name, const char *status);

/* A whole 126 with that status. */
int iges_put_curve(struct iges_writer *w, const struct curve *c, const char *status);

/* iges_format_trims.c: 144 of the surface 128 at directory entry `base`, one for each outer loop,
 * and all that they need. Errors: ST_RESOURCE. */
enum status iges_put_trims(struct iges_writer *w, const struct entity *e, int base, int color,
                           int name);

#endif
