/* desk_inside.h - what the files of the desk share. Private to desk*.c. */
#ifndef BATTEN_DESK_INSIDE_H
#define BATTEN_DESK_INSIDE_H

#include "desk.h"
#include "typed.h"

/* how much is kept, and how much is shown of what is found */
enum { PATH_MAX_DEPTH = 16, ENTRIES_MAX = 14, TILES_MAX = 8, PICKED_MAX = 512 };
enum { MESSAGES_MAX = 200, HISTORY_MAX = 100, FIELDS_MAX = 48, BUTTONS_MAX = 4 };
enum { CANDIDATES_MAX = 8, RESULTS_MAX = 8, NEAREST_MAX = 2, FOUND_MAX = 256 };

/* What covers the view or the panel, and takes the keys. */
enum page { PAGE_NONE, PAGE_JOBS, PAGE_SEARCH, PAGE_HELP, PAGE_KEYS, PAGE_MESSAGES, PAGE_QUESTION };

/* What the mouse does in the view, beside turning it. */
enum tool { TOOL_NONE, TOOL_VIEW, TOOL_LIGHT, TOOL_COLOR, TOOL_POINTS, TOOL_PICK };

enum drag_kind {
	DRAG_NONE,
	DRAG_ROTATE,
	DRAG_PAN,
	DRAG_PROBE,
	DRAG_LIGHT,
	DRAG_POINT,
	DRAG_CARD, /* on a card: a dial, a slider */
	DRAG_KEY,
};

/* Strings and arrays of a model; all go at the model's next filling. */
struct scraps {
	void **piece; /* owned, and each piece */
	int n, cap;
};

struct message_line {
	enum report_level level;
	bool done;                /* a check before it */
	bool past;                /* another form was opened since */
	const struct routine *of; /* what failed, NULL: none */
	char *text;               /* owned */
	char hint[48];
};

struct remembered {
	char *name, *value; /* owned */
};

/* A leaf that is asked for. */
struct ask {
	const struct routine *routine; /* NULL: nothing is asked */
	const struct Menu_Entry *entry;
	struct argument_row *rows; /* owned */
	int n, focus, scroll;
	struct typed *field; /* owned; n */
	char **error;        /* owned, and each; NULL: fine */
	json_t *candidates;  /* owned; of the field in focus */
	int candidate;       /* chosen one, -1: none */
	int back;            /* steps into the history */
};

struct question {
	char *title;    /* owned */
	char *line[8];  /* owned; NULL where there are fewer */
	bool in_prompt; /* asked in the prompt line alone */
	char key[BUTTONS_MAX];
	const char *word[BUTTONS_MAX];            /* NULL ends */
	void (*answer)(struct desk *d, char key); /* Esc gives the last key: the safe one */
};

struct desk {
	struct desk_ports ports;
	struct desk_house house; /* borrowed things */
	struct world *world;
	double width, height, scale, now;
	bool panel_shown;
	enum theme theme;
	struct layout layout;
	unsigned dirty;
	unsigned seen_revision;
	struct hits hits[N_DESK_PARTS];
	struct scraps scraps[N_DESK_PARTS];
	struct look look;

	/* menus */
	const struct Menu_Entry *path[PATH_MAX_DEPTH]; /* path[depth - 1] is shown */
	int depth;
	const struct Menu_Entry *left[PATH_MAX_DEPTH]; /* where one was before the World menu */
	int left_depth;
	bool in_world;
	int row_focus; /* by keyboard, -1: none */

	struct ask ask;
	struct remembered *history; /* owned; HISTORY_MAX */
	int n_history;

	struct message_line messages[MESSAGES_MAX]; /* the newest last */
	int n_messages;

	/* pages */
	enum page page, under; /* under: comes back when this one is closed */
	int page_scroll;
	double help_scroll;
	int help_link; /* with the focus, -1: none */
	char help_code[8];
	struct typed search;
	const struct Menu_Entry *found[FOUND_MAX]; /* best first */
	int n_found, found_chosen; /* chosen: -1 until the user says so among the nearest */
	bool found_near;           /* nothing was found: they are the nearest by name */
	struct question question;

