/* worker_output.c - what a computation leaves: attributes, figures, files that appear whole. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base.h"
#include "exr.h"
#include "file.h"
#include "json.h"
#include "parallel.h"
#include "path.h"
#include "worker_image.h"
#include "worker_private.h"

static const char param_prefix[] = "param.";

/* Larger text outputs are not looked into: they are made again. Bytes. */
static const uint64_t text_output_max = (uint64_t)1 << 30;

static enum status add(struct work_private *p, const char *prefix, const char *name,
                       const char *value)
{
	struct work_attribute *list =
	        realloc(p->attributes, (size_t)(p->n_attributes + 1) * sizeof *list);
	if (!list)
		return ST_RESOURCE;
	p->attributes = list;
	struct work_attribute a = { text_print("%s%s", prefix, name), strdup(value) };
	list[p->n_attributes++] = a;
	return a.name && a.value ? ST_OK : ST_RESOURCE;
}

enum status attributes_make(struct work *w)
{
	struct work_private *p = w->private;
	char version[24];
	snprintf(version, sizeof version, "%d", worker.version);
	enum status st = add(p, "", "program", "batten " BATTEN_VERSION);
	if (st == ST_OK)
		st = add(p, "", "worker", worker.name);
	if (st == ST_OK)
		st = add(p, "", "worker_version", version);
	if (st == ST_OK)
		st = add(p, "", "input_hash", p->computation->input_hash);
	if (st == ST_OK && w->file_unit)
		st = add(p, "", "unit", w->file_unit);
	if (st == ST_OK)
		st = add(p, "", "vector_level", vector_level());
	for (int i = 0; st == ST_OK && worker.params[i].name; i++)
		if (p->task->values[i])
			st = add(p, param_prefix, worker.params[i].name, p->task->values[i]);
	return st;
}

void attributes_finish(struct work_private *p)
{
	for (int i = 0; i < p->n_attributes; i++) {
		free((char *)p->attributes[i].name);
		free((char *)p->attributes[i].value);
	}
	free(p->attributes);
	p->attributes = NULL;
	p->n_attributes = 0;
}

char *attributes_key(const struct work *w)
{
	const struct work_private *p = w->private;
	struct text t = { 0 };
	for (int i = 0; i < p->n_attributes; i++)
		text_addf(&t, "%s=%s\n", p->attributes[i].name, p->attributes[i].value);
	if (worker.units_are_output)
		text_add(&t, "units=chunks\n"); /* they were tiles without a head once */
	return text_take(&t);
}

const struct work_attribute *work_attributes(const struct work *w, int *n)
{
	*n = w->private->n_attributes;
	return w->private->attributes;
}

enum status work_figures(struct work *w, json_t *figures)
{
	struct work_private *p = w->private;
	char *text = figures ? json_write(figures, false) : NULL;
	json_decref(p->figures);
	p->figures = figures;
	enum status st = text ? add(p, "", "figures", text) : ST_RESOURCE;
	free(text);
	return st;
}

char *output_path(const struct work *w, const struct worker_output *row)
{
	return text_print("%s%s", w->private->computation->base, row->extension);
}

bool output_wanted(const struct work *w, const struct worker_output *row)
{
	int i;
	if (!row->when)
		return true;
	const struct param *p = param_find(row->when, &i);
	return p && p->type == PARAM_FLAG ? work_flag(w, row->when) : work_has(w, row->when);
}

/* ---- up to date ---- */

/* Attributes of a file that is there, in whatever format. */
struct found {
	struct exr_picture picture;
	struct model model;
	int n;
};

static bool found_read(struct found *f, const char *path)
{
	*f = (struct found){ 0 };
	if (path_has_suffix(path, ".exr")) {
		if (exr_read_attributes(&f->picture, path, &report_none) != ST_OK)
			return false;
		f->n = f->picture.n_attributes;
		return true;
	}
	char *text;
	size_t n;
	if (file_read(path, text_output_max, &text, &n, &report_none) != ST_OK)
		return false;
	model_init(&f->model);
	bool ok = base_recognise(text, n) &&
	          base_parse(&f->model, text, n, path, NULL, &report_none) == ST_OK;
	free(text);
	f->n = ok ? f->model.n_attributes : 0;
	return ok;
}

static const char *found_at(const struct found *f, int i, const char **name)
{
	if (f->picture.n_attributes) {
		*name = f->picture.attributes[i].name;
		return f->picture.attributes[i].value;
	}
	*name = f->model.attributes[i].name;
	return f->model.attributes[i].value;
}

static const char *found_value(const struct found *f, const char *name)
{
	for (int i = 0; i < f->n; i++) {
		const char *here, *value = found_at(f, i, &here);
		if (strcmp(here, name) == 0)
			return value;
	}
	return NULL;
}

