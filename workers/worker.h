/* worker.h - what a worker file gives, and what worker.c gives it.
 *
 * A worker is one file that ends in `const struct worker worker`: a description and four functions.
 * worker.c, the main that all workers share, does the rest: options, packets, threads, part file,
 * signals, exit status, up-to-date check, whole output files.
 */
#ifndef BATTEN_WORKER_H
#define BATTEN_WORKER_H

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "model.h"
#include "report.h"
#include "text.h"

enum param_type {
	PARAM_INTEGER,
	PARAM_REAL,
	PARAM_TEXT,
	PARAM_CHOICE, /* choices: words by blanks */
	PARAM_FLAG,   /* yes or no; --name alone is yes */
	PARAM_SIZE,   /* AxB, two integers */
	PARAM_VECTOR, /* X,Y,Z */
	PARAM_VIEW,   /* as camera_fit takes it */
	PARAM_COLOR,  /* #RRGGBB */
};

/* One parameter. Values travel as text in command-line form. */
struct param {
	const char *name; /* NULL ends the list */
	enum param_type type;
	const char *def;  /* default in command-line form; NULL: not set, the worker decides */
	double min, max;  /* of each number; both 0: no limit */
	const char *unit; /* "deg", "px", "file", or NULL */
	const char *choices;
	const char *help; /* one sentence, no capital, no full stop */
};

/* What a worker leaves: extension added to the basic name, kind in RESULT. */
struct worker_output {
	const char *extension; /* ".map.exr"; NULL ends the list; the first is the worker's own */
	const char *kind;      /* "map", "image", "curves", "picture" */
	const char *when;      /* flag or parameter that must be set for it, or NULL: always */
};

struct work;

struct worker {
	const char *name;      /* "curvature": the executable is batten-curvature */
	const char *title;     /* "curvature map" */
	int version;           /* raised when results change */
	const char *help;      /* a sentence or two: what it makes */
	bool scene;            /* all surfaces named make one job; else one job a surface */
	bool units_are_output; /* the outputs take about as much room as the units' bytes */
	const struct param *params;
	const struct worker_output *outputs;

	/* Read parameters, prepare; may set w->state. Said once before any unit, and before finish. */
	enum status (*begin)(struct work *w);
	/* Number of units, after begin; at least 1. */
	size_t (*units)(const struct work *w);
	/* Do one unit and work_put its bytes. Any thread, several at once: w is read-only. */
	enum status (*unit)(struct work *w, size_t unit);
	/* All units are there: join them in unit order, write outputs, state the figures. */
	enum status (*finish)(struct work *w);
	/* Free w->state; may be NULL. */
	void (*end)(struct work *w);
};

/* The one worker of this executable. */
extern const struct worker worker;

/* One computation. Fields are set by worker.c before begin; read-only for the worker. */
struct work {
	const struct worker *worker;
	const struct surface **surfaces; /* scene: all; else one */
	const struct entity **entities;  /* the same, with names and colors */
	int n_surfaces;
	const char *file_unit; /* "m", or NULL */
	int threads;           /* at least 1 */
	size_t memory;         /* bytes allowed, 0: no limit */
	struct report report;  /* errors and notes go here, any thread */
	void *state;           /* the worker's own */
	struct work_private *private;
};

/* Values of parameters, checked against type and range before begin. */
double work_real(const struct work *w, const char *name);
long work_integer(const struct work *w, const char *name);
const char *work_text(const struct work *w, const char *name);
bool work_flag(const struct work *w, const char *name);
void work_size(const struct work *w, const char *name, int *a, int *b);
struct vec3 work_vector(const struct work *w, const char *name);
/* Has it a value (given, or a default)? */
bool work_has(const struct work *w, const char *name);

/*
 * Parameters that several workers have, under one name each; rows for `params`:
 *	PARAM_ROW_GRID("512x512"), PARAM_ROWS_LIGHT("0", "30"), PARAM_ROW_PNG, { .name = NULL }
 */
/* clang-format off */
#define PARAM_ROW_SIZE(value)                                                                      \
	{ .name = "size", .type = PARAM_SIZE, .def = value, .min = 1, .max = 65536, .unit = "px",  \
	  .help = "width and height of the image" }
