/* worker_private.h - what the files of the shared worker main know of each other. */
#ifndef BATTEN_WORKER_PRIVATE_H
#define BATTEN_WORKER_PRIVATE_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <time.h>

#include "hash.h"
#include "part.h"
#include "worker.h"

enum { PROTOCOL_VERSION = 1, THREADS_MAX = 1024, MEMORY_MAX = 1 << 30 };

/* ---- what is asked for: from the command line or from a job file ---- */

struct task_input {
	char *path, *entity; /* owned; entity NULL: all surfaces of the file */
};

struct task {
	struct task_input *inputs; /* owned */
	int n_inputs;
	char **values; /* owned, one a parameter of the worker, canonical; NULL: no value */
	bool *given;   /* owned, one a parameter: not by default */
	char *output;  /* owned; NULL: named after the input */
	char *part;    /* owned; NULL: OUTPUT.part */
	char **parts;  /* owned; part files of shards to take units from */
	int n_parts;
	int threads; /* 0: as many as there are processors */
	size_t memory_mib;
	uint64_t shard, n_shards; /* n_shards 0: the whole */
	bool force, json;
};

/* Errors: ST_RESOURCE. */
enum status task_init(struct task *t);
void task_finish(struct task *t);
enum status task_add_input(struct task *t, const char *path, const char *entity);

/* What the command line asks for besides a computation. */
enum mode { MODE_RUN, MODE_PACKETS, MODE_DESCRIBE, MODE_HELP, MODE_VERSION };

/* t is initialised here. Errors: ST_PARAMETER, ST_INPUT (job file), ST_RESOURCE. */
enum status options_parse(struct task *t, int argc, char **argv, enum mode *mode,
                          const struct report *r);

/* A job file, or its text; t is initialised here. Errors: ST_INPUT, ST_PARAMETER, ST_RESOURCE. */
enum status job_read(struct task *t, const char *path, const struct report *r);
enum status job_parse(struct task *t, const char *text, size_t n, const char *path,
                      const struct report *r);

/* ---- parameters ---- */

const struct param *param_find(const char *name, int *index); /* NULL if there is none */
const char *param_type_name(enum param_type type);

/* Check a value and keep it in canonical form. Errors: ST_PARAMETER, ST_RESOURCE. */
enum status values_set(struct task *t, const char *name, const char *value, const struct report *r);
/* Give those that are not set their default. */
enum status values_default(struct task *t, const struct report *r);

/* ---- --describe, --help ---- */

json_t *describe_json(void); /* NULL: out of memory */
void options_help(struct text *out);
void describe_help(struct text *out);

/* ---- where word goes ---- */

struct result {
	const char *path, *kind;
	const json_t *figures; /* may be NULL */
	bool up_to_date;
};

/* A terminal, or packets. Any thread may call; each callback locks for itself. */
struct front {
	void (*progress)(void *data, const char *phase, size_t done, size_t total);
	void (*note)(void *data, enum report_level level, const char *text);
	void (*unit)(void *data, size_t unit);
	void (*result)(void *data, const struct result *result);
	void (*error)(void *data, enum status st, const char *text);
	void *data;
};

/* Progress, told ten times a second at most, and at the beginning and end of each phase. */
struct meter {
	const struct front *front;
	pthread_mutex_t lock;
	char phase[96];
	size_t done, total; /* units; total 0: not known yet */
	double told;        /* when; seconds of the monotonic clock */
};
void meter_init(struct meter *m, const struct front *front);
void meter_set(struct meter *m, const char *phase, size_t done, size_t total);
void meter_repeat(struct meter *m); /* tell at once what is known */

/* One life of the process: allocated once and never freed, for the threads that read signals and
 * packets use it until the process ends. */
