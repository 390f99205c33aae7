/* curves_show.c - how curves (and surfaces, where the leaf is the same) are drawn. */
#include <stdlib.h>
#include <string.h>

#include "curve_samples.h"
#include "path.h"
#include "private.h"

enum { PICTURE_WIDTH = 1280, PICTURE_HEIGHT = 800, GRAPH_SAMPLES = 801 };

/* The current thing of the leaf's kind, and how it is drawn. */
static const struct Ful *current(const struct act *a, struct display *d)
{
	const struct Ful *f = act_current_kind(a, (enum entity_kind)a->routine->detail);

	if (f)
		*d = f->display;
	return f;
}

enum status show_segments(struct act *a, const struct arguments *given)
{
	struct display d;
	const struct Ful *f = current(a, &d);

	if (!f)
		return ST_PARAMETER;
	d.segments = (int)argument_number(given, "segments", 0);
	return world_set_display(a->world, f->id, &d);
}

enum status show_color(struct act *a, const struct arguments *given)
{
	struct display d;
	const struct Ful *f = current(a, &d);

	if (!f)
		return ST_PARAMETER;
	d.has_color = argument_color(given, "color", &d.color);
	return world_set_display(a->world, f->id, &d);
}

enum status show_line_type(struct act *a, const struct arguments *given)
{
	static const char *const words[] = { "solid", "dashed", "dotted" };
	const char *word = argument_text(given, "linetype");
	struct display d;
	const struct Ful *f = current(a, &d);

	if (!f)
		return ST_PARAMETER;
	for (int k = 0; k < 3; k++)
		if (!strcmp(word, words[k]))
			d.line = (enum line_type)k;
	return world_set_display(a->world, f->id, &d);
}

/* Everything that is shown, in space. */
static enum status shown_box(const struct act *a, struct box *box)
{
	*box = box_empty();
	for (int k = 0; k < world_count(a->world); k++) {
		const struct Ful *f = world_at(a->world, k);
		struct box one;
		if (!f->display.on ||
		    (f->entity.kind == ENTITY_CURVE_ON_SURFACE && !f->entity.space.order))
			continue;
		if (entity_box(&f->entity, &one) != ST_OK)
			return act_memory(a);
		box_add_box(box, &one);
	}
	if (box_is_empty(box))
		return report_error(&a->report, ST_PARAMETER,
		                    "nothing is shown that could be looked at");
	return ST_OK;
}

enum status show_view(struct act *a, const struct arguments *given)
{
	struct box box;
	struct sight *s = world_sight(a->world);
	const int width = s->has_camera && s->camera.width ? s->camera.width : PICTURE_WIDTH,
	          height = s->has_camera && s->camera.height ? s->camera.height : PICTURE_HEIGHT;
	enum status st = shown_box(a, &box);

	if (st == ST_OK)
		st = camera_fit(&s->camera, argument_text(given, "view"), &box, width, height,
		                &a->report);
	if (st == ST_OK) {
		s->has_camera = true;
		world_touch(a->world);
	}
	return st;
}

enum status show_samples(struct act *a, const struct arguments *given)
{
	struct display d;
	const struct Ful *f = current(a, &d);

	if (!f)
		return ST_PARAMETER;
	d.quills = (int)argument_number(given, "samples", d.quills);
	return world_set_display(a->world, f->id, &d);
}

/* The curve's values as a table or a graph, by the extension of the file. */
static enum status save_values(const struct act *a, const struct Ful *f, int quills,
                               const char *name)
{
	const bool table = !strcmp(path_extension(name), ".csv");
	struct curve_samples s;
	char *path = act_path(a, name);
	enum status st = path ? curve_samples_take(&s, a->world, f, table ? quills : GRAPH_SAMPLES)
	                      : ST_RESOURCE;

	if (st != ST_OK) {
		free(path);
		return act_memory(a);
	}
	st = table ? curve_samples_write(&s, path, &a->report)
	           : curve_graph_write(&s, f->name, f->unit, path, &a->report);
	if (st == ST_OK)
		act_say(a, "smallest radius %.6g, in %s", 1 / curve_samples_sharpest(&s),
		        path_file_name(path));
	curve_samples_finish(&s);
	free(path);
	return st;
}

enum status show_porcupine(struct act *a, const struct arguments *given)
{
	const char *save = argument_text(given, "save");
	struct display d;
	const struct Ful *f = current(a, &d);

	if (!f)
		return ST_PARAMETER;
	const double scale = argument_number(given, "scale", d.quill);
	d.porcupine = scale > 0;
	d.quill = scale > 0 ? scale : d.quill;
	enum status st = world_set_display(a->world, f->id, &d);
	return st == ST_OK && save ? save_values(a, f, d.quills, save) : st;
}

static enum status turn(struct act *a, bool on)
{
	struct display d;
	const struct Ful *f = current(a, &d);

	if (!f)
		return ST_PARAMETER;
	d.on = on;
	return world_set_display(a->world, f->id, &d);
}

enum status show_on(struct act *a, const struct arguments *given)
{
	(void)given;
	return turn(a, true);
}

enum status show_off(struct act *a, const struct arguments *given)
{
	(void)given;
	return turn(a, false);
}
