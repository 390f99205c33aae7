/* shutdown.c - end the service. */
#include "connection.h"
#include "verbs.h"

static int shutdown_run(const struct invocation *i)
{
	struct project p;
	struct client *client = NULL;
	struct report_store quiet;
	enum status st = project_find(&p, NULL, &i->report);

	if (st != ST_OK)
		return status_exit(st);
	report_store_init(&quiet);
	st = client_connect(&client, &p, false, &quiet.report);
	bool ran = st == ST_OK;
	if (ran)
		st = client_request(client, MESSAGE_SHUTDOWN, json_object(), NULL, NULL, NULL,
		                    &i->report);
	else if (st == ST_RESOURCE)
		st = ST_OK;
	else
		report_error(&i->report, st, "%s", quiet.error);
	client_close(client);
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
