/* obj.c - triangles as Wavefront OBJ. */
#include "mesh_file.h"
#include "number.h"
#include "text.h"

static void put_vector(FILE *f, const char *word, struct vec3 p)
{
	char x[3][NUMBER_SIZE];
	number_write(x[0], p.x);
	number_write(x[1], p.y);
	number_write(x[2], p.z);
	fprintf(f, "%s %s %s %s\n", word, x[0], x[1], x[2]);
}

/* A name is one word there. */
static void put_name(FILE *f, const char *name, int number)
{
	fputs("o ", f);
	if (!name || !*name)
		fprintf(f, "%d", number);
	for (; name && *name; name++)
		fputc((unsigned char)*name <= ' ' || *name == 0x7f ? '_' : *name, f);
	fputc('\n', f);
}

enum status obj_write(const struct mesh *m, const struct mesh_labels *l, const char *path,
                      const struct report *r)
{
	struct whole_file w;
	enum status st = whole_file_create(&w, path, r);
	if (st != ST_OK)
		return st;
	FILE *f = w.stream;
	fprintf(f, "# batten\n# unit %s\n", l->unit ? l->unit : "not known");
	for (int k = 0; k < m->n_points; k++)
		put_vector(f, "v", m->points[k]);
	for (int k = 0; k < m->n_normals; k++)
		put_vector(f, "vn", m->normals[k]);
	for (int k = 0; k < m->n_parts && !mesh_stopped(l); k++) {
		const struct mesh_part *p = &m->parts[k];
		put_name(f, l->names ? l->names[k] : NULL, k + 1);
		for (int t = p->first; t < p->first + p->count; t++) {
			const struct mesh_corner *c = m->triangles[t];
			fprintf(f, "f %d//%d %d//%d %d//%d\n", c[0].point + 1, c[0].normal + 1,
			        c[1].point + 1, c[1].normal + 1, c[2].point + 1, c[2].normal + 1);
		}
	}
	return mesh_commit(&w, l, r);
}