#define PARAM_ROW_GRID(value)                                                                      \
	{ .name = "grid", .type = PARAM_SIZE, .def = value, .min = 1, .max = 65536,                \
	  .help = "samples in u by samples in v" }
#define PARAM_ROW_VIEW(value)                                                                      \
	{ .name = "view", .type = PARAM_VIEW, .def = value,                                        \
	  .help = "from where it is seen: three-quarter, front, back, left, right, top, bottom or " \
		  "AZIMUTH,ELEVATION in degrees; then :perspective or :orthographic, and @ANGLE" }
#define PARAM_ROW_TOLERANCE(value)                                                                 \
	{ .name = "tolerance", .type = PARAM_REAL, .def = value, .min = 0, .max = INFINITY,        \
	  .unit = "file", .help = "largest distance from the exact result" }
#define PARAM_ROWS_LIGHT(azimuth_value, incidence_value)                                           \
	{ .name = "light", .type = PARAM_VECTOR,                                                   \
	  .help = "from the surface towards a parallel light, any length; instead of the angles" }, \
	{ .name = "azimuth", .type = PARAM_REAL, .def = azimuth_value, .min = -360, .max = 360,    \
	  .unit = "deg", .help = "where the light stands, from +x towards +y" },                   \
	{ .name = "incidence", .type = PARAM_REAL, .def = incidence_value, .min = 0, .max = 180,   \
	  .unit = "deg", .help = "angle of the light from +z" }
#define PARAM_ROW_PNG                                                                              \
	{ .name = "png", .type = PARAM_FLAG, .def = "no",                                          \
	  .help = "make the picture, too, with its color key where it has one" }
#define PARAM_ROW_SVG                                                                              \
	{ .name = "svg", .type = PARAM_FLAG, .def = "no", .help = "make the drawing, too" }
/* clang-format on */

/* Unit vector towards the light, of a worker with PARAM_ROWS_LIGHT.
 * Errors: ST_PARAMETER (no direction; both the vector and an angle given). */
enum status work_light(const struct work *w, struct vec3 *out);

/* Hand over a unit's finished bytes (any thread). */
enum status work_put(struct work *w, size_t unit, const void *bytes, size_t n);

/* In finish: a unit's bytes in place of what *bytes held; the room is used again. Thread: any. */
enum status work_read(struct work *w, size_t unit, struct text *bytes);

/* In finish: the last n bytes of a unit, not checked for damage: work_read of it, before an output is
 * whole, does that. Thread: any. */
enum status work_read_end(struct work *w, size_t unit, void *to, size_t n);

/* In finish: a unit's bytes, valid until the end; all units stay in memory. Thread: any. */
enum status work_get(struct work *w, size_t unit, const char **bytes, size_t *n);

/* Progress inside begin or finish, where those take longer than half a second; units are told of
 * by themselves. Thread: any. */
void work_phase(struct work *w, const char *phase, size_t done, size_t total);

/* True when it is time to stop: long loops ask now and then and return ST_CANCELLED. */
bool work_cancelled(const struct work *w);

/* Name and value pairs to write into an output, all of them: program, worker, worker_version,
 * input_hash, unit, vector_level, param.NAME for every parameter that has a value, and, once they
 * are stated, figures. Borrowed; good until work_figures. */
struct work_attribute {
	const char *name, *value;
};
const struct work_attribute *work_attributes(const struct work *w, int *n);

/* Write one file to `path`, a temporary name beside the output's. */
typedef enum status work_writer(void *data, const char *path, const struct report *r);

/*
 * In finish: make the output with that extension (one of the worker's outputs) by `write`, and sync
 * it. When finish has succeeded all outputs are renamed, the worker's own (the first) last, and
 * told of with the figures; when it fails they are taken away. Every output that the parameters ask
 * for must be made.
 */
enum status work_output(struct work *w, const char *extension, work_writer *write, void *data);

/* State the figures (a new reference, stolen) before the first work_output: they become the
 * attribute "figures" and go into RESULT. Errors: ST_RESOURCE. */
enum status work_figures(struct work *w, json_t *figures);

#endif
