/* model_read.c - files found by their content, entities found by what the user calls them. */
#include "model.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base.h"
#include "csv.h"
#include "file.h"
#include "g2.h"
#include "iges.h"
#include "number.h"
#include "path.h"

/* Larger files are refused. Bytes. */
static const uint64_t file_size_max = (uint64_t)1 << 40;

/* What a file is shows in so many bytes. */
enum { LOOK = 1 << 20 };

enum status progress_step(const struct progress *p, double fraction)
{
	if (!p)
		return ST_OK;
	if (p->stop && atomic_load_explicit(p->stop, memory_order_relaxed))
		return ST_CANCELLED;
	if (p->step)
		p->step(p->data, fraction);
	return ST_OK;
}

static bool has_changed(int fd, const struct stat *before)
{
	struct stat now;
	return fstat(fd, &now) < 0 || now.st_size != before->st_size ||
	       now.st_mtim.tv_sec != before->st_mtim.tv_sec ||
	       now.st_mtim.tv_nsec != before->st_mtim.tv_nsec;
}

/* IGES files are large: they are read from the disk as they are needed. *is: it was one. */
static enum status read_iges(struct model *m, const char *path, bool *is, const struct progress *p,
                             const struct report *r)
{
	char head[4096];
	struct stat file;
	enum status st = ST_OK;
	*is = false;
	/* a pipe is opened once only: who writes to it would be left alone at the close */
	if (stat(path, &file) || !S_ISREG(file.st_mode))
		return ST_OK;
	int fd = open(path, O_RDONLY | O_CLOEXEC);
	if (fd >= 0 && !fstat(fd, &file)) {
		ssize_t n = pread(fd, head, sizeof head, 0);
		*is = n > 0 && !base_recognise(head, (size_t)n) && iges_recognise(head, (size_t)n);
	}
	if (*is)
		st = iges_read(m, fd, (size_t)file.st_size, path, p, r);
	if (*is && st == ST_OK && has_changed(fd, &file))
		st = report_error(r, ST_INPUT,
		                  "cannot read '%s': it was written to meanwhile; try again when "
		                  "it is whole",
		                  path);
	if (fd >= 0)
		close(fd);
	return st;
}

static bool is_known(const char *bytes, size_t n)
{
	return base_recognise(bytes, n) || iges_recognise(bytes, n) || g2_recognise(bytes, n) ||
	       csv_recognise(bytes, n);
}

static enum status read_whole(struct model *m, const char *path, const struct progress *p,
                              const struct report *r)
{
	char *bytes = NULL;
	size_t n = 0;
	enum status st = file_read_wanted(path, file_size_max, LOOK, is_known, &bytes, &n, r);
	if (st != ST_OK)
		return st;
	if (n == 0)
		st = report_error(r, ST_INPUT, "cannot read '%s': the file is empty", path);
	else if (base_recognise(bytes, n))
		st = base_parse(m, bytes, n, path, p, r);
	else if (iges_recognise(bytes, n)) /* from a pipe */
		st = iges_parse(m, bytes, n, path, p, r);
	else if (g2_recognise(bytes, n))
		st = g2_parse(m, bytes, n, path, p, r);
	else if (csv_recognise(bytes, n))
		st = csv_parse(m, bytes, n, path, p, r);
	else
		st = report_error(r, ST_INPUT,
		                  "cannot read '%s': it is neither a batten base file (first line "
		                  "'batten base 1') nor IGES (80 columns, S in column 73), .g2 "
		                  "(first line such as '200 1 0 0') or columns of points",
		                  path);
	free(bytes);
	return st;
}

enum status model_read(struct model *m, const char *path, const struct progress *p,
                       const struct report *r)
{
	bool iges;
	model_init(m);
	enum status st = read_iges(m, path, &iges, p, r);
	if (!iges)
		st = read_whole(m, path, p, r);
	if (st == ST_OK && (st = model_set_text(&m->file, path)) != ST_OK)
		report_error(r, st, "cannot read '%s': no memory", path);
	if (st != ST_OK)
		model_finish(m);
	return st;
}

/* Highest number given. */
static int last_number(const struct model *m)
{
	int last = 0;
	for (int i = 0; i < m->n; i++)
		if (m->entities[i].number > last)
			last = m->entities[i].number;
	return last;
}

static struct entity *find_number(const struct model *m, int64_t number)
{
	for (int i = 0; i < m->n; i++)
		if (number > 0 && m->entities[i].number == number)
			return &m->entities[i];
	return NULL;
}

/* Does the face of that number lie on it? */
static bool lies_on(const struct entity *e, int64_t de)
{
	const struct face_list *l = e->kind == ENTITY_SURFACE ? e->faces : NULL;
	for (int k = 0; l && k < l->n; k++)
		if (l->de[k] == de)
			return true;
	return false;
}

static struct entity *find_de(const struct model *m, int64_t de)
{
	if (de < 1)
		return NULL;
	for (int i = 0; i < m->n; i++)
		if (m->entities[i].de == de)
			return &m->entities[i];
	for (int i = 0; i < m->n; i++)
		if (lies_on(&m->entities[i], de))
			return &m->entities[i];
	return NULL;
}

static enum status nothing_found(const struct model *m, const char *selector,
                                 const struct report *r)
{
	const char *file = m->file ? m->file : "the model";
	int last = last_number(m);
	if (last == 0)
		return report_error(r, ST_INPUT, "'%s' has no entity '%s': it has no numbered ones",
		                    file, selector);
	const char *example = NULL;
	for (int i = 0; i < m->n && !example; i++)
		example = m->entities[i].name;
	return report_error(r, ST_INPUT,
	                    "'%s' has no entity '%s'; it has the numbers 1 to %d%s%s%s, "
	                    "'batten info' lists them",
	                    file, selector, last, example ? ", names like '" : "",
	                    example ? example : "", example ? "'" : "");
}

enum status model_find(const struct model *m, const char *selector, struct entity **out,
                       const struct report *r)
{
	int64_t number;
	struct entity *e = NULL;
	if (number_parse_integer(selector, &number))
		e = find_number(m, number);
	else if (selector[0] == 'D' && number_parse_integer(selector + 1, &number))
		e = find_de(m, number);
	for (int i = 0; i < m->n && !e; i++) {
		if (!m->entities[i].name || strcmp(m->entities[i].name, selector) != 0)
			continue;
		e = &m->entities[i];
		for (int k = i + 1; k < m->n; k++)
			if (m->entities[k].name && strcmp(m->entities[k].name, selector) == 0)
				return report_error(r, ST_INPUT,
				                    "'%s' has several entities named '%s'; "
				                    "give the number or D and the directory entry",
				                    m->file ? m->file : "the model", selector);
	}
	if (!e)
		return nothing_found(m, selector, r);
	*out = e;
	return ST_OK;
}

enum status model_split_name(const char *argument, char **path, char **selector)
{
	const char *hash = strrchr(argument, '#');
	*selector = NULL;
	if (!hash || path_exists(argument)) {
		*path = strdup(argument);
		return *path ? ST_OK : ST_RESOURCE;
	}
	*path = strndup(argument, (size_t)(hash - argument));
	*selector = strdup(hash + 1);
	if (*path && *selector)
		return ST_OK;
	free(*path);
	free(*selector);
	*path = *selector = NULL;
	return ST_RESOURCE;
}
