/* scene.c - lines of surfaces, curves, nets, points and combs drawn. */
#include <stdlib.h>

#include "view_private.h"

static const double line_px = 0.1;       /* of chords from their curve, device px */
static const double moved_line_px = 0.6; /* while something is dragged */
/* Surfaces smaller than that, logical px, have no lines inside, or none at all: at rest, while dragged. */
static const double wire_least[2] = { 16, 24 }, edge_least[2] = { 5, 12 };

/* Lines on a surface stand before it by this many px. */
enum { LIFT_WIRE = 1, LIFT_RESULT = 2, LIFT_CURVE = 3, LIFT_NET = 4, LIFT_POINT = 5 };

/* Which lines of a surface are to be seen at its size. */
struct detail {
	bool wire, edge;
};
static struct detail detail_of(const struct drawing *d, int i)
{
	const struct Ful *f = d->things[i];
	const struct shape *x = d->shown[i];
	const double across = box_diagonal(&x->box) / drawing_pixel(d, x->origin) / d->frame.scale;
	const bool marked = f->id == d->state->chosen || f->id == d->state->hover_thing;
	return (struct detail){ across >= wire_least[d->state->moving],
		                marked || across >= edge_least[d->state->moving] ||
		                        surface_look_of(d, f) == LOOK_WIRE };
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
		gpu_draw_lines(&d->frame, shape_lines(x, which), &x->poly[which], &style);
}

static void draw_wires(struct drawing *d)
{
	const struct rgb on_map = { 0x14 / 255.0, 0x17 / 255.0, 0x1A / 255.0 };
	for (int i = 0; i < d->n_shown; i++) {
		const struct Ful *f = d->things[i];
		if (f->entity.kind != ENTITY_SURFACE || !d->in_view[i])
			continue;
		const enum surface_look look = surface_look_of(d, f);
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
		const struct detail seen = detail_of(d, i);
		if (seen.wire)
			draw(d, i, SHAPE_WIRE, wire);
		if (seen.edge)
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
	gpu_draw_lines(&d->frame, shape_lines(d->shown[i], SHAPE_CURVE),
	               &d->shown[i]->poly[SHAPE_CURVE], &hidden);
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
		gpu_draw_sprites(&d->frame, shape_lines(d->shown[i], SHAPE_POINTS),
		                 d->shown[i]->origin, &point);
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

static bool has_lines(const struct drawing *d, int i)
{
	const struct Ful *f = d->things[i];
	const struct detail seen = detail_of(d, i);
	return f->entity.kind != ENTITY_SURFACE || seen.wire || seen.edge || f->display.net ||
	       f->display.porcupine;
}

enum status scene_draw(struct drawing *d)
{
	const double pixel = surfaces_pixel(d);
	enum status st = surfaces_make(d, pixel);
	for (int i = 0; i < d->n_shown && st == ST_OK; i++) {
		struct shape *x = d->shown[i];
		if (!d->in_view[i] || !has_lines(d, i))
			continue;
		/* while moving the lines that there are do */
		if (!d->state->moving || !(x->tolerance > 0) || x->tolerance >= 8 * line_px * pixel)
			st = shape_make_lines(x, d->world, d->things[i], detail_of(d, i).wire,
			                      line_px * pixel);
		if (st == ST_OK && d->state->moving)
			st = shape_make_moved_lines(x, moved_line_px * pixel);
		if (st != ST_OK)
			report_error(d->report, st, "cannot draw: memory ran out");
	}
	if (st != ST_OK)
		return st;
	st = surfaces_draw(d, pixel);
	if (st != ST_OK)
		return st;
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
