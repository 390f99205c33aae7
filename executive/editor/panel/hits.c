/* hits.c - where the things are that can be clicked. */
#include <stdlib.h>
#include <string.h>

#include "paint.h"

void hits_reset(struct hits *h)
{
	for (int i = 0; i < h->n; i++)
		free(h->hit[i].tip);
	h->n = 0;
}

void hits_finish(struct hits *h)
{
	if (!h)
		return;
	hits_reset(h);
	free(h->hit);
	*h = (struct hits){ 0 };
}

static bool is_over(const struct hit *t, double x, double y)
{
	return x >= t->x && x < t->x + t->width && y >= t->y && y < t->y + t->height;
}

const struct hit *hits_at(const struct hits *h, double x, double y)
{
	for (int i = h->n - 1; i >= 0; i--)
		if (h->hit[i].kind != HIT_TIP && is_over(&h->hit[i], x, y))
			return &h->hit[i];
	return NULL;
}

const char *hits_tip(const struct hits *h, double x, double y)
{
	for (int i = h->n - 1; i >= 0; i--) {
		const struct hit *t = &h->hit[i];
		if (!is_over(t, x, y))
			continue;
		if (t->kind == HIT_TIP)
			return t->tip;
		if (t->kind == HIT_NONE)
			return NULL; /* a page over it */
	}
	return NULL;
}

/* Without memory for more, what was painted last cannot be clicked; it keeps its key. */
static bool add(struct hits *h, const struct hit *one)
{
	if (!(one->width > 0) || !(one->height > 0))
		return false;
	if (h->n == h->cap) {
		int cap = h->cap ? 2 * h->cap : 64;
		struct hit *more = realloc(h->hit, (size_t)cap * sizeof *more);
		if (!more)
			return false;
		h->hit = more;
		h->cap = cap;
	}
	h->hit[h->n++] = *one;
	return true;
}

void paint_hit(const struct paint *p, enum hit_kind kind, int index, int part, double x, double y,
               double width, double height)
{
	const struct hit one = { kind, index, part, x, y, width, height, NULL };
	if (p->hits)
		add(p->hits, &one);
}

void paint_tip(const struct paint *p, double x, double y, double width, double height,
               const char *text)
{
	const struct hit one = {
		HIT_TIP, 0, 0, x, y, width, height, p->hits ? strdup(text) : NULL
	};
	if (one.tip && !add(p->hits, &one))
		free(one.tip);
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
