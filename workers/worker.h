/* worker.h - what a worker file gives, and what worker.c gives it.
 *
 * A worker is one file that ends in `const struct worker worker`: a description and four functions.
 * worker.c, the main that all workers share, does the rest: options, packets, threads, part file,
 * signals, exit status, up-to-date check, whole output files.
 */
#ifndef BATTEN_WORKER_H
#define BATTEN_WORKER_H

#include <jansson.h>
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
	const char *name;  /* "curvature": the executable is batten-curvature */
	const char *title; /* "curvature map" */
	int version;       /* raised when results change */
	const char *help;  /* a sentence or two: what it makes */
	bool scene;        /* all surfaces named make one job; else one job a surface */
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

/* Hand over a unit's finished bytes (any thread). */
enum status work_put(struct work *w, size_t unit, const void *bytes, size_t n);

/* In finish: a unit's bytes, valid until the end. */
enum status work_get(struct work *w, size_t unit, const char **bytes, size_t *n);

/* Progress inside begin or finish, where those take longer than half a second. */
void work_phase(struct work *w, const char *phase, size_t done, size_t total);

/* True when it is time to stop: long loops ask now and then and return ST_CANCELLED. */
bool work_cancelled(const struct work *w);

/* Name and value pairs to write into an output: program and worker version, input hash, every
 * parameter, unit, vector level. Borrowed. */
struct work_attribute {
	const char *name, *value;
};
const struct work_attribute *work_attributes(const struct work *w, int *n);

/* Write one file to `path`, a temporary name beside the output's. */
typedef enum status work_writer(void *data, const char *path, const struct report *r);

/*
 * In finish: make the output with that extension (one of the worker's outputs) by `write`, then
 * sync, rename and tell of it. figures (a new reference, stolen; may be NULL) go with it; the
 * figures of the first output are kept in its attributes as "figures" by the writer: take them from
 * work_attributes after work_figures.
 */
enum status work_output(struct work *w, const char *extension, work_writer *write, void *data);

/* State the figures before the first work_output; they become an attribute and go into RESULT. */
enum status work_figures(struct work *w, json_t *figures);

#endif
