/* contour_sets.h - which planes and cylinders the contours worker cuts with. */
#ifndef BATTEN_CONTOUR_SETS_H
#define BATTEN_CONTOUR_SETS_H

#include "box.h"
#include "level.h"
#include "worker.h"

enum { CONTOUR_SETS_MAX = 3, CONTOUR_VALUES_MAX = 1000 };

enum contour_kind {
	CONTOUR_STATIONS,   /* planes across the ship, x = value */
	CONTOUR_WATERLINES, /* level planes, z = value */
	CONTOUR_BUTTOCKS,   /* upright planes along the ship, y = value */
	CONTOUR_PLANES,
	CONTOUR_CYLINDERS,
	N_CONTOUR_KINDS
};

extern const char *const contour_names[N_CONTOUR_KINDS]; /* "station" */

/* Cuts of one kind, all along one direction. */
struct contour_set {
	enum contour_kind kind;
	struct level_field field; /* value: of the first */
	double *values;           /* owned, rising */
	int n;
	int first; /* number of the first value: 0 where a range was given, else 1 */
};

struct contour_sets {
	struct contour_set set[CONTOUR_SETS_MAX];
	int n;
	int n_values; /* of all sets */
	struct box box;
	bool half;   /* the surfaces are one half of a hull, y = 0 its plane of symmetry */
	double side; /* 1: port, y > 0, is there; -1: starboard alone */
};

/* The rows of these parameters, for the worker's table. */
/* clang-format off */
#define PARAM_ROWS_CONTOURS                                                                        \
	{ .name = "stations", .type = PARAM_TEXT,                                                  \
	  .help = "planes across a ship that lies along x: how many, evenly inside its length, "   \
		  "or FROM:TO:COUNT with both ends" },                                             \
	{ .name = "waterlines", .type = PARAM_TEXT,                                                \
	  .help = "level planes: how many, or FROM:TO:COUNT" },                                    \
	{ .name = "buttocks", .type = PARAM_TEXT,                                                  \
	  .help = "upright planes along the ship on one side of y = 0: how many, or "              \
		  "FROM:TO:COUNT" },                                                               \
	{ .name = "plane", .type = PARAM_VECTOR,                                                   \
	  .help = "direction across parallel planes, any length (0,0,1 where nothing is given)" }, \
	{ .name = "cylinder", .type = PARAM_VECTOR,                                                \
	  .help = "direction of the axis of cylinders, any length" },                              \
	{ .name = "point", .type = PARAM_VECTOR, .unit = "file",                                   \
	  .help = "a point of the axis (0,0,0 where not given), or of the first plane, instead "   \
		  "of from" },                                                                     \
	{ .name = "from", .type = PARAM_REAL, .unit = "file",                                      \
	  .help = "first plane's distance from the origin along the direction, or first radius" }, \
	{ .name = "to", .type = PARAM_REAL, .unit = "file",                                        \
	  .help = "last of several planes or radii" },                                             \
	{ .name = "spacing", .type = PARAM_REAL, .min = 0, .max = INFINITY, .unit = "file",        \
	  .help = "distance from one to the next" },                                               \
	{ .name = "count", .type = PARAM_INTEGER, .min = 1, .max = CONTOUR_VALUES_MAX,             \
	  .help = "how many planes or cylinders (10, evenly inside the size, where neither "       \
		  "from nor point is given)" },                                                    \
	{ .name = "half", .type = PARAM_CHOICE, .def = "auto", .choices = "auto yes no",           \
	  .help = "the surfaces are one half of a ship: its mirror image over y = 0 is "           \
		  "measured with it" }
/* clang-format on */

/* Errors: ST_PARAMETER, ST_INPUT (surfaces without size), ST_RESOURCE. */
enum status contour_sets_read(struct contour_sets *out, const struct work *w);
void contour_sets_finish(struct contour_sets *s); /* a zeroed one is fine */

/* The set and place in it of value i of all. */
const struct contour_set *contour_sets_at(const struct contour_sets *s, int i, int *place);

#endif