static void found_finish(struct found *f)
{
	exr_picture_finish(&f->picture);
	model_finish(&f->model);
}

static bool is_param(const char *name)
{
	return strncmp(name, param_prefix, sizeof param_prefix - 1) == 0;
}

/* Same work: worker, version, input and every parameter; the program's own version and the
 * processor do not count. */
static bool same_work(const struct work_private *p, const struct found *f)
{
	int n_params = 0, n_found = 0;
	for (int i = 0; i < p->n_attributes; i++) {
		const struct work_attribute *a = &p->attributes[i];
		const char *value = found_value(f, a->name);
		n_params += is_param(a->name);
		if (strcmp(a->name, "program") == 0 || strcmp(a->name, "vector_level") == 0)
			continue;
		if (!value || strcmp(value, a->value) != 0)
			return false;
	}
	for (int i = 0; i < f->n; i++) {
		const char *name;
		found_at(f, i, &name);
		n_found += is_param(name);
	}
	return n_params == n_found;
}

static bool outputs_exist(const struct work *w)
{
	for (const struct worker_output *row = worker.outputs; row->extension; row++) {
		char *path = output_wanted(w, row) ? output_path(w, row) : NULL;
		bool missing = path && !path_exists(path);
		free(path);
		if (missing)
			return false;
	}
	return true;
}

bool outputs_up_to_date(struct work *w, json_t **figures)
{
	struct found f;
	*figures = NULL;
	if (!outputs_exist(w))
		return false;
	char *path = output_path(w, &worker.outputs[0]);
	bool same = path && found_read(&f, path);
	if (same) {
		same = same_work(w->private, &f);
		const char *text = found_value(&f, "figures");
		if (same && text)
			json_parse_object(text, strlen(text), path, figures, &report_none);
		found_finish(&f);
	}
	free(path);
	return same;
}

/* ---- making them ---- */

/* One name for one piece of work: a second start of it writes over what a killed one left. */
static char *temp_path(const struct work *w, const struct worker_output *row)
{
	const struct task *t = w->private->task;
	const char *base = w->private->computation->base, *name = path_file_name(base);
	char *brief = path_brief_name(name),
	     *part = t->part ? path_basic_name(t->part) : strdup("hand");
	char *temp = brief && part ? text_print("%.*s.%s%s.%s.tmp", (int)(name - base), base, brief,
	                                        row->extension, part)
	                           : NULL;
	free(brief);
	free(part);
	return temp;
}

/* ---- what stands where they go ---- */

static enum status check_place(const char *path, const struct report *r)
{
	struct stat s;
	size_t n = strlen(path_file_name(path));
	if (n > NAME_MAX)
		return report_error(
		        r, ST_PARAMETER,
		        "cannot write '%s': its name has %zu bytes, %d are the most; name another "
		        "with -o",
		        path, n, NAME_MAX);
	if (lstat(path, &s) || S_ISLNK(s.st_mode))
		return ST_OK; /* nothing, or a link, which the file takes the place of */
	if (!S_ISREG(s.st_mode))
		return report_error(r, ST_INPUT,
		                    "cannot write '%s': %s stands there; name another with -o",
		                    path, S_ISDIR(s.st_mode) ? "a folder" : "what is no file");
	if (!(s.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)))
		return report_error(
		        r, ST_INPUT,
		        "cannot write '%s': the file there is read-only; make it writable or name "
		        "another with -o",
		        path);
	return ST_OK;
}

enum status outputs_check(const struct work *w)
{
	enum status st = ST_OK;
	for (const struct worker_output *row = worker.outputs; st == ST_OK && row->extension;
	     row++) {
		char *path = output_wanted(w, row) ? output_path(w, row) : NULL;
		if (path)
			st = check_place(path, &w->report);
		free(path);
	}
	return st;
}

static enum status sync_path(const char *path, int flags, const struct report *r)
{
	int fd = open(path, flags | O_CLOEXEC);
	int error = fd < 0 || fsync(fd) < 0 ? errno : 0;
	if (fd >= 0 && close(fd) < 0 && !error)
		error = errno;
	if (error)
		return report_error(r, ST_RESOURCE, "cannot write '%s': %s", path, strerror(error));
	return ST_OK;
}

static void pending_drop(struct work *w, struct pending *p)
{
	if (p->temp) {
		unlink(p->temp);
		run_drop_temp(w->private->run, p->temp);
	}
	free(p->temp);
	free(p->path);
	*p = (struct pending){ 0 };
}

static const struct worker_output *find_output(const char *extension)
{
	for (const struct worker_output *row = worker.outputs; row->extension; row++)
		if (strcmp(row->extension, extension) == 0)
			return row;
	return NULL;
}

