/* level_wires.h - what drawings of curves show of the surfaces: whole ones, or lines of trimmed faces. */
#ifndef BATTEN_LEVEL_WIRES_H
#define BATTEN_LEVEL_WIRES_H

#include "level_work.h"

struct level_wires {
	const struct surface **surfaces; /* owned array: those without trims */
	int n_surfaces;
	struct level_lines lines; /* of the others */
};

/* After level_work_join. Errors: ST_RESOURCE. */
enum status level_wires_make(struct level_wires *out, const struct level_work *l,
                             const struct work *w);
void level_wires_finish(struct level_wires *x); /* a zeroed one is fine */

#endif
