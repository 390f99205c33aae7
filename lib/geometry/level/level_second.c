/* level_second.c - what fields of second order are made of: derivatives up to the second and the normal, as forms. */
#include "level_second.h"

#include <math.h>
#include <string.h>

/* A product of more numbers than this is asked about row by row. */
static const double long_product = 1e6;

void second_add_product(struct tracer *t, struct form *out, struct form a, struct form b,
                        double weight)
{
	const size_t rows = (size_t)a.m + 1;
	if ((double)form_count(a.m, a.n) * (double)form_count(b.m, b.n) < long_product) {
		if (!tracer_ends(t))
			form_add_product(out, a, b, weight);
		return;
	}
	for (size_t i = 0; i < rows && !tracer_ends(t); i++)
		form_product(a.c + (a.n + 1) * i, 0, a.n, b.c, b.m, b.n, weight,
		             out->c + (out->n + 1) * i);
	out->b = bound_sum(out->b, weight, bound_product(a.b, b.b, out->m, out->n));
}

/* The derivative of a form, both scaled, by the parameter that runs over [0, 1] on the surface. */
static struct form derivative(struct tracer *t, struct form x, int d)
{
	const struct bezier_net *net = &t->level->surface->net;
	const double *binomial = t->level->surface->binomial, *b = net->breaks[d];
	const int degree = d == 0 ? x.m : x.n, i0 = t->place[d];
	const double by = degree * (b[net->spans[d]] - b[0]) / (b[i0 + 1] - b[i0]);
	struct form out = form_new(t, x.m - (d == 0), x.n - (d == 1));
	struct form plain = form_new(t, x.m, x.n);
	memcpy(plain.c, x.c, sizeof *x.c * form_count(x.m, x.n));
	form_scale(plain.c, x.m, x.n, binomial, true);
	const size_t step = d == 0 ? (size_t)x.n + 1 : 1;
	for (int i = 0; i <= out.m; i++)
		for (int j = 0; j <= out.n; j++) {
			const double *c = plain.c + (size_t)i * (x.n + 1) + j;
			out.c[(size_t)i * (out.n + 1) + j] = by * (c[step] - c[0]);
		}
	out.b.size = form_most(out.c, form_count(out.m, out.n));
	out.b.error = 2 * by * x.b.error + 16 * UNIT_ROUNDOFF * (out.b.size + by * x.b.size);
	form_scale(out.c, out.m, out.n, binomial, false);
	return out;
}

/* w Xd - wd X; Xd where w is 1. */
static void quotient(struct tracer *t, const struct form x[4], const struct form d[4],
                     struct form out[3])
{
	for (int k = 0; k < 3; k++) {
		if (!t->level->surface->net.rational) {
			out[k] = d[k];
			continue;
		}
		out[k] = form_new(t, d[k].m + x[3].m, d[k].n + x[3].n);
		form_add_product(&out[k], d[k], x[3], 1);
		form_add_product(&out[k], d[3], x[k], -1);
		form_tighten(t, &out[k]);
	}
}

void second_parts_make(struct tracer *t, struct second_parts *p)
{
	const struct level_surface *s = t->level->surface;
	struct form d[N_DERIVATIVES][4];
	double from[3];
	for (int k = 0; k < 3; k++)
		from[k] = vec3_dot(vec3_of(s->frame[k]), vec3_of(t->points)) / t->points[3];
	form_points(t, from, p->x);
	for (int k = 0; k < 4; k++) {
		d[DU][k] = derivative(t, p->x[k], 0);
		d[DV][k] = derivative(t, p->x[k], 1);
		d[DUU][k] = derivative(t, d[DU][k], 0);
		d[DUV][k] = derivative(t, d[DU][k], 1);
		d[DVV][k] = derivative(t, d[DV][k], 1);
	}
	for (int i = 0; i < N_DERIVATIVES; i++)
		quotient(t, p->x, d[i], p->d[i]);
	for (int k = 0; k < 3; k++)
		p->n[k] = form_normal(t, k);
}

struct form second_dot(struct tracer *t, const struct form a[3], const struct form b[3])
{
	struct form out = form_new(t, a[0].m + b[0].m, a[0].n + b[0].n);
	for (int k = 0; k < 3; k++)
		second_add_product(t, &out, a[k], b[k], 1);
	form_tighten(t, &out);
	return out;
}

struct form second_product(struct tracer *t, struct form a, struct form b)
{
	struct form out = form_new(t, a.m + b.m, a.n + b.n);
	second_add_product(t, &out, a, b, 1);
	form_tighten(t, &out);
	return out;
}

bool second_side_zero(const struct tracer *t, const struct form *f, int d, bool upper)
{
	const double *binomial = t->level->surface->binomial;
	const double *bm = binomial_row(binomial, f->m), *bn = binomial_row(binomial, f->n);
	const int count = d == 0 ? f->n : f->m, at = !upper ? 0 : d == 0 ? f->m : f->n;
	for (int k = 0; k <= count; k++) {
		const int i = d == 0 ? at : k, j = d == 0 ? k : at;
		if (fabs(f->c[(size_t)i * (f->n + 1) + j]) / (bm[i] * bn[j]) >
		    larger(ZERO_SHARE * f->b.size, f->b.error))
			return false;
	}
	return true;
}
