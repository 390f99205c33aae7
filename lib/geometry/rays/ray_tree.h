/* ray_tree.h - boxes in boxes, eight a node, over what rays are to meet. Private to the rays library. */
#ifndef BATTEN_RAY_TREE_H
#define BATTEN_RAY_TREE_H

#include <stddef.h>
#include <stdint.h>

#include "ray_leaf.h"

enum {
	TREE_WIDE = 8,
	/* Nodes from the root down, at most; a walk has the others of each node still before it. */
	TREE_DEPTH = 40,
	TREE_STACK = (TREE_WIDE - 1) * TREE_DEPTH + 1,
};

/* A child that is a leaf; the other bits are its number. */
#define TREE_LEAF 0x80000000u

/* Empty places have boxes that nothing meets, and stand last. */
struct ray_node {
	float side[6][TREE_WIDE]; /* of each child's box: low x y z, high x y z */
	uint32_t child[TREE_WIDE];
} __attribute__((aligned(32)));

struct ray_tree {
	struct ray_node *nodes; /* owned; the first is the root */
	size_t n, capacity;
};

/*
 * Over boxes 0 .. n - 1, n at least 1. memory: bytes that building may take, 0 for no limit.
 * Errors: ST_RESOURCE.
 */
enum status ray_tree_init(struct ray_tree *t, const struct ray_bounds *bounds, size_t n,
                          size_t memory);
void ray_tree_finish(struct ray_tree *t);

#endif
