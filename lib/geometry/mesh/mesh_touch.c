/* mesh_touch.c - where edges that are not joined yet run along each other. */
#include <stdlib.h>

#include "mesh_tree.h"

/* An end of edge `from` lies on edge `on`, at t. */
struct contact {
	int from, end, on;
	double t;
};

/* A place on an edge where another one begins or ends; a vertex, and its point on the edge. */
struct stop {
	double t;
	int vertex;
	struct vec3 p;
};

/* Edge `edge` is to be parted at t. */
struct cut {
	int edge, vertex;
	double t;
};

struct touch {
	struct mesh_build *b;
	double level;
	bool *joined; /* owned; of each stop of the first edge: the piece behind it is joined */
	int joined_room;
	struct contact *contacts; /* owned */
	int n_contacts, contacts_room;
	struct stop *stops[2]; /* owned; of the two edges at hand */
	int n_stops[2], stops_room[2];
	struct cut *cuts; /* owned */
	int n_cuts, cuts_room;
};

static double apart(struct vec3 a, struct vec3 b)
{
	return vec3_length(vec3_sub(a, b));
}

static enum status add_contact(struct touch *x, int from, int end, int on, double t)
{
	enum status st = mesh_grow((void **)&x->contacts, &x->contacts_room, x->n_contacts + 1,
	                           sizeof *x->contacts);
	if (st == ST_OK)
		x->contacts[x->n_contacts++] = (struct contact){ from, end, on, t };
	return st;
}

/* All edges that an end lies on. */
static enum status find_contacts(struct touch *x, const struct mesh_tree *tree, int edge, int end,
                                 int **found, int *room)
{
	struct mesh_build *b = x->b;
	const struct vec3 p = mesh_edge_point(b, &b->edges[edge], b->edges[edge].t[end]);
	int n;
	enum status st = mesh_tree_near(tree, p, x->level, found, room, &n);
	for (int i = 0, k; i < n && st == ST_OK; i = k) {
		const struct mesh_piece *piece = &tree->pieces[(*found)[i]];
		const struct mesh_edge *e = &b->edges[piece->edge];
		int last = piece->last;
		double t;
		for (k = i + 1; k < n; k++) {
			const struct mesh_piece *more = &tree->pieces[(*found)[k]];
			if (more->edge != piece->edge || more->first != last)
				break;
			last = more->last;
		}
		if (piece->edge != edge && mesh_edge_nearest(b, e, p, e->samples[piece->first].t,
		                                             e->samples[last].t, &t) <= x->level)
			st = add_contact(x, edge, end, piece->edge, t);
	}
	return st;
}

static int low_of(const struct contact *c)
{
	return c->from < c->on ? c->from : c->on;
}

static int high_of(const struct contact *c)
{
	return c->from < c->on ? c->on : c->from;
}

static int by_pair(const void *a, const void *b)
{
	const struct contact *p = a, *q = b;
	if (low_of(p) != low_of(q))
		return low_of(p) < low_of(q) ? -1 : 1;
	if (high_of(p) != high_of(q))
		return high_of(p) < high_of(q) ? -1 : 1;
	if (p->from != q->from)
		return p->from < q->from ? -1 : 1;
	if (p->end != q->end)
		return p->end - q->end;
	return (p->t > q->t) - (p->t < q->t);
}

static int by_parameter(const void *a, const void *b)
{
	const struct stop *p = a, *q = b;
	if (p->t != q->t)
		return p->t < q->t ? -1 : 1;
	return p->vertex - q->vertex;
}

/* A stop on edge e; so near to one of its ends it is that end. */
static enum status add_stop(struct touch *x, int which, int edge, double t, int vertex)
{
	const struct mesh_edge *e = &x->b->edges[edge];
	struct stop s = { t, vertex, mesh_edge_point(x->b, e, t) };
	double least = x->level;
	for (int k = 0; k < 2; k++) {
		const struct vec3 p = mesh_edge_point(x->b, e, e->t[k]);
		if (t == e->t[k] || apart(s.p, p) < least || (apart(s.p, p) <= least && !k)) {
			least = apart(s.p, p);
			s = (struct stop){ e->t[k], e->vertex[k], p };
		}
	}
	enum status st = mesh_grow((void **)&x->stops[which], &x->stops_room[which],
	                           x->n_stops[which] + 1, sizeof *x->stops[which]);
	if (st == ST_OK)
		x->stops[which][x->n_stops[which]++] = s;
	return st;
}

