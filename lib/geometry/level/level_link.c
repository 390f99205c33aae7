/* level_link.c - which strands meet: over edges between patches, seams and poles. */
#include "level_private.h"

#include <math.h>
#include <stdlib.h>

/* How far apart two ends on an edge may lie, as a part of the edge. Where the sides share their
 * coefficients only rounding parts them; where the normals differ a little the curve has a small
 * step, which is bridged. */
static const double shared_step = 1e-6, smooth_step = 0.1, smooth_step_unequal = 0.02;

/* Ends that found no partner on their edge (at a corner, or where the curve grazes the edge) meet
 * others within this part of the size. */
static const double corner_step = 1e-6;

/* Through a pole: cosine between one way out and the other's opposite. */
static const double pole_straight = 0.9999;

struct edge_end {
	int d, line, along; /* the edge; a seam's two lines are line 0 */
	int side;           /* 0: the strand lies below the line, 1: above */
	double at;
	size_t end;
};

static int edge_compare(const struct edge_end *a, const struct edge_end *b)
{
	if (a->d != b->d)
		return a->d - b->d;
	if (a->line != b->line)
		return a->line - b->line;
	return a->along - b->along;
}

/* Of two ends on one edge. */
static bool edge_end_before(const struct edge_end *a, const struct edge_end *b)
{
	if (a->side != b->side)
		return a->side < b->side;
	return a->at != b->at ? a->at < b->at : a->end < b->end;
}

/*
 * Edge after edge, on each those from below first, rising: by counting, then inserting. Errors: ST_RESOURCE.
 */
static enum status edge_ends_sort(const struct level_surface *s, const struct edge_end *e, size_t n,
                                  struct edge_end *out)
{
	const size_t edges = (size_t)(s->net.spans[0] + 1) * s->net.spans[1],
	             all = edges + (size_t)(s->net.spans[1] + 1) * s->net.spans[0];
	size_t *first = calloc(all + 1, sizeof *first);
	if (!first)
		return ST_RESOURCE;
	for (size_t i = 0; i < n; i++)
		first[edges * e[i].d + (size_t)e[i].line * s->net.spans[1 - e[i].d] + e[i].along +
		      1]++;
	for (size_t i = 0; i < all; i++)
		first[i + 1] += first[i];
	/* first[k] becomes where edge k ends */
	for (size_t i = 0; i < n; i++) {
		size_t k =
		        edges * e[i].d + (size_t)e[i].line * s->net.spans[1 - e[i].d] + e[i].along;
		size_t to = first[k]++;
		for (; to > 0 && edge_compare(&out[to - 1], &e[i]) == 0 &&
		       edge_end_before(&e[i], &out[to - 1]);
		     to--)
			out[to] = out[to - 1];
		out[to] = e[i];
	}
	free(first);
	return ST_OK;
}

static bool uv_jumps(const struct joint *j, size_t a, size_t b)
{
	const struct bezier_net *net = &j->level->surface->net;
	struct joint_end x, y;
	joint_end_get(j, a, &x);
	joint_end_get(j, b, &y);
	for (int d = 0; d < 2; d++) {
		double range = net->breaks[d][net->spans[d]] - net->breaks[d][0];
		if (fabs(x.uv[d] - y.uv[d]) > 0.2 * range)
			return true;
	}
	return false;
}

static void link_ends(struct joint *j, size_t a, size_t b, bool cut, bool on_edge)
{
	j->links[a] = (struct link){ LINK_STRAND, b, cut, on_edge, 0 };
	j->links[b] = (struct link){ LINK_STRAND, a, cut, on_edge, 0 };
}

