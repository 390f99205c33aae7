/* environment.c - light stripes, sky, nothing. */
#include "environment.h"

#include <string.h>

enum status environment_init(struct environment *e, const struct work *w, const struct look *look)
{
	const char *kind = work_text(w, "environment");
	struct vec3 axis = work_vector(w, "stripe-direction");
	double size = fmax(fabs(axis.x), fmax(fabs(axis.y), fabs(axis.z)));

	memset(e, 0, sizeof *e);
	e->kind = !strcmp(kind, "sky")    ? ENVIRONMENT_SKY
	          : !strcmp(kind, "none") ? ENVIRONMENT_NONE
	                                  : ENVIRONMENT_STRIPES;
	e->sun = look->light;
	e->zenith = look->sky;
	/* whole pairs of stripes go round, or there would be a seam */
	e->pairs = fmax(1, round(180 / work_real(w, "stripe-width")));
	if (e->kind != ENVIRONMENT_STRIPES)
		return ST_OK;
	if (!(size > 0) || !isfinite(size))
		return report_error(&w->report, ST_PARAMETER,
		                    "--stripe-direction '%s' has no direction; name one like 1,0,0",
		                    work_text(w, "stripe-direction"));
	e->axis = vec3_unit(vec3_scale(axis, 1 / size));
	e->across = vec3_unit(
	        vec3_cross(fabs(e->axis.z) < 0.9 ? vec3(0, 0, 1) : vec3(0, 1, 0), e->axis));
	e->up = vec3_cross(e->axis, e->across);
	return ST_OK;
}

static struct tint blend(struct tint a, struct tint b, double share)
{
	float s = (float)share;

	return (struct tint){ a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b) };
}

static double smooth(double from, double to, double x)
{
	double t = fmin(fmax((x - from) / (to - from), 0), 1);

	return t * t * (3 - 2 * t);
}

static struct tint stripes(const struct environment *e, struct vec3 d)
{
	static const struct tint dark = { 0.02f, 0.025f, 0.035f }, bright = { 0.95f, 0.96f, 1 };
	double angle = atan2(vec3_dot(d, e->up), vec3_dot(d, e->across));
	double turn = angle / (2 * M_PI) * e->pairs, phase = turn - floor(turn);
	double edge = fabs(phase - 0.5); /* 0.25 at the edges of a stripe */

	return blend(bright, dark, smooth(0.235, 0.265, edge));
}

static struct tint sky(const struct environment *e, struct vec3 d)
{
	static const struct tint ground = { 0.10f, 0.09f, 0.08f }, low = { 0.80f, 0.86f, 0.92f };
	static const struct tint high = { 0.16f, 0.33f, 0.62f }, sun = { 6, 5.6f, 5 };
	double up = vec3_dot(d, e->zenith), toward = vec3_dot(d, e->sun);
	struct tint c = blend(low, high, pow(fmax(up, 0), 0.6));

	c = blend(c, ground, smooth(0.02, -0.04, up));
	return toward > 0.99 ? blend(c, sun, smooth(0.9985, 0.9995, toward)) : c;
}

struct tint environment_color(const struct environment *e, struct vec3 d)
{
	if (e->kind == ENVIRONMENT_STRIPES)
		return stripes(e, d);
	if (e->kind == ENVIRONMENT_SKY)
		return sky(e, d);
	return (struct tint){ 0, 0, 0 };
}
