/* panel.h - everything in the window that is not the view: painted with Cairo from plain models.
 * A painter knows nothing of worlds, jobs or menus; it gets a model, draws it, and says where the things
 * are that can be clicked. Numbers are logical px; the caller scales the context. */
#ifndef BATTEN_PANEL_H
#define BATTEN_PANEL_H

#include <cairo.h>

#include "colormap.h"
#include "stats.h"
#include "theme.h"

/* What lies where: filled in by painters, asked by the mouse. index and part of each: */
enum hit_kind {
	HIT_NONE, /* a card or page where nothing can be clicked; it hides what lies below */
	HIT_MENU_ROW,
	HIT_FIELD,
	HIT_CHOICE, /* the field; part: which choice, of a yes or no 0 */
	HIT_BUTTON, /* which; part: enum hit_group */
	HIT_CHIP,   /* which; -1: those there is no room for */
	HIT_JOB_ROW,
	HIT_JOB_BOX, /* the box before the row; -1: that in the head, of all rows */
	HIT_TAB,
	HIT_SEARCH,
	HIT_WORLD,
	HIT_CANDIDATE,
	HIT_RESULT,
	HIT_KEY_LOW, /* the lower and the upper half of the key's bar, each with 14 px beyond its */
	HIT_KEY_HIGH,    /* end: what lies nearer to an end drags it */
	HIT_COLOR_WHEEL, /* 0: saturation to the right, value upward; 1: hue, from 0 at the top */
	HIT_COLOR_VALUE, /* 0 to 2: slider of hue, saturation, value; 3: the old color; 4 on: samples */
	HIT_LIGHT,       /* 0: the dial, its box a square about it; 1: slider of the intensity */
	HIT_BAR,
	HIT_CRUMB,
	HIT_HELP_LINK, /* 0 on: link of the page (panel_help_link); -1: help on this menu; -2: close */
	HIT_SCROLL,    /* part: enum hit_group; the box is the track */
	HIT_TIP,       /* a text that was cut; never given by hits_at */
};
enum hit_group { GROUP_FORM, GROUP_JOBS, GROUP_LIST, GROUP_EMPTY, GROUP_HELP, GROUP_KEY };
struct hit {
	enum hit_kind kind;
	int index, part; /* which row, and which part of it (a choice, an end) */
	double x, y, width, height;
	char *tip; /* owned by the hits: the whole text of a HIT_TIP */
};
struct hits {
	struct hit *hit; /* owned */
	int n, cap;
};
void hits_reset(struct hits *h);
void hits_finish(struct hits *h);
const struct hit *hits_at(const struct hits *h, double x, double y); /* the last painted; NULL */
const char *hits_tip(const struct hits *h, double x, double y); /* the whole text there, or NULL */

/* State common to all painters. */
struct look {
	enum theme theme;
	double scale; /* device px a logical px */
	enum hit_kind hover_kind;
	int hover_index, hover_part;
	enum hit_kind focus_kind; /* keyboard focus: ring */
	int focus_index, focus_part;
};

/* Where the parts are in a window of that size; a part that is not shown has width 0. */
struct box_px {
	double x, y, width, height;
};
struct layout {
	struct box_px top, view, key, panel_top, menu, form, mouse, message, prompt;
	double menu_row, form_row;
};
void layout_place(struct layout *l, double width, double height, bool panel_shown, int menu_rows);

/* Top bar: project, chips of jobs. */
struct chip {
	int64_t id;
	enum job_state state;
	const char *name; /* "curvature 21" */
	const char *note; /* "1:24", "after 21", "done in 0:41" */
	double fraction;  /* NaN: no bar */
};
struct top_model {
	const char *project, *detail; /* "goteborg.iges", "3 surfaces, metres" */
	const struct chip *chips;
	int n_chips;
};

