/* fuzz_job.c - texts to the job file's reader: what it takes is in range, what not has a sentence. */
#include <stdlib.h>
#include <string.h>

#include "worker_private.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static const struct param params[] = {
	{ .name = "n", .type = PARAM_INTEGER, .def = "3", .min = 1, .max = 9, .help = "a number" },
	{ .name = "word", .type = PARAM_CHOICE, .choices = "one two", .help = "a word" },
	{ .name = "color", .type = PARAM_COLOR, .help = "a color" },
	{ .name = "flag", .type = PARAM_FLAG, .def = "no", .help = "a flag" },
	PARAM_ROW_GRID("4x4"),
	PARAM_ROW_VIEW("top"),
	PARAM_ROW_TOLERANCE("1e-3"),
	PARAM_ROWS_LIGHT("0", "30"),
	{ .name = NULL },
};

static const struct worker_output outputs[] = { { ".x", "text", NULL }, { NULL, NULL, NULL } };

const struct worker worker = {
	.name = "fuzz", .title = "fuzz", .version = 1, .params = params, .outputs = outputs
};

static void check(const struct task *t)
{
	struct work_private private = { .task = t };
	struct work w = { .private = &private };
	int a, b;
	long n = work_integer(&w, "n");
	work_size(&w, "grid", &a, &b);
	if (n < 1 || n > 9 || a < 1 || b < 1 || a > 65536 || b > 65536)
		abort();
	if (!(work_real(&w, "tolerance") >= 0) || t->n_inputs < 1)
		abort();
	if (t->n_shards && t->shard >= t->n_shards)
		abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct task t;
	struct report_store said;
	report_store_init(&said);
	if (job_parse(&t, (const char *)data, n, "fuzz.json", &said.report) == ST_OK) {
		check(&t);
		task_finish(&t);
	} else if (!*said.error) {
		abort();
	}
	return 0;
}
