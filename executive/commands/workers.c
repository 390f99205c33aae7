/* workers.c - the workers there are. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "json.h"
#include "roster.h"
#include "verbs.h"

static json_t *worker_json(const struct roster_worker *w)
{
	static const char *const keys[] = { "title", "version", "help",       "inputs",
		                            "scene", "shards",  "parameters", "outputs" };
	json_t *o = json_object();

	json_set_text(o, "name", w->name);
	for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
		json_t *v = json_object_get(w->description, keys[k]);
		json_object_set_new(o, keys[k], v ? json_incref(v) : json_null());
	}
	json_set_text(o, "path", w->path);
	json_set_text(o, "broken", w->broken);
	return o;
}

static int workers_run(const struct invocation *i)
{
	struct project p;
	struct roster roster = { 0 };
	enum status st = project_find(&p, NULL, &i->report);

	if (st == ST_OK)
		st = roster_read(&roster, &p, NULL, &i->report);
	int rc = status_exit(st);
	if (st == ST_OK && i->json) {
		json_t *all = json_array();
		for (int k = 0; k < roster.n; k++)
			json_array_append_new(all, worker_json(&roster.workers[k]));
		rc = print_json(json_pack("{s:o}", "workers", all));
	}
	for (int k = 0; st == ST_OK && !i->json && k < roster.n; k++) {
		const struct roster_worker *w = &roster.workers[k];
		printf("%-12s %s%s\n", w->name, w->broken ? "broken: " : "",
		       w->broken ? w->broken : json_text(w->description, "title", ""));
	}
	if (st == ST_OK && !i->json && roster.n)
		puts("\nbatten help WORKER shows its parameters.");
	roster_finish(&roster);
	project_finish(&p);
	return rc;
}

const struct command command_workers = {
	.name = "workers",
	.usage = "",
	.text = "list the workers, what they take and what they make",
	.help = "A worker is an executable batten-NAME that describes itself: beside the program, in\n"
	        "$BATTEN_WORKER_PATH, in .batten/workers or in ~/.config/batten/workers.",
	.run = workers_run,
};