	/* jobs */
	struct job_shelf shelf;
	enum link_state link;
	char link_reason[256];
	int64_t picked[PICKED_MAX];
	int n_picked;
	int64_t job_focus, job_log; /* ids, 0: none */
	int job_tab, job_scroll, job_rows;
	char *log_text; /* owned */
	struct state_seen {
		int64_t id;
		enum job_state state;
	} * seen; /* owned; states the user was told of */
	int n_seen, seen_cap;
	int slots;      /* jobs that may run at once; 0: not looked up yet */
	bool caught_up; /* the first records came: what is over now is no news */

	/* views */
	struct desk_tile tiles[TILES_MAX];
	int n_tiles, tile; /* tile: the one with the keyboard */
	enum view_split split;
	bool fitted, split_anew;     /* split_anew: since the views were fitted last */
	double uv_range[2][2];       /* of the plane of parameters: what is seen of it */
	double uv_before[2][2];      /* of a drag, for Esc */
	int uv_of;                   /* id of the surface whose plane that is, 0: none */
	struct camera camera_before; /* of a drag, for Esc */
	struct camera camera_seen;   /* the world's, when the views last looked */
	struct camera camera_fitted; /* as everything was fitted last */
	struct sight sight_before;   /* of a tool, for Esc */
	struct display display_before;
	int display_thing;

	/* mouse */
	double x, y, down_x, down_y;
	enum drag_kind drag;
	enum desk_button drag_button;
	bool drag_moved, space, space_used;
	double click_at; /* of the last press on a key's end, for double clicks */
	enum tool tool;
	struct pick pick; /* under the mouse, or of the point dragged */
	int skip;
	bool probe_shown, probe_kept;
	double probe_x, probe_y;
	double hue, saturation, value; /* of the color tool */
	enum hit_kind card_kind;       /* of a DRAG_CARD */
	int card_index;
	enum quantity quantity;              /* of the map shown last */
	struct colormap key_map, key_before; /* as shown; when an end was taken */
	double key_px;
	bool point_moved, weighing; /* weighing: its weight is dragged, not its place */
	struct vec3 point_from, point_to;
	double weight_from, weight_to;

	struct errand *errand;   /* owned; it has the world */
	const char *undo_before; /* the last edit when it began: only compared, never looked at */
	char **pending;          /* owned; files still to be opened */
	int n_pending, pending_at;
	const char *leaving_jobs; /* what becomes of them: as V133 says it */

	/* models as filled last */
	struct menu_model menu;
	struct foot_model foot;
	struct top_model top;
	struct jobs_model jobs;
	struct search_model results;
	struct help_model help;
	struct list_model list;
	struct keys_model keys;
};

/* desk.c, desk_keys.c, desk_mouse.c */
void desk_dirty(struct desk *d, unsigned bits);
unsigned desk_bit(enum desk_part part);
void desk_place(struct desk *d); /* the layout, after anything that changes it */
void desk_set_page(struct desk *d, enum page page);
void desk_toggle_page(struct desk *d, enum page page);
void desk_leave_page(struct desk *d);
bool desk_back(struct desk *d);                /* one step, as Esc; false: nothing to leave */
bool desk_busy(struct desk *d);                /* an errand has the world: says so */
bool desk_takes_text(const struct desk *d);    /* letters go to a text */
void desk_command(struct desk *d, uint32_t c); /* a letter while no text is asked */
void desk_world_changed(struct desk *d);       /* look whether it did */

/* desk_menu.c */
const struct Menu_Entry *desk_shown_menu(const struct desk *d);
int desk_entries(const struct desk *d, const struct Menu_Entry *out[ENTRIES_MAX]);
void desk_enter(struct desk *d, const struct Menu_Entry *menu);
bool desk_up(struct desk *d);
void desk_world_menu(struct desk *d);
void desk_root(struct desk *d, enum menu_root which);
void desk_go_to(struct desk *d, const struct Menu_Entry *e); /* show the menu it is in */
void desk_choose(struct desk *d, const struct Menu_Entry *e);
bool desk_choose_key(struct desk *d, uint32_t c);
char desk_row_key(int row);
/* "MAIN › FILES"; the whole path, the entry's own name left out. Into a scrap. */
const char *desk_path_text(struct desk *d, struct scraps *s, const struct Menu_Entry *e);
const char *desk_short_name(const struct desk *d, const struct Menu_Entry *e);
const struct routine *desk_routine(const struct Menu_Entry *e);
const struct Menu_Entry *desk_leaf(const struct desk *d, const char *code); /* NULL: none */

