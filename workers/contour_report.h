/* contour_report.h - what the contours worker found, as figures, table and lines plan. */
#ifndef BATTEN_CONTOUR_REPORT_H
#define BATTEN_CONTOUR_REPORT_H

#include "contour_measure.h"
#include "contour_sets.h"
#include "level_curves.h"

/* The state of the worker. */
struct contour_state {
	struct level_work level; /* first, as level_work.h asks */
	struct contour_sets sets;
	double tolerance;
	double *values;                   /* owned, of all sets */
	const char **kinds;               /* owned array */
	struct contour_measure *measures; /* owned, one a value; filled by finish */
};

/* New reference, NULL for want of memory; warns where curves miss the tolerance. */
json_t *contour_figures(const struct work *w, const struct contour_state *s);

/* For work_output, data the struct work. */
work_writer contour_table_write, contour_plan_write;

#endif
