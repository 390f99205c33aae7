/* status.c - the rows of the one map of how things end. */
#include "status.h"

#include <errno.h>
#include <string.h>

struct status_row {
	int exit_status;
	const char *class, *text;
};

#define X(name, exit_status, class, text) [ST_##name] = { exit_status, class, text },
static const struct status_row rows[N_STATUS] = { STATUS_MAP(X) };
#undef X

int status_exit(enum status st)
{
	return rows[st].exit_status;
}

const char *status_class(enum status st)
{
	return rows[st].class;
}

const char *status_text(enum status st)
{
	return rows[st].text;
}

enum status status_from_class(const char *name)
{
	for (int i = 0; i < N_STATUS; i++)
		if (!strcmp(rows[i].class, name))
			return (enum status)i;
	return ST_INTERNAL;
}

enum status status_from_errno(int error)
{
	static const int named_wrongly[] = { ENOENT, EACCES, EPERM,        ENOTDIR, EISDIR,
		                             EROFS,  ELOOP,  ENAMETOOLONG, EEXIST,  EINVAL };

	if (error == EINTR || error == ECANCELED)
		return ST_CANCELLED;
	for (size_t i = 0; i < sizeof named_wrongly / sizeof *named_wrongly; i++)
		if (error == named_wrongly[i])
			return ST_INPUT;
	return ST_RESOURCE;
}
