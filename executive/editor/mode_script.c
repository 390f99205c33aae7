/* mode_script.c - routines from a file, without a window. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "modes.h"
#include "path.h"
#include "reading_child.h"
#include "routine.h"

static atomic_bool interrupted;

static void on_signal(int number)
{
	(void)number;
	atomic_store(&interrupted, true);
}

static void say(void *data, const char *text)
{
	(void)data;
	puts(text);
	fflush(stdout);
}

/* The first Ctrl-C ends the step that runs; the second one ends the program. */
static void listen_to_signals(void)
{
	const struct sigaction a = { .sa_handler = on_signal, .sa_flags = SA_RESETHAND };

	sigaction(SIGINT, &a, NULL);
	sigaction(SIGTERM, &a, NULL);
	signal(SIGPIPE, SIG_IGN);
}

static void tell_unsaved(const struct world *w, const struct report *r)
{
	for (int k = 0; k < world_count(w); k++)
		if (!world_at(w, k)->saved)
			report_warning(r, "'%s' was not saved; V176 saves it",
			               world_at(w, k)->name);
}

int mode_script(int argc, char **argv)
{
	const struct report r = report_stderr("batten");
	struct project project = { 0 };
	struct reading_child reading = { NULL };
	struct world *world = NULL;
	bool keep_going = false, journal = false;
	int failed = 0;

	for (int k = 1; k < argc; k++) {
		keep_going |= !strcmp(argv[k], "--keep-going");
		journal |= !strcmp(argv[k], "--journal");
	}
	if (argc < 1)
		return status_exit(
		        report_error(&r, ST_PARAMETER, "name a script, or - for standard input"));
	listen_to_signals();
	enum status st = project_find(&project, NULL, &r);
	if (st == ST_OK) {
		/* names in a script are relative to where it is run */
		char *here = path_absolute(".", NULL);
		st = here ? world_create(&world, here) : ST_RESOURCE;
		free(here);
	}
	if (st == ST_OK) {
		world_set_reader(world, reading_child, &reading);
		struct act a = { .world = world,
			         .project = &project,
			         .report = r,
			         .say = say,
			         .stop = &interrupted,
			         .wait = true,
#ifdef BATTEN_VIEW
			         .picture = editor_picture,
#endif
			         .journal = journal };
		st = script_run(&a, argv[0], keep_going, &failed);
		tell_unsaved(world, &r);
	}
	world_destroy(world);
	project_finish(&project);
	return atomic_load(&interrupted) ? status_exit(ST_CANCELLED) : status_exit(st);
}
