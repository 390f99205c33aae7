/* level_term.c - forms and their products, in the room of a tracer. */
#include "level_term.h"

#include <math.h>
#include <string.h>

struct form form_new(struct tracer *t, int m, int n)
{
	struct form f = { t->product + t->n_product, m, n, { 0, 0 } };
	t->n_product += form_count(m, n);
	memset(f.c, 0, sizeof *f.c * form_count(m, n));
	return f;
}

/* A coefficient of the product is a sum of at most so many. */
static double terms_of(struct form a, struct form b)
{
	return ((a.m < b.m ? a.m : b.m) + 1.0) * ((a.n < b.n ? a.n : b.n) + 1.0);
}

void form_add_product(struct form *out, struct form a, struct form b, double weight)
{
	form_product(a.c, a.m, a.n, b.c, b.m, b.n, weight, out->c);
	out->b = bound_sum(out->b, weight,
	                   bound_product_of(a.b, b.b, terms_of(a, b), out->m, out->n));
}

void form_add_square(struct form *out, struct form a, double weight)
{
	form_square(a.c, a.m, a.n, weight, out->c);
	out->b = bound_sum(out->b, weight, bound_product(a.b, a.b, out->m, out->n));
}

/* A form that is 1 all over. */
static struct form form_one(struct tracer *t, int m, int n)
{
	struct form one = form_new(t, m, n);
	for (size_t i = 0; i < form_count(m, n); i++)
		one.c[i] = 1;
	one.b.size = 1;
	form_scale(one.c, m, n, t->level->surface->binomial, false);
	return one;
}

void form_add(struct tracer *t, struct form *out, struct form a, double weight)
{
	struct form raised = form_new(t, out->m, a.n);
	form_add_product(&raised, a, form_one(t, out->m - a.m, 0), 1);
	form_add_product(out, raised, form_one(t, 0, out->n - a.n), weight);
}

struct form form_normal(struct tracer *t, int d)
{
	const struct level_surface *s = t->level->surface;
	struct form f = form_new(t, s->degree[0], s->degree[1]);
	for (size_t i = 0; i < form_count(f.m, f.n); i++)
		f.c[i] = t->normals[4 * i + d];
	f.b = (struct bound){ form_most(f.c, form_count(f.m, f.n)), s->normal_error[t->patch] };
	form_scale(f.c, f.m, f.n, s->binomial, false);
	return f;
}

struct bound form_moved_bound(const struct tracer *t, const double from[3])
{
	struct bound points, weights;
	level_patch_bounds(t->level->surface, t->points, &points, &weights);
	double away = vec3_length(vec3_of(from));
	struct bound b = { points.size + away * weights.size, 0 };
	b.error = 2 * points.error + away * weights.error + 16 * UNIT_ROUNDOFF * b.size;
	return b;
}

void form_points(struct tracer *t, const double from[3], struct form out[4])
{
	const struct level_surface *s = t->level->surface;
	int m = s->net.order[0] - 1, n = s->net.order[1] - 1;
	struct bound of_points, of_weights, moved = form_moved_bound(t, from);
	level_patch_bounds(s, t->points, &of_points, &of_weights);
	for (int d = 0; d < 4; d++) {
		struct form f = form_new(t, m, n);
		for (size_t i = 0; i < form_count(m, n); i++) {
			const double *p = t->points + 4 * i, *r = s->frame[d % 3];
			f.c[i] = d == 3 ? p[3]
			                : r[0] * p[0] + r[1] * p[1] + r[2] * p[2] - from[d] * p[3];
		}
		f.b = d == 3 ? of_weights : moved;
		f.b.size = form_most(f.c, form_count(m, n));
		form_scale(f.c, m, n, s->binomial, false);
		out[d] = f;
	}
}

void form_tighten(const struct tracer *t, struct form *f)
{
	const double *binomial = t->level->surface->binomial;
	const double *bm = binomial_row(binomial, f->m), *bn = binomial_row(binomial, f->n);
	double most = 0;
	for (int i = 0; i <= f->m; i++)
		for (int j = 0; j <= f->n; j++)
			most = larger(most,
			              fabs(f->c[(size_t)i * (f->n + 1) + j]) / (bm[i] * bn[j]));
	f->b.size = most * (1 + 4 * UNIT_ROUNDOFF);
}
