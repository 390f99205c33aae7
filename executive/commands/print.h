/* print.h - JSON on standard output, member by member and row by row: a list may be longer than memory. */
#ifndef BATTEN_PRINT_H
#define BATTEN_PRINT_H

#include <jansson.h>
#include <stdbool.h>

#include "text.h"

/* Zeroed: not begun. */
struct print {
	struct text waiting; /* to be written */
	bool held;           /* all waits until the end: there may be an error yet */
	bool failed, row;
};

/* One object with "version": 1 put first. Values are stolen. */
void print_begin(struct print *p, bool held);
void print_member(struct print *p, const char *name, json_t *value);
void print_rows(struct print *p, const char *name); /* a list: rows follow */
void print_row(struct print *p, json_t *row);
void print_rows_end(struct print *p);
int print_end(struct print *p); /* exit status */
void print_forget(struct print *p);

#endif
