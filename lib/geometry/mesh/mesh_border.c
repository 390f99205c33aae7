/* mesh_border.c - the loops of a face as straight pieces in its u, v: all of them there, none across
 * another. */
#include <stdlib.h>

#include "mesh_face.h"

/* Loops that still cross when all pieces there were halved so often do cross; those that still lie
 * on the wrong side of each other do. */
enum { ROUNDS = 14, SIDE_ROUNDS = 5, FLAWS_MAX = 10000 };

/* So many are added in their order without delay. */
enum { FEW_NODES = 2048 };

/* A piece between two nodes, as vertices of the net. */
struct piece {
	int from, to, edge, node, loop;
};

struct border {
	struct mesh_face *f;
	struct piece *pieces; /* owned; in order of loops */
	int n, room;
};

void mesh_flaws_finish(struct mesh_flaws *flaws)
{
	free(flaws->list);
	*flaws = (struct mesh_flaws){ 0 };
}

static enum status add_flaw(struct mesh_flaws *flaws, int edge, int piece, double t)
{
	enum status st =
	        mesh_grow((void **)&flaws->list, &flaws->room, flaws->n + 1, sizeof *flaws->list);
	if (st == ST_OK)
		flaws->list[flaws->n++] = (struct mesh_flaw){ edge, piece, t };
	return st;
}

/* A node on a crease gets just the crease's parameter. */
static void snap(const struct mesh_face *f, const double in[2], double out[2])
{
	for (int d = 0; d < 2; d++) {
		const double near = MESH_ON_CREASE * (f->s->domain[d][1] - f->s->domain[d][0]);
		const double *at = f->creases->at[d];
		int lo = 0, hi = f->creases->n[d];
		while (lo < hi) {
			const int mid = lo + (hi - lo) / 2;
			if (at[mid] < in[d] - near)
				lo = mid + 1;
			else
				hi = mid;
		}
		out[d] = lo < f->creases->n[d] && at[lo] <= in[d] + near ? at[lo] : in[d];
	}
}

/* The pieces of a loop; they have no vertices yet. */
static enum status add_loop(struct border *x, int loop)
{
	const struct mesh_edge *edges = x->f->b->edges;
	enum status st = ST_OK;
	for (int k = x->f->b->loops[loop].first; k >= 0 && st == ST_OK; k = edges[k].next)
		for (int i = 0; i + 1 < edges[k].n_nodes && st == ST_OK; i++) {
			st = mesh_grow((void **)&x->pieces, &x->room, x->n + 1, sizeof *x->pieces);
			if (st == ST_OK)
				x->pieces[x->n++] = (struct piece){ -1, -1, k, i, loop };
		}
	return st;
}

/* The vertex of the net where a piece begins. */
static enum status add_vertex(struct mesh_face *f, struct piece *p)
{
	const struct mesh_node *node = &f->b->edges[p->edge].nodes[p->node];
	const int before = f->net.n;
	int32_t at[2];
	double uv[2];
	snap(f, node->uv, uv);
	mesh_face_at(f, uv, at);
	enum status st = net_add(&f->net, at[0], at[1], &p->from);
	if (st == ST_OK && p->from >= before)
		return mesh_face_place(f, p->from, uv, node->point);
	if (st == ST_OK)
		mesh_point_unite(f->b, f->places[p->from].point, node->point);
	return st;
}

/*
 * Every piece between two vertices. One after the other along a curve, each may change triangles as far
 * as the curve's other side, n^2 in all: of many nodes first some far from each other are taken, then
 * each time those half way between.
 */
static enum status add_vertices(struct border *x)
{
	enum status st = ST_OK;
	int step = 1;
	while (x->n / step > FEW_NODES)
		step *= 2;
	for (int i = 0; i < x->n && st == ST_OK; i += step)
		st = add_vertex(x->f, &x->pieces[i]);
	for (; step > 1; step /= 2)
		for (int i = step / 2; i < x->n && st == ST_OK; i += step)
			st = add_vertex(x->f, &x->pieces[i]);
	for (int i = 0, first = 0; i < x->n; i++) {
		const bool last = i + 1 == x->n || x->pieces[i + 1].loop != x->pieces[i].loop;
		x->pieces[i].to = x->pieces[last ? first : i + 1].from;
		first = last ? i + 1 : first;
	}
	return st;
}

static enum status flaw_between(const struct border *x, int a, int b, struct mesh_flaws *flaws)
{
	for (int i = 0; i < x->n; i++) {
		const struct piece *p = &x->pieces[i];
		if ((p->from == a && p->to == b) || (p->from == b && p->to == a))
			return add_flaw(flaws, p->edge, p->node, NAN);
	}
	return ST_OK;
}

/* The parameter of a piece next to the place of a vertex that it passes. */
static double beside(const struct border *x, const struct piece *p, int vertex)
{
	const struct mesh_node *node = &x->f->b->edges[p->edge].nodes[p->node];
	const double *uv = x->f->places[vertex].uv;
	const double du = node[1].uv[0] - node[0].uv[0], dv = node[1].uv[1] - node[0].uv[1];
	const double f =
	        ((uv[0] - node[0].uv[0]) * du + (uv[1] - node[0].uv[1]) * dv) / (du * du + dv * dv);
	return node[0].t + fmin(fmax(f, 0.01), 0.99) * (node[1].t - node[0].t);
}

