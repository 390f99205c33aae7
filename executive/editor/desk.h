/* desk.h - the editor without its window: what every key and button does now, what is asked, what is
 * shown where. Events go in; what must be painted again comes out. Lengths are logical px of the window. */
#ifndef BATTEN_DESK_H
#define BATTEN_DESK_H

#include "errand.h"
#include "help.h"
#include "jobs_link.h"
#include "menu.h"
#include "panel.h"
#include "view.h"

/* Pieces of the window that are painted on surfaces of their own, from back to front. */
enum desk_part {
	PART_OVER,  /* headings, color keys and bars over the view */
	PART_PROBE, /* what lies under the mouse */
	PART_TOP,
	PART_MENU,
	PART_MOUSE,
	PART_FOOT,
	PART_CARD, /* of a tool: light, color; nothing is open */
	PART_PAGE, /* jobs, search, help, keys, messages, questions */
	N_DESK_PARTS
};
enum { DESK_VIEW = 1 << N_DESK_PARTS, DESK_ALL = (2 << N_DESK_PARTS) - 1 };

enum desk_key {
	KEY_ESCAPE,
	KEY_ENTER,
	KEY_TAB,
	KEY_BACKSPACE,
	KEY_DELETE,
	KEY_LEFT,
	KEY_RIGHT,
	KEY_UP,
	KEY_DOWN,
	KEY_HOME,
	KEY_END,
	KEY_PAGE_UP,
	KEY_PAGE_DOWN,
	KEY_SPACE,
	KEY_F1,
	KEY_F4,
	KEY_F9,
	KEY_F10,
	KEY_CTRL_1, /* six in a row, then letters with Ctrl */
	KEY_CTRL_6 = KEY_CTRL_1 + 5,
	KEY_CTRL_A,
	KEY_CTRL_Z = KEY_CTRL_A + 25,
};
enum { MOD_SHIFT = 1, MOD_CTRL = 2, MOD_ALT = 4 };
enum desk_button { BUTTON_LEFT, BUTTON_MIDDLE, BUTTON_RIGHT };

/* What the desk wants of the window. All are called on the caller's thread; those that are NULL are
 * left out. */
struct desk_ports {
	/* what lies at (x, y) of a view's rectangle, as view_pick */
	bool (*pick)(void *data, const struct view_state *v, double x, double y, bool points,
	             int skip, struct pick *out);
	bool (*key)(void *data, struct key *out); /* of the map drawn last, as view_key */
	void (*ask_jobs)(void *data, enum message_type type, const int64_t *ids, int n);
	void (*restart_jobs)(void *data);
	/* start it on a thread; false: run it now. Its end is told by desk_errand_over */
	bool (*start)(void *data, struct errand *e);
	errand_picture *picture; /* of EXPORT PICTURE */
	void (*bell)(void *data);
	void (*close)(void *data); /* the window is to close, all is settled */
	void (*copy)(void *data, const char *text);
	const char *(*paste)(void *data); /* borrowed; NULL: nothing */
	void *data;
};

struct desk; /* opaque */

/* What the desk stands on; all borrowed until desk_destroy. */
struct desk_house {
	struct world *world;
	const struct project *project;
	const struct menu_set *menus; /* what they complain of is said */
	const struct help *help;      /* likewise */
	enum theme theme;
};

/* Errors: ST_RESOURCE. Thread: every function is for one thread. */
enum status desk_create(struct desk **out, const struct desk_house *h, const struct desk_ports *p);
void desk_destroy(struct desk *d); /* NULL is fine */

/* Events. */
void desk_resize(struct desk *d, double width, double height, double scale);
void desk_key(struct desk *d, enum desk_key key, unsigned mods);
void desk_space_up(struct desk *d); /* the space bar was let go */
void desk_text(struct desk *d, uint32_t character);
void desk_move(struct desk *d, double x, double y);
void desk_press(struct desk *d, enum desk_button button, unsigned mods);
void desk_release(struct desk *d, enum desk_button button);
void desk_scroll(struct desk *d, double dy);
void desk_tick(struct desk *d, double now); /* seconds since 1970: clocks of jobs, the caret */
/* When desk_tick is to be called next if nothing else happens; INFINITY: not. */
double desk_next_tick(const struct desk *d);
void desk_close(struct desk *d); /* the window's close button: asks where work could be lost */
/* Open these files (as V175 does), one after the other. */
void desk_open(struct desk *d, const char *const *files, int n);
/* Records changed in the shelf; how the tie to the service stands. */
void desk_jobs_changed(struct desk *d, enum link_state state, const char *reason);
void desk_answer(struct desk *d, const struct link_answer *a);
void desk_errand_progress(struct desk *d);
void desk_errand_over(struct desk *d);

/* A sentence for the message line. */
void desk_say(struct desk *d, enum report_level level, const char *format, ...)
        __attribute__((format(printf, 3, 4)));

/* The shelf that the window fills. */
struct job_shelf *desk_shelf(struct desk *d);

/* What must be painted again: a bit a part, and DESK_VIEW. Taking it clears it. While an errand has the
 * world, what shows the world is kept back. */
unsigned desk_take_dirty(struct desk *d);
/* The part's rectangle; width 0: not shown. */
struct box_px desk_part_box(const struct desk *d, enum desk_part part);
/* Paint a part; cr has window coordinates in logical px and is clear. */
void desk_paint(struct desk *d, enum desk_part part, cairo_t *cr);

/* The views: each a rectangle and what it shows. *n of them, borrowed until the next event. A plane of
 * parameters is painted by PART_OVER: there is nothing to draw. */
struct desk_tile {
	struct box_px box;
	struct view_state view;
	bool is_uv;
};
struct desk_tile *desk_tiles(struct desk *d, int *n);
bool desk_world_lent(const struct desk *d); /* an errand has it: do not draw views */
int desk_tile_focus(const struct desk *d);  /* the view with the keyboard */
bool desk_moving(const struct desk *d);     /* a view is being dragged */

/* Models as painted last, for tests and the sheet in the documents. Borrowed until the next event. */
const struct menu_model *desk_menu_model(struct desk *d);
const struct foot_model *desk_foot_model(struct desk *d);
const struct top_model *desk_top_model(struct desk *d);
const struct jobs_model *desk_jobs_model(struct desk *d);     /* NULL: the page is not open */
const struct search_model *desk_search_model(struct desk *d); /* likewise */
const struct help_model *desk_help_model(struct desk *d);
const struct list_model *desk_list_model(struct desk *d); /* messages, a question */
const struct keys_model *desk_keys_model(struct desk *d);
struct Mouse_Words desk_mouse_words(const struct desk *d);
const struct hits *desk_hits(const struct desk *d, enum desk_part part);

/* The keys and what they do: the sheet and the document are made of these rows. NULL key ends. */
extern const struct key_row desk_key_table[];

#endif
