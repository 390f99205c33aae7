/* export_mesh.h - surfaces as triangles in a file. */
#ifndef BATTEN_EXPORT_MESH_H
#define BATTEN_EXPORT_MESH_H

#include "mesh_file.h"
#include "mesh_look.h"
#include "model.h"

/* Write the mesh as that format has it. */
typedef enum status mesh_writer(const struct mesh *m, const struct mesh_labels *l, const char *path,
                                const struct report *r);

/* What is asked for; what is 0 is chosen. */
struct mesh_wishes {
	double tolerance;                /* file units; a thousandth of the diagonal of the box */
	double angle;                    /* degrees; 15 */
	double join;                     /* file units; a ten-thousandth of the diagonal */
	const struct progress *progress; /* NULL: nobody watches */
};

/* What became of it. */
struct mesh_figures {
	int triangles, points;
	struct mesh_looks looks;
	double tolerance, angle, join; /* as used */
	double gap;                    /* the widest that was closed */
};

void mesh_figures_finish(struct mesh_figures *f); /* a zeroed one is fine */

/* All surfaces of a model, trimmed where they have trims; parts of the mesh in their order. *out is the
 * caller's to finish, after a failure too.
 * Errors: ST_INPUT (nothing that could be seen as an area, sizes beyond numbers, not writable), ST_RESOURCE
 * (also: more than TESSELLATE_MOST triangles), ST_CANCELLED. */
enum status export_mesh(const struct model *m, mesh_writer *write, const char *path,
                        const struct mesh_wishes *w, struct mesh_figures *out,
                        const struct report *r);

#endif
