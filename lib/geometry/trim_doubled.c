/* trim_doubled.c - a loop that a file gives twice is kept once.
 *
 * What counts crossings of all loops would find nothing between the two. Loops come settled: those
 * that are alike run in the same direction.
 */
#include <stdlib.h>

#include "trim_mender.h"

/* Places of loops, as one number: those alike have nearly the same. */
struct place {
	double key;
	int loop;
};

/* Of loops whose places are nearly the same so many are compared with each: many tiny ones may lie
 * within the tolerance. */
enum { COMPARED_MAX = 64 };

static int compare(const void *a, const void *b)
{
	const struct place *x = a, *y = b;
	int order = (x->key > y->key) - (x->key < y->key);
	return order ? order : (x->loop > y->loop) - (x->loop < y->loop);
}

/* From the lower corner of the box of its curves' ends. */
static double key_of(const struct mender *m, const struct trim_loop *l)
{
	/* holes in rows and columns do not share a number */
	const double weight[2] = { 1, 0.6180339887498949 };
	double lo[2] = { INFINITY, INFINITY }, sum = 0;
	for (int i = 0; i < l->n; i++) {
		double uv[2];
		trim_curve_end(&l->curves[i], 0, uv);
		for (int d = 0; d < 2; d++)
			lo[d] = fmin(lo[d], uv[d]);
	}
	for (int d = 0; d < 2; d++)
		sum += weight[d] * lo[d] / m->length[d];
	return sum;
}

static bool curves_alike(const struct mender *m, const struct curve *a, const struct curve *b)
{
	const int n = 2 * (a->n > b->n ? a->n : b->n);
	for (int i = 0; i <= n; i++) {
		const double t = (double)i / n;
		struct vec3 p = curve_point(a, (1 - t) * a->domain[0] + t * a->domain[1]);
		struct vec3 q = curve_point(b, (1 - t) * b->domain[0] + t * b->domain[1]);
		if (!(fabs(p.x - q.x) <= m->near[0] && fabs(p.y - q.y) <= m->near[1]))
			return false;
	}
	return true;
}

/* The same curves one after the other, wherever each loop begins. */
static bool loops_alike(const struct mender *m, const struct trim_loop *a,
                        const struct trim_loop *b)
{
	if (a->n != b->n || a->outer != b->outer)
		return false;
	for (int first = 0; first < a->n; first++) {
		int i = 0;
		while (i < a->n && curves_alike(m, &a->curves[i], &b->curves[(first + i) % a->n]))
			i++;
		if (i == a->n)
			return true;
	}
	return false;
}

enum status trim_drop_doubled(struct mender *m, struct trim *t)
{
	const double near = m->near[0] / m->length[0] + m->near[1] / m->length[1];
	struct place *places = malloc(((size_t)t->n + 1) * sizeof *places);
	bool *dropped = calloc((size_t)t->n + 1, sizeof *dropped);
	const enum status st = places && dropped ? ST_OK : ST_RESOURCE;
	int kept = 0;
	if (st != ST_OK)
		goto out;
	for (int i = 0; i < t->n; i++)
		places[i] = (struct place){ key_of(m, &t->loops[i]), i };
	qsort(places, t->n, sizeof *places, compare);
	for (int i = 0; i < t->n; i++) {
		if (dropped[places[i].loop])
			continue;
		int compared = 0;
		for (int k = i + 1; k < t->n && places[k].key - places[i].key <= near; k++) {
			const int a = places[i].loop, b = places[k].loop;
			if (dropped[b])
				continue;
			if (compared++ == COMPARED_MAX)
				break;
			dropped[b] = loops_alike(m, &t->loops[a], &t->loops[b]);
			compared -= dropped[b];
		}
	}
	for (int i = 0; i < t->n; i++) {
		if (dropped[i])
			trim_loop_finish(&t->loops[i]);
		else
			t->loops[kept++] = t->loops[i];
	}
	m->doubled = t->n - kept;
	t->n = kept;
out:
	free(places);
	free(dropped);
	return st;
}
