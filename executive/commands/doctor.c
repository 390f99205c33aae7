/* doctor.c - does everything that batten needs work here? */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "client.h"
#include "command.h"
#include "json.h"
#include "parallel.h"
#include "path.h"
#include "roster.h"
#include "settings.h"
#include "text.h"
#include "verbs.h"

enum verdict { GOOD, NOTE, BAD };

struct examination {
	struct project project;
	json_t *findings;
	bool bad;
};

static const char *const verdict_words[] = { [GOOD] = "ok", [NOTE] = "note", [BAD] = "bad" };

/* text is a fresh string, freed here. */
static void find(struct examination *x, enum verdict v, const char *what, char *text)
{
	x->bad |= v == BAD;
	json_array_append_new(x->findings,
	                      json_pack("{s:s, s:s, s:s}", "what", what, "verdict",
	                                verdict_words[v], "text", text ? text : "memory ran out"));
	free(text);
}

static void examine_processor(struct examination *x)
{
	find(x, GOOD, "processor",
	     text_print("%d usable, vector level %s", parallel_processors(), vector_level()));
}

static void examine_project(struct examination *x)
{
	bool there = path_exists(x->project.hidden);

	if (!there)
		find(x, NOTE, "project",
		     text_print("%s has no .batten yet; the first job makes it",
		                x->project.folder));
	else if (access(x->project.hidden, W_OK))
		find(x, BAD, "project",
		     text_print("%s cannot be written: %s; give yourself write permission",
		                x->project.hidden, strerror(errno)));
	else
		find(x, GOOD, "project", text_print("%s", x->project.folder));
}

static void examine_disk(struct examination *x)
{
	struct statvfs v;

	if (statvfs(x->project.folder, &v)) {
		find(x, BAD, "disk", text_print("%s: %s", x->project.folder, strerror(errno)));
		return;
	}
	double gib = (double)v.f_bavail * (double)v.f_frsize / (1 << 30);
	find(x,
	     gib < 0.1 ? BAD
	     : gib < 1 ? NOTE
	               : GOOD,
	     "disk",
	     text_print("%.1f GiB free%s", gib, gib < 1 ? "; make room before long jobs" : ""));
}

static void examine_settings(struct examination *x)
{
	struct settings s = { 0 };
	struct report_store store;

	report_store_init(&store);
	if (settings_read(&s, &x->project, &store.report) == ST_OK)
		find(x, GOOD, "settings", text_print("read"));
	else
		find(x, BAD, "settings", text_print("%s", store.error));
	settings_finish(&s);
}

static void examine_workers(struct examination *x)
{
	struct roster roster = { 0 };
	struct report_store store;

	report_store_init(&store);
	if (roster_read(&roster, &x->project, NULL, &store.report) != ST_OK)
		find(x, BAD, "workers", text_print("%s", store.error));
	else if (!roster.n)
		find(x, BAD, "workers",
		     text_print("none found beside the program; build or install batten"));
	for (int k = 0; k < roster.n; k++) {
		const struct roster_worker *w = &roster.workers[k];
		char *name = text_print("worker %s", w->name);
		find(x, w->broken ? BAD : GOOD, name ? name : "worker",
		     text_print("%s", w->broken ? w->broken : w->path));
		free(name);
	}
	roster_finish(&roster);
}

static void examine_service(struct examination *x)
{
	struct client *client = NULL;
	struct report_store store;

	report_store_init(&store);
	if (client_connect(&client, &x->project, false, &store.report) == ST_OK)
		find(x, GOOD, "service", text_print("answers at %s", x->project.socket));
	else if (store.status == ST_INPUT)
		find(x, BAD, "service", text_print("%s", store.error));
	else
		find(x, NOTE, "service", text_print("does not run; the first job verb starts it"));
	client_close(client);
}

static int doctor_run(const struct invocation *i)
{
	static void (*const examinations[])(struct examination *) = {
		examine_processor, examine_project, examine_disk,
		examine_settings,  examine_workers, examine_service,
	};
	struct examination x = { .findings = json_array() };
	enum status st = project_find(&x.project, NULL, &i->report);

	if (st != ST_OK || !x.findings)
		return status_exit(st);
	for (size_t k = 0; k < sizeof examinations / sizeof *examinations; k++)
		examinations[k](&x);
	int rc = x.bad ? 1 : 0;
	size_t k;
	json_t *f;
	json_array_foreach(x.findings, k, f) if (!i->json)
	        printf("%-5s %-18s %s\n", json_text(f, "verdict", ""), json_text(f, "what", ""),
	               json_text(f, "text", ""));
	if (i->json && print_json(json_pack("{s:O}", "findings", x.findings)))
		rc = 1;
	json_decref(x.findings);
	project_finish(&x.project);
	return rc;
}

const struct command command_doctor = {
	.name = "doctor",
	.usage = "",
	.text = "say whether everything batten needs works here",
	.help = "Exit status 1 where something is bad, and what to do about it.",
	.run = doctor_run,
};
