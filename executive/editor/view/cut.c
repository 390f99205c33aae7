/* cut.c - triangles of many shapes, on all threads, within a time. */
#include <limits.h>
#include <stdlib.h>
#include <time.h>

#include "parallel.h"
#include "shape.h"

static const double angle_coarse = 0.4, angle_fine = 0.12; /* radians, between normals of an edge */

/* So many chords across a surface those angles hold; less are asked of smaller ones. */
static const double chords_coarse = 30, chords_fine = 100;
enum { AT_ONCE = 16 /* surfaces a thread, between looks at the clock */ };

struct order {
	struct shape *shape;
	struct mesh_made made;
	double chord;
	enum status status;
};

struct orders {
	struct order *order;
	bool coarse;
	double seen; /* length by which a surface counts as small */
};

static double now(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static enum status cut_one(void *data, size_t unit, int thread)
{
	struct orders *all = data;
	struct order *o = &all->order[unit];
	(void)thread;
	/* bends of small surfaces are not seen */
	const double chords = box_diagonal(&o->shape->box) / all->seen;
	const double wide = fmax((all->coarse ? chords_coarse : chords_fine) / chords, 1);
	const double angle = fmin((all->coarse ? angle_coarse : angle_fine) * wide * wide, M_PI);
	o->status = mesh_made_init(&o->made, &o->shape->surface, &o->shape->trim, o->shape->origin,
	                           o->chord, angle);
	return ST_OK;
}

/* How many triangles a chord would give, from those there are: their number is as 1 / chord. */
static double foresee(const struct shape *x, double chord)
{
	const struct shape_mesh *known = x->fine.chord > 0 ? &x->fine : &x->coarse;
	return known->chord > 0 ? known->triangles * fmax(known->chord / chord, 1) : 0;
}

/* A mesh is good enough that is as fine as asked, or as fine as it may get; one that is much finer
 * than needed is kept. */
static bool good(const struct shape_mesh *m, double chord)
{
	return m->chord > 0 && m->chord <= 1.5 * chord;
}

static void finish_order(struct order *o, bool coarse)
{
	struct shape_mesh *m = coarse ? &o->shape->coarse : &o->shape->fine;
	m->failed = o->status != ST_OK;
	m->chord = o->chord;
	m->triangles = o->made.n_indices / 3;
	mesh_made_finish(&m->made);
	m->made = o->made;
	m->loaded = false;
	if (coarse)
		return;
	shape_mesh_gpu(m);
	mesh_made_finish(&m->made);
}

enum status shapes_cut(struct shape *const *shapes, int n, bool coarse, double chord, double seen,
                       int most, double seconds, bool *more)
{
	const double end = now() + seconds;
	const int threads = parallel_processors();
	double expected = 0;
	for (int i = 0; i < n; i++)
		expected += foresee(shapes[i], chord);
	chord *= fmax(expected / most, 1);
	const int room = AT_ONCE * threads;
	struct order *order = calloc((size_t)room, sizeof *order);
	if (!order)
		return ST_RESOURCE;
	struct orders all = { order, coarse, seen };
	enum status st = ST_OK;
	for (int i = 0; i < n && st == ST_OK;) {
		int k = 0;
		for (; i < n && k < room; i++)
			if (shapes[i]->surface.order[0] &&
			    !good(coarse ? &shapes[i]->coarse : &shapes[i]->fine, chord))
				order[k++] = (struct order){ .shape = shapes[i], .chord = chord };
		if (k && now() > end) {
			*more = true;
			break;
		}
		st = parallel_run(threads, (size_t)k, NULL, cut_one, &all);
		for (int j = 0; j < k; j++)
			finish_order(&order[j], coarse);
	}
	free(order);
	return st;
}

enum status shapes_cut_coarse(struct shapes *s, struct shape *const *shapes, int n, double chord,
                              int most)
{
	enum { TRIES = 4 };
	double before = INFINITY;
	enum status st = ST_OK;
	for (int k = 0; k < TRIES && st == ST_OK; k++) {
		bool more = false;
		double sum = 0;
		s->coarse_chord = fmax(s->coarse_chord, chord);
		st = shapes_cut(shapes, n, true, s->coarse_chord, chord, INT_MAX, INFINITY, &more);
		for (int i = 0; i < n; i++)
			sum += shapes[i]->coarse.triangles;
		/* those of few triangles each cannot have fewer */
		if (sum <= most || sum > 0.8 * before)
			break;
		before = sum;
		s->coarse_chord *= 1.2 * sum / most;
		for (int i = 0; i < n; i++)
			shapes[i]->coarse.chord = 0;
	}
	return st;
}
