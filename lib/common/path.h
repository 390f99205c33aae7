/* path.h - file names. All strings given back are fresh (caller frees) or NULL for want of memory,
 * unless they are said to point into the argument. */
#ifndef BATTEN_PATH_H
#define BATTEN_PATH_H

#include <stdbool.h>

/* "a", "b" -> "a/b"; b alone where it is absolute or a is "". */
char *path_join(const char *a, const char *b);

/* The part behind the last '/', in the argument. */
const char *path_file_name(const char *path);

/* The extension with its point ("" if none), in the argument: "a/hull.map.exr" -> ".exr". */
const char *path_extension(const char *path);

/* Folder part: "a/b.igs" -> "a", "b.igs" -> ".". */
char *path_folder(const char *path);

/* Without folder and last extension: "a/hull.igs" -> "hull". */
char *path_basic_name(const char *path);

/* For a temporary name beside it: the name, or where it is longer than PATH_BRIEF bytes its first part
 * and a hash of it; names of up to NAME_MAX bytes leave room for more that way. */
enum { PATH_BRIEF = 96 };
char *path_brief_name(const char *name);

/* Absolute, . and .. taken out as text; relative to folder (NULL: the current one). */
char *path_absolute(const char *path, const char *folder);

/* The nearest folder from `from` upward that holds `name`, absolute; NULL if none does. */
char *path_find_upward(const char *from, const char *name);

/* Folder of the running program, absolute. */
char *path_of_program(void);

bool path_exists(const char *path);
bool path_is_folder(const char *path);
bool path_has_suffix(const char *path, const char *suffix);

#endif
