/* level_curvature.c - lines of constant curvature: f from the forms of both fundamental forms.
 *
 * With X = (P, w), A = w Pu - wu P, B = w Pv - wv P (Pu and Pv where w = 1), Duu = w Puu - wuu P and so
 * on, N as everywhere: l = Duu . N, m = Duv . N, n = Dvv . N, and
 *   k = l n - m^2                     K = k w^2 / |N|^4
 *   h = A.A n - 2 A.B m + B.B l       H = h / 2 |N|^3
 *   normal curvature in u             l w^2 / (A.A |N|)
 * so that the fields are, s being |N| (level_root.c):
 *   Gaussian   k w^2 - c N.N^2
 *   mean       h - 2 c N.N s
 *   principal  c^2 N.N^2 + k w^2 - c h s, and 2 c N.N s - h >= 0 for kmax, <= 0 for kmin
 *   normal     l w^2 - c A.A s
 * For c = 0 that is k, h, k with the sign of h, l.
 * Where N has lost a factor p at a pole (level_normal.c) l, m, n, k, h are made of the N that is left, and k and
 * h have another p^2 to lose: there a surface has curvatures only if they do have it.
 * Source: do Carmo, Differential Geometry of Curves and Surfaces (1976), section 3.3.
 */
#include "level_second.h"

#include <math.h>
#include <string.h>

#include "curvature.h"
#include "level_root.h"

/* Relative to the larger curvature: what jumps by less over a line is continuous there. */
#define JUMP_SHARE 1e-6

/* No more forms, none of higher degree than f, are needed. */
enum { FORMS_MAX = 80 };

static int most(int a, int b)
{
	return a > b ? a : b;
}

void level_curvature_degree(struct level *l)
{
	const struct level_surface *s = l->surface;
	const bool zero = l->value == 0;
	for (int d = 0; d < 2; d++) {
		const int p = s->net.order[d] - 1, extra = s->net.rational ? p : 0;
		const int m = s->degree[d], root = s->root ? s->root->degree : 0;
		const int square = p - 1 + extra, h = 3 * p - 2 + 3 * extra + m;
		const int second = p + extra + m; /* of l, m, n: at most */
		l->side_degree[d] = zero ? h : most(2 * m + root, h);
		/* no form is raised to a degree that only others have */
		if (zero) {
			l->degree[d] = s->quantity == QUANTITY_MEAN       ? h
			               : s->quantity >= QUANTITY_NORMAL_U ? second
			                                                  : 2 * (p - 1 + extra + m);
			continue;
		}
		switch (s->quantity) {
		case QUANTITY_GAUSSIAN:
			l->degree[d] = 4 * m;
			break;
		case QUANTITY_MEAN:
			l->degree[d] = l->side_degree[d];
			break;
		case QUANTITY_KMAX:
		case QUANTITY_KMIN:
			l->degree[d] = most(4 * m, h + root);
			break;
		default:
			l->degree[d] = most(second + 2 * p, 2 * (square + 1) + root);
		}
	}
}

size_t level_curvature_room(const struct level *l)
{
	int m = most(l->degree[0], l->side_degree[0]), n = most(l->degree[1], l->side_degree[1]);
	for (int k = 0; l->surface->root && k < 2; k++) {
		m = most(m, 2 * l->surface->root->degree);
		n = most(n, 2 * l->surface->root->degree);
	}
	return FORMS_MAX * form_count(m, n);
}

/* Take out the square of the factors that the normal has lost; false where it is not there. */
static bool factors_out(struct tracer *t, struct form *f)
{
	const unsigned char *factors = t->level->surface->factors + (size_t)4 * t->patch;
	for (int side = 0; side < 4; side++)
		for (int k = 0; k < 2 * factors[side]; k++) {
			const int d = side / 2, upper = side % 2;
			if (!second_side_zero(t, f, d, upper))
				return false;
			form_divide(f->c, f->m, f->n, d, upper);
			f->b.error *= (d == 0 ? f->m : f->n) + 1;
			form_tighten(t, f);
		}
	return true;
}

