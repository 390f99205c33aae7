/* level_wires.c - surfaces for drawings, trimmed ones as the lines that are left of them. */
#include "level_wires.h"

#include <stdlib.h>

/* Isoparametric lines each way; how near they are, as a part of the size. */
enum { WIRES = 5 };
static const double near_share = 2e-4;

void level_wires_finish(struct level_wires *x)
{
	free(x->surfaces);
	level_lines_finish(&x->lines);
	*x = (struct level_wires){ .n_surfaces = 0 };
}

enum status level_wires_make(struct level_wires *out, const struct level_work *l,
                             const struct work *w)
{
	enum status st = ST_OK;
	*out = (struct level_wires){ .n_surfaces = 0 };
	out->surfaces = calloc((size_t)w->n_surfaces, sizeof *out->surfaces);
	if (!out->surfaces)
		return ST_RESOURCE;
	for (int i = 0; st == ST_OK && i < w->n_surfaces; i++) {
		if (l->trimmed && w->entities[i]->trim.n > 0)
			st = level_face_lines(l->faces, i, WIRES, near_share * level_work_size(w),
			                      &out->lines);
		else
			out->surfaces[out->n_surfaces++] = w->surfaces[i];
	}
	if (st != ST_OK)
		level_wires_finish(out);
	return st;
}
