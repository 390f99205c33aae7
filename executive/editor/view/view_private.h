/* view_private.h - what the files of the view share. */
#ifndef BATTEN_VIEW_PRIVATE_H
#define BATTEN_VIEW_PRIVATE_H

#include "exr.h"
#include "key.h"
#include "shape.h"
#include "view.h"

/* Off-screen image that is drawn into. */
struct target {
	GLuint frame, color, depth; /* color and depth are renderbuffers */
	int width, height, samples;
};

/* Values over a surface's domain, of a file, of a job's tiles so far, or of the surface itself. */
struct map {
	int thing;
	unsigned revision; /* of the thing, where the values are its own; else 0 */
	char *file;        /* owned; NULL: the surface's own values */
	int64_t stamp[3];  /* of the file: time, size, i-node */
	int width, height;
	float *values[N_QUANTITIES]; /* owned; rows from v's end down; NULL: not in the file */
	float *weights;              /* owned; area of each sample */
	GLuint texture[N_QUANTITIES];
	bool used;
	unsigned changes; /* grows when values arrive */
};

/* Lines of a result file, in groups of one value. */
struct result_group {
	double value;
	bool strong; /* every third */
	char *label; /* owned */
	struct poly poly;
	struct gpu_poly gpu;
};

struct result {
	char *file; /* owned */
	int64_t stamp[3];
	double tolerance;
	struct result_group *groups; /* owned */
	int n;
	bool used;
};

/* A picture in a texture, colors multiplied by alpha. */
struct plate {
	GLuint texture;
	int width, height;
};

struct image {
	char *file; /* owned */
	int64_t stamp[3];
	struct plate plate;
	bool used;
};

enum { LABEL_ROOM = 48 };

/* A text in a texture, kept as long as it is used. */
struct text_plate {
	char text[LABEL_ROOM];
	unsigned style; /* theme, kind, scale: all that its pixels depend on */
	struct plate plate;
	bool used;
};

/* The things at rest in one place. */
struct still {
	struct target target;
	uint64_t of; /* what it shows; 0: nothing */
	bool is_image;
};

/* Small surfaces in one mesh, for frames while something is dragged. */
struct batch {
	struct gpu_mesh gpu;
	struct vec3 origin;
	uint64_t of; /* what it is made of; 0: nothing */
};

struct view {
	struct programs programs;
	struct target fine, plain; /* with and without multisampling */
	struct still stills[VIEW_PLACES];
	struct shapes shapes;
	struct batch batch;
	struct map *maps;         /* owned */
	struct result *results;   /* owned */
	struct image *images;     /* owned */
	struct text_plate *texts; /* owned */
	int n_maps, n_results, n_images, n_texts;
	struct gpu_poly scratch; /* lines of one frame */
	struct poly scratch_poly;
	GLuint empty;   /* an array for what has no attributes */
	GLuint colors;  /* the color map as a texture */
	struct key key; /* what is shown now */
	bool has_key;
	int triangles;   /* of surfaces, drawn last */
	uint64_t key_of; /* what the key was found from */
};

/* One drawing: everything that its parts need. */
struct drawing {
	struct view *view;
	const struct world *world;
	const struct view_state *state;
	struct camera camera; /* in device px */
	struct gpu_frame frame;
	struct box box; /* of what is shown */
	struct vec3 light, fill, sky;
	double near, far;
	struct rgb ground;
	enum theme set;            /* whose lines and texts stand out from the ground */
	struct shape **shown;      /* owned; surfaces and curves that are on */
	const struct Ful **things; /* owned; the same */
	bool *in_view;             /* owned; of those, which may be in the picture */
	bool *in_batch;            /* owned; of those, which the batch has */
	int n_shown;
	bool has_batch; /* it is drawn */
	bool fine;      /* the fine triangles are drawn, of those that have them */
	bool has_map;   /* some surface shows values */
	bool has_image; /* an image stands in place of the things */
	bool more;
	const struct report *report;
};

static inline struct rgb drawing_color(const struct drawing *d, enum token token)
{
	return theme_color(d->set, token);
}

/* device px -> length at a point */
static inline double drawing_pixel(const struct drawing *d, struct vec3 p)
{
	return camera_pixel(&d->camera, p);
}

/* target.c. Errors: ST_RESOURCE. */
enum status target_init(struct target *t, int width, int height, int samples,
                        const struct report *r);
void target_finish(struct target *t);

/* view_map.c: values of the surfaces that show them, the colors for all of them, and their use. */
enum status maps_update(struct drawing *d);
void maps_finish(struct view *v);
/* Uniforms of PROGRAM_SURFACE for a thing; false: it has no values. */
bool map_use(struct drawing *d, int thing);
/* Which quantity is shown of a thing, whose overlay o is (NULL: none); -1: none. */
int map_quantity(const struct drawing *d, const struct overlay *o);
const struct overlay *overlay_of(const struct world *w, enum overlay_kind kind, int thing);

/* result.c: lines of .isophote and its kin. */
enum status results_draw(struct drawing *d);
void results_finish(struct view *v);

/* image.c: an image result in place of the things. */
bool images_draw(struct drawing *d); /* false: there is none */
void images_finish(struct view *v);

/* plates.c: textures from Cairo, drawn in px. */
void plate_load(struct plate *p, cairo_surface_t *surface);
void plate_finish(struct plate *p);
void plate_draw(const struct drawing *d, const struct plate *p, double x, double y, double width,
                double height); /* device px from the upper left corner */
/* A text with its middle at (x, y), device px; on_ground: on a plate of the ground's color. */
void text_draw(struct drawing *d, const char *text, enum label_style style, bool on_ground,
               double x, double y);
double text_width(struct drawing *d, const char *text, enum label_style style, bool on_ground);
void texts_begin(struct view *v);
void texts_end(struct view *v); /* those not used are forgotten */
void texts_finish(struct view *v);

/* marks.c: kept marks with their circles, the light, the axes, the point under the mouse. */
void marks_draw(struct drawing *d);
void light_draw(struct drawing *d);
void axes_draw(struct drawing *d);

/* surfaces.c: triangles of all that is in view, then drawn. Length of the smallest pixel on them. */
double surfaces_pixel(const struct drawing *d);
enum status surfaces_make(struct drawing *d, double pixel);
enum status surfaces_draw(struct drawing *d, double pixel);
/* How a surface is drawn now: a map without values is a wire frame. */
enum surface_look surface_look_of(const struct drawing *d, const struct Ful *f);
struct rgb surface_color(const struct Ful *f);

/* batch.c: which surfaces are drawn at once, and their mesh. Errors: ST_RESOURCE. */
enum status batch_make(struct drawing *d, double pixel);

/* scene.c: the things themselves. */
enum status scene_draw(struct drawing *d);
void hover_draw(struct drawing *d); /* the control point under the mouse */

/* scratch.c: lines and points that live for one frame; begin, add to d->view->scratch_poly, draw. */
void scratch_begin(struct drawing *d, struct vec3 origin);
void scratch_lines(struct drawing *d, const struct gpu_style *style);
void scratch_sprites(struct drawing *d, const struct gpu_sprite *style);

/* frame.c: the camera in device px, box, planes, matrix; for drawing and picking alike. */
enum status drawing_init(struct drawing *d, struct view *v, const struct world *w,
                         const struct view_state *s, int width, int height, const struct report *r);
void drawing_finish(struct drawing *d);
/* The theme whose lines have more contrast with that ground. */
enum theme ground_theme(struct rgb ground);

#endif
