/* export_mesh.c - surfaces as triangles in a file. */
#include "export_mesh.h"

#include <math.h>
#include <stdlib.h>

/* Of the diagonal of the box of all surfaces; what is finer than `finest` drowns in rounding. */
static const double default_tolerance = 1e-3, default_join = 1e-4, finest = 1e-11;

static const double default_angle = 15;

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

static enum status settle(const struct mesh_wishes *w, double size, struct mesh_figures *out,
                          const struct report *r)
{
	/* squares of lengths must be numbers */
	if (!(size > 1e-150 && size < 1e150))
		return report_error(
		        r, ST_INPUT,
		        "the surfaces are %g across; expected 1e-150 to 1e150, scale them", size);
	out->tolerance = w->tolerance > 0 ? w->tolerance : default_tolerance * size;
	out->angle = w->angle > 0 ? w->angle : default_angle;
	out->join = w->join > 0 ? w->join : default_join * size;
	if (out->tolerance < finest * size) {
		report_warning(
		        r, "a tolerance of %g is less than numbers of this size hold; %g is taken",
		        out->tolerance, finest * size);
		out->tolerance = finest * size;
	}
	/* beyond the size nothing changes */
	out->tolerance = fmin(out->tolerance, size);
	return ST_OK;
}

bool mesh_stopped(const struct mesh_labels *l)
{
	return l->stop && atomic_load_explicit(l->stop, memory_order_relaxed);
}

enum status mesh_commit(struct whole_file *f, const struct mesh_labels *l, const struct report *r)
{
	if (!mesh_stopped(l))
		return whole_file_commit(f, r);
	whole_file_abandon(f);
	return ST_CANCELLED;
}

void mesh_figures_finish(struct mesh_figures *f)
{
	mesh_looks_finish(&f->looks);
	*f = (struct mesh_figures){ 0 };
}

enum status export_mesh(const struct model *m, mesh_writer *write, const char *path,
                        const struct mesh_wishes *w, struct mesh_figures *out,
                        const struct report *r)
{
	const struct progress *p = w->progress;
	const struct tessellate_watch watch = { p ? p->step : NULL, p ? p->data : NULL,
		                                p ? p->stop : NULL };
	struct chosen x;
	struct mesh mesh = { 0 };
	*out = (struct mesh_figures){ 0 };
	enum status st = choose(m, &x);
	if (st != ST_OK)
		report_error(r, st, "memory ran out");
	else
		st = settle(w, x.size, out, r);
	if (st == ST_OK) {
		const struct tessellate_limits limits = { .chord = out->tolerance,
			                                  .angle = out->angle * M_PI / 180,
			                                  .join = out->join,
			                                  .orient = true };
		st = tessellate(&mesh, x.faces, x.n, &limits, &watch, r);
	}
	if (st == ST_OK && !mesh.n_triangles)
		st = report_error(
		        r, ST_INPUT,
		        "'%s' is not written: no surface named has an area within its trims "
		        "that a tolerance of %g lets see",
		        path, out->tolerance);
	if (st == ST_OK && mesh_look(&out->looks, &mesh) != ST_OK)
		st = report_error(r, ST_RESOURCE, "memory ran out");
	if (st == ST_OK) {
		const struct mesh_labels labels = { m->unit, x.names, watch.stop };
		out->triangles = mesh.n_triangles;
		out->points = mesh.n_points;
		out->gap = mesh.gap;
		st = write(&mesh, &labels, path, r);
	}
	mesh_finish(&mesh);
	free(x.faces);
	free(x.names);
	return st;
}
