/* hits.c - where the things are that can be clicked. */
#include <stdlib.h>

#include "paint.h"

void hits_reset(struct hits *h)
{
	h->n = 0;
}

void hits_finish(struct hits *h)
{
	if (!h)
		return;
	free(h->hit);
	*h = (struct hits){ 0 };
}

const struct hit *hits_at(const struct hits *h, double x, double y)
{
	for (int i = h->n - 1; i >= 0; i--) {
		const struct hit *t = &h->hit[i];
		if (x >= t->x && x < t->x + t->width && y >= t->y && y < t->y + t->height)
			return t;
	}
	return NULL;
}

/* Without memory for more, what was painted last cannot be clicked; it keeps its key. */
void paint_hit(const struct paint *p, enum hit_kind kind, int index, int part, double x, double y,
               double width, double height)
{
	struct hits *h = p->hits;
	if (!h || !(width > 0) || !(height > 0))
		return;
	if (h->n == h->cap) {
		int cap = h->cap ? 2 * h->cap : 64;
		struct hit *more = realloc(h->hit, (size_t)cap * sizeof *more);
		if (!more)
			return;
		h->hit = more;
		h->cap = cap;
	}
	h->hit[h->n++] = (struct hit){ kind, index, part, x, y, width, height };
}

bool paint_hot(const struct paint *p, enum hit_kind kind, int index, int part)
{
	const struct look *k = p->look;
	return k->hover_kind == kind && k->hover_index == index && k->hover_part == part;
}

bool paint_focused(const struct paint *p, enum hit_kind kind, int index, int part)
{
	const struct look *k = p->look;
	return k->focus_kind == kind && k->focus_index == index && k->focus_part == part;
}
