/* connection.c - what the verbs that talk to the service share. */
#include "connection.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "json.h"
#include "number.h"
#include "settings.h"

enum status connection_open(struct connection *c, const struct invocation *i, bool start)
{
	*c = (struct connection){ 0 };
	enum status st = project_find(&c->project, NULL, &i->report);
	if (st == ST_OK)
		st = project_check(&c->project, &i->report);
	if (st == ST_OK && start)
		st = project_make(&c->project, &i->report);
	if (st == ST_OK)
		st = client_connect(&c->client, &c->project, start, &i->report);
	if (st != ST_OK)
		connection_close(c);
	return st;
}

void connection_close(struct connection *c)
{
	client_close(c->client);
	project_finish(&c->project);
	*c = (struct connection){ 0 };
}

void connection_bell(const struct connection *c)
{
	struct settings s;

	if (!isatty(STDERR_FILENO) || settings_read(&s, &c->project, NULL) != ST_OK)
		return;
	if (!strcmp(s.value[SETTING_BELL], "on"))
		fputc('\a', stderr);
	settings_finish(&s);
}

enum status connection_selection(const struct invocation *i, bool need, json_t **body)
{
	const char *group = invocation_value(i, "--group");
	bool all = invocation_flag(i, "--all");
	int ways = (i->n_words > 0) + (group != NULL) + (all && need);

	if (ways > 1)
		return report_error(&i->report, ST_PARAMETER,
		                    "name jobs by id, by --group or by --all, in one way only");
	if (need && !ways)
		return report_error(&i->report, ST_PARAMETER,
		                    "no job is named; give ids, --group G or --all");
	json_t *o = json_object(), *jobs = i->n_words ? json_array() : NULL;
	for (int k = 0; k < i->n_words; k++) {
		int64_t id;
		if (!number_parse_integer(i->words[k], &id) || id < 1) {
			json_decref(o);
			json_decref(jobs);
			return report_error(&i->report, ST_PARAMETER,
			                    "'%s' is no job; a job is named by its number",
			                    i->words[k]);
		}
		json_array_append_new(jobs, json_integer(id));
	}
	if (jobs)
		json_object_set_new(o, "jobs", jobs);
	if (group)
		json_set_text(o, "group", group);
	if (all)
		json_object_set_new(o, "all", json_true());
	*body = o;
	return o ? ST_OK : report_error(&i->report, ST_RESOURCE, "memory ran out");
}
