/* ply.c - triangles as PLY. Source: Turk, The PLY Polygon File Format (1994). */
#include <stdlib.h>

#include "bytes_out.h"
#include "file.h"
#include "mesh_file.h"

/* A vertex there is a point and a normal: a normal of the mesh, which belongs to one point. */
static int *points_of_normals(const struct mesh *m)
{
	int *point = calloc((size_t)m->n_normals + 1, sizeof *point);
	for (int t = 0; point && t < m->n_triangles; t++)
		for (int k = 0; k < 3; k++)
			point[m->triangles[t][k].normal] = m->triangles[t][k].point;
	return point;
}

enum status ply_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r)
{
	struct whole_file w;
	int *point = points_of_normals(m);
	enum status st =
	        point ? whole_file_create(&w, path, r)
	              : report_error(r, ST_RESOURCE, "cannot write '%s': memory ran out", path);
	if (st != ST_OK) {
		free(point);
		return st;
	}
	FILE *f = w.stream;
	fprintf(f,
	        "ply\nformat binary_little_endian 1.0\ncomment batten\ncomment unit %s\n"
	        "element vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
	        "property float nx\nproperty float ny\nproperty float nz\n"
	        "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
	        l->unit ? l->unit : "not known", m->n_normals, m->n_triangles);
	for (int k = 0; k < m->n_normals; k++) {
		const struct vec3 p = m->points[point[k]], n = m->normals[k];
		put_double(f, p.x);
		put_double(f, p.y);
		put_double(f, p.z);
		put_float(f, n.x);
		put_float(f, n.y);
		put_float(f, n.z);
	}
	for (int t = 0; t < m->n_triangles; t++) {
		put_u64(f, 3, 1);
		for (int k = 0; k < 3; k++)
			put_u64(f, (uint64_t)m->triangles[t][k].normal, 4);
	}
	free(point);
	return whole_file_commit(&w, r);
}