static bool gauss_form(struct tracer *t, const struct second_parts *p, struct form *k)
{
	const struct form l = second_dot(t, p->d[DUU], p->n), m = second_dot(t, p->d[DUV], p->n),
	                  n = second_dot(t, p->d[DVV], p->n);
	*k = form_new(t, 2 * m.m, 2 * m.n);
	second_add_product(t, k, l, n, 1);
	second_add_product(t, k, m, m, -1);
	form_tighten(t, k);
	if (!factors_out(t, k))
		return false;
	if (t->level->surface->net.rational && t->level->value != 0)
		*k = second_product(t, *k, second_product(t, p->x[3], p->x[3]));
	return true;
}

static bool mean_form(struct tracer *t, const struct second_parts *p, struct form *h)
{
	const struct form l = second_dot(t, p->d[DUU], p->n), m = second_dot(t, p->d[DUV], p->n),
	                  n = second_dot(t, p->d[DVV], p->n);
	const struct form e = second_dot(t, p->d[DU], p->d[DU]),
	                  f = second_dot(t, p->d[DU], p->d[DV]),
	                  g = second_dot(t, p->d[DV], p->d[DV]);
	*h = form_new(t, f.m + m.m, f.n + m.n);
	second_add_product(t, h, e, n, 1);
	second_add_product(t, h, f, m, -2);
	second_add_product(t, h, g, l, 1);
	form_tighten(t, h);
	return factors_out(t, h);
}

/* weight (2 c N.N s - h), whose sign tells kmax from kmin. */
static void beside_mean(struct tracer *t, struct form *out, struct form square, struct form root,
                        struct form h, double weight)
{
	form_add(t, out, second_product(t, square, root), 2 * t->level->value * weight);
	form_add(t, out, h, -weight);
}

static bool normal_make(struct tracer *t, const struct second_parts *p, struct form root,
                        struct form *f)
{
	const bool u = t->level->surface->quantity == QUANTITY_NORMAL_U;
	const struct form *along = p->d[u ? DU : DV];
	struct form second = second_dot(t, p->d[u ? DUU : DVV], p->n);
	if (t->level->surface->net.rational)
		second = second_product(t, second, second_product(t, p->x[3], p->x[3]));
	form_add(t, f, second, 1);
	form_add(t, f, second_product(t, second_dot(t, along, along), root), -t->level->value);
	return true;
}

/* The value is 0: factors that all terms have are left out, and no length is needed. */
static bool zero_make(struct tracer *t, const struct second_parts *p, struct form *f,
                      struct form *side)
{
	const enum quantity quantity = t->level->surface->quantity;
	const bool gauss = quantity == QUANTITY_GAUSSIAN || t->n_side > 0;
	struct form k, h;
	if (quantity == QUANTITY_NORMAL_U || quantity == QUANTITY_NORMAL_V) {
		form_add(t, f, second_dot(t, p->d[quantity == QUANTITY_NORMAL_U ? DUU : DVV], p->n),
		         1);
		return true;
	}
	if ((gauss && !gauss_form(t, p, &k)) ||
	    (quantity != QUANTITY_GAUSSIAN && !mean_form(t, p, &h)))
		return false;
	form_add(t, f, gauss ? k : h, 1);
	if (t->n_side)
		form_add(t, side, h, quantity == QUANTITY_KMAX ? -1 : 1);
	return true;
}

static bool field_make(struct tracer *t, struct form *f, struct form *side)
{
	const struct level *l = t->level;
	const enum quantity quantity = l->surface->quantity;
	const double c = l->value;
	struct second_parts p;
	struct form k, h, root;
	second_parts_make(t, &p);
	if (c == 0)
		return zero_make(t, &p, f, side);
	const struct form square = second_dot(t, p.n, p.n);
	if (quantity == QUANTITY_GAUSSIAN) {
		if (!gauss_form(t, &p, &k))
			return false;
		form_add(t, f, k, 1);
		second_add_product(t, f, square, square, -c);
		return true;
	}
	if (!level_root_form(t, &square, &root))
		return false;
	if (quantity == QUANTITY_NORMAL_U || quantity == QUANTITY_NORMAL_V)
		return normal_make(t, &p, root, f);
	if (!mean_form(t, &p, &h))
		return false;
	if (quantity == QUANTITY_MEAN) {
		beside_mean(t, f, square, root, h, -1);
		return true;
	}
	if (!gauss_form(t, &p, &k))
		return false;
	form_add(t, f, second_product(t, square, square), c * c);
	form_add(t, f, k, 1);
	form_add(t, f, second_product(t, h, root), -c);
	beside_mean(t, side, square, root, h, quantity == QUANTITY_KMAX ? 1 : -1);
	return true;
}

