/* mesh_cut.c - edges cut into pieces that are straight enough. */
#include <stdlib.h>
#include <string.h>

#include "mesh_private.h"

enum { DEPTH_MAX = 24, POLE_DEPTH_MAX = 7 };

/* Of its length: an edge that strays less is straight. */
static const double straight_within = 1e-9;

/* Largest turn between neighbouring rays from a pole. Radians. */
static const double pole_turn = 0.5;

/* One line in space being cut: the edge that gives the points, and all that share them. */
struct line {
	struct mesh_build *b;
	const struct mesh_edge *master;
	const int *members;
	int n_members;
	double *t; /* owned; rising */
	int n, room;
};

static enum status line_add(struct line *x, double t)
{
	enum status st = mesh_grow((void **)&x->t, &x->room, x->n + 1, sizeof *x->t);
	if (st == ST_OK)
		x->t[x->n++] = t;
	return st;
}

static double from_chord(struct vec3 p, struct vec3 a, struct vec3 b)
{
	const struct vec3 d = vec3_sub(b, a), w = vec3_sub(p, a);
	const double dd = vec3_dot(d, d);
	const double f = dd > 0 ? fmin(fmax(vec3_dot(w, d) / dd, 0), 1) : 0;
	return vec3_length(vec3_along(w, -f, d));
}

static double angle_between(struct vec3 a, struct vec3 b)
{
	return atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b));
}

/* How far the piece strays from its chord. */
static double stray(const struct line *x, double from, double to, struct vec3 a, struct vec3 b)
{
	double worst = 0;
	const struct mesh_edge *e = x->master;
	for (int i = 0; i < e->n_samples; i++)
		if (e->samples[i].t > from && e->samples[i].t < to)
			worst = fmax(worst, from_chord(e->samples[i].p, a, b));
	for (int i = 1; i < 4; i++)
		worst = fmax(worst, from_chord(mesh_edge_point(x->b, e, from + (to - from) * i / 4),
		                               a, b));
	return worst;
}

