/* example.h - the shapes that batten-examples makes, and what they are made with. */
#ifndef BATTEN_EXAMPLE_H
#define BATTEN_EXAMPLE_H

#include "model.h"

/* Each fills an empty model with named surfaces, N outward. */
typedef enum status example_make(struct model *m, const struct report *r);
example_make example_hull, example_naca, example_propeller, example_sphere, example_teapot,
        example_torus, example_wigley;

/* Add a surface (moved in, also on failure) under a name; color as 0xRRGGBB. */
enum status example_add(struct model *m, struct surface *s, const char *name, unsigned color);

/* Add s as above and its mirror image in the plane y = 0, under two names. */
enum status example_add_mirrored(struct model *m, struct surface *s, const char *name,
                                 const char *mirrored, unsigned color);

/* Mirror in the plane y = 0, u turned about so that N stays outward. In place. */
void example_mirror(struct surface *s);

/* A smooth curve y(x) through a table of points with rising x. */
struct table {
	struct curve through;
};
enum status table_init(struct table *t, const double (*xy)[2], int n, const struct report *r);
void table_finish(struct table *t);
double table_value(const struct table *t, double x); /* x inside the table's */

#endif
