/* help.c - the texts read: those compiled with the program, then the user's own. */
#include "help.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "number.h"
#include "path.h"
#include "texts.h"
#define HELP_SET_UP
#include "help_index.h"

enum { FILE_MAX = 1 << 24 };

void help_destroy(struct help *h)
{
	if (!h)
		return;
	help_source_finish(&h->source);
	free(h->complaint);
	free(h);
}

const char *help_complaint(const struct help *h)
{
	return h->complaint;
}

size_t help_count(const struct help *h)
{
	return h->source.n;
}

const struct help_text *help_at(const struct help *h, size_t k)
{
	return &h->source.texts[k];
}

const struct help_text *help_find(const struct help *h, const char *code)
{
	for (size_t k = 0; k < h->source.n; k++)
		if (!strcasecmp(h->source.texts[k].code, code))
			return &h->source.texts[k];
	return NULL;
}

/* One line of the pointer file: index, first byte, bytes. */
static bool take_pointer(const char **p, const char *end, const char *code, int64_t *from,
                         int64_t *n)
{
	size_t length = strlen(code);

	if ((size_t)(end - *p) <= length || memcmp(*p, code, length) != 0 || (*p)[length] != ' ')
		return false;
	*p += length + 1;
	if (!number_read_integer(p, end, from) || *p == end || *(*p)++ != ' ' ||
	    !number_read_integer(p, end, n) || *p == end || *(*p)++ != '\n')
		return false;
	return *from >= 0 && *n >= 0;
}

/* Every text the program was built with, each from where the pointer file says that it begins. */
static enum status take_texts(struct help *h, const char *messages, size_t n_messages,
                              const char *pointers, size_t n_pointers, const char *name,
                              const struct report *r)
{
	const char *end = pointers + n_pointers, *p = memchr(pointers, '\n', n_pointers);
	enum status st = ST_OK;

	p = p ? p + 1 : end;
	for (size_t k = 0; k < HELP_TEXTS && st == ST_OK; k++) {
		int64_t from, n;

		if (!take_pointer(&p, end, help_codes[k], &from, &n) ||
		    (uint64_t)from > n_messages || (uint64_t)n > n_messages - (uint64_t)from)
			return report_error(r, ST_INPUT,
			                    "the help file '%s' is not of this version of batten "
			                    "(%s is not where it should be); install it again",
			                    name, help_codes[k]);
		st = help_source_parse(&h->source, messages + from, (size_t)n, name, r);
		if (st == ST_OK &&
		    (h->source.n != k + 1 || strcmp(h->source.texts[k].code, help_codes[k]) != 0))
			return report_error(r, ST_INPUT,
			                    "the help file '%s' has another text where %s should "
			                    "be; install it again",
			                    name, help_codes[k]);
	}
	return st;
}

static enum status read_compiled(struct help *h, const char *folder, const struct report *r)
{
	char *message = path_join(folder, "batten.msg"), *pointer = path_join(folder, "batten.ptr");
	char *m = NULL, *p = NULL;
	size_t n_m, n_p;
	enum status st = message && pointer ? file_read(message, FILE_MAX, &m, &n_m, r)
	                                    : report_error(r, ST_RESOURCE,
	                                                   "cannot read the help: memory ran out");

	if (st == ST_OK)
		st = file_read(pointer, FILE_MAX, &p, &n_p, r);
	if (st == ST_OK)
		st = take_texts(h, m, n_m, p, n_p, message, r);
	free(m);
	free(p);
	free(message);
	free(pointer);
	return st;
}

/* A text of the user's goes into the place of ours, a new one stays at the end. */
static void merge(struct help *h, size_t n_ours)
{
	struct help_text *all = h->source.texts;
	size_t n = n_ours;

	for (size_t k = n_ours; k < h->source.n; k++) {
		size_t place = 0;

		while (place < n_ours && strcmp(all[place].code, all[k].code) != 0)
			place++;
		if (place < n_ours) {
			help_text_finish(&all[place]);
			all[place] = all[k];
		} else {
			all[n++] = all[k];
		}
	}
	h->source.n = n;
}

static enum status read_own(struct help *h, const char *path, const struct report *r)
{
	struct report_store store;
	size_t n, n_before = h->source.n;
	char *bytes;

	if (!path_exists(path))
		return ST_OK;
	report_store_init(&store);
	enum status st = file_read(path, FILE_MAX, &bytes, &n, &store.report);
	if (st == ST_OK) {
		st = help_source_parse(&h->source, bytes, n, path, &store.report);
		free(bytes);
	}
	if (st == ST_OK) {
		merge(h, n_before);
		return ST_OK;
	}
	while (h->source.n > n_before)
		help_text_finish(&h->source.texts[--h->source.n]);
	free(h->complaint);
	h->complaint = text_print("%s; its texts are left out", store.error);
	return h->complaint ? ST_OK
	                    : report_error(r, ST_RESOURCE, "cannot read the help: memory ran out");
}

enum status help_read(struct help **out, const char *folder, const char *const *own, size_t n_own,
                      const struct report *r)
{
	struct help *h = calloc(1, sizeof *h);
	enum status st = h ? read_compiled(h, folder, r)
	                   : report_error(r, ST_RESOURCE, "cannot read the help: memory ran out");

	*out = NULL;
	for (size_t k = 0; k < n_own && st == ST_OK; k++)
		st = read_own(h, own[k], r);
	if (st != ST_OK) {
		help_destroy(h);
		return st;
	}
	qsort(h->source.texts, h->source.n, sizeof *h->source.texts, help_text_order);
	*out = h;
	return ST_OK;
}

static char *config_file(void)
{
	const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");

	if (config && config[0] == '/')
		return path_join(config, "batten/help/own.help");
	return home && *home ? path_join(home, ".config/batten/help/own.help") : NULL;
}

enum status help_load(struct help **out, const char *project, const struct report *r)
{
	char *program = path_of_program();
	/* the build tree, else installed */
	char *folder = program ? path_join(program, "../help") : NULL;
	char *message = folder ? path_join(folder, "batten.msg") : NULL;
	if (message && !path_exists(message)) {
		free(folder);
		folder = path_join(program, "../share/batten/help");
	}
	free(message);
	char *files[] = { config_file(),
		          project ? path_join(project, ".batten/help/own.help") : NULL };
	const char *own[2];
	size_t n = 0;
	for (int k = 0; k < 2; k++)
		if (files[k])
			own[n++] = files[k];
	*out = NULL;
	enum status st =
	        folder ? help_read(out, folder, own, n, r)
	               : report_error(r, ST_RESOURCE, "cannot read the help: memory ran out");
	for (int k = 0; k < 2; k++)
		free(files[k]);
	free(folder);
	free(program);
	return st;
}
