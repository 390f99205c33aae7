/* worker_describe.c - a worker's description: --describe for programs, --help for people. */
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "worker_private.h"

/* JSON's null for a limit that is none. */
static json_t *limit(const struct param *p, double x)
{
	if ((p->min == 0 && p->max == 0) || isinf(x))
		return json_null();
	return json_real_or_null(x);
}

static json_t *describe_choices(const struct param *p)
{
	if (p->type != PARAM_CHOICE)
		return json_null();
	json_t *list = json_array();
	for (const char *s = p->choices + strspn(p->choices, " "); *s;) {
		size_t n = strcspn(s, " ");
		json_array_append_new(list, json_stringn(s, n));
		s += n + strspn(s + n, " ");
	}
	return list;
}

static json_t *describe_param(const struct param *p)
{
	json_t *o = json_object();
	json_set_text(o, "name", p->name);
	json_set_text(o, "type", param_type_name(p->type));
	json_set_text(o, "default", p->def);
	json_object_set_new(o, "min", limit(p, p->min));
	json_object_set_new(o, "max", limit(p, p->max));
	json_set_text(o, "unit", p->unit);
	json_object_set_new(o, "choices", describe_choices(p));
	json_set_text(o, "help", p->help);
	return o;
}

json_t *describe_json(void)
{
	json_t *o = json_object(), *params = json_array(), *outputs = json_array();
	for (const struct param *p = worker.params; p->name; p++)
		json_array_append_new(params, describe_param(p));
	for (const struct worker_output *out = worker.outputs; out->extension; out++) {
		json_t *row = json_object();
		json_set_text(row, "extension", out->extension);
		json_set_text(row, "kind", out->kind);
		json_set_text(row, "when", out->when);
		json_array_append_new(outputs, row);
	}
	json_set_text(o, "name", worker.name);
	json_set_text(o, "title", worker.title);
	json_set_int(o, "version", worker.version);
	json_set_text(o, "help", worker.help);
	json_set_text(o, "inputs", "surfaces");
	json_object_set_new(o, "scene", json_boolean(worker.scene));
	json_object_set_new(o, "shards",
	                    json_true()); /* the shared main can do some of the units */
	json_object_set_new(o, "parameters", params);
	json_object_set_new(o, "outputs", outputs);
	return o;
}

static const char *const value_words[] = {
	[PARAM_INTEGER] = "N",    [PARAM_REAL] = "X",        [PARAM_TEXT] = "TEXT",
	[PARAM_CHOICE] = "WORD",  [PARAM_FLAG] = "[yes|no]", [PARAM_SIZE] = "AxB",
	[PARAM_VECTOR] = "X,Y,Z", [PARAM_VIEW] = "VIEW",     [PARAM_COLOR] = "#RRGGBB",
};

/* "(default 30; 0 to 180; deg)" */
static void help_notes(struct text *out, const struct param *p)
{
	struct text notes = { 0 };
	if (p->def)
		text_addf(&notes, "; default %s", p->def);
	if (p->choices)
		text_addf(&notes, "; one of %s", p->choices);
	if (p->min != 0 || p->max != 0) {
		text_add(&notes, "; ");
		if (!isinf(p->min))
			text_add_number(&notes, p->min);
		text_add(&notes, " to ");
		text_add(&notes, isinf(p->max) ? "any" : "");
		if (!isinf(p->max))
			text_add_number(&notes, p->max);
	}
	if (p->unit)
		text_addf(&notes, "; %s", p->unit);
	if (notes.n > 2 && !notes.failed)
		text_addf(out, " (%s)", notes.s + 2);
	text_finish(&notes);
}

void describe_help(struct text *out)
{
	text_addf(out,
	          "usage: batten-%s FILE[#ENTITY]... [--PARAM V]... [-o NAME]\n\n"
	          "%s: %s\n%s\n\nparameters:\n",
	          worker.name, worker.title, worker.help,
	          worker.scene ? "All the surfaces named are one scene."
	                       : "Each surface named is done by itself.");
	for (const struct param *p = worker.params; p->name; p++) {
		char left[64];
		snprintf(left, sizeof left, "--%s %s", p->name, value_words[p->type]);
		text_addf(out, "  %-20s  %s", left, p->help);
		help_notes(out, p);
		text_add(out, "\n");
	}
	text_add(out, "\noptions:\n");
	options_help(out);
	text_add(out, "\noutputs:\n");
	for (const struct worker_output *o = worker.outputs; o->extension; o++) {
		char left[64];
		snprintf(left, sizeof left, "NAME%s", o->extension);
		text_addf(out, "  %-20s  %s%s%s\n", left, o->kind, o->when ? ", with --" : "",
		          o->when ? o->when : "");
	}
	text_add(out, "\nWithout arguments it speaks packets (docs/packets.md).\n"
	              "exit status: 0; 1 failure; 2 usage or parameter; 130 interrupted, the\n"
	              "finished units are kept and the same command goes on from there\n");
}
