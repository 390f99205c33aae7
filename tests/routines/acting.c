/* acting.c - routines called by a test, without a window, a service or workers. */
#include "acting.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void say(void *data, const char *text)
{
	struct acting *a = data;

	strncat(a->said, text, sizeof a->said - strlen(a->said) - 2);
	strcat(a->said, "\n");
}

void acting_init(struct acting *a)
{
	memset(a, 0, sizeof *a);
	place_init(&a->place);
	assert_int_equal(project_find(&a->project, a->place.folder, NULL), ST_OK);
	a->act = (struct act){ .world = a->place.world,
		               .project = &a->project,
		               .report = a->place.said.report,
		               .say = say,
		               .data = a,
		               .wait = true };
	a->act.report.data = &a->place.said;
}

void acting_finish(struct acting *a)
{
	project_finish(&a->project);
	place_finish(&a->place);
}

int acting_setup(void **state)
{
	static struct acting a;

	acting_init(&a);
	*state = &a;
	return 0;
}

int acting_teardown(void **state)
{
	acting_finish(*state);
	return 0;
}

enum status acting_run(struct acting *a, const char *line)
{
	struct script_line l;

	report_store_init(&a->place.said);
	enum status st = script_line_parse(&l, line, &a->act.report);
	if (st == ST_OK && l.routine)
		st = routine_call(l.routine, &a->act, &l.given);
	script_line_finish(&l);
	return st;
}

void acting_does(struct acting *a, const char *line)
{
	if (acting_run(a, line) != ST_OK)
		fail_msg("%s: %s", line, a->place.said.error);
}

void acting_fails(struct acting *a, const char *line, enum status st, const char *says)
{
	enum status got = acting_run(a, line);

	if (got != st || !strstr(a->place.said.error, says))
		fail_msg("%s: %s, '%s'; expected %s and '%s'", line, status_class(got),
		         a->place.said.error, status_class(st), says);
}

const struct Ful *acting_thing(struct acting *a, const char *name)
{
	const struct Ful *f = world_find(a->place.world, name, NULL);

	assert_non_null(f);
	return f;
}
