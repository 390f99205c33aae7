/* mesh_net_fix.c - edges that must be there. Source: Sloan (1993). */
#include <stdlib.h>

#include "mesh_net_private.h"

/* Mark the edge across from corner i of t on both sides. */
static void mark(struct net *x, int t, int i, unsigned char flags)
{
	const int o = x->triangles[t].next[i];
	unsigned char *e = &x->triangles[t].edge[i];
	*e = (unsigned char)((*e | (flags & NET_FIXED)) ^ (flags & NET_BORDER));
	if (o >= 0)
		x->triangles[o].edge[net_place_of(&x->triangles[o], t)] = *e;
}

/* The edge from p to q as a triangle and a place in it; p is none of the frame's. False: none. */
static bool find_edge(const struct net *x, int p, int q, int *triangle, int *place)
{
	const int first = x->of[p];
	int t = first;
	do {
		const struct net_triangle *a = &x->triangles[t];
		const int i = net_corner_of(a, p);
		if (a->v[net_turn_of[i]] == q) {
			*triangle = t;
			*place = net_back_of[i];
			return true;
		}
		t = a->next[net_turn_of[i]];
	} while (t >= 0 && t != first);
	return false;
}

bool net_is_fixed(const struct net *x, int a, int b)
{
	int t, i;
	return find_edge(x, a, b, &t, &i) && x->triangles[t].edge[i] & NET_FIXED;
}

/* The triangle at a into which the way to b leads, and a's place in it. Where a vertex of it lies on
 * the way, *on is that vertex, else -1. False: none, the points are one. */
static bool find_way(const struct net *x, int a, int b, int *triangle, int *place, int *on)
{
	const int32_t *o = x->at[a], *to = x->at[b];
	const int first = x->of[a];
	int t = first;
	do {
		const struct net_triangle *p = &x->triangles[t];
		const int i = net_corner_of(p, a), right = p->v[net_turn_of[i]],
		          left = p->v[net_back_of[i]];
		const int64_t s = net_side(x, a, right, b);
		const int64_t ahead = (int64_t)(x->at[right][0] - o[0]) * (to[0] - o[0]) +
		                      (int64_t)(x->at[right][1] - o[1]) * (to[1] - o[1]);
		*triangle = t;
		*place = i;
		*on = s == 0 && ahead > 0 ? right : -1;
		if (*on >= 0 || (s > 0 && net_side(x, a, left, b) < 0))
			return true;
		t = p->next[net_turn_of[i]];
	} while (t >= 0 && t != first);
	return false;
}

/* Pairs of vertices: edges that are still to be turned. */
struct edge_queue {
	int *pairs; /* owned */
	int head, n, room;
};

static enum status enqueue(struct edge_queue *q, int a, int b)
{
	enum status st = net_grow((void **)&q->pairs, &q->room, 2 * q->n + 2, sizeof *q->pairs);
	if (st == ST_OK) {
		q->pairs[2 * q->n] = a;
		q->pairs[2 * q->n + 1] = b;
		q->n++;
	}
	return st;
}

/* List the edges crossed on the way from a, which is corner i of t, towards b; *end is the vertex on
 * it that is met first; where one is fixed, `crossed` has its vertices. */
static enum status list_crossed(const struct net *x, int a, int b, int t, int i,
                                struct edge_queue *q, int *end, int crossed[2])
{
	for (;;) {
		const struct net_triangle *p = &x->triangles[t];
		const int right = p->v[net_turn_of[i]], left = p->v[net_back_of[i]], o = p->next[i];
		if (p->edge[i] & NET_FIXED) {
			crossed[0] = right;
			crossed[1] = left;
			return ST_INPUT;
		}
		enum status st = right < 4 ? enqueue(q, left, right) : enqueue(q, right, left);
		if (st != ST_OK)
			return st;
		const struct net_triangle *far = &x->triangles[o];
		const int apex = far->v[net_place_of(far, t)];
		const int64_t s = net_side(x, a, b, apex);
		*end = apex;
		if (s == 0)
			return ST_OK;
		t = o;
		i = net_corner_of(far, s > 0 ? left : right);
	}
}

