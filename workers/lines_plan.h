/* lines_plan.h - a ship's lines as a naval architect draws them: body plan, profile, half-breadth.
 *
 * The body plan has the sections forward of amidships on the right, the others on the left; the bow
 * points to the right in profile and half-breadth. In each view the planes of the other two sets
 * are straight lines.
 */
#ifndef BATTEN_LINES_PLAN_H
#define BATTEN_LINES_PLAN_H

#include "contour_sets.h"

struct plan_curve {
	const struct curve *curve; /* borrowed, in space */
	enum contour_kind of;      /* stations, waterlines or buttocks */
	int place;                 /* which of the set's values */
};

struct lines_plan {
	const struct surface **surfaces; /* their borders are drawn */
	int n_surfaces;
	const struct curve *borders; /* those of trimmed faces */
	size_t n_borders;
	const struct contour_sets *sets;
	const struct plan_curve *curves; /* by rising value within a set */
	size_t n_curves;
	double forward; /* 1: the bow is at +x; -1: at -x */
	bool has_draught;
	double draught;
	const char *unit; /* or NULL */
};

/* As SVG. Errors: as of picture_lines. */
enum status lines_plan_write(const struct lines_plan *p, const char *path, const struct report *r);

#endif
