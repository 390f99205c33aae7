/* mesh_cut.c - edges cut into pieces that are straight enough; all of one line at the same points. */
#include <stdlib.h>
#include <string.h>

#include "mesh_private.h"

/* Bends are counted by int: to halve them so often is enough. */
enum { DEPTH_MAX = 24, POLE_DEPTH_MAX = 7, BENDS_DEPTH_MAX = 33 };

/* Of its length: an edge that strays less is straight. */
static const double straight_within = 1e-9;

/* Of its length: a bend so near to an end is the end. */
static const double short_of = 1e-7;

/* Largest turn between neighbouring rays from a pole. Radians. */
static const double pole_turn = 0.5;

/* One line in space being cut: the edge that gives the points, and all that share them. */
struct line {
	struct mesh_build *b;
	struct mesh_edge *master;
	const int *members;
	int n_members;
	double *ways;  /* owned; for each depth the members' parameters at the middle */
	double *ends;  /* owned; at the start, at the end, then at the bends */
	double *bends; /* owned; rising */
	int n_bends;
};

static enum status vertex_point(struct mesh_build *b, int vertex, int *point)
{
	struct mesh_vertex *v = &b->vertices[vertex];
	enum status st = v->point < 0 ? mesh_add_point(b, v->p, &v->point) : ST_OK;
	*point = v->point;
	return st;
}

static enum status add_node(struct mesh_build *b, struct mesh_edge *e, double t, int point)
{
	enum status st =
	        mesh_grow((void **)&e->nodes, &e->nodes_room, e->n_nodes + 1, sizeof *e->nodes);
	if (st != ST_OK)
		return st;
	struct mesh_node *node = &e->nodes[e->n_nodes++];
	*node = (struct mesh_node){ .t = t, .point = point };
	mesh_edge_uv(b, e, t, node->uv);
	return ST_OK;
}

/* A node of the master and of all others; those that run against it are turned about at last. */
static enum status line_add(struct line *x, double t, const double *ways)
{
	struct mesh_build *b = x->b;
	struct mesh_edge *m = x->master;
	const bool end = t == m->t[0] || t == m->t[1];
	int point;
	if (b->out->n_points > TESSELLATE_MOST)
		return mesh_too_many(b);
	enum status st = end || m->degenerate ? vertex_point(b, m->vertex[t != m->t[0]], &point)
	                                      : mesh_add_point(b, mesh_edge_point(b, m, t), &point);
	for (int k = 0; k < x->n_members && st == ST_OK; k++)
		st = add_node(b, &b->edges[x->members[k]], ways[k], point);
	return st;
}

static double angle_between(struct vec3 a, struct vec3 b)
{
	return atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b));
}

/* The normals of some face turn too far between points of the line. */
static bool turns(const struct line *x, const double *from, const double *middle, const double *to)
{
	const double limit = x->b->limits->angle;
	for (int k = 0; k < x->n_members; k++) {
		const struct mesh_edge *e = &x->b->edges[x->members[k]];
		const struct mesh_creases *c = &x->b->creases[e->face];
		double uv[3][2];
		struct vec3 n[3];
		mesh_edge_uv(x->b, e, from[k], uv[0]);
		mesh_edge_uv(x->b, e, middle[k], uv[1]);
		mesh_edge_uv(x->b, e, to[k], uv[2]);
		for (int i = 0; i < 3; i++)
			n[i] = mesh_patch_normal(x->b->faces[e->face].surface, c,
			                         mesh_patch_of(c, uv[1]), uv[i]);
		/* without a normal: NaN, and no turn */
		if (angle_between(n[0], n[1]) > limit || angle_between(n[1], n[2]) > limit ||
		    angle_between(n[0], n[2]) > limit)
			return true;
	}
	return false;
}

/* Where the members pass the master's point at t, between their parameters before and behind it:
 * always between, so that their nodes keep the order. */
static void find_ways(const struct line *x, double t, const double *from, const double *to,
                      double *ways)
{
	const struct vec3 p = mesh_edge_point(x->b, x->master, t);
	for (int k = 0; k < x->n_members; k++) {
		const struct mesh_edge *e = &x->b->edges[x->members[k]];
		const double lo = fmin(from[k], to[k]), hi = fmax(from[k], to[k]);
		const double least = 0.05 * (hi - lo);
		ways[k] = t;
		if (e == x->master)
			continue;
		mesh_edge_nearest(x->b, e, p, lo, hi, &ways[k]);
		ways[k] = fmin(fmax(ways[k], lo + least), hi - least);
	}
}

