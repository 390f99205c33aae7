/* history.c - undo and redo: a step holds what its things were before. */
#include <stdlib.h>
#include <string.h>

#include "world_private.h"

/* What undo keeps at most; the oldest steps go first. Bytes. */
static const size_t history_most = (size_t)256 << 20;

static void step_finish(struct step *s)
{
	for (int k = 0; k < s->n; k++)
		ful_destroy(s->changes[k].ful);
	free(s->changes);
	free(s->name);
	*s = (struct step){ 0 };
}

void history_finish(struct history *h)
{
	for (int k = 0; k < h->n; k++)
		step_finish(&h->steps[k]);
	free(h->steps);
	*h = (struct history){ 0 };
}

void world_step_begin(struct world *w, const char *what)
{
	if (w->depth++ == 0)
		w->open = (struct step){ .name = strdup(what) };
}

enum status history_room(struct world *w)
{
	enum status st = grow((void **)&w->open.changes, w->open.n, sizeof *w->open.changes);

	if (st == ST_OK)
		st = grow((void **)&w->undo.steps, w->undo.n, sizeof *w->undo.steps);
	return st;
}

void history_record(struct world *w, int id, int place, struct Ful *before)
{
	/* what a thing was before the step is what counts */
	for (int k = 0; k < w->open.n; k++)
		if (w->open.changes[k].id == id) {
			ful_destroy(before);
			return;
		}
	w->open.changes[w->open.n++] = (struct change){ id, place, before };
}

/* Exchange a thing as it is with what it was. Room for one more thing is there. */
static void change_swap(struct world *w, struct change *c)
{
	const int at = thing_index(w, c->id);
	struct Ful *present = at < 0 ? NULL : w->things[at];

	if (present && c->ful) {
		const bool other_shape = present->revision != c->ful->revision;
		c->ful->display = present->display; /* not a matter of undo */
		w->things[at] = c->ful;
		if (other_shape) {
			c->ful->revision = ++w->revision;
			overlays_drop(w, c->id);
		}
	} else if (present) {
		thing_take_out(w, at);
		c->place = at;
	} else if (c->ful) {
		const int place = c->place < w->n ? c->place : w->n;
		memmove(w->things + place + 1, w->things + place,
		        (size_t)(w->n - place) * sizeof *w->things);
		w->things[place] = c->ful;
		w->n++;
	}
	c->ful = present;
}

/* Places are right only in the order in which things came and went, so the list is turned round. */
static enum status step_swap(struct world *w, struct step *s)
{
	/* `grow` gives room where the count is a power of two: make sure of as many as may come */
	struct Ful **things = w->things;
	size_t room = 1;
	while (room < (size_t)(w->n + s->n) + 1)
		room *= 2;
	things = reallocarray(things, room, sizeof *things);
	if (!things)
		return ST_RESOURCE;
	w->things = things;
	for (int k = s->n - 1; k >= 0; k--)
		change_swap(w, &s->changes[k]);
	for (int k = 0; k < s->n / 2; k++) {
		struct change c = s->changes[k];
		s->changes[k] = s->changes[s->n - 1 - k];
		s->changes[s->n - 1 - k] = c;
	}
	thing_mend_current(w);
	for (int k = 0; k < s->n; k++)
		if (thing_get(w, s->changes[k].id))
			thing_make_current(w, thing_get(w, s->changes[k].id));
	w->revision++;
	return ST_OK;
}

static size_t step_bytes(const struct step *s)
{
	size_t n = sizeof *s;

	for (int k = 0; k < s->n; k++)
		n += s->changes[k].ful ? ful_bytes(s->changes[k].ful) : 0;
	return n;
}

/* The last step stays, however large it is. */
static void forget_oldest(struct history *h)
{
	int gone = 0;

	while (gone + 1 < h->n && h->bytes > history_most) {
		h->bytes -= step_bytes(&h->steps[gone]);
		step_finish(&h->steps[gone++]);
	}
	h->n -= gone;
	memmove(h->steps, h->steps + gone, (size_t)h->n * sizeof *h->steps);
}

void world_step_end(struct world *w, bool keep)
{
	if (--w->depth)
		return;
	struct step s = w->open;
	w->open = (struct step){ 0 };
	if (!s.n || (!keep && step_swap(w, &s) == ST_OK)) {
		step_finish(&s);
		return;
	}
	history_finish(&w->redo);
	w->undo.steps[w->undo.n++] = s;
	w->undo.bytes += step_bytes(&s);
	forget_oldest(&w->undo);
}

static enum status history_go(struct world *w, struct history *from, struct history *to,
                              const char *word, const struct report *r)
{
	if (!from->n)
		return report_error(r, ST_PARAMETER, "there is nothing to %s", word);
	enum status st = grow((void **)&to->steps, to->n, sizeof *to->steps);
	const size_t bytes = step_bytes(&from->steps[from->n - 1]);
	if (st == ST_OK)
		st = step_swap(w, &from->steps[from->n - 1]);
	if (st != ST_OK)
		return out_of_memory(r);
	struct step s = from->steps[--from->n];
	from->bytes -= bytes;
	to->bytes += step_bytes(&s);
	to->steps[to->n++] = s;
	return ST_OK;
}

enum status world_undo(struct world *w, const struct report *r)
{
	return history_go(w, &w->undo, &w->redo, "undo", r);
}

enum status world_redo(struct world *w, const struct report *r)
{
	return history_go(w, &w->redo, &w->undo, "redo", r);
}

static const char *last_name(const struct history *h)
{
	const char *name = h->n ? h->steps[h->n - 1].name : NULL;

	return h->n && !name ? "edit" : name;
}

const char *world_undo_name(const struct world *w)
{
	return last_name(&w->undo);
}

const char *world_redo_name(const struct world *w)
{
	return last_name(&w->redo);
}

static void mark_unsaved(struct history *h, const struct Ful *f)
{
	for (int k = 0; k < h->n; k++)
		for (int c = 0; c < h->steps[k].n; c++) {
			struct Ful *was = h->steps[k].changes[c].ful;
			if (!was || was->id != f->id)
				continue;
			was->saved = false;
			was->alone = f->alone && model_set_text(&was->file, f->file) == ST_OK;
		}
}

void history_saved(struct world *w, const struct Ful *f)
{
	mark_unsaved(&w->undo, f);
	mark_unsaved(&w->redo, f);
}