/* Pair a[0..n) from below with b[0..m) from above, both rising. */
static void link_edge(struct joint *j, const struct edge_end *a, int n, const struct edge_end *b,
                      int m, enum edge_kind kind, bool seam)
{
	double step = kind == EDGE_SHARED ? shared_step : smooth_step;
	bool in_order = n == m;
	for (int i = 0; in_order && i < n; i++)
		in_order = fabs(a[i].at - b[i].at) <= step;
	if (!in_order && kind != EDGE_SHARED)
		step = smooth_step_unequal;
	for (int i = 0, k = 0; i < n && k < m;) {
		double off = b[k].at - a[i].at;
		/* the next one may be nearer */
		bool skip_a = !in_order && i + 1 < n && fabs(b[k].at - a[i + 1].at) < fabs(off);
		bool skip_b = !in_order && k + 1 < m && fabs(b[k + 1].at - a[i].at) < fabs(off);
		if (fabs(off) <= step && !skip_a && !skip_b) {
			link_ends(j, a[i].end, b[k].end, seam, true);
			i++;
			k++;
		} else if (off > 0) {
			i++;
		} else {
			k++;
		}
	}
}

/* Ends at one pole: each goes on straight, where another does. */
static void link_pole(struct joint *j, const struct edge_end *e, int n)
{
	for (int i = 0; i < n; i++)
		j->links[e[i].end].kind = LINK_END;
	for (int i = 0; i < n; i++) {
		struct joint_end x, y;
		double best = -pole_straight;
		int other = -1;
		if (j->links[e[i].end].kind == LINK_STRAND)
			continue;
		joint_end_get(j, e[i].end, &x);
		for (int k = i + 1; k < n; k++) {
			if (j->links[e[k].end].kind == LINK_STRAND)
				continue;
			joint_end_get(j, e[k].end, &y);
			double c = x.tangent[0] * y.tangent[0] + x.tangent[1] * y.tangent[1] +
			           x.tangent[2] * y.tangent[2];
			if (c < best) {
				best = c;
				other = k;
			}
		}
		if (other >= 0)
			link_ends(j, e[i].end, e[other].end, true, false);
	}
}

/* On a crease curves end, but where its angle vanishes they go on. e[0 .. middle) lie below it. */
static void link_crease(struct joint *j, struct edge_end *e, int middle, int n)
{
	int kept = 0, below = 0;
	for (int k = 0; k < n; k++) {
		if (!level_smooth_at(j->level->surface, e[k].d, e[k].line, e[k].along, e[k].at)) {
			j->links[e[k].end].kind = LINK_END;
			continue;
		}
		below += k < middle;
		e[kept++] = e[k];
	}
	link_edge(j, e, below, e + below, kept - below, EDGE_CREASE, e[0].line == 0);
	for (int k = 0; k < kept; k++)
		if (j->links[e[k].end].kind == LINK_NONE)
			j->links[e[k].end].kind = LINK_END;
}

static void link_edges(struct joint *j, struct edge_end *e, int n)
{
	const struct level_surface *s = j->level->surface;
	for (int i = 0; i < n;) {
		int middle = i, end = i;
		while (middle < n && edge_compare(&e[middle], &e[i]) == 0 && e[middle].side == 0)
			middle++;
		for (end = middle; end < n && edge_compare(&e[end], &e[i]) == 0;)
			end++;
		int d = e[i].d;
		size_t at = d == 0 ? level_edge(s, 0, e[i].line, e[i].along)
		                   : level_edge(s, 1, e[i].along, e[i].line);
		enum edge_kind kind = s->edges[d][at];
		if (kind == EDGE_SHARED || kind == EDGE_SMOOTH) {
			link_edge(j, e + i, middle - i, e + middle, end - middle, kind,
			          e[i].line == 0);
		} else if (kind == EDGE_POLE) {
			while (end < n && e[end].d == d && e[end].line == e[i].line)
				end++;
			link_pole(j, e + i, end - i);
		} else if (kind == EDGE_CREASE) {
			link_crease(j, e + i, middle - i, end - i);
		} else {
			for (int k = i; k < end; k++)
				j->links[e[k].end].kind = LINK_END;
		}
		i = end;
	}
}

/* An end left over. */
struct rest {
	struct joint_end at;
	size_t end;
	bool loose; /* inside its patch, at an undecided cell */
};

static int rest_compare(const void *x, const void *y)
{
	const struct rest *a = x, *b = y;
	if (a->at.p[0] != b->at.p[0])
		return a->at.p[0] < b->at.p[0] ? -1 : 1;
	return a->end < b->end ? -1 : a->end > b->end;
}