/* The stops of both edges from their contacts, in order, each once. */
static enum status find_stops(struct touch *x, const int edge[2], const struct contact *c, int n)
{
	enum status st = ST_OK;
	x->n_stops[0] = x->n_stops[1] = 0;
	for (int i = 0; i < n && st == ST_OK; i++) {
		const struct mesh_edge *from = &x->b->edges[c[i].from];
		const int which = c[i].from == edge[1];
		st = add_stop(x, which, edge[which], from->t[c[i].end], from->vertex[c[i].end]);
		if (st == ST_OK)
			st = add_stop(x, !which, edge[!which], c[i].t, from->vertex[c[i].end]);
	}
	for (int k = 0; k < 2 && st == ST_OK; k++) {
		struct stop *s = x->stops[k];
		int m = 0;
		qsort(s, (size_t)x->n_stops[k], sizeof *s, by_parameter);
		for (int i = 0; i < x->n_stops[k]; i++)
			if (!m || s[i].t > s[m - 1].t)
				s[m++] = s[i];
		x->n_stops[k] = m;
	}
	return st;
}

bool mesh_runs_along(const struct mesh_build *b, const struct mesh_edge *e, const double et[2],
                     const struct mesh_edge *m, const double mt[2], double level, bool *reversed)
{
	double first = 0, t;
	for (int i = 1; i < 4; i++) {
		const double f = 0.25 * i;
		const struct vec3 p = mesh_edge_point(b, e, et[0] + f * (et[1] - et[0]));
		const struct vec3 q = mesh_edge_point(b, m, mt[0] + f * (mt[1] - mt[0]));
		/* and back: one may be longer than the other */
		if (mesh_edge_nearest(b, e, q, et[0], et[1], &t) > 2 * level ||
		    mesh_edge_nearest(b, m, p, mt[0], mt[1], &t) > 2 * level)
			return false;
		if (i == 1)
			first = t;
	}
	*reversed = first > t;
	const double le = mesh_edge_length(b, e, et[0], et[1]);
	const double lm = mesh_edge_length(b, m, mt[0], mt[1]);
	return fabs(le - lm) <= 0.5 * fmin(le, lm) + 4 * level;
}

static enum status add_cut(struct touch *x, int edge, const struct stop *s)
{
	const struct mesh_edge *e = &x->b->edges[edge];
	if (s->t == e->t[0] || s->t == e->t[1])
		return ST_OK;
	enum status st =
	        mesh_grow((void **)&x->cuts, &x->cuts_room, x->n_cuts + 1, sizeof *x->cuts);
	if (st == ST_OK)
		x->cuts[x->n_cuts++] = (struct cut){ edge, s->vertex, s->t };
	return st;
}

/* What ends of pieces that run along each other have in common. */
static enum status unite(struct touch *x, const int edge[2], const struct stop *s,
                         const struct stop *r)
{
	mesh_vertex_unite(x->b, s->vertex, r->vertex);
	enum status st = add_cut(x, edge[0], s);
	return st == ST_OK ? add_cut(x, edge[1], r) : st;
}