/* desk_leaf.c: leaves that the desk knows by themselves */
bool desk_leaf_own(struct desk *d, const struct Menu_Entry *e); /* true: done */
bool desk_leaf_is_own(const char *code); /* the desk does it, whatever its routine says */
enum tool desk_leaf_tool(const char *code);
void desk_run(struct desk *d, const struct routine *t, const struct arguments *given);
void desk_run_code(struct desk *d, const char *code, const char *name, const char *value);
/* What was done without the routine, as if by it; pairs of name and value, ended by NULL. */
void desk_journal(struct desk *d, const char *code, const char *const *pairs);
void desk_open_next(struct desk *d);
const char *desk_near_path(const struct desk *d, const char *path); /* borrowed from path */

/* desk_leave.c */
void desk_quit(struct desk *d);

/* desk_ask.c */
void desk_ask(struct desk *d, const struct routine *t, const struct Menu_Entry *e);
void desk_ask_end(struct desk *d);
bool desk_ask_key(struct desk *d, enum desk_key key, unsigned mods);
bool desk_ask_text(struct desk *d, uint32_t c);
void desk_ask_focus(struct desk *d, int field);
void desk_ask_accept(struct desk *d);
void desk_ask_run(struct desk *d); /* as accept, and the form stays */
void desk_ask_defaults(struct desk *d);
bool desk_ask_textual(const struct desk *d);
void desk_ask_set(struct desk *d, const char *name, const char *format, ...)
        __attribute__((format(printf, 3, 4))); /* a field by name; nothing where there is none */
const char *desk_ask_get(const struct desk *d, const char *name); /* NULL: no such field */
int desk_ask_find(const struct desk *d, const char *name);        /* -1 */
enum form_kind desk_form_kind(const struct argument_row *row);
struct act desk_act(struct desk *d); /* to ask routines about their rows */
void desk_ask_dirty(struct desk *d);
void desk_ask_error(struct ask *a, int field, const char *text); /* NULL or "": it is fine */

/* desk_ask_values.c: of the field in focus */
void desk_ask_candidates(struct desk *d);
void desk_ask_changed(struct desk *d); /* the text: candidates, error gone */
void desk_ask_candidate(struct desk *d, int k);
void desk_ask_choice(struct desk *d, int field, int part);
bool desk_ask_complete(struct desk *d); /* false: nothing to complete */
void desk_ask_remember(struct desk *d, const char *name, const char *value);
void desk_ask_recall(struct desk *d, int step);
bool desk_ask_step(struct desk *d, int up);
bool desk_ask_up_down(struct desk *d, int down);

/* desk_search.c */
void desk_search_open(struct desk *d);
bool desk_search_key(struct desk *d, enum desk_key key);
void desk_search_changed(struct desk *d);
void desk_search_take(struct desk *d, int k, bool go);

/* desk_pages.c: help, keys, messages, questions */
void desk_help_for(struct desk *d, const char *code);
void desk_help_here(struct desk *d);
bool desk_page_key(struct desk *d, enum desk_key key, unsigned mods);
int desk_page_last(struct desk *d); /* the furthest that a list can be scrolled */
void desk_question(struct desk *d, const struct question *q); /* strings are moved in */
void desk_answer_question(struct desk *d, int button);
bool desk_question_text(struct desk *d, uint32_t c);
void desk_question_finish(struct question *q);

/* desk_jobs.c */
bool desk_jobs_key(struct desk *d, enum desk_key key, unsigned mods);
bool desk_jobs_text(struct desk *d, uint32_t c);
void desk_jobs_click(struct desk *d, const struct hit *h, unsigned mods);
int desk_jobs_rows(struct desk *d, const struct Stats **out,
                   int max);               /* of the tab, newest first */
