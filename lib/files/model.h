/* model.h - what a geometry file holds, whatever its format. */
#ifndef BATTEN_MODEL_H
#define BATTEN_MODEL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "box.h"
#include "curve.h"
#include "report.h"
#include "surface.h"
#include "trim.h"

enum entity_kind {
	ENTITY_CURVE,
	ENTITY_SURFACE,
	ENTITY_CURVE_ON_SURFACE,
	ENTITY_POINTS,
	N_ENTITY_KINDS,
};

struct point_list {
	int n, dimension; /* 2: u v, 3: x y z */
	double *values;   /* owned, n x dimension */
};

/* A name and a value, both text. */
struct attribute {
	char *name, *value; /* owned */
};

/* Directory Entry numbers of the trimmed faces that lie on a surface. */
struct face_list {
	int n;
	int de[];
};

enum { SOURCE_TYPE_MAX = 1023, ATTRIBUTES_MAX = 65535 };

/* Files have hundreds of thousands of lines and points, so it is kept small: what only one kind has
 * shares its room with what others have. Look at the kind before you look at these. */
struct entity {
	enum entity_kind kind : 4;
	bool used : 1; /* a curve or point that another entity is made of or trimmed by */
	bool has_color : 1;
	unsigned source_type : 10; /* IGES entity type it was made from, 0 if none */
	unsigned short n_attributes;
	float color[3]; /* sRGB 0 .. 1 */
	int number;     /* 1, 2, ... as `batten info` counts; 0: used by another entity only */
	int de;         /* IGES Directory Entry number, 0 if none */
	int trims;      /* trimming loops that the file gives it, read or not */
	int surface;    /* of a curve on surface: index of its surface in the model, or -1 */
	char *name;     /* owned; label of the file, or NULL */
	struct attribute *attributes; /* owned; what is known of it: angle, closed, length, ... */
	union {
		struct { /* ENTITY_CURVE; ENTITY_CURVE_ON_SURFACE: in u, v and in space */
			struct curve curve;
			struct curve space; /* order 0: none */
		};
		struct { /* ENTITY_SURFACE */
			struct surface geometry;
			struct trim trim;        /* what is left of it; zeroed: all */
			struct face_list *faces; /* owned; NULL: none */
		};
		struct point_list points; /* ENTITY_POINTS */
	};
};

/* An empty entity of that kind; finish takes back all it owns (a zeroed one is fine). */
void entity_init(struct entity *e, enum entity_kind kind);
void entity_finish(struct entity *e);

/* All that e owns, twice. *out is fresh, or empty on failure. Errors: ST_RESOURCE. */
enum status entity_copy(struct entity *out, const struct entity *e);

/* Set or replace. Errors: ST_RESOURCE. */
enum status entity_set_attribute(struct entity *e, const char *name, const char *value);
const char *entity_get_attribute(const struct entity *e, const char *name); /* NULL if none */
/* Errors: ST_RESOURCE, ST_INTERNAL (no surface). */
enum status entity_add_face(struct entity *e, int de);

const char *entity_kind_name(enum entity_kind kind); /* "curve", "surface", ... */

/* Box in space of one entity, tight within 1e-9 of its size. A curve on surface without its curve
 * in space, and a list of u, v, have a box in u, v with z = 0. Errors: ST_RESOURCE. */
enum status entity_box(const struct entity *e, struct box *out);

struct skipped {
	int type; /* IGES type */
	int count;
	int first_de;
	char *reason; /* owned */
};

struct model {
	char *file;        /* owned; path it was read from, or NULL */
	char *unit;        /* owned; "m", "mm", "in", ... or NULL where the file names none */
	double unit_in_mm; /* 0 where not known */
	double scale;      /* IGES model space scale, 1 otherwise; coordinates are as in the file */
	struct entity *entities; /* owned */
	int n;
	struct skipped *skipped; /* owned; one row a type and reason */
	int n_skipped;
	char **warnings; /* owned; kept here for the caller to say, not said to a report */
	int n_warnings;
	struct attribute
	        *attributes; /* owned; how a file was made: worker, parameters, input hash */
	int n_attributes;
};

void model_init(struct model *m);
void model_finish(struct model *m);

/* Append an entity (moved in: *e is empty afterwards, also on failure). Errors: ST_RESOURCE. */
enum status model_add(struct model *m, struct entity *e);
/* Count one that was not read, keep a warning, set or replace an attribute; texts are copied.
 * Errors: ST_RESOURCE. */
enum status model_skip(struct model *m, int type, int de, const char *reason);
enum status model_warn(struct model *m, const char *format, ...)
        __attribute__((format(printf, 2, 3)));
enum status model_set_attribute(struct model *m, const char *name, const char *value);
const char *model_get_attribute(const struct model *m, const char *name); /* NULL if none */

/* A fresh copy of `text` (caller's old one freed) into *field; NULL text empties it. */
enum status model_set_text(char **field, const char *text);

/* Give the numbers 1, 2, ... in the order of the entities to all that no other one uses. */
void model_number(struct model *m);

/*
 * "3", "NAME" or "D15" -> the entity, borrowed. D finds used entities too, and for a trimmed face
 * the surface that it lies on.
 * Errors: ST_INPUT with a sentence that names what the file has.
 */
enum status model_find(const struct model *m, const char *selector, struct entity **out,
                       const struct report *r);

/* How far a reader is, and whether to stop. */
struct progress {
	void (*step)(void *data, double fraction); /* may be NULL */
	void *data;
	const atomic_bool *stop; /* may be NULL */
};

/* Say how far; ST_CANCELLED when told to stop. p may be NULL. */
enum status progress_step(const struct progress *p, double fraction);

/*
 * Read any geometry file by its content: .base and its kin, IGES, .g2, points in columns. `p` may be NULL.
 * m is initialised here; on success the caller finishes it, on failure it is empty.
 * Errors: ST_INPUT (missing, unknown format, nothing could be read, cut short), ST_RESOURCE,
 * ST_CANCELLED.
 */
enum status model_read(struct model *m, const char *path, const struct progress *p,
                       const struct report *r);

/* "hull.igs#3" -> path "hull.igs", selector "3" (NULL where there is no '#'; a file that exists
 * under the whole name wins). Both fresh. Errors: ST_RESOURCE. */
enum status model_split_name(const char *argument, char **path, char **selector);

#endif
