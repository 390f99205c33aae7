/* source.h - the help source: texts one after the other, each
 *	@V79 Title
 *	paragraphs of its purpose
 *	:arguments
 *	name | range | meaning          lines that begin with a blank go on with the meaning
 *	:result
 *	paragraphs
 *	:example
 *	lines of a script
 *	:see V80 N31
 * A line that begins with # is a comment. Parts come in this order; a menu's text (N) has purpose and
 * see only, a routine's (V) needs purpose, result and example. The message file is written in the same
 * form, a paragraph a line. */
#ifndef BATTEN_HELP_SOURCE_H
#define BATTEN_HELP_SOURCE_H

#include "help.h"
#include "text.h"

struct help_source {
	struct help_text *texts; /* owned */
	size_t n, cap;
};

/*
 * Add the texts of `bytes` to *s. `name` is the file's for sentences, first_line the number of its
 * first line.
 * Errors: ST_INPUT (name, line, what was found and expected; a code that stands twice in `bytes`),
 * ST_RESOURCE. *s then holds what was read so far.
 */
enum status help_source_parse(struct help_source *s, const char *bytes, size_t n, const char *name,
                              const struct report *r);
void help_source_finish(struct help_source *s); /* a zeroed one is fine */
void help_text_finish(struct help_text *t);

/* The text in canonical form at the end of out. */
void help_text_write(const struct help_text *t, struct text *out);

/* "V79" as a letter and a number; false where it is no index. */
bool help_code_parse(const char *code, char *letter, int *number);
/* N before V, then by number; for qsort over texts. */
int help_text_order(const void *a, const void *b);

#endif
