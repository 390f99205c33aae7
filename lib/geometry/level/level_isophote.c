/* level_isophote.c - isophotes: f from the normal (x, y, z) in a frame whose third axis is the light.
 *
 * With c the cosine f is sin^2 z^2 - c^2 (x^2 + y^2), and z has the sign of c. Near 90 degrees both roots of
 * this nearly touch. There f is z - c s, s a polynomial for the normal's length (level_root.c), which
 * has one root and a slope; what s is off is in the bound, times c.
 */
#include "level_term.h"

#include <math.h>
#include <string.h>

/* Where the length of the normal is not known to this share of it, squares are better. */
#define LENGTH_SHARE 1e-6

/* No more forms, none of more than twice the degree of s, are needed. */
enum { FORMS_MAX = 20 };

bool level_oblique(const struct level_field *f)
{
	return f->kind == LEVEL_ISOPHOTE && fabs(f->value) > LEVEL_COSINE_ZERO &&
	       fabs(f->value) <= LEVEL_OBLIQUE;
}

size_t level_isophote_room(const struct level *l)
{
	const int n = l->oblique ? 2 * l->surface->root->degree : 0;
	return l->oblique ? FORMS_MAX * form_count(n, n)
	       : l->side  ? form_count(l->surface->degree[0], l->surface->degree[1])
	                  : 1;
}

/*
 * All normals' coefficients, and so all normals, lie inside the cone of the angle about the light,
 * or all beyond one plane that touches it.
 */
static bool cone_excludes(const struct tracer *t, size_t count)
{
	const double c = fabs(t->level->value), s = t->level->sine;
	const double sign = t->level->value < 0 ? -1 : 1;
	const double error = 3 * t->level->surface->normal_error[t->patch];
	double mx = 0, my = 0;
	bool inside = true;
	for (size_t i = 0; i < count; i++) {
		const double *n = t->normals + 4 * i;
		double z = s * sign * n[2] - error;
		mx += n[0];
		my += n[1];
		if (!(z > 0 && z * z > c * c * (n[0] * n[0] + n[1] * n[1]) * (1 + 1e-12)))
			inside = false;
	}
	if (inside)
		return true;
	double l = hypot(mx, my);
	if (!(l > 0))
		return false;
	mx *= c / l;
	my *= c / l;
	for (size_t i = 0; i < count; i++) {
		const double *n = t->normals + 4 * i;
		double beyond = mx * n[0] + my * n[1] - sign * s * n[2];
		if (!(beyond > error + 1e-12 * (fabs(n[0]) + fabs(n[1]) + fabs(n[2]))))
			return false;
	}
	return true;
}

/* z, of the sign that it has on the curves. */
static void side_make(struct tracer *t, double *out)
{
	const struct level_surface *s = t->level->surface;
	const double sign = t->level->value < 0 ? -1 : 1;
	for (size_t i = 0; i < form_count(s->degree[0], s->degree[1]); i++)
		out[i] = sign * t->normals[4 * i + 2];
	t->side_error = s->normal_error[t->patch];
}

static void squares_make(struct tracer *t, double *out)
{
	const struct level_surface *s = t->level->surface;
	int m = s->degree[0], n = s->degree[1];
	size_t count = (size_t)(m + 1) * (n + 1);
	double c = t->level->value, sine = t->level->sine;
	struct bound normal = level_normal_bound(t);
	struct bound square = bound_product(normal, normal, 2 * m, 2 * n);
	t->bound = bound_sum(bound_sum(square, c * c, square), c * c, square);
	memset(out, 0, sizeof *out * t->n_field);
	for (int k = 0; k < 3; k++) {
		for (size_t i = 0; i < count; i++)
			t->product[i] = t->normals[4 * i + k];
		form_scale(t->product, m, n, s->binomial, false);
		form_square(t->product, m, n, k == 2 ? sine * sine : -c * c, out);
	}
	form_scale(out, 2 * m, 2 * n, s->binomial, true);
	side_make(t, out + t->n_field);
}

/* z - c s, or the squares, which have a lower degree, where s is not near enough. */
static void oblique_make(struct tracer *t, double *out)
{
	const struct level *l = t->level;
	const struct level_surface *s = l->surface;
	const double c = l->value, sine = l->sine;
	struct form f = { out, l->degree[0], l->degree[1], { 0, 0 } }, n[3], root;
	struct form square = form_new(t, 2 * s->degree[0], 2 * s->degree[1]);
	memset(out, 0, sizeof *out * t->n_field);
	for (int k = 0; k < 3; k++) {
		n[k] = form_normal(t, k);
		form_add_square(&square, n[k], 1);
	}
	form_tighten(t, &square);
	if (level_root_form(t, &square, &root) && root.b.error <= LENGTH_SHARE * root.b.size) {
		form_add(t, &f, n[2], 1);
		form_add(t, &f, root, -c);
		t->n_side = 0;
		t->own_field = true;
	} else {
		struct form squares = form_new(t, square.m, square.n);
		for (int k = 0; k < 3; k++)
			form_add_square(&squares, n[k], k == 2 ? sine * sine : -c * c);
		form_add(t, &f, squares, 1);
		side_make(t, out + t->n_field);
	}
	form_scale(f.c, f.m, f.n, s->binomial, true);
	t->bound = f.b;
}

bool level_isophote_make(struct tracer *t, double *out)
{
	const struct level_surface *s = t->level->surface;
	if (cone_excludes(t, form_count(s->degree[0], s->degree[1])))
		return false;
	t->n_product = 0;
	if (t->level->oblique)
		oblique_make(t, out);
	else
		squares_make(t, out);
	return true;
}
