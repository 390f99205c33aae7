/* import.c - every entity of a geometry file as .base. */
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base.h"
#include "file.h"
#include "json.h"
#include "path.h"
#include "print.h"
#include "reading.h"
#include "text.h"
#include "verbs.h"
#include "work_order.h"

enum { HAND_OVER = 1 << 18 }; /* bytes at once */

static const struct option_row import_options[] = {
	{ "--into", NULL, "DIR", "folder to write into (default: the current one)" },
	{ "--inputs", NULL, NULL, "write the surfaces under their hash, as jobs read them" },
	{ "--model-fd", NULL, "N", "for programs: write all of it as one .base to descriptor N" },
	{ "--progress-fd", NULL, "N",
	  "for programs: how far it is, 0 to 1 a line, to descriptor N" },
	{ 0 },
};

/* How one import goes. */
struct import {
	const struct invocation *i;
	const struct model *m;
	const char *folder, *basic;
	bool inputs;
	int n_chosen;
	struct print print; /* of JSON; what it says waits until all is written */
};

/* Where an entity goes: DIR/NAME.base, DIR/NAME-3.base. Fresh. */
static char *place(const struct import *x, const struct entity *e)
{
	char *name, *path;

	if (x->n_chosen == 1)
		name = text_print("%s.base", x->basic);
	else if (e->number)
		name = text_print("%s-%d.base", x->basic, e->number);
	else
		name = text_print("%s-D%d.base", x->basic, e->de);
	path = name ? path_join(x->folder, name) : NULL;
	free(name);
	return path;
}

static enum status write_entity(struct import *x, const struct entity *e)
{
	const struct report *r = &x->i->report;
	struct text t = { 0 };
	enum status st;
	char *path = NULL;

	base_format_entity(x->m, e, &t);
	if (x->inputs)
		st = work_input_keep(x->folder, &t, &path, r);
	else if (t.failed || !(path = place(x, e)))
		st = report_error(r, ST_RESOURCE, "memory ran out");
	else
		st = file_write(path, t.s, t.n, r);
	if (st == ST_OK && x->i->json)
		print_row(&x->print,
		          json_pack("{s:i, s:s, s:s?, s:o, s:s}", "number", e->number, "kind",
		                    entity_kind_name(e->kind), "name", e->name, "de",
		                    e->de ? json_integer(e->de) : json_null(), "path", path));
	if (st == ST_OK && !x->i->json)
		puts(path);
	free(path);
	text_finish(&t);
	return st;
}

static bool is_meant(const struct import *x, const struct entity *chosen, const struct entity *e)
{
	if (chosen)
		return e == chosen;
	return e->number > 0 && (!x->inputs || e->kind == ENTITY_SURFACE);
}

static enum status import_all(struct import *x, const struct entity *chosen)
{
	const struct report *r = &x->i->report;
	enum status st = ST_OK;

	for (int k = 0; k < x->m->n; k++)
		x->n_chosen += is_meant(x, chosen, &x->m->entities[k]);
	if (!x->n_chosen)
		return report_error(r, ST_INPUT, "'%s' has no %s", x->m->file,
		                    x->inputs ? "surface; jobs work on surfaces" : "entity");
	if (x->inputs && chosen && chosen->kind != ENTITY_SURFACE)
		return report_error(r, ST_INPUT, "entity %d of '%s' is a %s; jobs work on surfaces",
		                    chosen->number, x->m->file, entity_kind_name(chosen->kind));
	struct interrupt interrupt;
	int written = 0;
	interrupt_begin(&interrupt);
	for (int k = 0; k < x->m->n && st == ST_OK; k++)
		if (is_meant(x, chosen, &x->m->entities[k])) {
			if (interrupt_noted())
				st = report_error(r, ST_CANCELLED,
				                  "cancelled; %d of %d entities are written, each "
				                  "whole",
				                  written, x->n_chosen);
			else
				st = write_entity(x, &x->m->entities[k]);
			written++;
		}
	interrupt_end(&interrupt);
	return st;
}

