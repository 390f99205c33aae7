/* view.h - the world drawn with OpenGL 3.3: wire frame, shading, maps, lines, images, net, probe. */
#ifndef BATTEN_VIEW_H
#define BATTEN_VIEW_H

#include "key.h"
#include "text.h"
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

enum { VIEW_PLACES = 8 };

/* What a place in the window shows. Cameras are changed by the functions below, in logical px. */
struct view_state {
	struct camera camera;
	enum theme theme;
	double scale; /* device px a logical px */
	int place; /* of several drawn one after another each keeps its picture: 0 to VIEW_PLACES - 1 */
	bool moving;  /* being dragged: at most about 100,000 triangles, no multisampling */
	bool whole;   /* at rest: all triangles are made, however long it takes */
	int only;     /* id of the one thing shown, 0: all that are on */
	int quantity; /* enum quantity for LOOK_MAP, -1: as the overlay says */
	bool axes;    /* small cross of axes in the corner */
	int hover_thing, hover_point; /* id and index of the control point under the mouse; 0, -1 */
	int chosen;        /* id of the surface whose borders are drawn as chosen, 0: none */
	bool light;        /* the sun and its ray are drawn: the light is being set */
	struct mark probe; /* drawn with its circles; thing 0: none */
	struct vec3 pivot; /* about which it is being turned: view_rotate's own */
	bool has_pivot;    /* false at the start of a drag */
};

struct view; /* opaque; GL objects and tessellations of one world, cached by id and revision */

/* A GL context of 3.3 or later must be current, and the same one in every other call.
 * Errors: ST_RESOURCE with the GL version found and the one needed. */
enum status view_create(struct view **out, const struct report *r);
void view_destroy(struct view *v);

/* Draw into the framebuffer bound now, rectangle in device px from the lower left corner.
 * *more: something coarser was drawn than can be: draw again at rest. Results of a running job are drawn as
 * far as its file has come; draw again when there is news of the job. */
enum status view_draw(struct view *v, const struct world *w, const struct view_state *s, int x,
                      int y, int width, int height, bool *more, const struct report *r);

/* Triangles of surfaces in what was drawn last; lines are not counted. */
int view_triangles(const struct view *v);

/* The key of the map that was drawn last; false: there was none. Its unit and bar are the caller's. */
bool view_key(const struct view *v, struct key *out);

/* Cameras. Angles in degrees; px logical, (0, 0) the upper left corner of the view. The camera's width
 * and height are the view's in logical px: the window keeps them so when the view's size changes.
 * view_fit: view as camera_fit takes it, NULL: from where it is seen now.
 * view_rotate: about the middle of what is seen, z stays upright; dx > 0 turns what is near to the right,
 * dy > 0 down. */
enum status view_fit(struct view_state *s, const struct world *w, const char *view, int width,
                     int height, const struct report *r);
void view_rotate(struct view_state *s, const struct world *w, double dx, double dy);
void view_pan(struct view_state *s, double dx, double dy);
void view_zoom(struct view_state *s, const struct world *w, double factor, double x, double y);
/* The other projection, with what is in the middle as large as before. */
void view_project(struct view_state *s, const struct world *w, enum camera_kind kind);

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

/* Views beside each other, as a window has them: where each is, and what the halves of two are. */
struct tile_px {
	double x, y, width, height; /* without the rules between them */
};
/* Long things lie below each other, a square beside what it is of, seven curvatures four and three; their
 * number. */
int view_tiles(enum view_split split, bool curvatures, double width, double height,
               struct tile_px out[N_QUANTITIES]);
/* Which thing a half shows: 0: all that are on, -1: none yet. */
int view_tile_only(const struct world *w, enum view_split split, int half);
/* The surface whose parameters have a plane: of the curve selected last the one it lies on, else the current
 * one; NULL: none. */
const struct Ful *view_plane_surface(const struct world *w);
/* Heading and note of a half, appended; false: it has those of the whole. */
bool view_tile_words(const struct world *w, enum view_split split, int half, struct text *title,
                     struct text *note);

/* What is beside each other in a picture. */
enum picture_views {
	PICTURE_SHOWN, /* as the window has it */
	PICTURE_ONE,
	PICTURE_SIDE,
	PICTURE_CHILD,
	PICTURE_UV,
	PICTURE_CURVATURES,
	N_PICTURE_VIEWS
};
extern const char *const picture_views_words[N_PICTURE_VIEWS]; /* "shown", "one", "side", ... */

/* How a picture is made; zeroed but for the size: three-quarter view, light theme, scale 1. */
struct render_options {
	const char *view; /* as camera_fit takes it; NULL: the sight's camera, else three-quarter */
	int width, height; /* px of the picture */
	enum theme theme;
	double scale;      /* px a logical px, of texts and line widths; 0: 1 */
	bool has_quantity; /* for LOOK_MAP, instead of the overlays' */
	enum quantity quantity;
	const char *title; /* NULL: what is shown, in words */
	enum picture_views views;
	const char *
	        beside; /* from where the second of two sides looks; NULL: as the window, else top */
};

/*
 * The world as a picture with key and title: .png by GL with multisampling, .svg and .pdf for lines (of the seven
 * curvatures one view: maps are no lines).
 * The file appears whole or not at all. Same world, same bytes (of PNG: by the same GL driver).
 * Errors: ST_PARAMETER (extension, view), ST_INPUT (folder), ST_RESOURCE (no GL, full disk).
 */
enum status render_write(const struct world *w, const char *path, const struct render_options *o,
                         const struct report *r);

#endif
