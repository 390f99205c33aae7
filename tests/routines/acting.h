/* acting.h - routines called by a test, without a window, a service or workers. */
#ifndef BATTEN_TESTS_ACTING_H
#define BATTEN_TESTS_ACTING_H

#include "open.h"
#include "routine.h"

struct acting {
	struct place place;
	struct project project;
	struct act act;
	char said[4096]; /* what was told, a line each */
};

void acting_init(struct acting *a);
void acting_finish(struct acting *a);
int acting_setup(void **state);
int acting_teardown(void **state);

/* Run a line of a script; its status. acting_does fails the test where it is not done. */
enum status acting_run(struct acting *a, const char *line);
void acting_does(struct acting *a, const char *line);
/* It must fail with that class, and say something with `says` in it. */
void acting_fails(struct acting *a, const char *line, enum status st, const char *says);

const struct Ful *acting_thing(struct acting *a, const char *name);

#endif
