/* world_private.h - what the files of the world share. */
#ifndef BATTEN_WORLD_PRIVATE_H
#define BATTEN_WORLD_PRIVATE_H

#include "world.h"

/* One thing as it was before an edit. */
struct change {
	int id, place;   /* place among the things when it goes or comes back */
	struct Ful *ful; /* owned; NULL: it was not there */
};

struct step {
	char *name; /* owned; "move point 5" */
	struct change *changes;
	int n;
};

struct history {
	struct step *steps; /* owned; the last is the next to be taken */
	int n;
	size_t bytes; /* about what the steps hold */
};

struct preset {
	char *worker, *parameter, *value; /* owned */
};

struct world {
	char *folder;
	struct Ful **things; /* owned, in order of opening */
	int n;
	int last_id;
	int current[2]; /* ids: surface, curve; 0: none */
	int selected;   /* id of the last one made current */
	unsigned revision;
	struct history undo, redo;
	struct step open; /* the edits since world_step_begin */
	int depth;        /* of begins that have not ended */
	world_reader *read;
	void *read_data; /* borrowed */
	struct sight sight;
	struct overlay *overlays;
	int n_overlays;
	struct mark *marks;
	int n_marks;
	struct preset *presets;
	int n_presets;
};

/* Room for one more in an array that doubles: n elements are in it. */
enum status grow(void **array, int n, size_t size);

/* things.c */
int thing_index(const struct world *w, int id); /* -1: none */
struct Ful *thing_get(const struct world *w, int id);
void ful_destroy(struct Ful *f);       /* NULL is fine */
size_t ful_bytes(const struct Ful *f); /* about */
/* All of it twice; *out is fresh. */
enum status ful_copy(struct Ful **out, const struct Ful *f);
/* A thing around an entity (moved in, also on failure), not yet in the world. */
enum status ful_create(struct world *w, struct Ful **out, struct entity *e);
enum status thing_append(struct world *w, struct Ful *f); /* f is taken, also on failure */
void thing_take_out(struct world *w, int index);
void thing_make_current(struct world *w, const struct Ful *f);
void thing_mend_current(struct world *w);
enum status thing_missing(int id, const struct report *r);
enum status out_of_memory(const struct report *r);

/* names.c: a name that no other thing has, fresh, of what can be part of a file's name. */
char *name_unique(const struct world *w, const char *wish);
enum status name_check(const struct world *w, int id, const char *name, const struct report *r);

/* open.c: by the reader set, or model_read. */
enum status world_read(const struct world *w, struct model *out, const char *path,
                       const struct progress *p, const struct report *r);
/* The curves that trim surfaces as curves on them, behind all that the file has. */
enum status world_add_trims(struct model *m);
void world_stamp(const char *path, int64_t stamp[3]); /* zeros: it is not there */

/* history.c */
enum status history_room(struct world *w); /* for one more change: so that recording cannot fail */
void history_record(struct world *w, int id, int place, struct Ful *before); /* taken */
void history_finish(struct history *h);
void history_saved(struct world *w,
                   const struct Ful *f); /* earlier states are not what f's file has */

/* overlays.c */
void overlays_drop(struct world *w, int id); /* results and marks of a shape that is no more */
void overlays_finish(struct world *w);

/* settings_kept.c */
void presets_finish(struct world *w);

/* session.c */
char *session_folder(const struct world *w);
extern const char *const line_type_words[3];
extern const char *const look_words[4];

#endif
