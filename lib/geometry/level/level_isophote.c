/* level_isophote.c - isophotes: f from the normal (x, y, z) in a frame whose third axis is the light.
 *
 * With c the cosine f is sin^2 z^2 - c^2 (x^2 + y^2), and z has the sign of c. Near 90 degrees both roots of
 * this nearly touch. There f is z - c s, s a polynomial for the normal's length (level_root.c), which
 * has one root and a slope; what s is off is in the bound, times c.
 * Near 0 and 180 degrees the curves are small loops, in which f is far below its terms on the patch: there
 * it is made in the cells, where its terms are small, too.
 */
#include "level_isophote.h"

#include <math.h>
#include <string.h>

#include "level_root.h"
#include "level_term.h"

/* Where the length of the normal is not known to this share of it, and adds more than the normal is off, squares are
 * better. */
#define LENGTH_SHARE 1e-6

/* No more forms, none of more than twice the degree of s, are needed; for squares alone, of the normal's degree. */
enum { FORMS_MAX = 20, FORMS_SQUARES = 4 };

bool level_oblique(const struct level_field *f)
{
	return f->kind == LEVEL_ISOPHOTE && fabs(f->value) > LEVEL_COSINE_ZERO &&
	       fabs(f->value) <= LEVEL_OBLIQUE;
}

size_t level_isophote_room(const struct level *l)
{
	const int n = l->oblique ? 2 * l->surface->root->degree : 0;
	return l->oblique ? FORMS_MAX * form_count(n, n)
	       : l->side  ? FORMS_SQUARES * form_count(l->surface->degree[0], l->surface->degree[1])
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

/* The difference of squares in a cell or the patch, from the normal's components there; its bound. */
static struct bound squares_make(struct tracer *t, const struct form n[3], double *out)
{
	const struct level *l = t->level;
	const double c = l->value, sine = l->sine;
	struct form f = { out, l->degree[0], l->degree[1], { 0, 0 } };
	const bool raised = f.m > 2 * n[0].m || f.n > 2 * n[0].n;
	struct form squares = raised ? form_new(t, 2 * n[0].m, 2 * n[0].n) : f;
	memset(out, 0, sizeof *out * t->n_field);
	for (int k = 0; k < 3; k++)
		form_add_square(&squares, n[k], k == 2 ? sine * sine : -c * c);
	if (raised)
		form_add(t, &f, squares, 1);
	else
		f.b = squares.b;
	form_scale(out, f.m, f.n, l->surface->binomial, true);
	return f.b;
}

/* One component in a cell. */
static struct form component_in(struct tracer *t, const struct cell *cell, int k, struct form lower)
{
	const struct level_surface *s = t->level->surface;
	struct form f = form_new(t, lower.m, lower.n);
	const size_t count = form_count(f.m, f.n);
	double error = s->normal_error[t->patch];
	for (size_t i = 0; i < count; i++)
		f.c[i] = t->normals[4 * i + k];
	/* halved, and evaluated on the patch */
	const int steps = f.m * (cell->level[0] + 4) + f.n * (cell->level[1] + 4) + 32;
	error += steps * UNIT_ROUNDOFF * form_most(f.c, count);
	for (int d = 0; d < 2; d++)
		for (int bit = cell->level[d] - 1; bit >= 0; bit--) {
			form_split(f.c, f.m, f.n, d, lower.c);
			if (!(cell->index[d] >> bit & 1))
				memcpy(f.c, lower.c, sizeof *f.c * count);
		}
	f.b = (struct bound){ form_most(f.c, count), error };
	form_scale(f.c, f.m, f.n, s->binomial, false);
	return f;
}

bool level_isophote_again(struct tracer *t, const struct cell *cell, double *out, struct bound *b)
{
	const struct level_surface *s = t->level->surface;
	if (s->kind != LEVEL_ISOPHOTE || t->n_side == 0 || t->own_field || t->cleaned)
		return false;
	t->n_product = 0;
	struct form n[3], lower = form_new(t, s->degree[0], s->degree[1]);
	for (int k = 0; k < 3; k++)
		n[k] = component_in(t, cell, k, lower);
	*b = squares_make(t, n, out);
	return true;
}

/* z - c s, or the squares, which have a lower degree, where s is not near enough. */
static void oblique_make(struct tracer *t, const struct form n[3], double *out)
{
	const struct level *l = t->level;
	const struct level_surface *s = l->surface;
	struct form f = { out, l->degree[0], l->degree[1], { 0, 0 } }, root;
	struct form square = form_new(t, 2 * s->degree[0], 2 * s->degree[1]);
	for (int k = 0; k < 3; k++)
		form_add_square(&square, n[k], 1);
	form_tighten(t, &square);
	const bool known = level_root_form(t, &square, &root);
	const double enough = larger(LENGTH_SHARE * root.b.size, n[2].b.error / fabs(l->value));
	if (!known || root.b.error > enough) {
		t->bound = squares_make(t, n, out);
		side_make(t, out + t->n_field);
		return;
	}
	memset(out, 0, sizeof *out * t->n_field);
	form_add(t, &f, n[2], 1);
	form_add(t, &f, root, -l->value);
	form_scale(f.c, f.m, f.n, s->binomial, true);
	t->bound = f.b;
	t->n_side = 0;
	t->own_field = true;
}

bool level_isophote_make(struct tracer *t, double *out)
{
	const struct level_surface *s = t->level->surface;
	struct form n[3];
	if (cone_excludes(t, form_count(s->degree[0], s->degree[1])))
		return false;
	t->n_product = 0;
	for (int k = 0; k < 3; k++)
		n[k] = form_normal(t, k);
	if (t->level->oblique) {
		oblique_make(t, n, out);
	} else {
		t->bound = squares_make(t, n, out);
		side_make(t, out + t->n_field);
	}
	return true;
}
