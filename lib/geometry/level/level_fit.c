/* level_fit.c - one cubic in u,v and one in space between two points of the curve.
 *
 * Both have the curve's tangents at the ends, at first of the length that suits a circle. In u,v both are changed
 * alike until the middle lies on the curve; in space, too, and one against the other where the curve is not plane.
 */
#include "level_private.h"

#include <math.h>

/* A length is changed by so much of itself at most. */
#define CHANGE_MAX 0.1

/* Effects nearer to one direction than this sine are one. */
#define SINE_MIN 1e-3

/* The middle is on the curve within this part of the tolerance. */
#define OFF_SHARE 0.01

static double dot(const double *a, const double *b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The curve near a place: along it (of any length; one over its square), and to its nearest point. */
struct place {
	struct field_point x;
	double along[3], per_square, step[2], target[3];
};

static void place_set(const struct tracer *t, const double uv[2], struct place *q)
{
	struct field_point *x = &q->x;
	level_field_at(t, uv[0], uv[1], x);
	for (int d = 0; d < 3; d++)
		q->along[d] = x->fu * x->sv[d] - x->fv * x->su[d];
	q->per_square = 1 / (dot(q->along, q->along) + 1e-300);
	const double f = x->f * q->per_square;
	q->step[0] = -f * dot(x->sv, q->along);
	q->step[1] = f * dot(x->su, q->along);
	for (int d = 0; d < 3; d++)
		q->target[d] = x->p[d] + x->su[d] * q->step[0] + x->sv[d] * q->step[1];
}

/* a without its part along b of that square: 1 over it in `per`. */
static void without(double a[3], const double b[3], double per)
{
	const double part = dot(a, b) * per;
	for (int d = 0; d < 3; d++)
		a[d] -= part * b[d];
}

static void middle_set(const struct place *q, struct proof_middle *mid)
{
	const struct field_point *x = &q->x;
	mid->across[0] = dot(x->sv, q->along) * q->per_square;
	mid->across[1] = -dot(x->su, q->along) * q->per_square;
	for (int d = 0; d < 3; d++)
		mid->step[d] = x->su[d] * mid->across[0] + x->sv[d] * mid->across[1];
}

void level_fit_middle(const struct tracer *t, struct proof_middle *mid)
{
	struct place q;
	place_set(t, mid->uv, &q);
	middle_set(&q, mid);
}

static double fit_uv(const struct place *q, const struct station *a, const struct station *b,
                     double length)
{
	const struct field_point *x = &q->x;
	const double effect =
	        (x->fu * (a->duv[0] - b->duv[0]) + x->fv * (a->duv[1] - b->duv[1])) / 8;
	const double more = effect != 0 ? -x->f / effect : 0;
	return fabs(more) < CHANGE_MAX * length ? length + more : length;
}

/* The lengths in space. `enough`: how far from the curve the middle may stay. */
static void fit_space(const struct place *q, const struct station *a, const struct station *b,
                      double length, double enough, double out[2])
{
	double even[3], odd[3], off[3];
	for (int d = 0; d < 3; d++) {
		even[d] = (a->dp[d] - b->dp[d]) / 8;
		odd[d] = (a->dp[d] + b->dp[d]) / 8;
		off[d] = q->target[d] - 0.5 * (a->p[d] + b->p[d]) - length * even[d];
	}
	without(even, q->along, q->per_square);
	without(off, q->along, q->per_square);
	out[0] = out[1] = length;
	const double even2 = dot(even, even), by_even = dot(off, even) / even2;
	if (!(fabs(by_even) < CHANGE_MAX * length))
		return;
	for (int d = 0; d < 3; d++)
		off[d] -= by_even * even[d];
	out[0] = out[1] = length + by_even;
	if (dot(off, off) <= enough * enough)
		return;
	without(odd, q->along, q->per_square);
	const double shared = dot(odd, even) / even2, odd2 = dot(odd, odd);
	for (int d = 0; d < 3; d++)
		odd[d] -= shared * even[d];
	const double rest2 = dot(odd, odd), by_odd = dot(off, odd) / rest2;
	if (!(rest2 > SINE_MIN * SINE_MIN * odd2 && fabs(by_odd) < CHANGE_MAX * length &&
	      fabs(by_even - shared * by_odd) < CHANGE_MAX * length))
		return;
	out[0] += by_odd - shared * by_odd;
	out[1] -= by_odd + shared * by_odd;
}

/* The parameters that make both cubics run alike: at the ends by their speeds, in the middle by how far one is
 * ahead. */
static void match(const struct place *q, const double uv[2], const struct piece *x,
                  double uv_length, const double length[2], double out[3])
{
	double ahead = 0, speed = 0, off[2], duv[2];
	for (int d = 0; d < 2; d++) {
		off[d] = 0.5 * (x->uv[0][d] + x->uv[1][d]) + (x->duv[0][d] - x->duv[1][d]) / 8 -
		         uv[d];
		duv[d] = 1.5 * (x->uv[1][d] - x->uv[0][d]) - (x->duv[0][d] + x->duv[1][d]) / 4;
	}
	for (int d = 0; d < 3; d++) {
		const double p = 0.5 * (x->p[0][d] + x->p[1][d]) + (x->dp[0][d] - x->dp[1][d]) / 8;
		ahead += (p - q->x.p[d] - q->x.su[d] * off[0] - q->x.sv[d] * off[1]) * q->along[d];
		speed += (q->x.su[d] * duv[0] + q->x.sv[d] * duv[1]) * q->along[d];
	}
	out[0] = 0.5 * (length[0] - length[1]) / uv_length;
	out[1] = 0.5 * (length[0] + length[1]) / uv_length - 1;
	out[2] = speed != 0 ? 16 * ahead / speed - 4 * out[0] : 0;
}

bool level_fit(const struct tracer *t, const struct station *a, const struct station *b,
               double length, struct piece *x, struct proof_middle *mid, double uv[2])
{
	const struct station *s[2] = { a, b };
	struct place q;
	double space[2];
	for (int d = 0; d < 2; d++) {
		mid->uv[d] = 0.5 * (a->uv[d] + b->uv[d]) + length * (a->duv[d] - b->duv[d]) / 8;
		if (!(mid->uv[d] > -0.1 && mid->uv[d] < 1.1))
			return false;
	}
	place_set(t, mid->uv, &q);
	const double uv_length = fit_uv(&q, a, b, length);
	fit_space(&q, a, b, length, OFF_SHARE * t->level->tolerance, space);
	for (int e = 0; e < 2; e++) {
		for (int d = 0; d < 2; d++) {
			x->uv[e][d] = s[e]->uv[d];
			x->duv[e][d] = uv_length * s[e]->duv[d];
		}
		for (int d = 0; d < 3; d++) {
			x->p[e][d] = s[e]->p[d];
			x->dp[e][d] = space[e] * s[e]->dp[d];
		}
	}
	middle_set(&q, mid);
	match(&q, mid->uv, x, uv_length, space, mid->match);
	for (int d = 0; d < 2; d++)
		uv[d] = mid->uv[d] + q.step[d];
	return true;
}
