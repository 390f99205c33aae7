/* probe.c - a worker for tests: its units are bytes by formula; the environment makes it misbehave
 * at a given place, so that the parameters, and with them the part file's key, stay the same.
 *
 *	PROBE_HANG=N|finish|write  wait there until cancelled (write: with half a file written)
 *	PROBE_FAIL=N|begin|finish|write with PROBE_CLASS=input|resource|internal|silent
 *	PROBE_FORGET=unit|output   leave that out
 *	PROBE_LOG=FILE             append a line for each unit done
 */
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base.h"
#include "file.h"
#include "hash.h"
#include "worker.h"

static bool told(const char *variable, const char *here)
{
	const char *where = getenv(variable);
	return where && strcmp(where, here) == 0;
}

/* Says "holding" as its phase, so that a test knows. */
static void hang(struct work *w, const char *here)
{
	if (!told("PROBE_HANG", here))
		return;
	work_phase(w, "holding", 0, 0);
	while (!work_cancelled(w))
		sched_yield();
}

static enum status fail(const struct work *w, const char *here)
{
	if (!told("PROBE_FAIL", here))
		return ST_OK;
	const char *class = getenv("PROBE_CLASS");
	if (!class || strcmp(class, "silent") == 0)
		return ST_RESOURCE;
	return report_error(&w->report, status_from_class(class), "failed as told at %s", here);
}

static void log_unit(size_t unit)
{
	const char *path = getenv("PROBE_LOG");
	FILE *f = path ? fopen(path, "a") : NULL;
	if (f) {
		fprintf(f, "%zu\n", unit);
		fclose(f);
	}
}

static enum status begin(struct work *w)
{
	struct vec3 light;
	enum status st = work_light(w, &light);
	if (work_flag(w, "warn"))
		report_warning(&w->report, "warned as told");
	work_phase(w, "warming up", 1, 2);
	return st == ST_OK ? fail(w, "begin") : st;
}

static size_t units(const struct work *w)
{
	return (size_t)work_integer(w, "units");
}

static enum status unit_bytes(struct work *w, size_t unit)
{
	size_t n = (size_t)work_integer(w, "bytes");
	unsigned char *bytes = malloc(n + 1);
	if (!bytes)
		return ST_RESOURCE;
	for (size_t i = 0; i < n; i++)
		bytes[i] = (unsigned char)(unit * 31 + i * i);
	log_unit(unit);
	enum status st = told("PROBE_FORGET", "unit") ? ST_OK : work_put(w, unit, bytes, n);
	free(bytes);
	return st;
}

static enum status unit(struct work *w, size_t number)
{
	char here[24];
	snprintf(here, sizeof here, "%zu", number);
	hang(w, here);
	if (told("PROBE_HANG", here) && work_cancelled(w))
		return ST_CANCELLED;
	enum status st = fail(w, here);
	return st == ST_OK ? unit_bytes(w, number) : st;
}

static enum status add_point(struct model *m, const double *xyz)
{
	struct entity e = { .kind = ENTITY_POINTS, .points = { .n = 1, .dimension = 3 } };
	e.points.values = malloc(3 * sizeof *xyz);
	if (!e.points.values)
		return ST_RESOURCE;
	memcpy(e.points.values, xyz, 3 * sizeof *xyz);
	return model_add(m, &e);
}

/* All that the units gave, and the attributes, in a .base file of one point. */
static enum status join(struct work *w, struct model *m)
{
	struct text all = { 0 };
	char hash[HASH_SIZE];
	int n;
	const struct work_attribute *a = work_attributes(w, &n);
	enum status st = ST_OK;
	for (int i = 0; st == ST_OK && i < n; i++)
		st = model_set_attribute(m, a[i].name, a[i].value);
	for (size_t i = 0; st == ST_OK && i < units(w); i++) {
		const char *bytes;
		size_t length;
		st = work_get(w, i, &bytes, &length);
		if (st == ST_OK)
			text_add_bytes(&all, bytes, length);
	}
	if (st == ST_OK && !all.failed) {
		hash_bytes(all.s ? all.s : "", all.n, hash);
		st = model_set_attribute(m, "joined", hash);
	}
	text_finish(&all);
	if (st == ST_OK)
		st = add_point(m, w->surfaces[0]->points);
	return st;
}

static enum status write_base(void *data, const char *path, const struct report *r)
{
	struct work *w = data;
	struct model m;
	struct text t = { 0 };
	model_init(&m);
	enum status st = join(w, &m);
	base_format(&m, &t);
	if (st == ST_OK && told("PROBE_HANG", "write")) {
		st = file_write(path, t.s, t.n / 2, r);
		hang(w, "write");
	}
	if (st == ST_OK)
		st = fail(w, "write");
	if (st == ST_OK)
		st = file_write(path, t.s, t.n, r);
	text_finish(&t);
	model_finish(&m);
	return st;
}

static enum status write_extra(void *data, const char *path, const struct report *r)
{
	(void)data;
	return file_write(path, "extra\n", 6, r);
}

static enum status finish(struct work *w)
{
	hang(w, "finish");
	json_t *figures = json_pack("{s:i, s:f, s:[i]}", "units", (int)units(w), "half",
	                            (double)units(w) / 2, "list", w->n_surfaces);
	enum status st = work_figures(w, figures);
	if (st == ST_OK)
		st = fail(w, "finish");
	if (st == ST_OK && !told("PROBE_FORGET", "output"))
		st = work_output(w, ".probe.base", write_base, w);
	if (st == ST_OK && work_flag(w, "extra"))
		st = work_output(w, ".probe.txt", write_extra, NULL);
	return st;
}

static const struct param params[] = {
	{ .name = "units",
	  .type = PARAM_INTEGER,
	  .def = "8",
	  .min = 0,
	  .max = 10000,
	  .help = "units" },
	{ .name = "bytes",
	  .type = PARAM_INTEGER,
	  .def = "100",
	  .min = 0,
	  .max = 1 << 30,
	  .help = "bytes of a unit" },
	{ .name = "extra", .type = PARAM_FLAG, .def = "no", .help = "a second output" },
	{ .name = "warn", .type = PARAM_FLAG, .def = "no", .help = "say a warning" },
	{ .name = "word", .type = PARAM_CHOICE, .choices = "one two three", .help = "a choice" },
	{ .name = "color", .type = PARAM_COLOR, .def = "#00ff00", .help = "a color" },
	PARAM_ROW_GRID("4x4"),
	PARAM_ROW_SIZE("640x480"),
	PARAM_ROW_VIEW("three-quarter"),
	PARAM_ROW_TOLERANCE("1e-3"),
	PARAM_ROWS_LIGHT("0", "30"),
	{ .name = NULL },
};

static const struct worker_output outputs[] = {
	{ ".probe.base", "curves", NULL },
	{ ".probe.txt", "picture", "extra" },
	{ NULL, NULL, NULL },
};

#ifndef PROBE_SCENE
#define PROBE_SCENE false
#endif

const struct worker worker = {
	.name = PROBE_SCENE ? "scene" : "probe",
	.title = "probe",
	.version = 3,
	.help = "Makes bytes for tests.",
	.scene = PROBE_SCENE,
	.params = params,
	.outputs = outputs,
	.begin = begin,
	.units = units,
	.unit = unit,
	.finish = finish,
};
