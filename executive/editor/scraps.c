/* scraps.c - strings and arrays that live until a model is filled again. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "desk_inside.h"

void scraps_reset(struct scraps *s)
{
	for (int i = 0; i < s->n; i++)
		free(s->piece[i]);
	s->n = 0;
}

void scraps_finish(struct scraps *s)
{
	scraps_reset(s);
	free(s->piece);
	*s = (struct scraps){ 0 };
}

static void *keep(struct scraps *s, void *piece)
{
	if (piece && s->n == s->cap) {
		int cap = s->cap ? 2 * s->cap : 32;
		void **more = reallocarray(s->piece, (size_t)cap, sizeof *more);
		if (!more) {
			free(piece);
			return NULL;
		}
		s->piece = more;
		s->cap = cap;
	}
	if (piece)
		s->piece[s->n++] = piece;
	return piece;
}

const char *scraps_print(struct scraps *s, const char *format, ...)
{
	va_list list;
	char *out = NULL;

	va_start(list, format);
	if (vasprintf(&out, format, list) < 0)
		out = NULL;
	va_end(list);
	out = keep(s, out);
	return out ? out : "";
}

void *scraps_array(struct scraps *s, size_t n, size_t size)
{
	return keep(s, calloc(n ? n : 1, size));
}
