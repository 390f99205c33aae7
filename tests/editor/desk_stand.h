/* desk_stand.h - a desk for tests to sit at: events in, models out, nothing on a screen. */
#ifndef BATTEN_TESTS_DESK_STAND_H
#define BATTEN_TESTS_DESK_STAND_H

#include "desk.h"

struct stand {
	char folder[64];
	struct project project;
	struct world *world;
	struct menu_set menus;
	struct help *help;
	struct desk *desk;
	cairo_surface_t *paper;
	bool closed, keep_errands;
	int bells;
	struct errand *errand; /* kept, not run */
	enum message_type asked;
	int64_t ids[8];
	int n_ids;
	struct pick pick;
};

/* cmocka's set up and tear down; *state is the stand. */
int stand_set_up(void **state);
int stand_tear_down(void **state);
int stand_set_up_drawing(void **state,
                         errand_picture *picture); /* with an EXPORT PICTURE of its own */
/* A bent plate of 4 x 4 points; its id. */
int stand_add_plate(struct stand *s, const char *name);

/* Paint what is dirty, which says where things are; what that was. */
unsigned stand_paint(struct stand *s);
const struct hit *stand_hit(struct stand *s, enum hit_kind kind, int index, int part); /* -1: any */
void stand_click(struct stand *s, enum hit_kind kind, int index);
void stand_click_with(struct stand *s, enum hit_kind kind, int index, int part, unsigned mods);
void stand_type(struct stand *s, const char *ascii);
void stand_key(struct stand *s, enum desk_key k);
/* Go to a leaf as a user would who knows its code. */
void stand_leaf(struct stand *s, const char *code);

const char *stand_title(struct stand *s);
const char *stand_message(struct stand *s);
int stand_row_of(struct stand *s, const char *name);
const struct menu_row *stand_row(struct stand *s, const char *name);
const struct form_field *stand_field(struct stand *s, const char *label);

errand_picture stand_picture; /* of EXPORT PICTURE: a few bytes */
void stand_put_job(struct stand *s, int64_t id, enum job_state state, const char *reason);
void stand_some_jobs(struct stand *s); /* 1 running, 2 suspended, 3 failed, 4 queued */

#endif
