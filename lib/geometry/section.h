/* section.h - area, centroid and girth of plane figures bounded by curves.
 *
 * A border is a chain of curves, each going on where the one before ends. What gap is left between
 * two of them, and between the last end and the first start, is closed by a straight line.
 */
#ifndef BATTEN_SECTION_H
#define BATTEN_SECTION_H

#include "curve.h"

/* One curve of a border. */
struct section_side {
	const struct curve *curve; /* borrowed */
	bool reversed;             /* run through from its end to its start */
};

/* What lies higher is cut off: a station measured below the waterline. */
struct section_lid {
	struct vec3 up; /* unit */
	double height;  /* along it, from the origin */
};

struct section {
	double area;          /* positive where the border runs counterclockwise about the normal */
	struct vec3 centroid; /* of that area; NaN where it is zero */
	struct vec3 moment;   /* area times centroid, but without the division */
	double girth;         /* length of the curves, without what is cut off */
	double closing;       /* length of the straight lines that close the border, likewise */
};

/*
 * Measure the figure. normal: of its plane, unit length; curves that leave the plane are projected
 * on it for area and centroid. lid may be NULL.
 * Accuracy: relative to girth (girth^2 for the area): quadrature is halved until it holds, and
 * exact from the start for polynomial curves to order 7. Units: the curves'.
 * Errors: ST_RESOURCE.
 */
enum status section_measure(const struct section_side *sides, int n, struct vec3 normal,
                            const struct section_lid *lid, double accuracy, struct section *out);

/*
 * How often the border runs round p, counterclockwise about normal: 0 outside. Exact where p is
 * farther from the border than rounding. Errors: ST_RESOURCE.
 */
enum status section_winding(const struct section_side *sides, int n, struct vec3 normal,
                            struct vec3 p, int *out);

/*
 * Parameters at which a curve passes through the plane P . normal = value from one side to the
 * other, rising. *t is the caller's to free; NULL where there are none. Errors: ST_RESOURCE.
 */
enum status curve_crossings(const struct curve *c, struct vec3 normal, double value, double **t,
                            int *n);

#endif
