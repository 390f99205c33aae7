/* border.c - how the borders of a surface's domain lie: joined, or shrunk to a point. */
#include "surface.h"

/* Samples along each span of a border: more than a border curve of that order can hide between. */
static int border_samples(const struct surface *s, int along)
{
	return 2 * s->order[along] + 1;
}

static struct vec3 border_point(const struct surface *s, int d, int end, double t)
{
	double at = s->domain[d][end];
	return d == 0 ? surface_point(s, at, t) : surface_point(s, t, at);
}

/* Walk the border's samples; false as soon as `far` finds one to be beyond tolerance. */
static bool border_holds(const struct surface *s, int along, double tolerance,
                         double (*far)(const struct surface *, int d, int end, double t), int end)
{
	const double *knots = s->knots[along], *domain = s->domain[along];
	const int samples = border_samples(s, along);
	double from = domain[0];
	for (int i = s->order[along]; i <= s->n[along] && from < domain[1]; i++) {
		if (!(knots[i] > from))
			continue;
		double to = fmin(knots[i], domain[1]);
		for (int k = 0; k <= samples; k++)
			if (!(far(s, 1 - along, end, from + (to - from) * k / samples) <=
			      tolerance))
				return false;
		from = to;
	}
	return true;
}

static double gap_to_other_end(const struct surface *s, int d, int end, double t)
{
	struct vec3 a = border_point(s, d, end, t), b = border_point(s, d, 1 - end, t);
	return vec3_length(vec3_sub(a, b));
}

static double gap_to_corner(const struct surface *s, int d, int end, double t)
{
	struct vec3 a = border_point(s, d, end, t);
	struct vec3 b = border_point(s, d, end, s->domain[1 - d][0]);
	return vec3_length(vec3_sub(a, b));
}

bool surface_closed(const struct surface *s, int d, double tolerance)
{
	return border_holds(s, 1 - d, tolerance, gap_to_other_end, 0);
}

bool surface_degenerate(const struct surface *s, int d, int end, double tolerance)
{
	return border_holds(s, 1 - d, tolerance, gap_to_corner, end);
}
