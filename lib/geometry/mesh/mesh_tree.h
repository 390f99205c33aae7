/* mesh_tree.h - pieces of edges by where they are. Private to this folder. */
#ifndef BATTEN_MESH_TREE_H
#define BATTEN_MESH_TREE_H

#include "box.h"
#include "mesh_private.h"

/* A few samples of an edge, one after the other. */
struct mesh_piece {
	struct box box; /* of the curve between them */
	int edge, first, last;
};

struct mesh_tree {
	struct mesh_piece
	        *pieces;   /* owned; each half of a range is on its side of the middle one */
	struct box *boxes; /* owned; of the range that has that one in its middle */
	int n, room;
};

/* Of all edges that are not joined and not one point. Errors: ST_RESOURCE. */
enum status mesh_tree_init(struct mesh_tree *x, const struct mesh_build *b);
void mesh_tree_finish(struct mesh_tree *x);

/* Pieces whose boxes come nearer to p than `within`: their numbers into *found, in order of edges and
 * samples. Errors: ST_RESOURCE. */
enum status mesh_tree_near(const struct mesh_tree *x, struct vec3 p, double within, int **found,
                           int *room, int *n);

#endif