/* Make a piece an edge of the net. */
static enum status fix_piece(struct border *x, const struct piece *p, struct mesh_flaws *flaws)
{
	int at = p->from;
	while (at != p->to) {
		int end = p->to, crossed[2];
		enum status st =
		        net_fix_first(&x->f->net, at, &end, NET_FIXED | NET_BORDER, crossed);
		if (st == ST_INPUT) {
			flaws->crossed = true;
			st = add_flaw(flaws, p->edge, p->node, NAN);
			return st == ST_OK ? flaw_between(x, crossed[0], crossed[1], flaws) : st;
		}
		if (st == ST_OK && end != p->to)
			st = add_flaw(flaws, p->edge, p->node, beside(x, p, end));
		if (st != ST_OK)
			return st;
		at = end;
	}
	return ST_OK;
}

/* Twice the area that a loop's pieces go around, counterclockwise positive. */
static double turning(const struct border *x, int first, int end)
{
	double sum = 0;
	const double *o = x->f->places[x->pieces[first].from].uv;
	for (int i = first; i < end; i++) {
		const double *p = x->f->places[x->pieces[i].from].uv;
		const double *q = x->f->places[x->pieces[i].to].uv;
		sum += (p[0] - o[0]) * (q[1] - o[1]) - (q[0] - o[0]) * (p[1] - o[1]);
	}
	return sum;
}

/* A loop that is cut coarsely may come to lie on the wrong side of another: an outer loop has the face
 * within, an inner one about it. */
static enum status look_at_sides(const struct border *x, struct mesh_flaws *flaws)
{
	enum status st = ST_OK;
	for (int i = 0, end; i < x->n && st == ST_OK; i = end) {
		const int loop = x->pieces[i].loop;
		bool wrong = true;
		for (end = i; end < x->n && x->pieces[end].loop == loop; end++)
			;
		const double area = turning(x, i, end);
		const bool left = (area > 0) == x->f->b->loops[loop].outer;
		for (int k = i; k < end && wrong; k++) {
			const struct piece *p = &x->pieces[k];
			wrong = p->from != p->to &&
			        net_inside_left(&x->f->net, left ? p->from : p->to,
			                        left ? p->to : p->from) == 0;
		}
		flaws->wrong_side |= wrong && area != 0;
		for (int k = 0; k < x->n && wrong && area != 0 && st == ST_OK; k++)
			st = add_flaw(flaws, x->pieces[k].edge, x->pieces[k].node, NAN);
	}
	return st;
}

enum status mesh_face_border(struct mesh_face *f, struct mesh_flaws *flaws)
{
	struct border x = { .f = f };
	const int *loops = f->b->first_loop + f->face;
	enum status st = ST_OK;
	flaws->n = 0;
	flaws->crossed = flaws->wrong_side = false;
	for (int k = loops[0]; k < loops[1] && st == ST_OK; k++)
		st = add_loop(&x, k);
	if (st == ST_OK)
		st = add_vertices(&x);
	for (int i = 0; i < x.n && st == ST_OK; i++)
		st = fix_piece(&x, &x.pieces[i], flaws);
	if (st == ST_OK)
		st = net_classify(&f->net);
	if (st == ST_OK && !flaws->n)
		st = look_at_sides(&x, flaws);
	free(x.pieces);
	return st;
}

static int last_piece_first(const void *a, const void *b)
{
	const struct mesh_flaw *p = a, *q = b;
	if (p->edge != q->edge)
		return p->edge < q->edge ? -1 : 1;
	if (p->piece != q->piece)
		return p->piece > q->piece ? -1 : 1;
	if (isnan(p->t) || isnan(q->t))
		return isnan(p->t) - isnan(q->t);
	return (p->t < q->t) - (p->t > q->t);
}

/* Mend what is wrong with one face; the faces that changed with it are marked. */
static enum status mend(struct mesh_build *b, struct mesh_flaws *flaws, bool *again)
{
	enum status st = ST_OK;
	if (flaws->n)
		qsort(flaws->list, (size_t)flaws->n, sizeof *flaws->list, last_piece_first);
	for (int i = 0; i < flaws->n && st == ST_OK; i++) {
		const struct mesh_flaw *x = &flaws->list[i];
		const struct mesh_edge *e = &b->edges[x->edge];
		const int *group = b->groups + e->master;
		/* one of a piece each round, or one of the same edge's other side would be off */
		if (i && x->edge == x[-1].edge && x->piece == x[-1].piece)
			continue;
		st = mesh_cut_more(b, x->edge, x->piece, x->t);
		for (int k = group[0]; k < group[1]; k++)
			again[b->edges[b->members[k]].face] = true;
	}
	return st;
}

enum status mesh_uncross(struct mesh_build *b)
{
	bool *again = malloc((size_t)b->n_faces * sizeof *again);
	struct mesh_flaws flaws = { 0 };
	enum status st = again ? ST_OK : ST_RESOURCE;
	for (int f = 0; f < b->n_faces && st == ST_OK; f++)
		again[f] = true;
	bool any = true;
	for (int round = 0; round < ROUNDS && any && st == ST_OK; round++) {
		any = false;
		for (int f = 0; f < b->n_faces && st == ST_OK; f++) {
			struct mesh_face face;
			if (!again[f])
				continue;
			st = mesh_step(b, MESH_UNCROSS, f, b->n_faces);
			if (st != ST_OK)
				break;
			again[f] = false;
			st = mesh_face_init(&face, b, f);
			if (st == ST_OK)
				st = mesh_face_border(&face, &flaws);
			mesh_face_finish(&face);
			if (flaws.n == 0 || flaws.n > FLAWS_MAX ||
			    (flaws.wrong_side && round >= SIDE_ROUNDS))
				continue;
			any = true;
			if (st == ST_OK)
				st = mend(b, &flaws, again);
		}
	}
	mesh_flaws_finish(&flaws);
	free(again);
	return st;
}
