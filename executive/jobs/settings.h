/* settings.h - the settings: one table; from $XDG_CONFIG_HOME/batten/config, then .batten/config,
 * then the environment (BATTEN_KEY), later ones win. Lines are `key = value`; # at the beginning or behind a blank begins a comment; a value in "..." is
 * taken as it stands, with \" and \\ for those two. */
#ifndef BATTEN_SETTINGS_H
#define BATTEN_SETTINGS_H

#include <stdbool.h>

#include "project.h"

/* key, type (i integer, s seconds, w word, t text, t text), default, min, max, help */
#define SETTINGS_MAP(X)                                                                               \
	X(JOBS, "jobs", 'i', "0", 0, 1024,                                                            \
	  "jobs running at once; 0: as many as processors, 4 at least")                               \
	X(THREADS, "threads", 'i', "1", 1, 1024, "threads of one job")                                \
	X(MEMORY, "memory", 'i', "0", 0, 1 << 30, "memory of one job in MiB; 0: no limit")            \
	X(NICE, "nice", 'i', "5", 0, 19, "niceness of workers")                                       \
	X(CANCEL_GRACE, "cancel-grace", 's', "2", 0, 3600, "seconds from CANCEL to SIGTERM")          \
	X(TERM_GRACE, "term-grace", 's', "3", 0, 3600, "seconds from SIGTERM to SIGKILL")             \
	X(HELLO_GRACE, "hello-grace", 's', "10", 0.1, 3600, "seconds a worker has to say HELLO")      \
	X(END_GRACE, "end-grace", 's', "5", 0.1, 3600, "seconds from a worker's pipe to its exit")    \
	X(IDLE, "idle", 's', "60", 0.1, 86400, "seconds after which an idle service ends")            \
	X(LAUNCHER, "launcher", 'w', "local", 0, 0,                                                   \
	  "where jobs run that do not say: local, slurm")                                             \
	X(SLURM_JOBS, "slurm-jobs", 'i', "100", 1, 1 << 20, "jobs in Slurm at once")                  \
	X(SLURM_PARTITION, "slurm-partition", 't', "", 0, 0, "partition of Slurm jobs")               \
	X(SLURM_ACCOUNT, "slurm-account", 't', "", 0, 0, "account of Slurm jobs")                     \
	X(SLURM_TIME, "slurm-time", 't', "", 0, 0, "time limit of Slurm jobs, as srun --time")        \
	X(SLURM_OPTIONS, "slurm-options", 't', "", 0, 0, "more options of srun, by blanks")           \
	X(WALL, "wall", 's', "0", 0, 1e8, "seconds one job may run; 0: no limit")                     \
	X(DISK_FLOOR, "disk-floor", 'i', "64", 0, 1 << 30,                                            \
	  "MiB that must be free where a job writes, beyond its output as far as known; 0: no limit") \
	X(RESUME, "resume", 'w', "auto", 0, 0,                                                        \
	  "jobs that ran when the service died: auto (go on), ask (are held), never (are lost)")      \
	X(HOOK, "hook", 't', "", 0, 0, "command run at the end of each job and of each group")        \
	X(BELL, "bell", 'w', "off", 0, 0, "ring the terminal at the end of run and wait: on, off")    \
	X(COLOR, "color", 'w', "auto", 0, 0, "auto, always or never")

#define X(name, key, type, def, min, max, help) SETTING_##name,
enum setting { SETTINGS_MAP(X) N_SETTINGS };
#undef X

struct setting_row {
	const char *key;
	char type;
	const char *def;
	double min, max;
	const char *help;
};
extern const struct setting_row settings_table[N_SETTINGS];

struct settings {
	char *value[N_SETTINGS];  /* owned */
	char *source[N_SETTINGS]; /* owned; "default", a file, "environment" */
};

/* Errors: ST_PARAMETER with file and line. p may be NULL (no project file). */
enum status settings_read(struct settings *s, const struct project *p, const struct report *r);
void settings_finish(struct settings *s);
double settings_number(const struct settings *s, enum setting which);

/* Write one value into the project's or (user) the user's file, other lines kept. */
enum status settings_write(const struct project *p, bool user, const char *key, const char *value,
                           const struct report *r);

#endif
