/* level_end.c - the ends of branches: on which borders they lie, and whether two may be one place. */
#include "level_chain.h"

#include <stdlib.h>

/* Over smooth borders whose normals differ a little curves take a step: at most this part of the
 * border, as over knot lines of one surface. */
static const double step_share = 0.02;

/* A branch shorter than this many gaps does not close with itself. */
enum { SHORT_GAPS = 4 };

/* Curvatures that differ by less, as a part of their size, are one. */
static const double curvature_share = 1e-4;

/* How a kind goes on over a border. */
static const struct {
	bool over_creases; /* it depends on the place alone */
	bool turned;       /* it is the same for the opposite normal */
} ways[N_LEVEL_KINDS] = {
	[LEVEL_PLANE] = { true, true },       [LEVEL_CYLINDER] = { true, true },
	[LEVEL_ISOPHOTE] = { false, false },  [LEVEL_SILHOUETTE] = { false, true },
	[LEVEL_EYE] = { false, true },        [LEVEL_HIGHLIGHT] = { false, false },
	[LEVEL_REFLECTION] = { false, true }, [LEVEL_CURVATURE] = { false, false },
};

double faces_size(const struct level_faces *f)
{
	struct box all = box_empty();
	const struct border_node *root = f->nodes.p;
	if (f->nodes.n > 0)
		box_add_box(&all, &root->box);
	return box_is_empty(&all) ? 0 : box_diagonal(&all);
}

static const struct surface *surface_of(const struct joiner *j, int face)
{
	return j->faces->faces[face].surface;
}

/* Does the field mean the same for the opposite normal? */
static bool may_turn(const struct level_field *f)
{
	const bool even =
	        f->kind == LEVEL_CURVATURE &&
	        (f->quantity == QUANTITY_GAUSSIAN ||
	         (f->value == 0 && f->quantity != QUANTITY_KMAX && f->quantity != QUANTITY_KMIN));
	return ways[f->kind].turned || even ||
	       ((f->kind == LEVEL_ISOPHOTE || f->kind == LEVEL_HIGHLIGHT) && f->value == 0);
}

/* Curvatures on both sides, the second's normal times sign. */
static bool curvatures_agree(const struct level_field *f, const struct surface_shape *a,
                             const struct surface_shape *b, double sign)
{
	const double size = curvature_share *
	                    (fabs(a->value[QUANTITY_ABSOLUTE]) + fabs(b->value[QUANTITY_ABSOLUTE]));
	const double mean = a->value[QUANTITY_MEAN] - sign * b->value[QUANTITY_MEAN];
	const double gaussian = a->value[QUANTITY_GAUSSIAN] - b->value[QUANTITY_GAUSSIAN];
	if (!(fabs(mean) <= size) ||
	    !(fabs(gaussian) <= size * (a->value[QUANTITY_ABSOLUTE] + b->value[QUANTITY_ABSOLUTE])))
		return false;
	if (f->quantity != QUANTITY_NORMAL_U && f->quantity != QUANTITY_NORMAL_V)
		return true;
	/* their lines must go on, too */
	const bool u = f->quantity == QUANTITY_NORMAL_U;
	const struct vec3 x =
	        vec3_cross(vec3_unit(u ? a->du : a->dv), vec3_unit(u ? b->du : b->dv));
	return vec3_length(x) <= curvature_share;
}

/* Is the field of both faces one, at places that are one? */
static bool goes_on(const struct joiner *j, int a, const double uva[2], int b, const double uvb[2])
{
	const struct level_field *f = j->how->field;
	struct vec3 m, n;
	if (ways[f->kind].over_creases)
		return true;
	if (!surface_normal(surface_of(j, a), uva[0], uva[1], &m) ||
	    !surface_normal(surface_of(j, b), uvb[0], uvb[1], &n))
		return false;
	const double sign = vec3_dot(m, n) < 0 ? -1 : 1;
	if (vec3_length(vec3_cross(m, n)) > j->how->crease || (sign < 0 && !may_turn(f)))
		return false;
	if (f->kind != LEVEL_CURVATURE)
		return true;
	struct surface_shape x, y;
	surface_shape(surface_of(j, a), uva[0], uva[1], &x);
	surface_shape(surface_of(j, b), uvb[0], uvb[1], &y);
	return curvatures_agree(f, &x, &y, sign);
}

/* Another place on the border, not the end's own one seen from the next edge. */
static bool is_other(const struct joiner *j, const struct chain_end *e, const struct border_foot *x)
{
	const struct surface *s = surface_of(j, e->face);
	if (x->face != e->face)
		return true;
	for (int d = 0; d < 2; d++)
		if (fabs(x->uv[d] - e->uv[d]) > 0.1 * (s->domain[d][1] - s->domain[d][0]))
			return true;
	return false;
}

/* How far off the other end may be: more where the curve is along the border nearly. */
static double end_reach(const struct joiner *j, const struct chain_end *e)
{
	const double gap = j->faces->gap;
	if (e->own < 0)
		return gap;
	const struct border_foot *own = &e->feet[e->own];
	const double across = vec3_length(vec3_cross(own->along, e->out));
	const double grazing = smaller(4 * gap / larger(across, 1e-12), 3 * sqrt(gap * j->size));
	const double step =
	        ways[j->how->field->kind].over_creases
	                ? 0
	                : step_share *
	                          ((const struct border_edge *)j->faces->edges.p)[own->edge].length;
	return larger(gap, larger(grazing, step));
}