int desk_jobs_count(const struct desk *d); /* in the tab */
bool desk_job_can(const struct Stats *s, enum message_type type);
void desk_jobs_do(struct desk *d, enum message_type type);
void desk_job_open(struct desk *d, const struct Stats *s);
void desk_jobs_begin(struct desk *d);           /* open the list, at its top */
void desk_job_show(struct desk *d, int64_t id); /* in the list, with its log */
bool desk_picked(const struct desk *d, int64_t id);
void desk_duration(double seconds, char out[96]); /* "1:24", "2 h 10" */
void desk_results(struct desk *d);
/* killed: those that have just been told to end */
void desk_jobs_settle(struct desk *d, const int64_t *killed, int n_killed); /* show what has come */
int desk_unended(const struct desk *d);

/* desk_tiles.c */
void desk_views_place(struct desk *d);
void desk_views_fit(struct desk *d, const char *view);
void desk_views_adopt(struct desk *d);
void desk_views_spread(struct desk *d, int from);
void desk_split_next(struct desk *d);
int desk_tile_at(const struct desk *d, double x, double y); /* -1: none */

/* desk_uv.c: the plane of parameters, in the tile that has it */
const struct Ful *desk_uv_surface(const struct desk *d); /* whose plane it is; NULL: none */
void desk_uv_fit(struct desk *d);
void desk_uv_pan(struct desk *d, double dx, double dy);
void desk_uv_zoom(struct desk *d, double factor, double x, double y);
bool desk_uv_at(struct desk *d, double x, double y, double uv[2]); /* false: beside the domain */
bool desk_uv_pick(struct desk *d, bool points, struct pick *out);
void desk_paint_uv(struct desk *d, cairo_t *cr, struct scraps *s, const struct box_px *pane);

/* desk_view.c */
bool desk_view_press(struct desk *d, enum desk_button b, unsigned mods);
void desk_view_move(struct desk *d, double dx, double dy);
void desk_view_release(struct desk *d);
void desk_view_scroll(struct desk *d, double dy);
bool desk_view_key(struct desk *d, enum desk_key key, unsigned mods);
bool desk_view_text(struct desk *d, uint32_t c);
void desk_drag_cancel(struct desk *d);

/* desk_probe.c */
bool desk_pick_at(struct desk *d, bool points, struct pick *out); /* under the mouse */
bool desk_pick_wanted(const struct desk *d); /* the field in focus asks for what can be picked */
void desk_pick_give(struct desk *d);
void desk_hover(struct desk *d);
void desk_probe(struct desk *d);
void desk_probe_keep(struct desk *d);
void desk_probe_hide(struct desk *d);

/* desk_tools.c, desk_points.c */
void desk_tool_begin(struct desk *d, enum tool tool);
void desk_tool_end(struct desk *d);
void desk_tool_changed(struct desk *d); /* a field of the form was typed: show it */
bool desk_tool_press(struct desk *d, const struct hit *h);
void desk_tool_move(struct desk *d);
bool desk_point_press(struct desk *d, bool weighing);
void desk_point_move(struct desk *d);
void desk_point_release(struct desk *d, bool keep);
struct color_model desk_color_model(struct desk *d);

/* desk_model.c, desk_model_pages.c, desk_over.c */
void desk_fill_menu(struct desk *d);
void desk_fill_foot(struct desk *d);
void desk_fill_top(struct desk *d);
void desk_fill_jobs(struct desk *d);
void desk_fill_search(struct desk *d);
void desk_fill_help(struct desk *d);
void desk_fill_list(struct desk *d);
void desk_paint_over(struct desk *d, cairo_t *cr);
void desk_paint_probe(struct desk *d, cairo_t *cr);
const struct overlay *desk_image(const struct desk *d); /* NULL: things are in the view */
void desk_paint_keys(struct desk *d, cairo_t *cr, struct scraps *s, double low);
bool desk_key_press(struct desk *d, const struct hit *h); /* an end of a color key */
void desk_key_move(struct desk *d);
void desk_key_calculate(struct desk *d);
void desk_key_keep(struct desk *d); /* the end was let go: it goes into the journal */

/* scraps.c */
void scraps_reset(struct scraps *s);
void scraps_finish(struct scraps *s);
/* Never NULL: "" or, for an array, NULL only for want of memory. */
const char *scraps_print(struct scraps *s, const char *format, ...)
        __attribute__((format(printf, 2, 3)));
void *scraps_array(struct scraps *s, size_t n, size_t size);

#endif
