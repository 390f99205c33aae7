/* session_read.c - the session as the last one left it. What is no longer there is told and left out. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "json.h"
#include "path.h"
#include "text.h"
#include "world_private.h"

enum { SESSION_MAX = 64 << 20, SESSION_VERSION = 1, ASIDE_MAX = 100 };

static struct rgb rgb_read(const json_t *a, struct rgb fallback)
{
	double v[3];

	for (size_t k = 0; k < 3; k++) {
		const json_t *x = json_array_get(a, k);
		if (!json_is_number(x))
			return fallback;
		v[k] = fmin(fmax(json_number_value(x), 0), 1);
	}
	return (struct rgb){ v[0], v[1], v[2] };
}

static bool vec_read(const json_t *a, struct vec3 *out)
{
	double v[3];

	for (size_t k = 0; k < 3; k++) {
		const json_t *x = json_array_get(a, k);
		if (!json_is_number(x))
			return false;
		v[k] = json_number_value(x);
	}
	*out = vec3(v[0], v[1], v[2]);
	return true;
}

static int word_index(const char *const *words, int n, const char *word)
{
	for (int k = 0; k < n; k++)
		if (!strcmp(words[k], word))
			return k;
	return 0;
}

static int bounded(const json_t *o, const char *key, int lo, int hi, int fallback)
{
	int64_t x = json_int(o, key, fallback);

	return x < lo || x > hi ? fallback : (int)x;
}

static void display_read(struct display *d, const json_t *o)
{
	const json_t *color = json_object_get(o, "color");

	d->on = json_flag(o, "on", d->on);
	d->line = (enum line_type)word_index(line_type_words, 3, json_text(o, "line", "solid"));
	d->look = (enum surface_look)word_index(look_words, 4, json_text(o, "look", "wire"));
	d->segments = bounded(o, "segments", 0, 100000, d->segments);
	d->lines_u = bounded(o, "lines_u", 0, 10000, d->lines_u);
	d->lines_v = bounded(o, "lines_v", 0, 10000, d->lines_v);
	d->quills = bounded(o, "quills", 2, 100000, d->quills);
	d->quill = json_number(o, "quill", d->quill);
	d->net = json_flag(o, "net", false);
	d->porcupine = json_flag(o, "porcupine", false);
	d->has_color = json_is_array(color);
	d->color = rgb_read(color, d->color);
}

/* False: it is not there, or not whole; *out stays. */
static bool camera_read(struct camera *out, const json_t *o)
{
	struct camera c = { .kind = json_flag(o, "perspective", false) ? CAMERA_PERSPECTIVE
		                                                       : CAMERA_ORTHOGRAPHIC,
		            .half = json_number(o, "half", 0) };

	if (!vec_read(json_object_get(o, "eye"), &c.eye) ||
	    !vec_read(json_object_get(o, "right"), &c.right) ||
	    !vec_read(json_object_get(o, "up"), &c.up) ||
	    !vec_read(json_object_get(o, "ahead"), &c.ahead) || !(c.half > 0))
		return false;
	*out = c;
	return true;
}

static void sight_read(struct sight *s, const json_t *o)
{
	const json_t *back = json_object_get(o, "background");

	s->light_azimuth = json_number(o, "light_azimuth", s->light_azimuth);
	s->light_incidence = json_number(o, "light_incidence", s->light_incidence);
	s->light_intensity = json_number(o, "light_intensity", s->light_intensity);
	s->specular = rgb_read(json_object_get(o, "specular"), s->specular);
	s->reflectivity = json_number(o, "reflectivity", s->reflectivity);
	s->near_ = json_number(o, "near", 0);
	s->far_ = json_number(o, "far", 0);
	s->bell = json_flag(o, "bell", s->bell);
	s->all_curvatures = json_flag(o, "all_curvatures", false);
	s->no_image = json_flag(o, "no_image", false);
	s->has_background = json_is_array(back);
	s->background = rgb_read(back, s->background);
	s->split = (enum view_split)word_index(view_split_words, N_SPLITS,
	                                       json_text(o, "split", "one"));
	s->has_camera = camera_read(&s->camera, json_object_get(o, "camera"));
	s->has_beside = camera_read(&s->beside, json_object_get(o, "beside"));
}

/* The file read last, since things of one file follow each other. */
struct source {
	const struct world *world;
	bool trims; /* are among the model's entities, too */
	char *path;
	struct model m;
};

static void source_finish(struct source *s)
{
	free(s->path);
	model_finish(&s->m);
	*s = (struct source){ .world = s->world };
	model_init(&s->m);
}

static enum status source_open(struct source *s, const char *path, const struct report *r)
{
	if (s->path && !strcmp(s->path, path))
		return ST_OK;
	source_finish(s);
	enum status st = world_read(s->world, &s->m, path, NULL, r);
	if (st == ST_OK)
		st = model_set_text(&s->path, path);
	return st;
}

