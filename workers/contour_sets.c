/* contour_sets.c - planes and cylinders from parameters: by name, by number, by distance. */
#include "contour_sets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "refine.h"

enum { COUNT_DEFAULT = 10 };

/* A hull that sticks out over its plane of symmetry by less than this part of its breadth is one
 * half. */
static const double half_share = 1e-3;

const char *const contour_names[N_CONTOUR_KINDS] = {
	[CONTOUR_STATIONS] = "station",   [CONTOUR_WATERLINES] = "waterline",
	[CONTOUR_BUTTOCKS] = "buttock",   [CONTOUR_PLANES] = "plane",
	[CONTOUR_CYLINDERS] = "cylinder",
};

/* What can be asked for by a hull's own words. */
static const struct named {
	const char *parameter;
	enum contour_kind kind;
	struct vec3 direction;
} named[] = {
	{ "stations", CONTOUR_STATIONS, { 1, 0, 0 } },
	{ "waterlines", CONTOUR_WATERLINES, { 0, 0, 1 } },
	{ "buttocks", CONTOUR_BUTTOCKS, { 0, 1, 0 } },
};
enum { N_NAMED = sizeof named / sizeof *named };

void contour_sets_finish(struct contour_sets *s)
{
	for (int i = 0; i < CONTOUR_SETS_MAX; i++)
		free(s->set[i].values);
	*s = (struct contour_sets){ .n = 0 };
}

const struct contour_set *contour_sets_at(const struct contour_sets *s, int i, int *place)
{
	int k = 0;
	while (i >= s->set[k].n)
		i -= s->set[k++].n;
	*place = i;
	return &s->set[k];
}

