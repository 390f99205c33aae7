/* frame.c - one drawing of the world: camera, order, targets. */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "hash.h"
#include "view_private.h"

enum { SAMPLES = 4, SAMPLED_MOST = 1 << 25 /* px, of 32 bytes with their samples */ };

enum status view_create(struct view **out, const struct report *r)
{
	const int version = epoxy_gl_version();
	if (!epoxy_is_desktop_gl() || version < 33)
		return report_error(r, ST_RESOURCE,
		                    "cannot draw: found OpenGL%s %d.%d, 3.3 is needed; update the "
		                    "graphics driver or set LIBGL_ALWAYS_SOFTWARE=1",
		                    epoxy_is_desktop_gl() ? "" : " ES", version / 10, version % 10);
	struct view *v = calloc(1, sizeof *v);
	if (!v)
		return report_error(r, ST_RESOURCE, "cannot draw: memory ran out");
	glGenVertexArrays(1, &v->empty);
	*out = v;
	return ST_OK;
}

void view_destroy(struct view *v)
{
	if (!v)
		return;
	programs_finish(&v->programs);
	target_finish(&v->fine);
	target_finish(&v->plain);
	for (int i = 0; i < VIEW_PLACES; i++)
		target_finish(&v->stills[i].target);
	shapes_finish(&v->shapes);
	gpu_mesh_finish(&v->batch.gpu);
	maps_finish(v);
	results_finish(v);
	images_finish(v);
	texts_finish(v);
	gpu_poly_finish(&v->scratch);
	poly_finish(&v->scratch_poly);
	glDeleteVertexArrays(1, &v->empty);
	glDeleteTextures(1, &v->colors);
	free(v);
}

static bool is_shown(const struct drawing *d, const struct Ful *f)
{
	return d->state->only ? f->id == d->state->only : f->display.on;
}

static enum status find_shown(struct drawing *d)
{
	const int n = world_count(d->world);
	d->shown = calloc((size_t)n + 1, sizeof *d->shown);
	d->things = calloc((size_t)n + 1, sizeof *d->things);
	d->in_view = calloc((size_t)n + 1, sizeof *d->in_view);
	d->in_batch = calloc((size_t)n + 1, sizeof *d->in_batch);
	if (!d->shown || !d->things || !d->in_view || !d->in_batch)
		return ST_RESOURCE;
	for (int k = 0; k < n; k++) {
		const struct Ful *f = world_at(d->world, k);
		struct shape *x = shapes_find(&d->view->shapes, f->id, k);
		if (!x || !is_shown(d, f) || box_is_empty(&x->box))
			continue;
		d->things[d->n_shown] = f;
		d->shown[d->n_shown++] = x;
		box_add_box(&d->box, &x->box);
	}
	return ST_OK;
}

/* Depths that everything lies between, with room for combs and marks. */
static void find_planes(struct drawing *d)
{
	const struct camera *c = &d->camera;
	const double size = fmax(box_diagonal(&d->box), 1e-30);
	double near = INFINITY, far = -INFINITY;
	for (int i = 0; i < 8; i++) {
		struct vec3 p =
		        vec3(i & 1 ? d->box.hi.x : d->box.lo.x, i & 2 ? d->box.hi.y : d->box.lo.y,
		             i & 4 ? d->box.hi.z : d->box.lo.z);
		double z = vec3_dot(vec3_sub(p, c->eye), c->ahead);
		near = fmin(near, z);
		far = fmax(far, z);
	}
	d->near = near - 0.5 * size;
	d->far = far + 0.5 * size;
	if (c->kind == CAMERA_PERSPECTIVE) {
		d->far = fmax(d->far, 1e-3 * size);
		/* 24 bits of depth tell a thousandth of a pixel at this */
		d->near = fmax(d->near, 1e-4 * d->far);
	}
}

static void find_matrix(struct drawing *d)
{
	const struct camera *c = &d->camera;
	const double smaller = c->width < c->height ? c->width : c->height;
	const double sx = smaller / (c->half * c->width), sy = smaller / (c->half * c->height);
	const double n = d->near, f = d->far;
	const struct vec3 axis[3] = { c->right, c->up, c->ahead };
	double view[3][4], *m = d->frame.matrix;
	for (int k = 0; k < 3; k++) {
		view[k][0] = axis[k].x;
		view[k][1] = axis[k].y;
		view[k][2] = axis[k].z;
		view[k][3] = -vec3_dot(axis[k], c->eye);
	}
	const bool flat = c->kind == CAMERA_ORTHOGRAPHIC;
	for (int k = 0; k < 4; k++) {
		const double one = k == 3;
		m[4 * k] = sx * view[0][k];
		m[4 * k + 1] = sy * view[1][k];
		m[4 * k + 2] = flat ? (2 * view[2][k] - (n + f) * one) / (f - n)
		                    : ((f + n) * view[2][k] - 2 * f * n * one) / (f - n);
		m[4 * k + 3] = flat ? one : view[2][k];
	}
	/* depth of a length of one pixel, at the middle of what is seen */
	struct vec3 middle = box_is_empty(&d->box) ? c->eye : box_center(&d->box);
	double z = fmax(vec3_dot(vec3_sub(middle, c->eye), c->ahead), n);
	double pixel = 2 * c->half / smaller * (flat ? 1 : z);
	d->frame.pixel_depth = flat ? 2 * pixel / (f - n) : 2 * f * n / (f - n) / (z * z) * pixel;
}