/* Its entity in the file, where that is still one of its kind. */
static const struct entity *source_find(struct source *s, const json_t *o, bool kept)
{
	const int64_t place = kept ? 0 : json_int(o, "place", 0);

	if (place >= s->m.n && !s->trims) {
		s->trims = true;
		if (world_add_trims(&s->m) != ST_OK)
			return NULL;
	}
	const struct entity *e = place < 0 || place >= s->m.n ? NULL : &s->m.entities[place];

	return e && !strcmp(entity_kind_name(e->kind), json_text(o, "kind", "")) ? e : NULL;
}

/* A foreign file that is another one now may be one that never ends: the start does not wait for it. */
static bool is_another(const json_t *o, const char *path)
{
	const json_t *stamp = json_object_get(o, "stamp");
	int64_t now[3];
	bool same = true;

	if (json_array_size(stamp) != 3 || path_has_suffix(path, ".base"))
		return false;
	world_stamp(path, now);
	for (size_t k = 0; k < 3; k++)
		same = same && json_integer_value(json_array_get(stamp, k)) == now[k];
	return !same && now[2] > 0;
}

/* Geometry of ours that is not whole: the next keeping takes away what it does not name, but this may be all
 * there is of it. */
static void keep_damaged(const char *path)
{
	char *name = text_print("%s.damaged", path);

	if (name)
		rename(path, name); /* one that is not there stays so */
	free(name);
}

/* Warnings go to r, what ends the reading to wrong. */
static enum status read_thing(struct world *w, const json_t *o, const char *folder,
                              struct source *s, const struct report *r, const struct report *wrong)
{
	const char *kept = json_text(o, "kept", NULL), *file = json_text(o, "file", NULL);
	const char *name = json_text(o, "name", "thing");
	char *path = kept ? path_join(folder, path_file_name(kept)) : strdup(file ? file : "");
	struct entity copy;
	struct Ful *f = NULL;

	if (!path)
		return ST_RESOURCE;
	enum status st = ST_OK;
	if (!kept && is_another(o, path)) {
		report_warning(r, "'%s' is left out: '%s' has changed since; V175 opens it", name,
		               path);
		free(path);
		return ST_OK;
	}
	st = source_open(s, path, r);
	const struct entity *e = st == ST_OK ? source_find(s, o, kept != NULL) : NULL;
	if (!e && kept && st != ST_RESOURCE)
		keep_damaged(path);
	free(path);
	if (!e) {
		report_warning(r, "'%s' is left out: %s", name,
		               st == ST_OK ? "its file has changed" : "its file cannot be read");
		return st == ST_RESOURCE ? st : ST_OK;
	}
	st = entity_copy(&copy, e);
	if (st == ST_OK)
		st = ful_create(w, &f, &copy);
	if (st != ST_OK)
		return st;
	f->id = (int)json_int(o, "id", f->id);
	f->saved = !kept;
	f->alone = json_flag(o, "alone", false);
	f->place = (int)json_int(o, "place", 0);
	for (size_t k = 0; k < 3; k++)
		f->stamp[k] = json_integer_value(json_array_get(json_object_get(o, "stamp"), k));
	f->entity.number = (int)json_int(o, "number", 0);
	f->copy_of = (int)json_int(o, "copy_of", 0);
	f->offset_of = (int)json_int(o, "offset_of", 0);
	if (f->entity.kind == ENTITY_CURVE_ON_SURFACE)
		f->on = (int)json_int(o, "on", 0);
	f->offset = json_number(o, "offset", 0);
	f->unit_in_mm = s->m.unit_in_mm;
	f->scale = s->m.scale;
	display_read(&f->display, json_object_get(o, "display"));
	f->name = name_unique(w, name);
	st = f->name ? model_set_text(&f->file, file) : ST_RESOURCE;
	if (st == ST_OK)
		st = model_set_text(&f->unit, s->m.unit);
	if (st == ST_OK && thing_get(w, f->id))
		st = report_error(wrong, ST_INPUT, "the session names thing %d twice", f->id);
	if (st == ST_OK)
		return thing_append(w, f);
	ful_destroy(f);
	return st;
}

