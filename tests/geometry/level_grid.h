/* level_grid.h - pieces of a level counted by changes of sign on a grid. */
#ifndef BATTEN_LEVEL_GRID_H
#define BATTEN_LEVEL_GRID_H

#include <stddef.h>

enum { GRID = 400, ROW = GRID + 1, EDGES = 2 * ROW * ROW };

static inline int edge_root(int *parent, int i)
{
	while (parent[i] != i)
		i = parent[i] = parent[parent[i]];
	return i;
}

/* Connected runs of the grid's edges on which f (ROW x ROW) changes sign; in a cell with four of
 * them the middle decides. Edges: along u, then along v. */
static inline size_t grid_pieces(const double *f, int *parent)
{
	size_t pieces = 0;
	for (int e = 0; e < EDGES; e++)
		parent[e] = e;
	for (int i = 0; i < GRID; i++)
		for (int j = 0; j < GRID; j++) {
			const double *g = f + i * ROW + j;
			const double corner[4] = { g[0], g[ROW], g[ROW + 1], g[1] };
			const int edge[4] = { i * ROW + j, ROW * ROW + (i + 1) * ROW + j,
				              i * ROW + j + 1, ROW * ROW + i * ROW + j };
			int hit[4], n = 0;
			for (int k = 0; k < 4; k++)
				if ((corner[k] < 0) != (corner[(k + 1) % 4] < 0))
					hit[n++] = edge[k];
			bool middle = g[0] + g[ROW] + g[ROW + 1] + g[1] < 0;
			int turn = n == 4 && middle != (g[0] < 0);
			for (int k = 0; k + 1 < n; k += 2)
				parent[edge_root(parent, hit[k + turn])] =
				        edge_root(parent, hit[(k + turn + 1) % 4]);
		}
	for (int i = 0; i < ROW; i++)
		for (int j = 0; j < ROW; j++) {
			int u = i * ROW + j, v = ROW * ROW + u;
			if (i < GRID && (f[u] < 0) != (f[u + ROW] < 0))
				pieces += edge_root(parent, u) == u;
			if (j < GRID && (f[u] < 0) != (f[u + 1] < 0))
				pieces += edge_root(parent, v) == v;
		}
	return pieces;
}

#endif
