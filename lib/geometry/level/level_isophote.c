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
	const int *degree = l->surface->degree;
	const int m = degree[0] > degree[1] ? degree[0] : degree[1];
	const int root = l->oblique ? l->surface->root->degree : 0;
	const int n = l->oblique ? 2 * (m > root ? m : root) : 0;
	return l->oblique ? FORMS_MAX * form_count(n, n)
	       : level_needs_normals(l->surface->kind)
	               ? FORMS_SQUARES * form_count(l->surface->degree[0], l->surface->degree[1])
	               : 1;
}

/* Coefficients of a normal's components, `step` numbers apart; one of them may be left out (count: none). */
struct cone_points {
	const double *n[3];
	size_t step, count, without;
};

/*
 * All normals' coefficients, and so all normals, lie inside the cone of the angle about the light,
 * or all beyond one plane that touches it.
 */
static bool cone_excludes(const struct level *l, const struct cone_points *p, double error)
{
	const double c = fabs(l->value), s = l->sine;
	const double sign = l->value < 0 ? -1 : 1;
	double mx = 0, my = 0;
	bool inside = true;
	for (size_t i = 0; i < p->count; i++) {
		const double x = p->n[0][p->step * i], y = p->n[1][p->step * i];
		const double z = s * sign * p->n[2][p->step * i] - error;
		mx += x;
		my += y;
		if (i != p->without && !(z > 0 && z * z > c * c * (x * x + y * y) * (1 + 1e-12)))
			inside = false;
	}
	if (inside)
		return true;
	double length = hypot(mx, my);
	if (!(length > 0))
		return false;
	mx *= c / length;
	my *= c / length;
	for (size_t i = 0; i < p->count; i++) {
		const double x = p->n[0][p->step * i], y = p->n[1][p->step * i];
		const double z = p->n[2][p->step * i];
		const double beyond = mx * x + my * y - sign * s * z;
		if (i != p->without && !(beyond > error + 1e-12 * (fabs(x) + fabs(y) + fabs(z))))
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
	return f;
}

bool level_isophote_again(struct tracer *t, const struct cell *cell, double *out, struct bound *b)
{
	const struct level_surface *s = t->level->surface;
	if (s->kind != LEVEL_ISOPHOTE || t->n_side == 0 || t->own_field || t->cleaned)
		return false;
	t->n_product = 0;
	struct form n[3], lower = form_new(t, s->degree[0], s->degree[1]);
	for (int k = 0; k < 3; k++) {
		n[k] = component_in(t, cell, k, lower);
		form_scale(n[k].c, n[k].m, n[k].n, s->binomial, false);
	}
	*b = squares_make(t, n, out);
	return true;
}

/* The coefficient in the corner of the patch that is a corner of the cell, too; false: none. */
static bool corner_of(const struct level_surface *s, const struct cell *cell, size_t *at)
{
	bool upper[2];
	for (int d = 0; d < 2; d++) {
		upper[d] = cell->index[d] > 0;
		if (upper[d] && cell->index[d] != (1u << cell->level[d]) - 1)
			return false;
	}
	*at = (upper[0] ? (size_t)s->degree[0] * (s->degree[1] + 1) : 0) +
	      (upper[1] ? (size_t)s->degree[1] : 0);
	return true;
}

bool level_isophote_clear(struct tracer *t, const struct cell *cell)
{
	const struct level_surface *s = t->level->surface;
	size_t corner;
	if ((s->kind != LEVEL_ISOPHOTE && s->kind != LEVEL_SILHOUETTE) ||
	    !corner_of(s, cell, &corner))
		return false;
	const double *c = t->normals + 4 * corner;
	if (vec3_length(vec3_of(c)) >
	    larger(3 * s->normal_error[t->patch], ZERO_SHARE * level_normal_bound(t).size))
		return false;
	t->n_product = 0;
	struct form n[3], lower = form_new(t, s->degree[0], s->degree[1]);
	double error = 0;
	for (int k = 0; k < 3; k++) {
		n[k] = component_in(t, cell, k, lower);
		error += n[k].b.error;
	}
	const size_t count = form_count(s->degree[0], s->degree[1]);
	const struct cone_points p = { { n[0].c, n[1].c, n[2].c }, 1, count, corner };
	return cone_excludes(t->level, &p, error);
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
	const double *at = t->normals;
	const size_t count = form_count(s->degree[0], s->degree[1]);
	const struct cone_points p = { { at, at + 1, at + 2 }, 4, count, count };
	if (cone_excludes(t->level, &p, 3 * s->normal_error[t->patch]))
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
