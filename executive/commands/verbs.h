/* verbs.h - the record of each verb; each is at the end of the file of that name. */
#ifndef BATTEN_VERBS_H
#define BATTEN_VERBS_H

#include "command.h"

extern const struct command command_activate;
extern const struct command command_config;
extern const struct command command_doctor;
extern const struct command command_eval;
extern const struct command command_export;
extern const struct command command_help_verb;
extern const struct command command_hold;
extern const struct command command_import;
extern const struct command command_info;
extern const struct command command_jobs;
extern const struct command command_kill;
extern const struct command command_log;
extern const struct command command_priority;
extern const struct command command_prune;
extern const struct command command_release;
extern const struct command command_render;
extern const struct command command_retry;
extern const struct command command_routines;
extern const struct command command_run;
extern const struct command command_script;
extern const struct command command_serve;
extern const struct command command_shutdown;
extern const struct command command_submit;
extern const struct command command_suspend;
extern const struct command command_wait;
extern const struct command command_workers;

#endif
