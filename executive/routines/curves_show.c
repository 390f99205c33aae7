/* curves_show.c - how curves (and surfaces, where the leaf is the same) are drawn. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "on_surface.h"
#include "path.h"
#include "private.h"
#include "text.h"

enum { PICTURE_WIDTH = 1280, PICTURE_HEIGHT = 800 };

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

/* One row of the table: what the curve is at t. */
static void add_sample(struct text *t, const struct Ful *f, const struct surface *on, double at,
                       double length)
{
	struct curve_shape shape;
	struct on_surface_shape with = { .normal_curvature = NAN, .geodesic_curvature = NAN };
	const struct on_surface c = { &f->entity.curve, on };

	if (on) {
		on_surface_shape(&c, at, &with);
		shape = with.space;
	} else
		curve_shape(&f->entity.curve, at, &shape);
	const double values[] = { at,
		                  length,
		                  shape.point.x,
		                  shape.point.y,
		                  shape.point.z,
		                  shape.curvature,
		                  shape.torsion,
		                  with.normal_curvature,
		                  with.geodesic_curvature };
	const size_t n = on ? 9 : 7;
	for (size_t k = 0; k < n; k++) {
		text_add(t, k ? "," : "");
		if (values[k] == values[k])
			text_add_number(t, values[k]);
	}
	text_add(t, "\n");
}

static struct vec3 point_at(const struct Ful *f, const struct surface *on, double at)
{
	const struct vec3 p = curve_point(&f->entity.curve, at);

	return on ? surface_point(on, p.x, p.y) : p;
}

/* Curvature and torsion along the curve as a table; lengths by chords between the samples. */
static enum status save_table(const struct act *a, const struct Ful *f, int samples,
                              const char *name)
{
	const struct Ful *base = f->on ? world_by_id(a->world, f->on) : NULL;
	const struct surface *on = base ? &base->entity.geometry : NULL;
	const double *domain = f->entity.curve.domain;
	struct text t = { 0 };
	double length = 0;
	struct vec3 before = point_at(f, on, domain[0]);
	char *path = act_path(a, name);

	text_add(&t, "t,length,x,y,z,curvature,torsion");
	text_add(&t, on ? ",normal_curvature,geodesic_curvature\n" : "\n");
	for (int k = 0; k < samples; k++) {
		const double at = domain[0] + (domain[1] - domain[0]) * k / (samples - 1);
		const struct vec3 p = point_at(f, on, at);
		length += vec3_length(vec3_sub(p, before));
		before = p;
		add_sample(&t, f, on, at, length);
	}
	enum status st = path && !t.failed ? file_write(path, t.s, t.n, &a->report) : act_memory(a);
	if (st == ST_OK)
		act_say(a, "%d samples in %s", samples, path_file_name(path));
	text_finish(&t);
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
	return st == ST_OK && save ? save_table(a, f, d.quills, save) : st;
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
