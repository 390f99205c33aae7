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

bool room_is_ample(const struct work *w, const char *part)
{
	const double twice = 2 * w->private->bytes_max;
	struct place units = { .path = part };
	struct place output = { .path = w->private->computation->base };
	bool ample = twice > 0 && place_look(&units) && place_look(&output) && units.free > twice &&
	             output.free > twice;
	free(units.folder);
	free(output.folder);
	return ample;
}

enum status room_check(const struct work *w, const char *part, size_t n_left)
{
	const struct work_private *p = w->private;
	if (part_count(p->part) == 0)
		return ST_OK;
	double mean = (double)part_bytes(p->part) / (double)part_count(p->part);
	bool kept = p->task->n_shards > 0 || !worker.units_are_output;
	struct place units = { .path = part, .wanted = mean * (double)n_left };
	struct place output = { .path = p->computation->base,
		                .wanted = kept ? 0 : mean * (double)p->n_units };
	enum status st = ST_OK;
	if (place_look(&units) && place_look(&output)) {
		if (units.disk == output.disk && p->in_place)
			output.wanted = units.wanted; /* the part file becomes the output */
		else if (units.disk == output.disk)
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
