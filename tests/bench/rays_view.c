/* rays_view.c - the camera of the benchmark of rays. */
#include "rays_view.h"

struct vec3 view_direction(const struct view *v, int x, int y)
{
	double a = 0.4 * ((x + 0.5) / SIZE - 0.5), b = 0.4 * (0.5 - (y + 0.5) / SIZE);

	return vec3_unit(vec3_along(vec3_along(v->ahead, a, v->right), b, v->up));
}

struct view view_fit(const struct box *box)
{
	struct view v = { .ahead = vec3_unit(vec3(-0.35, 0.8, -0.5)),
		          .light = vec3_unit(vec3(-0.5, -0.6, 0.65)),
		          .size = box_diagonal(box) };

	v.eye = vec3_along(box_center(box), -1.5 * v.size, v.ahead);
	v.right = vec3_unit(vec3_cross(v.ahead, vec3(0, 0, 1)));
	v.up = vec3_cross(v.right, v.ahead);
	return v;
}
