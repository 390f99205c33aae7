/* serve.c - the service of a project, in the foreground. */
#include "command.h"
#include "project.h"
#include "service.h"
#include "settings.h"
#include "verbs.h"

static int serve_run(const struct invocation *i)
{
	struct project p;
	struct settings s = { 0 };
	enum status st = project_find(&p, NULL, &i->report);

	if (st == ST_OK)
		st = project_make(&p, &i->report);
	if (st == ST_OK)
		st = settings_read(&s, &p, &i->report);
	if (st == ST_OK)
		st = service_run(&p, &s, &i->report);
	settings_finish(&s);
	project_finish(&p);
	return status_exit(st);
}

const struct command command_serve = {
	.name = "serve",
	.usage = "",
	.text = "run the service of this project",
	.help = "Every job verb starts the service by itself where none runs. It launches and watches the\n"
	        "workers and keeps the ledger; it ends when for 60 s (setting idle) nobody asks and nothing\n"
	        "is to be done. Only one can run in a project folder.",
	.run = serve_run,
};