static bool crosses(const struct net *x, int a, int b, int p, int q)
{
	if (p == a || p == b || q == a || q == b)
		return false;
	const int64_t s = net_side(x, a, b, p), r = net_side(x, a, b, q);
	return (s > 0 && r < 0) || (s < 0 && r > 0);
}

int net_beyond(const struct net *x, int t, int i)
{
	const struct net_triangle *a = &x->triangles[t];
	if (a->edge[i] & NET_FIXED || a->next[i] < 0)
		return -1;
	const struct net_triangle *b = &x->triangles[a->next[i]];
	const int apex = b->v[net_place_of(b, t)];
	return crosses(x, a->v[i], apex, a->v[net_turn_of[i]], a->v[net_back_of[i]]) ? apex : -1;
}

void net_turn(struct net *x, int t, int i)
{
	net_flip(x, t, i);
}

/* Turn the listed edges until a b is one. Those that do not cross any more go to `fresh`. */
static enum status turn_crossed(struct net *x, int a, int b, struct edge_queue *q,
                                struct edge_queue *fresh)
{
	const int64_t limit = 64 + 4 * (int64_t)q->n * q->n;
	enum status st = ST_OK;
	for (int64_t step = 0; q->head < q->n && st == ST_OK; step++) {
		const int p = q->pairs[2 * q->head], r = q->pairs[2 * q->head + 1];
		int t, i;
		q->head++;
		if (step > limit || !find_edge(x, p, r, &t, &i))
			return ST_INPUT;
		const struct net_triangle *one = &x->triangles[t];
		const struct net_triangle *two = &x->triangles[one->next[i]];
		const int u = one->v[i], w = two->v[net_place_of(two, t)];
		if (!crosses(x, u, w, p, r)) {
			st = enqueue(q, p, r); /* not convex yet */
			continue;
		}
		net_flip(x, t, i);
		const bool still = crosses(x, a, b, u, w);
		st = u < 4 ? enqueue(still ? q : fresh, w, u) : enqueue(still ? q : fresh, u, w);
	}
	return st;
}

/* Edges that were made on the way become Delaunay where they can. */
static void mend_fresh(struct net *x, const struct edge_queue *fresh)
{
	for (int k = 0; k < fresh->n; k++) {
		int t, i;
		if (!find_edge(x, fresh->pairs[2 * k], fresh->pairs[2 * k + 1], &t, &i))
			continue;
		const struct net_triangle *a = &x->triangles[t];
		if (a->edge[i] & NET_FIXED || a->next[i] < 0)
			continue;
		const struct net_triangle *b = &x->triangles[a->next[i]];
		if (net_in_circle(x, a->v, b->v[net_place_of(b, t)]))
			net_flip(x, t, i);
	}
}

enum status net_fix_first(struct net *x, int a, int *to, unsigned char flags, int crossed[2])
{
	struct edge_queue across = { 0 }, fresh = { 0 };
	enum status st = ST_OK;
	int t, i, end;
	crossed[0] = crossed[1] = -1;
	if (!find_way(x, a, *to, &t, &i, &end))
		return ST_INPUT;
	if (end < 0) {
		st = list_crossed(x, a, *to, t, i, &across, &end, crossed);
		if (st == ST_OK)
			st = turn_crossed(x, a, end, &across, &fresh);
	}
	if (st == ST_OK) {
		if (find_edge(x, a, end, &t, &i))
			mark(x, t, i, flags);
		else
			st = ST_INPUT;
		mend_fresh(x, &fresh);
	}
	free(across.pairs);
	free(fresh.pairs);
	*to = end;
	return st;
}

enum status net_fix(struct net *x, int a, int b, unsigned char flags)
{
	enum status st = ST_OK;
	int crossed[2];
	while (a != b && st == ST_OK) {
		int end = b;
		st = net_fix_first(x, a, &end, flags, crossed);
		a = end;
	}
	return st;
}

int net_inside_left(const struct net *x, int a, int b)
{
	int t, i;
	return find_edge(x, a, b, &t, &i) ? x->triangles[t].inside : -1;
}
