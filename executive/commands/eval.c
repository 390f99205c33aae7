/* eval.c - points, derivatives, normal and curvatures at given parameters. */
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "curvature.h"
#include "json.h"
#include "number.h"
#include "reading.h"
#include "text.h"
#include "verbs.h"

/* Where answers go: JSON is written as it comes, so a million points need no tree. */
struct answers {
	bool json;
	size_t n;
	struct text text; /* flushed now and then */
	bool failed;
};

static void flush_answers(struct answers *a, size_t above)
{
	if (a->text.n <= above)
		return;
	a->failed |= a->text.failed || fwrite(a->text.s, 1, a->text.n, stdout) != a->text.n;
	text_reset(&a->text);
}

static void add_number(struct text *t, double x)
{
	if (isfinite(x))
		text_add_number(t, x);
	else
		text_add(t, "null");
}

static void add_key(struct text *t, const char *key)
{
	text_add(t, ",\"");
	text_add(t, key);
	text_add(t, "\":");
}

static void add_field(struct text *t, const char *key, double x)
{
	add_key(t, key);
	add_number(t, x);
}

static void add_vector(struct text *t, const char *key, struct vec3 p)
{
	add_key(t, key);
	if (!isfinite(p.x + p.y + p.z)) {
		text_add(t, "null");
		return;
	}
	text_add(t, "[");
	text_add_number(t, p.x);
	text_add(t, ",");
	text_add_number(t, p.y);
	text_add(t, ",");
	text_add_number(t, p.z);
	text_add(t, "]");
}

static void add_row(struct text *t, const char *name, const double *x, int n)
{
	text_addf(t, "  %-9s", name);
	for (int k = 0; k < n; k++)
		if (!isfinite(x[k]))
			text_addf(t, " %22s", "-");
		else
			text_addf(t, " %22.15g", x[k]);
	text_add(t, "\n");
}

static void add_vector_row(struct text *t, const char *name, struct vec3 p)
{
	add_row(t, name, (double[]){ p.x, p.y, p.z }, 3);
}

static void answer_surface(struct answers *a, const struct entity *e, double u, double v)
{
	struct surface_shape p;
	struct text *t = &a->text;

	surface_shape(&e->geometry, u, v, &p);
	const struct {
		const char *name;
		struct vec3 value;
	} vectors[] = { { "point", p.point },  { "du", p.du },   { "dv", p.dv },
		        { "duu", p.duu },      { "duv", p.duv }, { "dvv", p.dvv },
		        { "normal", p.normal } };
	if (!a->json) {
		text_addf(t, "%d: u %.15g v %.15g%s\n", e->number, u, v,
		          p.limit ? " (a limit)" : "");
		for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++)
			add_vector_row(t, vectors[k].name, vectors[k].value);
		for (int q = 0; q < N_QUANTITIES; q++)
			add_row(t, quantity_table[q].json, &p.value[q], 1);
		return;
	}
	text_addf(t, "%s\n{\"entity\":%d", a->n ? "," : "", e->number);
	add_field(t, "u", u);
	add_field(t, "v", v);
	for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++)
		add_vector(t, vectors[k].name, vectors[k].value);
	for (int q = 0; q < N_QUANTITIES; q++)
		add_field(t, quantity_table[q].json, p.value[q]);
	text_addf(t, ",\"limit\":%s}", p.limit ? "true" : "false");
}

static void answer_curve(struct answers *a, const struct entity *e, double at)
{
	struct curve_shape p;
	struct text *t = &a->text;

	curve_shape(&e->curve, at, &p);
	if (!a->json) {
		text_addf(t, "%d: t %.15g%s\n", e->number, at, p.limit ? " (a limit)" : "");
		add_vector_row(t, "point", p.point);
		add_vector_row(t, "d1", p.d1);
		add_vector_row(t, "d2", p.d2);
		add_row(t, "curvature", &p.curvature, 1);
		add_row(t, "torsion", &p.torsion, 1);
		return;
	}
	text_addf(t, "%s\n{\"entity\":%d", a->n ? "," : "", e->number);
	add_field(t, "t", at);
	add_vector(t, "point", p.point);
	add_vector(t, "d1", p.d1);
	add_vector(t, "d2", p.d2);
	add_field(t, "curvature", p.curvature);
	add_field(t, "torsion", p.torsion);
	text_addf(t, ",\"limit\":%s}", p.limit ? "true" : "false");
}

/* What is evaluated: the entity named, else all surfaces, else all curves. */
struct targets {
	const struct entity **entities; /* owned; the entities are the model's */
	size_t n;
	int numbers; /* parameters of a point: 2 or 1 */
};

static enum status choose_targets(struct targets *x, const struct model *m,
                                  const struct entity *chosen, const struct report *r)
{
	enum entity_kind kind = ENTITY_CURVE;

	for (int k = 0; k < m->n; k++)
		if (m->entities[k].kind == ENTITY_SURFACE && m->entities[k].number > 0)
			kind = ENTITY_SURFACE;
	if (chosen)
		kind = chosen->kind;
	if (kind == ENTITY_POINTS || kind == ENTITY_CURVE_ON_SURFACE)
		return report_error(r, ST_INPUT,
		                    "a %s cannot be evaluated; name a curve or a surface",
		                    entity_kind_name(kind));
	x->numbers = kind == ENTITY_SURFACE ? 2 : 1;
	x->entities = calloc((size_t)m->n + 1, sizeof(struct entity *));
	if (!x->entities)
		return report_error(r, ST_RESOURCE, "memory ran out");
	for (int k = 0; k < m->n; k++) {
		const struct entity *e = &m->entities[k];
		if (chosen ? e == chosen : e->kind == kind && e->number > 0)
			x->entities[x->n++] = e;
	}
	return x->n ? ST_OK
	            : report_error(r, ST_INPUT, "'%s' has no surface and no curve", m->file);
}

