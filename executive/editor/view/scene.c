/* scene.c - surfaces, curves, nets, points and combs drawn. */
#include <stdlib.h>

#include "view_private.h"

enum {
	MOVING_TRIANGLES = 100000, /* over all, while something is dragged */
	FINE_TRIANGLES = 600000,
	FLUSHED = 16384, /* a driver begins with so many while more come */
};
static const double chord_px = 0.2;      /* of triangles from their surface, device px */
static const double line_px = 0.1;       /* of chords from their curve */
static const double moved_line_px = 0.6; /* while something is dragged */
static const double small_triangle = 64; /* device px squared */
static const double coarse_chord = 1e-3; /* of the scene's size */
static const double border_back = 2;     /* px, of borders behind their surface */
static const double cut_seconds = 0.06;  /* a drawing may spend on triangles */

/* Shading as in the shading worker's pictures. */
static const double ambient = 0.3, diffuse = 0.5, highlight = 0.12, sharpness = 40;
static const struct rgb plain_surface = { 0xC3 / 255.0, 0xCC / 255.0, 0xD4 / 255.0 };

/* Lines on a surface stand before it by this many px. */
enum { LIFT_WIRE = 1, LIFT_RESULT = 2, LIFT_CURVE = 3, LIFT_NET = 4, LIFT_POINT = 5 };

/* How a surface is drawn now: a map without values is a wire frame. */
static enum surface_look look_of(const struct drawing *d, const struct Ful *f)
{
	if (f->entity.kind != ENTITY_SURFACE || f->display.look == LOOK_IMAGE)
		return LOOK_WIRE;
	if (f->display.look == LOOK_MAP &&
	    map_quantity(d, overlay_of(d->world, OVERLAY_MAP, f->id)) < 0)
		return LOOK_WIRE;
	return f->display.look;
}

/* The smallest length of a pixel anywhere on what is seen. */
static double smallest_pixel(const struct drawing *d)
{
	const struct camera *c = &d->camera;
	struct vec3 at = box_center(&d->box);
	if (c->kind == CAMERA_PERSPECTIVE) {
		double size = box_diagonal(&d->box);
		double z = vec3_dot(vec3_sub(at, c->eye), c->ahead) - 0.5 * size;
		at = vec3_along(c->eye, fmax(z, 1e-2 * size), c->ahead);
	}
	return camera_pixel(c, at);
}

static const struct shape_mesh *finest(const struct shape *x)
{
	return x->fine.chord > 0 && x->fine.chord <= x->coarse.chord ? &x->fine : &x->coarse;
}

/* What was last seen at rest is not too much to be moved. */
static bool fine_is_quick(struct shape *const *solid, int n)
{
	double sum = 0;
	for (int i = 0; i < n; i++)
		sum += finest(solid[i])->triangles;
	return sum <= MOVING_TRIANGLES;
}

static enum status make_triangles(struct drawing *d, double pixel)
{
	struct shape **solid = calloc((size_t)d->n_shown + 1, sizeof *solid);
	int n = 0;
	if (!solid)
		return report_error(d->report, ST_RESOURCE, "cannot draw: memory ran out");
	for (int i = 0; i < d->n_shown; i++)
		if (d->in_view[i] && look_of(d, d->things[i]) != LOOK_WIRE)
			solid[n++] = d->shown[i];
	enum status st = shapes_cut_coarse(&d->view->shapes, solid, n,
	                                   coarse_chord * box_diagonal(&d->box), MOVING_TRIANGLES);
	d->fine = st == ST_OK && (!d->state->moving || fine_is_quick(solid, n));
	if (st == ST_OK && !d->state->moving)
		st = shapes_cut(solid, n, false, chord_px * pixel, FINE_TRIANGLES, cut_seconds,
		                &d->more);
	free((void *)solid);
	return st == ST_OK ? st : report_error(d->report, st, "cannot draw: %s", status_text(st));
}

static void set_eye(const struct drawing *d, const GLint *u, struct vec3 origin)
{
	const struct camera *c = &d->camera;
	struct vec3 eye = vec3_sub(c->eye, origin), back = vec3_scale(c->ahead, -1);
	if (c->kind == CAMERA_ORTHOGRAPHIC)
		glUniform4f(u[UNIFORM_EYE], (float)back.x, (float)back.y, (float)back.z, 0);
	else
		glUniform4f(u[UNIFORM_EYE], (float)eye.x, (float)eye.y, (float)eye.z, 1);
}

