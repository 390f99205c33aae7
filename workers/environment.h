/* environment.h - what stands around the surfaces, far away: light stripes, a sky, or nothing. */
#ifndef BATTEN_ENVIRONMENT_H
#define BATTEN_ENVIRONMENT_H

#include "look.h"

enum environment_kind { ENVIRONMENT_STRIPES, ENVIRONMENT_SKY, ENVIRONMENT_NONE };

struct environment {
	enum environment_kind kind;
	struct vec3 axis, across,
	        up;              /* unit: stripes run along axis; across and up span the rest */
	struct vec3 sun, zenith; /* unit */
	double pairs;            /* of a bright and a dark stripe, all around */
};

/* Rows for `params`. */
/* clang-format off */
#define ENVIRONMENT_ROWS                                                                           \
	{ .name = "environment", .type = PARAM_CHOICE, .def = "stripes",                           \
	  .choices = "stripes sky none",                                                           \
	  .help = "what is mirrored: bright and dark stripes as of light tubes, far away, by "     \
		  "which fairness is judged; a sky; or nothing" },                                 \
	{ .name = "stripe-width", .type = PARAM_REAL, .def = "8", .min = 0.1, .max = 90,           \
	  .unit = "deg",                                                                           \
	  .help = "angle that one stripe takes, rounded so that whole pairs go round" },           \
	{ .name = "stripe-direction", .type = PARAM_VECTOR, .def = "1,0,0",                        \
	  .help = "along which the stripes run" }
/* clang-format on */

/* Errors: ST_PARAMETER (stripes without direction). */
enum status environment_init(struct environment *e, const struct work *w, const struct look *look);

/* Light that comes from direction d (unit). */
struct tint environment_color(const struct environment *e, struct vec3 d);

#endif
