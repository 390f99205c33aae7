/* level_curves.h - what workers that trace curves on a surface leave: figures, file, drawing. */
#ifndef BATTEN_LEVEL_CURVES_H
#define BATTEN_LEVEL_CURVES_H

#include <jansson.h>

#include "colormap.h"
#include "level_work.h"

/* The results for n values on a worker's surfaces. All borrowed. */
struct level_curves {
	const struct work *work;
	const char
	        *value_name; /* attribute and figure: "angle"; NULL: the one value says nothing */
	const char *title;   /* of the drawing */
	const char *unit;    /* behind a value in the drawing, UTF-8 */
	struct colormap map; /* colors of the values */
	double tolerance;
	const double *values;
	const struct level_work *level;
	int n;
	const char *const *kinds; /* attribute `kind` for each value; NULL: none */
};

/* What one value, or all of them, came to; branches over all surfaces, joined. */
struct level_total {
	size_t branches, closed, undecided, creases;
	double length, max_error, max_error_uv, step;
};
struct level_total level_curves_total(const struct level_work *l, int i);
void level_total_add(struct level_total *to, const struct level_total *t);
/* As figures; creases and max_step where there are. */
void level_total_set(const struct work *w, const struct level_total *t, json_t *o);

/* Nothing is silently wrong: a warning where curves miss the tolerance; max_error says the same. */
void level_curves_tell(const struct work *w, double tolerance, const struct level_total *all);

/* branches, closed, length, max_error, undecided over all values, and `levels` with the same for
 * each where there are several; warns as above. New reference, NULL for want of memory. */
json_t *level_curves_figures(const struct level_curves *c);

/*
 * For work_output, data a struct level_curves: the surfaces and the curves on them in the .base
 * format, undecided boxes as pairs of corners in u, v.
 */
work_writer level_curves_write;

/* Likewise an SVG drawing from the worker's parameter `view`. */
work_writer level_curves_draw;

#endif
