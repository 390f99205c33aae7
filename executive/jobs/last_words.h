/* last_words.h - why a service ended before anybody could ask it. */
#ifndef BATTEN_LAST_WORDS_H
#define BATTEN_LAST_WORDS_H

#include <stdint.h>

/* Bytes of its log, 0 where there is none. */
int64_t last_words_mark(const char *log);

/* The last line that was written since, without the program's name. Fresh; NULL: none. */
char *last_words(const char *log, int64_t mark);

#endif
