/* model.h - what a geometry file holds, whatever its format. */
#ifndef BATTEN_MODEL_H
#define BATTEN_MODEL_H

#include <stdatomic.h>

#include "box.h"
#include "curve.h"
#include "report.h"
#include "surface.h"

enum entity_kind { ENTITY_CURVE, ENTITY_SURFACE, ENTITY_CURVE_ON_SURFACE, ENTITY_POINTS };

struct point_list {
	int n, dimension; /* 2: u v, 3: x y z */
	double *values;   /* owned, n x dimension */
};

struct entity {
	enum entity_kind kind;
	int number;      /* 1, 2, ... as `batten info` counts; 0: used by another entity only */
	char *name;      /* owned; label of the file, or NULL */
	int de;          /* IGES Directory Entry number, 0 if none */
	int source_type; /* IGES entity type it was made from, 0 if none */
	int trims;       /* trimming loops that the file gives it (not read yet: counted) */
	bool has_color;
	double color[3]; /* sRGB 0 .. 1 */
	int surface;     /* of a curve on surface: index of its surface in the model, or -1 */
	struct curve curve;        /* ENTITY_CURVE; ENTITY_CURVE_ON_SURFACE: in u, v */
	struct surface geometry;   /* ENTITY_SURFACE */
	struct point_list points;  /* ENTITY_POINTS */
};

struct skipped {
	int type;     /* IGES type */
	int count;
	int first_de;
	char *reason; /* owned */
};

struct attribute {
	char *name, *value; /* owned; how a file was made: worker, parameters, input hash */
};

struct model {
	char *file;          /* owned; path it was read from */
	char *unit;          /* owned; "m", "mm", "in", ... or NULL where the file names none */
	double unit_in_mm;   /* 0 where not known */
	double scale;        /* IGES model space scale, 1 otherwise; coordinates are left as they are */
	struct entity *entities; /* owned */
	int n;
	struct skipped *skipped; /* owned; one row a type and reason */
	int n_skipped;
	char **warnings; /* owned */
	int n_warnings;
	struct attribute *attributes; /* owned */
	int n_attributes;
};

void model_init(struct model *m);
void model_finish(struct model *m);

/* Append an entity (moved in: *e is empty afterwards). Errors: ST_RESOURCE. */
enum status model_add(struct model *m, struct entity *e);
enum status model_skip(struct model *m, int type, int de, const char *reason);
enum status model_warn(struct model *m, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
enum status model_set_attribute(struct model *m, const char *name, const char *value);
const char *model_get_attribute(const struct model *m, const char *name); /* NULL if none */

/* Give the numbers 1, 2, ... to what `info` lists: in DE order, every surface, and every curve that
 * no other entity uses (those come with number 0 already set by the reader to -1 or kept). */
void model_number(struct model *m);

/* "3", "NAME" or "D15" -> the entity; NULL selector: not allowed here.
 * Errors: ST_INPUT with a sentence that names what the file has. */
enum status model_find(const struct model *m, const char *selector, struct entity **out,
                       const struct report *r);

const char *entity_kind_name(enum entity_kind kind); /* "curve", "surface", ... */

/* Box of one entity, tight within 1e-9 of its size. */
enum status entity_box(const struct entity *e, struct box *out);

/* How far a reader is, and whether to stop. */
struct progress {
	void (*step)(void *data, double fraction); /* may be NULL */
	void *data;
	const atomic_bool *stop; /* may be NULL */
};

/*
 * Read any geometry file by its content: .base and its kin, IGES. `p` may be NULL.
 * Errors: ST_INPUT (missing, unknown format, nothing could be read, cut short), ST_RESOURCE,
 * ST_CANCELLED. m is initialised here and finished on failure... the caller finishes on success.
 */
enum status model_read(struct model *m, const char *path, const struct progress *p,
                       const struct report *r);

/* "hull.igs#3" -> path "hull.igs", selector "3" (NULL where there is no '#'; a file that exists
 * under the whole name wins). Both fresh. */
enum status model_split_name(const char *argument, char **path, char **selector);

#endif
