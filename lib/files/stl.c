/* stl.c - triangles as binary STL. */
#include "bytes_out.h"
#include "mesh_file.h"

enum { HEADER_BYTES = 80 };

static void put_vector(FILE *f, struct vec3 p)
{
	put_float(f, p.x);
	put_float(f, p.y);
	put_float(f, p.z);
}

static bool same_in_float(struct vec3 p, struct vec3 q)
{
	return (float)p.x == (float)q.x && (float)p.y == (float)q.y && (float)p.z == (float)q.z;
}

/* Two corners are one place in float. The edge between them goes with both triangles that have it,
 * so what was closed stays closed. */
static bool vanishes(const struct mesh *m, int t)
{
	struct vec3 p[3];
	for (int k = 0; k < 3; k++)
		p[k] = m->points[m->triangles[t][k].point];
	return same_in_float(p[0], p[1]) || same_in_float(p[1], p[2]) || same_in_float(p[2], p[0]);
}

enum status stl_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r)
{
	struct whole_file w;
	char header[HEADER_BYTES + 1] = "";
	int gone = 0;
	enum status st = whole_file_create(&w, path, r);
	if (st != ST_OK)
		return st;
	for (int t = 0; t < m->n_triangles; t++)
		gone += vanishes(m, t);
	/* not "solid", which begins the text form */
	snprintf(header, sizeof header, "batten, unit %s", l->unit ? l->unit : "not known");
	fwrite(header, 1, HEADER_BYTES, w.stream);
	put_u64(w.stream, (uint64_t)(m->n_triangles - gone), 4);
	for (int t = 0; t < m->n_triangles && (t % 4096 || !mesh_stopped(l)); t++) {
		struct vec3 p[3];
		if (vanishes(m, t))
			continue;
		for (int k = 0; k < 3; k++)
			p[k] = m->points[m->triangles[t][k].point];
		put_vector(w.stream,
		           vec3_unit(vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]))));
		for (int k = 0; k < 3; k++)
			put_vector(w.stream, p[k]);
		put_u64(w.stream, 0, 2);
	}
	if (gone)
		report_warning(
		        r,
		        "%d of %d triangles are left out of '%s': its numbers have seven digits "
		        "and their corners fall together; .ply and .obj hold them",
		        gone, m->n_triangles, path);
	return mesh_commit(&w, l, r);
}
