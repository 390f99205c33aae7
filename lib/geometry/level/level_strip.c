/* level_strip.c - where a curve must be that is a graph over one direction.
 *
 * f is monotone across the graph. So where f has one sign all along a line beside a piece, beyond rounding, the curve
 * is on one side of that line. It needs no slopes, and holds where rounding leaves none.
 */
#include "level_private.h"

#include <math.h>
#include <string.h>

/* Lines are tried farther and farther away, then between the first sure one and the one before. */
enum { TRIES_MAX = 40, HALVINGS = 3 };
#define FARTHER 3.0

/* Of the cell, what is nearer is not tried. */
#define NEAR_SHARE 1e-7

/* f has one sign, that of above or below the curve, on the line from .. to at y. */
static bool sign_sure(const struct strip *s, double from, double to, double y, bool above)
{
	const int along = s->along, n[2] = { s->degree[0], s->degree[1] };
	const size_t row = (size_t)n[1] + 1;
	const size_t step[2] = { row, 1 };
	const double *lo = s->box->lo, *hi = s->box->hi;
	const double x = (y - lo[1 - along]) / (hi[1 - along] - lo[1 - along]);
	const double width = hi[along] - lo[along];
	double line[FIELD_DEGREE_MAX + 1], d[FIELD_DEGREE_MAX + 1] = { 0 };
	for (int i = 0; i <= n[along]; i++) {
		for (int k = 0; k <= n[1 - along]; k++)
			d[k] = s->c[step[along] * i + step[1 - along] * k];
		for (int r = 1; r <= n[1 - along]; r++)
			for (int k = 0; k <= n[1 - along] - r; k++)
				d[k] += x * (d[k + 1] - d[k]);
		line[i] = d[0];
	}
	form_part(line, 0, n[along], 1, (from - lo[along]) / width, (to - lo[along]) / width);
	const double error = s->error + form_part_error(s->c, n[0], n[1]);
	const double sign = s->rising == above ? 1 : -1;
	for (int i = 0; i <= n[along]; i++)
		if (!(sign * line[i] > error))
			return false;
	return true;
}

void level_strip_bound(const struct strip *s, const double a[2], const double b[2], double out[2])
{
	const int along = s->along, other = 1 - along;
	const double from = smaller(a[along], b[along]), to = larger(a[along], b[along]);
	const double end[2] = { smaller(a[other], b[other]), larger(a[other], b[other]) };
	const double lo = s->box->lo[other], hi = s->box->hi[other];
	const double first = larger(0.5 * (end[1] - end[0]), NEAR_SHARE * (hi - lo));
	for (int above = 0; above < 2; above++) {
		const double from_end = above ? end[1] : end[0], sign = above ? 1 : -1;
		double away = first, near = 0;
		out[above] = above ? hi : lo;
		for (int k = 0; k < TRIES_MAX; k++, near = away, away *= FARTHER) {
			const double y = from_end + sign * away;
			if (!(y > lo && y < hi))
				break;
			if (!sign_sure(s, from, to, y, above))
				continue;
			out[above] = y;
			for (int times = 0; near > 0 && times < HALVINGS; times++) {
				const double middle = 0.5 * (near + away);
				if (sign_sure(s, from, to, from_end + sign * middle, above))
					out[above] = from_end + sign * (away = middle);
				else
					near = middle;
			}
			break;
		}
	}
}
