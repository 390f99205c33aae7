/* mesh_look.c - edges of a mesh by how many triangles they have. */
#include "mesh_look.h"

#include <stdlib.h>

#include "mesh_uses.h"

struct open_edge {
	int low, high, part;
	bool up;
};

struct look {
	const struct mesh *m;
	struct mesh_looks *out;
	struct mesh_uses uses;   /* owned */
	struct open_edge *edges; /* owned */
	int n_edges, room;
	int *root;   /* owned; of each point one that open edges join it with */
	int *border; /* owned; of each root its border, -1: none */
};

static int root_of(int *root, int point)
{
	while (root[point] != point)
		point = root[point] = root[root[point]];
	return point;
}

static enum status add_open(struct look *x, int low, const struct mesh_use *h)
{
	if (x->n_edges == x->room) {
		const int more = x->room ? 2 * x->room : 64;
		struct open_edge *e = reallocarray(x->edges, (size_t)more, sizeof *e);
		if (!e)
			return ST_RESOURCE;
		x->edges = e;
		x->room = more;
	}
	x->edges[x->n_edges++] =
	        (struct open_edge){ low, h->high, mesh_part_of(x->m, h->triangle), h->up };
	const int p = root_of(x->root, low), q = root_of(x->root, h->high);
	x->root[p > q ? p : q] = p > q ? q : p;
	return ST_OK;
}

static enum status count_uses(struct look *x)
{
	enum status st = ST_OK;
	for (int p = 0; p < x->m->n_points; p++) {
		const struct mesh_use *h = x->uses.list + x->uses.first[p];
		const int n = x->uses.first[p + 1] - x->uses.first[p];
		for (int i = 0, k; i < n && st == ST_OK; i = k) {
			for (k = i + 1; k < n && h[k].high == h[i].high; k++)
				;
			x->out->multiple += k - i > 2;
			x->out->turned += k - i == 2 && h[i].up == h[i + 1].up;
			if (k - i == 1)
				st = add_open(x, p, &h[i]);
		}
	}
	x->out->open = x->n_edges;
	return st;
}

static int by_length(const void *a, const void *b)
{
	const struct mesh_border *p = a, *q = b;
	return (p->length < q->length) - (p->length > q->length);
}

/* The borders; twice the area that each goes around over its length is how wide it is. */
static enum status gather(struct look *x)
{
	const struct mesh *m = x->m;
	struct vec3 *around = calloc((size_t)x->n_edges + 1, sizeof *around);
	int n = 0;
	x->out->borders = calloc((size_t)x->n_edges + 1, sizeof *x->out->borders);
	if (!around || !x->out->borders) {
		free(around);
		return ST_RESOURCE;
	}
	for (int i = 0; i < x->n_edges; i++) {
		const struct open_edge *e = &x->edges[i];
		int *border = &x->border[root_of(x->root, e->low)];
		if (*border < 0) {
			*border = n;
			x->out->borders[n++] = (struct mesh_border){ .at = m->points[e->low],
				                                     .parts = { e->part, -1 } };
		}
		struct mesh_border *b = &x->out->borders[*border];
		const struct vec3 p = vec3_sub(m->points[e->low], b->at);
		const struct vec3 q = vec3_sub(m->points[e->high], b->at);
		b->edges++;
		b->length += vec3_length(vec3_sub(q, p));
		around[*border] = vec3_along(around[*border], e->up ? 1 : -1, vec3_cross(p, q));
		if (b->parts[1] < 0 && e->part != b->parts[0])
			b->parts[1] = e->part;
	}
	for (int i = 0; i < n; i++) {
		struct mesh_border *b = &x->out->borders[i];
		b->width = b->length > 0 ? vec3_length(around[i]) / b->length : 0;
	}
	qsort(x->out->borders, (size_t)n, sizeof *x->out->borders, by_length);
	x->out->n_borders = n;
	free(around);
	return ST_OK;
}

void mesh_looks_finish(struct mesh_looks *x)
{
	free(x->borders);
	*x = (struct mesh_looks){ 0 };
}

enum status mesh_look(struct mesh_looks *out, const struct mesh *m)
{
	struct look x = { .m = m, .out = out };
	*out = (struct mesh_looks){ 0 };
	enum status st = mesh_uses_init(&x.uses, m);
	x.root = malloc(((size_t)m->n_points + 1) * sizeof *x.root);
	x.border = malloc(((size_t)m->n_points + 1) * sizeof *x.border);
	if (!x.root || !x.border)
		st = ST_RESOURCE;
	for (int p = 0; p < m->n_points && st == ST_OK; p++) {
		x.root[p] = p;
		x.border[p] = -1;
	}
	if (st == ST_OK)
		st = count_uses(&x);
	if (st == ST_OK)
		st = gather(&x);
	mesh_uses_finish(&x.uses);
	free(x.edges);
	free(x.root);
	free(x.border);
	if (st != ST_OK)
		mesh_looks_finish(out);
	return st;
}
