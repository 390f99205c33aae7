/* mesh_net.c - a constrained Delaunay triangulation of points with whole coordinates. */
#include "mesh_net.h"

#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 wide;

static const int turn[3] = { 1, 2, 0 }, back[3] = { 2, 0, 1 };

/* Twice the area of a b p: > 0 where p is left of a b. */
static int64_t side(const struct net *x, int a, int b, int32_t px, int32_t py)
{
	const int32_t *p = x->at[a], *q = x->at[b];
	return (int64_t)(q[0] - p[0]) * (py - p[1]) - (int64_t)(q[1] - p[1]) * (px - p[0]);
}

static int64_t side_of(const struct net *x, int a, int b, int c)
{
	return side(x, a, b, x->at[c][0], x->at[c][1]);
}

/* d lies inside the circle through a b c, counterclockwise. */
static bool in_circle(const struct net *x, const int v[3], int d)
{
	int64_t dx[3], dy[3];
	for (int i = 0; i < 3; i++) {
		dx[i] = (int64_t)x->at[v[i]][0] - x->at[d][0];
		dy[i] = (int64_t)x->at[v[i]][1] - x->at[d][1];
	}
	wide sum = 0;
	for (int i = 0; i < 3; i++) {
		const int j = turn[i], k = back[i];
		const int64_t cross = dx[j] * dy[k] - dx[k] * dy[j];
		sum += (wide)(dx[i] * dx[i] + dy[i] * dy[i]) * cross;
	}
	return sum > 0;
}

static enum status grow(void **p, int *room, int n, size_t size)
{
	if (n <= *room)
		return ST_OK;
	int more = *room > INT32_MAX / 2 ? INT32_MAX : *room * 2 > n ? *room * 2 : n;
	void *q = reallocarray(*p, (size_t)more, size);
	if (!q)
		return ST_RESOURCE;
	*p = q;
	*room = more;
	return ST_OK;
}

/* Room for one more vertex and what comes with it, so that changes cannot fail half way. */
static enum status reserve(struct net *x)
{
	enum status st = grow((void **)&x->at, &x->room, x->n + 1, sizeof *x->at);
	if (st == ST_OK)
		st = grow((void **)&x->of, &x->of_room, x->n + 1, sizeof *x->of);
	if (st == ST_OK)
		st = grow((void **)&x->triangles, &x->triangles_room, x->n_triangles + 2,
		          sizeof *x->triangles);
	return st;
}

static enum status push(struct net *x, int t)
{
	enum status st = grow((void **)&x->stack, &x->stack_room, x->n_stack + 1, sizeof(int));
	if (st == ST_OK)
		x->stack[x->n_stack++] = t;
	return st;
}

enum status net_init(struct net *x)
{
	const int32_t lo = -NET_SIDE, hi = 2 * NET_SIDE;
	const int32_t corner[4][2] = { { lo, lo }, { hi, lo }, { hi, hi }, { lo, hi } };
	*x = (struct net){ 0 };
	enum status st = grow((void **)&x->at, &x->room, 64, sizeof *x->at);
	if (st == ST_OK)
		st = grow((void **)&x->of, &x->of_room, 64, sizeof *x->of);
	if (st == ST_OK)
		st = grow((void **)&x->triangles, &x->triangles_room, 128, sizeof *x->triangles);
	if (st != ST_OK) {
		net_finish(x);
		return st;
	}
	memcpy(x->at, corner, sizeof corner);
	x->n = 4;
	x->triangles[0] = (struct net_triangle){ .v = { 0, 1, 2 }, .next = { -1, 1, -1 } };
	x->triangles[1] = (struct net_triangle){ .v = { 0, 2, 3 }, .next = { -1, -1, 0 } };
	x->n_triangles = 2;
	x->of[0] = x->of[1] = x->of[2] = 0;
	x->of[3] = 1;
	return ST_OK;
}

void net_finish(struct net *x)
{
	free(x->at);
	free(x->of);
	free(x->triangles);
	free(x->stack);
	*x = (struct net){ 0 };
}

static int corner_of(const struct net_triangle *t, int vertex)
{
	return t->v[0] == vertex ? 0 : t->v[1] == vertex ? 1 : t->v[2] == vertex ? 2 : -1;
}

/* The place in t of its neighbour `other`. */
static int place_of(const struct net_triangle *t, int other)
{
	return t->next[0] == other ? 0 : t->next[1] == other ? 1 : 2;
}

static void relink(struct net *x, int t, int from, int to)
{
	if (t >= 0)
		x->triangles[t].next[place_of(&x->triangles[t], from)] = to;
}

