/* peer.h - what another program can do of what we measure. A peer that is not installed has no
 * entries; none is ever linked into the product. */
#ifndef BATTEN_BENCH_PEER_H
#define BATTEN_BENCH_PEER_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A surface as it is handed over: homogeneous points, v fastest. */
struct peer_net {
	int order[2], n[2];
	bool rational;
	const double *knots[2], *points;
};

/* Curves on a surface, as level.h has them. */
enum peer_field_kind {
	PEER_PLANE,      /* S . direction = value */
	PEER_CYLINDER,   /* distance from the line through `point` along `direction` = value */
	PEER_SILHOUETTE, /* N . direction = 0 */
	PEER_EYE,        /* N . (S - point) = 0 */
	PEER_ISOPHOTE,   /* N . direction = value */
};
struct peer_field {
	enum peer_field_kind kind;
	double direction[3], point[3], value; /* direction of length 1 */
	double tolerance;
};

/* One place of a curve that a peer found. */
typedef void peer_place(const double xyz[3], void *data);
enum { PEER_PLACES = 100 }; /* of each curve */

/* Every sum is of all results: of Gaussian curvatures, or of x + y + z. */
struct peer {
	const char *name, *version;
	void *(*surface)(const struct peer_net *net);
	void (*drop)(void *surface);
	/* n x n values at x, x; grid_sum: of those of the last call. */
	void (*grid_curvatures)(void *surface, const double *x, int n);
	void (*grid_points)(void *surface, const double *x, int n);
	double (*grid_sum)(void *surface);
	double (*points)(void *surface, const double *uv, int n);
	double (*curvatures)(void *surface, const double *uv, int n);
	/* K, H and the point; false where it has none. */
	bool (*curvature)(void *surface, double u, double v, double kh[2], double point[3]);
	/* Cubics; how many control points came of it. */
	int (*interpolate_curve)(const double *xyz, int n);
	int (*interpolate_surface)(const double *xyz, int n); /* n x n, x fastest */
	/* The offset along the normal, over the same parameters: a surface of the peer's, or NULL. */
	void *(*offset)(void *surface, double distance, double tolerance);
	void (*poles)(void *surface, int n[2]);
	/* How many curves; 0 where the peer does not know the kind. `place` may be NULL. */
	int (*curves)(void *surface, const struct peer_field *f, peer_place *place, void *data);
	/* IGES to splines in memory: how many things came of it. */
	int (*read_iges)(const char *path);
};

#ifdef HAVE_SISL
extern const struct peer peer_sisl;
#endif
#ifdef HAVE_OCCT
extern const struct peer peer_occt;
#endif

/* Those that are installed, at most BENCH_PEERS; NULL ends the list. */
extern const struct peer *const peers[];

#ifdef __cplusplus
}
#endif

#endif
