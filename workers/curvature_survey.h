/* curvature_survey.h - one quantity over the whole grid with the areas it stands for, as a picture. */
#ifndef BATTEN_CURVATURE_SURVEY_H
#define BATTEN_CURVATURE_SURVEY_H

#include "colormap.h"
#include "exr.h"
#include "grid.h"
#include "trim.h"
#include "worker.h"

/* The lines of a map; all borrowed. */
struct curvature_grid {
	const struct grid *grid;
	const struct trim_test *trim; /* NULL: all of the surface counts */
	const double *u, *v;          /* nu, nv */
	int nu, nv;
};

struct curvature_survey {
	struct work *w; /* borrowed */
	int nu, nv;
	enum quantity shown;
	float *values, *areas; /* owned; rows from the top, v upward */
	float *shade;          /* owned; NaN where it is trimmed away, else 1; NULL: no trim */
	struct colormap map;   /* fitted to the values by their areas */
};

/* Errors: ST_RESOURCE, ST_CANCELLED. */
enum status curvature_survey_init(struct curvature_survey *s, struct work *w,
                                  const struct curvature_grid *lines, enum quantity shown,
                                  enum colormap_scale scale);
void curvature_survey_finish(struct curvature_survey *s);

/* A work_writer: the survey as a PNG with axes and key. */
enum status curvature_survey_write(void *survey, const char *path, const struct report *r);

/* What the pictures say; caller frees: the unit, "1/m²"; the quantity; the surface. */
char *curvature_unit(const struct work *w, enum quantity q);
char *curvature_title(enum quantity q);
char *curvature_name(const struct work *w);

#endif