/* Tell the vertices of t where it is. */
static void name_corners(struct net *x, int t)
{
	for (int k = 0; k < 3; k++)
		x->of[x->triangles[t].v[k]] = t;
}

/* Turn the edge across from corner i of t: t and its neighbour get the other diagonal. The new edge
 * is across from corner 0 of both. */
static void flip(struct net *x, int t, int i)
{
	struct net_triangle *a = &x->triangles[t];
	const int o = a->next[i];
	struct net_triangle *b = &x->triangles[o];
	const int j = place_of(b, t);
	const struct net_triangle p = *a, q = *b;
	/* p: apex, l, r and the neighbours across; q: apex, r, l */
	const int l = p.v[turn[i]], r = p.v[back[i]];
	*a = (struct net_triangle){
		.v = { l, q.v[j], p.v[i] },
		.next = { o, p.next[back[i]], q.next[turn[j]] },
		.edge = { 0, p.edge[back[i]], q.edge[turn[j]] },
		.inside = p.inside,
	};
	*b = (struct net_triangle){
		.v = { r, p.v[i], q.v[j] },
		.next = { t, q.next[back[j]], p.next[turn[i]] },
		.edge = { 0, q.edge[back[j]], p.edge[turn[i]] },
		.inside = p.inside,
	};
	relink(x, q.next[turn[j]], o, t);
	relink(x, p.next[turn[i]], t, o);
	name_corners(x, t);
	name_corners(x, o);
}

/* Make the edges across from the newest vertex Delaunay; triangles of it are on the stack. */
static enum status legalise(struct net *x, int vertex)
{
	enum status st = ST_OK;
	while (x->n_stack > 0 && st == ST_OK) {
		const int t = x->stack[--x->n_stack];
		const struct net_triangle *a = &x->triangles[t];
		const int i = corner_of(a, vertex), o = i < 0 ? -1 : a->next[i];
		if (o < 0 || a->edge[i] & NET_FIXED)
			continue;
		const struct net_triangle *b = &x->triangles[o];
		const int apex = b->v[place_of(b, t)];
		if (!in_circle(x, a->v, apex))
			continue;
		flip(x, t, i);
		st = push(x, t);
		if (st == ST_OK)
			st = push(x, o);
	}
	x->n_stack = 0;
	return st;
}

static enum status split_inside(struct net *x, int t, int vertex)
{
	const struct net_triangle p = x->triangles[t];
	const int name[3] = { t, x->n_triangles, x->n_triangles + 1 };
	enum status st = ST_OK;
	x->n_triangles += 2;
	/* triangle k keeps the edge across from corner k */
	for (int k = 0; k < 3; k++) {
		x->triangles[name[k]] = (struct net_triangle){
			.v = { vertex, p.v[turn[k]], p.v[back[k]] },
			.next = { p.next[k], name[turn[k]], name[back[k]] },
			.edge = { p.edge[k], 0, 0 },
			.inside = p.inside,
		};
		if (k)
			relink(x, p.next[k], t, name[k]);
		name_corners(x, name[k]);
	}
	for (int k = 0; k < 3 && st == ST_OK; k++)
		st = push(x, name[k]);
	return st == ST_OK ? legalise(x, vertex) : st;
}

/* The vertex lies on the edge across from corner i of t. */
static enum status split_edge(struct net *x, int t, int i, int vertex)
{
	const struct net_triangle p = x->triangles[t];
	const int o = p.next[i], t2 = x->n_triangles, o2 = t2 + 1;
	const struct net_triangle q = x->triangles[o];
	const int j = place_of(&q, t);
	const int apex = p.v[i], l = p.v[turn[i]], r = p.v[back[i]], other = q.v[j];
	const unsigned char e = p.edge[i];
	enum status st = ST_OK;
	x->n_triangles += 2;
	x->triangles[t] = (struct net_triangle){
		.v = { apex, l, vertex },
		.next = { o, t2, p.next[back[i]] },
		.edge = { e, 0, p.edge[back[i]] },
		.inside = p.inside,
	};
	x->triangles[t2] = (struct net_triangle){
		.v = { apex, vertex, r },
		.next = { o2, p.next[turn[i]], t },
		.edge = { e, p.edge[turn[i]], 0 },
		.inside = p.inside,
	};
	x->triangles[o] = (struct net_triangle){
		.v = { other, vertex, l },
		.next = { t, q.next[turn[j]], o2 },
		.edge = { e, q.edge[turn[j]], 0 },
		.inside = q.inside,
	};
	x->triangles[o2] = (struct net_triangle){
		.v = { other, r, vertex },
		.next = { t2, o, q.next[back[j]] },
		.edge = { e, 0, q.edge[back[j]] },
		.inside = q.inside,
	};
	relink(x, p.next[turn[i]], t, t2);
	relink(x, q.next[back[j]], o, o2);
	const int name[4] = { t, t2, o, o2 };
	for (int k = 0; k < 4 && st == ST_OK; k++) {
		name_corners(x, name[k]);
		st = push(x, name[k]);
	}
	return st == ST_OK ? legalise(x, vertex) : st;
}

