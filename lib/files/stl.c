/* stl.c - triangles as binary STL. */
#include "bytes_out.h"
#include "file.h"
#include "mesh_file.h"

enum { HEADER_BYTES = 80 };

static void put_vector(FILE *f, struct vec3 p)
{
	put_float(f, p.x);
	put_float(f, p.y);
	put_float(f, p.z);
}

enum status stl_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r)
{
	struct whole_file w;
	char header[HEADER_BYTES + 1] = "";
	enum status st = whole_file_create(&w, path, r);
	if (st != ST_OK)
		return st;
	/* not "solid", which begins the text form */
	snprintf(header, sizeof header, "batten, unit %s", l->unit ? l->unit : "not known");
	fwrite(header, 1, HEADER_BYTES, w.stream);
	put_u64(w.stream, (uint64_t)m->n_triangles, 4);
	for (int t = 0; t < m->n_triangles; t++) {
		struct vec3 p[3];
		for (int k = 0; k < 3; k++)
			p[k] = m->points[m->triangles[t][k].point];
		put_vector(w.stream,
		           vec3_unit(vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]))));
		for (int k = 0; k < 3; k++)
			put_vector(w.stream, p[k]);
		put_u64(w.stream, 0, 2);
	}
	return whole_file_commit(&w, r);
}
