/* look.h - light and color of surfaces, for the workers that shade and trace. All colors linear. */
#ifndef BATTEN_LOOK_H
#define BATTEN_LOOK_H

#include "image.h"

struct tint {
	float r, g, b; /* linear */
};

struct look {
	struct vec3 light; /* unit, towards the light */
	struct vec3 sky;   /* unit: where the ambient light is brightest */
	double intensity, ambient, diffuse, specular, shininess;
	struct tint *colors; /* owned; one a surface */
};

/* Rows for `params`. */
/* clang-format off */
#define LOOK_ROWS                                                                                  \
	{ .name = "light", .type = PARAM_VECTOR,                                                   \
	  .help = "from the surface towards a parallel light, any length; without it and without " \
		  "the angles the light stands above the viewer's left shoulder" },                \
	{ .name = "azimuth", .type = PARAM_REAL, .min = -360, .max = 360, .unit = "deg",           \
	  .help = "where the light stands, from +x towards +y" },                                  \
	{ .name = "incidence", .type = PARAM_REAL, .min = 0, .max = 180, .unit = "deg",            \
	  .help = "angle of the light from +z; 45 where only the azimuth is given" },              \
	{ .name = "intensity", .type = PARAM_REAL, .def = "1", .min = 0, .max = 100,               \
	  .help = "strength of the light" },                                                       \
	{ .name = "ambient", .type = PARAM_REAL, .def = "0.3", .min = 0, .max = 10,                \
	  .help = "light from all sides, brighter from above" },                                   \
	{ .name = "diffuse", .type = PARAM_REAL, .def = "0.75", .min = 0, .max = 10,               \
	  .help = "part of the light that the surface scatters" },                                 \
	{ .name = "specular", .type = PARAM_REAL, .def = "0.12", .min = 0, .max = 10,              \
	  .help = "strength of the highlight" },                                                   \
	{ .name = "shininess", .type = PARAM_REAL, .def = "40", .min = 1, .max = 10000,            \
	  .help = "how small the highlight is" },                                                  \
	{ .name = "color", .type = PARAM_COLOR, .def = "#C3CCD4",                                  \
	  .help = "color of surfaces to which the file gives none, or black" }
/* clang-format on */

/* Read the parameters. Errors: ST_PARAMETER (light given twice, without direction), ST_RESOURCE. */
enum status look_init(struct look *l, struct work *w, const struct camera *camera);
void look_finish(struct look *l);

/* A sRGB component 0 .. 1 as light. */
float look_linear(double srgb);

/* Ambient and direct light, and highlight, of a point of `base` color. n: unit normal on the
 * viewer's side; to_eye: unit. lit: does the light reach it. */
struct tint look_shade(const struct look *l, struct tint base, struct vec3 n, struct vec3 to_eye,
                       bool lit);

/* The normal's side that is seen along direction d. */
static inline struct vec3 look_side(struct vec3 n, struct vec3 d)
{
	return vec3_dot(n, d) > 0 ? vec3_scale(n, -1) : n;
}

#endif
