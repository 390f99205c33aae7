/* paint.h - what all painters of the window share: boxes, rules, texts, key caps, buttons, fields. */
#ifndef BATTEN_PAINT_H
#define BATTEN_PAINT_H

#include "label.h"
#include "panel.h"

enum {
	PAINT_PADDING = 16,
	PAINT_TOP = 48,
	PAINT_FOOT = 60,
	PAINT_MESSAGE = 24,
	PAINT_MOUSE = 148,
	PAINT_MOUSE_LOW = 72, /* without the icon */
	PAINT_MENU_HEAD = 64,
	PAINT_BUTTON = 28,
};

struct paint {
	cairo_t *cr; /* borrowed, as all */
	const struct look *look;
	struct hits *hits; /* NULL: nothing can be clicked */
};

/* Colors. */
struct rgb paint_color(const struct paint *p, enum token token);
void paint_set(const struct paint *p, enum token token, double alpha);
void paint_set_rgb(const struct paint *p, struct rgb c);
bool paint_is_dark(const struct paint *p);

/* Lengths of whole device pixels, one at least; the device pixel's edge nearest to a place. */
double paint_px(const struct paint *p, double length);
double paint_snap(const struct paint *p, double place);

/* Boxes have their edges on device pixels. radius 0: square. */
void paint_round(const struct paint *p, double x, double y, double width, double height,
                 double radius); /* the path alone */
void paint_fill(const struct paint *p, double x, double y, double width, double height,
                double radius, enum token token);
void paint_border(const struct paint *p, double x, double y, double width, double height,
                  double radius, double line, enum token token); /* inside of the box */
void paint_raised(const struct paint *p, double x, double y, double width, double height,
                  double radius); /* with a border where the ground would hide it */
void paint_card(const struct paint *p, double x, double y, double width, double height,
                double radius); /* with shadow and border */
void paint_rule(const struct paint *p, double x, double y, double width);
void paint_rule_down(const struct paint *p, double x, double y, double height);
void paint_dot(const struct paint *p, double x, double y, double radius, enum token token);
void paint_circle(const struct paint *p, double x, double y, double radius, double line,
                  enum token token);
void paint_line(const struct paint *p, double x0, double y0, double x1, double y1, double line,
                enum token token);
void paint_chevron(const struct paint *p, double x, double y, enum token token);
void paint_check(const struct paint *p, double x, double y, double size, enum token token);
void paint_lens(const struct paint *p, double x, double y, double size);
void paint_bar(const struct paint *p, double x, double y, double width, double fraction,
               struct rgb color); /* of progress, 4 high; fraction NaN: empty */
void paint_scroll(const struct paint *p, double x, double y, double height, int first, int shown,
                  int all, int part); /* a thumb at the right edge x, and its hit */

/* Texts about the middle of their capitals; widths drawn. */
double paint_text(const struct paint *p, enum label_style style, enum token token, double x,
                  double middle, double align, const char *text);
double paint_cut(const struct paint *p, enum label_style style, enum token token, double x,
                 double middle, double align, double room, const char *text);
double paint_path(const struct paint *p, enum label_style style, enum token token, double x,
                  double middle, double room, const char *text); /* cut in the middle */
double paint_width(const struct paint *p, enum label_style style, const char *text);

/* A key as a cap; ends at x where align is 1. */
double paint_cap(const struct paint *p, double x, double middle, double align, const char *key);
double paint_cap_width(const struct paint *p, const char *key);
/* "Tab complete": cap and word; and its width. */
double paint_hint(const struct paint *p, double x, double middle, const char *key,
                  const char *word);
double paint_hint_width(const struct paint *p, const char *key, const char *word);

struct button {
	const char *text, *key;  /* key may be NULL */
	bool main, off, on_card; /* on_card: on raised ground */
	enum hit_kind kind;
	int index, part;
};
double paint_button_width(const struct paint *p, const struct button *b);
double paint_button(const struct paint *p, double x, double y, const struct button *b);
void paint_toggle(const struct paint *p, double x, double middle, bool on);

void paint_slider(const struct paint *p, double x, double middle, double width, double at,
                  bool hot); /* at 0 .. 1 */

/* Ground of the view over what it shows, for letters; black over all that is out of reach now. */
void paint_plate(const struct paint *p, double x, double y, double width, double height);
void paint_dim(const struct paint *p, double x, double y, double width, double height);

/* What is under the mouse or has the focus of the keyboard, and where things are. */
bool paint_hot(const struct paint *p, enum hit_kind kind, int index, int part);
bool paint_focused(const struct paint *p, enum hit_kind kind, int index, int part);
void paint_ring(const struct paint *p, double x, double y, double width, double height,
                double radius);
void paint_hit(const struct paint *p, enum hit_kind kind, int index, int part, double x, double y,
               double width, double height);
void paint_tip(const struct paint *p, double x, double y, double width, double height,
               const char *text); /* copied */

/* States of jobs. */
struct rgb glyph_color(const struct paint *p, enum job_state state);
void glyph_draw(const struct paint *p, enum job_state state, double x, double y, double radius);
void glyph_warning(const struct paint *p, double x, double y, double radius);

/* A line being typed: scrolled so that the place of the caret (a byte) is seen. Gives the x after it. */
double paint_typed(const struct paint *p, enum label_style style, double x, double middle,
                   double room, const char *text, int caret, bool caret_on);

/* The text between the separators " › " as it is shown, cut at its beginning where too long. */
void paint_crumbs(const struct paint *p, double x, double middle, double room, const char *crumbs);

/* The form below the menu, in l->form. */
void paint_form(const struct paint *p, const struct layout *l, const struct menu_model *m);

/* Height of the bar of a color key in a view that high. */
double panel_key_bar(double view_height);

/* The part of `text` that is `found` (without regard to case) stands out. */
double paint_found(const struct paint *p, enum label_style style, enum token token, double x,
                   double middle, double room, const char *text, const char *found);

#endif
