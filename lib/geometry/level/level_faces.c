/* level_faces.c - the borders of faces: found, cut into nearly straight parts, put into a tree. */
#include "level_border.h"

#include <stdlib.h>
#include <string.h>

/* Sides that are one point, or meet, within this part of the size are no border. */
static const double closed_share = 1e-9;

/* Edges are cut into parts as straight as this part of the size, or a quarter of the gap. */
static const double flat_share = 1e-5;

enum { DEPTH_MAX = 12, LEAF = 4, STEPS_MAX = 4096 };

void border_edge_uv(const struct level_faces *f, int edge, double t, double uv[2], double duv[2])
{
	const struct border_edge *e = (const struct border_edge *)f->edges.p + edge;
	const struct surface *s = f->faces[e->face].surface;
	if (!e->uv) {
		uv[e->d] = s->domain[e->d][e->end];
		uv[1 - e->d] = t;
		duv[e->d] = 0;
		duv[1 - e->d] = 1;
		return;
	}
	struct vec3 x[2];
	curve_derivatives(e->uv, t, 1, x);
	const double at[2] = { x[0].x, x[0].y };
	for (int d = 0; d < 2; d++)
		uv[d] = smaller(larger(at[d], s->domain[d][0]), s->domain[d][1]);
	duv[0] = x[1].x;
	duv[1] = x[1].y;
}

static void edge_point(const struct level_faces *f, int edge, double t, struct vec3 *p,
                       struct vec3 *slope, double uv[2])
{
	const struct border_edge *e = (const struct border_edge *)f->edges.p + edge;
	double duv[2];
	struct vec3 su, sv;
	border_edge_uv(f, edge, t, uv, duv);
	surface_tangents(f->faces[e->face].surface, uv[0], uv[1], p, &su, &sv);
	*slope = vec3_along(vec3_scale(su, duv[0]), duv[1], sv);
}

static struct vec3 edge_at(const struct level_faces *f, int edge, double t)
{
	struct vec3 p, slope;
	double uv[2];
	edge_point(f, edge, t, &p, &slope, uv);
	return p;
}

static double off_chord(struct vec3 a, struct vec3 b, struct vec3 p)
{
	const struct vec3 d = vec3_sub(b, a), x = vec3_sub(p, a);
	const double l = vec3_dot(d, d);
	const double at = l > 0 ? smaller(larger(vec3_dot(x, d) / l, 0), 1) : 0;
	return vec3_length(vec3_along(x, -at, d));
}

/* Halve until the quarters lie near the chord; the box is twice as much larger. */
static void segments_add(struct level_faces *f, int edge, double a, double b, int depth)
{
	const struct vec3 p = edge_at(f, edge, a), q = edge_at(f, edge, b);
	double off = 0;
	for (int i = 1; i < 4; i++)
		off = larger(off, off_chord(p, q, edge_at(f, edge, a + 0.25 * i * (b - a))));
	if (off > f->flat && depth < DEPTH_MAX) {
		const double middle = 0.5 * (a + b);
		segments_add(f, edge, a, middle, depth + 1);
		segments_add(f, edge, middle, b, depth + 1);
		return;
	}
	struct border_segment *s = list_add(&f->segments, sizeof *s);
	if (!s)
		return;
	*s = (struct border_segment){ .edge = edge, .t = { a, b }, .box = box_empty() };
	box_add_point(&s->box, vec3_sub(p, vec3(2 * off, 2 * off, 2 * off)));
	box_add_point(&s->box, vec3_along(p, 2 * off, vec3(1, 1, 1)));
	box_add_point(&s->box, vec3_sub(q, vec3(2 * off, 2 * off, 2 * off)));
	box_add_point(&s->box, vec3_along(q, 2 * off, vec3(1, 1, 1)));
	((struct border_edge *)f->edges.p)[edge].length += vec3_length(vec3_sub(p, q));
}

/* How many knot spans of the surface a straight way in u,v goes over, at least one. */
static int spans_over(const struct surface *s, const double a[2], const double b[2])
{
	double n = 1;
	for (int d = 0; d < 2; d++)
		n += (s->n[d] - s->order[d] + 1) * fabs(b[d] - a[d]) /
		     (s->domain[d][1] - s->domain[d][0]);
	return (int)smaller(n, STEPS_MAX);
}

static void edge_add(struct level_faces *f, const struct border_edge *e)
{
	const struct surface *s = f->faces[e->face].surface;
	struct border_edge *x = list_add(&f->edges, sizeof *x);
	const int edge = (int)f->edges.n - 1;
	if (!x)
		return;
	*x = *e;
	const double *knots = e->uv ? e->uv->knots : s->knots[1 - e->d];
	const int order = e->uv ? e->uv->order : s->order[1 - e->d];
	const int n = e->uv ? e->uv->n : s->n[1 - e->d];
	for (int i = order - 1; i < n; i++) {
		const double a = larger(knots[i], e->t[0]), b = smaller(knots[i + 1], e->t[1]);
		double from[2], to[2], slope[2];
		if (!(a < b))
			continue;
		border_edge_uv(f, edge, a, from, slope);
		border_edge_uv(f, edge, b, to, slope);
		const int steps = 2 + (e->uv ? spans_over(s, from, to) : 0);
		for (int k = 0; k < steps; k++)
			segments_add(f, edge, a + (b - a) * k / steps,
			             a + (b - a) * (k + 1) / steps, 0);
	}
}

