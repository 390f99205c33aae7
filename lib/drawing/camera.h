/* camera.h - how surfaces are seen. World z is up. */
#ifndef BATTEN_CAMERA_H
#define BATTEN_CAMERA_H

#include "box.h"
#include "surface.h"
#include "vec.h"

enum camera_kind { CAMERA_ORTHOGRAPHIC, CAMERA_PERSPECTIVE };

struct camera {
	enum camera_kind kind;
	int width, height;            /* pixels */
	struct vec3 eye;              /* of an orthographic camera: centre of the image plane */
	struct vec3 right, up, ahead; /* unit, right x up = -ahead */
	double half;                  /* half of the image's smaller side: length (orthographic),
	                                 tangent of half the angle (perspective) */
};

/*
 * Look at the box so that it fits with a margin of 6 % a side. `view` is
 *	three-quarter (default) | front | back | left | right | top | bottom | AZIMUTH,ELEVATION
 * in degrees (azimuth from +x to +y of where the eye stands, elevation -90 to 90), optionally
 * followed by :orthographic (default) or :perspective, and that by @ANGLE in degrees, of the smaller
 * side (default 30). front stands at -y, right at +x; top and bottom have +x to the right. The whole
 * box is before the eye. view NULL or "" is the default. What camera_write gives is taken as it is.
 * Errors: ST_PARAMETER with what is allowed; ST_INPUT for an empty box.
 */
enum status camera_fit(struct camera *out, const char *view, const struct box *box, int width,
                       int height, const struct report *r);

/*
 * The same for surfaces instead of their box, so tighter: the points of a grid on each fit within the
 * margin, and the middle of what is seen is the middle of the image.
 * Errors: as camera_fit, and ST_RESOURCE.
 */
enum status camera_fit_surfaces(struct camera *out, const char *view,
                                const struct surface *const *surfaces, int n, int width, int height,
                                const struct report *r);

/* A camera as it is, but for width and height, as camera_fit takes it: "camera:", then eye, right, up,
 * ahead and half by comma, then :orthographic or :perspective. What is read is what was written. */
enum { CAMERA_TEXT_SIZE = 13 * 32 + 32 };
void camera_write(char out[CAMERA_TEXT_SIZE], const struct camera *c);
bool camera_is_text(const char *view);
bool camera_parse(struct camera *out, const char *text); /* width and height become 0 */

/* Ray through image point (x, y) in pixels, (0, 0) the upper left corner of the upper left pixel.
 * direction is of unit length; its length along the ray is not the depth of a perspective camera. */
void camera_ray(const struct camera *c, double x, double y, struct vec3 *origin,
                struct vec3 *direction);

/* Image point of p in pixels and its depth along `ahead`; false behind a perspective eye. */
bool camera_project(const struct camera *c, struct vec3 p, double *x, double *y, double *depth);

/* Length of a pixel at p, in the file's unit: for tolerances of lines drawn. */
double camera_pixel(const struct camera *c, struct vec3 p);

#endif
