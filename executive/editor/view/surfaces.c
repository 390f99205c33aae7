/* surfaces.c - surfaces drawn: their triangles, lit or with the colors of a map. */
#include <stdlib.h>

#include "view_private.h"

enum {
	MOVING_TRIANGLES = 100000, /* over all, while something is dragged */
	FINE_TRIANGLES = 600000,
	FLUSHED = 16384, /* a driver begins with so many while more come */
};
static const double chord_px = 0.2;      /* of triangles from their surface, device px */
static const double small_triangle = 64; /* device px squared */
static const double coarse_chord = 1e-3; /* of the scene's size */
static const double border_back = 2;     /* px, of borders behind their surface */
static const double cut_seconds = 0.06;  /* a drawing may spend on triangles */

/* Shading as in the shading worker's pictures. */
static const double ambient = 0.3, diffuse = 0.5, highlight = 0.12, sharpness = 40;
static const struct rgb plain_surface = { 0xC3 / 255.0, 0xCC / 255.0, 0xD4 / 255.0 };

/* How a surface is drawn now: a map without values is a wire frame. */
enum surface_look surface_look_of(const struct drawing *d, const struct Ful *f)
{
	if (f->entity.kind != ENTITY_SURFACE || f->display.look == LOOK_IMAGE)
		return LOOK_WIRE;
	if (f->display.look == LOOK_MAP &&
	    map_quantity(d, overlay_of(d->world, OVERLAY_MAP, f->id)) < 0)
		return LOOK_WIRE;
	return f->display.look;
}

/* The smallest length of a pixel anywhere on what is seen. */
double surfaces_pixel(const struct drawing *d)
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

static struct shape_mesh *finest(struct shape *x)
{
	return x->fine.chord > 0 && (x->fine.chord <= x->coarse.chord || !(x->coarse.chord > 0))
	               ? &x->fine
	               : &x->coarse;
}

/* What was last seen at rest is not too much to be moved. */
static bool fine_is_quick(struct shape *const *solid, int n)
{
	double sum = 0;
	for (int i = 0; i < n; i++)
		sum += finest(solid[i])->triangles;
	return sum <= MOVING_TRIANGLES;
}

enum status surfaces_make(struct drawing *d, double pixel)
{
	struct shape **solid = calloc((size_t)d->n_shown + 1, sizeof *solid);
	int n = 0;
	if (!solid)
		return report_error(d->report, ST_RESOURCE, "cannot draw: memory ran out");
	for (int i = 0; i < d->n_shown; i++)
		if (d->in_view[i] && surface_look_of(d, d->things[i]) != LOOK_WIRE)
			solid[n++] = d->shown[i];
	enum status st = ST_OK;
	if (!d->state->whole)
		st = shapes_cut_coarse(&d->view->shapes, solid, n,
		                       coarse_chord * box_diagonal(&d->box), MOVING_TRIANGLES);
	d->fine = st == ST_OK && (!d->state->moving || fine_is_quick(solid, n));
	if (st == ST_OK && !d->state->moving)
		st = shapes_cut(solid, n, false, chord_px * pixel, chord_px * pixel, FINE_TRIANGLES,
		                d->state->whole ? INFINITY : cut_seconds, &d->more);
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
struct rgb surface_color(const struct Ful *f)
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

/* Uniforms of light, and of where things from an origin are. */
static const GLint *use(struct drawing *d, enum program program, struct vec3 origin)
{
	const struct sight *s = world_sight((struct world *)d->world);
	const double shine = (s->specular.r + s->specular.g + s->specular.b) / 3 *
	                     (highlight + 0.5 * s->reflectivity);
	const GLint *u = program_use(d->frame.programs, program);
	float matrix[16];
	gpu_matrix(&d->frame, origin, matrix);
	glUniformMatrix4fv(u[UNIFORM_MATRIX], 1, GL_FALSE, matrix);
	set_eye(d, u, origin);
	set_vector(u[UNIFORM_LIGHT], d->light);
	set_vector(u[UNIFORM_FILL], d->fill);
	set_vector(u[UNIFORM_SKY], d->sky);
	glUniform4f(u[UNIFORM_STRENGTH], (float)ambient, (float)(diffuse * s->light_intensity),
	            (float)(shine * s->light_intensity), (float)sharpness);
	glUniform1f(u[UNIFORM_SCALE], (float)d->frame.scale);
	return u;
}

static void draw_mesh(struct drawing *d, const GLint *u, const struct gpu_mesh *g)
{
	glBindVertexArray(g->array);
	glUniform1f(u[UNIFORM_BIAS], 0);
	glDrawElements(GL_TRIANGLES, g->n, GL_UNSIGNED_INT, NULL);
	count_triangles(d->view, g->n / 3);
	/* Chords of neighbours part by less than a px: borders are as wide, a little behind. */
	glUniform1f(u[UNIFORM_BIAS], (float)(border_back * d->frame.pixel_depth));
	glDrawElements(GL_LINES, g->n_border, GL_UNSIGNED_INT,
	               (const void *)((size_t)g->n * sizeof(unsigned)));
	glBindVertexArray(0);
}

static void draw_surface(struct drawing *d, const struct Ful *f, struct shape *x)
{
	struct shape_mesh *m = d->fine ? finest(x) : &x->coarse;
	const bool map = surface_look_of(d, f) == LOOK_MAP;
	const bool quick = d->state->moving && !map && is_small(d, x, m);
	const struct rgb color = surface_color(f);
	const float light[3] = { (float)rgb_to_linear(color.r), (float)rgb_to_linear(color.g),
		                 (float)rgb_to_linear(color.b) };
	if (!m->triangles || m->failed)
		return;
	const GLint *u = use(d, quick ? PROGRAM_QUICK : PROGRAM_SURFACE, x->origin);
	if (quick) {
		glVertexAttrib3fv(3, light);
	} else {
		glUniform4f(u[UNIFORM_COLOR], light[0], light[1], light[2], 1);
		glUniform1i(u[UNIFORM_LOOK], map && map_use(d, f->id));
	}
	draw_mesh(d, u, shape_mesh_gpu(m));
}

enum status surfaces_draw(struct drawing *d, double pixel)
{
	enum status st = batch_make(d, pixel);
	if (st != ST_OK)
		return report_error(d->report, st, "cannot draw: %s", status_text(st));
	glDisable(GL_BLEND);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_LESS);
	glDepthMask(GL_TRUE);
	d->view->triangles = 0;
	/* triangles step back by their slope, so that lines on them are whole */
	glEnable(GL_POLYGON_OFFSET_FILL);
	glPolygonOffset(1.5F, 2);
	if (d->has_batch)
		draw_mesh(d, use(d, PROGRAM_QUICK, d->view->batch.origin), &d->view->batch.gpu);
	for (int i = 0; i < d->n_shown; i++)
		if (d->in_view[i] && !(d->has_batch && d->in_batch[i]) &&
		    surface_look_of(d, d->things[i]) != LOOK_WIRE)
			draw_surface(d, d->things[i], d->shown[i]);
	glDisable(GL_POLYGON_OFFSET_FILL);
	return ST_OK;
}
