/* shutdown.c - end the service. */
#include "connection.h"
#include "verbs.h"

static int shutdown_run(const struct invocation *i)
{
	struct project p;
	bool ran = false;
	enum status st = project_find(&p, NULL, &i->report);

	if (st == ST_OK)
		st = client_shutdown(&p, &ran, &i->report);
	project_finish(&p);
	if (st != ST_OK)
		return status_exit(st);
	if (i->json)
		return print_json(json_pack("{s:b}", "running", (int)ran));
	puts(ran ? "The service ends; running jobs go on at the next start."
	         : "No service runs here.");
	return 0;
}

const struct command command_shutdown = {
	.name = "shutdown",
	.usage = "",
	.text = "end the service of this project",
	.help = "Running jobs stop at a unit and are queued for the next start. Any job verb starts the\n"
	        "service again.",
	.run = shutdown_run,
};