/* The normals of some face turn too far between points of the line; p[1] is in the middle. */
static bool turns(const struct line *x, const struct vec3 p[3])
{
	const double limit = x->b->limits->angle;
	for (int k = 0; k < x->n_members; k++) {
		const struct mesh_edge *e = &x->b->edges[x->members[k]];
		const struct mesh_creases *c = &x->b->creases[e->face];
		double uv[3][2];
		struct vec3 n[3];
		for (int i = 0; i < 3; i++) {
			double t;
			mesh_edge_nearest(x->b, e, p[i], &t);
			mesh_edge_uv(x->b, e, t, uv[i]);
		}
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

/* Put the parameters between from and to, and `to` itself, on the list. */
static enum status cut_between(struct line *x, double from, double to, int depth, int least)
{
	const struct tessellate_limits *l = x->b->limits;
	const double middle = 0.5 * (from + to);
	const struct vec3 p[3] = { mesh_edge_point(x->b, x->master, from),
		                   mesh_edge_point(x->b, x->master, middle),
		                   mesh_edge_point(x->b, x->master, to) };
	const double far = stray(x, from, to, p[0], p[2]);
	const double length = vec3_length(vec3_sub(p[1], p[0])) + vec3_length(vec3_sub(p[2], p[1]));
	bool split =
	        depth < least || far > l->chord || (depth == 0 && far > straight_within * length);
	if (!split && length > l->chord)
		split = angle_between(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[1])) > l->angle ||
		        turns(x, p);
	if (!split || depth >= DEPTH_MAX || middle <= from || middle >= to)
		return line_add(x, to);
	enum status st = cut_between(x, from, middle, depth + 1, least);
	return st == ST_OK ? cut_between(x, middle, to, depth + 1, least) : st;
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
		return line_add(x, to);
	enum status st = cut_pole(x, from, middle, depth + 1);
	return st == ST_OK ? cut_pole(x, middle, to, depth + 1) : st;
}

static enum status cut_line(struct line *x)
{
	const struct mesh_edge *e = x->master;
	enum status st = line_add(x, e->t[0]);
	if (e->degenerate)
		return st != ST_OK ? st
		       : e->uv     ? line_add(x, e->t[1])
		                   : cut_pole(x, e->t[0], e->t[1], 0);
	const int least = e->vertex[0] == e->vertex[1] ? 2 : 0;
	double from = e->t[0];
	for (int i = 1; e->uv && i < e->uv->n && st == ST_OK; i++) {
		const double t = e->uv->knots[i];
		if (t > from && t < e->t[1] && t == e->uv->knots[i + e->uv->order - 2]) {
			st = cut_between(x, from, t, 0, least);
			from = t;
		}
	}
	return st == ST_OK ? cut_between(x, from, e->t[1], 0, least) : st;
}

static enum status vertex_point(struct mesh_build *b, int vertex, int *point)
{
	struct mesh_vertex *v = &b->vertices[vertex];
	enum status st = v->point < 0 ? mesh_add_point(b, v->p, &v->point) : ST_OK;
	*point = v->point;
	return st;
}

/* Nodes of the master itself. */
static enum status set_nodes(struct line *x, struct mesh_edge *e)
{
	struct mesh_build *b = x->b;
	enum status st = ST_OK;
	e->nodes = malloc((size_t)x->n * sizeof *e->nodes);
	if (!e->nodes)
		return ST_RESOURCE;
	e->n_nodes = x->n;
	for (int i = 0; i < x->n && st == ST_OK; i++) {
		struct mesh_node *node = &e->nodes[i];
		mesh_edge_uv(b, e, x->t[i], node->uv);
		if (i == 0 || i == x->n - 1 || e->degenerate)
			st = vertex_point(b, e->vertex[i > 0], &node->point);
		else
			st = mesh_add_point(b, mesh_edge_point(b, e, x->t[i]), &node->point);
	}
	return st;
}

/* Nodes of an edge that shares the master's points. False: they are not in order on it. */
static enum status follow(struct mesh_build *b, struct mesh_edge *e, const struct mesh_edge *m,
                          bool *good)
{
	double last = e->t[0];
	*good = true;
	e->nodes = malloc((size_t)m->n_nodes * sizeof *e->nodes);
	if (!e->nodes)
		return ST_RESOURCE;
	e->n_nodes = m->n_nodes;
	for (int i = 0; i < e->n_nodes && *good; i++) {
		const int from = e->reversed ? m->n_nodes - 1 - i : i;
		struct mesh_node *node = &e->nodes[i];
		double t = i == 0 ? e->t[0] : e->t[1];
		node->point = m->nodes[from].point;
		if (i > 0 && i < e->n_nodes - 1)
			mesh_edge_nearest(b, e, b->out->points[node->point], &t);
		*good = i == 0 || t > last;
		last = t;
		mesh_edge_uv(b, e, t, node->uv);
	}
	if (!*good) {
		free(e->nodes);
		e->nodes = NULL;
	}
	return ST_OK;
}

static enum status cut_alone(struct mesh_build *b, int k, const int *members, int n)
{
	struct line x = { .b = b, .master = &b->edges[k], .members = members, .n_members = n };
	enum status st = cut_line(&x);
	if (st == ST_OK)
		st = set_nodes(&x, &b->edges[k]);
	free(x.t);
	return st;
}

static enum status cut_group(struct mesh_build *b, int k, const int *members, int n)
{
	enum status st = cut_alone(b, k, members, n);
	for (int i = 0; i < n && st == ST_OK; i++) {
		struct mesh_edge *e = &b->edges[members[i]];
		bool good = true;
		if (members[i] == k)
			continue;
		st = follow(b, e, &b->edges[k], &good);
		if (st == ST_OK && !good) {
			e->master = members[i];
			st = cut_alone(b, members[i], &members[i], 1);
		}
	}
	return st;
}

enum status mesh_cut(struct mesh_build *b)
{
	/* members of each group, one group behind the other */
	int *count = calloc((size_t)b->n_edges + 1, sizeof *count);
	int *members = malloc((size_t)b->n_edges * sizeof *members);
	enum status st = count && members ? ST_OK : ST_RESOURCE;
	for (int k = 0; k < b->n_edges && st == ST_OK; k++)
		count[b->edges[k].master + 1]++;
	for (int k = 0; k < b->n_edges && st == ST_OK; k++)
		count[k + 1] += count[k];
	for (int k = b->n_edges - 1; k >= 0 && st == ST_OK; k--)
		members[--count[b->edges[k].master + 1]] = k;
	/* count[k + 1] is now where the group of k begins */
	for (int k = 0; k < b->n_edges && st == ST_OK; k++) {
		const int at = count[k + 1];
		const int end = k + 1 < b->n_edges ? count[k + 2] : b->n_edges;
		if (b->stop && atomic_load_explicit(b->stop, memory_order_relaxed))
			st = ST_CANCELLED;
		else if (end > at)
			st = cut_group(b, k, members + at, end - at);
	}
	free(count);
	free(members);
	return st;
}