/* Is the field of the end's face another there than on the face beyond? Compared where the border of that
 * one is nearest, which may be a corner a little off. */
static bool is_crease(const struct joiner *j, const struct chain_end *e,
                      const struct border_foot *beyond)
{
	struct border_foot feet[END_FEET];
	const int n = border_feet(j->faces, beyond->p, j->faces->gap, feet, END_FEET);
	for (int i = 0; i < n; i++)
		if (feet[i].face == e->face &&
		    (beyond->face != e->face || !is_other(j, e, &feet[i])))
			return !goes_on(j, e->face, feet[i].uv, beyond->face, beyond->uv);
	return !goes_on(j, e->face, e->uv, beyond->face, beyond->uv);
}

static void end_make(const struct joiner *j, const struct level_result *x, size_t branch, int e,
                     struct chain_end *out)
{
	const struct level_branch *b = &x->branches[branch];
	const double t = b->space.domain[e];
	struct vec3 d[2];
	curve_derivatives(&b->space, t, 1, d);
	const struct vec3 uv = curve_point(&b->uv, t);
	out->branch = branch;
	out->closed = b->closed;
	out->length = b->length;
	out->p = out->at = d[0];
	out->out = vec3_scale(vec3_unit(d[1]), e ? 1 : -1);
	out->uv[0] = uv.x;
	out->uv[1] = uv.y;
	out->own = -1;
	if (b->closed)
		return;
	out->n_feet = border_feet(j->faces, out->p, j->faces->gap, out->feet, END_FEET);
	for (int i = out->n_feet - 1; i >= 0; i--)
		if (!is_other(j, out, &out->feet[i]))
			out->own = i;
	out->inside = out->own < 0;
	const struct level_box *mark = b->mark[e] >= 0 ? &x->undecided[b->mark[e]] : NULL;
	if (mark && level_mark_joins(mark->kind)) {
		out->crossing = mark->ends > 1;
		out->at = surface_point(surface_of(j, out->face), mark->at[0], mark->at[1]);
	}
	out->reach = end_reach(j, out);
	const bool place_alone = ways[j->how->field->kind].over_creases;
	out->crease = out->inside && !mark && !place_alone;
	for (int i = 0; i < out->n_feet && !out->inside && !place_alone; i++)
		if (is_other(j, out, &out->feet[i]))
			out->crease |= is_crease(j, out, &out->feet[i]);
}

enum status chain_ends_make(const struct joiner *j, const struct level_result *results, size_t n,
                            struct chain_end **out)
{
	struct chain_end *ends = calloc(2 * n + 1, sizeof *ends);
	size_t k = 0;
	*out = ends;
	if (!ends)
		return ST_RESOURCE;
	for (int i = 0; i < j->faces->n; i++)
		for (size_t b = 0; b < results[i].n_branches; b++)
			for (int e = 0; e < 2; e++, k++) {
				ends[k].k = k;
				ends[k].face = i;
				end_make(j, &results[i], b, e, &ends[k]);
			}
	return ST_OK;
}

/* The foot of `of` on the edge where b ends, or on another of its face; NULL: none. */
static const struct border_foot *foot_on(const struct chain_end *of, const struct chain_end *b)
{
	const struct border_foot *found = NULL;
	for (int i = of->n_feet - 1; i >= 0; i--)
		if (of->feet[i].face == b->face && i != of->own &&
		    (!found || of->feet[i].edge == b->feet[b->own].edge))
			found = &of->feet[i];
	return found;
}

/*
 * Over a longer way: both are on one shared border, and along the border from a to b the field of
 * a's face stays as near to its value as the two faces differ.
 */
static bool step_meets(const struct joiner *j, const struct chain_end *a, const struct chain_end *b)
{
	enum { SAMPLES = 8 };
	if (a->own < 0 || b->own < 0)
		return false;
	const struct border_foot *there = foot_on(a, b), *here = foot_on(b, a);
	const struct border_foot *own = &a->feet[a->own];
	if (!there || !here || there->edge != b->feet[b->own].edge || here->edge != own->edge)
		return false;
	if (!goes_on(j, a->face, a->uv, b->face, there->uv) ||
	    !goes_on(j, b->face, b->uv, a->face, here->uv))
		return false;
	const struct level_field *f = j->how->field;
	const double off = fabs(level_value(f, surface_of(j, a->face), here->uv[0], here->uv[1])) +
	                   fabs(level_value(f, surface_of(j, b->face), there->uv[0], there->uv[1]));
	for (int i = 1; i < SAMPLES; i++) {
		double uv[2], duv[2];
		border_edge_uv(j->faces, own->edge, own->t + (here->t - own->t) * i / SAMPLES, uv,
		               duv);
		if (!(fabs(level_value(f, surface_of(j, a->face), uv[0], uv[1])) <= 2 * off))
			return false;
	}
	return true;
}

bool chain_ends_meet(const struct joiner *j, const struct chain_end *a, const struct chain_end *b,
                     double distance)
{
	const bool place_alone = ways[j->how->field->kind].over_creases;
	const bool same = (a->k ^ 1) == b->k;
	if ((a->crossing && a->inside) || (b->crossing && b->inside) ||
	    (a->crossing && b->crossing && a->face == b->face))
		return false;
	if (same && !(a->length > SHORT_GAPS * j->faces->gap))
		return false;
	if (!place_alone && (a->inside || b->inside))
		return false;
	if (distance <= j->faces->gap)
		return goes_on(j, a->face, a->uv, b->face, b->uv);
	return step_meets(j, a, b);
}
