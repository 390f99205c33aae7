/* mesh_orient.c - sides of faces: neighbours agree, closed shapes look out. */
#include <stdlib.h>

#include "mesh_private.h"

/* What two faces say of each other: across a shared line they agree, or not. */
struct bond {
	int face, other;
	bool agree;
};

struct orient {
	struct mesh_build *b;
	bool *against;      /* owned; of each loop: it runs with the face on its right */
	int *loop_of;       /* owned; of each edge */
	struct bond *bonds; /* owned; both ways, by face */
	int n_bonds, bonds_room;
	int *first;    /* owned; of each face its first bond, and one behind the last */
	int *shell;    /* owned; of each face, -1: none yet */
	double *size;  /* owned; of each face: area, then volume under it */
	bool *open;    /* owned; of each face: a border of it is no other's, or several others' */
	struct vec3 o; /* volumes are about it */
};

/* Loops run with the face on their left, if outer ones are counterclockwise in u, v. */
static void find_directions(struct orient *x)
{
	const struct mesh_build *b = x->b;
	for (int l = 0; l < b->n_loops; l++) {
		const int first = b->loops[l].first;
		const double *o = b->edges[first].nodes[0].uv;
		double sum = 0;
		for (int k = first; k >= 0; k = b->edges[k].next) {
			const struct mesh_edge *e = &b->edges[k];
			x->loop_of[k] = l;
			for (int i = 0; i + 1 < e->n_nodes; i++) {
				const double *p = e->nodes[i].uv, *q = e->nodes[i + 1].uv;
				sum += (p[0] - o[0]) * (q[1] - o[1]) -
				       (q[0] - o[0]) * (p[1] - o[1]);
			}
		}
		x->against[l] = (sum > 0) != b->loops[l].outer;
	}
}

static enum status add_bond(struct orient *x, int face, int other, bool agree)
{
	enum status st =
	        mesh_grow((void **)&x->bonds, &x->bonds_room, x->n_bonds + 1, sizeof *x->bonds);
	if (st == ST_OK)
		x->bonds[x->n_bonds++] = (struct bond){ face, other, agree };
	return st;
}

static int by_face(const void *a, const void *b)
{
	const struct bond *p = a, *q = b;
	if (p->face != q->face)
		return p->face < q->face ? -1 : 1;
	if (p->other != q->other)
		return p->other < q->other ? -1 : 1;
	return p->agree - q->agree;
}

static enum status find_bonds(struct orient *x)
{
	const struct mesh_build *b = x->b;
	enum status st = ST_OK;
	for (int k = 0; k < b->n_edges && st == ST_OK; k++) {
		const int *at = b->groups + k, *edge = b->members + at[0], n = at[1] - at[0];
		if (n == 2) {
			const struct mesh_edge *e = &b->edges[edge[0]], *f = &b->edges[edge[1]];
			const bool along = e->reversed == f->reversed;
			const bool sides =
			        x->against[x->loop_of[edge[0]]] == x->against[x->loop_of[edge[1]]];
			if (e->face == f->face)
				continue;
			st = add_bond(x, e->face, f->face, along != sides);
			if (st == ST_OK)
				st = add_bond(x, f->face, e->face, along != sides);
		}
		for (int i = 0; i < n && n != 2; i++)
			x->open[b->edges[edge[i]].face] |= !b->edges[edge[i]].degenerate;
	}
	if (x->n_bonds)
		qsort(x->bonds, (size_t)x->n_bonds, sizeof *x->bonds, by_face);
	for (int i = 0; i < x->n_bonds; i++)
		x->first[x->bonds[i].face + 1]++;
	for (int f = 0; f < b->n_faces; f++)
		x->first[f + 1] += x->first[f];
	return st;
}

static void measure(struct orient *x, int face)
{
	const struct mesh *m = x->b->out;
	const struct mesh_part *part = &m->parts[face];
	double area = 0, volume = 0;
	for (int t = part->first; t < part->first + part->count; t++) {
		struct vec3 p[3];
		for (int k = 0; k < 3; k++)
			p[k] = vec3_sub(m->points[m->triangles[t][k].point], x->o);
		const struct vec3 c = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
		area += 0.5 * vec3_length(c);
		volume += vec3_dot(p[0], c) / 6;
	}
	x->size[2 * face] = area;
	x->size[2 * face + 1] = volume;
}

/* All faces that hang together with that one; each agrees with the one it was come to from. *queue has
 * room for all faces. */
static int gather(struct orient *x, int face, int *queue)
{
	bool *turned = x->b->turned;
	int n = 0;
	queue[n++] = face;
	x->shell[face] = face;
	for (int i = 0; i < n; i++)
		for (int k = x->first[queue[i]]; k < x->first[queue[i] + 1]; k++) {
			const struct bond *bond = &x->bonds[k];
			if (x->shell[bond->other] >= 0)
				continue;
			x->shell[bond->other] = face;
			turned[bond->other] = turned[bond->face] != !bond->agree;
			queue[n++] = bond->other;
		}
	return n;
}

/* Closed ones look out; of others the larger part of the area stays as it is. */
static void settle(struct orient *x, const int *faces, int n)
{
	bool *turned = x->b->turned, open = false;
	double area = 0, volume = 0;
	for (int i = 0; i < n; i++) {
		const int f = faces[i];
		open |= x->open[f];
		area += turned[f] ? -x->size[2 * f] : x->size[2 * f];
		volume += turned[f] ? -x->size[2 * f + 1] : x->size[2 * f + 1];
	}
	for (int i = 0; i < n && (open ? area : volume) < 0; i++)
		turned[faces[i]] = !turned[faces[i]];
}

enum status mesh_orient(struct mesh_build *b)
{
	const size_t faces = (size_t)b->n_faces;
	struct orient x = {
		.b = b,
		.against = calloc((size_t)b->n_loops + 1, sizeof *x.against),
		.loop_of = calloc((size_t)b->n_edges + 1, sizeof *x.loop_of),
		.first = calloc(faces + 2, sizeof *x.first),
		.shell = malloc(faces * sizeof *x.shell),
		.size = calloc(2 * faces, sizeof *x.size),
		.open = calloc(faces, sizeof *x.open),
	};
	int *queue = malloc(faces * sizeof *queue);
	enum status st = ST_RESOURCE;
	b->turned = calloc(faces, sizeof *b->turned);
	if (!x.against || !x.loop_of || !x.first || !x.shell || !x.size || !x.open || !queue ||
	    !b->turned)
		goto out;
	if (b->out->n_points)
		x.o = b->out->points[0];
	find_directions(&x);
	st = find_bonds(&x);
	for (int f = 0; f < b->n_faces && st == ST_OK; f++) {
		x.shell[f] = -1;
		measure(&x, f);
	}
	for (int f = 0; f < b->n_faces && st == ST_OK; f++)
		if (x.shell[f] < 0)
			settle(&x, queue, gather(&x, f, queue));
out:
	free(x.against);
	free(x.loop_of);
	free(x.bonds);
	free(x.first);
	free(x.shell);
	free(x.size);
	free(x.open);
	free(queue);
	return st;
}
