/* serve.c - the service of a project, in the foreground. */
#include "at_login.h"
#include "command.h"
#include "project.h"
#include "service.h"
#include "settings.h"
#include "verbs.h"

static const struct option_row serve_options[] = {
	{ "--at-login", NULL, NULL, "do not serve now: have systemd do so at each login" },
	{ "--not-at-login", NULL, NULL, "take that back" },
	{ 0 },
};

static enum status serve(const struct project *p, const struct report *r)
{
	struct settings s = { 0 };
	enum status st = settings_read(&s, p, r);

	if (st == ST_OK)
		st = service_run(p, &s, r);
	settings_finish(&s);
	return st;
}

static int serve_run(const struct invocation *i)
{
	struct project p;
	enum status st = project_find(&p, NULL, &i->report);

	if (st == ST_OK)
		st = project_check(&p, &i->report);
	if (st == ST_OK)
		st = project_make(&p, &i->report);
	if (st == ST_OK && invocation_flag(i, "--at-login"))
		st = at_login_write(&p, &i->report);
	else if (st == ST_OK && invocation_flag(i, "--not-at-login"))
		st = at_login_remove(&p, &i->report);
	else if (st == ST_OK)
		st = serve(&p, &i->report);
	project_finish(&p);
	return status_exit(st);
}

const struct command command_serve = {
	.name = "serve",
	.usage = "[--at-login|--not-at-login]",
	.text = "run the service of this project",
	.help = "Every job verb starts the service by itself where none runs. It launches and watches the\n"
	        "workers and keeps the ledger; it ends when for 60 s (setting idle) nobody asks and nothing\n"
	        "is to be done. Only one can run in a project folder. --at-login writes a unit of systemd\n"
	        "for this user, so that jobs go on after a reboot; 'loginctl enable-linger' has that happen\n"
	        "without a login.",
	.options = serve_options,
	.run = serve_run,
};
