/* journal_folders.h - the folders of the test of the journal. */
#ifndef BATTEN_TESTS_JOURNAL_FOLDERS_H
#define BATTEN_TESTS_JOURNAL_FOLDERS_H

#include <stdbool.h>

/* Models that the steps open. */
void journal_inputs(const char *folder);
/* A file's text, fresh. */
char *journal_text(const char *folder, const char *name);
bool journal_same_file(const char *folder, const char *a, const char *b);
/* All files of a are in b, pictures too, to the byte. How many. */
int journal_same_folder(const char *a, const char *b);

#endif
