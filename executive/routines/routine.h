/* routine.h - what the menu leaves do: one row each. A routine sees the world and its arguments, never
 * the window; the window and a script call the same function. */
#ifndef BATTEN_ROUTINE_H
#define BATTEN_ROUTINE_H

#include <jansson.h>

#include <stdatomic.h>

#include "project.h"
#include "stats.h"
#include "world.h"

enum routine_kind { ROUTINE_SETTING, ROUTINE_SHOW, ROUTINE_EDIT, ROUTINE_JOB, ROUTINE_MENU };
extern const char *const routine_kind_word[]; /* "setting", "show", "edit", "job", "menu" */

/* name, word in routines --json */
#define ARGUMENT_TYPE_MAP(X)                                                                       \
	X(NUMBER, "number")                                                                        \
	X(INTEGER, "integer")                                                                      \
	X(CHOICE, "choice")                                                                        \
	X(YESNO, "yesno")                                                                          \
	X(TEXT, "text")                                                                            \
	X(FILE, "file") /* to read; one from a list of those in the project */                     \
	X(OUTPUT, "output")                                                                        \
	X(SURFACE, "surface")                                                                      \
	X(CURVE, "curve")                                                                          \
	X(THING, "thing")       /* either */                                                       \
	X(ENTITIES, "entities") /* of a file, by comma */                                          \
	X(VECTOR, "vector")     /* X,Y,Z or U,V */                                                 \
	X(POINTS, "points")     /* rows by semicolon */                                            \
	X(SIZE, "size")         /* WxH */                                                          \
	X(VIEW, "view")                                                                            \
	X(COLOR, "color") /* #RRGGBB */                                                            \
	X(JOBS, "jobs")   /* ids by comma, or all */

#define X(name, word) ARGUMENT_##name,
enum argument_type { ARGUMENT_TYPE_MAP(X) N_ARGUMENT_TYPES };
#undef X
extern const char *const argument_type_word[N_ARGUMENT_TYPES];

struct argument_row {
	const char *name; /* "segments"; NULL ends the list */
	enum argument_type type;
	const char *prompt;  /* "Segments" */
	const char *def;     /* value in script form, or NULL: must be given */
	double min, max;     /* of numbers; min > max: no range */
	const char *unit;    /* or NULL */
	const char *choices; /* "linear|arsinh" */
	const char *pattern; /* of a FILE: "*.map.exr *.base", or NULL */
	const char *help;    /* one sentence */
	bool optional;       /* may be left out, or given as auto, though it has no default */
	/* "shading.azimuth raytrace.azimuth": defaults of later jobs that it sets, and whose value is its own
	 * default; or NULL */
	const char *stores;
};

/* Arguments as given, checked: name and value in script form. */
struct arguments {
	const char **name, **value;
	int n;
};

/* A picture of what the window shows. */
struct picture_wish {
	const char *path;
	const char *view,
	        *beside; /* as camera_fit takes them; NULL: as the window, of the second of two sides */
	const char *
	        views; /* of those beside each other: "shown", "one", a word of view_split_words, "curvatures" */
	int width, height; /* px */
};

/*
 * What a routine works with. Everything is borrowed. say tells the user what happened in a sentence
 * ("94 branches"); report takes errors. stop may be NULL.
 */
struct routine;
struct act {
	struct world *world;
	const struct project *project;
	const struct routine *routine; /* the one that runs; set by routine_call */
	struct report report;
	void (*say)(void *data, const char *text);
	void (*progress)(void *data, double fraction, const char *what);
	void *data;
	const atomic_bool *stop;
	bool wait; /* a job routine returns at the job's end (wait=yes) or when it is queued */
	int64_t jobs[64]; /* set by a job routine: the ids it queued */
	int n_jobs;
	bool killed; /* a job routine starts none and goes on as if it had been killed (wait=killed) */
	bool journal; /* what was done is written to the journal */
	bool quit;    /* set by QUIT */
	/* The view as a picture (EXPORT PICTURE); NULL: there is no view. */
	enum status (*picture)(const struct world *w, const struct picture_wish *wish,
	                       const struct report *r);
};

