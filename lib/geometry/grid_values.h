/* grid_values.h - points, normals and curvatures from the derivatives of a block of lanes. Private
 * to the kernels, which compile it once for each vector level. */
#ifndef BATTEN_GRID_VALUES_H
#define BATTEN_GRID_VALUES_H

#include "forms.h"
#include "grid_kernel.h"

static const unsigned grid_points =
        GRID_BIT(GRID_POINT_X) + GRID_BIT(GRID_POINT_Y) + GRID_BIT(GRID_POINT_Z);

enum { S, SU, SV, SUU, SUV, SVV };

#define ALWAYS static inline __attribute__((always_inline))

ALWAYS struct vec3 at(const struct grid_block *b, int derivative, size_t i)
{
	return vec3(b->d[derivative][0][i], b->d[derivative][1][i], b->d[derivative][2][i]);
}

ALWAYS void points(struct grid_block *b, const double center[3], size_t n, const bool rational)
{
	const double x = center[0], y = center[1], z = center[2];
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++) {
		const double w = rational ? 1 / b->d[S][3][i] : 1;
		b->channel[GRID_POINT_X][i] = b->d[S][0][i] * w + x;
		b->channel[GRID_POINT_Y][i] = b->d[S][1][i] * w + y;
		b->channel[GRID_POINT_Z][i] = b->d[S][2][i] * w + z;
	}
}

/* First derivatives of lane i; of a rational form up to the factor w, which a normal has no use for. */
ALWAYS void tangents(const struct grid_block *b, size_t i, const bool rational, const double w,
                     struct vec3 *p, struct vec3 *du, struct vec3 *dv)
{
	*p = vec3(0, 0, 0);
	*du = at(b, SU, i);
	*dv = at(b, SV, i);
	if (rational) {
		*p = vec3_scale(at(b, S, i), w);
		*du = vec3_scale(vec3_along(*du, -b->d[SU][3][i], *p), w);
		*dv = vec3_scale(vec3_along(*dv, -b->d[SV][3][i], *p), w);
	}
}

ALWAYS void normals(struct grid_block *b, size_t n, const bool rational)
{
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++) {
		struct vec3 p, du, dv;
		tangents(b, i, rational, rational ? 1 / b->d[S][3][i] : 1, &p, &du, &dv);
		const struct vec3 cross = vec3_cross(du, dv);
		const double area2 = vec3_dot(cross, cross), scale = 1 / sqrt(area2);
		b->area2[i] = area2;
		b->channel[GRID_NORMAL_X][i] = cross.x * scale;
		b->channel[GRID_NORMAL_Y][i] = cross.y * scale;
		b->channel[GRID_NORMAL_Z][i] = cross.z * scale;
	}
}

/* All quantities, whichever are asked for: with fewer, sums would fuse otherwise and values differ. */
ALWAYS void curvatures(struct grid_block *b, size_t n, const bool rational)
{
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++) {
		struct vec3 p, du, dv;
		const double w = rational ? 1 / b->d[S][3][i] : 1;
		tangents(b, i, rational, w, &p, &du, &dv);
		struct vec3 uu = at(b, SUU, i), uv = at(b, SUV, i), vv = at(b, SVV, i);
		if (rational) {
			/* The parts along Su and Sv are square to the normal: they may go. */
			uu = vec3_scale(vec3_along(uu, -b->d[SUU][3][i], p), w);
			uv = vec3_scale(vec3_along(uv, -b->d[SUV][3][i], p), w);
			vv = vec3_scale(vec3_along(vv, -b->d[SVV][3][i], p), w);
		}
		const struct vec3 cross = vec3_cross(du, dv);
		const struct forms x = {
			vec3_dot(du, du),       vec3_dot(du, dv),    vec3_dot(dv, dv),
			vec3_dot(cross, uu),    vec3_dot(cross, uv), vec3_dot(cross, vv),
			vec3_dot(cross, cross),
		};
		const struct form_values f = forms_values(&x);
		b->area2[i] = x.area2;
		b->channel[QUANTITY_GAUSSIAN][i] = f.gaussian;
		b->channel[QUANTITY_MEAN][i] = f.mean;
		b->channel[QUANTITY_KMAX][i] = f.kmax;
		b->channel[QUANTITY_KMIN][i] = f.kmin;
		b->channel[QUANTITY_ABSOLUTE][i] = fabs(f.kmax) + fabs(f.kmin);
		b->channel[QUANTITY_NORMAL_U][i] = f.normal_u;
		b->channel[QUANTITY_NORMAL_V][i] = f.normal_v;
	}
}

ALWAYS size_t count_low(const double *area2, size_t n, double floor)
{
	size_t count = 0;
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++)
		count += !(area2[i] > floor);
	return count;
}

/* Channels `what` from the derivatives in b. Returns how many lanes have |Su x Sv|^2 <= floor. */
ALWAYS size_t block_values(const double center[3], double floor, unsigned what, size_t n,
                           struct grid_block *b, const bool rational)
{
	if (what & grid_points)
		points(b, center, n, rational);
	if (!(what & grid_first))
		return 0;
	if (what & grid_first & ~grid_second)
		normals(b, n, rational);
	if (what & grid_second)
		curvatures(b, n, rational);
	return count_low(b->area2, n, floor);
}

#endif
