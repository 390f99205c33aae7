/* world.h - what is open: curves and surfaces, which of them are current, what is shown, undo. */
#ifndef BATTEN_WORLD_H
#define BATTEN_WORLD_H

#include <stdint.h>

#include "camera.h"
#include "colormap.h"
#include "curvature.h"
#include "model.h"

enum line_type { LINE_SOLID, LINE_DASHED, LINE_DOTTED };
enum surface_look { LOOK_WIRE, LOOK_SHADED, LOOK_MAP, LOOK_IMAGE };

/* How a thing is drawn; never a change of the thing. */
struct display {
	bool on;
	bool has_color;
	struct rgb color;
	enum line_type line;
	int segments;         /* of a curve, or of an isoparametric line; 0: as exact as seen */
	int lines_u, lines_v; /* isoparametric lines between the borders */
	enum surface_look look;
	bool net;       /* control polygon or net */
	bool porcupine; /* curvature comb */
	double quill;   /* length of the longest quill, share of the thing's size */
	int quills;     /* how many */
};

/*
 * One thing that is open: the thesis's FulCurv where its kind is a curve or a curve on surface, FulSurf
 * where it is a surface. Its id never changes and is never used again.
 */
struct Ful {
	int id;
	char *name;           /* owned; basic name, unique in the world */
	char *file;           /* owned; where it was read from or last saved, NULL: nowhere */
	int place;            /* among the entities of `file` */
	bool alone;           /* `file` holds nothing else */
	char *unit;           /* owned; of lengths: "m", or NULL where it is not known */
	double unit_in_mm;    /* 0 where not known */
	double scale;         /* IGES model space scale, 1 otherwise */
	struct entity entity; /* owned: geometry, trims, the color of its file */
	struct display display;
	int copy_of, offset_of, on; /* ids, 0: none; on: the surface a curve on surface lies on */
	double offset;              /* distance of offset_of, file units */
	bool saved;                 /* as it is, it lies in `file` */
	int64_t stamp[3];           /* of `file` when it was read: seconds, nanoseconds, size */
	unsigned revision;          /* grows with every change of the geometry: for caches */
};

bool ful_is_curve(const struct Ful *f); /* curve or curve on surface */
bool ful_is_surface(const struct Ful *f);

enum overlay_kind { OVERLAY_MAP, OVERLAY_LINES, OVERLAY_IMAGE };

/* A result that is shown with its thing: a curvature map on a surface, lines on it, an image. */
struct overlay {
	enum overlay_kind kind;
	int thing;   /* id, 0: none (an image of several) */
	char *file;  /* owned; result or, while its job runs, part file */
	int64_t job; /* 0: none; else tiles arrive from it */
	enum quantity quantity;
	bool range_given, symmetric; /* of a map */
	double lo, hi;
	enum colormap_scale scale;
	struct overlay *before; /* the world's own: shown again where `job` comes to nothing */
};

/* Where a probe was kept. */
struct mark {
	int thing; /* id of a surface */
	double u, v;
};

/* What the window shows beside each other: one view; two of the same from two sides; the parent and
 * what was made from it; the current surface and the plane of its parameters. */
enum view_split { SPLIT_ONE, SPLIT_SIDE, SPLIT_CHILD, SPLIT_UV, N_SPLITS };
extern const char *const view_split_words[N_SPLITS]; /* "one", "side", "child", "uv" */

/* Things that setting routines set and that are no default of a job. */
struct sight {
	struct camera camera; /* width and height are the window's concern */
	bool has_camera;
	double near_, far_; /* of the view, from the eye, file units; 0: as it fits */
	struct rgb background;
	bool has_background;
	double light_azimuth, light_incidence, light_intensity; /* degrees, 0 .. 1 */
	struct rgb specular;
	double reflectivity;
	bool bell;
	bool all_curvatures; /* seven tiles */
	bool no_image;       /* images give way to the things they are of */
	enum view_split split;
	struct camera beside; /* of SPLIT_SIDE, from where the second view looks */
	bool has_beside;
};

struct world; /* opaque */

/*
 * folder: the project's. Borrowed strings are copied.
 * Errors: ST_RESOURCE.
 */
enum status world_create(struct world **out, const char *folder);
void world_destroy(struct world *w); /* NULL is fine */
const char *world_folder(const struct world *w);

/* What is there. Pointers are borrowed until the next change. */
int world_count(const struct world *w);
const struct Ful *world_at(const struct world *w, int k);     /* k < count, in order of opening */
const struct Ful *world_by_id(const struct world *w, int id); /* NULL: none */
/* By its name, by FILE#ENTITY (number, D and Directory Entry number), or by the label of its file where
 * only one has that. Errors: NULL, and the sentence names what is open. */
const struct Ful *world_find(const struct world *w, const char *name, const struct report *r);
const struct Ful *world_current(const struct world *w, bool curve); /* NULL: none */
const struct Ful *
world_selected(const struct world *w); /* the one of both that was made current last */
/* The thing selected and the last one made from it (a copy, an offset), or, where it was made from
 * another itself, that other and it; false: there is no child, and
 * *parent is what is selected. */
bool world_family(const struct world *w, const struct Ful **parent, const struct Ful **child);
unsigned world_revision(const struct world *w); /* grows with every change of anything here */
bool world_unsaved(const struct world *w);

