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
	/* IGES to splines in memory: how many things came of it. */
	int (*read_iges)(const char *path);
};

#ifdef HAVE_SISL
extern const struct peer peer_sisl;
#endif
#ifdef HAVE_OCCT
extern const struct peer peer_occt;
#endif

#ifdef __cplusplus
}
#endif

#endif
