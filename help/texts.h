/* texts.h - the inside of struct help, for the files of this folder. */
#ifndef BATTEN_HELP_TEXTS_H
#define BATTEN_HELP_TEXTS_H

#include "source.h"

struct help {
	struct help_source source; /* in help_text_order */
	char *complaint;           /* owned */
};

#endif