/* A box all of whose corners lie beyond the same side of the picture is not in it. */
static bool box_in_view(const struct drawing *d, const struct box *b)
{
	const double *m = d->frame.matrix;
	const double room = 1 + 16 * d->frame.scale / fmin(d->camera.width, d->camera.height);
	int beyond[4] = { 0 };
	for (int i = 0; i < 8; i++) {
		const double p[3] = { i & 1 ? b->hi.x : b->lo.x, i & 2 ? b->hi.y : b->lo.y,
			              i & 4 ? b->hi.z : b->lo.z };
		double c[4];
		for (int k = 0; k < 4; k++)
			c[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
		for (int k = 0; k < 2; k++) {
			beyond[2 * k] += c[k] < -room * c[3];
			beyond[2 * k + 1] += c[k] > room * c[3];
		}
	}
	return beyond[0] < 8 && beyond[1] < 8 && beyond[2] < 8 && beyond[3] < 8;
}

/* Quills stand out of the box. */
static void find_in_view(struct drawing *d)
{
	for (int i = 0; i < d->n_shown; i++)
		d->in_view[i] =
		        d->things[i]->display.porcupine || box_in_view(d, &d->shown[i]->box);
}

static void find_light(struct drawing *d)
{
	const struct camera *c = &d->camera;
	const struct sight *s = world_sight((struct world *)d->world);
	const double a = s->light_azimuth * M_PI / 180, i = s->light_incidence * M_PI / 180;
	d->light = vec3(sin(i) * cos(a), sin(i) * sin(a), cos(i));
	struct vec3 shoulder = vec3_scale(c->ahead, -0.72);
	shoulder = vec3_along(shoulder, 0.62, c->up);
	d->fill = vec3_unit(vec3_along(shoulder, -0.5, c->right));
	d->sky = vec3_unit(vec3_add(c->up, vec3(0, 0, 1)));
	if (!(vec3_length(d->sky) > 0))
		d->sky = c->up;
}

/* Luminance as light, of sRGB. */
static double luminance(struct rgb c)
{
	return 0.2126 * rgb_to_linear(c.r) + 0.7152 * rgb_to_linear(c.g) +
	       0.0722 * rgb_to_linear(c.b);
}

enum theme ground_theme(struct rgb ground)
{
	/* equal contrast with white and black lies at 0.18 */
	return luminance(ground) > 0.18 ? THEME_LIGHT : THEME_DARK;
}

static void find_ground(struct drawing *d)
{
	const struct sight *s = world_sight((struct world *)d->world);
	d->set = d->state->theme;
	d->ground = theme_color(d->state->theme, TOKEN_VIEW);
	if (s->has_background) {
		d->ground = s->background;
		d->set = ground_theme(d->ground);
	}
}

enum status drawing_init(struct drawing *d, struct view *v, const struct world *w,
                         const struct view_state *s, int width, int height, const struct report *r)
{
	*d = (struct drawing){ .view = v,
		               .world = w,
		               .state = s,
		               .camera = s->camera,
		               .box = box_empty(),
		               .report = r };
	d->camera.width = width;
	d->camera.height = height;
	d->frame = (struct gpu_frame){ .programs = &v->programs,
		                       .width = width,
		                       .height = height,
		                       .scale = s->scale > 0 ? s->scale : 1 };
	enum status st = shapes_update(&v->shapes, w);
	if (st == ST_OK)
		st = find_shown(d);
	if (st != ST_OK) {
		drawing_finish(d);
		return report_error(r, st, "cannot draw: memory ran out");
	}
	if (box_is_empty(&d->box))
		box_add_point(&d->box, vec3(0, 0, 0));
	find_planes(d);
	find_matrix(d);
	find_in_view(d);
	find_light(d);
	find_ground(d);
	return ST_OK;
}

void drawing_finish(struct drawing *d)
{
	free((void *)d->shown);
	free((void *)d->things);
	free(d->in_view);
	free(d->in_batch);
	d->in_view = d->in_batch = NULL;
	d->shown = NULL;
	d->things = NULL;
}

static void clear(const struct drawing *d)
{
	glViewport(0, 0, d->camera.width, d->camera.height);
	glDisable(GL_SCISSOR_TEST);
	glDepthMask(GL_TRUE);
	glClearColor((float)d->ground.r, (float)d->ground.g, (float)d->ground.b, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static enum status draw_things(struct drawing *d)
{
	clear(d);
	d->has_image = images_draw(d);
	if (d->has_image)
		return ST_OK;
	enum status st = maps_update(d);
	return st == ST_OK ? scene_draw(d) : st;
}

/* What lies over the things and follows the mouse. */
static void draw_above(struct drawing *d)
{
	if (d->has_image)
		return;
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	hover_draw(d);
	marks_draw(d);
	if (d->state->axes)
		axes_draw(d);
}

static void copy(const struct target *from, GLuint to, int x, int y)
{
	glBindFramebuffer(GL_READ_FRAMEBUFFER, from->frame);
	glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
	glBlitFramebuffer(0, 0, from->width, from->height, x, y, x + from->width, y + from->height,
	                  GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

/* All that the things' picture depends on, but for what is drawn above them. */
static uint64_t picture_of(const struct drawing *d)
{
	struct {
		uint64_t world, arrived; /* of results whose jobs run: their files */
		struct camera camera;
		double scale;
		int theme, only, quantity, chosen, hover;
	} x;
	const struct view_state *s = d->state;
	memset(&x, 0, sizeof x);
	x.world = world_revision(d->world);
	x.camera.kind = d->camera.kind;
	x.camera.width = d->camera.width;
	x.camera.height = d->camera.height;
	x.camera.eye = d->camera.eye;
	x.camera.right = d->camera.right;
	x.camera.up = d->camera.up;
	x.camera.ahead = d->camera.ahead;
	x.camera.half = d->camera.half;
	x.scale = d->frame.scale;
	x.theme = s->theme;
	x.only = s->only;
	x.quantity = s->quantity;
	x.chosen = s->chosen;
	x.hover = s->hover_point < 0 ? s->hover_thing : 0;
	for (int k = 0; k < world_overlays(d->world); k++) {
		const struct overlay *o = world_overlay(d->world, k);
		int64_t stamp[4] = { (int64_t)x.arrived };
		if (o->job && o->file && file_stamp(o->file, stamp + 1))
			x.arrived = checksum_bytes(stamp, sizeof stamp);
	}
	return checksum_bytes(&x, sizeof x) | 1;
}

static struct still *still_of(const struct drawing *d)
{
	const int place = d->state->place;
	return &d->view->stills[place > 0 && place < VIEW_PLACES ? place : 0];
}

/* At rest the things' picture is kept: what follows the mouse is drawn over a copy. */
static enum status draw_at_rest(struct drawing *d)
{
	struct view *v = d->view;
	struct still *still = still_of(d);
	const uint64_t picture = picture_of(d);
	const int width = d->camera.width, height = d->camera.height;
	if (still->of == picture && still->target.width == width &&
	    still->target.height == height) {
		d->has_image = still->is_image;
		return ST_OK;
	}
	still->of = 0;
	/* what has no room for that is drawn with one sample */
	enum status st = ST_RESOURCE;
	if ((double)width * height <= SAMPLED_MOST)
		st = target_init(&v->fine, width, height, SAMPLES, &report_none);
	if (st != ST_OK)
		st = target_init(&v->fine, width, height, 0, d->report);
	if (st == ST_OK)
		st = target_init(&still->target, width, height, 0, d->report);
	if (st != ST_OK)
		return st;
	glBindFramebuffer(GL_FRAMEBUFFER, v->fine.frame);
	st = draw_things(d);
	copy(&v->fine, still->target.frame, 0, 0);
	if (st == ST_OK && !d->more) {
		still->of = picture;
		still->is_image = d->has_image;
	}
	return st;
}

static enum status draw_all(struct drawing *d)
{
	struct view *v = d->view;
	enum status st = target_init(&v->plain, d->camera.width, d->camera.height, 0, d->report);
	if (st == ST_OK && !d->state->moving) {
		st = draw_at_rest(d);
		if (st == ST_OK)
			copy(&still_of(d)->target, v->plain.frame, 0, 0);
		glBindFramebuffer(GL_FRAMEBUFFER, v->plain.frame);
		glViewport(0, 0, d->camera.width, d->camera.height);
	} else if (st == ST_OK) {
		glBindFramebuffer(GL_FRAMEBUFFER, v->plain.frame);
		st = draw_things(d);
	}
	if (st == ST_OK)
		draw_above(d);
	return st;
}

enum status view_draw(struct view *v, const struct world *w, const struct view_state *s, int x,
                      int y, int width, int height, bool *more, const struct report *r)
{
	struct drawing d;
	GLint bound = 0;
	*more = false;
	if (width < 1 || height < 1 || !(s->camera.half > 0))
		return ST_OK;
	glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
	enum status st = drawing_init(&d, v, w, s, width, height, r);
	if (st == ST_OK) {
		texts_begin(v);
		st = draw_all(&d);
		texts_end(v);
		if (st == ST_OK && v->programs.failed)
			st = report_error(r, ST_INTERNAL, "cannot draw: %s", v->programs.why);
		if (st == ST_OK)
			copy(&v->plain, (GLuint)bound, x, y);
		*more = d.more || s->moving;
		drawing_finish(&d);
	}
	glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)bound);
	glBindVertexArray(0);
	glUseProgram(0);
	glDisable(GL_BLEND);
	glDisable(GL_DEPTH_TEST);
	return st;
}

int view_triangles(const struct view *v)
{
	return v->triangles;
}

bool view_key(const struct view *v, struct key *out)
{
	if (v->has_key)
		*out = v->key;
	return v->has_key;
}
