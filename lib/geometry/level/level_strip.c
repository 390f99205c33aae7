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

/* What all lines beside one piece share. */
struct looker {
	const struct strip *s;
	double from, to;                     /* of the piece, in the cell's [0, 1] along it */
	double error;                        /* of f on a line */
	double middle[FIELD_DEGREE_MAX + 1]; /* f across the cell, at the piece's middle */
};

/* Bernstein's polynomials of degree n at x, by sums of positive terms. */
static void weights_at(int n, double x, double *out)
{
	out[0] = 1;
	for (int r = 1; r <= n; r++) {
		out[r] = x * out[r - 1];
		for (int k = r - 1; k > 0; k--)
			out[k] = (1 - x) * out[k] + x * out[k - 1];
		out[0] *= 1 - x;
	}
}

static void looker_init(struct looker *l, const struct strip *s, double from, double to)
{
	const int along = s->along, *n = s->degree;
	const size_t step[2] = { (size_t)n[1] + 1, 1 };
	const double lo = s->box->lo[along], width = s->box->hi[along] - lo;
	double w[FIELD_DEGREE_MAX + 1];
	*l = (struct looker){ .s = s, .from = (from - lo) / width, .to = (to - lo) / width };
	l->error = s->error + form_part_error(s->c, n[0], n[1]);
	weights_at(n[along], 0.5 * (l->from + l->to), w);
	for (int i = 0; i <= n[along]; i++)
		for (int k = 0; k <= n[1 - along]; k++)
			l->middle[k] += w[i] * s->c[step[along] * i + step[1 - along] * k];
}

/* f has one sign, that of above or below the curve, on the line beside the piece at y. */
static bool sign_sure(const struct looker *l, double y, bool above)
{
	const struct strip *s = l->s;
	const int along = s->along, *n = s->degree;
	const size_t step[2] = { (size_t)n[1] + 1, 1 };
	const double *lo = s->box->lo, *hi = s->box->hi;
	const double sign = s->rising == above ? 1 : -1;
	double line[FIELD_DEGREE_MAX + 1], w[FIELD_DEGREE_MAX + 1], middle = 0;
	weights_at(n[1 - along], (y - lo[1 - along]) / (hi[1 - along] - lo[1 - along]), w);
	for (int k = 0; k <= n[1 - along]; k++)
		middle += w[k] * l->middle[k];
	if (!(sign * middle > l->error))
		return false;
	for (int i = 0; i <= n[along]; i++) {
		line[i] = 0;
		for (int k = 0; k <= n[1 - along]; k++)
			line[i] += w[k] * s->c[step[along] * i + step[1 - along] * k];
	}
	form_part(line, 0, n[along], 1, l->from, l->to);
	for (int i = 0; i <= n[along]; i++)
		if (!(sign * line[i] > l->error))
			return false;
	return true;
}

bool level_strip_bound(const struct strip *s, const double a[2], const double b[2], double out[2])
{
	const int along = s->along, other = 1 - along;
	struct looker l;
	const double end[2] = { smaller(a[other], b[other]), larger(a[other], b[other]) };
	const double lo = s->box->lo[other], hi = s->box->hi[other];
	const double first = larger(0.5 * (end[1] - end[0]), NEAR_SHARE * (hi - lo));
	bool found[2] = { false, false };
	looker_init(&l, s, smaller(a[along], b[along]), larger(a[along], b[along]));
	for (int above = 0; above < 2; above++) {
		const double from_end = above ? end[1] : end[0], sign = above ? 1 : -1;
		double away = first, near = 0;
		out[above] = above ? hi : lo;
		for (int k = 0; k < TRIES_MAX; k++, near = away, away *= FARTHER) {
			const double y = from_end + sign * away;
			if (!(y > lo && y < hi))
				break;
			if (!sign_sure(&l, y, above))
				continue;
			out[above] = y;
			found[above] = true;
			for (int times = 0; near > 0 && times < HALVINGS; times++) {
				const double middle = 0.5 * (near + away);
				if (sign_sure(&l, from_end + sign * middle, above))
					out[above] = from_end + sign * (away = middle);
				else
					near = middle;
			}
			break;
		}
	}
	return found[0] && found[1];
}
