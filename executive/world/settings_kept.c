/* settings_kept.c - defaults of later jobs that the setting routines store. */
#include <stdlib.h>
#include <string.h>

#include "world_private.h"

static struct preset *find(const struct world *w, const char *worker, const char *parameter)
{
	for (int k = 0; k < w->n_presets; k++)
		if (!strcmp(w->presets[k].worker, worker) &&
		    !strcmp(w->presets[k].parameter, parameter))
			return &w->presets[k];
	return NULL;
}

static void preset_finish(struct preset *p)
{
	free(p->worker);
	free(p->parameter);
	free(p->value);
}

void presets_finish(struct world *w)
{
	for (int k = 0; k < w->n_presets; k++)
		preset_finish(&w->presets[k]);
	free(w->presets);
	w->presets = NULL;
	w->n_presets = 0;
}

enum status world_set_default(struct world *w, const char *worker, const char *parameter,
                              const char *value)
{
	struct preset *p = find(w, worker, parameter);

	w->revision++;
	if (p && value)
		return model_set_text(&p->value, value);
	if (p) {
		preset_finish(p);
		*p = w->presets[--w->n_presets];
		return ST_OK;
	}
	if (!value)
		return ST_OK;
	struct preset fresh = { strdup(worker), strdup(parameter), strdup(value) };
	enum status st = grow((void **)&w->presets, w->n_presets, sizeof *w->presets);
	if (st == ST_OK && fresh.worker && fresh.parameter && fresh.value) {
		w->presets[w->n_presets++] = fresh;
		return ST_OK;
	}
	preset_finish(&fresh);
	return ST_RESOURCE;
}

const char *world_default(const struct world *w, const char *worker, const char *parameter)
{
	const struct preset *p = find(w, worker, parameter);

	return p ? p->value : NULL;
}
