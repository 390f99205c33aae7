/* trim.c - loops of curves in a surface's u,v plane: making, copying. */
#include "trim.h"

#include <stdlib.h>

void trim_loop_finish(struct trim_loop *l)
{
	for (int i = 0; i < l->n; i++)
		curve_finish(&l->curves[i]);
	free(l->curves);
	*l = (struct trim_loop){ 0 };
}

void trim_finish(struct trim *t)
{
	if (!t)
		return;
	for (int i = 0; i < t->n; i++)
		trim_loop_finish(&t->loops[i]);
	free(t->loops);
	*t = (struct trim){ 0 };
}

static enum status loop_copy(struct trim_loop *out, const struct trim_loop *l)
{
	*out = (struct trim_loop){ .outer = l->outer };
	for (int i = 0; i < l->n; i++) {
		struct curve c;
		enum status st = curve_copy(&c, &l->curves[i]);
		if (st == ST_OK)
			st = trim_loop_add(out, &c);
		if (st != ST_OK) {
			trim_loop_finish(out);
			return st;
		}
	}
	return ST_OK;
}

enum status trim_copy(struct trim *out, const struct trim *t)
{
	*out = (struct trim){ 0 };
	for (int i = 0; i < t->n; i++) {
		struct trim_loop l;
		enum status st = loop_copy(&l, &t->loops[i]);
		if (st == ST_OK)
			st = trim_add(out, &l);
		if (st != ST_OK) {
			trim_finish(out);
			return st;
		}
	}
	return ST_OK;
}

/* Room for one more in an array that doubles: n elements are in it. */
static enum status array_grow(void **p, int n, size_t size)
{
	if (n && (n & (n - 1)))
		return ST_OK;
	void *q = reallocarray(*p, n ? (size_t)n * 2 : 1, size);
	if (!q)
		return ST_RESOURCE;
	*p = q;
	return ST_OK;
}

enum status trim_add(struct trim *t, struct trim_loop *loop)
{
	enum status st = array_grow((void **)&t->loops, t->n, sizeof *t->loops);
	if (st == ST_OK)
		t->loops[t->n++] = *loop;
	else
		trim_loop_finish(loop);
	*loop = (struct trim_loop){ 0 };
	return st;
}

enum status trim_loop_add(struct trim_loop *loop, struct curve *c)
{
	enum status st = array_grow((void **)&loop->curves, loop->n, sizeof *loop->curves);
	if (st == ST_OK)
		loop->curves[loop->n++] = *c;
	else
		curve_finish(c);
	*c = (struct curve){ 0 };
	return st;
}