static void set_vector(GLint at, struct vec3 v)
{
	glUniform3f(at, (float)v.x, (float)v.y, (float)v.z);
}

/* Does the file say how it looks? Black is what CAD systems write for "as the pen is". */
static struct rgb surface_color(const struct Ful *f)
{
	struct rgb c = f->display.color;
	return f->display.has_color && c.r + c.g + c.b > 0.15 ? c : plain_surface;
}

/* Are its triangles so small that light at their corners does? */
static bool is_small(const struct drawing *d, const struct shape *x, const struct shape_mesh *m)
{
	const double across = box_diagonal(&x->box) / drawing_pixel(d, x->origin);
	return across * across <= small_triangle * m->triangles;
}

static void count_triangles(struct view *v, int n)
{
	const int before = v->triangles / FLUSHED;
	v->triangles += n;
	if (v->triangles / FLUSHED > before)
		glFlush();
}

static void draw_surface(struct drawing *d, const struct Ful *f, struct shape *x)
{
	const struct shape_mesh *m = d->fine ? finest(x) : &x->coarse;
	const bool map = look_of(d, f) == LOOK_MAP;
	const bool quick = d->state->moving && !map && is_small(d, x, m);
	const enum program program = quick ? PROGRAM_QUICK : PROGRAM_SURFACE;
	const struct sight *s = world_sight((struct world *)d->world);
	const struct rgb color = surface_color(f);
	const double shine = (s->specular.r + s->specular.g + s->specular.b) / 3 *
	                     (highlight + 0.5 * s->reflectivity);
	float matrix[16];
	if (!m->gpu.n || m->failed)
		return;
	const GLint *u = program_use(d->frame.programs, program);
	gpu_matrix(&d->frame, x->origin, matrix);
	glUniformMatrix4fv(u[UNIFORM_MATRIX], 1, GL_FALSE, matrix);
	set_eye(d, u, x->origin);
	glUniform4f(u[UNIFORM_COLOR], (float)rgb_to_linear(color.r), (float)rgb_to_linear(color.g),
	            (float)rgb_to_linear(color.b), 1);
	set_vector(u[UNIFORM_LIGHT], d->light);
	set_vector(u[UNIFORM_FILL], d->fill);
	set_vector(u[UNIFORM_SKY], d->sky);
	glUniform4f(u[UNIFORM_STRENGTH], (float)ambient, (float)(diffuse * s->light_intensity),
	            (float)(shine * s->light_intensity), (float)sharpness);
	glUniform1f(u[UNIFORM_SCALE], (float)d->frame.scale);
	glUniform1i(u[UNIFORM_LOOK], map && map_use(d, f->id));
	glBindVertexArray(m->gpu.array);
	glUniform1f(u[UNIFORM_BIAS], 0);
	glDrawElements(GL_TRIANGLES, m->gpu.n, GL_UNSIGNED_INT, NULL);
	count_triangles(d->view, m->triangles);
	/* Chords of neighbours part by less than a px: borders are as wide, a little behind. */
	glUniform1f(u[UNIFORM_BIAS], (float)(border_back * d->frame.pixel_depth));
	glDrawElements(GL_LINES, m->gpu.n_border, GL_UNSIGNED_INT,
	               (const void *)((size_t)m->gpu.n * sizeof(unsigned)));
	glBindVertexArray(0);
}

static void draw_surfaces(struct drawing *d)
{
	glDisable(GL_BLEND);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_LESS);
	glDepthMask(GL_TRUE);
	d->view->triangles = 0;
	/* triangles step back by their slope, so that lines on them are whole */
	glEnable(GL_POLYGON_OFFSET_FILL);
	glPolygonOffset(1.5F, 2);
	for (int i = 0; i < d->n_shown; i++)
		if (d->in_view[i] && look_of(d, d->things[i]) != LOOK_WIRE)
			draw_surface(d, d->things[i], d->shown[i]);
	glDisable(GL_POLYGON_OFFSET_FILL);
}