/* How geometry files are read: as model_read, which is used unless this sets another. data is borrowed. */
typedef enum status world_reader(void *data, struct model *out, const char *path,
                                 const struct progress *p, const struct report *r);
void world_set_reader(struct world *w, world_reader *read, void *data);

/* Open every entity of a file, or those chosen ("3", "NAME", "D15", several by comma; NULL: all that
 * no other entity uses); the first of each kind becomes current. Names are made unique (-2, -3).
 * Not an edit that undo takes back. Errors: as model_read. */
enum status world_open(struct world *w, const char *path, const char *entities,
                       const struct progress *p, const struct report *r);
/* Likewise only those whose kind is in `kinds` (a bit 1 << enum entity_kind each), and the surfaces of
 * curves on surface. Where curves on surface alone are wanted they are also those that trim a surface; who
 * chooses a surface chooses its. Errors: ST_INPUT where there are none, or one chosen is of another kind. */
enum status world_open_kinds(struct world *w, const char *path, const char *entities,
                             unsigned kinds, const struct progress *p, const struct report *r);

/*
 * Edits. Each is one step of undo and is named ("move point 5"). `e` is moved in.
 * Errors: ST_PARAMETER (no such thing), ST_RESOURCE.
 */
enum status world_add(struct world *w, const char *what, const char *name, struct entity *e,
                      int *id, const struct report *r);
/* Where a thing comes from. `on` must be given with a curve on surface. */
struct origin {
	int copy_of, offset_of, on; /* ids, 0: none; lengths are in the unit of the first given */
	double offset;
};
/* name NULL: that of its origin, made unique; world_add: origin NULL. The new thing becomes current. */
enum status world_add_from(struct world *w, const char *what, const char *name, struct entity *e,
                           const struct origin *from, int *id, const struct report *r);
/* Results shown with the thing, and marks on it, belong to what it was: they go. */
enum status world_replace(struct world *w, const char *what, int id, struct entity *e,
                          const struct report *r);
/* A surface takes the curves on it along. */
enum status world_remove(struct world *w, const char *what, int id, const struct report *r);
enum status world_rename(struct world *w, int id, const char *name, const struct report *r);
/* Edits from begin to end are one step; keep false takes them back, as if they had not been. */
void world_step_begin(struct world *w, const char *what);
void world_step_end(struct world *w, bool keep);
/* What its lengths are in; they stay as they are. */
enum status world_set_unit(struct world *w, int id, const char *unit, double unit_in_mm,
                           const struct report *r);
enum status world_undo(struct world *w, const struct report *r);
enum status world_redo(struct world *w, const struct report *r);
const char *world_undo_name(const struct world *w); /* "move point 5", NULL: nothing to undo */
const char *world_redo_name(const struct world *w);

/* Not edits: what is current, how it is drawn, what is shown. */
enum status world_select(struct world *w, int id, const struct report *r);
enum status world_set_display(struct world *w, int id, const struct display *d);
struct sight *world_sight(struct world *w); /* to read and change; then world_touch */
void world_touch(struct world *w);
enum status world_show(struct world *w,
                       const struct overlay *o); /* copied; replaces one of its kind and thing */
void world_hide(struct world *w, enum overlay_kind kind, int thing);
/* Its job came to nothing: what was shown before it is shown again, or nothing. */
void world_hide_job(struct world *w, enum overlay_kind kind, int thing);
int world_overlays(const struct world *w);
const struct overlay *world_overlay(const struct world *w, int k);
/* All seven curvatures at once, which an image in the view hides. */
bool world_shows_seven(const struct world *w);
enum status world_keep_mark(struct world *w, const struct mark *m);
int world_marks(const struct world *w);
const struct mark *world_mark(const struct world *w, int k);
void world_drop_marks(struct world *w);

/* Write a thing, whole or not at all; it is saved then. path NULL: its own file where that holds nothing
 * else and has its name, otherwise NAME.base in the project's folder, which must not be there yet. A curve
 * on surface takes its surface along.
 * Errors: ST_PARAMETER (no such thing, another's file), ST_INPUT (not writable), ST_RESOURCE. */
enum status world_save(struct world *w, int id, const char *path, const struct report *r);

/* Defaults of later jobs that setting routines store: "curvature", "grid", "400x200". NULL: none. */
enum status world_set_default(struct world *w, const char *worker, const char *parameter,
                              const char *value);
const char *world_default(const struct world *w, const char *worker, const char *parameter);

/* Edits that were not saved are given up: the session keeps what the files have, and nothing of what lies
 * in none; that goes. For the end: undo goes, too. */
void world_discard(struct world *w);

/* The things as a model, for writers: of each id the geometry, the surface of a curve on surface with it.
 * The caller finishes *out. Errors: ST_PARAMETER (no such thing, two units), ST_RESOURCE. */
enum status world_model(const struct world *w, const int *ids, int n, struct model *out,
                        const struct report *r);

/* The session: what is open, unsaved geometry with it, sight, display, overlays, defaults, in
 * .batten/session; restored at start. Undo does not survive. */
enum status world_keep_session(const struct world *w, const struct report *r);
enum status world_restore_session(struct world *w, const struct report *r);

#endif
