/* model_write.h - the formats geometry is written in, by the extension of the file. */
#ifndef BATTEN_MODEL_WRITE_H
#define BATTEN_MODEL_WRITE_H

#include "export_mesh.h"

/* A format: who writes it, and which entities it can hold. */
struct model_format {
	const char *extension, *holds;
	bool all; /* it keeps everything: what entities are made of, too */
	bool (*takes)(const struct entity *e);
	enum status (*write)(const struct model *m, const char *path, const struct report *r);
	mesh_writer *write_mesh; /* of a format of triangles; `write` is NULL then */
};

/* Errors: NULL, and the sentence names all extensions. */
const struct model_format *model_format_find(const char *path, const struct report *r);

/* Write what the format takes; what it does not must have been left out by the caller.
 * *f is set for triangles only; the caller finishes it. */
enum status model_write(const struct model *m, const struct model_format *format, const char *path,
                        const struct mesh_wishes *w, struct mesh_figures *f,
                        const struct report *r);

#endif