static int new_vertex(struct net *x, int32_t px, int32_t py)
{
	x->at[x->n][0] = px;
	x->at[x->n][1] = py;
	return x->n++;
}

/* Every triangle, one after the other. */
static int find_slowly(const struct net *x, int32_t px, int32_t py)
{
	for (int t = 0; t < x->n_triangles; t++) {
		const int *v = x->triangles[t].v;
		if (side(x, v[0], v[1], px, py) >= 0 && side(x, v[1], v[2], px, py) >= 0 &&
		    side(x, v[2], v[0], px, py) >= 0)
			return t;
	}
	return 0;
}

int net_find(struct net *x, int32_t px, int32_t py)
{
	int t = x->last;
	/* Walks end in a Delaunay triangulation; fixed edges can send them round: the edge looked
	 * at first changes, and there is a limit. */
	for (unsigned step = 0; step <= 4 * (unsigned)x->n_triangles; step++) {
		const struct net_triangle *a = &x->triangles[t];
		int go = -1;
		for (unsigned k = 0; k < 3 && go < 0; k++) {
			const unsigned i = (k + step) % 3;
			if (side(x, a->v[turn[i]], a->v[back[i]], px, py) < 0)
				go = a->next[i];
		}
		if (go < 0)
			return x->last = t;
		t = go;
	}
	return x->last = find_slowly(x, px, py);
}

/* Add to triangle t, which holds the point; `keep`: leave fixed edges whole. */
static enum status add_to(struct net *x, int t, int32_t px, int32_t py, bool keep, int *vertex)
{
	const struct net_triangle *a = &x->triangles[t];
	int on = -1, zeros = 0;
	*vertex = -1;
	for (int i = 0; i < 3; i++) {
		const int64_t s = side(x, a->v[turn[i]], a->v[back[i]], px, py);
		if (s < 0)
			return ST_OK;
		if (s == 0) {
			zeros++;
			on = i;
		}
	}
	if (zeros > 1) {
		for (int i = 0; i < 3 && !keep; i++)
			if (x->at[a->v[i]][0] == px && x->at[a->v[i]][1] == py)
				*vertex = a->v[i];
		return ST_OK;
	}
	if (zeros && (a->next[on] < 0 || (keep && a->edge[on] & NET_FIXED)))
		return ST_OK;
	enum status st = reserve(x);
	if (st != ST_OK)
		return st;
	*vertex = new_vertex(x, px, py);
	return zeros ? split_edge(x, t, on, *vertex) : split_inside(x, t, *vertex);
}

enum status net_add(struct net *x, int32_t px, int32_t py, int *vertex)
{
	return add_to(x, net_find(x, px, py), px, py, false, vertex);
}

enum status net_add_in(struct net *x, int t, int32_t px, int32_t py, int *vertex)
{
	return add_to(x, t, px, py, true, vertex);
}

/* Mark the edge across from corner i of t on both sides. */
static void mark(struct net *x, int t, int i, unsigned char flags)
{
	const int o = x->triangles[t].next[i];
	unsigned char *e = &x->triangles[t].edge[i];
	*e = (unsigned char)((*e | (flags & NET_FIXED)) ^ (flags & NET_BORDER));
	if (o >= 0)
		x->triangles[o].edge[place_of(&x->triangles[o], t)] = *e;
}