/* Menu panel: search and World buttons, crumbs, title, rows, then the form of what is asked. */
struct menu_row {
	char key;         /* '1' .. '9', '0', 'A' .. 'D' */
	const char *name; /* "ALL CURVATURES" */
	const char
	        *state; /* right: "400 × 200", "job", why it is greyed; "shown" has a check; "" */
	bool greyed, chosen; /* chosen: what is being asked for or was done last */
	bool is_menu;
};
enum form_kind { FORM_TEXT, FORM_CHOICE, FORM_YESNO };
struct form_field {
	const char *label, *value, *unit, *error; /* error: below the field, or NULL */
	enum form_kind kind;
	const char *choices; /* "linear|arsinh" */
	const char *empty;   /* what stands, grey, where nothing does; or NULL */
	bool focused;
	int caret; /* byte in value */
};
struct menu_model {
	const char *crumbs; /* "MAIN › INTERROGATION › SURFACE" */
	const char *title, *code;
	const struct menu_row *rows;
	int n_rows;
	const char *form_title, *form_code; /* NULL: nothing is asked */
	const struct form_field *fields;
	int n_fields, scroll;
	const char *main_button; /* "Show", "Start"; HIT_BUTTON 0 */
	bool world_open;
	const char *other_button, *other_key; /* "Put back", "Esc"; HIT_BUTTON 1; NULL: none */
};

/* Mouse words; "" where a button does nothing now. At most 24 characters. */
struct Mouse_Words {
	const char *press[3], *release[3]; /* left, middle, right */
};

/* Foot: message and prompt. */
struct foot_model {
	enum report_level level;
	bool done; /* a check before the message */
	const char *message, *message_hint;
	const char *prompt, *typed, *rest, *range; /* rest: grey completion; range at the right */
	int caret;
	bool caret_on;
	struct {
		const char *key, *word; /* NULL: none */
	} hints[4];
	const char *const *candidates, *const *candidate_notes; /* at most 8, best first */
	int n_candidates, candidate;
};

/* Cards and pages over the view. */
struct probe_model {
	const char *title;
	bool has_uv;
	double u, v, point[3], normal[3], K, H, kmax, kmin;
	const char *unit; /* of length, "m" or NULL */
	bool kept;
};
struct key_model { /* color key of a map at the view's right edge */
	struct colormap map;
	const char *title, *note, *symbol, *unit;
	double below, above;
	bool nothing;
	const char *button; /* where there are no values: HIT_BUTTON 0 of GROUP_KEY; NULL: none */
};
struct jobs_model {
	const struct Stats *const *jobs;
	const bool *picked;
	int n, focus, tab, scroll; /* tab: all, active, waiting, ended */
	int count[4];
	const char *slots; /* "3 of 4 job slots in use" */
	const char *log_title, *const *log;
	int n_log;
	double now;  /* seconds since 1970 */
	bool can[5]; /* suspend, activate, kill, retry, open: HIT_BUTTON of GROUP_JOBS */
};
struct search_model {
	const char *typed;
	int caret;
	struct search_result {
		const char *name, *path, *kind, *code;
		bool greyed;
	} results[8]; /* where none was found: the nearest, or what was used last */
	int n, found, all, chosen;
};
/*
 * A text of help: paragraphs with an empty line between. A line of one of the words purpose,
 * arguments, result, example, see also (with or without capital and colon) begins that section; so does
 * any other line that stands alone and ends with a colon. In arguments a line is a row of a table: name,
 * value and meaning with a bar, two blanks or a tab between, indented lines go on with the meaning. Lines
 * of an example are kept as they are. See also: codes, each followed by its name or not.
 */
struct help_model {
	const char *code, *title, *kind, *path; /* path: "CURVATURE › GAUSSIAN" */
	const char *text;
	double scroll; /* px; at most panel_help_scroll() has a meaning */
};
struct keys_model { /* the sheet of all keys; scroll: the first row shown */
	const struct key_row {
		const char *key, *does;
		bool off;
	} * rows;
	int n, scroll;
};
struct color_model {
	double hue, saturation, value; /* 0 to 360; 0 to 1 */
	struct rgb old;
	const char *what; /* "Color of hull" */
};
struct light_model { /* degrees from the x axis, degrees from the vertical, 0 to 1 */
	double azimuth, incidence, intensity;
};
struct bar_model {
	enum report_level level;
	const char *text, *button;
}; /* under the top bar, until solved */
struct empty_model {
	const char *const *recent;
	int n;
};
/* The plane of a surface's parameters: u to the right, v upward, both ranges as long as the square. */
enum uv_line_kind { UV_LINE_CURVE, UV_LINE_CURRENT, UV_LINE_TRIM, UV_LINE_NET };
struct uv_line {
	enum uv_line_kind kind;
	const double *uv; /* n pairs */
	int n;
};
struct uv_model {
	double range[2][2];  /* of u and v that is seen; empty: there is no surface */
	double domain[2][2]; /* of the surface */
	const double *knots[2];
	int n_knots[2];
	const struct uv_line *lines;
	const double *points, *marks; /* control points, and places kept: pairs */
	int n_lines, n_points, n_marks;
	int hover; /* control point under the mouse, -1: none */
	bool has_probe;
	double probe[2];
};
struct list_model { /* plain lists: messages, questions before loss of work */
	const char *title, *const *lines;
	int n, scroll; /* scroll: the first line shown */
	const char *const *buttons;
	int n_buttons;
};

