/* reading.h - reading a geometry file in a verb: progress in the terminal, Ctrl-C, warnings. */
#ifndef BATTEN_READING_H
#define BATTEN_READING_H

#include <signal.h>

#include "command.h"
#include "model.h"

/*
 * Read "FILE" or "FILE#ENTITY" into *m (caller finishes); *chosen is the entity, NULL where none is
 * named. Progress is drawn on standard error when it is a terminal and takes over half a second.
 */
enum status reading_open(struct model *m, const char *argument, struct entity **chosen,
                         const struct report *r);

/* Likewise; progress goes to the open descriptor fd, a fraction a line, where fd is not -1. */
enum status reading_open_telling(struct model *m, const char *argument, int fd,
                                 struct entity **chosen, const struct report *r);

/* Between begin and end Ctrl-C is only noted, so that what is being written becomes whole. */
struct interrupt {
	struct sigaction before;
};

/* What takes time: how far it is, drawn on standard error when that is a terminal and after half a
 * second; Ctrl-C stops it. */
struct working {
	struct progress progress; /* to hand on */
	double began, drawn;
	const char *what, *name; /* borrowed: "reading", "hull.igs" */
	bool shown;
	int fd; /* a fraction a line goes there; -1: none */
	struct interrupt interrupt;
};

void working_begin(struct working *x, const char *what, const char *name, int fd);
void working_end(struct working *x);

void interrupt_begin(struct interrupt *x);
bool interrupt_noted(void);
void interrupt_end(const struct interrupt *x);

#endif