/* Does a trimming curve lie along the seam of a closed surface, and does the face go on beyond? */
static bool on_seam(const struct level_faces *f, int face, const struct curve *c)
{
	const struct surface *s = f->faces[face].surface;
	for (int d = 0; d < 2; d++)
		for (int end = 0; end < 2; end++) {
			const double range = s->domain[d][1] - s->domain[d][0];
			bool along = surface_closed(s, d, closed_share * surface_size(s));
			for (int i = 0; along && i < c->n; i++) {
				const struct vec3 p = curve_get_point(c, i, NULL);
				along = fabs((d == 0 ? p.x : p.y) - s->domain[d][end]) <=
				        closed_share * range;
			}
			if (!along)
				continue;
			const struct vec3 m = curve_point(c, 0.5 * (c->domain[0] + c->domain[1]));
			double uv[2] = { m.x, m.y };
			uv[d] = s->domain[d][1 - end];
			return trim_test_inside(f->tests[face], uv[0], uv[1]);
		}
	return false;
}

static bool no_point(const struct level_faces *f, int face, int d, int end)
{
	const struct surface *s = f->faces[face].surface;
	return !surface_degenerate(s, d, end, closed_share * surface_size(s));
}

static void face_edges(struct level_faces *f, int i)
{
	const struct surface *s = f->faces[i].surface;
	const struct trim *t = f->faces[i].trim;
	bool outer = false;
	for (int l = 0; f->tests[i] && l < t->n; l++)
		outer |= t->loops[l].outer;
	/* holes alone leave the sides */
	for (int d = 0; !outer && d < 2; d++) {
		if (surface_closed(s, d, closed_share * surface_size(s)))
			continue;
		for (int end = 0; end < 2; end++)
			if (no_point(f, i, d, end))
				edge_add(f, &(struct border_edge){ .face = i,
				                                   .d = d,
				                                   .end = end,
				                                   .t = { s->domain[1 - d][0],
				                                          s->domain[1 - d][1] } });
	}
	for (int l = 0; f->tests[i] && l < t->n; l++)
		for (int k = 0; k < t->loops[l].n; k++) {
			const struct curve *c = &t->loops[l].curves[k];
			if (!on_seam(f, i, c))
				edge_add(f, &(struct border_edge){
				                    .face = i,
				                    .uv = c,
				                    .t = { c->domain[0], c->domain[1] } });
		}
}

static int by_middle(const struct border_segment *a, const struct border_segment *b, int axis)
{
	const double p[3] = { a->box.lo.x + a->box.hi.x, a->box.lo.y + a->box.hi.y,
		              a->box.lo.z + a->box.hi.z };
	const double q[3] = { b->box.lo.x + b->box.hi.x, b->box.lo.y + b->box.hi.y,
		              b->box.lo.z + b->box.hi.z };
	if (p[axis] != q[axis])
		return p[axis] < q[axis] ? -1 : 1;
	if (a->edge != b->edge)
		return a->edge - b->edge;
	return a->t[0] < b->t[0] ? -1 : a->t[0] > b->t[0];
}

static int by_x(const void *a, const void *b)
{
	return by_middle(a, b, 0);
}

static int by_y(const void *a, const void *b)
{
	return by_middle(a, b, 1);
}

static int by_z(const void *a, const void *b)
{
	return by_middle(a, b, 2);
}

/* The tree over segments [from, to), halved along the longest extent. Returns its root. */
static int tree_make(struct level_faces *f, int from, int to)
{
	static int (*const compare[3])(const void *, const void *) = { by_x, by_y, by_z };
	struct border_segment *s = f->segments.p;
	struct border_node *node = list_add(&f->nodes, sizeof *node);
	const int at = (int)f->nodes.n - 1;
	if (!node)
		return 0;
	node->box = box_empty();
	for (int i = from; i < to; i++)
		box_add_box(&node->box, &s[i].box);
	node->from = from;
	node->to = to;
	if (to - from <= LEAF)
		return at;
	const struct vec3 d = vec3_sub(node->box.hi, node->box.lo);
	const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
	qsort(s + from, (size_t)(to - from), sizeof *s, compare[axis]);
	tree_make(f, from, (from + to) / 2);
	const int right = tree_make(f, (from + to) / 2, to);
	if (!f->nodes.failed)
		((struct border_node *)f->nodes.p)[at].right = right;
	return at;
}

