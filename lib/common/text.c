/* text.c - a string that grows. */
#include "text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"

void text_finish(struct text *t)
{
	if (!t)
		return;
	free(t->s);
	*t = (struct text){ 0 };
}

void text_reset(struct text *t)
{
	t->n = 0;
	t->failed = false;
	if (t->s)
		t->s[0] = 0;
}

/* Room for n more bytes and the zero. */
static bool text_room(struct text *t, size_t n)
{
	if (t->failed)
		return false;
	if (t->cap - t->n > n)
		return true;
	size_t cap = t->cap ? t->cap : 64;
	while (cap - t->n <= n) {
		if (cap > SIZE_MAX / 2) {
			t->failed = true;
			return false;
		}
		cap *= 2;
	}
	char *s = realloc(t->s, cap);
	if (!s) {
		t->failed = true;
		return false;
	}
	t->s = s;
	t->cap = cap;
	return true;
}

char *text_add_room(struct text *t, size_t n)
{
	if (!text_room(t, n))
		return NULL;
	char *room = t->s + t->n;
	t->n += n;
	t->s[t->n] = 0;
	return room;
}

void text_add_bytes(struct text *t, const void *p, size_t n)
{
	if (!text_room(t, n))
		return;
	if (n)
		memcpy(t->s + t->n, p, n);
	t->n += n;
	t->s[t->n] = 0;
}

void text_add(struct text *t, const char *s)
{
	text_add_bytes(t, s, strlen(s));
}

void text_add_number(struct text *t, double x)
{
	char s[NUMBER_SIZE];

	text_add_bytes(t, s, (size_t)number_write(s, x));
}

void text_addf(struct text *t, const char *format, ...)
{
	va_list list, again;

	va_start(list, format);
	va_copy(again, list);
	int n = vsnprintf(NULL, 0, format, list);
	va_end(list);
	if (n < 0)
		t->failed = true;
	else if (text_room(t, (size_t)n)) {
		vsnprintf(t->s + t->n, (size_t)n + 1, format, again);
		t->n += (size_t)n;
	}
	va_end(again);
}

char *text_take(struct text *t)
{
	char *s = NULL;

	if (text_room(t, 0)) {
		t->s[t->n] = 0;
		s = t->s;
		t->s = NULL;
	}
	text_finish(t);
	return s;
}

char *text_print(const char *format, ...)
{
	va_list list;
	char *s;

	va_start(list, format);
	int n = vasprintf(&s, format, list);
	va_end(list);
	return n < 0 ? NULL : s;
}

size_t text_character(const char *s, size_t left)
{
	const unsigned char *p = (const unsigned char *)s;
	if (!left)
		return 0;
	const unsigned char c = *p;
	const size_t n = c < 0x80   ? 1
	                 : c < 0xc2 ? 0
	                 : c < 0xe0 ? 2
	                 : c < 0xf0 ? 3
	                 : c < 0xf5 ? 4
	                            : 0;
	if (!n || n > left)
		return 0;
	for (size_t i = 1; i < n; i++)
		if ((p[i] & 0xc0) != 0x80)
			return 0;
	/* too long a form, a surrogate, beyond the last one */
	if ((c == 0xe0 && p[1] < 0xa0) || (c == 0xed && p[1] >= 0xa0) ||
	    (c == 0xf0 && p[1] < 0x90) || (c == 0xf4 && p[1] >= 0x90))
		return 0;
	return n;
}

bool text_is_utf8(const char *s)
{
	size_t left = strlen(s), n = 1;
	for (; left && n; s += n, left -= n)
		n = text_character(s, left);
	return n > 0;
}
