/* level_region.c - undecided boxes that touch are one region. */
#include "level_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int box_compare(const void *x, const void *y)
{
	const struct level_box *a = x, *b = y;
	for (int d = 0; d < 2; d++)
		if (a->lo[d] != b->lo[d])
			return a->lo[d] < b->lo[d] ? -1 : 1;
	return 0;
}

static size_t root_of(size_t *parent, size_t i)
{
	while (parent[i] != i)
		i = parent[i] = parent[parent[i]];
	return i;
}

static bool boxes_touch(const struct level_box *a, const struct level_box *b, const double near[2])
{
	for (int d = 0; d < 2; d++)
		if (a->lo[d] > b->hi[d] + near[d] || b->lo[d] > a->hi[d] + near[d])
			return false;
	return true;
}

/* The lowest of a region is its root, so that regions keep the order of their first boxes. */
static void region_unite(size_t *parent, size_t a, size_t b)
{
	a = root_of(parent, a);
	b = root_of(parent, b);
	if (a < b)
		parent[b] = a;
	else
		parent[a] = b;
}

/* Sweep along u; `active` are the boxes that the sweep has not left. */
static void regions_sweep(const struct level_box *b, size_t n, const double near[2], size_t *parent,
                          size_t *active)
{
	size_t n_active = 0;
	for (size_t i = 0; i < n; i++) {
		size_t kept = 0;
		parent[i] = i;
		for (size_t k = 0; k < n_active; k++) {
			size_t a = active[k];
			if (b[a].hi[0] + near[0] < b[i].lo[0])
				continue;
			active[kept++] = a;
			if (boxes_touch(&b[a], &b[i], near))
				region_unite(parent, a, i);
		}
		n_active = kept;
		active[n_active++] = i;
	}
}

static void region_add(struct level_box *to, const struct level_box *b)
{
	for (int d = 0; d < 2; d++) {
		to->lo[d] = smaller(to->lo[d], b->lo[d]);
		to->hi[d] = larger(to->hi[d], b->hi[d]);
	}
	to->flat = to->flat && b->flat;
}

enum status level_regions(const struct level *l, struct list *boxes, struct level_result *out)
{
	const struct bezier_net *net = &l->surface->net;
	struct level_box *b = boxes->p;
	size_t n = boxes->n, *parent, *active;
	double near[2];
	if (n == 0)
		return ST_OK;
	for (int d = 0; d < 2; d++)
		near[d] = 1e-9 * (net->breaks[d][net->spans[d]] - net->breaks[d][0]);
	qsort(b, n, sizeof *b, box_compare);
	out->undecided = malloc(sizeof *out->undecided * n);
	parent = malloc(sizeof *parent * 2 * n);
	if (!out->undecided || !parent) {
		free(parent);
		return ST_RESOURCE;
	}
	active = parent + n;
	regions_sweep(b, n, near, parent, active);
	size_t *place = active;
	for (size_t i = 0; i < n; i++) {
		size_t root = root_of(parent, i);
		if (root == i) {
			place[i] = out->n_undecided;
			out->undecided[out->n_undecided++] = b[i];
		} else {
			region_add(&out->undecided[place[root]], &b[i]);
		}
	}
	free(parent);
	return ST_OK;
}
