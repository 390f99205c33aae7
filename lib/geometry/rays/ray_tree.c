/* ray_tree.c - the tree from the root down, each part cut where the surface areas of the two boxes
 * times what lies in them are least.
 *
 * Source: Wald, On fast construction of SAH-based bounding volume hierarchies (RT 2007).
 */
#include "ray_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 16 };

/* Below this depth parts are halved by number, so that the tree ends before TREE_DEPTH. */
enum { DEPTH_BY_AREA = 26 };

/* What the tree is built of, moved about while it is. */
struct item {
	float lo[3], hi[3];
	uint32_t leaf;
};

/* Items first .. first + n - 1: their box, and that of their boxes' middles, doubled. */
struct part {
	size_t first, n;
	struct ray_bounds box, middles;
};

struct builder {
	struct ray_tree *tree;
	struct item *items; /* owned */
	size_t memory;
};

static float smaller(float a, float b)
{
	return a < b ? a : b;
}

static float larger(float a, float b)
{
	return a > b ? a : b;
}

static struct ray_bounds nothing(void)
{
	return (struct ray_bounds){ { INFINITY, INFINITY, INFINITY },
		                    { -INFINITY, -INFINITY, -INFINITY } };
}

static void bounds_add(struct ray_bounds *b, const float lo[3], const float hi[3])
{
	for (int e = 0; e < 3; e++) {
		b->lo[e] = smaller(b->lo[e], lo[e]);
		b->hi[e] = larger(b->hi[e], hi[e]);
	}
}

static float bounds_area(const struct ray_bounds *b)
{
	float x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];

	return x * y + y * z + z * x;
}

static void part_measure(const struct builder *b, struct part *p)
{
	p->box = p->middles = nothing();
	for (size_t i = p->first; i < p->first + p->n; i++) {
		const struct item *item = &b->items[i];
		float middle[3];

		for (int e = 0; e < 3; e++)
			middle[e] = item->lo[e] + item->hi[e];
		bounds_add(&p->box, item->lo, item->hi);
		bounds_add(&p->middles, middle, middle);
	}
}

/* Places 0 .. BINS - 1 of middles along axis e. */
struct bins {
	float from, scale;
};

static struct bins bins_of(const struct part *p, int e)
{
	float length = p->middles.hi[e] - p->middles.lo[e];

	return (struct bins){ p->middles.lo[e], length > 1e-30f ? BINS * 0.9999f / length : 0 };
}

static int bin_of(const struct bins *b, const struct item *item, int e)
{
	return (int)((item->lo[e] + item->hi[e] - b->from) * b->scale);
}

/* Where to cut: items of bins below `bin` along axis; axis -1: nowhere, all are in one place. */
struct cut {
	int axis, bin;
};

static struct cut part_best_cut(const struct builder *b, const struct part *p)
{
	struct ray_bounds box[3][BINS];
	size_t count[3][BINS] = { { 0 } };
	struct bins bins[3];
	struct cut best = { -1, 0 };
	float least = INFINITY;

	for (int e = 0; e < 3; e++) {
		bins[e] = bins_of(p, e);
		for (int k = 0; k < BINS; k++)
			box[e][k] = nothing();
	}
	for (size_t i = p->first; i < p->first + p->n; i++)
		for (int e = 0; e < 3; e++) {
			int k = bin_of(&bins[e], &b->items[i], e);

			count[e][k]++;
			bounds_add(&box[e][k], b->items[i].lo, b->items[i].hi);
		}
	for (int e = 0; e < 3; e++) {
		float above[BINS];
		struct ray_bounds all = nothing();
		size_t n = 0;

		for (int k = BINS - 1; k > 0; k--) {
			n += count[e][k];
			bounds_add(&all, box[e][k].lo, box[e][k].hi);
			above[k] = n ? bounds_area(&all) * (float)n : INFINITY;
		}
		all = nothing();
		n = 0;
		for (int k = 1; k < BINS; k++) {
			n += count[e][k - 1];
			bounds_add(&all, box[e][k - 1].lo, box[e][k - 1].hi);
			if (n == 0)
				continue;
			float cost = bounds_area(&all) * (float)n + above[k];
			if (cost < least) {
				least = cost;
				best = (struct cut){ e, k };
			}
		}
	}
	return best;
}

