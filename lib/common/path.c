/* path.c - file names. */
#include "path.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hash.h"
#include "text.h"

char *path_join(const char *a, const char *b)
{
	size_t n = strlen(a);

	if (!n || b[0] == '/')
		return strdup(b);
	return text_print(a[n - 1] == '/' ? "%s%s" : "%s/%s", a, b);
}

const char *path_file_name(const char *path)
{
	const char *slash = strrchr(path, '/');

	return slash ? slash + 1 : path;
}

const char *path_extension(const char *path)
{
	const char *name = path_file_name(path), *point = strrchr(name, '.');

	return point && point != name ? point : name + strlen(name);
}

char *path_folder(const char *path)
{
	const char *slash = strrchr(path, '/');

	if (!slash)
		return strdup(".");
	return slash == path ? strdup("/") : strndup(path, (size_t)(slash - path));
}

char *path_basic_name(const char *path)
{
	const char *name = path_file_name(path);

	return strndup(name, (size_t)(path_extension(path) - name));
}

char *path_brief_name(const char *name)
{
	enum { DIGITS = 8 };
	char hash[HASH_SIZE];
	size_t n = strlen(name);

	if (n <= PATH_BRIEF)
		return strdup(name);
	hash_bytes(name, n, hash);
	n = PATH_BRIEF - DIGITS - 1;
	while (n && ((unsigned char)name[n] & 0xc0) == 0x80)
		n--; /* no character is cut in two */
	return text_print("%.*s~%.*s", (int)n, name, DIGITS, hash);
}

char *path_absolute(const char *path, const char *folder)
{
	char here[PATH_MAX];
	struct text t = { 0 };

	if (path[0] != '/') {
		if (!folder || folder[0] != '/') {
			if (!getcwd(here, sizeof here))
				return NULL;
			text_addf(&t, "%s/", here);
		}
		if (folder)
			text_addf(&t, "%s/", folder);
	}
	text_add(&t, path);
	if (t.failed)
		return text_take(&t);
	/* take out empty parts, . and .. */
	char *out = t.s, *to = out;
	for (char *from = t.s; *from;) {
		while (*from == '/')
			from++;
		char *end = from;
		while (*end && *end != '/')
			end++;
		size_t n = (size_t)(end - from);
		if (n == 2 && from[0] == '.' && from[1] == '.') {
			while (to > out && *--to != '/')
				;
		} else if (n && !(n == 1 && from[0] == '.')) {
			*to++ = '/';
			memmove(to, from, n);
			to += n;
		}
		from = end;
	}
	if (to == out)
		*to++ = '/';
	*to = 0;
	t.n = (size_t)(to - out);
	return text_take(&t);
}

char *path_find_upward(const char *from, const char *name)
{
	char *folder = path_absolute(from, NULL);

	while (folder) {
		char *there = path_join(folder, name);
		bool found = there && path_exists(there);
		free(there);
		if (found)
			return folder;
		if (!strcmp(folder, "/"))
			break;
		char *up = path_folder(folder);
		free(folder);
		folder = up;
	}
	free(folder);
	return NULL;
}

char *path_of_program(void)
{
	char link[PATH_MAX];
	ssize_t n = readlink("/proc/self/exe", link, sizeof link - 1);

	if (n < 0)
		return NULL;
	link[n] = 0;
	return path_folder(link);
}

bool path_exists(const char *path)
{
	return access(path, F_OK) == 0;
}

bool path_is_folder(const char *path)
{
	struct stat st;

	return stat(path, &st) == 0 && S_ISDIR(st.st_mode);
}

bool path_has_suffix(const char *path, const char *suffix)
{
	size_t n = strlen(path), m = strlen(suffix);

	return n >= m && !strcmp(path + n - m, suffix);
}