/* Nodes between from and to, and at `to` itself. */
static enum status cut_between(struct line *x, const double t[2], const double *from,
                               const double *to, int depth, int least)
{
	const struct tessellate_limits *l = x->b->limits;
	const double middle = 0.5 * (t[0] + t[1]);
	const struct vec3 p[3] = { mesh_edge_point(x->b, x->master, t[0]),
		                   mesh_edge_point(x->b, x->master, middle),
		                   mesh_edge_point(x->b, x->master, t[1]) };
	const double far = mesh_edge_stray(x->b, x->master, t[0], t[1]);
	const double length = vec3_length(vec3_sub(p[1], p[0])) + vec3_length(vec3_sub(p[2], p[1]));
	double *ways = x->ways + (size_t)depth * x->n_members;
	bool split =
	        depth < least || far > l->chord || (depth == 0 && far > straight_within * length);
	if (depth >= DEPTH_MAX || middle <= t[0] || middle >= t[1])
		return line_add(x, t[1], to);
	find_ways(x, middle, from, to, ways);
	if (!split && length > l->chord)
		split = angle_between(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[1])) > l->angle ||
		        turns(x, from, ways, to);
	if (!split)
		return line_add(x, t[1], to);
	enum status st = cut_between(x, (double[2]){ t[0], middle }, from, ways, depth + 1, least);
	return st == ST_OK ? cut_between(x, (double[2]){ middle, t[1] }, ways, to, depth + 1, least)
	                   : st;
}

/* Direction in which the surface leaves a border that is one point. */
static struct vec3 ray_at(const struct line *x, double t)
{
	const struct mesh_edge *e = x->master;
	double uv[2];
	struct vec3 p, du, dv;
	mesh_edge_uv(x->b, e, t, uv);
	surface_tangents(x->b->faces[e->face].surface, uv[0], uv[1], &p, &du, &dv);
	return vec3_unit(e->a[0] == e->b[0] ? du : dv);
}

static enum status cut_pole(struct line *x, double from, double to, int depth)
{
	const double middle = 0.5 * (from + to);
	const struct vec3 a = ray_at(x, from), m = ray_at(x, middle), b = ray_at(x, to);
	if (depth >= POLE_DEPTH_MAX ||
	    (angle_between(a, m) <= 0.5 * pole_turn && angle_between(m, b) <= 0.5 * pole_turn))
		return line_add(x, to, &to);
	enum status st = cut_pole(x, from, middle, depth + 1);
	return st == ST_OK ? cut_pole(x, middle, to, depth + 1) : st;
}

/* The master's sharp bends, but those next to an end or to the one before. */
static enum status find_bends(struct line *x)
{
	const struct mesh_edge *e = x->master;
	const double near = short_of * mesh_edge_length(x->b, e, e->t[0], e->t[1]);
	const struct vec3 end = mesh_edge_point(x->b, e, e->t[1]);
	struct vec3 last = mesh_edge_point(x->b, e, e->t[0]);
	double at = e->t[0];
	enum status st = ST_OK;
	int room = 0;
	for (int i = 1; e->uv && i < e->uv->n && st == ST_OK; i++) {
		const double t = e->uv->knots[i];
		if (!(t > at && t < e->t[1] && t == e->uv->knots[i + e->uv->order - 2]))
			continue;
		const struct vec3 p = mesh_edge_point(x->b, e, t);
		at = t;
		if (vec3_length(vec3_sub(p, last)) <= near || vec3_length(vec3_sub(p, end)) <= near)
			continue;
		last = p;
		st = mesh_grow((void **)&x->bends, &room, x->n_bends + 1, sizeof *x->bends);
		if (st == ST_OK)
			x->bends[x->n_bends++] = t;
	}
	return st;
}

/* Nodes between t[0] and t[1], where bends lo .. hi - 1 lie. The middle one first, so that the others'
 * parameters are looked for in ever shorter pieces. */
static enum status cut_bends(struct line *x, const double t[2], int lo, int hi, const double *from,
                             const double *to, int depth)
{
	/* a line that ends where it began needs a few points to be one */
	const bool ring = x->master->vertex[0] == x->master->vertex[1];
	if (lo >= hi)
		return cut_between(x, t, from, to, 0,
		                   ring ? x->n_bends < 1 ? 2 : x->n_bends < 3 : 0);
	const int middle = lo + (hi - lo) / 2;
	const double at = x->bends[middle];
	double *ways = x->ends + (size_t)depth * x->n_members;
	find_ways(x, at, from, to, ways);
	enum status st = cut_bends(x, (double[2]){ t[0], at }, lo, middle, from, ways, depth + 1);
	return st == ST_OK
	               ? cut_bends(x, (double[2]){ at, t[1] }, middle + 1, hi, ways, to, depth + 1)
	               : st;
}

