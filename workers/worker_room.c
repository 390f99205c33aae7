/* worker_room.c - is there room on the disk for what is still to come? */
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/statvfs.h>

#include "path.h"
#include "worker_private.h"

static const double mib = 1 << 20;

/* A place on a disk, and how much of it is wanted and free, in bytes. */
struct place {
	const char *path; /* borrowed */
	char *folder;     /* owned */
	dev_t disk;
	double wanted, free;
};

/* False where it cannot be known: then nothing is refused. */
static bool place_look(struct place *p)
{
	struct statvfs v;
	struct stat s;
	p->folder = path_folder(p->path);
	if (!p->folder || stat(p->folder, &s) || statvfs(p->folder, &v) || !v.f_blocks)
		return false;
	p->disk = s.st_dev;
	p->free = (double)v.f_bavail * (double)v.f_frsize;
	return true;
}

static enum status refuse(const struct work *w, const struct place *p)
{
	return report_error(
	        &w->report, ST_RESOURCE,
	        "not enough room: about %.0f MiB more are wanted in '%s' and %.0f MiB are "
	        "free; make room and run it again, what is done is kept",
	        ceil(p->wanted / mib), p->folder, floor(p->free / mib));
}

enum status room_check(const struct work *w, const char *part, size_t n_left)
{
	const struct work_private *p = w->private;
	struct stat s;
	if (part_count(p->part) == 0 || stat(part, &s))
		return ST_OK;
	double mean = (double)s.st_size / (double)part_count(p->part);
	bool copied = worker.units_are_output && p->task->n_shards == 0;
	struct place units = { .path = part, .wanted = mean * (double)n_left };
	struct place output = { .path = p->computation->base,
		                .wanted = copied ? mean * (double)p->n_units : 0 };
	enum status st = ST_OK;
	if (place_look(&units) && place_look(&output)) {
		if (units.disk == output.disk)
			units.wanted = output.wanted += units.wanted;
		if (output.wanted > output.free)
			st = refuse(w, &output);
		else if (units.wanted > units.free)
			st = refuse(w, &units);
	}
	free(units.folder);
	free(output.folder);
	return st;
}