/* A corner of the surface's border counts as border. */
static bool on_border(const struct joint *j, const double uv[2])
{
	const struct bezier_net *net = &j->level->surface->net;
	for (int d = 0; d < 2; d++) {
		double lo = net->breaks[d][0], hi = net->breaks[d][net->spans[d]];
		double near = shared_step * (hi - lo);
		if (!net->closed[d] && (uv[d] < lo + near || uv[d] > hi - near))
			return true;
	}
	return false;
}

/* Nothing goes on here, and no reason is known: say so. */
static bool box_at(struct joint *j, const struct rest *x)
{
	const struct bezier_net *net = &j->level->surface->net;
	struct level_box *b = list_add(&j->boxes, sizeof *b);
	if (!b)
		return false;
	for (int d = 0; d < 2; d++) {
		double lo = net->breaks[d][0], hi = net->breaks[d][net->spans[d]];
		double near = shared_step * (hi - lo);
		b->lo[d] = larger(lo, x->at.uv[d] - near);
		b->hi[d] = smaller(hi, x->at.uv[d] + near);
	}
	return true;
}

static enum status link_rest(struct joint *j, struct rest *r, size_t n)
{
	double step = corner_step * j->level->surface->net.size;
	qsort(r, n, sizeof *r, rest_compare);
	for (size_t i = 0; i < n; i++) {
		double best = step;
		size_t other = n;
		if (r[i].loose || j->links[r[i].end].kind != LINK_NONE)
			continue;
		for (size_t k = i + 1; k < n && r[k].at.p[0] - r[i].at.p[0] <= step; k++) {
			const double *a = r[i].at.p, *b = r[k].at.p;
			const double *x = r[i].at.tangent, *y = r[k].at.tangent;
			double off = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
			if (!r[k].loose && j->links[r[k].end].kind == LINK_NONE && off <= best &&
			    x[0] * y[0] + x[1] * y[1] + x[2] * y[2] < 0) {
				best = off;
				other = k;
			}
		}
		if (other < n)
			link_ends(j, r[i].end, r[other].end, uv_jumps(j, r[i].end, r[other].end),
			          false);
	}
	for (size_t i = 0; i < n; i++) {
		struct link *l = &j->links[r[i].end];
		if (l->kind != LINK_NONE)
			continue;
		l->kind = LINK_END;
		if (!r[i].loose && !on_border(j, r[i].at.uv) && !box_at(j, &r[i]))
			return ST_RESOURCE;
	}
	return ST_OK;
}

enum status level_link(struct joint *j)
{
	const struct bezier_net *net = &j->level->surface->net;
	struct edge_end *e = calloc(4 * j->n_strands + 1, sizeof *e);
	struct edge_end *sorted = e ? e + 2 * j->n_strands : NULL;
	struct rest *rest = malloc(sizeof *rest * (2 * j->n_strands + 1));
	enum status st = ST_RESOURCE;
	size_t n = 0, n_rest = 0;
	if (!e || !rest)
		goto out;
	for (size_t i = 0; i < 2 * j->n_strands; i++) {
		const struct strand_end *x = &j->strands[i / 2].end[i % 2];
		int place[2] = { j->patch[i / 2] / net->spans[1], j->patch[i / 2] % net->spans[1] };
		if (x->kind != STRAND_BORDER)
			continue;
		int line = place[x->d] + x->upper;
		if (net->closed[x->d] && line == net->spans[x->d])
			line = 0;
		e[n++] = (struct edge_end){ x->d, line, place[1 - x->d], !x->upper, x->at, i };
	}
	if (edge_ends_sort(j->level->surface, e, n, sorted) != ST_OK)
		goto out;
	link_edges(j, sorted, (int)n);
	for (size_t i = 0; i < 2 * j->n_strands; i++) {
		const struct strand_end *x = &j->strands[i / 2].end[i % 2];
		if (x->kind == STRAND_CLOSED || j->links[i].kind != LINK_NONE)
			continue;
		rest[n_rest].end = i;
		rest[n_rest].loose = x->kind == STRAND_LOOSE;
		joint_end_get(j, i, &rest[n_rest].at);
		n_rest++;
	}
	st = link_rest(j, rest, n_rest);
out:
	free(e);
	free(rest);
	return st;
}
