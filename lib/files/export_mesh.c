/* export_mesh.c - surfaces as triangles in a file. */
#include "export_mesh.h"

#include <math.h>
#include <stdlib.h>

/* Of the diagonal of the box of all surfaces. */
static const double default_tolerance = 1e-3, join_within = 1e-4;

/* The surfaces of a model and what they are called; both arrays have room for all entities. */
struct chosen {
	struct tessellate_face *faces; /* owned */
	const char **names;            /* owned; the names are borrowed */
	int n;
	double size;
};

static enum status choose(const struct model *m, struct chosen *x)
{
	struct box all = box_empty();
	enum status st = ST_OK;
	*x = (struct chosen){ .faces = calloc((size_t)m->n + 1, sizeof *x->faces),
		              .names = calloc((size_t)m->n + 1, sizeof *x->names) };
	if (!x->faces || !x->names)
		return ST_RESOURCE;
	for (int k = 0; k < m->n && st == ST_OK; k++) {
		const struct entity *e = &m->entities[k];
		struct box box;
		if (e->kind != ENTITY_SURFACE)
			continue;
		st = entity_box(e, &box);
		box_add_box(&all, &box);
		x->faces[x->n] = (struct tessellate_face){ &e->geometry, &e->trim };
		x->names[x->n++] = e->name;
	}
	x->size = box_diagonal(&all);
	return st;
}

enum status export_mesh(const struct model *m, mesh_writer *write, const char *path,
                        double tolerance, double angle, struct mesh_figures *out,
                        const struct report *r)
{
	struct chosen x;
	struct mesh mesh = { 0 };
	enum status st = choose(m, &x);
	if (st != ST_OK)
		report_error(r, st, "memory ran out");
	if (!(tolerance > 0))
		tolerance = default_tolerance * x.size;
	const struct tessellate_limits limits = { .chord = tolerance,
		                                  .angle = angle * M_PI / 180,
		                                  .orient = true,
		                                  .join = join_within * x.size };
	if (st == ST_OK) {
		st = tessellate(&mesh, x.faces, x.n, &limits, NULL, r);
		if (st == ST_OK)
			st = mesh_open_edges(&mesh, &out->open_edges);
		if (st == ST_RESOURCE)
			report_error(r, st,
			             "memory ran out making triangles; give a larger "
			             "--tolerance");
	}
	if (st == ST_OK) {
		const struct mesh_labels labels = { m->unit, x.names };
		out->triangles = mesh.n_triangles;
		out->points = mesh.n_points;
		out->tolerance = tolerance;
		out->angle = angle;
		st = write(&mesh, &labels, path, r);
	}
	mesh_finish(&mesh);
	free(x.faces);
	free(x.names);
	return st;
}
