/* typed.c - one line of text being typed. */
#include "typed.h"

#include <string.h>

static bool inside(char c)
{
	return ((unsigned char)c & 0xC0) == 0x80;
}

static int encode(uint32_t c, char out[4])
{
	if (c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0xD800 && c < 0xE000) || c > 0x10FFFF)
		return 0;
	int more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
	static const unsigned char lead[] = { 0, 0xC0, 0xE0, 0xF0 };
	for (int i = more; i > 0; i--, c >>= 6)
		out[i] = (char)(0x80 | (c & 0x3F));
	out[0] = (char)(lead[more] | c);
	return more + 1;
}

static bool put(struct typed *t, const char *bytes, int n)
{
	if (t->n + n >= TYPED_BYTES)
		return false;
	memmove(t->s + t->caret + n, t->s + t->caret, (size_t)(t->n - t->caret + 1));
	memcpy(t->s + t->caret, bytes, (size_t)n);
	t->n += n;
	t->caret += n;
	return true;
}

static bool cut(struct typed *t, int from, int to)
{
	if (from >= to)
		return false;
	memmove(t->s + from, t->s + to, (size_t)(t->n - to + 1));
	t->n -= to - from;
	t->caret = from;
	return true;
}

bool typed_insert(struct typed *t, uint32_t character)
{
	char bytes[4];
	int n = encode(character, bytes);

	return n && put(t, bytes, n);
}

void typed_insert_text(struct typed *t, const char *s)
{
	while (*s) {
		int n = 1;
		while (inside(s[n]))
			n++;
		if ((unsigned char)*s >= 0x20 && !put(t, s, n))
			return;
		s += n;
	}
}

void typed_set(struct typed *t, const char *s)
{
	t->n = t->caret = 0;
	t->s[0] = 0;
	typed_insert_text(t, s);
}

static int before(const struct typed *t, int at)
{
	do
		at--;
	while (at > 0 && inside(t->s[at]));
	return at;
}

static int after(const struct typed *t, int at)
{
	do
		at++;
	while (inside(t->s[at]));
	return at;
}

bool typed_backspace(struct typed *t)
{
	return t->caret > 0 && cut(t, before(t, t->caret), t->caret);
}

bool typed_backspace_word(struct typed *t)
{
	int at = t->caret;

	while (at > 0 && t->s[at - 1] == ' ')
		at--;
	while (at > 0 && t->s[at - 1] != ' ')
		at--;
	return cut(t, at, t->caret);
}

bool typed_delete(struct typed *t)
{
	return t->caret < t->n && cut(t, t->caret, after(t, t->caret));
}

bool typed_clear(struct typed *t)
{
	return cut(t, 0, t->n);
}

static bool go(struct typed *t, int at)
{
	bool moved = t->caret != at;

	t->caret = at;
	return moved;
}

bool typed_left(struct typed *t)
{
	return t->caret > 0 && go(t, before(t, t->caret));
}

bool typed_right(struct typed *t)
{
	return t->caret < t->n && go(t, after(t, t->caret));
}

void typed_place(struct typed *t, int byte)
{
	t->caret = byte < 0 ? 0 : byte > t->n ? t->n : byte;
	while (t->caret > 0 && t->caret < t->n && ((unsigned char)t->s[t->caret] & 0xC0) == 0x80)
		t->caret--;
}

bool typed_home(struct typed *t)
{
	return go(t, 0);
}

bool typed_end(struct typed *t)
{
	return go(t, t->n);
}
