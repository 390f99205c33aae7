/* script.c - routines from a file. */
#include "editor_program.h"
#include "verbs.h"

static const struct option_row script_options[] = {
	{ "--keep-going", NULL, NULL, "go on behind a line that fails" },
	{ "--journal", NULL, NULL, "write what is done to .batten/journal, too" },
	{ 0 },
};

static int script_run_verb(const struct invocation *i)
{
	const char *words[6] = { NULL, "--script" };
	int n = 2;

	if (i->n_words != 1)
		return status_exit(report_error(&i->report, ST_PARAMETER,
		                                "name one script, or - for standard input"));
	words[n++] = i->words[0];
	if (invocation_flag(i, "--keep-going"))
		words[n++] = "--keep-going";
	if (invocation_flag(i, "--journal"))
		words[n++] = "--journal";
	words[n] = NULL;
	return editor_program_become((char **)(size_t)words, &i->report);
}

const struct command command_script = {
	.name = "script",
	.usage = "FILE|- [--keep-going]",
	.text = "run routines, one a line",
	.help = "A line is CODE KEY=VALUE..., a comment begins with #. Values with blanks stand in \"...\", with\n"
	        "\\\" inside; lists and points by comma, rows by semicolon; surfaces by name or FILE#ENTITY.\n"
	        "Routines that start a job wait for its end, unless wait=no is given. `batten routines` lists\n"
	        "the codes. A line that fails is told with its number, and the script ends there.",
	.options = script_options,
	.first_word = WORD_FILE,
	.run = script_run_verb,
};
