/* roster.c - find the workers there are, and ask each what it is. */
#include "roster.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "describe.h"
#include "json.h"
#include "path.h"
#include "text.h"

static const char prefix[] = "batten-";

/* Programs of ours that are no workers. */
static const char *const not_workers[] = { "launch", "editor" };

static bool is_worker_name(const char *name)
{
	for (size_t i = 0; i < sizeof not_workers / sizeof *not_workers; i++)
		if (!strcmp(name, not_workers[i]))
			return false;
	return *name && !name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_-")];
}

static bool is_executable(const char *path)
{
	struct stat s;
	return !stat(path, &s) && S_ISREG(s.st_mode) && !access(path, X_OK);
}

/* The folders to look in, first ones first. Freed by folders_finish. */
struct folders {
	char **path;
	int n;
	bool failed;
};

static void folders_finish(struct folders *f)
{
	for (int i = 0; i < f->n; i++)
		free(f->path[i]);
	free(f->path);
}

/* Takes path over. */
static void folders_add(struct folders *f, char *path)
{
	char **p = path ? realloc(f->path, ((size_t)f->n + 1) * sizeof *p) : NULL;
	if (!p) {
		free(path);
		f->failed = true;
		return;
	}
	f->path = p;
	f->path[f->n++] = path;
}

static void folders_find(struct folders *f, const struct project *p)
{
	memset(f, 0, sizeof *f);
	char *program = path_of_program();
	if (program) {
		folders_add(f, path_join(program, ""));
		folders_add(f, path_join(program, "../workers"));
		folders_add(f, path_join(program, "../libexec/batten"));
	}
	free(program);
	const char *list = getenv("BATTEN_WORKER_PATH");
	while (list && *list) {
		size_t n = strcspn(list, ":");
		if (n)
			folders_add(f, text_print("%.*s", (int)n, list));
		list += n + (list[n] == ':');
	}
	if (p)
		folders_add(f, path_join(p->hidden, "workers"));
	const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
	if (config && config[0] == '/')
		folders_add(f, path_join(config, "batten/workers"));
	else if (home && *home)
		folders_add(f, path_join(home, ".config/batten/workers"));
}

enum status roster_locate(char **out, const struct project *p, const char *name,
                          const struct report *r)
{
	struct folders f;
	*out = NULL;
	folders_find(&f, p);
	for (int i = 0; i < f.n && !f.failed && !*out && is_worker_name(name); i++) {
		char *path = text_print("%s/%s%s", f.path[i], prefix, name);
		if (path && is_executable(path))
			*out = path_absolute(path, NULL);
		f.failed |= !path;
		free(path);
	}
	folders_finish(&f);
	if (*out)
		return ST_OK;
	if (f.failed)
		return report_error(r, ST_RESOURCE, "cannot look for workers: out of memory");
	return report_error(r, ST_PARAMETER,
	                    "there is no worker '%s'; 'batten workers' lists those there are",
	                    name);
}

static enum status roster_add(struct roster *x, const char *folder, const char *name)
{
	if (roster_find(x, name))
		return ST_OK;
	struct roster_worker w = { 0 };
	char *path = text_print("%s/%s%s", folder, prefix, name);
	if (!path)
		return ST_RESOURCE;
	if (!is_executable(path)) {
		free(path);
		return ST_OK;
	}
	struct roster_worker *p = realloc(x->workers, ((size_t)x->n + 1) * sizeof *p);
	if (p) {
		x->workers = p;
		w.name = strdup(name);
		w.path = path_absolute(path, NULL);
	}
	free(path);
	if (!p || !w.name || !w.path) {
		free(w.name);
		free(w.path);
		return ST_RESOURCE;
	}
	x->workers[x->n++] = w;
	return ST_OK;
}

static enum status folder_scan(struct roster *x, const char *folder)
{
	DIR *d = opendir(folder);
	enum status st = ST_OK;
	for (struct dirent *e; d && st == ST_OK && (e = readdir(d));) {
		const char *name = e->d_name + sizeof prefix - 1;
		if (!strncmp(e->d_name, prefix, sizeof prefix - 1) && is_worker_name(name))
			st = roster_add(x, folder, name);
	}
	if (d)
		closedir(d);
	return st;
}

static int by_name(const void *a, const void *b)
{
	const struct roster_worker *x = a, *y = b;
	return strcmp(x->name, y->name);
}

enum status roster_read(struct roster *out, const struct project *p, const char *only,
                        const struct report *r)
{
	struct folders f;
	enum status st = ST_OK;
	memset(out, 0, sizeof *out);
	folders_find(&f, p);
	if (f.failed)
		st = ST_RESOURCE;
	for (int i = 0; i < f.n && st == ST_OK; i++) {
		if (!only)
			st = folder_scan(out, f.path[i]);
		else if (is_worker_name(only))
			st = roster_add(out, f.path[i], only);
	}
	folders_finish(&f);
	if (st == ST_OK && out->n) {
		qsort(out->workers, (size_t)out->n, sizeof *out->workers, by_name);
		st = describe_all(out->workers, out->n);
	}
	if (st != ST_OK) {
		roster_finish(out);
		return report_error(r, st, "cannot look for workers: out of memory");
	}
	return ST_OK;
}

void roster_finish(struct roster *x)
{
	for (int i = 0; x && i < x->n; i++) {
		free(x->workers[i].name);
		free(x->workers[i].path);
		free(x->workers[i].broken);
		json_decref(x->workers[i].description);
	}
	if (x) {
		free(x->workers);
		memset(x, 0, sizeof *x);
	}
}

const struct roster_worker *roster_find(const struct roster *x, const char *name)
{
	for (int i = 0; i < x->n; i++)
		if (!strcmp(x->workers[i].name, name))
			return &x->workers[i];
	return NULL;
}