/* Extent of the surfaces along unit vector d, their distance from the axis through p along d. */
static enum status extent(const struct work *w, struct vec3 d, double range[2])
{
	struct vec3 a = fabs(d.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
	struct vec3 x = vec3_unit(vec3_cross(a, d)), y = vec3_cross(d, x);
	const double frame[3][4] = { { x.x, x.y, x.z }, { y.x, y.y, y.z }, { d.x, d.y, d.z } };
	struct box all = box_empty();
	for (int i = 0; i < w->n_surfaces; i++) {
		struct surface turned;
		struct box one;
		if (surface_copy(&turned, w->surfaces[i]) != ST_OK)
			return ST_RESOURCE;
		surface_transform(&turned, frame);
		enum status st = surface_box(&turned, 0, &one);
		surface_finish(&turned);
		if (st != ST_OK)
			return st;
		box_add_box(&all, &one);
	}
	range[0] = all.lo.z;
	range[1] = all.hi.z;
	return ST_OK;
}

/* No point of the surfaces is farther from the axis. */
static double reach(const struct work *w, struct vec3 p, struct vec3 d)
{
	double r = 0;
	for (int k = 0; k < w->n_surfaces; k++) {
		const struct surface *s = w->surfaces[k];
		for (int i = 0; i < s->n[0]; i++)
			for (int j = 0; j < s->n[1]; j++) {
				struct vec3 q = vec3_sub(surface_get_point(s, i, j, NULL), p);
				r = fmax(r, vec3_length(vec3_cross(q, d)));
			}
	}
	return r;
}

/* Room for a set's values. */
static struct contour_set *set_add(struct contour_sets *s, const struct work *w,
                                   enum contour_kind kind, struct vec3 direction, int n)
{
	struct contour_set *set = &s->set[s->n];
	set->values = malloc(sizeof *set->values * (size_t)n);
	if (!set->values) {
		report_error(&w->report, ST_RESOURCE, "no memory for %d contours", n);
		return NULL;
	}
	s->n++;
	s->n_values += n;
	set->kind = kind;
	set->field.kind = kind == CONTOUR_CYLINDERS ? LEVEL_CYLINDER : LEVEL_PLANE;
	set->field.direction = direction;
	set->n = n;
	return set;
}

/* n values inside an interval, as far from its ends as from each other: at the ends planes only
 * touch. */
static void values_inside(struct contour_set *set, double lo, double hi)
{
	set->first = 1;
	for (int i = 0; i < set->n; i++)
		set->values[i] = lo + (hi - lo) * (i + 1) / (set->n + 1);
}

static void values_between(struct contour_set *set, double from, double to)
{
	for (int i = 0; i < set->n; i++)
		set->values[i] = set->n > 1 ? from + (to - from) * i / (set->n - 1) : from;
}

/* "N", or "FROM:TO:N". */
static bool named_parse(const char *text, bool *range, double *from, double *to, int *n)
{
	const char *s = text, *end = text + strlen(text);
	int64_t count;
	*range = strchr(text, ':');
	if (*range) {
		if (!number_read(&s, end, from) || *s++ != ':' || !number_read(&s, end, to) ||
		    *s++ != ':' || !isfinite(*from) || !isfinite(*to))
			return false;
	}
	if (!number_parse_integer(s, &count) || count < 1 || count > CONTOUR_VALUES_MAX)
		return false;
	*n = (int)count;
	return true;
}

static enum status named_read(struct contour_sets *s, const struct work *w, const struct named *how)
{
	const char *text = work_text(w, how->parameter);
	double lo, hi, from = 0, to = 0;
	bool range;
	int n;
	if (!named_parse(text, &range, &from, &to, &n))
		return report_error(&w->report, ST_PARAMETER,
		                    "--%s '%s': expected a number from 1 to %d, or FROM:TO:COUNT",
		                    how->parameter, text, CONTOUR_VALUES_MAX);
	if (range && (from > to || (from == to && n > 1)))
		return report_error(&w->report, ST_PARAMETER,
		                    "--%s %s: the first is not below the last; exchange them",
		                    how->parameter, text);
	struct contour_set *set = set_add(s, w, how->kind, how->direction, n);
	if (!set)
		return ST_RESOURCE;
	if (range) {
		values_between(set, from, to);
		return ST_OK;
	}
	lo = vec3_dot(s->box.lo, how->direction);
	hi = vec3_dot(s->box.hi, how->direction);
	if (how->kind == CONTOUR_BUTTOCKS) {
		lo = s->side > 0 ? 0 : s->box.lo.y;
		hi = s->side > 0 ? s->box.hi.y : 0;
	}
	values_inside(set, lo, hi);
	return ST_OK;
}

/* How many planes or cylinders stand between from and to. */
static enum status count_read(const struct work *w, bool has_from, double from, int *n)
{
	bool has_to = work_has(w, "to"), has_count = work_has(w, "count");
	bool has_spacing = work_has(w, "spacing");
	*n = has_count ? (int)work_integer(w, "count") : has_from ? 1 : COUNT_DEFAULT;
	if ((has_to || has_spacing) && !has_from)
		return report_error(&w->report, ST_PARAMETER,
		                    "--to and --spacing begin at --from, which is not given");
	if (has_to && work_real(w, "to") < from)
		return report_error(&w->report, ST_PARAMETER,
		                    "--from %g is above --to %g; exchange them", from,
		                    work_real(w, "to"));
	if (has_spacing && !(work_real(w, "spacing") > 0))
		return report_error(&w->report, ST_PARAMETER, "--spacing is 0; give a distance");
	if (has_to + has_count + has_spacing == 3)
		return report_error(&w->report, ST_PARAMETER,
		                    "--to, --count and --spacing are given together; leave one "
		                    "out");
	if (has_count && *n > 1 && has_from && !has_to && !has_spacing)
		return report_error(&w->report, ST_PARAMETER,
		                    "--from and --count %d need --to or --spacing", *n);
	if (has_to && !has_count) {
		if (!has_spacing && work_real(w, "to") > from)
			return report_error(&w->report, ST_PARAMETER,
			                    "--from and --to need --count or --spacing");
		/* the last may stand at the end but for rounding */
		double steps =
		        has_spacing ? floor((work_real(w, "to") - from) / work_real(w, "spacing") +
		                            1e-9)
		                    : 0;
		if (!(steps < CONTOUR_VALUES_MAX))
			return report_error(&w->report, ST_PARAMETER,
			                    "--spacing %g makes more than %d contours; take more",
			                    work_real(w, "spacing"), CONTOUR_VALUES_MAX);
		*n = (int)steps + 1;
	}
	return ST_OK;
}

/* Planes across, or cylinders about, one direction. */
static enum status plain_read(struct contour_sets *s, const struct work *w, bool cylinder)
{
	struct vec3 d = vec3(0, 0, 1), p = vec3(0, 0, 0);
	const char *what = cylinder ? "cylinder" : "plane";
	if (work_has(w, what))
		d = work_vector(w, what);
	double l = vec3_length(d), range[2] = { 0, 0 };
	if (!(l > 0) || !isfinite(l))
		return report_error(&w->report, ST_PARAMETER,
		                    "--%s: expected a direction, found no length", what);
	if (work_has(w, "point"))
		p = work_vector(w, "point");
	d = vec3_scale(d, 1 / l);
	bool from_point = !cylinder && work_has(w, "point");
	if (from_point && work_has(w, "from"))
		return report_error(&w->report, ST_PARAMETER,
		                    "the first plane is given twice: take --from or --point");
	bool has_from = from_point || work_has(w, "from");
	double from = from_point ? vec3_dot(p, d) : has_from ? work_real(w, "from") : 0;
	int n;
	enum status st = count_read(w, has_from, from, &n);
	if (st != ST_OK)
		return st;
	if (cylinder && has_from && !(from > 0))
		return report_error(&w->report, ST_PARAMETER,
		                    "--from %g is no radius; give one above 0", from);
	struct contour_set *set =
	        set_add(s, w, cylinder ? CONTOUR_CYLINDERS : CONTOUR_PLANES, d, n);
	if (!set)
		return ST_RESOURCE;
	set->field.point = p;
	if (!has_from) {
		st = cylinder ? ST_OK : extent(w, d, range);
		if (cylinder)
			range[1] = reach(w, p, d);
		values_inside(set, range[0], range[1]);
		return st == ST_OK ? st : report_error(&w->report, st, "no memory for contours");
	}
	set->first = 1;
	if (work_has(w, "to") && !work_has(w, "spacing"))
		values_between(set, from, work_real(w, "to"));
	else
		for (int i = 0; i < n; i++)
			set->values[i] = n > 1 ? from + i * work_real(w, "spacing") : from;
	return ST_OK;
}

static enum status box_read(struct contour_sets *s, const struct work *w)
{
	s->box = box_empty();
	for (int i = 0; i < w->n_surfaces; i++) {
		struct box one;
		if (surface_box(w->surfaces[i], 0, &one) != ST_OK)
			return report_error(&w->report, ST_RESOURCE, "no memory for contours");
		box_add_box(&s->box, &one);
	}
	if (!(box_diagonal(&s->box) > 0))
		return report_error(&w->report, ST_INPUT,
		                    "the surface is a single point and has no contours; choose "
		                    "another entity");
	const double port = s->box.hi.y, starboard = -s->box.lo.y;
	const char *half = work_text(w, "half");
	s->side = port >= starboard ? 1 : -1;
	s->half = strcmp(half, "auto") == 0
	                  ? fmin(port, starboard) <= half_share * fmax(port, starboard)
	                  : strcmp(half, "yes") == 0;
	return ST_OK;
}

enum status contour_sets_read(struct contour_sets *out, const struct work *w)
{
	bool names = false, cylinder = work_has(w, "cylinder"), plane = work_has(w, "plane");
	static const char *const plain[] = { "plane", "cylinder", "point", "from",
		                             "to",    "spacing",  "count" };
	*out = (struct contour_sets){ .n = 0 };
	for (int i = 0; i < N_NAMED; i++)
		names |= work_has(w, named[i].parameter);
	for (size_t i = 0; names && i < sizeof plain / sizeof *plain; i++)
		if (work_has(w, plain[i]))
			return report_error(&w->report, ST_PARAMETER,
			                    "--%s does not go with stations, waterlines and "
			                    "buttocks; give them as FROM:TO:COUNT",
			                    plain[i]);
	if (plane && cylinder)
		return report_error(&w->report, ST_PARAMETER,
		                    "--plane and --cylinder are given; take one of them");
	enum status st = box_read(out, w);
	if (st == ST_OK && !names)
		st = plain_read(out, w, cylinder);
	for (int i = 0; st == ST_OK && i < N_NAMED; i++)
		if (work_has(w, named[i].parameter))
			st = named_read(out, w, &named[i]);
	for (int i = 0; st == ST_OK && i < out->n; i++)
		out->set[i].field.value = out->set[i].values[0];
	if (st == ST_OK && out->n_values > CONTOUR_VALUES_MAX)
		st = report_error(&w->report, ST_PARAMETER,
		                  "%d contours are asked for, at most %d can be; take fewer",
		                  out->n_values, CONTOUR_VALUES_MAX);
	return st;
}
