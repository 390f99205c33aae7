/* work_order.h - from a worker's name, parameters and inputs to jobs that the service takes; for the verbs
 * and the editor. */
#ifndef BATTEN_WORK_ORDER_H
#define BATTEN_WORK_ORDER_H

#include "client.h"
#include "roster.h"
#include "text.h"

/* One entity that a job reads. All texts are borrowed. */
struct work_input {
	const char *path;      /* .batten/inputs/HASH.base */
	const char *file_name; /* as the user named its file; the results' name without -o */
	const char *path_name; /* absolute */
	int64_t number;        /* behind the results' name, of several of one file */
	bool alone;            /* the only one named of its file */
};

/* What is to be done; a zeroed one has all defaults. All texts and objects are borrowed. */
struct work_order {
	const char *worker;
	json_t *parameters; /* object of texts, as on the command line */
	const struct work_input *inputs;
	size_t n_inputs;
	const char *output; /* basic name, or whole file name; NULL: that of the input */
	const char *folder; /* what output is relative to; NULL: the current folder */
	const char *group;
	json_t *after, *after_any; /* ids, or NULL */
	double wall_s;             /* 0: as the settings say */
	long priority, threads, memory_mib, shards;
	const char *on, *partition, *account, *time; /* NULL: as the settings say */
	bool force;
	/* set by work_order_check */
	struct roster roster;
	const struct roster_worker *found; /* in roster */
	char *place;                       /* owned: name of the launcher */
};

/*
 * Look for the worker, check parameters and place against it. Errors: ST_PARAMETER, ST_INPUT (a worker that
 * is broken). work_order_finish in any case.
 */
enum status work_order_check(struct work_order *o, const struct project *p, const struct report *r);

/* A text for a job's record, which is JSON. ST_PARAMETER where it is no UTF-8; NULL is none, and good. */
enum status work_text_check(const char *what, const char *text, const struct report *r);

/*
 * Submit what was checked: a scene as one job, otherwise a job an input, as a group. Each new job goes to
 * on_job. Errors: ST_PARAMETER (results of the same name), the service's.
 */
enum status work_order_send(const struct work_order *o, struct client *c, client_job *on_job,
                            void *data, const struct report *r);
void work_order_finish(struct work_order *o);

/*
 * Keep the text of a .base file as what jobs read: FOLDER/inputs/HASH.base (FOLDER: .batten). Written once;
 * what is there already is made young again, so that prune leaves it until it is submitted.
 * *path is fresh. Errors: ST_INPUT, ST_RESOURCE.
 */
enum status work_input_keep(const char *folder, const struct text *t, char **path,
                            const struct report *r);

#endif