static void turn_nodes(struct mesh_edge *e)
{
	for (int i = 0; i < e->n_nodes / 2; i++) {
		const struct mesh_node node = e->nodes[i];
		e->nodes[i] = e->nodes[e->n_nodes - 1 - i];
		e->nodes[e->n_nodes - 1 - i] = node;
	}
}

static enum status cut_line(struct line *x)
{
	const struct mesh_edge *e = x->master;
	enum status st;
	if (e->degenerate) {
		st = line_add(x, e->t[0], &e->t[0]);
		if (st == ST_OK)
			st = e->uv ? line_add(x, e->t[1], &e->t[1])
			           : cut_pole(x, e->t[0], e->t[1], 0);
		return st;
	}
	const size_t n = (size_t)x->n_members;
	x->ways = malloc((DEPTH_MAX + 1) * n * sizeof *x->ways);
	x->ends = malloc((2 + BENDS_DEPTH_MAX) * n * sizeof *x->ends);
	st = x->ways && x->ends ? find_bends(x) : ST_RESOURCE;
	for (size_t k = 0; k < n && st == ST_OK; k++) {
		const struct mesh_edge *m = &x->b->edges[x->members[k]];
		x->ends[k] = m->t[m->reversed];
		x->ends[n + k] = m->t[!m->reversed];
	}
	if (st == ST_OK)
		st = line_add(x, e->t[0], x->ends);
	if (st == ST_OK)
		st = cut_bends(x, e->t, 0, x->n_bends, x->ends, x->ends + n, 2);
	for (size_t k = 0; k < n; k++) {
		struct mesh_edge *m = &x->b->edges[x->members[k]];
		if (m->reversed)
			turn_nodes(m);
	}
	free(x->ways);
	free(x->ends);
	free(x->bends);
	return st;
}

enum status mesh_cut(struct mesh_build *b)
{
	enum status st = ST_OK;
	for (int k = 0; k < b->n_edges && st == ST_OK; k++) {
		const int n = b->groups[k + 1] - b->groups[k];
		struct line x = { .b = b,
			          .master = &b->edges[k],
			          .members = b->members + b->groups[k],
			          .n_members = n };
		st = mesh_step(b, MESH_CUT, k, b->n_edges);
		if (st == ST_OK && n)
			st = cut_line(&x);
	}
	return st;
}

static enum status node_insert(struct mesh_build *b, struct mesh_edge *e, int piece, double t,
                               int point)
{
	enum status st =
	        mesh_grow((void **)&e->nodes, &e->nodes_room, e->n_nodes + 1, sizeof *e->nodes);
	if (st != ST_OK)
		return st;
	struct mesh_node *node = &e->nodes[piece + 1];
	memmove(node + 1, node, (size_t)(e->n_nodes - piece - 1) * sizeof *node);
	e->n_nodes++;
	*node = (struct mesh_node){ .t = t, .point = point };
	mesh_edge_uv(b, e, t, node->uv);
	return ST_OK;
}

enum status mesh_cut_more(struct mesh_build *b, int edge, int piece, double t)
{
	const struct mesh_edge *e = &b->edges[edge];
	const struct mesh_edge *m = &b->edges[e->master];
	const int across = m->n_nodes - 2 - piece, at = e->reversed ? across : piece;
	const double lo = e->nodes[piece].t, hi = e->nodes[piece + 1].t;
	double tm = isnan(t) ? 0.5 * (lo + hi) : t;
	int point;
	if (!(hi > lo && lo < tm && tm < hi))
		return ST_OK;
	const double own = tm;
	if (e != m)
		mesh_edge_nearest(b, m, mesh_edge_point(b, e, own), m->nodes[at].t,
		                  m->nodes[at + 1].t, &tm);
	const struct vec3 p = mesh_edge_point(b, m, tm);
	enum status st = m->degenerate ? vertex_point(b, m->vertex[0], &point)
	                               : mesh_add_point(b, p, &point);
	for (int i = b->groups[e->master]; i < b->groups[e->master + 1] && st == ST_OK; i++) {
		struct mesh_edge *x = &b->edges[b->members[i]];
		const int k = x->reversed ? m->n_nodes - 2 - at : at;
		const double from = x->nodes[k].t, to = x->nodes[k + 1].t;
		double tx = own;
		if (x != e) {
			mesh_edge_nearest(b, x, p, from, to, &tx);
			tx = fmin(fmax(tx, from + 0.05 * (to - from)), to - 0.05 * (to - from));
		}
		if (x != m)
			st = node_insert(b, x, k, tx, point);
		else
			tm = tx;
	}
	return st == ST_OK ? node_insert(b, &b->edges[e->master], at, tm, point) : st;
}