typedef enum status routine_run(struct act *a, const struct arguments *given);

struct routine {
	const char *code; /* "V79" */
	enum routine_kind kind;
	const char *worker; /* of a job: arguments are those of its description, else NULL */
	const struct argument_row *arguments; /* NULL: none */
	routine_run *run;                     /* NULL: not available yet */
	const char *
	        needs; /* what must be current or there: "surface", "curve", "space curve", "curve on
	                      surface", "thing", "undo", "redo", or NULL */
	int detail;    /* for rows that share a function: a quantity, a state event, ... */
};

/* Every leaf of the menus, by number; ends with code NULL. */
extern const struct routine routine_table[];
const struct routine *routine_find(const char *code); /* NULL: none */

/* The rows asked for, those of a job from its worker's description, defaults those now set in the
 * world. The caller frees *out with routine_rows_free. Errors: ST_PARAMETER (no worker), ST_RESOURCE. */
enum status routine_rows(struct argument_row **out, const struct routine *t, struct act *a);
void routine_rows_free(struct argument_row *rows);

/* Why it cannot be run now ("no file", "no curve", "later version"), or NULL. */
const char *routine_greyed(const struct routine *t, const struct world *w);
/* What a setting is set to, for the right of its menu row ("400 x 200"); "default" where nothing was
 * set; "" where there is nothing to tell. */
void routine_state(const struct routine *t, const struct world *w, char out[48]);

/* Is that value right for that row? Errors: ST_PARAMETER: what it is, what is allowed. */
enum status argument_check(const struct argument_row *row, const char *value, const struct world *w,
                           const struct report *r);
/* Of a value that is wrong: the byte where it stops being the beginning of a right one; its length where
 * that cannot be told, or what is wrong is the whole. */
size_t argument_wrong_at(const struct argument_row *row, const char *value);
/* Candidates that begin with (files: contain) `begin`, best first; a json array of strings. */
json_t *argument_candidates(const struct argument_row *row, const char *begin, const struct act *a);

/* Check, fill in defaults, run, write the journal. Errors: the routine's; ST_PARAMETER names the argument. */
enum status routine_call(const struct routine *t, struct act *a, const struct arguments *given);

/* A job that a routine started without waiting has ended: what it made takes the place of its part file
 * in what is shown. For the window, with each record that it gets. */
void routine_job_ended(struct world *w, const struct Stats *s);

/* All leaves as `batten routines --json` gives them, without paths: a list of {"code","kind","available",
 * "arguments"}; p: for the workers' descriptions. New reference, NULL for want of memory. */
json_t *routines_describe(struct act *a);

/* A line of a script: CODE KEY=VALUE... # comment. Values with blanks in "...", \" inside. A line with
 * nothing on it is fine (*t NULL). Errors: ST_PARAMETER with column. script_line_finish frees. */
struct script_line {
	const struct routine *routine;
	struct arguments given;
	char *text; /* owned: what the above point into */
};
enum status script_line_parse(struct script_line *out, const char *line, const struct report *r);
void script_line_finish(struct script_line *l);

/* Run a script line by line. Errors name the line. *failed counts lines (keep_going). */
enum status script_run(struct act *a, const char *path, bool keep_going, int *failed);

/* Append what was done to .batten/journal in script form, with all arguments and wait=. Jobs that were
 * not waited for are named behind it ("# job 4 5"), for journal_settle. */
enum status journal_write(const struct act *a, const struct routine *t,
                          const struct arguments *given);
/* As a remark: numbers of jobs mean nothing where it is done again. */
enum status journal_remark(const struct act *a, const struct routine *t,
                           const struct arguments *given);

/* How a job ended, or that it goes on after all. */
struct job_end {
	int64_t id;
	bool nothing; /* killed, failed or lost: it left no result */
};
/*
 * Say so in the journal, in place: a line all of whose jobs came to nothing gets wait=killed, so that
 * doing it again starts none; others wait=yes. `ends` is sorted here. No journal is fine.
 * Errors: ST_INPUT, ST_RESOURCE.
 */
enum status journal_settle(const struct project *p, struct job_end *ends, size_t n,
                           const struct report *r);

#endif
