/* log.c - what a job's worker said on standard error. */
#include <stdlib.h>

#include "connection.h"
#include "json.h"
#include "number.h"
#include "text.h"
#include "verbs.h"

static const struct option_row log_options[] = {
	{ "--follow", "-f", NULL, "go on until the job is over" },
	{ 0 },
};

static void print_text(void *data, const char *text)
{
	(void)data;
	fputs(text, stdout);
	fflush(stdout);
}

static void keep_text(void *data, const char *text)
{
	text_add(data, text);
}

static int log_run(const struct invocation *i)
{
	struct connection c;
	struct text kept = { 0 };
	int64_t id;

	if (i->n_words != 1 || !number_parse_integer(i->words[0], &id) || id < 1)
		return status_exit(
		        report_error(&i->report, ST_PARAMETER, "name one job by its number"));
	enum status st = connection_open(&c, i, true);
	if (st != ST_OK)
		return status_exit(st);
	json_t *body = json_pack("{s:I, s:b}", "job", (json_int_t)id, "follow",
	                         (int)invocation_flag(i, "--follow"));
	st = client_request(c.client, MESSAGE_LOG, body, NULL, i->json ? keep_text : print_text,
	                    &kept, &i->report);
	int rc = status_exit(st);
	if (st == ST_OK && i->json)
		rc = print_json(
		        json_pack("{s:I, s:s}", "id", (json_int_t)id, "log", kept.s ? kept.s : ""));
	text_finish(&kept);
	connection_close(&c);
	return rc;
}

const struct command command_log = {
	.name = "log",
	.usage = "ID [--follow]",
	.text = "show what a job's worker said",
	.options = log_options,
	.first_word = WORD_JOB,
	.run = log_run,
};