static void read_overlays(struct world *w, const json_t *list, const struct report *r)
{
	size_t k;
	json_t *o;

	json_array_foreach(list, k, o)
	{
		char *file = strdup(json_text(o, "file", ""));
		struct overlay v = {
			.kind = (enum overlay_kind)bounded(o, "kind", 0, OVERLAY_IMAGE, 0),
			.thing = (int)json_int(o, "thing", 0),
			.file = file,
			.quantity = (enum quantity)bounded(o, "quantity", 0, N_QUANTITIES - 1, 0),
			.range_given = json_flag(o, "range_given", false),
			.symmetric = json_flag(o, "symmetric", false),
			.lo = json_number(o, "lo", 0),
			.hi = json_number(o, "hi", 0),
			.scale = (enum colormap_scale)bounded(o, "scale", 0, COLORMAP_AUTOMATIC,
			                                      COLORMAP_AUTOMATIC),
		};
		if (file && !path_exists(file))
			report_warning(r, "'%s' is no longer there and is not shown", file);
		else if (file && (!v.thing || thing_get(w, v.thing)))
			world_show(w, &v);
		free(file);
	}
}

static void read_rest(struct world *w, const json_t *o, const struct report *r)
{
	const json_t *current = json_object_get(o, "current");
	size_t k;
	json_t *x;

	for (size_t c = 0; c < 2; c++)
		w->current[c] = (int)json_integer_value(json_array_get(current, c));
	w->selected = (int)json_integer_value(json_array_get(current, 2));
	thing_mend_current(w);
	sight_read(&w->sight, json_object_get(o, "sight"));
	read_overlays(w, json_object_get(o, "overlays"), r);
	json_array_foreach(json_object_get(o, "marks"), k, x)
	{
		const struct mark m = { (int)json_int(x, "thing", 0), json_number(x, "u", 0),
			                json_number(x, "v", 0) };
		world_keep_mark(w, &m);
	}
	json_array_foreach(json_object_get(o, "defaults"), k, x)
	{
		const char *worker = json_string_value(json_array_get(x, 0)),
		           *parameter = json_string_value(json_array_get(x, 1)),
		           *value = json_string_value(json_array_get(x, 2));
		if (worker && parameter && value)
			world_set_default(w, worker, parameter, value);
	}
}

/* A curve whose surface was left out cannot stay. */
static void drop_orphans(struct world *w, const struct report *r)
{
	for (int k = w->n - 1; k >= 0; k--) {
		struct Ful *f = w->things[k];
		if (!f->on || ful_is_surface(thing_get(w, f->on)))
			continue;
		report_warning(r, "'%s' is left out: its surface is", f->name);
		thing_take_out(w, k);
		ful_destroy(f);
	}
}

/* The next keeping would take away what this one could not read: out of its way. Fresh name, NULL: it stays. */
static char *set_aside(const char *folder)
{
	for (int k = 1; k < ASIDE_MAX; k++) {
		char *name = text_print("%s-%d", folder, k);
		if (name && !path_exists(name) && !rename(folder, name))
			return name;
		free(name);
	}
	return NULL;
}

static enum status read_session(json_t **o, const char *path, const struct report *r)
{
	char *text = NULL;
	size_t n = 0;
	enum status st = file_read(path, SESSION_MAX, &text, &n, r);

	if (st == ST_OK)
		st = json_parse_object(text, n, path, o, r);
	free(text);
	if (st == ST_OK && json_int(*o, "version", SESSION_VERSION) > SESSION_VERSION)
		st = report_error(r, ST_INPUT, "'%s' was written by a later batten", path);
	return st;
}

/* The sentence of what went wrong, with where it all is now. */
static void say_aside(const struct report_store *said, enum status st, const char *folder,
                      const struct report *r)
{
	char *aside = set_aside(folder);

	if (aside)
		report_error(r, st, "%s; the session and its geometry are kept in '%s'",
		             said->error, aside);
	else
		report_error(r, st, "%s", said->error);
	free(aside);
}

enum status world_restore_session(struct world *w, const struct report *r)
{
	char *folder = session_folder(w), *path = folder ? path_join(folder, "session.json") : NULL;
	size_t k;
	json_t *o = NULL, *x;
	struct source s = { .world = w };
	struct report_store said;
	enum status st = path ? ST_OK : out_of_memory(r);

	model_init(&s.m);
	report_store_init(&said);
	if (st != ST_OK || !path_exists(path))
		goto done;
	st = read_session(&o, path, &said.report);
	json_array_foreach(json_object_get(o, "things"), k, x) if (st == ST_OK) st =
	        read_thing(w, x, folder, &s, r, &said.report);
	if (st != ST_OK)
		say_aside(&said, st, folder, r);
	if (st == ST_OK) {
		for (int f = 0; f < w->n; f++)
			if (w->things[f]->id > w->last_id)
				w->last_id = w->things[f]->id;
		if (json_int(o, "last_id", 0) > w->last_id)
			w->last_id = (int)json_int(o, "last_id", 0);
		drop_orphans(w, r);
		read_rest(w, o, r);
		w->revision++;
	}
done:
	source_finish(&s);
	json_decref(o);
	free(path);
	free(folder);
	return st;
}
