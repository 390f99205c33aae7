/* prune.c - take away the files in .batten/ that belong to no job. */
#include <dirent.h>
#include <malloc.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "number.h"
#include "path.h"
#include "server.h"
#include "text.h"

/* An input is written before its job is submitted: a young one may be waiting for that. */
enum { INPUT_YOUNG_S = 600 };

/* "12.json" and a shard's "12-3.json" -> 12, -1 for another name. */
static int64_t name_id(const char *name, const char *extension)
{
	int64_t id, shard;
	const char *p = name, *end = name + strlen(name);
	if (!path_has_suffix(name, extension) || !number_read_integer(&p, end, &id) || id < 1)
		return -1;
	if (*p == '-' && p++ && (!number_read_integer(&p, end, &shard) || shard < 0))
		return -1;
	return strcmp(p, extension) ? -1 : id;
}

struct keeper {
	struct queue *queue;
	const char *extension;
	char **inputs; /* owned, strings too; sorted */
	size_t n_inputs, cap;
};

static bool keeps_id(const struct keeper *k, const char *path, const char *name)
{
	int64_t id = name_id(name, k->extension);
	(void)path;
	return id < 0 || queue_has(k->queue, id);
}

static int by_name(const void *a, const void *b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

static bool keeps_input(const struct keeper *k, const char *path, const char *name)
{
	struct stat s;
	(void)name;
	if (k->n_inputs && bsearch(&path, k->inputs, k->n_inputs, sizeof *k->inputs, by_name))
		return true;
	return stat(path, &s) || time(NULL) - s.st_mtime < INPUT_YOUNG_S;
}

static void folder_prune(const struct project *p, const char *folder, const struct keeper *k,
                         bool (*keeps)(const struct keeper *k, const char *path, const char *name))
{
	char *path = path_join(p->hidden, folder);
	DIR *d = path ? opendir(path) : NULL;
	for (struct dirent *e; d && (e = readdir(d));) {
		char *file = e->d_name[0] == '.' ? NULL : path_join(path, e->d_name);
		if (file && !keeps(k, file, e->d_name))
			unlink(file);
		free(file);
	}
	if (d)
		closedir(d);
	free(path);
}

static bool inputs_add(struct keeper *k, const struct Stats *s)
{
	for (int i = 0; i < s->n_inputs; i++) {
		if (k->n_inputs == k->cap) {
			size_t cap = k->cap ? 2 * k->cap : 64;
			char **more = reallocarray(k->inputs, cap, sizeof *more);
			if (!more)
				return false;
			k->inputs = more;
			k->cap = cap;
		}
		char *path = strdup(s->inputs[i].path);
		if (!path)
			return false;
		k->inputs[k->n_inputs++] = path;
	}
	return true;
}

/* Every input of every job left; false where they cannot be known, then all are kept. */
static bool inputs_gather(struct keeper *k)
{
	int64_t *over = NULL;
	size_t n = 0;
	bool good = queue_over(k->queue, &(struct ledger_choice){ 0 }, &over, &n, NULL) == ST_OK;
	for (int i = 0; good && i < queue_count(k->queue); i++)
		good = inputs_add(k, queue_at(k->queue, i));
	for (size_t i = 0; good && i < n; i++) {
		const struct Stats *s = queue_find(k->queue, over[i]);
		good = s && inputs_add(k, s);
	}
	free(over);
	if (good && k->n_inputs)
		qsort(k->inputs, k->n_inputs, sizeof *k->inputs, by_name);
	return good;
}

void prune_files(const struct project *p, struct queue *q)
{
	struct keeper k = { .queue = q };
	k.extension = ".log";
	folder_prune(p, "logs", &k, keeps_id);
	k.extension = ".json";
	folder_prune(p, "jobs", &k, keeps_id);
	k.extension = ".part";
	folder_prune(p, "parts", &k, keeps_id);
	k.extension = ".part.ahead";
	folder_prune(p, "parts", &k, keeps_id);
	if (inputs_gather(&k))
		folder_prune(p, "inputs", &k, keeps_input);
	for (size_t i = 0; i < k.n_inputs; i++)
		free(k.inputs[i]);
	free(k.inputs);
	malloc_trim(0); /* the records that went */
}
