/* view_place.h - a world with shapes, and pictures of it in memory, for the tests of the view. */
#ifndef BATTEN_TEST_VIEW_PLACE_H
#define BATTEN_TEST_VIEW_PLACE_H

#include "view.h"

enum { SIDE = 240 }; /* px of the pictures */

/* Run a program's tests with one GL context for all; where there is none they are skipped, with the
 * reason. The exit status of the program. */
int place_tests(int (*run)(void));

/* An empty world, and a view of it; things are moved in and their ids given back. */
struct world *place_world(void);
int place_surface(struct world *w, struct surface *s, struct trim *trim, enum surface_look look);
int place_curve(struct world *w, struct curve *c);
int place_sphere(struct world *w, double radius, enum surface_look look);
int place_torus(struct world *w, enum surface_look look);
/* A flat square from (-1, -1) to (1, 1) with a round hole of radius 0.5. */
int place_holed(struct world *w, enum surface_look look);
void place_bare(struct world *w, int id); /* without lines inside */

/* A state that looks from there at everything, SIDE x SIDE. */
struct view_state place_state(const struct world *w, const char *view);

struct view *place_view(void);

/* Draw until nothing more comes; rows from the top, 0xRRGGBB. Fails the test on any error. */
void place_draw(const struct world *w, const struct view_state *s, unsigned pixels[SIDE * SIDE]);

/* The largest difference of a channel. */
int color_apart(unsigned a, unsigned b);
unsigned color_bytes(struct rgb c);

#endif
