/* typed.h - one line of text being typed, in UTF-8, with a caret. */
#ifndef BATTEN_TYPED_H
#define BATTEN_TYPED_H

#include <stdbool.h>
#include <stdint.h>

enum { TYPED_BYTES = 4096 };

struct typed {
	char s[TYPED_BYTES]; /* ended by a zero byte */
	int n, caret;        /* bytes; the caret never stands inside a character */
};

/* What does not fit is left out, whole characters at a time. */
void typed_set(struct typed *t, const char *s); /* the caret goes to the end */
/* False: no room, or no character that is written (a control, a surrogate, beyond Unicode). */
bool typed_insert(struct typed *t, uint32_t character);
void typed_insert_text(struct typed *t, const char *s);

void typed_place(struct typed *t, int byte); /* the caret: before it, and before its character */

/* True where something changed. */
bool typed_backspace(struct typed *t);
bool typed_backspace_word(struct typed *t);
bool typed_delete(struct typed *t);
bool typed_clear(struct typed *t);
bool typed_left(struct typed *t);
bool typed_right(struct typed *t);
bool typed_home(struct typed *t);
bool typed_end(struct typed *t);

#endif
