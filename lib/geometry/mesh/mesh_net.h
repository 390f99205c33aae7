/* mesh_net.h - a constrained Delaunay triangulation of points with whole coordinates. Private to this
 * folder.
 *
 * Coordinates stay below 2^28, so that both tests (which side of a line, inside a circle) are exact.
 * Source: Lawson (1977) for flips, Sloan (1993) for edges that must be there.
 */
#ifndef BATTEN_MESH_NET_H
#define BATTEN_MESH_NET_H

#include <stdbool.h>
#include <stdint.h>

#include "report.h"

enum { NET_SIDE = 1 << 28 };

/* Of an edge: it must stay; inside is on one side of it only. */
enum { NET_FIXED = 1, NET_BORDER = 2 };

struct net_triangle {
	int v[3];              /* counterclockwise */
	int next[3];           /* the triangle across from v[i]; -1: none */
	unsigned char edge[3]; /* flags of the edge across from v[i] */
	bool inside;           /* of the border; net_classify */
	bool done;             /* for the caller; false whenever the triangle changes */
};

struct net {
	int32_t (*at)[2]; /* owned; the first four vertices are a frame about all */
	int *of;          /* owned; a triangle at each vertex */
	int n, room, of_room;
	struct net_triangle *triangles; /* owned */
	int n_triangles, triangles_room;
	int *stack; /* owned; triangles to look at */
	int n_stack, stack_room;
	int last; /* triangle found last: walks begin there */
};

enum status net_init(struct net *x);
void net_finish(struct net *x);

/* Add a point; *vertex is the one that was there already, if any. Errors: ST_RESOURCE. */
enum status net_add(struct net *x, int32_t px, int32_t py, int *vertex);

/* Add a point that lies in the closed triangle t or not at all: *vertex is -1 where it does not, or
 * lies on a vertex or on an edge that is fixed. Errors: ST_RESOURCE. */
enum status net_add_in(struct net *x, int t, int32_t px, int32_t py, int *vertex);

/* Make the segment a b an edge with these flags; flags NET_BORDER given twice cancel out. Vertices
 * on it part it. Errors: ST_INPUT (it crosses a fixed edge), ST_RESOURCE. */
enum status net_fix(struct net *x, int a, int b, unsigned char flags);

/* The same, no farther than to the first vertex on it, *to: b or one before it. crossed: where it fails
 * for that, the fixed edge's vertices. */
enum status net_fix_first(struct net *x, int a, int *to, unsigned char flags, int crossed[2]);

/* What is left of the edge from a to b: 1 inside, 0 outside; -1: there is no such edge. */
int net_inside_left(const struct net *x, int a, int b);

/* Find which triangles are inside: across an odd number of border edges from the frame.
 * Errors: ST_RESOURCE. */
enum status net_classify(struct net *x);

/* The edge a b is there and fixed; a is none of the frame's. */
bool net_is_fixed(const struct net *x, int a, int b);

/* The vertex beyond the edge across from corner i of t, which can be turned; -1: it cannot. */
int net_beyond(const struct net *x, int t, int i);
/* Turn that edge. */
void net_turn(struct net *x, int t, int i);

/* The triangle that holds a point (any of them on an edge). */
int net_find(struct net *x, int32_t px, int32_t py);

#endif
