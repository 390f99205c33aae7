/* model_write.c - the formats geometry is written in. */
#include "model_write.h"

#include <strings.h>

#include "base.h"
#include "csv.h"
#include "g2.h"
#include "iges.h"
#include "path.h"

static bool any(const struct entity *e)
{
	(void)e;
	return true;
}

static bool is_surface(const struct entity *e)
{
	return e->kind == ENTITY_SURFACE;
}

static bool is_points(const struct entity *e)
{
	return e->kind == ENTITY_POINTS;
}

static const struct model_format formats[] = {
	{ ".base", "all geometry", true, any, base_write, NULL },
	{ ".csv", "points", false, is_points, csv_write, NULL },
	{ ".g2", "curves, surfaces and points in space", false, g2_holds, g2_write, NULL },
	{ ".iges", "curves, surfaces and points in space", false, iges_holds, iges_write, NULL },
	{ ".igs", "curves, surfaces and points in space", false, iges_holds, iges_write, NULL },
	{ ".obj", "surfaces as triangles", false, is_surface, NULL, obj_write },
	{ ".ply", "surfaces as triangles", false, is_surface, NULL, ply_write },
	{ ".stl", "surfaces as triangles", false, is_surface, NULL, stl_write },
};

const struct model_format *model_format_find(const char *path, const struct report *r)
{
	const char *extension = path_extension(path);

	for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
		if (!strcasecmp(extension, formats[i].extension))
			return &formats[i];
	report_error(r, ST_PARAMETER,
	             "'%s': the extension says no format that can be written; there are .base .csv "
	             ".g2 .iges .igs .obj .ply .stl",
	             path);
	return NULL;
}

enum status model_write(const struct model *m, const struct model_format *format, const char *path,
                        const struct mesh_wishes *w, struct mesh_figures *f, const struct report *r)
{
	if (format->write_mesh)
		return export_mesh(m, format->write_mesh, path, w, f, r);
	return format->write(m, path, r);
}
