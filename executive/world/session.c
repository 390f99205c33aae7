/* session.c - what is open, written down so that the next start finds it. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base.h"
#include "file.h"
#include "hash.h"
#include "json.h"
#include "path.h"
#include "text.h"
#include "world_private.h"

const char *const line_type_words[3] = { "solid", "dashed", "dotted" };
const char *const look_words[4] = { "wire", "shaded", "map", "image" };
const char *const view_split_words[N_SPLITS] = { "one", "side", "child", "uv" };

char *session_folder(const struct world *w)
{
	return path_join(w->folder, ".batten/session");
}

static json_t *rgb_json(struct rgb c)
{
	return json_pack("[f, f, f]", c.r, c.g, c.b);
}

static json_t *vec_json(struct vec3 v)
{
	return json_pack("[f, f, f]", v.x, v.y, v.z);
}

static json_t *display_json(const struct display *d)
{
	json_t *o = json_pack("{s:b, s:s, s:i, s:i, s:i, s:s, s:b, s:b, s:i}", "on", d->on, "line",
	                      line_type_words[d->line], "segments", d->segments, "lines_u",
	                      d->lines_u, "lines_v", d->lines_v, "look", look_words[d->look], "net",
	                      d->net, "porcupine", d->porcupine, "quills", d->quills);

	json_set_number(o, "quill", d->quill);
	if (d->has_color)
		json_object_set_new(o, "color", rgb_json(d->color));
	return o;
}

static json_t *camera_json(const struct camera *c)
{
	return json_pack("{s:b, s:o, s:o, s:o, s:o, s:f}", "perspective",
	                 c->kind == CAMERA_PERSPECTIVE, "eye", vec_json(c->eye), "right",
	                 vec_json(c->right), "up", vec_json(c->up), "ahead", vec_json(c->ahead),
	                 "half", c->half);
}

static json_t *sight_json(const struct sight *s)
{
	json_t *o =
	        json_pack("{s:f, s:f, s:f, s:o, s:f, s:b, s:b}", "light_azimuth", s->light_azimuth,
	                  "light_incidence", s->light_incidence, "light_intensity",
	                  s->light_intensity, "specular", rgb_json(s->specular), "reflectivity",
	                  s->reflectivity, "bell", s->bell, "all_curvatures", s->all_curvatures);

	json_object_set_new(o, "no_image", json_boolean(s->no_image));
	json_set_text(o, "split", view_split_words[s->split]);
	json_set_number(o, "near", s->near_);
	json_set_number(o, "far", s->far_);
	if (s->has_background)
		json_object_set_new(o, "background", rgb_json(s->background));
	if (s->has_camera)
		json_object_set_new(o, "camera", camera_json(&s->camera));
	if (s->has_beside)
		json_object_set_new(o, "beside", camera_json(&s->beside));
	return o;
}

/* Geometry that lies in no file goes to HASH.base in the session's folder. */
static enum status keep_geometry(const struct Ful *f, const char *folder, json_t *o,
                                 const struct report *r)
{
	struct model m;
	struct text t = { 0 };
	char hash[HASH_SIZE], *name = NULL, *path = NULL;

	model_init(&m);
	m.unit = f->unit;
	m.unit_in_mm = f->unit_in_mm;
	m.scale = f->scale;
	base_format_entity(&m, &f->entity, &t);
	enum status st = ST_RESOURCE;
	if (!t.failed) {
		hash_bytes(t.s, t.n, hash);
		name = text_print("%s.base", hash);
		path = name ? path_join(folder, name) : NULL;
	}
	if (!path)
		out_of_memory(r);
	else
		st = path_exists(path) ? ST_OK : file_write(path, t.s, t.n, r);
	json_set_text(o, "kept", name);
	free(path);
	free(name);
	text_finish(&t);
	return st;
}