/* What could not be read, for who takes the model over. */
static json_t *complaints(const struct model *m)
{
	json_t *skipped = json_array(), *warnings = json_array();

	for (int k = 0; k < m->n_skipped; k++)
		json_array_append_new(
		        skipped, json_pack("{s:i, s:i, s:i, s:s}", "type", m->skipped[k].type,
		                           "count", m->skipped[k].count, "first_de",
		                           m->skipped[k].first_de, "reason", m->skipped[k].reason));
	for (int k = 0; k < m->n_warnings; k++)
		json_array_append_new(warnings, json_string(m->warnings[k]));
	return json_pack("{s:s?, s:i, s:o, s:o}", "file", m->file, "entities", m->n, "skipped",
	                 skipped, "warnings", warnings);
}

static enum status send(const struct text *t, int fd, const struct report *r)
{
	size_t done = 0;

	if (t->failed)
		return report_error(r, ST_RESOURCE, "memory ran out");
	while (done < t->n) {
		const ssize_t n = write(fd, t->s + done, t->n - done);
		if (n > 0)
			done += (size_t)n;
		else if (errno != EINTR)
			return report_error(r, status_from_errno(errno),
			                    "cannot hand over what was read: %s", strerror(errno));
	}
	return ST_OK;
}

/* The whole model to an open descriptor. */
static int hand_over(const struct invocation *i, const struct model *m, int fd)
{
	struct text t = { 0 };
	enum status st = ST_OK;

	for (int piece = 0; piece <= m->n && st == ST_OK; piece++) {
		base_format_piece(m, piece, &t);
		if (t.failed || t.n > HAND_OVER || piece == m->n) {
			st = send(&t, fd, &i->report);
			text_reset(&t);
		}
	}
	text_finish(&t);
	return st == ST_OK ? print_json(complaints(m)) : status_exit(st);
}

static int import_run(const struct invocation *i)
{
	struct model m;
	struct entity *chosen;
	const char *into = invocation_value(i, "--into");
	long model_fd = -1, progress_fd = -1;

	if (i->n_words != 1)
		return status_exit(report_error(&i->report, ST_PARAMETER, "name one file"));
	enum status st = invocation_integer(i, "--model-fd", 3, INT_MAX, -1, &model_fd);
	if (st == ST_OK)
		st = invocation_integer(i, "--progress-fd", 3, INT_MAX, -1, &progress_fd);
	if (st == ST_OK)
		st = reading_open_telling(&m, i->words[0], (int)progress_fd, &chosen, &i->report);
	if (st != ST_OK)
		return status_exit(st);
	if (model_fd >= 0) {
		const int rc = hand_over(i, &m, (int)model_fd);
		model_finish(&m);
		return rc;
	}
	char *basic = m.file ? path_basic_name(m.file) : NULL;
	struct import x = { .i = i,
		            .m = &m,
		            .folder = into ? into : ".",
		            .basic = basic,
		            .inputs = invocation_flag(i, "--inputs") };
	if (i->json) {
		print_begin(&x.print, true);
		print_member(&x.print, "file", m.file ? json_string(m.file) : json_null());
		print_rows(&x.print, "entities");
	}
	if (into)
		st = folder_make(into, 0777, &i->report);
	if (st == ST_OK)
		st = import_all(&x, chosen);
	for (int k = 0; k < m.n_warnings; k++)
		report_warning(&i->report, "%s", m.warnings[k]);
	for (int k = 0; k < m.n_skipped && !x.inputs; k++)
		report_warning(&i->report, "skipped %d of type %d from D%d: %s", m.skipped[k].count,
		               m.skipped[k].type, m.skipped[k].first_de, m.skipped[k].reason);
	int rc = status_exit(st);
	if (st == ST_OK && i->json) {
		print_rows_end(&x.print);
		rc = print_end(&x.print);
	}
	print_forget(&x.print);
	free(basic);
	model_finish(&m);
	return rc;
}

const struct command command_import = {
	.name = "import",
	.usage = "FILE[#ENTITY] [--into DIR]",
	.text = "write every entity of a geometry file as .base",
	.help = "NAME.base where there is one entity, else NAME-3.base with its number. Units, names, colors\n"
	        "and Directory Entry numbers are kept; what could not be read is said.",
	.options = import_options,
	.first_word = WORD_FILE,
	.run = import_run,
};
