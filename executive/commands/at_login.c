/* at_login.c - the unit that has systemd start a project's service at each login of its user. */
#include "at_login.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "file.h"
#include "path.h"
#include "text.h"

/* Where the unit is, and the link that enables it (what `systemctl --user enable` makes). */
struct unit {
	char *name, *folder, *path, *wants, *link; /* owned */
};

static void unit_finish(struct unit *u)
{
	free(u->name);
	free(u->folder);
	free(u->path);
	free(u->wants);
	free(u->link);
}

static enum status unit_init(struct unit *u, const struct project *p, const struct report *r)
{
	const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");

	*u = (struct unit){ .name = text_print("batten-%s.service", path_file_name(p->socket)) };
	u->folder = config && config[0] == '/'
	                    ? text_print("%s/systemd/user", config)
	                    : text_print("%s/.config/systemd/user", home && *home ? home : "/");
	if (u->name && u->folder) {
		u->path = path_join(u->folder, u->name);
		u->wants = path_join(u->folder, "default.target.wants");
	}
	if (u->wants)
		u->link = path_join(u->wants, u->name);
	if (u->path && u->link)
		return ST_OK;
	unit_finish(u);
	return report_error(r, ST_RESOURCE, "cannot write the unit: memory ran out");
}

/* % and, between quotes, \ and " have a meaning of their own; so has $ in a command. */
static void add_escaped(struct text *t, const char *s, bool command)
{
	for (; *s; s++) {
		if (*s == '%' || (command && *s == '$'))
			text_addf(t, "%c", *s);
		else if (command && (*s == '"' || *s == '\\'))
			text_add(t, "\\");
		text_addf(t, "%c", *s);
	}
}

static enum status unit_text(struct text *t, const struct project *p, const struct report *r)
{
	char *program = path_of_program(), *batten = program ? path_join(program, "batten") : NULL;

	if (batten) {
		text_add(
		        t,
		        "# written by batten serve --at-login\n[Unit]\nDescription=batten jobs in ");
		add_escaped(t, p->folder, false);
		text_add(t, "\n\n[Service]\nWorkingDirectory=");
		add_escaped(t, p->folder, false);
		text_add(t, "\nExecStart=\"");
		add_escaped(t, batten, true);
		/* at SIGTERM what runs stops at a unit */
		text_add(t, "\" serve\nKillMode=mixed\nTimeoutStopSec=10\n"
		            "\n[Install]\nWantedBy=default.target\n");
	}
	enum status st = batten && !t->failed ? ST_OK : ST_RESOURCE;
	if (st != ST_OK)
		report_error(r, st, "cannot write the unit: memory ran out");
	else if (strchr(p->folder, '\n'))
		st = report_error(r, ST_INPUT,
		                  "the name of the folder '%s' has a line break: no "
		                  "unit can name it",
		                  p->folder);
	free(program);
	free(batten);
	return st;
}

enum status at_login_write(const struct project *p, const struct report *r)
{
	struct unit u;
	struct text t = { 0 };
	enum status st = unit_init(&u, p, r);

	if (st != ST_OK)
		return st;
	st = unit_text(&t, p, r);
	if (st == ST_OK)
		st = folder_make(u.wants, 0777, r);
	if (st == ST_OK)
		st = file_write(u.path, t.s, t.n, r);
	if (st == ST_OK && symlink(u.path, u.link) && errno != EEXIST)
		st = report_error(r, ST_RESOURCE, "cannot make the link '%s': %s", u.link,
		                  strerror(errno));
	if (st == ST_OK)
		printf("%s\n", u.path);
	text_finish(&t);
	unit_finish(&u);
	return st;
}

enum status at_login_remove(const struct project *p, const struct report *r)
{
	struct unit u;
	enum status st = unit_init(&u, p, r);

	if (st != ST_OK)
		return st;
	unlink(u.link);
	if (unlink(u.path))
		st = report_error(r, ST_INPUT, "cannot take away '%s': %s", u.path,
		                  strerror(errno));
	unit_finish(&u);
	return st;
}
