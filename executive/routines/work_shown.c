/* work_shown.c - results of jobs among what is shown: when they are made, and while they are. */
#include <stdlib.h>
#include <string.h>

#include "exr.h"
#include "json.h"
#include "path.h"
#include "private.h"
#include "text.h"

/* kind of an output, kind of what is shown */
static const struct {
	const char *output;
	enum overlay_kind kind;
} kinds[] = {
	{ "map", OVERLAY_MAP },
	{ "curves", OVERLAY_LINES },
	{ "image", OVERLAY_IMAGE },
};

static bool kind_of(const char *output, enum overlay_kind *kind)
{
	for (size_t k = 0; output && k < sizeof kinds / sizeof *kinds; k++)
		if (!strcmp(kinds[k].output, output)) {
			*kind = kinds[k].kind;
			return true;
		}
	return false;
}

/* "94 branches, 3 closed" out of the figures that a result has. */
static void say_result(const struct act *a, const struct Stats *s, const struct job_output *o)
{
	static const char *const words[] = { "branches", "closed", "undecided", "length",
		                             "max_error" };
	struct text t = { 0 };

	for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
		const json_t *x = json_object_get(o->figures, words[k]);
		if (!json_is_number(x))
			continue;
		if (k < 3)
			text_addf(&t, ", %lld %s", (long long)json_number_value(x), words[k]);
		else
			text_addf(&t, ", %s %.6g", k == 3 ? "length" : "largest error",
			          json_number_value(x));
	}
	act_say(a, "job %lld done: %s%s", (long long)s->id, path_file_name(o->path),
	        t.s ? t.s : "");
	text_finish(&t);
}

void work_seen(struct world *w, enum overlay_kind kind)
{
	const bool image = kind == OVERLAY_IMAGE;
	bool hidden = false;

	for (int k = 0; k < world_overlays(w) && !image; k++)
		hidden |= world_overlay(w, k)->kind == OVERLAY_IMAGE;
	if (image || hidden)
		world_sight(w)->no_image = !image;
}

enum status work_show(struct act *a, const struct Stats *s, int thing, const struct overlay *like)
{
	struct overlay o = *like;
	enum status st = ST_OK;

	o.thing = thing;
	work_seen(a->world, like->kind);
	if (!job_state_table[s->state].over) {
		char *part = text_print("%s/parts/%lld.part", a->project->hidden, (long long)s->id);
		o.job = s->id;
		o.file = part;
		st = part ? world_show(a->world, &o) : ST_RESOURCE;
		free(part);
		act_say(a, "job %lld %s", (long long)s->id, job_state_table[s->state].word);
	}
	for (int k = 0; k < s->n_outputs && st == ST_OK && job_state_table[s->state].over; k++) {
		enum overlay_kind kind;
		if (!kind_of(s->outputs[k].kind, &kind) || kind != like->kind)
			continue;
		o.job = 0;
		o.file = s->outputs[k].path;
		st = world_show(a->world, &o);
		say_result(a, s, &s->outputs[k]);
		break;
	}
	return st == ST_OK ? st : act_memory(a);
}

void routine_job_ended(struct world *w, const struct Stats *s)
{
	if (!job_state_table[s->state].over)
		return;
	for (int k = world_overlays(w) - 1; k >= 0; k--) {
		struct overlay o = *world_overlay(w, k);
		bool found = false;
		if (o.job != s->id)
			continue;
		for (int j = 0; j < s->n_outputs && !found && s->state == JOB_DONE; j++) {
			enum overlay_kind kind;
			if (!kind_of(s->outputs[j].kind, &kind) || kind != o.kind)
				continue;
			o.job = 0;
			o.file = s->outputs[j].path;
			found = world_show(w, &o) == ST_OK;
		}
		if (!found)
			world_hide_job(w, o.kind, o.thing);
	}
}

static bool same(const char *a, const char *b)
{
	return a && b && !strcmp(a, b);
}

bool work_is_current(const char *path, const char *worker, const char hash[33], char **grid)
{
	bool current = false;

	if (grid)
		*grid = NULL;
	if (path_has_suffix(path, ".exr")) {
		struct exr_picture p;
		if (exr_read_attributes(&p, path, NULL) != ST_OK)
			return false;
		current = same(exr_text(&p, "worker"), worker) &&
		          same(exr_text(&p, "input_hash"), hash);
		const char *g = exr_text(&p, "param.grid");
		if (current && grid && g)
			*grid = strdup(g);
		exr_picture_finish(&p);
		return current;
	}
	struct model m;
	if (model_read(&m, path, NULL, NULL) != ST_OK)
		return false;
	current = same(model_get_attribute(&m, "worker"), worker) &&
	          same(model_get_attribute(&m, "input_hash"), hash);
	model_finish(&m);
	return current;
}
