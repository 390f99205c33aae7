/* mesh_face.h - one face being filled with triangles. Private to this folder. */
#ifndef BATTEN_MESH_FACE_H
#define BATTEN_MESH_FACE_H

#include "mesh_net.h"
#include "mesh_private.h"

/* A vertex of the net on the surface. */
struct mesh_place {
	double uv[2];
	struct vec3 p;
	int point;          /* in the mesh */
	int patch;          /* the smooth patch that `normal` is of; -1: none yet */
	struct vec3 normal; /* NaN where there is none */
};

struct mesh_face {
	struct mesh_build *b;
	const struct surface *s;
	const struct mesh_creases *creases;
	struct net net;
	double span[2];            /* mean length of a span in u and v */
	int32_t side[2];           /* of the domain in the net's coordinates */
	struct mesh_place *places; /* owned; of each vertex of the net, the frame's four unused */
	int places_room;
};

/* mesh_face.c */
void mesh_face_at(const struct mesh_face *f, const double uv[2], int32_t at[2]);
/* A vertex that is new to the net gets its place; point < 0: a new point of the mesh. */
enum status mesh_face_place(struct mesh_face *f, int vertex, const double uv[2], int point);
/* The normal at a vertex as seen from that patch; NaN where there is none. */
struct vec3 mesh_face_normal(struct mesh_face *f, int vertex, int patch);
/* The piece from vertex a to b, seen from that patch, is not yet near or smooth enough. */
bool mesh_face_coarse(struct mesh_face *f, int a, int b, int patch);

/* mesh_refine.c */
enum status mesh_face_creases(struct mesh_face *f);
enum status mesh_face_refine(struct mesh_face *f);

#endif