enum status level_faces_create(struct level_faces **out, const struct level_face *faces, int n,
                               double gap)
{
	struct level_faces *f = calloc(1, sizeof *f);
	*out = f;
	if (!f)
		return ST_RESOURCE;
	f->n = n;
	f->gap = gap;
	f->faces = calloc((size_t)n + 1, sizeof *f->faces);
	f->tests = calloc((size_t)n + 1, sizeof *f->tests);
	enum status st = f->faces && f->tests ? ST_OK : ST_RESOURCE;
	for (int i = 0; st == ST_OK && i < n; i++) {
		f->faces[i] = faces[i];
		if (faces[i].trim && faces[i].trim->n > 0)
			st = trim_test_create(&f->tests[i], faces[i].trim, faces[i].surface);
		/* feet are found on the edge itself: parts need not be flatter however small the gap */
		f->flat = larger(0.25 * gap, flat_share * surface_size(faces[i].surface));
		if (st == ST_OK)
			face_edges(f, i);
	}
	if (st == ST_OK && f->segments.n > 0)
		tree_make(f, 0, (int)f->segments.n);
	if (f->edges.failed || f->segments.failed || f->nodes.failed)
		st = ST_RESOURCE;
	if (st != ST_OK) {
		level_faces_destroy(f);
		*out = NULL;
	}
	return st;
}

void level_faces_destroy(struct level_faces *f)
{
	if (!f)
		return;
	for (int i = 0; f->tests && i < f->n; i++)
		trim_test_destroy(f->tests[i]);
	free(f->tests);
	free(f->faces);
	free(f->edges.p);
	free(f->segments.p);
	free(f->nodes.p);
	free(f);
}

/* A segment's point nearest to p: from the chord's, by Newton's method without curvature. */
static void segment_foot(const struct level_faces *f, const struct border_segment *s, struct vec3 p,
                         struct border_foot *out)
{
	enum { STEPS = 12 };
	const struct vec3 a = edge_at(f, s->edge, s->t[0]);
	const struct vec3 d = vec3_sub(edge_at(f, s->edge, s->t[1]), a);
	const double l = vec3_dot(d, d), h = s->t[1] - s->t[0];
	double x = l > 0 ? vec3_dot(vec3_sub(p, a), d) / l : 0;
	double t = s->t[0] + h * smaller(larger(x, 0), 1);
	struct vec3 q, slope;
	for (int i = 0; i < STEPS; i++) {
		edge_point(f, s->edge, t, &q, &slope, out->uv);
		const double m = vec3_dot(slope, slope);
		const double step = m > 0 ? vec3_dot(vec3_sub(p, q), slope) / m : 0;
		const double next = smaller(larger(t + step, s->t[0]), s->t[1]);
		if (fabs(next - t) <= 1e-14 * h)
			break;
		t = next;
	}
	edge_point(f, s->edge, t, &q, &slope, out->uv);
	out->edge = s->edge;
	out->face = ((const struct border_edge *)f->edges.p)[s->edge].face;
	out->t = t;
	out->p = q;
	out->along = vec3_unit(slope);
	out->distance = vec3_length(vec3_sub(p, q));
}

static bool box_near(const struct box *b, struct vec3 p, double r)
{
	return p.x >= b->lo.x - r && p.x <= b->hi.x + r && p.y >= b->lo.y - r &&
	       p.y <= b->hi.y + r && p.z >= b->lo.z - r && p.z <= b->hi.z + r;
}

/* Into a list that rises with the distance, one an edge. Returns its new length. */
static int foot_put(struct border_foot *out, int n, int max, const struct border_foot *x)
{
	int at = 0;
	while (at < n && out[at].edge != x->edge)
		at++;
	if (at < n && out[at].distance <= x->distance)
		return n;
	if (at == n && n == max) {
		if (out[--at].distance <= x->distance)
			return n;
	} else if (at == n) {
		n++;
	}
	for (; at > 0 && out[at - 1].distance > x->distance; at--)
		out[at] = out[at - 1];
	out[at] = *x;
	return n;
}

int border_feet(const struct level_faces *f, struct vec3 p, double radius, struct border_foot *out,
                int max)
{
	enum { STACK = 128 };
	const struct border_node *nodes = f->nodes.p;
	const struct border_segment *segments = f->segments.p;
	int stack[STACK], top = 0, n = 0;
	if (f->nodes.n > 0)
		stack[top++] = 0;
	while (top > 0) {
		const struct border_node *node = &nodes[stack[--top]];
		if (!box_near(&node->box, p, radius))
			continue;
		if (node->right) {
			stack[top++] = (int)(node - nodes) + 1;
			stack[top++] = node->right;
			continue;
		}
		for (int i = node->from; i < node->to; i++) {
			struct border_foot x;
			if (!box_near(&segments[i].box, p, radius))
				continue;
			segment_foot(f, &segments[i], p, &x);
			if (x.distance <= radius)
				n = foot_put(out, n, max, &x);
		}
	}
	return n;
}
