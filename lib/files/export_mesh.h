/* export_mesh.h - surfaces as triangles in a file. */
#ifndef BATTEN_EXPORT_MESH_H
#define BATTEN_EXPORT_MESH_H

#include "mesh_file.h"
#include "model.h"

/* Write the mesh as that format has it. */
typedef enum status mesh_writer(const struct mesh *m, const struct mesh_labels *l, const char *path,
                                const struct report *r);

/* What became of it. */
struct mesh_figures {
	int triangles, points, open_edges;
	double tolerance, angle; /* as used; file units, degrees */
};

/*
 * All surfaces of a model, trimmed where they have trims. tolerance 0: a thousandth of the diagonal
 * of their box. angle in degrees.
 */
enum status export_mesh(const struct model *m, mesh_writer *write, const char *path,
                        double tolerance, double angle, struct mesh_figures *out,
                        const struct report *r);

#endif
