/* bodies.h - what tests of the real workers share: surfaces written as files to work on, results
 * looked at, refusals. */
#ifndef BATTEN_TEST_BODIES_H
#define BATTEN_TEST_BODIES_H

#include "drive.h"

#include <jansson.h>

#include "exr.h"
#include "model.h"

struct surface body_sphere(struct vec3 center, double radius);
struct surface body_torus(struct vec3 center, double major, double minor);
/* The square of half width r at height z; u and v are 0 to 1. */
struct surface body_square(double r, double z);
/* Bilinear over four corners; all the same: a surface that is a point. */
struct surface body_corners(struct vec3 a, struct vec3 b, struct vec3 c, struct vec3 d);

/* A .base file of these surfaces, which are taken over; unit "mm", or NULL: none said. */
void bodies_write(const char *path, const char *unit, struct surface *s, int n);
void body_write(const char *path, const char *unit, struct surface s);

/* Teardown of a test group whose state is a struct place. */
int bodies_leave(void **state);

/* Run a worker with arguments ended by NULL; fails the test where it does. */
void run_well(const char *worker, ...);

void near(double a, double b, double tolerance);

/* The figures a model was written with; the caller's. One that an image was. */
json_t *figures_of(const struct model *m);
double figure_of(const struct exr_picture *p, const char *name);

struct refusal {
	const char *input, *arguments[6];
	int exit_status;
	const char *says; /* on standard error */
};
/* Each is refused with its sentence, and the file `output` is not made; "-o wrong" is given. */
void expect_refusals(const char *worker, const struct refusal *list, size_t n, const char *output);

#endif