static void draw(struct drawing *d, int i, enum shape_lines which, struct gpu_style style)
{
	struct shape *x = d->shown[i];
	const enum line_type line = d->things[i]->display.line;
	if (which <= SHAPE_CURVE && line != LINE_SOLID) {
		style.dash[0] = line == LINE_DASHED ? 6 : 1.5;
		style.dash[1] = line == LINE_DASHED ? 4 : 3;
	}
	if (d->state->moving && which < (int)N_MOVED_LINES && !(style.dash[1] > 0))
		gpu_draw_ribbon(&d->frame, &x->moved_lines[which], x->origin, &style);
	else
		gpu_draw_lines(&d->frame, &x->lines[which], &x->poly[which], &style);
}

static void draw_wires(struct drawing *d)
{
	const struct rgb on_map = { 0x14 / 255.0, 0x17 / 255.0, 0x1A / 255.0 };
	for (int i = 0; i < d->n_shown; i++) {
		const struct Ful *f = d->things[i];
		if (f->entity.kind != ENTITY_SURFACE || !d->in_view[i])
			continue;
		const enum surface_look look = look_of(d, f);
		const bool own =
		        look == LOOK_WIRE && f->display.has_color &&
		        f->display.color.r + f->display.color.g + f->display.color.b > 0.15;
		struct gpu_style wire = { .color = drawing_color(d, TOKEN_TEXT),
			                  .alpha = 0.25,
			                  .width = 0.75,
			                  .lift = LIFT_WIRE };
		struct gpu_style edge = { .color = drawing_color(d, TOKEN_TEXT2),
			                  .alpha = 0.6,
			                  .width = 1,
			                  .lift = LIFT_WIRE };
		if (look != LOOK_WIRE) {
			/* on a lit surface or a map dark lines are read in both themes */
			wire.color = on_map;
			wire.alpha = 0.22;
			edge.color = on_map;
			edge.alpha = 0.4;
		}
		if (own) {
			wire.color = edge.color = f->display.color;
			wire.alpha = 0.45;
		}
		if (f->id == d->state->chosen)
			edge = (struct gpu_style){ .color = drawing_color(d, TOKEN_ACCENT),
				                   .alpha = 1,
				                   .width = 2,
				                   .lift = LIFT_RESULT };
		if (f->id == d->state->hover_thing && d->state->hover_point < 0)
			edge.width += 1;
		draw(d, i, SHAPE_WIRE, wire);
		draw(d, i, SHAPE_EDGE, edge);
	}
}

/* A curve in its style; what lies behind surfaces dashed and at half strength. */
static void draw_curve(struct drawing *d, int i, bool current)
{
	const struct Ful *f = d->things[i];
	struct gpu_style line = { .color = drawing_color(d, current ? TOKEN_CURRENT : TOKEN_TEXT),
		                  .alpha = 1,
		                  .width = current ? 2 : 1.5,
		                  .lift = LIFT_CURVE };
	if (!current && f->display.has_color &&
	    f->display.color.r + f->display.color.g + f->display.color.b > 0.15)
		line.color = f->display.color;
	if (f->id == d->state->hover_thing && d->state->hover_point < 0)
		line.width += 1;
	struct gpu_style hidden = line;
	hidden.dash[0] = 2;
	hidden.dash[1] = 3;
	hidden.alpha = 0.5;
	glDepthFunc(GL_GREATER);
	gpu_draw_lines(&d->frame, &d->shown[i]->lines[SHAPE_CURVE], &d->shown[i]->poly[SHAPE_CURVE],
	               &hidden);
	glDepthFunc(GL_LEQUAL);
	if (current) {
		struct gpu_style casing = line;
		casing.color = d->ground;
		casing.alpha = 0.55;
		casing.width += 4;
		draw(d, i, SHAPE_CURVE, casing);
	}
	draw(d, i, SHAPE_CURVE, line);
}

static void draw_curves(struct drawing *d)
{
	const struct Ful *current = world_current(d->world, true);
	for (int last = 0; last < 2; last++)
		for (int i = 0; i < d->n_shown; i++)
			if (ful_is_curve(d->things[i]) && d->in_view[i] &&
			    (d->things[i] == current) == last)
				draw_curve(d, i, last);
}

