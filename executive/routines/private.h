/* private.h - what the branches of routines share. */
#ifndef BATTEN_ROUTINES_PRIVATE_H
#define BATTEN_ROUTINES_PRIVATE_H

#include "client.h"
#include "rows.h"
#include "vec.h"

/* Arguments that were checked: as given, or NULL where left out or auto. */
const char *argument_text(const struct arguments *g, const char *name);
double argument_number(const struct arguments *g, const char *name, double fallback);
bool argument_yes(const struct arguments *g, const char *name, bool fallback);
/* X,Y,Z or U,V (z 0); false where it was left out. */
bool argument_vector(const struct arguments *g, const char *name, struct vec3 *out);
bool argument_color(const struct arguments *g, const char *name, struct rgb *out);
bool argument_pair(const char *value, char between, double *a, double *b);

/* Tell the user, as printf. */
void act_say(const struct act *a, const char *format, ...) __attribute__((format(printf, 2, 3)));
enum status act_memory(const struct act *a); /* "memory ran out" */

/* The current thing, of that kind where one is asked for; the sentence says what to do. NULL: none. */
const struct Ful *act_current(const struct act *a, bool curve);
const struct Ful *act_current_kind(const struct act *a, enum entity_kind kind);
/* Say what of a file was opened: all from place `before` on. */
void opened_say(struct act *a, const char *file, int before);
/* Relative to the project's folder; fresh. */
char *act_path(const struct act *a, const char *name);

/* A job's parameters: those of `given`, without wait and surfaces; the object is the caller's. */
json_t *work_parameters(const struct arguments *given);

/* What came of jobs. */
struct work_done {
	struct Stats job; /* the last one's record; finished by the caller */
};
/*
 * Run a worker on things: all in one job where it sees a scene, else only the first. Waits as a->wait says,
 * otherwise the record is that of the queued job. `suffix`: part of the results' name, or NULL.
 * Errors: the worker's, ST_CANCELLED (a->stop; the job is killed).
 */
enum status work_run(struct act *a, const char *worker, json_t *parameters, const int *ids, int n,
                     const char *suffix, struct work_done *out);
void work_done_finish(struct work_done *d);

/* Surfaces of a scene: those shown, else the current one. *ids is fresh. 0 with a sentence: there are none. */
int work_scene(struct act *a, int **ids);
/* Those that a leaf is for: the current one, or, where it is asked for, each that is shown; likewise. */
int work_meant(struct act *a, const struct arguments *given, int **ids);
/* Name of results of these things, absolute, fresh: their own, or one that no others have. */
char *work_name(const struct act *a, const int *ids, int n, const char *suffix);
/* What a result says it was made of, for these things. */
enum status work_hash(const struct world *w, const int *ids, int n, char out[33]);

/* What was asked for last is seen: an image in the view gives way to things, and the other way round. */
void work_seen(struct world *w, enum overlay_kind kind);
/* Show what a job made, or is making. */
enum status work_show(struct act *a, const struct Stats *s, int thing, const struct overlay *like);
/* Is that file a result of the worker for these things as they are now? *grid: its parameter, fresh or NULL. */
bool work_is_current(const char *path, const char *worker, const char hash[33], char **grid);

/* A request to the service about jobs; each record goes to on_job. body is stolen. */
enum status work_ask(struct act *a, enum message_type type, json_t *body, client_job *on_job,
                     void *data);

/* rows_given.c: arguments of a job from its worker, and wait. */
enum status rows_of_worker(struct argument_row **out, const struct routine *t, struct act *a);
enum status rows_copy(struct argument_row **out, const struct argument_row *rows,
                      const struct world *w);
/* state.c: what the world has now as defaults of rows that set it. Errors: ST_RESOURCE. */
enum status rows_from_state(struct argument_row *rows, const struct routine *t,
                            const struct world *w);
/* contours.c: what the settings of planes and cylinders make of a row's default. Fresh or NULL. */
/* Is that parameter of the worker for the other leaf, planes or cylinders? */
bool contours_is_other(bool cylinders, const char *parameter);
char *contours_default(const struct world *w, bool cylinders, const char *parameter);

#endif
