/* mesh_private.h - what the files of the triangulation share.
 *
 * Faces are bounded by loops of edges; an edge is a piece of a curve in its face's u, v. Edges end in
 * vertices: the end of an edge and the start of the next in its loop are one, and so are the ends of
 * edges that are found to be one line in space. Such edges have one master, which is cut into
 * pieces; the others are cut at the same points.
 */
#ifndef BATTEN_MESH_PRIVATE_H
#define BATTEN_MESH_PRIVATE_H

#include "tessellate.h"

/* Of the domain: nearer to a crease counts as on it. */
#define MESH_ON_CREASE 1e-9

struct mesh_node {
	double t, uv[2];
	int point; /* in the mesh */
};

struct mesh_sample {
	double t;
	struct vec3 p;
};

struct mesh_edge {
	int face, next;         /* the edge behind it in its loop; -1: the last one */
	const struct curve *uv; /* borrowed; NULL: straight from a to b, parameter 0 to 1 */
	double a[2], b[2];
	double t[2];     /* from, to */
	int vertex[2];   /* at t[0], t[1]; see mesh_vertex_root */
	bool degenerate; /* one point in space */
	bool joined;     /* one line with other edges */
	bool ring;       /* of a master: it was joined as a line that ends where it began */
	int master;      /* the edge whose cuts it takes; itself where it has its own */
	bool reversed;   /* against the master's direction */
	struct mesh_sample *samples; /* owned; rising t, both ends among them */
	int n_samples;
	struct mesh_node *nodes; /* owned; from t[0] to t[1] */
	int n_nodes, nodes_room;
};

struct mesh_loop {
	int face, first; /* its first edge */
	bool outer;
};

/* Parameters at which a surface may have a sharp line. */
struct mesh_creases {
	double *at[2]; /* owned; rising, inside the domain */
	int n[2];
};

struct mesh_vertex {
	struct vec3 p;
	int root;  /* one that it was united with, or itself */
	int point; /* in the mesh; -1: not yet */
};

struct mesh_build {
	const struct tessellate_face *faces;
	int n_faces;
	const struct tessellate_limits *limits;
	const struct tessellate_watch *watch;
	const struct report *r;
	struct mesh *out;
	int points_room, normals_room, triangles_room, heads_room, parameters_room;
	int *same; /* owned; of each point one it was united with, or itself */
	int same_room;
	int *heads;       /* owned; of each point its first normal, -1: none; then next_normal */
	int *next_normal; /* owned */
	int next_room;
	struct mesh_edge *edges; /* owned */
	int n_edges, edges_room;
	struct mesh_loop *loops; /* owned; in order of faces */
	int n_loops, loops_room;
	int *first_loop; /* owned; of each face, and one behind the last */
	bool *turned;    /* owned; of each face: its triangles are to be turned about */
	struct mesh_creases *creases; /* owned; one a face */
	struct mesh_vertex *vertices; /* owned */
	int n_vertices, vertices_room;
	int *groups;  /* owned; members[groups[k]] .. [groups[k + 1] - 1] have edge k as master */
	int *members; /* owned */
	double gap;   /* the widest that was closed */
	int round;    /* of joining */
	bool parameters; /* of corners are kept */
	bool told;       /* why it cannot be was said */
};

/* The steps, for those who watch. */
enum mesh_stage { MESH_COLLECT, MESH_JOIN, MESH_CUT, MESH_UNCROSS, MESH_FILL, N_MESH_STAGES };

/* tessellate.c */
/* Number i of n of that stage comes; ST_CANCELLED: stop. Looks now and then only. */
enum status mesh_step(const struct mesh_build *b, enum mesh_stage stage, int i, int n);
enum status mesh_too_many(struct mesh_build *b); /* says so */
enum status mesh_grow(void **p, int *room, int n, size_t size);
enum status mesh_add_point(struct mesh_build *b, struct vec3 p, int *point);
int mesh_point_root(struct mesh_build *b, int point);
void mesh_point_unite(struct mesh_build *b, int point, int other);
/* The normal at that point, one of those there if it is the same. */
enum status mesh_add_normal(struct mesh_build *b, int point, struct vec3 normal, int *out);
enum status mesh_add_triangle(struct mesh_build *b, const struct mesh_corner corner[3],
                              const double uv[3][2]);

