/* label.h - text on a Cairo surface, in the program's type. Lines are single lines whatever the text
 * holds; what is no UTF-8 is shown as such, never refused.
 * Layouts are kept with the surface: one that is drawn on again needs little time. */
#ifndef BATTEN_LABEL_H
#define BATTEN_LABEL_H

#include <cairo.h>

#include "theme.h"

/* style, px, CSS weight, are its figures as wide as each other (1) */
#define LABEL_MAP(X)                                                                               \
	X(HEADING, 13, 600, 1)                                                                     \
	X(STRONG, 11, 600, 1)                                                                      \
	X(NOTE, 11, 400, 1)                                                                        \
	X(TITLE, 18, 600, 0) /* of a menu, a list */                                               \
	X(PAGE, 20, 600, 0)  /* title of a page of help */                                         \
	X(ENTRY, 13, 400, 0) /* of a menu; text of help */                                         \
	X(PROMPT, 13, 500, 0)                                                                      \
	X(FORM, 12, 400, 1)                                                                        \
	X(NAME, 12, 500, 1) /* buttons, chips, heads of columns */                                 \
	X(SECTION, 12, 600, 0)                                                                     \
	X(CAP, 11, 500, 0)   /* key caps, mouse words */                                           \
	X(TYPED, 18, 400, 0) /* what is typed into the search */                                   \
	X(RING, 10, 400, 0)  /* rings of a dial */                                                 \
	X(MONO, 11, 400, 0)  /* code, logs */

#define X(name, size, weight, tabular) LABEL_##name,
enum label_style { LABEL_MAP(X) N_LABEL_STYLES };
#undef X

/* Families to try, in CSS form. */
extern const char label_families[];
double label_size(enum label_style style); /* px */
int label_weight(enum label_style style);  /* CSS weight */

/* Draw with the baseline at y; align 0: begins at x, 0.5: centred, 1: ends there. */
void label_draw(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                double align, const char *text);

double label_width(cairo_t *cr, enum label_style style, const char *text);

/* What gives way to an ellipsis where a text is wider than its room. */
enum label_cut { LABEL_CUT_END, LABEL_CUT_MIDDLE };

/* The same in `room` px; gives the width drawn. Nothing is drawn in less than the ellipsis needs. */
double label_fit(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                 double align, double room, enum label_cut cut, const char *text);

/* Lines broken at words within `width`, 1.25 of the type's own apart, the first one's top at y; gives
 * their height. max_lines 0: as many as it takes; the last one allowed ends with an ellipsis. */
double label_wrap(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                  double width, int max_lines, const char *text);
double label_wrap_height(cairo_t *cr, enum label_style style, double width, int max_lines,
                         const char *text);

/* px from the text's beginning to before its byte `at`; of a place within a character: before it. */
double label_caret(cairo_t *cr, enum label_style style, const char *text, int at);

/* How many texts drawn on this surface so far had less room than they needed. */
int label_cuts(cairo_t *cr);

/* Baseline of a text whose capitals are centred about `middle`. */
double label_baseline(enum label_style style, double middle);

#endif
