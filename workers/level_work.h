/* level_work.h - the units of workers that trace curves on surfaces: groups of patches at a value. */
#ifndef BATTEN_LEVEL_WORK_H
#define BATTEN_LEVEL_WORK_H

#include "level_faces.h"
#include "level_look.h"
#include "worker.h"

/* Every field on every surface of a worker. */
struct level_work {
	int n, n_surfaces;          /* fields */
	struct level **levels;      /* owned, n x n_surfaces, field by field; some borrow from
	                                 others before them */
	size_t *first;              /* owned: first unit of each surface within a field's */
	struct level_head *heads;   /* owned, n: what the units of each field begin with */
	struct level_field *fields; /* owned, n */
	double tolerance, gap;
	bool trimmed;                 /* trims cut the curves */
	struct level_faces *faces;    /* owned */
	struct level_result *results; /* owned, n x n_surfaces; filled by level_work_join */
	struct level_chains *chains;  /* owned, n; likewise */
};

/* names: of each field its value as the user has it, told to who looks on. The tolerance in u,v is that of
 * the parameters. Errors: those of level_create. */
enum status level_work_init(struct level_work *l, const struct work *w,
                            const struct level_field *fields, const double *names, int n,
                            double tolerance);
void level_work_finish(struct level_work *l); /* a zeroed one is fine */

/*
 * What `units` and `unit` of struct worker are where w->state begins with a struct level_work.
 * Thread: any. Errors: ST_CANCELLED, ST_RESOURCE.
 */
size_t level_work_units(const struct work *w);
enum status level_work_unit(struct work *w, size_t unit);

/* All units are there: fill the results, join them over the surfaces' borders. */
enum status level_work_join(struct level_work *l, struct work *w);

static inline const struct level_result *level_work_result(const struct level_work *l, int field,
                                                           int surface)
{
	return &l->results[(size_t)field * l->n_surfaces + surface];
}

/* Size of the largest surface; 0: all are single points. */
double level_work_size(const struct work *w);

/* 1e-5 of the size of the largest surface, or what the parameter `tolerance` says. */
double level_work_tolerance(const struct work *w);

/* clang-format off */
#define PARAM_ROWS_LEVEL_TOLERANCE                                                                 \
	{ .name = "tolerance", .type = PARAM_REAL, .min = 0, .max = INFINITY, .unit = "file",      \
	  .help = "largest distance from the exact curve (1e-5 of the surface's size where "       \
		  "not given)" },                                                                  \
	{ .name = "tolerance-uv", .type = PARAM_REAL, .def = "0", .min = 0, .max = INFINITY,       \
	  .help = "largest distance from the exact curve in the surface's parameters, too (0: "    \
		  "not asked for)" }
#define PARAM_ROW_TRIMMED                                                                          \
	{ .name = "trimmed", .type = PARAM_FLAG, .def = "yes",                                     \
	  .help = "leave out what the trims of the surfaces cut away" }
#define PARAM_ROW_GAP                                                                              \
	{ .name = "gap", .type = PARAM_REAL, .min = 0, .max = INFINITY, .unit = "file",            \
	  .help = "neighbouring surfaces share a border where theirs are no farther apart, and "   \
		  "curves go on over it (1e-5 of the size, four times the tolerance at least, "    \
		  "where not given)" }
#define PARAM_ROW_CREASE                                                                           \
	{ .name = "crease", .type = PARAM_REAL, .def = "0.06", .min = 0, .max = 45, .unit = "deg", \
	  .help = "curves end on a border between surfaces whose normals differ by more" }
/* clang-format on */

#endif
