/* worker_values.c - values of parameters: checked as they come, in one canonical form. */
#include <assert.h>
#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "worker_private.h"

static const char *const type_names[] = {
	[PARAM_INTEGER] = "integer", [PARAM_REAL] = "real", [PARAM_TEXT] = "text",
	[PARAM_CHOICE] = "choice",   [PARAM_FLAG] = "flag", [PARAM_SIZE] = "size",
	[PARAM_VECTOR] = "vector",   [PARAM_VIEW] = "view", [PARAM_COLOR] = "color",
};

const char *param_type_name(enum param_type type)
{
	return type_names[type];
}

const struct param *param_find(const char *name, int *index)
{
	for (int i = 0; worker.params[i].name; i++) {
		if (strcmp(worker.params[i].name, name) == 0) {
			*index = i;
			return &worker.params[i];
		}
	}
	return NULL;
}

static enum status no_such(const char *name, const struct report *r)
{
	struct text list = { 0 };
	for (int i = 0; worker.params[i].name; i++)
		text_addf(&list, "%s%s", i ? ", " : "", worker.params[i].name);
	enum status st = report_error(r, ST_PARAMETER, "there is no parameter '%s'; %s has %s",
	                              name, worker.name, list.n && !list.failed ? list.s : "none");
	text_finish(&list);
	return st;
}

/* "from 1 to 65536", "at least 0", or "" where there is no limit. */
static void describe_range(const struct param *p, char *out, size_t n)
{
	char min[NUMBER_SIZE], max[NUMBER_SIZE];
	number_write(min, p->min);
	number_write(max, p->max);
	if (p->min == 0 && p->max == 0)
		out[0] = 0;
	else if (isinf(p->max))
		snprintf(out, n, " of at least %s", min);
	else if (isinf(p->min))
		snprintf(out, n, " of at most %s", max);
	else
		snprintf(out, n, " from %s to %s", min, max);
}

static bool in_range(const struct param *p, double x)
{
	return (p->min == 0 && p->max == 0) || (x >= p->min && x <= p->max);
}

static enum status wrong(const struct param *p, const char *value, const char *expected,
                         const struct report *r)
{
	char range[2 * NUMBER_SIZE + 32];
	describe_range(p, range, sizeof range);
	return report_error(r, ST_PARAMETER, "--%s '%s': expected %s%s", p->name, value, expected,
	                    range);
}

/* Read n numbers with `mark` between them. */
static bool read_numbers(const char *s, char mark, int n, bool integers, double *out)
{
	const char *end = s + strlen(s);
	for (int i = 0; i < n; i++) {
		int64_t whole;
		if (i > 0 && *s++ != mark && !(mark == 'x' && s[-1] == 'X'))
			return false;
		if (integers) {
			if (!number_read_integer(&s, end, &whole) || whole > INT_MAX ||
			    whole < -INT_MAX)
				return false;
			out[i] = (double)whole;
		} else if (!number_read(&s, end, &out[i]) || !isfinite(out[i])) {
			return false;
		}
	}
	return s == end;
}

static enum status set_numbers(const struct param *p, const char *value, char mark, int n,
                               bool integers, const char *expected, char **out,
                               const struct report *r)
{
	double x[3];
	struct text t = { 0 };
	if (!read_numbers(value, mark, n, integers, x))
		return wrong(p, value, expected, r);
	for (int i = 0; i < n; i++)
		if (!in_range(p, x[i]))
			return wrong(p, value, expected, r);
	for (int i = 0; i < n; i++) {
		if (i > 0)
			text_add_bytes(&t, &mark, 1);
		text_add_number(&t, x[i] == 0 ? 0 : x[i]);
	}
	*out = text_take(&t);
	return ST_OK;
}

static bool is_choice(const struct param *p, const char *value)
{
	size_t n = strlen(value);
	for (const char *s = p->choices; n && *s; s += strcspn(s, " ")) {
		s += strspn(s, " ");
		if (strcspn(s, " ") == n && strncmp(s, value, n) == 0)
			return true;
	}
	return false;
}

static bool is_color(const char *s)
{
	return s[0] == '#' && strlen(s) == 7 && strspn(s + 1, "0123456789abcdefABCDEF") == 6;
}