/* The edge from p to q as a triangle and a place in it; p is none of the frame's. False: none. */
static bool find_edge(const struct net *x, int p, int q, int *triangle, int *place)
{
	const int first = x->of[p];
	int t = first;
	do {
		const struct net_triangle *a = &x->triangles[t];
		const int i = corner_of(a, p);
		if (a->v[turn[i]] == q) {
			*triangle = t;
			*place = back[i];
			return true;
		}
		t = a->next[turn[i]];
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
		const int i = corner_of(p, a), right = p->v[turn[i]], left = p->v[back[i]];
		const int64_t s = side_of(x, a, right, b);
		const int64_t ahead = (int64_t)(x->at[right][0] - o[0]) * (to[0] - o[0]) +
		                      (int64_t)(x->at[right][1] - o[1]) * (to[1] - o[1]);
		*triangle = t;
		*place = i;
		*on = s == 0 && ahead > 0 ? right : -1;
		if (*on >= 0 || (s > 0 && side_of(x, a, left, b) < 0))
			return true;
		t = p->next[turn[i]];
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
	enum status st = grow((void **)&q->pairs, &q->room, 2 * q->n + 2, sizeof *q->pairs);
	if (st == ST_OK) {
		q->pairs[2 * q->n] = a;
		q->pairs[2 * q->n + 1] = b;
		q->n++;
	}
	return st;
}

/* List the edges crossed on the way from a, which is corner i of t, towards b; *end is the vertex on
 * it that is met first. */
static enum status list_crossed(const struct net *x, int a, int b, int t, int i,
                                struct edge_queue *q, int *end)
{
	for (;;) {
		const struct net_triangle *p = &x->triangles[t];
		const int right = p->v[turn[i]], left = p->v[back[i]], o = p->next[i];
		if (p->edge[i] & NET_FIXED)
			return ST_INPUT;
		enum status st = right < 4 ? enqueue(q, left, right) : enqueue(q, right, left);
		if (st != ST_OK)
			return st;
		const struct net_triangle *far = &x->triangles[o];
		const int apex = far->v[place_of(far, t)];
		const int64_t s = side_of(x, a, b, apex);
		*end = apex;
		if (s == 0)
			return ST_OK;
		t = o;
		i = corner_of(far, s > 0 ? left : right);
	}
}

static bool crosses(const struct net *x, int a, int b, int p, int q)
{
	if (p == a || p == b || q == a || q == b)
		return false;
	const int64_t s = side_of(x, a, b, p), r = side_of(x, a, b, q);
	return (s > 0 && r < 0) || (s < 0 && r > 0);
}

int net_beyond(const struct net *x, int t, int i)
{
	const struct net_triangle *a = &x->triangles[t];
	if (a->edge[i] & NET_FIXED || a->next[i] < 0)
		return -1;
	const struct net_triangle *b = &x->triangles[a->next[i]];
	const int apex = b->v[place_of(b, t)];
	return crosses(x, a->v[i], apex, a->v[turn[i]], a->v[back[i]]) ? apex : -1;
}

void net_turn(struct net *x, int t, int i)
{
	flip(x, t, i);
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
		const int u = one->v[i], w = two->v[place_of(two, t)];
		if (!crosses(x, u, w, p, r)) {
			st = enqueue(q, p, r); /* not convex yet */
			continue;
		}
		flip(x, t, i);
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
		if (in_circle(x, a->v, b->v[place_of(b, t)]))
			flip(x, t, i);
	}
}

enum status net_fix(struct net *x, int a, int b, unsigned char flags)
{
	enum status st = ST_OK;
	while (a != b && st == ST_OK) {
		struct edge_queue crossed = { 0 }, fresh = { 0 };
		int t, i, end;
		if (!find_way(x, a, b, &t, &i, &end))
			return ST_INPUT;
		if (end < 0) {
			st = list_crossed(x, a, b, t, i, &crossed, &end);
			if (st == ST_OK)
				st = turn_crossed(x, a, end, &crossed, &fresh);
		}
		if (st == ST_OK) {
			if (find_edge(x, a, end, &t, &i))
				mark(x, t, i, flags);
			else
				st = ST_INPUT;
			mend_fresh(x, &fresh);
		}
		free(crossed.pairs);
		free(fresh.pairs);
		a = end;
	}
	return st;
}

enum status net_classify(struct net *x)
{
	bool *seen = calloc((size_t)x->n_triangles, sizeof *seen);
	enum status st = seen ? push(x, x->of[0]) : ST_RESOURCE;
	if (st == ST_OK) {
		seen[x->of[0]] = true;
		x->triangles[x->of[0]].inside = false;
	}
	while (x->n_stack > 0 && st == ST_OK) {
		const int t = x->stack[--x->n_stack];
		for (int i = 0; i < 3 && st == ST_OK; i++) {
			const struct net_triangle *a = &x->triangles[t];
			const int o = a->next[i];
			if (o < 0 || seen[o])
				continue;
			seen[o] = true;
			x->triangles[o].inside = a->inside ^ !!(a->edge[i] & NET_BORDER);
			st = push(x, o);
		}
	}
	x->n_stack = 0;
	free(seen);
	return st;
}
