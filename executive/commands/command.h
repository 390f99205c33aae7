/* command.h - a verb of `batten`: one file, one record; the table in command.c lists them.
 * Help, man page and completion come from the records. */
#ifndef BATTEN_COMMAND_H
#define BATTEN_COMMAND_H

#include <stdbool.h>

#include "report.h"

/* An option of a verb. */
struct option_row {
	const char *name;   /* "--into"; NULL ends the list */
	const char *letter; /* "-o" or NULL */
	const char *value;  /* what it takes, "DIR"; NULL: a flag */
	const char *help;   /* one sentence, no capital, no full stop */
};

struct command;

enum { OPTIONS_MAX = 24 };

/* What a verb was called with. Everything is borrowed from main. */
struct invocation {
	const struct command *command;
	char **words; /* what is no option */
	int n_words;
	const char *values[OPTIONS_MAX]; /* of each option row: "" for a flag, NULL: not given */
	char **extra; /* name, value, name, value of options let through; names without dashes */
	int n_extra;  /* pairs */
	bool json, color;
	struct report report; /* standard error */
};

/* What completion offers for words. */
enum word_kind { WORD_NONE, WORD_FILE, WORD_JOB, WORD_WORKER, WORD_TOPIC };

struct command {
	const char *name, *usage; /* usage: what follows the name */
	const char *text;         /* one line */
	const char *help;         /* paragraphs */
	const struct option_row *options;
	enum word_kind first_word, words;
	/* Of a verb that lets unknown options through to a worker: does this one take a value? NULL:
	 * unknown options are errors. */
	bool (*takes_value)(const struct invocation *i, const char *option);
	int (*run)(const struct invocation *i); /* exit status */
};

extern const struct command *const command_table[]; /* ends with NULL, by name */
const struct command *command_find(const char *name);

/* Value of an option, NULL where it was not given; a row of that name must exist. */
const char *invocation_value(const struct invocation *i, const char *option);
bool invocation_flag(const struct invocation *i, const char *option);
/* An option's whole number, or `fallback`. Errors: ST_PARAMETER. */
enum status invocation_integer(const struct invocation *i, const char *option, long min, long max,
                               long fallback, long *out);

/*
 * Take a command line apart (words behind the verb). The arrays of *i are allocated here;
 * invocation_finish frees them. Errors: ST_PARAMETER (unknown option, value missing).
 */
enum status invocation_parse(struct invocation *i, const struct command *c, int argc, char **argv);
void invocation_finish(struct invocation *i);

/* --help of one verb, of the program; a man page in roff; the completion for bash. On out. */
#include <stdio.h>
void command_help(const struct command *c, FILE *out);
void program_help(FILE *out);
void command_man(const struct command *c, FILE *out); /* NULL: the program's */
void program_completion(FILE *out);

/* Options every verb has. */
extern const struct option_row option_common[];

/* Print an object with "version": 1 put first; o is stolen. Exit status. */
#include <jansson.h>
int print_json(json_t *o);

#endif
