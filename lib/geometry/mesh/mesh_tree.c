/* mesh_tree.c - pieces of edges in a tree of boxes. */
#include "mesh_tree.h"

#include <stdlib.h>

enum { PIECE = 8 };

static double coordinate(struct vec3 p, int axis)
{
	return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static struct box piece_box(const struct mesh_edge *e, int first, int last)
{
	struct box x = box_empty();
	double step = 0;
	for (int i = first; i <= last; i++) {
		box_add_point(&x, e->samples[i].p);
		if (i > first)
			step = fmax(step,
			            vec3_length(vec3_sub(e->samples[i].p, e->samples[i - 1].p)));
	}
	step *= 0.25; /* the curve between samples */
	x.lo = vec3_sub(x.lo, vec3(step, step, step));
	x.hi = vec3_add(x.hi, vec3(step, step, step));
	return x;
}

static enum status add_edge(struct mesh_tree *x, const struct mesh_edge *e, int edge)
{
	enum status st = ST_OK;
	for (int i = 0; i + 1 < e->n_samples && st == ST_OK; i += PIECE) {
		const int last = i + PIECE < e->n_samples - 1 ? i + PIECE : e->n_samples - 1;
		st = mesh_grow((void **)&x->pieces, &x->room, x->n + 1, sizeof *x->pieces);
		if (st == ST_OK)
			x->pieces[x->n++] =
			        (struct mesh_piece){ piece_box(e, i, last), edge, i, last };
	}
	return st;
}

/* Order by center, then by number, so that equal ones have their places too. */
static bool before(const struct mesh_piece *p, const struct mesh_piece *q, int axis)
{
	const double a = coordinate(p->box.lo, axis) + coordinate(p->box.hi, axis);
	const double b = coordinate(q->box.lo, axis) + coordinate(q->box.hi, axis);
	if (a != b)
		return a < b;
	return p->edge != q->edge ? p->edge < q->edge : p->first < q->first;
}

/* Put the piece that belongs in the middle of [lo, hi) there, smaller ones before it. */
static void part_at_middle(struct mesh_piece *p, int lo, int hi, int axis)
{
	const int middle = lo + (hi - lo) / 2;
	hi--;
	while (lo < hi) {
		const struct mesh_piece pivot = p[lo + (hi - lo) / 2];
		int i = lo, j = hi;
		while (i <= j) {
			while (before(&p[i], &pivot, axis))
				i++;
			while (before(&pivot, &p[j], axis))
				j--;
			if (i <= j) {
				const struct mesh_piece swap = p[i];
				p[i++] = p[j];
				p[j--] = swap;
			}
		}
		if (middle <= j)
			hi = j;
		else if (middle >= i)
			lo = i;
		else
			break;
	}
}

static void build(struct mesh_tree *x, int lo, int hi)
{
	struct box all = box_empty();
	for (int i = lo; i < hi; i++)
		box_add_box(&all, &x->pieces[i].box);
	const int middle = lo + (hi - lo) / 2;
	x->boxes[middle] = all;
	if (hi - lo == 1)
		return;
	const struct vec3 side = vec3_sub(all.hi, all.lo);
	const int axis = side.x >= side.y ? side.x >= side.z ? 0 : 2 : side.y >= side.z ? 1 : 2;
	part_at_middle(x->pieces, lo, hi, axis);
	if (middle > lo)
		build(x, lo, middle);
	if (middle + 1 < hi)
		build(x, middle + 1, hi);
}

enum status mesh_tree_init(struct mesh_tree *x, const struct mesh_build *b)
{
	enum status st = ST_OK;
	*x = (struct mesh_tree){ 0 };
	for (int k = 0; k < b->n_edges && st == ST_OK; k++)
		if (!b->edges[k].joined && !b->edges[k].degenerate)
			st = add_edge(x, &b->edges[k], k);
	if (st == ST_OK && x->n) {
		x->boxes = malloc((size_t)x->n * sizeof *x->boxes);
		if (x->boxes)
			build(x, 0, x->n);
		else
			st = ST_RESOURCE;
	}
	if (st != ST_OK)
		mesh_tree_finish(x);
	return st;
}

void mesh_tree_finish(struct mesh_tree *x)
{
	free(x->pieces);
	free(x->boxes);
	*x = (struct mesh_tree){ 0 };
}

static bool is_near(const struct box *x, struct vec3 p, double within)
{
	return p.x >= x->lo.x - within && p.x <= x->hi.x + within && p.y >= x->lo.y - within &&
	       p.y <= x->hi.y + within && p.z >= x->lo.z - within && p.z <= x->hi.z + within;
}

struct query {
	const struct mesh_tree *x;
	struct vec3 p;
	double within;
	int *found, room, n;
};

static enum status look(struct query *q, int lo, int hi)
{
	const int middle = lo + (hi - lo) / 2;
	enum status st = ST_OK;
	if (lo >= hi || !is_near(&q->x->boxes[middle], q->p, q->within))
		return ST_OK;
	if (is_near(&q->x->pieces[middle].box, q->p, q->within)) {
		st = mesh_grow((void **)&q->found, &q->room, q->n + 1, sizeof *q->found);
		if (st == ST_OK)
			q->found[q->n++] = middle;
	}
	if (st == ST_OK)
		st = look(q, lo, middle);
	return st == ST_OK ? look(q, middle + 1, hi) : st;
}

enum status mesh_tree_near(const struct mesh_tree *x, struct vec3 p, double within, int **found,
                           int *room, int *n)
{
	struct query q = { x, p, within, *found, *room, 0 };
	enum status st = look(&q, 0, x->n);
	/* few are found: put in order of edges and samples one by one */
	for (int i = 1; i < q.n && st == ST_OK; i++) {
		const int at = q.found[i];
		const struct mesh_piece *a = &x->pieces[at];
		int k = i;
		for (; k > 0; k--) {
			const struct mesh_piece *c = &x->pieces[q.found[k - 1]];
			if (c->edge < a->edge || (c->edge == a->edge && c->first < a->first))
				break;
			q.found[k] = q.found[k - 1];
		}
		q.found[k] = at;
	}
	*found = q.found;
	*room = q.room;
	*n = q.n;
	return st;
}
