/* camera.c - how surfaces are seen. */
#include "camera.h"

#include <string.h>

#include "number.h"

static const double margin = 0.06; /* of the image, a side */

static const struct named_view {
	const char *name;
	double azimuth, elevation;
} named_views[] = {
	{ "three-quarter", -50, 25 }, { "front", -90, 0 }, { "back", 90, 0 },
	{ "left", 180, 0 },           { "right", 0, 0 },   { "top", -90, 90 },
	{ "bottom", -90, -90 },
};

struct view {
	double azimuth, elevation, angle; /* degrees */
	enum camera_kind kind;
};

static bool take_word(const char **s, const char *word)
{
	size_t n = strlen(word);
	if (strncmp(*s, word, n))
		return false;
	*s += n;
	return true;
}

static bool parse_direction(struct view *v, const char **s, const char *end)
{
	for (size_t i = 0; i < sizeof named_views / sizeof *named_views; i++)
		if (take_word(s, named_views[i].name)) {
			v->azimuth = named_views[i].azimuth;
			v->elevation = named_views[i].elevation;
			return true;
		}
	return number_read(s, end, &v->azimuth) && take_word(s, ",") &&
	       number_read(s, end, &v->elevation) && fabs(v->azimuth) <= 360 &&
	       fabs(v->elevation) <= 90;
}

static bool parse_view(struct view *v, const char *s)
{
	const char *end = s + strlen(s);
	if (!parse_direction(v, &s, end))
		return false;
	if (take_word(&s, ":perspective")) {
		v->kind = CAMERA_PERSPECTIVE;
		if (take_word(&s, "@") &&
		    !(number_read(&s, end, &v->angle) && v->angle >= 1 && v->angle <= 150))
			return false;
	} else {
		take_word(&s, ":orthographic");
	}
	return s == end;
}

