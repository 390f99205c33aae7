/* help_text.h - the blocks of a text of help, one after the other. */
#ifndef BATTEN_HELP_TEXT_H
#define BATTEN_HELP_TEXT_H

#include "text.h"

enum help_block {
	HELP_END,
	HELP_HEAD,
	HELP_PARAGRAPH,
	HELP_ROW,     /* of the table of arguments: text, value, meaning */
	HELP_EXAMPLE, /* its lines */
	HELP_LINK,    /* text: the code; value: the name */
};
enum help_section { SECTION_TEXT, SECTION_ARGUMENTS, SECTION_EXAMPLE, SECTION_SEE };

struct help_reader {
	const char *at; /* borrowed */
	enum help_section section;
	struct text text, value, meaning; /* of the last block; owned */
};

void help_reader_init(struct help_reader *r, const char *text);
void help_reader_finish(struct help_reader *r);
/* For want of memory: HELP_END. */
enum help_block help_reader_next(struct help_reader *r);

#endif
