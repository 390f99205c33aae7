/* tidy.c - take away what a worker that was killed left half written beside its outputs. */
#include "tidy.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "path.h"

/* ".BASIC.EXTENSION.ID.tmp" with the brief form of BASIC, as the workers' shared main names them, and what a whole file puts behind that
 * on its way: a point and six letters. */
static bool is_left(const char *name, const char *basic, int64_t id)
{
	enum { BEHIND = 7 };
	char end[32];
	size_t n = strlen(name), n_basic = strlen(basic);
	int n_end = snprintf(end, sizeof end, ".%lld.tmp", (long long)id);
	if (n < n_basic + 2 || name[0] != '.' || strncmp(name + 1, basic, n_basic) ||
	    name[n_basic + 1] != '.')
		return false;
	const char *rest = name + n_basic + 1, *stop = name + n;
	if (stop - rest > BEHIND + n_end && stop[-BEHIND] == '.' &&
	    !memcmp(stop - BEHIND - n_end, end, (size_t)n_end))
		return true;
	return stop - rest > n_end && !strcmp(stop - n_end, end);
}

void tidy_outputs(const struct Stats *s)
{
	char *folder = s->output ? path_folder(s->output) : NULL;
	char *basic = folder ? path_brief_name(path_file_name(s->output)) : NULL;
	DIR *d = basic ? opendir(folder) : NULL;
	for (struct dirent *e; d && (e = readdir(d));)
		if (is_left(e->d_name, basic, s->id))
			unlinkat(dirfd(d), e->d_name, 0);
	if (d)
		closedir(d);
	free(basic);
	free(folder);
}