static enum status canonical(const struct param *p, const char *value, char **out,
                             const struct report *r)
{
	char expected[256];
	switch (p->type) {
	case PARAM_INTEGER:
		return set_numbers(p, value, ',', 1, true, "an integer", out, r);
	case PARAM_REAL:
		return set_numbers(p, value, ',', 1, false, "a number", out, r);
	case PARAM_SIZE:
		return set_numbers(p, value, 'x', 2, true, "two integers AxB, each", out, r);
	case PARAM_VECTOR:
		return set_numbers(p, value, ',', 3, false, "three numbers X,Y,Z", out, r);
	case PARAM_CHOICE:
		snprintf(expected, sizeof expected, "one of %s", p->choices);
		if (!is_choice(p, value))
			return wrong(p, value, expected, r);
		break;
	case PARAM_FLAG:
		if (strcmp(value, "yes") != 0 && strcmp(value, "no") != 0)
			return wrong(p, value, "yes or no", r);
		break;
	case PARAM_COLOR:
		if (!is_color(value))
			return wrong(p, value, "a color #RRGGBB", r);
		break;
	case PARAM_TEXT:
	case PARAM_VIEW:
		if (!*value)
			return wrong(p, value, "a text that is not empty", r);
		break;
	}
	*out = strdup(value);
	if (*out && p->type == PARAM_COLOR)
		for (char *s = *out; *s; s++)
			*s = (char)toupper((unsigned char)*s);
	return ST_OK;
}

enum status values_set(struct task *t, const char *name, const char *value, const struct report *r)
{
	int i;
	char *text = NULL;
	const struct param *p = param_find(name, &i);
	if (!p)
		return no_such(name, r);
	enum status st = canonical(p, value, &text, r);
	if (st != ST_OK)
		return st;
	if (!text)
		return ST_RESOURCE;
	free(t->values[i]);
	t->values[i] = text;
	t->given[i] = true;
	return ST_OK;
}

enum status values_default(struct task *t, const struct report *r)
{
	for (int i = 0; worker.params[i].name; i++) {
		const struct param *p = &worker.params[i];
		if (t->values[i] || !p->def)
			continue;
		enum status st = values_set(t, p->name, p->def, r);
		if (st != ST_OK)
			return st;
		t->given[i] = false;
	}
	return ST_OK;
}

static const char *value_of(const struct work *w, const char *name)
{
	int i;
	const struct param *p = param_find(name, &i);
	assert(p);
	return p ? w->private->task->values[i] : NULL;
}

bool work_has(const struct work *w, const char *name)
{
	return value_of(w, name) != NULL;
}

const char *work_text(const struct work *w, const char *name)
{
	return value_of(w, name);
}

bool work_flag(const struct work *w, const char *name)
{
	const char *value = value_of(w, name);
	return value && strcmp(value, "yes") == 0;
}

double work_real(const struct work *w, const char *name)
{
	double x = 0;
	const char *value = value_of(w, name);
	assert(value);
	number_parse(value, &x);
	return x;
}

long work_integer(const struct work *w, const char *name)
{
	int64_t x = 0;
	const char *value = value_of(w, name);
	assert(value);
	number_parse_integer(value, &x);
	return (long)x;
}

void work_size(const struct work *w, const char *name, int *a, int *b)
{
	double x[2] = { 0 };
	const char *value = value_of(w, name);
	assert(value);
	read_numbers(value, 'x', 2, true, x);
	*a = (int)x[0];
	*b = (int)x[1];
}

struct vec3 work_vector(const struct work *w, const char *name)
{
	double x[3] = { 0 };
	const char *value = value_of(w, name);
	assert(value);
	read_numbers(value, ',', 3, false, x);
	return vec3(x[0], x[1], x[2]);
}

static bool was_given(const struct work *w, const char *name)
{
	int i;
	return param_find(name, &i) && w->private->task->given[i];
}

enum status work_light(const struct work *w, struct vec3 *out)
{
	if (!work_has(w, "light")) {
		double azimuth = work_real(w, "azimuth") * M_PI / 180;
		double incidence = work_real(w, "incidence") * M_PI / 180;
		*out = vec3(sin(incidence) * cos(azimuth), sin(incidence) * sin(azimuth),
		            cos(incidence));
		return ST_OK;
	}
	if (was_given(w, "azimuth") || was_given(w, "incidence"))
		return report_error(&w->report, ST_PARAMETER,
		                    "the light is given twice: take --light, or --azimuth and "
		                    "--incidence");
	struct vec3 l = work_vector(w, "light");
	double size = fmax(fabs(l.x), fmax(fabs(l.y), fabs(l.z)));
	if (!(size > 0))
		return report_error(&w->report, ST_PARAMETER,
		                    "--light '%s' has no direction; name one like 0,0,1",
		                    work_text(w, "light"));
	*out = vec3_unit(vec3_scale(l, 1 / size)); /* its square might overflow */
	return ST_OK;
}