/* In two; the lower one stays in p. */
static void part_split(struct builder *b, struct part *p, struct part *upper, bool by_area)
{
	struct cut cut = by_area ? part_best_cut(b, p) : (struct cut){ -1, 0 };
	size_t below = p->n / 2;

	if (cut.axis >= 0) {
		struct bins bins = bins_of(p, cut.axis);
		size_t end = p->first + p->n;

		below = 0;
		for (size_t i = p->first; i < end;) {
			struct item *item = &b->items[i];

			if (bin_of(&bins, item, cut.axis) < cut.bin) {
				below++;
				i++;
				continue;
			}
			struct item moved = *item;
			*item = b->items[--end];
			b->items[end] = moved;
		}
	}
	*upper = (struct part){ .first = p->first + below, .n = p->n - below };
	p->n = below;
	part_measure(b, p);
	part_measure(b, upper);
}

static enum status tree_room(struct builder *b)
{
	struct ray_tree *t = b->tree;
	if (t->n < t->capacity)
		return ST_OK;

	size_t capacity = t->capacity ? t->capacity + t->capacity / 2 : 64;
	if (capacity >= TREE_LEAF || (b->memory && capacity * sizeof *t->nodes > b->memory))
		return ST_RESOURCE;
	struct ray_node *nodes = aligned_alloc(32, capacity * sizeof *nodes);
	if (!nodes)
		return ST_RESOURCE;
	if (t->n)
		memcpy(nodes, t->nodes, t->n * sizeof *nodes);
	free(t->nodes);
	t->nodes = nodes;
	t->capacity = capacity;
	return ST_OK;
}

/* The largest is cut next; one item is not to be cut. */
static int part_to_cut(const struct part *parts, int n, bool by_area)
{
	float most = -1;
	int found = -1;

	for (int k = 0; k < n; k++) {
		float size = by_area ? bounds_area(&parts[k].box) : (float)parts[k].n;

		if (parts[k].n > 1 && size > most) {
			most = size;
			found = k;
		}
	}
	return found;
}

static enum status node_build(struct builder *b, struct part whole, int depth, uint32_t *number)
{
	struct part parts[TREE_WIDE] = { whole };
	bool by_area = depth < DEPTH_BY_AREA;
	int n = 1;
	enum status st = tree_room(b);
	if (st != ST_OK)
		return st;

	*number = (uint32_t)b->tree->n++;
	for (int k; n < TREE_WIDE && (k = part_to_cut(parts, n, by_area)) >= 0; n++)
		part_split(b, &parts[k], &parts[n], by_area);

	struct ray_node node;
	const struct ray_bounds none = nothing();
	for (int k = 0; k < TREE_WIDE; k++) {
		const struct ray_bounds *box = k < n ? &parts[k].box : &none;

		for (int e = 0; e < 3; e++) {
			node.side[e][k] = box->lo[e];
			node.side[3 + e][k] = box->hi[e];
		}
		node.child[k] = TREE_LEAF;
		if (k < n && parts[k].n == 1)
			node.child[k] |= b->items[parts[k].first].leaf;
		else if (k < n)
			st = node_build(b, parts[k], depth + 1, &node.child[k]);
		if (st != ST_OK)
			return st;
	}
	b->tree->nodes[*number] = node;
	return ST_OK;
}

enum status ray_tree_init(struct ray_tree *t, const struct ray_bounds *bounds, size_t n,
                          size_t memory)
{
	struct builder b = { .tree = t, .memory = memory };
	struct part whole = { .n = n };
	uint32_t root;

	*t = (struct ray_tree){ .nodes = NULL };
	if (n >= TREE_LEAF || (memory && n * sizeof *b.items >= memory))
		return ST_RESOURCE;
	b.items = malloc(n * sizeof *b.items);
	if (!b.items)
		return ST_RESOURCE;
	if (memory)
		b.memory -= n * sizeof *b.items;
	for (size_t i = 0; i < n; i++) {
		memcpy(b.items[i].lo, bounds[i].lo, sizeof bounds[i].lo);
		memcpy(b.items[i].hi, bounds[i].hi, sizeof bounds[i].hi);
		b.items[i].leaf = (uint32_t)i;
	}
	part_measure(&b, &whole);
	enum status st = node_build(&b, whole, 0, &root);
	free(b.items);
	if (st != ST_OK) {
		ray_tree_finish(t);
		return st;
	}
	struct ray_node *nodes = aligned_alloc(32, t->n * sizeof *nodes);
	if (nodes) { /* without what growing took too much */
		memcpy(nodes, t->nodes, t->n * sizeof *nodes);
		free(t->nodes);
		t->nodes = nodes;
		t->capacity = t->n;
	}
	return ST_OK;
}

void ray_tree_finish(struct ray_tree *t)
{
	free(t->nodes);
	*t = (struct ray_tree){ .nodes = NULL };
}