static enum status add_thing(const struct Ful *f, const char *folder, json_t *things,
                             const struct report *r)
{
	json_t *o =
	        json_pack("{s:i, s:s, s:s?, s:b, s:b, s:s, s:i, s:i, s:i, s:f}", "id", f->id,
	                  "name", f->name, "file", f->file, "alone", f->alone, "saved", f->saved,
	                  "kind", entity_kind_name(f->entity.kind), "copy_of", f->copy_of,
	                  "offset_of", f->offset_of, "on", f->on, "offset", f->offset);

	if (!o)
		return out_of_memory(r);
	json_object_set_new(o, "stamp",
	                    json_pack("[I, I, I]", (json_int_t)f->stamp[0], (json_int_t)f->stamp[1],
	                              (json_int_t)f->stamp[2]));
	json_set_int(o, "place", f->place);
	json_set_int(o, "number", f->entity.number);
	json_object_set_new(o, "display", display_json(&f->display));
	json_array_append_new(things, o);
	return f->saved ? ST_OK : keep_geometry(f, folder, o, r);
}

static json_t *overlays_json(const struct world *w)
{
	json_t *list = json_array();

	for (int k = 0; k < w->n_overlays; k++) {
		const struct overlay *v = &w->overlays[k];
		/* a result whose job is not over has no file of its own */
		if (v->job)
			v = v->before;
		if (!v || !v->file)
			continue;
		json_t *o =
		        json_pack("{s:i, s:i, s:s, s:i, s:b, s:b, s:i}", "kind", v->kind, "thing",
		                  v->thing, "file", v->file, "quantity", v->quantity, "range_given",
		                  v->range_given, "symmetric", v->symmetric, "scale", v->scale);
		json_set_number(o, "lo", v->lo);
		json_set_number(o, "hi", v->hi);
		json_array_append_new(list, o);
	}
	return list;
}

static json_t *rest_json(const struct world *w, json_t *o)
{
	json_t *marks = json_array(), *defaults = json_array();

	for (int k = 0; k < w->n_marks; k++)
		json_array_append_new(marks,
		                      json_pack("{s:i, s:f, s:f}", "thing", w->marks[k].thing, "u",
		                                w->marks[k].u, "v", w->marks[k].v));
	for (int k = 0; k < w->n_presets; k++)
		json_array_append_new(defaults,
		                      json_pack("[s, s, s]", w->presets[k].worker,
		                                w->presets[k].parameter, w->presets[k].value));
	json_object_set_new(o, "current",
	                    json_pack("[i, i, i]", w->current[0], w->current[1], w->selected));
	json_object_set_new(o, "sight", sight_json(&w->sight));
	json_object_set_new(o, "overlays", overlays_json(w));
	json_object_set_new(o, "marks", marks);
	json_object_set_new(o, "defaults", defaults);
	return o;
}

static bool is_kept(const json_t *things, const char *name)
{
	size_t k;
	json_t *o;

	json_array_foreach(things, k, o) if (!strcmp(json_text(o, "kept", ""), name)) return true;
	return false;
}

/* Geometry that nothing names any more. */
static void sweep(const char *folder, const json_t *things)
{
	DIR *d = opendir(folder);
	struct dirent *e;

	while (d && (e = readdir(d))) {
		if (!path_has_suffix(e->d_name, ".base") || is_kept(things, e->d_name))
			continue;
		char *path = path_join(folder, e->d_name);
		if (path)
			unlink(path);
		free(path);
	}
	if (d)
		closedir(d);
}

enum status world_keep_session(const struct world *w, const struct report *r)
{
	char *folder = session_folder(w), *path = folder ? path_join(folder, "session.json") : NULL;
	json_t *things = json_array(), *o = json_object();
	enum status st = path && things && o ? folder_make(folder, 0777, r) : out_of_memory(r);

	for (int k = 0; k < w->n && st == ST_OK; k++)
		st = add_thing(w->things[k], folder, things, r);
	if (st == ST_OK) {
		json_set_int(o, "version", 1);
		json_set_int(o, "last_id", w->last_id);
		json_object_set(o, "things", things);
		rest_json(w, o);
		char *text = json_write(o, true);
		st = text ? file_write(path, text, strlen(text), r) : out_of_memory(r);
		free(text);
	}
	if (st == ST_OK)
		sweep(folder, things);
	json_decref(things);
	json_decref(o);
	free(path);
	free(folder);
	return st;
}
