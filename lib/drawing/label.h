/* label.h - a line of text on a Cairo surface, in the program's type. */
#ifndef BATTEN_LABEL_H
#define BATTEN_LABEL_H

#include <cairo.h>

#include "theme.h"

enum label_style {
	LABEL_HEADING, /* 13, semi-bold */
	LABEL_STRONG,  /* 11, semi-bold */
	LABEL_NOTE,    /* 11 */
	N_LABEL_STYLES
};

/* Families to try, in CSS form. */
extern const char label_families[];
double label_size(enum label_style style); /* px */
int label_weight(enum label_style style);  /* CSS weight */

/* Draw with the baseline at y; align 0: begins at x, 0.5: centred, 1: ends there. */
void label_draw(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                double align, const char *text);

double label_width(cairo_t *cr, enum label_style style, const char *text);

/* Baseline of a text whose capitals are centred about `middle`. */
double label_baseline(enum label_style style, double middle);

#endif
