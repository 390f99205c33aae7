/* ply.c - triangles as PLY. Source: Turk, The PLY Polygon File Format (1994). */
#include <stdlib.h>

#include "bytes_out.h"
#include "mesh_file.h"

/* A vertex there is a point and a normal, so a point that has several gets their mean: with a vertex for
 * each the triangles of two sides of a sharp edge would not hang together. */
static struct vec3 *mean_normals(const struct mesh *m)
{
	struct vec3 *mean = calloc((size_t)m->n_points + 1, sizeof *mean);
	bool *seen = calloc((size_t)m->n_normals + 1, sizeof *seen);
	for (int t = 0; mean && seen && t < m->n_triangles; t++)
		for (int k = 0; k < 3; k++) {
			const struct mesh_corner c = m->triangles[t][k];
			if (!seen[c.normal])
				mean[c.point] = vec3_add(mean[c.point], m->normals[c.normal]);
			seen[c.normal] = true;
		}
	/* of sides that face each other there is no mean: the last one's */
	for (int t = 0; mean && seen && t < m->n_triangles; t++)
		for (int k = 0; k < 3; k++) {
			const struct mesh_corner c = m->triangles[t][k];
			if (!(vec3_length(mean[c.point]) > 1e-6))
				mean[c.point] = m->normals[c.normal];
		}
	if (!seen) {
		free(mean);
		mean = NULL;
	}
	free(seen);
	return mean;
}

enum status ply_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r)
{
	struct whole_file w;
	struct vec3 *normals = mean_normals(m);
	enum status st =
	        normals ? whole_file_create(&w, path, r)
	                : report_error(r, ST_RESOURCE, "cannot write '%s': memory ran out", path);
	if (st != ST_OK) {
		free(normals);
		return st;
	}
	FILE *f = w.stream;
	fprintf(f,
	        "ply\nformat binary_little_endian 1.0\ncomment batten\ncomment unit %s\n"
	        "element vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
	        "property float nx\nproperty float ny\nproperty float nz\n"
	        "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
	        l->unit ? l->unit : "not known", m->n_points, m->n_triangles);
	for (int k = 0; k < m->n_points && (k % 4096 || !mesh_stopped(l)); k++) {
		const struct vec3 p = m->points[k], n = vec3_unit(normals[k]);
		put_double(f, p.x);
		put_double(f, p.y);
		put_double(f, p.z);
		put_float(f, n.x);
		put_float(f, n.y);
		put_float(f, n.z);
	}
	for (int t = 0; t < m->n_triangles && (t % 4096 || !mesh_stopped(l)); t++) {
		put_u64(f, 3, 1);
		for (int k = 0; k < 3; k++)
			put_u64(f, (uint64_t)m->triangles[t][k].point, 4);
	}
	free(normals);
	return mesh_commit(&w, l, r);
}