bool level_curvature_make(struct tracer *t, double *out)
{
	const struct level *l = t->level;
	const double *binomial = l->surface->binomial;
	struct form f = { out, l->degree[0], l->degree[1], { 0, 0 } };
	struct form side = { out + t->n_field, l->side_degree[0], l->side_degree[1], { 0, 0 } };
	if (form_most(t->normals, level_normals_size(l->surface)) == 0) {
		level_patch_undecided(t, true);
		return false;
	}
	memset(out, 0, sizeof *out * (t->n_field + t->n_side));
	t->n_product = 0;
	if (!field_make(t, &f, &side)) {
		level_patch_undecided(t, false);
		return false;
	}
	form_scale(f.c, f.m, f.n, binomial, true);
	if (t->n_side)
		form_scale(side.c, side.m, side.n, binomial, true);
	t->bound = f.b;
	t->side_error = side.b.error;
	t->own_field = true;
	return true;
}

/* A patch as a surface of its own over [0, 1]. */
static enum status patch_surface(const struct level_surface *s, int patch, struct surface *out)
{
	const struct bezier_net *net = &s->net;
	enum status st = surface_init(out, net->order, net->order);
	if (st != ST_OK)
		return st;
	memcpy(out->points, net->points + bezier_patch_size(net) * patch,
	       sizeof(double) * bezier_patch_size(net));
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < 2 * net->order[d]; i++)
			out->knots[d][i] = i >= net->order[d];
	return surface_check(out, "patch", NULL);
}

enum status level_mean_at(const struct level_surface *s, int patch, const double uv[2],
                          double *mean)
{
	struct surface one = { .n = { 0, 0 } };
	struct surface_shape x;
	const enum status st = patch_surface(s, patch, &one);
	if (st == ST_OK) {
		surface_shape(&one, uv[0], uv[1], &x);
		*mean = x.value[QUANTITY_MEAN];
	}
	surface_finish(&one);
	return st;
}

static bool near(double a, double b, double scale)
{
	return fabs(a - b) <= JUMP_SHARE * scale;
}

enum status level_curvature_agrees(const struct level_surface *s, const int patch[2], int d,
                                   const double *at, int n, bool *agrees)
{
	struct surface side[2] = { { .n = { 0, 0 } }, { .n = { 0, 0 } } };
	enum status st = patch_surface(s, patch[0], &side[0]);
	if (st == ST_OK)
		st = patch_surface(s, patch[1], &side[1]);
	*agrees = st == ST_OK;
	for (int i = 0; i < n && *agrees; i++) {
		struct surface_shape x[2];
		for (int k = 0; k < 2; k++) {
			double uv[2] = { at[i], at[i] };
			uv[d] = k == 0 ? 1 : 0;
			surface_shape(&side[k], uv[0], uv[1], &x[k]);
		}
		const double *a = x[0].value, *b = x[1].value;
		const double most = a[QUANTITY_ABSOLUTE] + b[QUANTITY_ABSOLUTE] + 1 / s->net.size;
		/* where both have none, nothing jumps */
		if (isnan(most))
			continue;
		*agrees = near(a[QUANTITY_GAUSSIAN], b[QUANTITY_GAUSSIAN], most * most) &&
		          near(a[QUANTITY_MEAN], b[QUANTITY_MEAN], most);
	}
	surface_finish(&side[0]);
	surface_finish(&side[1]);
	return st;
}
