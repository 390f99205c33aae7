/* iges_write.c - sections of an IGES file put together, in memory or on the disk. */
#include "iges_writer.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"

enum { BLOCK = 1 << 16 };

static void put_terminate(const struct iges_writer *w, int n_s, int n_g, struct text *out)
{
	text_addf(out, "S%7dG%7dD%7dP%7d%40sT%7d\n", n_s, n_g, w->n_d, w->n_p, "", 1);
}

static void writer_finish(struct iges_writer *w)
{
	text_finish(&w->directory);
	text_finish(&w->data);
	text_finish(&w->line);
	free(w->members);
}

void iges_format(const struct model *m, struct text *out)
{
	struct iges_writer w = { 0 };
	bool good = iges_put_model(&w, m);
	int n_s = iges_put_start(out);
	int n_g = iges_put_global(m, out);
	text_add_bytes(out, w.directory.s, w.directory.n);
	text_add_bytes(out, w.data.s, w.data.n);
	put_terminate(&w, n_s, n_g, out);
	out->failed |= !good;
	writer_finish(&w);
}

/* All of `from` behind what is in `to`. */
static void append_file(FILE *to, FILE *from)
{
	char block[BLOCK];
	size_t n;
	rewind(from);
	while ((n = fread(block, 1, sizeof block, from)) > 0)
		fwrite(block, 1, n, to);
}

/*
 * The directory stands before the data but is known only after them, so the data go to a file beside it first.
 */
static enum status write_parts(const struct model *m, struct whole_file *out,
                               struct whole_file *data, const struct report *r)
{
	struct iges_writer w = { .directory_to = out->stream, .data_to = data->stream };
	struct text t = { 0 };
	enum status st = ST_OK;
	int n_s = iges_put_start(&t);
	int n_g = iges_put_global(m, &t);
	iges_let_go(&t, out->stream, 0);
	if (!iges_put_model(&w, m) || t.failed)
		st = report_error(r, ST_RESOURCE,
		                  "cannot write '%s': no memory, or more lines than IGES can "
		                  "number (9999999)",
		                  out->path);
	iges_let_go(&w.directory, out->stream, 0);
	iges_let_go(&w.data, data->stream, 0);
	if (st == ST_OK && (fflush(data->stream) || ferror(data->stream)))
		st = report_error(r, ST_RESOURCE, "cannot write '%s': %s", out->path,
		                  strerror(errno));
	if (st == ST_OK) {
		append_file(out->stream, data->stream);
		if (ferror(data->stream))
			st = report_error(r, ST_RESOURCE, "cannot write '%s': %s", out->path,
			                  strerror(errno));
		put_terminate(&w, n_s, n_g, &t);
		iges_let_go(&t, out->stream, 0);
	}
	writer_finish(&w);
	text_finish(&t);
	return st;
}

enum status iges_write(const struct model *m, const char *path, const struct report *r)
{
	struct whole_file out, data;
	if (!m->unit)
		report_warning(r, "the geometry has no unit; '%s' says millimetres, IGES wants one",
		               path);
	enum status st = whole_file_create(&out, path, r);
	if (st != ST_OK)
		return st;
	st = whole_file_create(&data, path, r);
	if (st == ST_OK)
		st = write_parts(m, &out, &data, r);
	whole_file_abandon(&data);
	if (st == ST_OK)
		return whole_file_commit(&out, r);
	whole_file_abandon(&out);
	return st;
}
