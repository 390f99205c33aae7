/* each.c - the verbs that do one thing to each job named. */
#include "each.h"

#include "connection.h"
#include "path.h"

const struct option_row each_options[] = {
	{ "--all", NULL, NULL, "all jobs it can be done to" },
	{ "--group", NULL, "G", "the jobs of a group" },
	{ 0 },
};

int each_job(const struct invocation *i, enum message_type type, json_t *more)
{
	struct connection c;
	struct job_list list = { 0 };
	json_t *body = NULL;
	bool all = json_is_true(json_object_get(more, "all"));
	enum status st = connection_selection(i, !all, &body);

	if (st == ST_OK && more)
		json_object_update(body, more);
	json_decref(more);
	if (st == ST_OK) {
		st = connection_open(&c, i, true);
		if (st != ST_OK)
			json_decref(body);
	}
	if (st != ST_OK)
		return status_exit(st);
	st = client_request(c.client, type, body, job_list_add, NULL, &list, &i->report);
	int rc = status_exit(st);
	if (st == ST_OK && i->json)
		rc = job_list_print_json(&list);
	else if (st == ST_OK)
		for (size_t k = 0; k < list.n; k++)
			printf("%lld %s\n", (long long)list.jobs[k].id,
			       job_state_table[list.jobs[k].state].word);
	job_list_finish(&list);
	connection_close(&c);
	return rc;
}
