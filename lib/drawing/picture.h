/* picture.h - pictures with Cairo and Pango: PNG of images and maps with their key, SVG and PDF of curves.
 *
 * Same input, same bytes. Files are written under the path given, whatever its ending: give a
 * temporary name. On failure nothing is left there.
 * Errors of all: ST_INPUT (folder missing, not writable), ST_RESOURCE (full disk, no memory, larger
 * than a picture can be).
 */
#ifndef BATTEN_PICTURE_H
#define BATTEN_PICTURE_H

#include <cairo.h>
#include <stddef.h>

#include "camera.h"
#include "colormap.h"
#include "curve.h"
#include "report.h"
#include "surface.h"
#include "theme.h"

/* Linear R G B A planes, premultiplied as in EXR, width x height: over the theme's ground, as
 * sRGB; brighter than white is white. */
enum status picture_image(const char *path, int width, int height, const float *const rgba[4],
                          enum theme theme, const struct report *r);

/*
 * A map: values colored, with a key: symbol, unit, ticks at round numbers, range and scale in words.
 * A map of fewer than 512 values a side is drawn larger, each value as a rectangle of pixels.
 */
struct picture_map {
	int width, height;    /* of the values */
	const float *values;  /* rows from the top; NaN: no value there, hatched */
	const float *shade;   /* color is multiplied by it, for form; NaN: nothing there, ground.
	                             NULL: no form */
	const float *weights; /* areas, for the shares beyond the range; NULL: all the same */
	const char *title, *note; /* "Gaussian curvature", "hull, 512 x 512"; note may be NULL */
	const char *symbol;       /* of the key: "K" */
	const char *unit;         /* "1/m²" or NULL */
	const double *axes; /* u0 u1 v0 v1: parameters of the outermost values, v upward; NULL:
	                             a view, no axes */
	struct colormap map;
};
enum status picture_map(const char *path, const struct picture_map *m, enum theme theme,
                        const struct report *r);

/* A curve in space, drawn to 0.1 px or better; a cubic seen without perspective exactly. */
struct picture_curve {
	const struct curve *curve; /* borrowed */
	struct rgb color;
	double width;      /* px */
	const char *label; /* or NULL; written on the curve where there is room */
};

struct picture_text {
	double x,
	        y; /* px: of the baseline the left end (align 0), the middle (0.5), the right one (1) */
	double align;
	const char *text;
};

struct picture_lines {
	const struct camera *camera;
	const struct surface *const *surfaces; /* isoparametric lines, light; borders stronger */
	int n_surfaces;
	const struct picture_curve *curves;
	size_t n_curves;
	const char *title, *note;            /* may be NULL */
	const struct curve *wires, *borders; /* lines like the surfaces', of trimmed faces */
	size_t n_wires, n_borders;
	const struct picture_text *texts; /* small ones at places of their own */
	size_t n_texts;
};

enum picture_format { PICTURE_PNG, PICTURE_SVG, PICTURE_PDF };
enum status picture_lines(const char *path, enum picture_format format,
                          const struct picture_lines *lines, enum theme theme,
                          const struct report *r);

/* Several on one sheet, each as large as its camera's image and cut there. */
struct picture_pane {
	const struct picture_lines *lines;
	int x, y; /* px, of its upper left corner */
};
enum status picture_panes(const char *path, enum picture_format format, int width, int height,
                          const struct picture_pane *panes, int n, enum theme theme,
                          const struct report *r);

/* One of them alone, where Cairo draws already; its upper left corner is the origin. */
enum status picture_pane_draw(cairo_t *cr, const struct picture_lines *lines, enum theme theme);

#endif
