/* view.h - the world drawn with OpenGL 3.3: wire frame, shading, maps, lines, images, net, probe. */
#ifndef BATTEN_VIEW_H
#define BATTEN_VIEW_H

#include "theme.h"
#include "world.h"

enum view_standard {
	VIEW_THREE_QUARTER,
	VIEW_FRONT,
	VIEW_BACK,
	VIEW_LEFT,
	VIEW_RIGHT,
	VIEW_TOP,
	VIEW_BOTTOM
};

/* What a place in the window shows. Cameras are changed by the functions below, in logical px. */
struct view_state {
	struct camera camera;
	enum theme theme;
	double scale; /* device px a logical px */
	bool moving;  /* being dragged: at most about 100,000 triangles, no multisampling */
	int only;     /* id of the one thing shown, 0: all that are on */
	int quantity; /* enum quantity for LOOK_MAP, -1: as the overlay says */
	bool axes;    /* small cross of axes in the corner */
	int hover_thing, hover_point; /* id and index of the control point under the mouse; 0, -1 */
};

struct view; /* opaque; GL objects and tessellations, cached by id and revision */

/* A GL context of 3.3 or later must be current, and the same one in every other call.
 * Errors: ST_RESOURCE with the GL version found and the one needed. */
enum status view_create(struct view **out, const struct report *r);
void view_destroy(struct view *v);

/* Draw into the framebuffer bound now, rectangle in device px from the lower left corner.
 * *more: something coarser was drawn than can be, or results are still arriving: draw again at rest. */
enum status view_draw(struct view *v, const struct world *w, const struct view_state *s, int x,
                      int y, int width, int height, bool *more, const struct report *r);

/* Cameras. Angles in degrees; px logical, (0, 0) the upper left corner of the view. */
enum status view_fit(struct view_state *s, const struct world *w, const char *view, int width,
                     int height, const struct report *r);
void view_rotate(struct view_state *s, const struct world *w, double dx, double dy);
void view_pan(struct view_state *s, double dx, double dy);
void view_zoom(struct view_state *s, const struct world *w, double factor, double x, double y);

/* What lies under a place. */
struct pick {
	int thing;     /* id, 0: nothing */
	bool is_point; /* a control point: index */
	int index;     /* of the control point, row-major for surfaces */
	double u, v;   /* of a surface; a curve: u */
	struct vec3 point;
};
/* Nearest to the eye within 8 px; `skip` hits before it are passed over (Tab). Exact: by rays on
 * the surfaces themselves. */
enum status view_pick(struct view *v, const struct world *w, const struct view_state *s, double x,
                      double y, bool points, int skip, struct pick *out);

/* A GL context without a window (EGL surfaceless). Errors: ST_RESOURCE: what is missing. */
struct offscreen;
enum status offscreen_create(struct offscreen **out, const struct report *r);
void offscreen_destroy(struct offscreen *o);

/* The world as a picture with key and title: .png by GL with multisampling, .svg and .pdf for lines.
 * view as camera_fit takes it; NULL: the sight's camera, else three-quarter. */
enum status render_picture(const struct world *w, const char *path, const char *view, int width,
                           int height, enum theme theme, const struct report *r);

#endif
