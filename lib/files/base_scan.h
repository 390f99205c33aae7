/* base_scan.h - tokens of a .base text; errors say line, column, what was found and expected. */
#ifndef BATTEN_BASE_SCAN_H
#define BATTEN_BASE_SCAN_H

#include <stdint.h>

#include "model.h"

struct scanner {
	const char *start, *s, *end;
	const char *token; /* where the last token began: errors point there */
	const char *name;
	struct model *m;
	const struct progress *progress;
	const struct report *r;
	enum status st; /* a parser that has failed stays failed */
};

/* At the beginning of n bytes; all is borrowed. */
void scan_init(struct scanner *p, const char *bytes, size_t n, const char *name, struct model *m,
               const struct progress *progress, const struct report *r);

/* Pass blanks and comments; the next token begins at p->token then. */
void scan_blanks(struct scanner *p);

/* Fail at the token at hand, saying what was expected; the first failure is the one told. */
void scan_fail(struct scanner *p, const char *expected, ...) __attribute__((format(printf, 2, 3)));
void scan_no_memory(struct scanner *p);

/* Fail where a model's function had no memory. */
void scan_keep(struct scanner *p, enum status st);

/* The token at hand is that word; it is taken. */
bool scan_word(struct scanner *p, const char *word);

double scan_number(struct scanner *p, const char *what);
int scan_integer(struct scanner *p, const char *what, int64_t lo, int64_t hi);
bool scan_flag(struct scanner *p, const char *what);
void scan_numbers(struct scanner *p, double *out, int64_t n, const char *what);

/* A string in quotes; fresh. NULL when the scanner has failed. */
char *scan_string(struct scanner *p, const char *what);

/* How many things of `each` numbers can still follow: one byte and a blank a number. */
int64_t scan_numbers_left(const struct scanner *p, int64_t each);

/* Line and column, from 1, of a place in the text. */
int scan_line(const struct scanner *p, const char *at, int *column);

#endif