/* Where two edges run along each other between stops both are parted there. */
static enum status join_pair(struct touch *x, const int edge[2])
{
	struct mesh_build *b = x->b;
	const struct mesh_edge *e = &b->edges[edge[0]], *f = &b->edges[edge[1]];
	const struct stop *s = x->stops[0], *r = x->stops[1];
	enum status st =
	        mesh_grow((void **)&x->joined, &x->joined_room, x->n_stops[0], sizeof *x->joined);
	for (int i = 0; i < x->n_stops[0] && st == ST_OK; i++)
		x->joined[i] = false;
	for (int i = 0; i + 1 < x->n_stops[0] && x->n_stops[1] > 1 && st == ST_OK; i++) {
		const double et[2] = { s[i].t, s[i + 1].t };
		double middle;
		bool reversed;
		int k = 0;
		if (mesh_edge_nearest(b, f, mesh_edge_point(b, e, 0.5 * (et[0] + et[1])), r[0].t,
		                      r[x->n_stops[1] - 1].t, &middle) > 2 * x->level)
			continue;
		while (k + 2 < x->n_stops[1] && r[k + 1].t < middle)
			k++;
		const double ft[2] = { r[k].t, r[k + 1].t };
		if (mesh_edge_length(b, e, et[0], et[1]) <= 2 * x->level ||
		    mesh_edge_length(b, f, ft[0], ft[1]) <= 2 * x->level ||
		    !mesh_runs_along(b, e, et, f, ft, x->level, &reversed))
			continue;
		const struct stop *end[2] = { &r[reversed ? k + 1 : k], &r[reversed ? k : k + 1] };
		if (apart(s[i].p, end[0]->p) > 2 * x->level ||
		    apart(s[i + 1].p, end[1]->p) > 2 * x->level)
			continue;
		x->joined[i] = true;
		st = unite(x, edge, &s[i], end[0]);
		if (st == ST_OK)
			st = unite(x, edge, &s[i + 1], end[1]);
	}
	return st;
}

/* How far from t towards `to` edge e keeps within the level of f. */
static double keeps_to(const struct touch *x, const struct mesh_edge *e, const struct mesh_edge *f,
                       double t, double to)
{
	enum { STEPS = 32, HALVES = 30 };
	double good = t, bad = to, at;
	int k = 1;
	for (; k <= STEPS; k++) {
		const double next = t + (to - t) * k / STEPS;
		if (mesh_edge_nearest(x->b, f, mesh_edge_point(x->b, e, next), f->t[0], f->t[1],
		                      &at) > x->level) {
			bad = next;
			break;
		}
		good = next;
	}
	for (int i = 0; i < HALVES && k <= STEPS; i++) {
		const double next = 0.5 * (good + bad);
		if (mesh_edge_nearest(x->b, f, mesh_edge_point(x->b, e, next), f->t[0], f->t[1],
		                      &at) > x->level)
			bad = next;
		else
			good = next;
	}
	return good;
}

/* From stop i of the first edge, forward or back, as far as the two keep together. */
static enum status leave_from(struct touch *x, const int edge[2], int i, bool forward)
{
	enum { LEAST = 10 }; /* levels: shorter ones only meet */
	struct mesh_build *b = x->b;
	const struct mesh_edge *e = &b->edges[edge[0]], *f = &b->edges[edge[1]];
	const struct stop *s = &x->stops[0][i], *mate = NULL;
	const double to =
	        forward ? i + 1 < x->n_stops[0] ? s[1].t : e->t[1] : (i > 0 ? s[-1].t : e->t[0]);
	double least = 2 * x->level, tf;
	bool reversed;
	for (int k = 0; k < x->n_stops[1]; k++)
		if (apart(x->stops[1][k].p, s->p) <= least) {
			mate = &x->stops[1][k];
			least = apart(mate->p, s->p);
		}
	if (!mate || to == s->t)
		return ST_OK;
	struct stop fresh = { .t = keeps_to(x, e, f, s->t, to) };
	fresh.p = mesh_edge_point(b, e, fresh.t);
	mesh_edge_nearest(b, f, fresh.p, f->t[0], f->t[1], &tf);
	const double et[2] = { fmin(s->t, fresh.t), fmax(s->t, fresh.t) };
	const double ft[2] = { fmin(mate->t, tf), fmax(mate->t, tf) };
	if (fresh.t == to || mesh_edge_length(b, e, et[0], et[1]) <= LEAST * x->level ||
	    mesh_edge_length(b, f, ft[0], ft[1]) <= LEAST * x->level ||
	    !mesh_runs_along(b, e, et, f, ft, x->level, &reversed))
		return ST_OK;
	enum status st = mesh_add_vertex(b, fresh.p, &fresh.vertex);
	struct stop other = fresh;
	other.t = tf;
	if (st == ST_OK)
		st = unite(x, edge, s, mate);
	return st == ST_OK ? unite(x, edge, &fresh, &other) : st;
}

