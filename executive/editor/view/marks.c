/* marks.c - kept marks with their circles of curvature, the light, the axes. */
#include "curvature.h"
#include "view_private.h"

enum { ARC = 24, AXIS = 28, AXES_RIGHT = 52, AXES_BOTTOM = 44 };

static const struct rgb ink = { 0x0E / 255.0, 0x11 / 255.0, 0x14 / 255.0 };
static const struct rgb paper = { 1, 1, 1 };

/* The circle that touches in a direction, as far as it is of use to the eye: 100 px to each side or
 * a third of a turn. */
static void add_arc(struct poly *p, struct vec3 at, struct vec3 normal, struct vec3 along, double k,
                    double reach)
{
	double angle = fabs(k) * reach < 2 * M_PI / 3 ? k * reach : copysign(2 * M_PI / 3, k);
	for (int i = -ARC; i <= ARC; i++) {
		double a = angle * i / ARC, s = reach * i / ARC;
		struct vec3 q;
		if (fabs(k) * reach < 1e-6) {
			q = vec3_along(at, s, along);
		} else {
			q = vec3_along(at, sin(a) / k, along);
			q = vec3_along(q, (1 - cos(a)) / k, normal);
		}
		poly_add(p, q, i);
	}
	poly_end(p);
}

static void draw_cased(struct drawing *d, bool dashed)
{
	struct gpu_style style = { .color = paper, .alpha = 0.75, .width = 4.5, .lift = 6 };
	scratch_lines(d, &style);
	style = (struct gpu_style){ .color = ink, .alpha = 1, .width = 1.75, .lift = 6 };
	if (dashed) {
		style.dash[0] = 5;
		style.dash[1] = 4;
	}
	scratch_lines(d, &style);
}

static void draw_mark(struct drawing *d, const struct mark *m)
{
	const struct Ful *f = world_by_id(d->world, m->thing);
	struct surface_shape shape;
	struct vec3 along[2];
	if (!f || f->entity.kind != ENTITY_SURFACE)
		return;
	const struct surface *s = &f->entity.geometry;
	surface_shape(s, fmin(fmax(m->u, s->domain[0][0]), s->domain[0][1]),
	              fmin(fmax(m->v, s->domain[1][0]), s->domain[1][1]), &shape);
	const double pixel = drawing_pixel(d, shape.point) * d->frame.scale;
	const bool curved = isfinite(shape.normal.x) && shape_principal_directions(&shape, along);
	for (int i = 1; i >= 0 && curved; i--) {
		scratch_begin(d, shape.point);
		add_arc(&d->view->scratch_poly, shape.point, shape.normal, along[i],
		        shape.value[i ? QUANTITY_KMIN : QUANTITY_KMAX], 100 * pixel);
		draw_cased(d, i == 1);
	}
	if (isfinite(shape.normal.x)) {
		scratch_begin(d, shape.point);
		poly_add(&d->view->scratch_poly, shape.point, 0);
		poly_add(&d->view->scratch_poly, vec3_along(shape.point, 32 * pixel, shape.normal),
		         1);
		draw_cased(d, false);
	}
	const struct gpu_sprite dot = { .fill = ink,
		                        .stroke = paper,
		                        .fill_alpha = 1,
		                        .stroke_alpha = 0.9,
		                        .size = 9,
		                        .width = 1.5,
		                        .lift = 7,
		                        .shape = 1 };
	scratch_begin(d, shape.point);
	poly_add(&d->view->scratch_poly, shape.point, 0);
	scratch_sprites(d, &dot);
}

void marks_draw(struct drawing *d)
{
	for (int k = 0; k < world_marks(d->world); k++)
		draw_mark(d, world_mark(d->world, k));
	if (d->state->probe.thing)
		draw_mark(d, &d->state->probe);
	if (d->state->light)
		light_draw(d);
}

/* The sun stands where the light comes from, off what is seen; its ray is dashed. */
void light_draw(struct drawing *d)
{
	const struct rgb color = drawing_color(d, TOKEN_TEXT);
	const struct vec3 to = box_center(&d->box);
	const double away = 0.6 * box_diagonal(&d->box);
	const struct vec3 sun = vec3_along(to, away, d->light);
	const double pixel = drawing_pixel(d, sun) * d->frame.scale;
	scratch_begin(d, to);
	poly_add(&d->view->scratch_poly, vec3_along(sun, -10 * pixel, d->light), 0);
	poly_add(&d->view->scratch_poly, to, 1);
	scratch_lines(
	        d,
	        &(struct gpu_style){
	                .color = color, .alpha = 0.8, .width = 1.25, .dash = { 4, 4 }, .lift = 6 });
	/* eight rays about the disc, in the plane of the image */
	scratch_begin(d, sun);
	for (int i = 0; i < 8; i++) {
		struct vec3 side = vec3_scale(d->camera.right, cos(i * M_PI / 4));
		side = vec3_along(side, sin(i * M_PI / 4), d->camera.up);
		poly_add(&d->view->scratch_poly, vec3_along(sun, 9 * pixel, side), 0);
		poly_add(&d->view->scratch_poly, vec3_along(sun, 13 * pixel, side), 1);
		poly_end(&d->view->scratch_poly);
	}
	scratch_lines(d,
	              &(struct gpu_style){ .color = color, .alpha = 1, .width = 1.5, .lift = 6 });
	scratch_begin(d, sun);
	poly_add(&d->view->scratch_poly, sun, 0);
	scratch_sprites(d, &(struct gpu_sprite){ .fill = color,
	                                         .stroke = color,
	                                         .fill_alpha = 1,
	                                         .stroke_alpha = 1,
	                                         .size = 12,
	                                         .width = 1,
	                                         .lift = 7,
	                                         .shape = 1 });
}

/* In the corner, turned as the camera is; drawn in px. */
void axes_draw(struct drawing *d)
{
	static const char *const names[3] = { "x", "y", "z" };
	const double s = d->frame.scale, w = d->camera.width, h = d->camera.height;
	const struct vec3 axis[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
	const double x0 = w - AXES_RIGHT * s, y0 = h - AXES_BOTTOM * s;
	const struct gpu_frame scene = d->frame;
	/* places are px: x right, y down */
	const double matrix[16] = { 2 / w, 0, 0, 0, 0, -2 / h, 0, 0, 0, 0, 0, 0, -1, 1, 0, 1 };
	for (int i = 0; i < 16; i++)
		d->frame.matrix[i] = matrix[i];
	glDisable(GL_DEPTH_TEST);
	for (int k = 0; k < 3; k++) {
		double x = AXIS * s * vec3_dot(axis[k], d->camera.right);
		double y = -AXIS * s * vec3_dot(axis[k], d->camera.up);
		double length = hypot(x, y);
		scratch_begin(d, vec3(0, 0, 0));
		poly_add(&d->view->scratch_poly, vec3(x0, y0, 0), 0);
		poly_add(&d->view->scratch_poly, vec3(x0 + x, y0 + y, 0), 1);
		scratch_lines(d, &(struct gpu_style){ .color = drawing_color(d, TOKEN_TEXT2),
		                                      .alpha = 1,
		                                      .width = 1.25 });
		if (length > 3 * s)
			text_draw(d, names[k], LABEL_NOTE, false, x0 + x + 9 * s * x / length,
			          y0 + y + 9 * s * y / length);
	}
	d->frame = scene;
}
