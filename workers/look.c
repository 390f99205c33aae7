/* look.c - light and color of surfaces. */
#include "look.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

float look_linear(double x)
{
	return (float)(x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4));
}

static struct tint tint_of(const float srgb[3])
{
	return (struct tint){ look_linear(srgb[0]), look_linear(srgb[1]), look_linear(srgb[2]) };
}

/*
 * Does the file say how the surface looks? Black does not: it is what CAD systems write for "as the
 * pen is", and hides the form.
 */
static bool has_color(const struct entity *e)
{
	return e->has_color && e->color[0] + e->color[1] + e->color[2] > 0.15;
}

static enum status read_light(struct look *l, const struct work *w, const struct camera *c)
{
	if (work_has(w, "light"))
		return work_light(w, &l->light);
	if (!work_has(w, "azimuth") && !work_has(w, "incidence")) {
		struct vec3 d = vec3_scale(c->ahead, -0.72);

		d = vec3_along(d, 0.62, c->up);
		l->light = vec3_unit(vec3_along(d, -0.5, c->right));
		return ST_OK;
	}
	double azimuth = work_has(w, "azimuth") ? work_real(w, "azimuth") : 0;
	double incidence = work_has(w, "incidence") ? work_real(w, "incidence") : 45;
	double a = azimuth * M_PI / 180, i = incidence * M_PI / 180;

	l->light = vec3(sin(i) * cos(a), sin(i) * sin(a), cos(i));
	return ST_OK;
}

enum status look_init(struct look *l, struct work *w, const struct camera *camera)
{
	memset(l, 0, sizeof *l);
	l->sky = vec3_unit(vec3_add(camera->up, vec3(0, 0, 1)));
	if (!(vec3_length(l->sky) > 0)) /* seen from below: up may be -z */
		l->sky = camera->up;
	l->intensity = work_real(w, "intensity");
	l->ambient = work_real(w, "ambient");
	l->diffuse = work_real(w, "diffuse");
	l->specular = work_real(w, "specular");
	l->shininess = work_real(w, "shininess");

	enum status st = read_light(l, w, camera);
	if (st != ST_OK)
		return st;
	l->colors = calloc(w->n_surfaces, sizeof *l->colors);
	if (!l->colors)
		return ST_RESOURCE;

	unsigned rgb = 0;
	sscanf(work_text(w, "color"), "#%6x", &rgb);
	const float srgb[3] = { (rgb >> 16 & 255) / 255.f, (rgb >> 8 & 255) / 255.f,
		                (rgb & 255) / 255.f };
	for (int i = 0; i < w->n_surfaces; i++)
		l->colors[i] = tint_of(has_color(w->entities[i]) ? w->entities[i]->color : srgb);
	return ST_OK;
}

void look_finish(struct look *l)
{
	free(l->colors);
	memset(l, 0, sizeof *l);
}

struct tint look_shade(const struct look *l, struct tint base, struct vec3 n, struct vec3 to_eye,
                       bool lit)
{
	/* from below comes two fifths of what comes from above; what looks at the eye gets a
	 * little more, so that forms in the shade are read too */
	double above = 0.7 + 0.3 * vec3_dot(n, l->sky);
	double facing = vec3_dot(n, to_eye);
	double scattered = l->ambient * above * (0.75 + 0.25 * facing), shine = 0;
	double slope = vec3_dot(n, l->light);

	if (lit && slope > 0) {
		double half = vec3_dot(n, vec3_unit(vec3_add(l->light, to_eye)));

		scattered += l->diffuse * l->intensity * slope;
		if (half > 0 && l->specular > 0)
			shine = l->specular * l->intensity * pow(half, l->shininess);
	}
	return (struct tint){ (float)(base.r * scattered + shine),
		              (float)(base.g * scattered + shine),
		              (float)(base.b * scattered + shine) };
}
