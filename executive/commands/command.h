/* command.h - a verb of `batten`: one file, one record; the table in command.c lists them. */
#ifndef BATTEN_COMMAND_H
#define BATTEN_COMMAND_H

#include <stdbool.h>

#include "report.h"

/* An option of a verb; help, completion and man page come from these rows. */
struct option_row {
	const char *name;  /* "--json"; NULL ends the list */
	const char *short_name; /* "-o" or NULL */
	const char *value; /* "NAME": it takes one; NULL: a flag */
	const char *help;
};

/* What a verb was called with. */
struct invocation {
	const struct command *command;
	int argc; /* words that are no options */
	char **argv;
	const char **values;  /* value of each option row, "" for a flag, NULL where not given */
	const char *const *extra; /* "--name", "value" pairs that the verb lets through */
	int n_extra;
	bool json, color;
	struct report report; /* standard error */
};

struct command {
	const char *name, *usage, *text; /* text: one line; */
	const char *help;                /* paragraphs for --help and the man page */
	const struct option_row *options;
	bool lets_through; /* run and submit: unknown --name value are worker parameters */
	const char *words; /* what completion offers: "job", "file", "worker", "topic" or NULL */
	int (*run)(const struct invocation *i); /* exit status */
};

extern const struct command *const command_table[];
extern const int command_table_size;
const struct command *command_find(const char *name);

/* Value of an option, NULL where not given. */
const char *invocation_value(const struct invocation *i, const char *option);
bool invocation_flag(const struct invocation *i, const char *option);

#endif