/* Painters: in the box given, hits appended in the same px. */
void panel_top(cairo_t *cr, const struct box_px *b, const struct top_model *m, const struct look *k,
               struct hits *h);
void panel_menu(cairo_t *cr, const struct layout *l, const struct menu_model *m,
                const struct look *k, struct hits *h);
void panel_mouse(cairo_t *cr, const struct box_px *b, const struct Mouse_Words *m,
                 const struct look *k);
void panel_foot(cairo_t *cr, const struct layout *l, const struct foot_model *m,
                const struct look *k, struct hits *h);
void panel_heading(cairo_t *cr, const struct box_px *view, const char *title, const char *note,
                   bool strong, const struct look *k);
/* In place of a view; its heading is painted as that of a view. */
void panel_uv(cairo_t *cr, const struct box_px *pane, const struct uv_model *m,
              const struct look *k);
struct box_px panel_uv_square(const struct box_px *pane); /* where the range lies */
/* Beside (x, y), within the view. */
void panel_probe(cairo_t *cr, const struct box_px *view, double x, double y,
                 const struct probe_model *m, const struct look *k);
/* A map without values (lo not below hi) says so. */
void panel_key(cairo_t *cr, const struct box_px *view, const struct key_model *m,
               const struct look *k, struct hits *h);

/* Over the whole view. */
void panel_jobs(cairo_t *cr, const struct box_px *b, const struct jobs_model *m,
                const struct look *k, struct hits *h);
int panel_jobs_rows(const struct box_px *b); /* that have room: for scrolling */
/* What is known of one job, in the panel's form part. */
void panel_job(cairo_t *cr, const struct layout *l, const struct Stats *job, const struct look *k);

/* Over the whole window, which is dimmed. */
void panel_search(cairo_t *cr, double width, double height, const struct search_model *m,
                  const struct look *k, struct hits *h);

/* Over the menu and the view's edge. */
void panel_help(cairo_t *cr, const struct layout *l, const struct help_model *m,
                const struct look *k, struct hits *h);
double panel_help_scroll(cairo_t *cr, const struct layout *l, const struct help_model *m);
/* "V81" of link `index` of a text; false: there is none. */
bool panel_help_link(const char *text, int index, char *code, size_t size);

void panel_keys(cairo_t *cr, const struct box_px *b, const struct keys_model *m,
                const struct look *k);
int panel_keys_rows(const struct box_px *b, const struct keys_model *m); /* that have room */

/* Cards. Their boxes beside each other in a layout: below each other where they fit. */
void panel_cards_place(const struct layout *l, struct box_px *color, struct box_px *light);
void panel_color(cairo_t *cr, const struct box_px *b, const struct color_model *m,
                 const struct look *k, struct hits *h);
struct rgb panel_color_rgb(const struct color_model *m);
struct rgb panel_color_sample(int index); /* HIT_COLOR_VALUE 4 + index */
void panel_light(cairo_t *cr, const struct box_px *b, const struct light_model *m,
                 const struct look *k, struct hits *h);

/* Beside (x, y) within the window: the whole of a text that was cut. */
void panel_tip(cairo_t *cr, double width, double height, double x, double y, const char *text,
               const struct look *k);

/* At the top of the box: the view, of which the rest is left to others. */
double panel_bar_height(cairo_t *cr, const struct box_px *b, const struct bar_model *m);
void panel_bar(cairo_t *cr, const struct box_px *b, const struct bar_model *m, const struct look *k,
               struct hits *h);
/* HIT_BUTTON of GROUP_EMPTY: 0 open a file, then the recent ones, then start from a patch. */
void panel_empty(cairo_t *cr, const struct box_px *b, const struct empty_model *m,
                 const struct look *k, struct hits *h);
/* A card in the box's middle; with buttons (the safe one last) the box is dimmed. */
void panel_list(cairo_t *cr, const struct box_px *b, const struct list_model *m,
                const struct look *k, struct hits *h);
int panel_list_rows(const struct box_px *b, const struct list_model *m); /* lines that have room */

#endif
