/* input.c - geometry from the project's files and from IGES, one kind at a time. */
#include <string.h>

#include "private.h"

static void on_progress(void *data, double fraction)
{
	struct act *a = data;

	if (a->progress)
		a->progress(a->data, fraction, "reading");
}

static enum status open_kind(struct act *a, const char *file, const char *entities)
{
	const int before = world_count(a->world);
	const struct progress p = { on_progress, a, a->stop };
	enum status st = world_open_kinds(a->world, file, entities, 1u << a->routine->detail, &p,
	                                  &a->report);

	opened_say(a, file, before);
	return st;
}

enum status input_recall(struct act *a, const struct arguments *given)
{
	return open_kind(a, argument_text(given, "name"), NULL);
}

enum status input_iges(struct act *a, const struct arguments *given)
{
	const char *entity = argument_text(given, "entity");

	return open_kind(a, argument_text(given, "file"),
	                 entity && strcmp(entity, "all") ? entity : NULL);
}