static enum status leave_pair(struct touch *x, const int edge[2])
{
	enum status st = ST_OK;
	for (int i = 0; i < x->n_stops[0] && st == ST_OK; i++) {
		if (!x->joined[i])
			st = leave_from(x, edge, i, true);
		if (st == ST_OK && (i == 0 || !x->joined[i - 1]))
			st = leave_from(x, edge, i, false);
	}
	return st;
}

static int by_edge(const void *a, const void *b)
{
	const struct cut *p = a, *q = b;
	if (p->edge != q->edge)
		return p->edge < q->edge ? -1 : 1;
	if (p->t != q->t)
		return p->t < q->t ? -1 : 1;
	return p->vertex - q->vertex;
}

/* Part the edges; stops that are the same vertex, or hardly apart, are one. */
static enum status part_all(struct touch *x)
{
	struct mesh_build *b = x->b;
	double *t = malloc(((size_t)x->n_cuts + 1) * sizeof *t);
	int *vertex = malloc(((size_t)x->n_cuts + 1) * sizeof *vertex);
	enum status st = t && vertex ? ST_OK : ST_RESOURCE;
	if (x->n_cuts)
		qsort(x->cuts, (size_t)x->n_cuts, sizeof *x->cuts, by_edge);
	for (int i = 0, k; i < x->n_cuts && st == ST_OK; i = k) {
		const int edge = x->cuts[i].edge;
		const struct mesh_edge *e = &b->edges[edge];
		const double near = 1e-9 * (e->t[1] - e->t[0]);
		int m = 0;
		for (k = i; k < x->n_cuts && x->cuts[k].edge == edge; k++) {
			const struct cut *c = &x->cuts[k];
			const int root = mesh_vertex_root(b, c->vertex);
			if (m && (c->t - t[m - 1] <= near ||
			          root == mesh_vertex_root(b, vertex[m - 1]))) {
				mesh_vertex_unite(b, vertex[m - 1], c->vertex);
				continue;
			}
			if (c->t - e->t[0] <= near || e->t[1] - c->t <= near) {
				mesh_vertex_unite(b, e->vertex[c->t - e->t[0] > near], c->vertex);
				continue;
			}
			t[m] = c->t;
			vertex[m++] = c->vertex;
		}
		if (m)
			st = mesh_edge_part(b, edge, t, vertex, m);
	}
	free(t);
	free(vertex);
	return st;
}

enum status mesh_touch(struct mesh_build *b, double level, bool leave)
{
	struct touch x = { .b = b, .level = level };
	struct mesh_tree tree;
	int *found = NULL, room = 0;
	enum status st = mesh_tree_init(&tree, b);
	if (st != ST_OK)
		return st;
	for (int k = 0; k < b->n_edges && st == ST_OK; k++) {
		st = mesh_step(b, MESH_JOIN, k % 64 ? 1 : 64 * b->round, 64 * MESH_ROUNDS);
		for (int end = 0; end < 2 && st == ST_OK; end++)
			if (!b->edges[k].joined && !b->edges[k].degenerate)
				st = find_contacts(&x, &tree, k, end, &found, &room);
	}
	mesh_tree_finish(&tree);
	free(found);
	if (x.n_contacts)
		qsort(x.contacts, (size_t)x.n_contacts, sizeof *x.contacts, by_pair);
	for (int i = 0, k; i < x.n_contacts && st == ST_OK; i = k) {
		const int edge[2] = { low_of(&x.contacts[i]), high_of(&x.contacts[i]) };
		for (k = i + 1; k < x.n_contacts && low_of(&x.contacts[k]) == edge[0] &&
		                high_of(&x.contacts[k]) == edge[1];
		     k++)
			;
		st = find_stops(&x, edge, &x.contacts[i], k - i);
		if (st == ST_OK)
			st = join_pair(&x, edge);
		if (st == ST_OK && leave)
			st = leave_pair(&x, edge);
	}
	if (st == ST_OK)
		st = part_all(&x);
	free(x.contacts);
	free(x.stops[0]);
	free(x.stops[1]);
	free(x.cuts);
	free(x.joined);
	return st;
}