/* mesh_patch.c: creases part a surface into smooth patches. */
enum status mesh_find_creases(struct mesh_creases *c, const struct surface *s);
int mesh_patch_of(const struct mesh_creases *c, const double uv[2]);
/* The unit normal at the point of a patch next to uv, as seen from inside; NaN where there is none. */
struct vec3 mesh_patch_normal(const struct surface *s, const struct mesh_creases *c, int patch,
                              const double uv[2]);

/* mesh_line.c: an edge as a line in space. */
void mesh_edge_finish(struct mesh_edge *e);
void mesh_edge_uv(const struct mesh_build *b, const struct mesh_edge *e, double t, double uv[2]);
struct vec3 mesh_edge_point(const struct mesh_build *b, const struct mesh_edge *e, double t);
/* The parameter in [from, to] of the edge's point next to p; gives the distance. */
double mesh_edge_nearest(const struct mesh_build *b, const struct mesh_edge *e, struct vec3 p,
                         double from, double to, double *t);
/* How far the edge strays from the straight line between two of its points. */
double mesh_edge_stray(const struct mesh_build *b, const struct mesh_edge *e, double from,
                       double to);
double mesh_edge_length(const struct mesh_build *b, const struct mesh_edge *e, double from,
                        double to);
enum status mesh_edge_sample(struct mesh_build *b, struct mesh_edge *e);

/* mesh_edges.c: edges of all loops, cut at creases. */
enum status mesh_add_vertex(struct mesh_build *b, struct vec3 p, int *vertex);
enum status mesh_collect_edges(struct mesh_build *b);
/* Part edge number k at the m rising parameters t; vertex[i] is the vertex at t[i], -1: a new one. */
enum status mesh_edge_part(struct mesh_build *b, int k, const double *t, const int *vertex, int m);

/* mesh_join.c: edges that are one line in space, found in rounds. */
enum { MESH_ROUNDS = 11 };
enum status mesh_join(struct mesh_build *b);
int mesh_vertex_root(struct mesh_build *b, int vertex);
void mesh_vertex_unite(struct mesh_build *b, int vertex, int other);

/* mesh_touch.c: find where edges that are not joined yet run within `level` of each other, part them
 * there and unite the vertices. `leave`: also those that run along each other from an end of one
 * and then part ways where no other ends. */
enum status mesh_touch(struct mesh_build *b, double level, bool leave);
/* e runs within 2 level along m, piece e[0] .. e[1] along m[0] .. m[1]; then *reversed. */
bool mesh_runs_along(const struct mesh_build *b, const struct mesh_edge *e, const double et[2],
                     const struct mesh_edge *m, const double mt[2], double level, bool *reversed);

/* mesh_cut.c: nodes of every edge. */
enum status mesh_cut(struct mesh_build *b);

/* A node more in that piece of an edge, and so in all that share its points. */
enum status mesh_cut_more(struct mesh_build *b, int edge, int piece, double t);

/* mesh_border.c: cut edges finer where loops that were cut cross each other. */
enum status mesh_uncross(struct mesh_build *b);

/* mesh_face.c: the triangles of a face whose borders have been cut.
 * Errors: ST_INPUT (its loops cross each other), ST_RESOURCE, ST_CANCELLED. */
enum status mesh_fill(struct mesh_build *b, int face);

/* mesh_size.c: about how many triangles a face whose edges are sampled will have. */
double mesh_estimate(const struct mesh_build *b, int face);

/* mesh_orient.c: sides of faces, so that neighbours agree. */
enum status mesh_orient(struct mesh_build *b);

/* mesh_settle.c: points that were united, faces that were turned about, triangles that are nothing:
 * the mesh as it is given out. */
enum status mesh_settle(struct mesh_build *b);

#endif
