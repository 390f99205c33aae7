/* routines.c - the leaves of the menus. */
#include "editor_program.h"
#include "verbs.h"

static int routines_run(const struct invocation *i)
{
	const char *words[5] = { NULL, "--routines" };
	int n = 2;

	if (i->json)
		words[n++] = "--json";
	if (i->n_words > 1)
		return status_exit(
		        report_error(&i->report, ST_PARAMETER, "name one code, or none"));
	if (i->n_words)
		words[n++] = i->words[0];
	words[n] = NULL;
	return editor_program_become((char **)(size_t)words, &i->report);
}

const struct command command_routines = {
	.name = "routines",
	.usage = "[CODE]",
	.text = "list the routines of the menus, and what each asks for",
	.help = "Each leaf of the menus has a code (V79), by which a script calls it. With a code: its arguments.\n"
	        "Those that a later version will have are listed, too, and cannot be run.",
	.run = routines_run,
};