static void draw_combs(struct drawing *d)
{
	static const struct rgb side[2] = { { 0x5E / 255.0, 0x97 / 255.0, 0xCC / 255.0 },
		                            { 0xDA / 255.0, 0x85 / 255.0, 0x44 / 255.0 } };
	for (int i = 0; i < d->n_shown; i++) {
		if (!d->things[i]->display.porcupine)
			continue;
		struct gpu_style quill = { .alpha = 0.85, .width = 1, .lift = LIFT_WIRE };
		for (int k = 0; k < 2; k++) {
			quill.color = side[k];
			draw(d, i, SHAPE_QUILLS + k, quill);
		}
		draw(d, i, SHAPE_ENVELOPE,
		     (struct gpu_style){ .color = drawing_color(d, TOKEN_TEXT2),
		                         .alpha = 1,
		                         .width = 1.25,
		                         .lift = LIFT_WIRE });
	}
}

/* Nets and their points lie off their surface and are seen through it. */
static void draw_nets(struct drawing *d)
{
	const struct Ful *current = world_current(d->world, true);
	for (int i = 0; i < d->n_shown; i++) {
		const struct Ful *f = d->things[i];
		const bool list = f->entity.kind == ENTITY_POINTS;
		const bool pink = f == current || list;
		if ((!f->display.net && !list) || !d->in_view[i])
			continue;
		struct gpu_style net = { .color = drawing_color(d, TOKEN_NET),
			                 .alpha = 0.55,
			                 .width = 1,
			                 .dash = { 3, 3 },
			                 .lift = LIFT_NET };
		struct gpu_sprite point = { .fill = d->ground,
			                    .stroke = drawing_color(d, pink ? TOKEN_CURRENT
			                                                    : TOKEN_NET),
			                    .fill_alpha = 1,
			                    .stroke_alpha = 1,
			                    .size = pink ? 8 : 6,
			                    .width = pink ? 1.5 : 1,
			                    .lift = LIFT_POINT };
		if (!list)
			draw(d, i, SHAPE_NET, net);
		gpu_draw_sprites(&d->frame, &d->shown[i]->lines[SHAPE_POINTS], d->shown[i]->origin,
		                 &point);
	}
}

/* The control point under the mouse. */
void hover_draw(struct drawing *d)
{
	for (int i = 0; i < d->n_shown; i++) {
		const struct poly *points = &d->shown[i]->poly[SHAPE_POINTS];
		const int k = d->state->hover_point + 1; /* behind the vertex that begins */
		if (d->things[i]->id != d->state->hover_thing || k < 1 || k + 1 >= points->n)
			continue;
		const struct rgb color = drawing_color(d, TOKEN_CURRENT);
		const struct gpu_sprite point = { .fill = color,
			                          .stroke = color,
			                          .fill_alpha = 1,
			                          .stroke_alpha = 1,
			                          .size = 10,
			                          .width = 1.5,
			                          .lift = LIFT_POINT + 1 };
		scratch_begin(d, d->shown[i]->origin);
		poly_add(&d->view->scratch_poly, poly_at(points, k), 0);
		scratch_sprites(d, &point);
	}
}

enum status scene_draw(struct drawing *d)
{
	const double pixel = smallest_pixel(d);
	enum status st = make_triangles(d, pixel);
	for (int i = 0; i < d->n_shown && st == ST_OK; i++) {
		struct shape *x = d->shown[i];
		if (!d->in_view[i])
			continue;
		/* while moving the lines that there are do */
		if (!d->state->moving || !(x->tolerance > 0) || x->tolerance >= 8 * line_px * pixel)
			st = shape_make_lines(x, d->world, d->things[i], line_px * pixel);
		if (st == ST_OK && d->state->moving)
			st = shape_make_moved_lines(x, moved_line_px * pixel);
		if (st != ST_OK)
			report_error(d->report, st, "cannot draw: memory ran out");
	}
	if (st != ST_OK)
		return st;
	draw_surfaces(d);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_LEQUAL);
	glDepthMask(GL_FALSE);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	draw_wires(d);
	st = results_draw(d);
	draw_combs(d);
	draw_curves(d);
	glDisable(GL_DEPTH_TEST);
	draw_nets(d);
	return st;
}
