/* view_camera.c - fit, turn, pan, zoom. */
#include <stdio.h>
#include <stdlib.h>

#include "shape.h"
#include "view.h"

static const double perspective_half = 0.26794919243112270; /* tan 15 degrees */

static bool is_shown(const struct view_state *s, const struct Ful *f)
{
	return s->only ? f->id == s->only : f->display.on;
}

static struct box box_of(const struct view_state *s, const struct world *w)
{
	struct box all = box_empty();
	for (int k = 0; k < world_count(w); k++) {
		const struct Ful *f = world_at(w, k);
		struct box b;
		if (is_shown(s, f) && thing_box(w, f, &b))
			box_add_box(&all, &b);
	}
	return all;
}

static bool is_camera(const struct camera *c)
{
	return c->half > 0 && vec3_length(c->ahead) > 0.5;
}

/* The direction that a camera has, in words. */
static void words_of(char *out, size_t size, const struct camera *c)
{
	double elevation = asin(fmin(fmax(-c->ahead.z, -1), 1)) * 180 / M_PI;
	/* right is level: the eye stands a quarter turn behind it */
	double azimuth = atan2(c->right.y, c->right.x) * 180 / M_PI - 90;
	int n = snprintf(out, size, "%.9g,%.9g", azimuth, elevation);
	if (c->kind == CAMERA_PERSPECTIVE)
		snprintf(out + n, size - (size_t)n, ":perspective@%.9g",
		         fmin(fmax(2 * atan(c->half) * 180 / M_PI, 1), 150));
}

/* Surfaces alone fit tighter than their box. */
static enum status fit_surfaces(struct view_state *s, const struct world *w, const char *view,
                                int width, int height, const struct report *r, bool *done)
{
	const int n = world_count(w);
	const struct surface **all = calloc((size_t)n + 1, sizeof *all);
	int m = 0;
	enum status st = ST_OK;
	if (!all)
		return report_error(r, ST_RESOURCE, "cannot place a camera: memory ran out");
	*done = true;
	for (int k = 0; k < n; k++) {
		const struct Ful *f = world_at(w, k);
		if (!is_shown(s, f))
			continue;
		if (f->entity.kind == ENTITY_SURFACE && !f->display.net && !f->entity.trim.n)
			all[m++] = &f->entity.geometry;
		else
			*done = false;
	}
	*done = *done && m > 0;
	if (*done)
		st = camera_fit_surfaces(&s->camera, view, all, m, width, height, r);
	free((void *)all);
	return st;
}

enum status view_fit(struct view_state *s, const struct world *w, const char *view, int width,
                     int height, const struct report *r)
{
	char own[96];
	bool done = false;
	if (!view && is_camera(&s->camera)) {
		words_of(own, sizeof own, &s->camera);
		view = own;
	}
	struct box b = box_of(s, w);
	if (box_is_empty(&b)) {
		box_add_point(&b, vec3(-1, -1, -1));
		box_add_point(&b, vec3(1, 1, 1));
	}
	enum status st = fit_surfaces(s, w, view, width, height, r, &done);
	if (st == ST_OK && !done)
		st = camera_fit(&s->camera, view, &b, width, height, r);
	s->pivot = box_center(&b);
	s->has_pivot = false;
	return st;
}

/* The middle of what is seen: of the control points' boxes that lie in the image. Of one that is
 * larger than the image, the image's middle at its depth. */
static struct vec3 middle_of_seen(const struct view_state *s, const struct world *w)
{
	const struct box b = box_of(s, w);
	const struct camera *c = &s->camera;
	if (box_is_empty(&b))
		return s->pivot;
	struct vec3 middle = box_center(&b);
	double x, y, depth;
	const bool inside = camera_project(c, middle, &x, &y, &depth) && x >= 0 && y >= 0 &&
	                    x <= c->width && y <= c->height;
	const double pixel = camera_pixel(c, middle);
	const double shorter = c->width < c->height ? c->width : c->height;
	if (inside && box_diagonal(&b) < 3 * pixel * shorter)
		return middle;
	struct vec3 o, d;
	camera_ray(c, c->width / 2.0, c->height / 2.0, &o, &d);
	/* where the line of sight comes nearest to the middle */
	double t = vec3_dot(vec3_sub(middle, o), d);
	if (c->kind == CAMERA_PERSPECTIVE)
		t = fmax(t, 1e-3 * box_diagonal(&b));
	return vec3_along(o, t, d);
}