/* Quarter turns are exact, so that views along axes are. */
static void turn(double degrees, double *cosine, double *sine)
{
	static const double exact[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
	double quarters = degrees / 90;
	if (quarters == floor(quarters)) {
		int q = ((int)quarters % 4 + 4) % 4;
		*cosine = exact[q][0];
		*sine = exact[q][1];
		return;
	}
	*cosine = cos(degrees * M_PI / 180);
	*sine = sin(degrees * M_PI / 180);
}

static void set_axes(struct camera *c, const struct view *v)
{
	double ca, sa, ce, se;
	turn(v->azimuth, &ca, &sa);
	turn(v->elevation, &ce, &se);
	c->right = vec3(-sa, ca, 0);
	c->up = vec3(-se * ca, -se * sa, ce);
	c->ahead = vec3(-ce * ca, -ce * sa, -se);
}

static int smaller_side(const struct camera *c)
{
	return c->width < c->height ? c->width : c->height;
}

static struct vec3 corner(const struct box *b, int i)
{
	return vec3(i & 1 ? b->hi.x : b->lo.x, i & 2 ? b->hi.y : b->lo.y,
	            i & 4 ? b->hi.z : b->lo.z);
}

/* Stand off along -ahead, as near as lets every corner into the image less its margins. */
static void stand(struct camera *c, const struct box *box)
{
	struct vec3 center = box_center(box);
	double size = box_diagonal(box);
	double usable = 1 - 2 * margin;
	double wide = usable * c->width / smaller_side(c),
	       high = usable * c->height / smaller_side(c);
	double half = 0, away = 0;
	if (!(size > 0))
		size = 1;
	for (int i = 0; i < 8; i++) {
		struct vec3 p = vec3_sub(corner(box, i), center);
		double x = fabs(vec3_dot(p, c->right)) / wide, y = fabs(vec3_dot(p, c->up)) / high;
		half = fmax(half, fmax(x, y));
		double nearer = -vec3_dot(p, c->ahead);
		/* a box that is a line seen end on has to be before the eye too */
		away = fmax(away, fmax(fmax(x, y) / c->half, 1e-3 * size) + nearer);
	}
	if (c->kind == CAMERA_ORTHOGRAPHIC) {
		c->half = half > 1e-6 * size ? half : size / 2;
		away = size;
	}
	c->eye = vec3_along(center, -away, c->ahead);
}

enum status camera_fit(struct camera *out, const char *view, const struct box *box, int width,
                       int height, const struct report *r)
{
	struct view v = { .angle = 30, .kind = CAMERA_ORTHOGRAPHIC };
	if (!view || !*view)
		view = named_views[0].name;
	const bool exact = camera_is_text(view);
	if (exact ? !camera_parse(out, view) : !parse_view(&v, view))
		return report_error(r, ST_PARAMETER,
		                    "view '%s': expected three-quarter, front, back, left, right, "
		                    "top, bottom or AZIMUTH,ELEVATION in degrees (elevation -90 to "
		                    "90), then :orthographic or :perspective@ANGLE (1 to 150); or "
		                    "a camera as the journal writes it",
		                    view);
	if (width < 1 || height < 1)
		return report_error(r, ST_PARAMETER, "size %dx%d: expected 1x1 or more", width,
		                    height);
	if (exact) {
		out->width = width;
		out->height = height;
		return ST_OK;
	}
	if (box_is_empty(box))
		return report_error(r, ST_INPUT, "cannot place a camera: there is nothing to see");
	*out = (struct camera){
		.kind = v.kind, .width = width, .height = height, .half = tan(v.angle * M_PI / 360)
	};
	set_axes(out, &v);
	stand(out, box);
	return ST_OK;
}

/* Largest values of +-x, +-y and -z over points in the camera's axes; `lean` is what each is to be
 * reduced by for a unit of depth: nothing, or the tangents of half the usable angles. */
struct extent {
	double lean[2];
	double right, left, top, bottom, near;
};

static void extent_add(struct extent *e, const struct camera *c, struct vec3 p)
{
	double x = vec3_dot(p, c->right), y = vec3_dot(p, c->up), z = vec3_dot(p, c->ahead);

	e->right = fmax(e->right, x - e->lean[0] * z);
	e->left = fmax(e->left, -x - e->lean[0] * z);
	e->top = fmax(e->top, y - e->lean[1] * z);
	e->bottom = fmax(e->bottom, -y - e->lean[1] * z);
	e->near = fmax(e->near, -z);
}

/* Samples along one direction of a surface: its control points tell how much it may turn. */
static int samples_along(const struct surface *s, int d)
{
	enum { FEWEST = 24, MOST = 128 };
	int n = 2 * s->n[d];

	return n < FEWEST ? FEWEST : n > MOST ? MOST : n;
}

static void extent_add_surface(struct extent *e, const struct camera *c, const struct surface *s)
{
	int nu = samples_along(s, 0), nv = samples_along(s, 1);

	for (int i = 0; i <= nu; i++)
		for (int j = 0; j <= nv; j++) {
			double a = (double)i / nu, b = (double)j / nv;
			extent_add(e, c,
			           surface_point(s, (1 - a) * s->domain[0][0] + a * s->domain[0][1],
			                         (1 - b) * s->domain[1][0] + b * s->domain[1][1]));
		}
}

/* Every point p with |x - mx| <= lean (z + away) is in the image of an eye at (mx, my, -away): the
 * extents tell the nearest such eye; without perspective, the smallest image. */
static void frame(struct camera *c, const struct extent *e, double wide, double high, double size)
{
	double mx = (e->right - e->left) / 2, my = (e->top - e->bottom) / 2;
	double x = (e->right + e->left) / 2, y = (e->top + e->bottom) / 2, away = size + e->near;

	if (c->kind == CAMERA_ORTHOGRAPHIC) {
		double half = fmax(x / wide, y / high);
		c->half = half > 1e-6 * size ? half : size / 2;
	} else
		away = fmax(fmax(x / e->lean[0], y / e->lean[1]), e->near + 1e-3 * size);
	c->eye = vec3_scale(c->right, mx);
	c->eye = vec3_along(c->eye, my, c->up);
	c->eye = vec3_along(c->eye, -away, c->ahead);
}

enum status camera_fit_surfaces(struct camera *out, const char *view,
                                const struct surface *const *surfaces, int n, int width, int height,
                                const struct report *r)
{
	struct box box = box_empty();
	enum status st = ST_OK;

	for (int i = 0; i < n && st == ST_OK; i++) {
		struct box one;
		st = surface_box(surfaces[i], 1e-3 * surface_size(surfaces[i]), &one);
		if (st == ST_OK)
			box_add_box(&box, &one);
	}
	if (st != ST_OK)
		return report_error(r, st, "cannot place a camera: memory ran out");
	st = camera_fit(out, view, &box, width, height, r);
	if (st != ST_OK || (view && camera_is_text(view)))
		return st;
	double wide = (1 - 2 * margin) * width / smaller_side(out);
	double high = (1 - 2 * margin) * height / smaller_side(out), size = box_diagonal(&box);
	struct extent e = { .right = -INFINITY,
		            .left = -INFINITY,
		            .top = -INFINITY,
		            .bottom = -INFINITY,
		            .near = -INFINITY };
	if (out->kind == CAMERA_PERSPECTIVE) {
		e.lean[0] = out->half * wide;
		e.lean[1] = out->half * high;
	}
	for (int i = 0; i < n; i++)
		extent_add_surface(&e, out, surfaces[i]);
	frame(out, &e, wide, high, size > 0 ? size : 1);
	return ST_OK;
}

void camera_ray(const struct camera *c, double x, double y, struct vec3 *origin,
                struct vec3 *direction)
{
	double scale = 2 * c->half / smaller_side(c);
	double right = (x - c->width / 2.0) * scale, up = (c->height / 2.0 - y) * scale;
	if (c->kind == CAMERA_ORTHOGRAPHIC) {
		*origin = vec3_along(vec3_along(c->eye, right, c->right), up, c->up);
		*direction = c->ahead;
	} else {
		*origin = c->eye;
		*direction =
		        vec3_unit(vec3_along(vec3_along(c->ahead, right, c->right), up, c->up));
	}
}

bool camera_project(const struct camera *c, struct vec3 p, double *x, double *y, double *depth)
{
	struct vec3 d = vec3_sub(p, c->eye);
	double scale = smaller_side(c) / (2 * c->half);
	*depth = vec3_dot(d, c->ahead);
	if (c->kind == CAMERA_PERSPECTIVE) {
		if (!(*depth > 0))
			return false;
		scale /= *depth;
	}
	*x = c->width / 2.0 + vec3_dot(d, c->right) * scale;
	*y = c->height / 2.0 - vec3_dot(d, c->up) * scale;
	return true;
}

double camera_pixel(const struct camera *c, struct vec3 p)
{
	double pixel = 2 * c->half / smaller_side(c);
	if (c->kind == CAMERA_PERSPECTIVE)
		pixel *= fabs(vec3_dot(vec3_sub(p, c->eye), c->ahead));
	return pixel;
}
