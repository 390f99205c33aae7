/* batch.c - many small surfaces in one mesh: a driver's calls would cost more than their triangles. */
#include <stdlib.h>
#include <string.h>

#include "hash.h"
#include "view_private.h"

enum { FEWEST = 64, PART_SEEN = 4 /* or their vertices out of the picture cost more */ };
static const double small_part = 1 / 24.0; /* of the scene's size */
static const double chord_px_most = 3;     /* device px: coarse triangles do */

static bool is_member(const struct drawing *d, int i)
{
	const struct shape *x = d->shown[i];
	return surface_look_of(d, d->things[i]) == LOOK_SHADED && !x->coarse.failed &&
	       x->coarse.chord > 0 && x->coarse.made.n_indices > 0 &&
	       box_diagonal(&x->box) <= small_part * box_diagonal(&d->box);
}

struct member {
	int id;
	unsigned revision;
	double chord;
	struct rgb color;
};

/* Which of the things are in it; a hash of all that it is made of. */
static uint64_t choose(struct drawing *d, int *n, int *n_seen)
{
	uint64_t of = 1;
	*n = *n_seen = 0;
	for (int i = 0; i < d->n_shown; i++) {
		d->in_batch[i] = is_member(d, i);
		if (!d->in_batch[i])
			continue;
		struct {
			uint64_t before;
			struct member m;
		} x;
		memset(&x, 0, sizeof x);
		x.before = of;
		x.m.id = d->shown[i]->id;
		x.m.revision = d->shown[i]->revision;
		x.m.chord = d->shown[i]->coarse.chord;
		x.m.color = surface_color(d->things[i]);
		of = checksum_bytes(&x, sizeof x);
		++*n;
		*n_seen += d->in_view[i];
	}
	return of;
}

static void add(struct tinted *t, const struct drawing *d, int i, struct vec3 origin)
{
	const struct shape *x = d->shown[i];
	const struct mesh_made *m = &x->coarse.made;
	const struct vec3 by = vec3_sub(x->origin, origin);
	const struct rgb c = surface_color(d->things[i]);
	const float shift[3] = { (float)by.x, (float)by.y, (float)by.z };
	const float color[3] = { (float)rgb_to_linear(c.r), (float)rgb_to_linear(c.g),
		                 (float)rgb_to_linear(c.b) };
	const unsigned first = (unsigned)t->n_vertices;
	for (int k = 0; k < m->n_vertices; k++) {
		struct tinted_vertex *v = &t->vertices[t->n_vertices++];
		for (int e = 0; e < 3; e++) {
			v->position[e] = m->vertices[k].position[e] + shift[e];
			v->normal[e] = m->vertices[k].normal[e];
			v->color[e] = color[e];
		}
	}
	for (int k = 0; k < m->n_indices; k++)
		t->indices[t->n_indices++] = first + m->indices[k];
	for (int k = 0; k < m->n_border; k++)
		t->border[t->n_border++] = first + m->indices[m->n_indices + k];
}

static enum status make(struct drawing *d, struct batch *b)
{
	size_t vertices = 1, indices = 1, border = 1;
	for (int i = 0; i < d->n_shown; i++)
		if (d->in_batch[i]) {
			vertices += (size_t)d->shown[i]->coarse.made.n_vertices;
			indices += (size_t)d->shown[i]->coarse.made.n_indices;
			border += (size_t)d->shown[i]->coarse.made.n_border;
		}
	struct tinted t = { .vertices = malloc(vertices * sizeof *t.vertices),
		            .indices = malloc(indices * sizeof *t.indices),
		            .border = malloc(border * sizeof *t.border) };
	const bool room = t.vertices && t.indices && t.border;
	b->origin = box_center(&d->box);
	for (int i = 0; i < d->n_shown && room; i++)
		if (d->in_batch[i])
			add(&t, d, i, b->origin);
	if (room)
		gpu_tinted_load(&b->gpu, &t);
	free(t.vertices);
	free(t.indices);
	free(t.border);
	return room ? ST_OK : ST_RESOURCE;
}

enum status batch_make(struct drawing *d, double pixel)
{
	struct batch *b = &d->view->batch;
	int n = 0, n_seen = 0;
	d->has_batch = false;
	if (!d->state->moving || d->view->shapes.coarse_chord > chord_px_most * pixel)
		return ST_OK;
	const uint64_t of = choose(d, &n, &n_seen);
	if (n_seen < FEWEST || n_seen < n / PART_SEEN)
		return ST_OK;
	enum status st = of == b->of ? ST_OK : make(d, b);
	b->of = st == ST_OK ? of : 0;
	d->has_batch = st == ST_OK;
	return st;
}