/* *x must lie in the domain; beyond it by rounding alone, it is moved to the end. */
static enum status bring_inside(const struct entity *e, const char *name, const double domain[2],
                                double *x, const struct report *r)
{
	double slack = 8 * DBL_EPSILON * fmax(fabs(domain[0]), fabs(domain[1]));

	if (!(*x >= domain[0] - slack && *x <= domain[1] + slack))
		return report_error(r, ST_PARAMETER,
		                    "%s = %.17g is outside the domain of %s %d, %.17g to %.17g",
		                    name, *x, entity_kind_name(e->kind), e->number, domain[0],
		                    domain[1]);
	*x = fmin(fmax(*x, domain[0]), domain[1]);
	return ST_OK;
}

static enum status answer(struct answers *a, const struct targets *x, const double *p,
                          const struct report *r)
{
	for (size_t k = 0; k < x->n; k++) {
		const struct entity *e = x->entities[k];
		enum status st;
		if (e->kind == ENTITY_SURFACE) {
			double u = p[0], v = p[1];
			st = bring_inside(e, "u", e->geometry.domain[0], &u, r);
			if (st == ST_OK)
				st = bring_inside(e, "v", e->geometry.domain[1], &v, r);
			if (st == ST_OK)
				answer_surface(a, e, u, v);
		} else {
			double t = p[0];
			st = bring_inside(e, "t", e->curve.domain, &t, r);
			if (st == ST_OK)
				answer_curve(a, e, t);
		}
		if (st != ST_OK)
			return st;
		a->n++;
		flush_answers(a, 1 << 16);
	}
	return ST_OK;
}

/* Numbers of one line, by blanks or commas; a line without any is passed over. */
static enum status answer_line(struct answers *a, const struct targets *x, const char *line,
                               size_t n, size_t number, const struct report *r)
{
	const char *s = line, *end = line + n;
	double p[2];
	int got = 0;

	for (;;) {
		while (s < end && strchr(" \t,\r\n", *s))
			s++;
		if (s >= end)
			break;
		if (got == x->numbers || !number_read(&s, end, &p[got]) ||
		    (s < end && !strchr(" \t,\r\n", *s)))
			return report_error(
			        r, ST_PARAMETER,
			        "standard input line %zu: expected %s by blank or comma", number,
			        x->numbers == 2 ? "u v" : "t");
		got++;
	}
	if (!got)
		return ST_OK;
	if (got < x->numbers)
		return report_error(r, ST_PARAMETER, "standard input line %zu: expected u v",
		                    number);
	return answer(a, x, p, r);
}

static enum status answer_input(struct answers *a, const struct targets *x, const struct report *r)
{
	char *line = NULL;
	size_t room = 0, number = 0;
	ssize_t n;
	enum status st = ST_OK;

	while (st == ST_OK && (n = getline(&line, &room, stdin)) >= 0)
		st = answer_line(a, x, line, (size_t)n, ++number, r);
	if (st == ST_OK && ferror(stdin))
		st = report_error(r, ST_INPUT, "cannot read standard input: %s", strerror(errno));
	free(line);
	return st;
}

static enum status answer_words(struct answers *a, const struct targets *x,
                                const struct invocation *i)
{
	enum status st = ST_OK;
	int n = i->n_words - 1;

	if (!n || n % x->numbers)
		return report_error(&i->report, ST_PARAMETER, "give %s, or - for standard input",
		                    x->numbers == 2 ? "pairs u v" : "one t or more");
	for (int k = 0; k < n && st == ST_OK; k += x->numbers) {
		double p[2] = { 0 };
		for (int c = 0; c < x->numbers; c++)
			if (!number_parse(i->words[1 + k + c], &p[c]))
				return report_error(&i->report, ST_PARAMETER, "'%s' is no number",
				                    i->words[1 + k + c]);
		st = answer(a, x, p, &i->report);
	}
	return st;
}

static int eval_run(const struct invocation *i)
{
	struct answers a = { .json = i->json };
	struct targets x = { 0 };
	struct model m;
	struct entity *chosen;

	if (i->n_words < 1)
		return status_exit(
		        report_error(&i->report, ST_PARAMETER, "name a file and parameters"));
	enum status st = reading_open(&m, i->words[0], &chosen, &i->report);
	if (st != ST_OK)
		return status_exit(st);
	st = choose_targets(&x, &m, chosen, &i->report);
	bool from_input = i->n_words == 2 && !strcmp(i->words[1], "-");
	if (i->json)
		text_add(&a.text, "{\"version\":1,\"points\":[");
	if (st == ST_OK)
		st = from_input ? answer_input(&a, &x, &i->report) : answer_words(&a, &x, i);
	if (st == ST_OK) {
		if (i->json)
			text_add(&a.text, "]}\n");
		flush_answers(&a, 0);
		if (a.failed)
			st = ST_RESOURCE; /* said at the end of the verb */
	} else if (!i->json)
		flush_answers(&a, 0);
	text_finish(&a.text);
	free(x.entities);
	model_finish(&m);
	return status_exit(st);
}

const struct command command_eval = {
	.name = "eval",
	.usage = "FILE[#ENTITY] U V...|-",
	.text = "evaluate curves and surfaces at parameters",
	.help = "Points, derivatives, normal and curvatures, in the file's parameters and unit. Pairs u v\n"
	        "for surfaces, single t for curves; with - a pair (or t) a line from standard input, numbers\n"
	        "by blanks or commas. Values that do not exist are null; at a pole limits are given and\n"
	        "flagged.",
	.first_word = WORD_FILE,
	.run = eval_run,
};
