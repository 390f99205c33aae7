/* mesh_face.h - one face being filled with triangles. Private to this folder. */
#ifndef BATTEN_MESH_FACE_H
#define BATTEN_MESH_FACE_H

#include "mesh_net.h"
#include "mesh_private.h"

/* A vertex of the net on the surface. */
struct mesh_place {
	double uv[2];
	struct vec3 p;      /* of the surface; on a joined border the mesh's point is beside it */
	int point;          /* in the mesh */
	int patch;          /* the smooth patch that `normal` is of; -1: none yet */
	struct vec3 normal; /* NaN where there is none */
};

struct mesh_face {
	struct mesh_build *b;
	int face;
	const struct surface *s;
	const struct mesh_creases *creases;
	struct net net;
	double range[2][2];        /* of u and v that the loops reach */
	double span[2];            /* mean length of a span in u and v */
	int32_t side[2];           /* of the range in the net's coordinates */
	struct mesh_place *places; /* owned; of each vertex of the net, the frame's four unused */
	int places_room;
};

/* Pieces of edges whose straight lines in u, v cross each other, or pass through a node of others. */
struct mesh_flaws {
	struct mesh_flaw {
		int edge, piece; /* between its nodes piece, piece + 1 */
		double t;        /* put a node there; NaN: in the middle */
	} * list;                /* owned */
	int n, room;
	bool crossed;    /* some cross */
	bool wrong_side; /* a loop lies outside of one that it should lie in, or the other way */
};

/* mesh_face.c: with its measures, and an empty net. Errors: ST_RESOURCE. */
enum status mesh_face_init(struct mesh_face *f, struct mesh_build *b, int face);
void mesh_face_finish(struct mesh_face *f);
void mesh_face_at(const struct mesh_face *f, const double uv[2], int32_t at[2]);
/* A vertex that is new to the net gets its place; point < 0: a new point of the mesh. */
enum status mesh_face_place(struct mesh_face *f, int vertex, const double uv[2], int point);
/* The normal at a vertex as seen from that patch; NaN where there is none. */
struct vec3 mesh_face_normal(struct mesh_face *f, int vertex, int patch);
/* The piece from vertex a to b, seen from that patch, is not yet near or smooth enough. */
bool mesh_face_coarse(struct mesh_face *f, int a, int b, int patch);

/* mesh_size.c: range, span, side. */
void mesh_face_measure(struct mesh_face *f);

/* mesh_border.c: the loops in the net, what is inside of them, and what is wrong. Nodes that are one
 * place in the net become one point. Errors: ST_RESOURCE. */
enum status mesh_face_border(struct mesh_face *f, struct mesh_flaws *flaws);
void mesh_flaws_finish(struct mesh_flaws *flaws);

/* mesh_refine.c */
enum status mesh_face_creases(struct mesh_face *f);
enum status mesh_face_refine(struct mesh_face *f);

#endif
