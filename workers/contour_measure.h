/* contour_measure.h - area, centroid and girth of what a plane cuts out of a ship or a body. */
#ifndef BATTEN_CONTOUR_MEASURE_H
#define BATTEN_CONTOUR_MEASURE_H

#include "contour_sets.h"
#include "level_work.h"
#include "section.h"

struct contour_measure {
	bool known;           /* there is a figure to measure */
	double area, girth;   /* girth: length of the borders, without lines that close them */
	struct vec3 centroid; /* NaN where the area is zero */
};

/*
 * Measure all curves of one plane, the i-th of the work; what lies inside another is a hole in it, what lies in a hole
 * counts again. Of planes by direction closed curves count. Of stations, waterlines and buttocks open
 * ones do, too, closed by a straight line; stations and waterlines of a half hull with their
 * mirror images. lid: stations are measured below it; may be NULL. Errors: ST_RESOURCE.
 */
enum status contour_measure(struct contour_measure *out, const struct level_work *l, int i,
                            const struct contour_set *set, bool half,
                            const struct section_lid *lid);

#endif
