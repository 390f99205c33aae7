/* mesh_file.h - triangles for other programs: OBJ, PLY, STL. Same mesh, same bytes. */
#ifndef BATTEN_MESH_FILE_H
#define BATTEN_MESH_FILE_H

#include "report.h"
#include "tessellate.h"

/* What a file says beside the triangles. */
struct mesh_labels {
	const char *unit;         /* borrowed; NULL: not known */
	const char *const *names; /* borrowed; of each part; NULL, or some of them NULL: none */
};

/*
 * Written as whole files. OBJ: text, points to the bit, normals, an object a part. PLY: binary,
 * little endian, points as double and normals as float. STL: binary, all as float, as that format
 * has it; its normals are the triangles' own.
 * Errors: ST_INPUT (folder missing, not writable), ST_RESOURCE.
 */
enum status obj_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r);
enum status ply_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r);
enum status stl_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r);

#endif
