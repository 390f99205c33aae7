/* overlays.c - results that are shown, and marks that were kept. */
#include <stdlib.h>
#include <string.h>

#include "world_private.h"

static void drop_before(struct overlay *o)
{
	if (o->before)
		free(o->before->file);
	free(o->before);
	o->before = NULL;
}

static void remove_overlay(struct world *w, int k)
{
	drop_before(&w->overlays[k]);
	free(w->overlays[k].file);
	w->n_overlays--;
	memmove(w->overlays + k, w->overlays + k + 1,
	        (size_t)(w->n_overlays - k) * sizeof *w->overlays);
}

void overlays_finish(struct world *w)
{
	while (w->n_overlays)
		remove_overlay(w, w->n_overlays - 1);
	free(w->overlays);
	free(w->marks);
	w->overlays = NULL;
	w->marks = NULL;
	w->n_marks = 0;
}

void overlays_drop(struct world *w, int id)
{
	int kept = 0;

	for (int k = w->n_overlays - 1; k >= 0; k--)
		if (w->overlays[k].thing == id)
			remove_overlay(w, k);
	for (int k = 0; k < w->n_marks; k++)
		if (w->marks[k].thing != id)
			w->marks[kept++] = w->marks[k];
	w->n_marks = kept;
}

static int find_overlay(const struct world *w, enum overlay_kind kind, int thing)
{
	for (int k = 0; k < w->n_overlays; k++)
		if (w->overlays[k].kind == kind && w->overlays[k].thing == thing)
			return k;
	return -1;
}

/* What a job that begins hides: a result that is whole, or what the job before it hid. */
static enum status keep_before(struct overlay *o, struct overlay *old)
{
	if (o->job && old->job) {
		o->before = old->before;
		old->before = NULL;
	} else if (o->job) {
		o->before = malloc(sizeof *o->before);
		if (!o->before)
			return ST_RESOURCE;
		*o->before = *old;
		old->file = NULL;
	}
	drop_before(old);
	return ST_OK;
}

bool world_shows_seven(const struct world *w)
{
	for (int k = 0; k < w->n_overlays && !w->sight.no_image; k++)
		if (w->overlays[k].kind == OVERLAY_IMAGE)
			return false;
	return w->sight.all_curvatures;
}

enum status world_show(struct world *w, const struct overlay *o)
{
	struct overlay copy = *o;
	int at = find_overlay(w, o->kind, o->thing);
	enum status st = ST_OK;

	copy.file = NULL;
	copy.before = NULL;
	if (o->file && !(copy.file = strdup(o->file)))
		return ST_RESOURCE;
	if (at >= 0 && (st = keep_before(&copy, &w->overlays[at])) == ST_OK) {
		free(w->overlays[at].file);
		w->overlays[at] = copy;
	} else if (at >= 0)
		free(copy.file);
	else if ((st = grow((void **)&w->overlays, w->n_overlays, sizeof *w->overlays)) == ST_OK)
		w->overlays[w->n_overlays++] = copy;
	else
		free(copy.file);
	w->revision++;
	return st;
}

void world_hide(struct world *w, enum overlay_kind kind, int thing)
{
	int at = find_overlay(w, kind, thing);

	if (at >= 0)
		remove_overlay(w, at);
	w->revision++;
}

void world_hide_job(struct world *w, enum overlay_kind kind, int thing)
{
	const int at = find_overlay(w, kind, thing);
	struct overlay *before = at >= 0 ? w->overlays[at].before : NULL;

	if (before) {
		free(w->overlays[at].file);
		w->overlays[at] = *before;
		free(before);
	} else if (at >= 0)
		remove_overlay(w, at);
	w->revision++;
}

int world_overlays(const struct world *w)
{
	return w->n_overlays;
}

const struct overlay *world_overlay(const struct world *w, int k)
{
	return k >= 0 && k < w->n_overlays ? &w->overlays[k] : NULL;
}

enum status world_keep_mark(struct world *w, const struct mark *m)
{
	if (!ful_is_surface(thing_get(w, m->thing)))
		return ST_PARAMETER;
	enum status st = grow((void **)&w->marks, w->n_marks, sizeof *w->marks);
	if (st == ST_OK) {
		w->marks[w->n_marks++] = *m;
		w->revision++;
	}
	return st;
}

int world_marks(const struct world *w)
{
	return w->n_marks;
}

const struct mark *world_mark(const struct world *w, int k)
{
	return k >= 0 && k < w->n_marks ? &w->marks[k] : NULL;
}

void world_drop_marks(struct world *w)
{
	w->n_marks = 0;
	w->revision++;
}