/* One more output, which has no temporary name yet. */
static enum status pending_add(struct work *w, const char *extension, struct pending **out)
{
	struct work_private *p = w->private;
	const struct worker_output *row = find_output(extension);
	if (!row)
		return report_error(&w->report, ST_INTERNAL,
		                    "worker %s makes '%s', which its description does not have",
		                    worker.name, extension);
	struct pending *list = realloc(p->pending, (size_t)(p->n_pending + 1) * sizeof *list);
	if (!list)
		return ST_RESOURCE;
	p->pending = list;
	struct pending *new = &list[p->n_pending];
	*new = (struct pending){ .row = row, .path = output_path(w, row) };
	if (!new->path)
		return ST_RESOURCE;
	p->n_pending++;
	*out = new;
	return ST_OK;
}

static enum status pending_name(struct work *w, struct pending *p)
{
	p->temp = temp_path(w, p->row);
	return p->temp ? run_add_temp(w->private->run, p->temp) : ST_RESOURCE;
}

enum status outputs_add_part(struct work *w, const char *extension)
{
	struct pending *new;
	return pending_add(w, extension, &new);
}

enum status work_output(struct work *w, const char *extension, work_writer *write, void *data)
{
	struct pending *new;
	enum status st = pending_add(w, extension, &new);
	if (st == ST_OK)
		st = pending_name(w, new);
	if (st == ST_OK)
		st = write(data, new->temp, &w->report);
	if (st == ST_OK)
		st = sync_path(new->temp, O_RDONLY, &w->report);
	return st;
}

static const struct pending *find_pending(const struct work_private *p,
                                          const struct worker_output *row)
{
	for (int i = 0; i < p->n_pending; i++)
		if (p->pending[i].row == row)
			return &p->pending[i];
	return NULL;
}

const char *work_made(const struct work *w, const char *extension)
{
	const struct pending *p = find_pending(w->private, find_output(extension));
	return !p ? NULL : p->temp ? p->temp : part_file(w->private->part);
}

static enum status check_complete(const struct work *w)
{
	for (const struct worker_output *row = worker.outputs; row->extension; row++)
		if (output_wanted(w, row) && !find_pending(w->private, row))
			return report_error(&w->report, ST_INTERNAL,
			                    "worker %s did not make its output '%s'", worker.name,
			                    row->extension);
	return ST_OK;
}

/* The part file lies on another disk: its bytes go where it cannot. */
static enum status carry_over(struct work *w, struct pending *p)
{
	enum status st = pending_name(w, p);
	int error = st == ST_OK ? part_copy(w->private->part, p->temp) : 0;
	if (error)
		st = report_error(&w->report, status_from_errno(error), "cannot write '%s': %s",
		                  p->path, strerror(error));
	return st == ST_OK ? sync_path(p->temp, O_RDONLY, &w->report) : st;
}

/* Rename the part file; *done: it is in place. */
static enum status rename_part(struct work *w, struct pending *p, bool *done)
{
	int error = part_become(w->private->part, p->path);
	*done = error == 0;
	if (error == EXDEV)
		return carry_over(w, p);
	return error ? report_error(&w->report, status_from_errno(error), "cannot write '%s': %s",
	                            p->path, strerror(error))
	             : ST_OK;
}

static enum status put_in_place(struct work *w, struct pending *p)
{
	bool done = false;
	enum status st = p->temp ? ST_OK : rename_part(w, p, &done);
	if (st != ST_OK || done)
		return st;
	if (rename(p->temp, p->path) < 0)
		return report_error(&w->report, status_from_errno(errno), "cannot write '%s': %s",
		                    p->path, strerror(errno));
	run_drop_temp(w->private->run, p->temp);
	return ST_OK;
}

/* The own output goes last: it is the one whose attributes say that all are up to date. */
enum status outputs_commit(struct work *w)
{
	struct work_private *p = w->private;
	enum status st = check_complete(w);
	for (int own = 0; own < 2; own++)
		for (int i = 0; st == ST_OK && i < p->n_pending; i++)
			if ((p->pending[i].row == &worker.outputs[0]) == own)
				st = put_in_place(w, &p->pending[i]);
	char *folder = path_folder(p->computation->base);
	if (st == ST_OK)
		st = folder ? sync_path(folder, O_RDONLY | O_DIRECTORY, &w->report) : ST_RESOURCE;
	free(folder);
	return st;
}

void outputs_abandon(struct work *w)
{
	struct work_private *p = w->private;
	for (int i = 0; i < p->n_pending; i++)
		pending_drop(w, &p->pending[i]);
	free(p->pending);
	p->pending = NULL;
	p->n_pending = 0;
}
