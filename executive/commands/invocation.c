/* invocation.c - a command line taken apart by the rows of its verb. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command.h"
#include "number.h"

const struct option_row option_common[] = {
	{ "--json", NULL, NULL, "print one JSON object on standard output" },
	{ "--color", NULL, "WHEN",
	  "auto, always or never (auto: on a terminal, not with NO_COLOR set)" },
	{ "--help", "-h", NULL, "show this help" },
	{ 0 },
};

/* -1.5 and - are words, -o and --into are options. */
static bool is_option(const char *word)
{
	return word[0] == '-' && word[1] && !strchr("0123456789.", word[1]);
}

static int find_row(const struct option_row *rows, const char *name, size_t n)
{
	for (int i = 0; rows && rows[i].name; i++)
		if ((strlen(rows[i].name) == n && !strncmp(rows[i].name, name, n)) ||
		    (rows[i].letter && strlen(rows[i].letter) == n &&
		     !strncmp(rows[i].letter, name, n)))
			return i;
	return -1;
}

static bool wants_color(const char *when)
{
	const char *none = getenv("NO_COLOR");

	if (!strcmp(when, "always"))
		return true;
	return strcmp(when, "never") && !(none && *none) && isatty(STDOUT_FILENO);
}

static bool is_yes_or_no(const char *word)
{
	return strcmp(word, "yes") == 0 || strcmp(word, "no") == 0;
}

/* Take one option at argv[*at]; *at ends on the last word taken. */
static enum status take_option(struct invocation *i, int argc, char **argv, int *at,
                               const char **when)
{
	const char *word = argv[*at], *equals = strchr(word, '=');
	size_t n = equals ? (size_t)(equals - word) : strlen(word);
	int own = find_row(i->command->options, word, n), common = find_row(option_common, word, n);
	bool takes;

	if (own >= 0)
		takes = i->command->options[own].value != NULL;
	else if (common >= 0)
		takes = option_common[common].value != NULL;
	else if (i->command->takes_value && n > 2 && word[1] == '-')
		takes = !equals && i->command->takes_value(i, word + 2) ? true : equals != NULL;
	else
		return report_error(&i->report, ST_PARAMETER,
		                    "unknown option '%.*s'; see batten %s --help", (int)n, word,
		                    i->command->name);
	const char *value = "";
	if (equals && takes)
		value = equals + 1;
	else if (equals)
		return report_error(&i->report, ST_PARAMETER, "option '%.*s' takes no value",
		                    (int)n, word);
	else if (takes) {
		if (++*at >= argc)
			return report_error(&i->report, ST_PARAMETER, "option '%s' needs a value",
			                    word);
		value = argv[*at];
	}
	/* --color #3070A0 is a worker's, --color never ours */
	if (common >= 0 && i->command->takes_value && value[0] == '#')
		common = -1;
	if (own >= 0)
		i->values[own] = value;
	else if (common >= 0) {
		if (!strcmp(option_common[common].name, "--json"))
			i->json = true;
		else if (!strcmp(option_common[common].name, "--color"))
			*when = value;
	} else {
		char *name = strndup(word + 2, n - 2);
		if (!name)
			return report_error(&i->report, ST_RESOURCE, "memory ran out");
		/* a worker's flag may say which: --trimmed no */
		if (!takes)
			value = *at + 1 < argc && is_yes_or_no(argv[*at + 1]) ? argv[++*at] : "yes";
		i->extra[2 * i->n_extra] = name;
		i->extra[2 * i->n_extra + 1] = strdup(value);
		i->n_extra++;
	}
	return ST_OK;
}

enum status invocation_parse(struct invocation *i, const struct command *c, int argc, char **argv)
{
	const char *when = "auto";
	enum status st = ST_OK;

	i->command = c;
	i->words = calloc((size_t)argc + 1, sizeof *i->words);
	i->extra = calloc(2 * (size_t)argc + 2, sizeof *i->extra);
	if (!i->words || !i->extra)
		return report_error(&i->report, ST_RESOURCE, "memory ran out");
	bool only_words = false;
	for (int at = 0; at < argc && st == ST_OK; at++) {
		if (!only_words && !strcmp(argv[at], "--"))
			only_words = true;
		else if (!only_words && is_option(argv[at]))
			st = take_option(i, argc, argv, &at, &when);
		else
			i->words[i->n_words++] = argv[at];
	}
	if (st == ST_OK && strcmp(when, "auto") && strcmp(when, "always") && strcmp(when, "never"))
		st = report_error(&i->report, ST_PARAMETER,
		                  "--color is '%s'; it can be auto, always or never", when);
	i->color = wants_color(when);
	return st;
}

void invocation_finish(struct invocation *i)
{
	for (int k = 0; i->extra && k < 2 * i->n_extra; k++)
		free(i->extra[k]);
	free(i->extra);
	free(i->words);
	i->extra = i->words = NULL;
}

const char *invocation_value(const struct invocation *i, const char *option)
{
	int row = find_row(i->command->options, option, strlen(option));

	return row < 0 ? NULL : i->values[row];
}

bool invocation_flag(const struct invocation *i, const char *option)
{
	return invocation_value(i, option) != NULL;
}

enum status invocation_integer(const struct invocation *i, const char *option, long min, long max,
                               long fallback, long *out)
{
	const char *value = invocation_value(i, option);
	int64_t x = fallback;

	if (value && (!number_parse_integer(value, &x) || x < min || x > max))
		return report_error(&i->report, ST_PARAMETER,
		                    "%s is '%s'; it must be a whole number from %ld to %ld", option,
		                    value, min, max);
	*out = (long)x;
	return ST_OK;
}
