/* help.c - help of a verb, a worker, a topic, or a routine of the editor. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "help_routines.h"
#include "json.h"
#include "roster.h"
#include "stats.h"
#include "text.h"
#include "verbs.h"

static const struct topic {
	const char *name, *text;
} topics[] = {
	{ "files",
	  "Geometry is read from IGES files and from .base files (docs/formats.md). Results are named\n"
	  "after the input: hull.igs gives hull.shade.exr, hull.map.exr, hull.isophote, hull.trace.exr,\n"
	  "and pictures hull.shade.png and so on. A result appears under its name only when it is whole." },
	{ "entities",
	  "FILE#3 is the third entity that batten info FILE lists, FILE#NAME the one of that name,\n"
	  "FILE#D15 the one at IGES Directory Entry 15. FILE alone means all its surfaces." },
	{ "project",
	  "The project is the nearest folder upward that holds .batten/, else the current one. Ledger,\n"
	  "inputs, part files, job files and logs lie in .batten/; everything else is yours." },
};
enum { N_TOPICS = sizeof topics / sizeof *topics };

static const char states_topic[] = "states";

static void print_states(void)
{
	static const char *const meaning[N_JOB_STATES] = {
		[JOB_QUEUED] = "waits for its turn",
		[JOB_HELD] = "waits until it is released",
		[JOB_STARTING] = "its worker has been started",
		[JOB_RUNNING] = "its worker computes",
		[JOB_SUSPENDED] = "its worker stands still until it is activated",
		[JOB_ENDING] = "it was killed and its worker is about to end",
		[JOB_DONE] = "its results are in place",
		[JOB_FAILED] = "it ended without its results; the reason says why and what to do",
		[JOB_KILLED] = "somebody ended it; retry goes on from its part file",
		[JOB_LOST] = "what became of it cannot be known",
	};

	for (int k = 0; k < N_JOB_STATES; k++)
		printf("%s %-10s %s\n", job_state_table[k].glyph, job_state_table[k].word,
		       meaning[k]);
}

static void print_worker(const json_t *d)
{
	size_t k;
	json_t *row;

	printf("%s: %s\n\n%s\n\nparameters:\n", json_text(d, "name", ""), json_text(d, "title", ""),
	       json_text(d, "help", ""));
	json_array_foreach(json_object_get(d, "parameters"), k, row)
	{
		const char *def = json_text(row, "default", NULL),
		           *unit = json_text(row, "unit", NULL);
		const char *choices = json_text(row, "choices", NULL);
		printf("  --%-14s %s", json_text(row, "name", ""), json_text(row, "help", ""));
		if (choices)
			printf("; one of %s", choices);
		if (def)
			printf(" (%s%s%s)", def, unit ? " " : "", unit ? unit : "");
		else if (unit)
			printf(" (%s)", unit);
		putchar('\n');
	}
	puts("\nresults:");
	json_array_foreach(json_object_get(d, "outputs"), k, row)
	{
		const char *when = json_text(row, "when", NULL);
		printf("  NAME%-14s %s%s%s\n", json_text(row, "extension", ""),
		       json_text(row, "kind", ""), when ? ", with --" : "", when ? when : "");
	}
}

/* A worker's description; NULL where there is no such worker. */
static json_t *find_worker(const char *name, const struct report *r)
{
	struct project p;
	struct roster roster = { 0 };
	json_t *found = NULL;

	if (project_find(&p, NULL, r) != ST_OK)
		return NULL;
	if (roster_read(&roster, &p, name, r) == ST_OK) {
		const struct roster_worker *w = roster_find(&roster, name);
		if (w && !w->broken)
			found = json_incref(w->description);
	}
	roster_finish(&roster);
	project_finish(&p);
	return found;
}

static int list_all(bool json)
{
	json_t *all = json_array();

	for (int k = 0; command_table[k]; k++)
		json_array_append_new(all,
		                      json_pack("{s:s, s:s, s:s}", "topic", command_table[k]->name,
		                                "kind", "verb", "text", command_table[k]->text));
	for (int k = 0; k < N_TOPICS; k++)
		json_array_append_new(all, json_pack("{s:s, s:s, s:s}", "topic", topics[k].name,
		                                     "kind", "topic", "text", topics[k].text));
	json_array_append_new(all, json_pack("{s:s, s:s, s:s}", "topic", states_topic, "kind",
	                                     "topic", "text", "what the states of a job mean"));
	if (json)
		return print_json(json_pack("{s:o}", "topics", all));
	json_decref(all);
	program_help(stdout);
	printf("topics: %s", states_topic);
	for (int k = 0; k < N_TOPICS; k++)
		printf(" %s", topics[k].name);
	puts("; every worker's name (batten workers); and V79, N31, or any word: the routines of the editor");
	return 0;
}

/* A worker, then the routines in which the words occur. */
static int help_on(const struct invocation *i)
{
	struct text words = { 0 };
	size_t n_found = 0;
	json_t *worker = i->n_words == 1 ? find_worker(i->words[0], &i->report) : NULL;

	for (int k = 0; k < i->n_words; k++)
		text_addf(&words, "%s%s", k ? " " : "", i->words[k]);
	char *s = text_take(&words);
	if (worker && !i->json)
		print_worker(worker);
	int status = s ? help_words(s, worker, i->json, &n_found, &i->report)
	               : status_exit(report_error(&i->report, ST_RESOURCE, "memory ran out"));
	if (!status && !n_found && !worker)
		status = status_exit(
		        report_error(&i->report, ST_PARAMETER,
		                     "there is no help on '%s'; batten help lists the topics", s));
	free(s);
	json_decref(worker);
	return status;
}

static int help_run(const struct invocation *i)
{
	if (!i->n_words)
		return list_all(i->json);
	const char *topic = i->words[0];
	const struct command *c = command_find(topic);
	if (c) {
		command_help(c, stdout);
		return 0;
	}
	if (!strcmp(topic, states_topic)) {
		print_states();
		return 0;
	}
	for (int k = 0; k < N_TOPICS; k++)
		if (!strcmp(topics[k].name, topic)) {
			puts(topics[k].text);
			return 0;
		}
	if (i->n_words == 1 && is_routine_code(topic))
		return help_code(topic, i->json, &i->report);
	return help_on(i);
}

const struct command command_help_verb = {
	.name = "help",
	.usage = "[VERB|WORKER|TOPIC|CODE|WORD...]",
	.text = "explain a verb, a worker, a topic or a routine",
	.help = "CODE is the index of a routine or a menu of the editor: V79, N31. Other words are looked for\n"
	        "in all texts; routines in which each of them occurs are listed, best first.",
	.first_word = WORD_TOPIC,
	.run = help_run,
};
