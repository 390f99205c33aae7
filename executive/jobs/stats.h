/* stats.h - the Stats record of one job, its states, colors and glyphs. */
#ifndef BATTEN_STATS_H
#define BATTEN_STATS_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

#include "report.h"
#include "text.h"

/* state, color on dark ground, on light ground, glyph in a terminal, is the job over (1) */
#define JOB_STATE_MAP(X)                                                                           \
	X(QUEUED, "queued", "#DADDE0", "#55656C", "○", 0)                                          \
	X(HELD, "held", "#9B97FF", "#55309C", "⊖", 0)                                              \
	X(STARTING, "starting", "#A9DAFB", "#0F6D9A", "◎", 0)                                      \
	X(RUNNING, "running", "#7CC4F8", "#0F6D9A", "▶", 0)                                        \
	X(SUSPENDED, "suspended", "#F8CE30", "#8A5E00", "‖", 0)                                    \
	X(ENDING, "ending", "#A9DAFB", "#0F6D9A", "▷", 0)                                          \
	X(DONE, "done", "#74E695", "#2A7444", "✓", 1)                                              \
	X(FAILED, "failed", "#FF7440", "#921805", "✗", 1)                                          \
	X(KILLED, "killed", "#AD9B84", "#44342F", "■", 1)                                          \
	X(LOST, "lost", "#D286BE", "#6E0A60", "◌", 1)

#define X(name, word, dark, light, glyph, over) JOB_##name,
enum job_state { JOB_STATE_MAP(X) N_JOB_STATES };
#undef X

struct job_state_row {
	const char *word, *dark, *light, *glyph;
	bool over;
};
extern const struct job_state_row job_state_table[N_JOB_STATES];
enum job_state job_state_from_word(const char *word); /* N_JOB_STATES if there is none */

struct job_input {
	char *path;   /* owned; what the worker reads: .batten/inputs/HASH.base, absolute */
	char *entity; /* owned or NULL: number or name in that file */
};

struct job_output {
	char *path, *kind; /* owned */
	json_t *figures;   /* owned or NULL; likewise */
};

/* What is known of a job. Times are seconds since 1970, 0 where it has not happened. */
struct Stats {
	int64_t id;
	char *worker;                /* owned, all strings; NULL where not known */
	char *file_name, *path_name; /* as the user named the input; absolute path of that file */
	char *group, *host, *reason; /* reason: why it waits, or why it failed and what to do */
	enum job_state state;
	int priority;
	int64_t done, total; /* units */
	char *phase;
	double eta_s; /* NaN: not known */
	pid_t pid;    /* the worker's, 0: none */
	double submitted, started, ended;
	double wall_s, suspended_s, cpu_s; /* NaN: not known */
	int64_t peak_kib;                  /* -1: not known */
	struct job_input *inputs;
	int n_inputs;
	struct job_output *outputs;
	int n_outputs;
	int64_t bytes;      /* of its outputs, -1: not known */
	json_t *parameters; /* owned object of strings; shared by copies: never changed */
	char *output;       /* basic name, absolute */
	int64_t *after;     /* ids it waits for */
	int n_after;
	int64_t *after_any; /* ids whose end it waits for, whatever end that is */
	int n_after_any;
	double wall_limit_s; /* of one run, suspended time left out; 0: none */
	int threads;
	int64_t memory_mib; /* 0: no limit */
	bool force;
	char *on;                         /* name of its launcher; NULL: local */
	int shards;                       /* processes that share its units; 0, 1: one does all */
	char *partition, *account, *time; /* what Slurm is told; NULL: as the settings say */
	int umask;                        /* of who submitted it, -1: not known */
	char *log;                        /* path */
};

/* Nothing known; every number that may be unknown says so. */
void stats_init(struct Stats *s);
void stats_finish(struct Stats *s);
void stats_drop_outputs(struct Stats *s);
enum status stats_copy(struct Stats *out, const struct Stats *s);

/* The object that jobs --json shows (DESIGN: id worker state color fraction eta_s file_name
 * path_name pid host group reason wall_s suspended_s cpu_s peak_kib inputs outputs log), plus
 * bytes, on, shards, partition, account, time, priority, done, total, phase, after, after_any,
 * wall_limit_s, umask, parameters, output, threads, memory_mib, force, submitted,
 * started, ended. New reference; NULL for want of memory. */
json_t *stats_to_json(const struct Stats *s);

/* The same object as text, appended; several times quicker, for long lists. */
void stats_write(struct text *t, const struct Stats *s);
/* Likewise without what is not known, and without what follows from the rest (color, fraction): for
 * packets and the ledger. */
void stats_write_brief(struct text *t, const struct Stats *s);

/* What is missing is not known. Errors: ST_INPUT (no object, no such state, an input without path),
 * ST_RESOURCE. */
enum status stats_from_json(struct Stats *out, const json_t *o);

bool stats_is_local(const struct Stats *s);   /* it runs on this machine */
int stats_processes(const struct Stats *s);   /* that share its units, 1 at least */
double stats_fraction(const struct Stats *s); /* 0 .. 1, NaN where not known */

#endif
