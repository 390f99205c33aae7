/* mesh_net.c - a constrained Delaunay triangulation of points with whole coordinates. */
#include "mesh_net.h"

#include <stdlib.h>
#include <string.h>

#include "mesh_net_private.h"

__extension__ typedef __int128 wide;

/* Twice the area of a b p: > 0 where p is left of a b. */
static int64_t side(const struct net *x, int a, int b, int32_t px, int32_t py)
{
	const int32_t *p = x->at[a], *q = x->at[b];
	return (int64_t)(q[0] - p[0]) * (py - p[1]) - (int64_t)(q[1] - p[1]) * (px - p[0]);
}

int64_t net_side(const struct net *x, int a, int b, int c)
{
	return side(x, a, b, x->at[c][0], x->at[c][1]);
}

bool net_in_circle(const struct net *x, const int v[3], int d)
{
	int64_t dx[3], dy[3];
	for (int i = 0; i < 3; i++) {
		dx[i] = (int64_t)x->at[v[i]][0] - x->at[d][0];
		dy[i] = (int64_t)x->at[v[i]][1] - x->at[d][1];
	}
	wide sum = 0;
	for (int i = 0; i < 3; i++) {
		const int j = net_turn_of[i], k = net_back_of[i];
		const int64_t cross = dx[j] * dy[k] - dx[k] * dy[j];
		sum += (wide)(dx[i] * dx[i] + dy[i] * dy[i]) * cross;
	}
	return sum > 0;
}

enum status net_grow(void **p, int *room, int n, size_t size)
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
	enum status st = net_grow((void **)&x->at, &x->room, x->n + 1, sizeof *x->at);
	if (st == ST_OK)
		st = net_grow((void **)&x->of, &x->of_room, x->n + 1, sizeof *x->of);
	if (st == ST_OK)
		st = net_grow((void **)&x->triangles, &x->triangles_room, x->n_triangles + 2,
		              sizeof *x->triangles);
	return st;
}

static enum status push(struct net *x, int t)
{
	enum status st = net_grow((void **)&x->stack, &x->stack_room, x->n_stack + 1, sizeof(int));
	if (st == ST_OK)
		x->stack[x->n_stack++] = t;
	return st;
}

enum status net_init(struct net *x)
{
	const int32_t lo = -NET_SIDE, hi = 2 * NET_SIDE;
	const int32_t corner[4][2] = { { lo, lo }, { hi, lo }, { hi, hi }, { lo, hi } };
	*x = (struct net){ 0 };
	enum status st = net_grow((void **)&x->at, &x->room, 64, sizeof *x->at);
	if (st == ST_OK)
		st = net_grow((void **)&x->of, &x->of_room, 64, sizeof *x->of);
	if (st == ST_OK)
		st = net_grow((void **)&x->triangles, &x->triangles_room, 128,
		              sizeof *x->triangles);
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

int net_corner_of(const struct net_triangle *t, int vertex)
{
	return t->v[0] == vertex ? 0 : t->v[1] == vertex ? 1 : t->v[2] == vertex ? 2 : -1;
}

int net_place_of(const struct net_triangle *t, int other)
{
	return t->next[0] == other ? 0 : t->next[1] == other ? 1 : 2;
}

static void relink(struct net *x, int t, int from, int to)
{
	if (t >= 0)
		x->triangles[t].next[net_place_of(&x->triangles[t], from)] = to;
}

/* Tell the vertices of t where it is. */
static void name_corners(struct net *x, int t)
{
	for (int k = 0; k < 3; k++)
		x->of[x->triangles[t].v[k]] = t;
}

void net_flip(struct net *x, int t, int i)
{
	struct net_triangle *a = &x->triangles[t];
	const int o = a->next[i];
	struct net_triangle *b = &x->triangles[o];
	const int j = net_place_of(b, t);
	const struct net_triangle p = *a, q = *b;
	/* p: apex, l, r and the neighbours across; q: apex, r, l */
	const int l = p.v[net_turn_of[i]], r = p.v[net_back_of[i]];
	*a = (struct net_triangle){
		.v = { l, q.v[j], p.v[i] },
		.next = { o, p.next[net_back_of[i]], q.next[net_turn_of[j]] },
		.edge = { 0, p.edge[net_back_of[i]], q.edge[net_turn_of[j]] },
		.inside = p.inside,
	};
	*b = (struct net_triangle){
		.v = { r, p.v[i], q.v[j] },
		.next = { t, q.next[net_back_of[j]], p.next[net_turn_of[i]] },
		.edge = { 0, q.edge[net_back_of[j]], p.edge[net_turn_of[i]] },
		.inside = p.inside,
	};
	relink(x, q.next[net_turn_of[j]], o, t);
	relink(x, p.next[net_turn_of[i]], t, o);
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
		const int i = net_corner_of(a, vertex), o = i < 0 ? -1 : a->next[i];
		if (o < 0 || a->edge[i] & NET_FIXED)
			continue;
		const struct net_triangle *b = &x->triangles[o];
		const int apex = b->v[net_place_of(b, t)];
		if (!net_in_circle(x, a->v, apex))
			continue;
		net_flip(x, t, i);
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
			.v = { vertex, p.v[net_turn_of[k]], p.v[net_back_of[k]] },
			.next = { p.next[k], name[net_turn_of[k]], name[net_back_of[k]] },
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
	const int j = net_place_of(&q, t);
	const int apex = p.v[i], l = p.v[net_turn_of[i]], r = p.v[net_back_of[i]], other = q.v[j];
	const unsigned char e = p.edge[i];
	enum status st = ST_OK;
	x->n_triangles += 2;
	x->triangles[t] = (struct net_triangle){
		.v = { apex, l, vertex },
		.next = { o, t2, p.next[net_back_of[i]] },
		.edge = { e, 0, p.edge[net_back_of[i]] },
		.inside = p.inside,
	};
	x->triangles[t2] = (struct net_triangle){
		.v = { apex, vertex, r },
		.next = { o2, p.next[net_turn_of[i]], t },
		.edge = { e, p.edge[net_turn_of[i]], 0 },
		.inside = p.inside,
	};
	x->triangles[o] = (struct net_triangle){
		.v = { other, vertex, l },
		.next = { t, q.next[net_turn_of[j]], o2 },
		.edge = { e, q.edge[net_turn_of[j]], 0 },
		.inside = q.inside,
	};
	x->triangles[o2] = (struct net_triangle){
		.v = { other, r, vertex },
		.next = { t2, o, q.next[net_back_of[j]] },
		.edge = { e, 0, q.edge[net_back_of[j]] },
		.inside = q.inside,
	};
	relink(x, p.next[net_turn_of[i]], t, t2);
	relink(x, q.next[net_back_of[j]], o, o2);
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
			if (side(x, a->v[net_turn_of[i]], a->v[net_back_of[i]], px, py) < 0)
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
		const int64_t s = side(x, a->v[net_turn_of[i]], a->v[net_back_of[i]], px, py);
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