static struct vec3 turned(struct vec3 v, struct vec3 axis, double angle)
{
	struct vec3 out = vec3_scale(v, cos(angle));
	out = vec3_along(out, sin(angle), vec3_cross(axis, v));
	return vec3_along(out, (1 - cos(angle)) * vec3_dot(axis, v), axis);
}

static void turn(struct camera *c, struct vec3 pivot, struct vec3 axis, double angle)
{
	c->eye = vec3_add(pivot, turned(vec3_sub(c->eye, pivot), axis, angle));
	c->right = vec3_unit(turned(c->right, axis, angle));
	c->ahead = turned(c->ahead, axis, angle);
	/* without what rounding adds over many turns */
	c->ahead = vec3_unit(vec3_along(c->ahead, -vec3_dot(c->ahead, c->right), c->right));
	c->up = vec3_cross(c->right, c->ahead);
}

void view_rotate(struct view_state *s, const struct world *w, double dx, double dy)
{
	struct camera *c = &s->camera;
	if (!s->has_pivot)
		s->pivot = middle_of_seen(s, w);
	s->has_pivot = true;
	turn(c, s->pivot, vec3(0, 0, 1), -dx * M_PI / 180);
	/* up has a share along z that is the cosine of the elevation */
	double elevation = atan2(-c->ahead.z, c->up.z) * 180 / M_PI;
	double to = fmin(fmax(elevation + dy, -90), 90);
	turn(c, s->pivot, c->right, -(to - elevation) * M_PI / 180);
}

static double depth_of(const struct camera *c, struct vec3 p)
{
	return vec3_dot(vec3_sub(p, c->eye), c->ahead);
}

void view_pan(struct view_state *s, double dx, double dy)
{
	struct camera *c = &s->camera;
	const double shorter = c->width < c->height ? c->width : c->height;
	double pixel = 2 * c->half / shorter;
	if (c->kind == CAMERA_PERSPECTIVE)
		pixel *= fmax(depth_of(c, s->pivot), 1e-9);
	c->eye = vec3_along(c->eye, -dx * pixel, c->right);
	c->eye = vec3_along(c->eye, dy * pixel, c->up);
	s->has_pivot = false;
}

void view_zoom(struct view_state *s, const struct world *w, double factor, double x, double y)
{
	struct camera *c = &s->camera;
	const struct box b = box_of(s, w);
	const double size = box_is_empty(&b) ? 1 : fmax(box_diagonal(&b), 1e-30);
	struct vec3 o, d;
	if (!(factor > 0) || !isfinite(factor))
		return;
	camera_ray(c, x, y, &o, &d);
	s->has_pivot = false;
	if (c->kind == CAMERA_ORTHOGRAPHIC) {
		/* from a millionth of the size to a million times it */
		double half = fmin(fmax(c->half / factor, 1e-6 * size), 1e6 * size);
		double share = 1 - half / c->half;
		struct vec3 aside = vec3_sub(o, c->eye);
		c->eye = vec3_along(c->eye, share, aside);
		c->half = half;
		return;
	}
	double z = box_is_empty(&b) ? 1 : depth_of(c, box_center(&b));
	z = fmax(z, 1e-3 * size);
	double to = fmin(fmax(z / factor, 1e-4 * size), 1e4 * size);
	/* along the ray through the cursor: what lies on it stays on its pixel */
	c->eye = vec3_along(c->eye, (z - to) / vec3_dot(d, c->ahead), d);
}

void view_project(struct view_state *s, const struct world *w, enum camera_kind kind)
{
	struct camera *c = &s->camera;
	const struct vec3 middle = middle_of_seen(s, w);
	const struct box b = box_of(s, w);
	if (c->kind == kind)
		return;
	const double z = depth_of(c, middle);
	if (kind == CAMERA_PERSPECTIVE) {
		double away = c->half / perspective_half;
		c->eye = vec3_along(c->eye, z - away, c->ahead);
		c->half = perspective_half;
	} else {
		c->half *= fmax(z, 1e-9);
		/* all before the eye, as workers want it */
		double size = box_is_empty(&b) ? 0 : box_diagonal(&b);
		c->eye = vec3_along(c->eye, fmin(z - size, 0), c->ahead);
	}
	c->kind = kind;
}