struct run {
	const struct front *front; /* borrowed */
	atomic_bool stop;          /* asked to stop at the next unit */
	struct meter meter;
	struct report report; /* notes go to the front, the first error of each class is kept */
	pthread_mutex_t lock; /* guards the two below */
	char errors[N_STATUS][1024];
	char **temps; /* owned; files to take away when we leave at once; NULL: free places */
	size_t n_temps;
};
void run_init(struct run *run, const struct front *front);

/* Do everything a task asks for; failures have been told to the front. */
enum status run_task(struct run *run, const struct task *t);

/* Remember, forget a temporary file. Errors: ST_RESOURCE. */
enum status run_add_temp(struct run *run, const char *path);
void run_drop_temp(struct run *run, const char *path);

/* Leave the process now, temporary files taken away; the part file stays. */
_Noreturn void run_leave(struct run *run, int exit_status);

/* ---- inputs ---- */

/* What one begin..finish works on. */
struct computation {
	const struct surface **surfaces; /* owned array of borrowed things */
	const struct entity **entities;
	int n;
	const char *unit; /* borrowed from the model */
	char *base;       /* owned; output's basic name, with folder */
	char input_hash[HASH_SIZE];
};

struct inputs {
	struct model *models; /* owned */
	const char **paths;   /* owned array, of the task's strings */
	int n_models;
	struct computation *list; /* owned */
	int n;
};

/* Read files, find entities, name outputs. Errors: ST_INPUT, ST_PARAMETER, ST_RESOURCE,
 * ST_CANCELLED. */
enum status inputs_read(struct inputs *in, struct run *run, const struct task *t);
void inputs_finish(struct inputs *in);

/* ---- one computation ---- */

struct pending {
	const struct worker_output *row;
	char *temp, *path; /* owned; temp NULL: it is the part file, to be renamed */
};

struct work_private {
	struct run *run;
	const struct task *task;
	const struct computation *computation;
	struct part *part;
	bool in_place;                     /* the units are the own output's, in order */
	double bytes_max;                  /* of all units together; 0: not known */
	struct work_attribute *attributes; /* owned; names of parameters and values too */
	int n_attributes;
	json_t *figures;         /* owned */
	struct pending *pending; /* owned, one an output row at most */
	int n_pending;
	size_t n_units;
	atomic_size_t n_done;
};

/* Errors: ST_RESOURCE. */
enum status attributes_make(struct work *w);
void attributes_finish(struct work_private *p);

/* Key of the part file. Caller frees. */
char *attributes_key(const struct work *w);

/* All outputs that the parameters ask for are there, made by the same worker from the same input
 * and parameters. *figures is a new reference or NULL. */
bool outputs_up_to_date(struct work *w, json_t **figures);

/* Path of an output. Caller frees. */
char *output_path(const struct work *w, const struct worker_output *row);
bool output_wanted(const struct work *w, const struct worker_output *row);

/* Known before hours are spent: can the outputs have their names? Errors: ST_PARAMETER, ST_INPUT. */
enum status outputs_check(const struct work *w);

/* Is there so much room that what the units will take need not be known? */
bool room_is_ample(const struct work *w, const char *part);

/* The part file is the output with that extension. Errors: ST_INTERNAL, ST_RESOURCE. */
enum status outputs_add_part(struct work *w, const char *extension);

/* Rename what was made, or take it away. Errors: ST_INTERNAL (one is missing), ST_RESOURCE. */
enum status outputs_commit(struct work *w);
void outputs_abandon(struct work *w);

/* Is there room for n_left units more and for the outputs? Judged by the units that are there.
 * Errors: ST_RESOURCE (no; how much is wanted where). */
enum status room_check(const struct work *w, const char *part, size_t n_left);

/* ---- the two fronts ---- */

int hand_main(const struct task *t);
int link_main(void);

/* Take SIGINT, SIGTERM and SIGHUP as cancel, a second one as leave at once; SIGCONT tells the
 * progress. To be called before any other thread is made. */
enum status signals_watch(struct run *run);

#endif
