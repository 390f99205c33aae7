/* box.h - axis-parallel boxes. */
#ifndef BATTEN_BOX_H
#define BATTEN_BOX_H

#include "curve.h"
#include "surface.h"

struct box {
	struct vec3 lo, hi; /* empty: lo > hi */
};

struct box box_empty(void);
bool box_is_empty(const struct box *b);
void box_add_point(struct box *b, struct vec3 p);
void box_add_box(struct box *b, const struct box *other);
struct vec3 box_center(const struct box *b); /* not of an empty one: it has none */
double box_diagonal(const struct box *b);    /* length; 0 of an empty one */

/* Box of the part inside the domain, larger than the true one by at most tolerance a side
 * (absolute; 0: as tight as rounding allows within 1e-12 of the size, 1e-9 where the extreme is held
 * along a line askew to the parameters). Errors: ST_RESOURCE. */
enum status curve_box(const struct curve *c, double tolerance, struct box *out);
enum status surface_box(const struct surface *s, double tolerance, struct box *out);

#endif
