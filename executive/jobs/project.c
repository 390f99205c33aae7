/* project.c - the project folder and the place of its socket. */
#include "project.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "file.h"
#include "hash.h"
#include "path.h"
#include "text.h"

/* There may be a folder of ours in it already; else we must be able to make one. */
static bool takes_sockets(const char *runtime)
{
	char *own = path_join(runtime, "batten");
	bool takes = own && (path_is_folder(own) || !access(runtime, W_OK | X_OK));
	free(own);
	return takes;
}

/* The socket's name: of the folder itself, whatever link it was reached by. */
static char *socket_path(const char *folder)
{
	char hash[HASH_SIZE];
	char *real = realpath(folder, NULL);
	const char *name = real ? real : folder;
	hash_bytes(name, strlen(name), hash);
	free(real);

	const char *runtime = getenv("XDG_RUNTIME_DIR");
	if (runtime && runtime[0] == '/' && takes_sockets(runtime)) {
		char *path = text_print("%s/batten/%s", runtime, hash);
		if (!path || strlen(path) < sizeof(((struct sockaddr_un *)0)->sun_path))
			return path;
		free(path);
	}
	return text_print("/tmp/batten-%u/%s", (unsigned)geteuid(), hash);
}

enum status project_find(struct project *p, const char *from, const struct report *r)
{
	memset(p, 0, sizeof *p);
	char *start = path_absolute(from ? from : ".", NULL);
	if (!start)
		goto fail;
	p->folder = path_find_upward(start, ".batten");
	if (!p->folder) {
		p->folder = start;
		start = NULL;
	}
	free(start);
	start = NULL;
	p->hidden = path_join(p->folder, ".batten");
	p->socket = socket_path(p->folder);
	if (p->hidden && p->socket)
		return ST_OK;
fail:
	free(start);
	project_finish(p);
	return report_error(r, ST_RESOURCE, "cannot find the project folder: out of memory");
}

void project_finish(struct project *p)
{
	if (!p)
		return;
	free(p->folder);
	free(p->hidden);
	free(p->socket);
	memset(p, 0, sizeof *p);
}

enum status project_check(const struct project *p, const struct report *r)
{
	if (text_is_utf8(p->folder))
		return ST_OK;
	return report_error(r, ST_INPUT,
	                    "the name of the folder '%s' is not UTF-8, and no record of a job can "
	                    "hold it; rename it",
	                    p->folder);
}

static enum status socket_folder_make(const struct project *p, const struct report *r)
{
	char *folder = path_folder(p->socket);
	struct stat s;
	enum status st = ST_OK;
	if (!folder)
		return report_error(r, ST_RESOURCE,
		                    "cannot make the socket's folder: out of memory");
	if (mkdir(folder, 0700) && errno != EEXIST)
		st = report_error(r, ST_RESOURCE, "cannot make the socket's folder '%s': %s",
		                  folder, strerror(errno));
	else if (lstat(folder, &s))
		st = report_error(r, ST_RESOURCE, "cannot look at the socket's folder '%s': %s",
		                  folder, strerror(errno));
	else if (!S_ISDIR(s.st_mode) || s.st_uid != geteuid() || (s.st_mode & 077))
		st = report_error(
		        r, ST_INPUT,
		        "the socket's folder '%s' is not a folder that only you can enter; "
		        "take it away or set its mode to 700",
		        folder);
	free(folder);
	return st;
}

enum status project_make(const struct project *p, const struct report *r)
{
	static const char *const folders[] = { "inputs", "parts", "jobs", "logs" };
	for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
		char *path = path_join(p->hidden, folders[i]);
		if (!path)
			return report_error(r, ST_RESOURCE, "cannot make '%s': out of memory",
			                    p->hidden);
		enum status st = folder_make(path, 0777, r);
		free(path);
		if (st != ST_OK)
			return st;
	}
	return socket_folder_make(p, r);
}
