/* open.h - a project folder with geometry in it, and a world on it. */
#ifndef BATTEN_TESTS_WORLD_OPEN_H
#define BATTEN_TESTS_WORLD_OPEN_H

#include "world.h"

struct place {
	char *folder; /* owned */
	struct report_store said;
	struct world *world;
};

void place_init(struct place *p);
void place_finish(struct place *p); /* takes the folder away */
/* Of cmocka: *state is a place; gone again. */
int place_new(void **state);
int place_gone(void **state);
char *place_path(const struct place *p, const char *name); /* fresh */

/* Write `n` spheres of radius 1, 2, ... as a file of n surfaces. */
void place_spheres(const struct place *p, const char *name, int n);
void place_sphere(struct entity *out, double radius);
void place_line(struct entity *out, double length); /* along x */
/* A curve on surface, the parameters' diagonal, with its surface, as one file. */
void place_diagonal(const struct place *p, const char *name);

#endif
