/* iges_writer.h - what the files of the IGES writer share: sections being written. */
#ifndef BATTEN_IGES_WRITER_H
#define BATTEN_IGES_WRITER_H

#include <stdio.h>

#include "iges.h"
#include "number.h"

/* An entity written that belongs to a group. */
struct iges_member {
	const char *group; /* borrowed */
	int de;
};

struct iges_writer {
	struct text directory, data;  /* whole lines, or the last of them where they go to files */
	FILE *directory_to, *data_to; /* borrowed; NULL: all lines stay in memory */
	struct text line;             /* data columns of the P line begun */
	int n_d, n_p;                 /* lines in them */
	int de;                       /* of the entity at hand */
	int from;                     /* P lines before it */
	struct iges_member *members;  /* owned; in the order of their numbers */
	int n_members;
};

/* iges_format.c: directory and data of all. False: no memory, or more lines than can be numbered. */
bool iges_put_model(struct iges_writer *w, const struct model *m);
/* Lines that are done go to the file, if there is one, when they are more than `kept` bytes. */
void iges_let_go(struct text *lines, FILE *to, size_t kept);

/* Reals of IGES have a point, and E before the exponent. Returns the length. */
enum { IGES_REAL_SIZE = NUMBER_SIZE + 2 };
size_t iges_real_text(char out[IGES_REAL_SIZE], double x);

/* The curve of an entity that 126 can hold; NULL for none. */
const struct curve *iges_curve_of(const struct entity *e);

/* One entity: begin, its numbers, end with its color (0, or minus a 314) and status number. Gives
 * its directory entry. Names are properties, written before. */
int iges_begin(struct iges_writer *w, int type);
void iges_put_real(struct iges_writer *w, double x, char delimiter);
void iges_put_int(struct iges_writer *w, int x, char delimiter);
void iges_end(struct iges_writer *w, int type, int color, int name, const char *status);

/* Likewise with a form. */
void iges_end_form(struct iges_writer *w, int type, int form, int color, int name,
                   const char *status);

/* A property with a name (406 form 15). */
int iges_put_name(struct iges_writer *w, const char *name);

/* A whole 126 with that status. */
int iges_put_curve(struct iges_writer *w, const struct curve *c, const char *status);

/* iges_format_trims.c: 144 of the surface 128 at directory entry `base`, one for each outer loop,
 * and all that they need. Errors: ST_RESOURCE. */
enum status iges_put_trims(struct iges_writer *w, const struct entity *e, int base, int color,
                           int name);

/* A 142: a curve in u,v of the surface at `base`, which counts, and in space. */
int iges_put_curve_on_surface(struct iges_writer *w, int base, int uv, int space, int color,
                              int name, const char *status);

/* iges_format_header.c: how many lines. */
int iges_put_start(struct text *out);
int iges_put_global(const struct model *m, struct text *out);

/* iges_format_groups.c: note that `de` shows e, which may be of a group; write all groups that were
 * met, 402 form 7 with their names. Without memory w->data fails. */
void iges_join_group(struct iges_writer *w, const struct entity *e, int de);
void iges_put_groups(struct iges_writer *w);

#endif
