/* camera_text.c - a camera as it is, in words that give it back to the last bit. */
#include <stdio.h>
#include <string.h>

#include "camera.h"
#include "number.h"

static const char head[] = "camera:";
static const char *const kinds[] = {
	[CAMERA_ORTHOGRAPHIC] = ":orthographic", [CAMERA_PERSPECTIVE] = ":perspective"
};
enum { NUMBERS = 13 };

void camera_write(char out[CAMERA_TEXT_SIZE], const struct camera *c)
{
	const double x[NUMBERS] = { c->eye.x,   c->eye.y,   c->eye.z, c->right.x, c->right.y,
		                    c->right.z, c->up.x,    c->up.y,  c->up.z,    c->ahead.x,
		                    c->ahead.y, c->ahead.z, c->half };
	char *p = stpcpy(out, head);

	for (int i = 0; i < NUMBERS; i++) {
		p += number_write(p, x[i]);
		*p++ = ',';
	}
	strcpy(p - 1, kinds[c->kind]);
}

static bool is_axes(const struct camera *c)
{
	const struct vec3 across = vec3_add(vec3_cross(c->right, c->up), c->ahead);

	return fabs(vec3_length(c->right) - 1) < 1e-6 && fabs(vec3_length(c->up) - 1) < 1e-6 &&
	       fabs(vec3_dot(c->right, c->up)) < 1e-6 && vec3_length(across) < 1e-6;
}

bool camera_is_text(const char *view)
{
	return !strncmp(view, head, sizeof head - 1);
}

bool camera_parse(struct camera *out, const char *text)
{
	const char *p = text + sizeof head - 1, *end = text + strlen(text);
	double x[NUMBERS];

	if (!camera_is_text(text))
		return false;
	for (int i = 0; i < NUMBERS; i++) {
		if (i && *p++ != ',')
			return false;
		if (!number_read(&p, end, &x[i]) || !(fabs(x[i]) < 1e300))
			return false;
	}
	if (strcmp(p, kinds[CAMERA_ORTHOGRAPHIC]) && strcmp(p, kinds[CAMERA_PERSPECTIVE]))
		return false;
	*out = (struct camera){ .kind = strcmp(p, kinds[CAMERA_PERSPECTIVE]) ? CAMERA_ORTHOGRAPHIC
		                                                             : CAMERA_PERSPECTIVE,
		                .eye = vec3(x[0], x[1], x[2]),
		                .right = vec3(x[3], x[4], x[5]),
		                .up = vec3(x[6], x[7], x[8]),
		                .ahead = vec3(x[9], x[10], x[11]),
		                .half = x[12] };
	return out->half > 0 && is_axes(out);
}
