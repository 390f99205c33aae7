/* contours.c - planes and cylinders as the settings describe them, as parameters of the worker. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "private.h"
#include "text.h"

/* Axis of a family, 0 x to 2 z; -1: none. */
static int family_axis(const struct world *w)
{
	static const char *const words[] = { "stations", "buttocks", "waterlines" };
	const char *family = world_default(w, "planes", "family");

	for (int k = 0; family && k < 3; k++)
		if (!strcmp(family, words[k]))
			return k;
	return -1;
}

static const char *or_ten(const char *count)
{
	return count ? count : "10";
}

/* COUNT, or FROM:TO:COUNT where a point and a distance are set. */
static char *family_value(const struct world *w, int axis)
{
	const char *point = world_default(w, "planes", "point"),
	           *distance = world_default(w, "planes", "distance"),
	           *count = or_ten(world_default(w, "planes", "count"));
	const char *at[1] = { "point" }, *is[1] = { point };
	const struct arguments one = { at, is, 1 };
	struct text t = { 0 };
	struct vec3 p;
	double step, n;

	if (point && distance && argument_vector(&one, "point", &p) &&
	    number_parse(distance, &step) && number_parse(count, &n)) {
		const double from = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
		text_add_number(&t, from);
		text_add(&t, ":");
		text_add_number(&t, from + step * fmax(n - 1, 0));
		text_add(&t, ":");
	}
	text_add(&t, count);
	return text_take(&t);
}

static char *plane_default(const struct world *w, const char *parameter)
{
	static const char *const families[] = { "stations", "buttocks", "waterlines" };
	static const struct {
		const char *parameter, *setting;
	} same[] = {
		{ "plane", "normal" },
		{ "point", "point" },
		{ "spacing", "distance" },
		{ "count", "count" },
	};
	const int axis = family_axis(w);
	const char *value = NULL;

	if (axis >= 0)
		return strcmp(parameter, families[axis]) ? NULL : family_value(w, axis);
	for (size_t k = 0; k < sizeof same / sizeof *same; k++)
		if (!strcmp(parameter, same[k].parameter))
			value = world_default(w, "planes", same[k].setting);
	return value ? strdup(value) : NULL;
}

static char *cylinder_default(const struct world *w, const char *parameter)
{
	static const struct {
		const char *parameter, *setting, *otherwise;
	} same[] = {
		{ "cylinder", "axis", "0,0,1" }, { "point", "point", NULL },
		{ "from", "radius", NULL },      { "spacing", "distance", NULL },
		{ "count", "count", NULL },
	};

	for (size_t k = 0; k < sizeof same / sizeof *same; k++) {
		if (strcmp(parameter, same[k].parameter))
			continue;
		const char *value = world_default(w, "cylinders", same[k].setting);
		value = value ? value : same[k].otherwise;
		return value ? strdup(value) : NULL;
	}
	return NULL;
}

/* The accuracies, in space and in u, v; both hold. */
static char *accuracy_default(const struct world *w, const char *what, const char *setting)
{
	const char *value = world_default(w, what, setting);

	return value ? strdup(value) : NULL;
}

char *contours_default(const struct world *w, bool cylinders, const char *parameter)
{
	const char *what = cylinders ? "cylinders" : "planes";

	if (!strcmp(parameter, "tolerance"))
		return accuracy_default(w, what, "tolerance");
	if (!strcmp(parameter, "tolerance-uv"))
		return accuracy_default(w, what, "tolerance_uv");
	return cylinders ? cylinder_default(w, parameter) : plane_default(w, parameter);
}

bool contours_is_other(bool cylinders, const char *parameter)
{
	static const char *const of_planes[] = { "stations", "waterlines", "buttocks", "plane",
		                                 "half",     "draught",    "bow" };

	if (!cylinders)
		return !strcmp(parameter, "cylinder");
	for (size_t k = 0; k < sizeof of_planes / sizeof *of_planes; k++)
		if (!strcmp(parameter, of_planes[k]))
			return true;
	return false;
}
