/* text.h - a string that grows. A text that ran out of memory stays failed: test once at the end. */
#ifndef BATTEN_TEXT_H
#define BATTEN_TEXT_H

#include <stdbool.h>
#include <stddef.h>

struct text {
	char *s;       /* owned; NULL or ended by a zero byte */
	size_t n, cap; /* bytes without the zero; room */
	bool failed;
};

/* A zeroed struct text is an empty one. */
void text_finish(struct text *t);
void text_reset(struct text *t); /* empty again and not failed, room kept */

void text_add(struct text *t, const char *s);
void text_add_bytes(struct text *t, const void *p, size_t n);
char *text_add_room(struct text *t, size_t n);  /* n bytes for the caller to fill; NULL: failed */
void text_add_number(struct text *t, double x); /* shortest decimal that reads back the same */
void text_addf(struct text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Hand the string over to the caller, who frees it; NULL where the text failed. */
char *text_take(struct text *t);

/* Bytes of the UTF-8 character at p, of which `left` bytes are there; 0: it is none. */
size_t text_character(const char *p, size_t left);
bool text_is_utf8(const char *s);

/* printf into fresh memory; NULL where memory ran out. Caller frees. */
char *text_print(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
