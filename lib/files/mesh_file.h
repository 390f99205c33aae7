/* mesh_file.h - triangles for other programs: OBJ, PLY, STL. Same mesh, same bytes. */
#ifndef BATTEN_MESH_FILE_H
#define BATTEN_MESH_FILE_H

#include "file.h"
#include "report.h"
#include "tessellate.h"

/* What a file says beside the triangles. */
struct mesh_labels {
	const char *unit;         /* borrowed; NULL: not known */
	const char *const *names; /* borrowed; of each part; NULL, or some of them NULL: none */
	const atomic_bool *stop;  /* borrowed; NULL: nobody stops it */
};

/*
 * Written as whole files. OBJ: text, points to the bit, normals, an object a part. PLY: binary,
 * little endian, points as double and normals as float, the mean where a point has several. STL:
 * binary, all as float, as that format has it; its normals are the triangles' own. Triangles with
 * two corners in one place then are left out, with a warning.
 * Errors: ST_INPUT (folder missing, not writable), ST_RESOURCE, ST_CANCELLED.
 */
enum status obj_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r);
enum status ply_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r);
enum status stl_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r);

/* For the writers: put the file in place, or take it away if told to stop. */
enum status mesh_commit(struct whole_file *f, const struct mesh_labels *l, const struct report *r);
bool mesh_stopped(const struct mesh_labels *l);

#endif
