/* picture.h - pictures with Cairo and Pango: PNG of images and maps with their key, SVG of curves. */
#ifndef BATTEN_PICTURE_H
#define BATTEN_PICTURE_H

#include <stddef.h>

#include "camera.h"
#include "colormap.h"
#include "curve.h"
#include "report.h"
#include "surface.h"

/* Tokens of the two themes are in picture.c; both are chosen for contrast, see docs/formats.md. */
enum theme { THEME_LIGHT, THEME_DARK };

/* Linear R G B A planes (premultiplied or not as in EXR: premultiplied), width x height. */
enum status picture_image(const char *path, int width, int height, const float *const rgba[4],
                          enum theme theme, const struct report *r);

/*
 * A map: values (NaN: nothing there) colored, with a key: title, unit, ticks at round numbers,
 * range and scale in words. aspect: height over width of the map area (0: as the grid is).
 * `u0 u1 v0 v1` label the axes; NULL axes: a view, no axes. shade (may be NULL): darkening
 * 0 .. 1 multiplied in, for form.
 */
struct picture_map {
	int width, height; /* of the values */
	const float *values;
	const float *shade;
	const char *title, *unit; /* "Gaussian curvature", "1/m²" */
	const double *axes;       /* u0 u1 v0 v1 or NULL */
	struct colormap map;
};
enum status picture_map(const char *path, const struct picture_map *m, enum theme theme,
                        const struct report *r);

/* Lines in an SVG or PNG (by the path's extension), seen from a camera. */
struct picture_curve {
	const struct curve *curve; /* borrowed, in space */
	struct rgb color;
	double width;      /* px */
	const char *label; /* or NULL */
};
enum status picture_lines(const char *path, const struct camera *camera,
                          const struct surface *const *surfaces, int n_surfaces,
                          const struct picture_curve *curves, size_t n_curves, const char *title,
                          enum theme theme, const struct report *r);

#endif
