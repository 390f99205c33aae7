/* propeller.c - a propeller of 1 m diameter: three blades of DTMB propeller 4119 on a hub.
 *
 * x forward along the shaft, right-handed. Sections lie on cylinders, wrapped along the helix of
 * their pitch: a mean line NACA a = 0.8 under the thickness NACA 66 (TMB modified).
 * Source: Jessup, An experimental investigation of viscous aspects of propeller blade flow, thesis,
 * Catholic University of America (1989), geometry of propeller 4119; Abbott and von Doenhoff,
 * Theory of Wing Sections (1959), section 4.5; Brockett, DTMB Report 1780 (1966).
 */
#include <stdlib.h>

#include "construct.h"
#include "example.h"
#include "fit.h"
#include "refine.h"

enum { POINTS = 65, SECTIONS = 33, BLADES = 3, RADII = 10, ORDINATES = 26 };

static const double radius = 0.5, hub = 0.2;

/* r/R, chord/D, pitch/D, thickness/chord, camber/chord; at the tip the chord is 0. */
static const double blade[RADII][5] = {
	{ 0.20, 0.3200, 1.1050, 0.2055, 0.01429 }, { 0.30, 0.3625, 1.1022, 0.1553, 0.02318 },
	{ 0.40, 0.4048, 1.0983, 0.1180, 0.02303 }, { 0.50, 0.4392, 1.0932, 0.0902, 0.02182 },
	{ 0.60, 0.4610, 1.0879, 0.0696, 0.02072 }, { 0.70, 0.4622, 1.0839, 0.0542, 0.02003 },
	{ 0.80, 0.4347, 1.0811, 0.0421, 0.01967 }, { 0.90, 0.3613, 1.0785, 0.0332, 0.01817 },
	{ 0.95, 0.2775, 1.0770, 0.0323, 0.01631 }, { 1.00, 0.0000, 1.0750, 0.0316, 0.01175 },
};

/* Place on the chord, half thickness over the largest thickness. */
static const double thickness[ORDINATES][2] = {
	{ 0, 0 },          { 0.005, 0.0665 }, { 0.0075, 0.0812 }, { 0.0125, 0.1044 },
	{ 0.025, 0.1466 }, { 0.05, 0.2066 },  { 0.075, 0.2525 },  { 0.1, 0.2907 },
	{ 0.15, 0.3521 },  { 0.2, 0.4000 },   { 0.25, 0.4363 },   { 0.3, 0.4637 },
	{ 0.35, 0.4832 },  { 0.4, 0.4952 },   { 0.45, 0.5 },      { 0.5, 0.4962 },
	{ 0.55, 0.4846 },  { 0.6, 0.4653 },   { 0.65, 0.4383 },   { 0.7, 0.4035 },
	{ 0.75, 0.3612 },  { 0.8, 0.3110 },   { 0.85, 0.2532 },   { 0.9, 0.1877 },
	{ 0.95, 0.1143 },  { 1, 0.0333 },
};

struct tables {
	struct table chord; /* chord/D over sqrt(1 - r/R), with which it falls to 0 */
	struct table pitch, thick, camber;
	struct table
	        half; /* half thickness over the root of the place, which is smooth at the nose */
};

static void tables_finish(struct tables *t)
{
	table_finish(&t->chord);
	table_finish(&t->pitch);
	table_finish(&t->thick);
	table_finish(&t->camber);
	table_finish(&t->half);
}

static enum status tables_init(struct tables *t, const struct report *r)
{
	double xy[ORDINATES][2];
	for (int i = 0; i < RADII - 1; i++) {
		xy[i][0] = blade[i][0];
		xy[i][1] = blade[i][1] / sqrt(1 - blade[i][0]);
	}
	/* straight on to the tip, where the ratio is 0 / 0 */
	xy[RADII - 1][0] = 1;
	xy[RADII - 1][1] = 2 * xy[RADII - 2][1] - xy[RADII - 3][1];
	enum status st = table_init(&t->chord, xy, RADII, r);
	struct table *column[] = { &t->pitch, &t->thick, &t->camber };
	for (int k = 0; k < 3 && st == ST_OK; k++) {
		for (int i = 0; i < RADII; i++) {
			xy[i][0] = blade[i][0];
			xy[i][1] = blade[i][2 + k];
		}
		st = table_init(column[k], xy, RADII, r);
	}
	for (int i = 0; i < ORDINATES && st == ST_OK; i++) {
		xy[i][0] = sqrt(thickness[i][0]);
		xy[i][1] = thickness[i][1];
	}
	if (st == ST_OK)
		st = table_init(&t->half, xy, ORDINATES, r);
	return st;
}

static double x_log(double x, double power)
{
	return x > 0 ? pow(x, power) * log(x) : 0;
}

/* Mean line NACA a = 0.8 of unit design lift, over its largest camber. */
static double mean_line(double x)
{
	const double a = 0.8, largest = 0.06790;
	double g = -1 / (1 - a) * (a * a * (0.5 * log(a) - 0.25) + 0.25);
	double h =
	        1 / (1 - a) * (0.5 * (1 - a) * (1 - a) * log(1 - a) - 0.25 * (1 - a) * (1 - a)) + g;
	double d = fabs(a - x);
	double inner =
	        0.5 * x_log(d, 2) - 0.5 * x_log(1 - x, 2) + 0.25 * (1 - x) * (1 - x) - 0.25 * d * d;
	return (inner / (1 - a) - x_log(x, 1) + g - h * x) / (2 * M_PI * (a + 1)) / largest;
}

/* Half thickness over the largest; the blunt trailing edge of the table is drawn to a point. */
static double half_thickness(const struct tables *t, double x)
{
	return table_value(&t->half, sqrt(x)) - thickness[ORDINATES - 1][1] * x;
}

/*
 * Point i of the section at s, 0 root to 1 tip: from the trailing edge over the back (suction side)
 * to the nose and back. r/R goes with the square of 1 - s, so that the chord goes with 1 - s at the
 * tip and the outline is round there.
 */
static void section_points(const struct tables *t, double s, struct vec3 p[POINTS])
{
	double ratio = 1 - (1 - hub) * (1 - s) * (1 - s), at = ratio * radius;
	double chord = 2 * radius * table_value(&t->chord, ratio) * sqrt(1 - ratio);
	double angle = atan(table_value(&t->pitch, ratio) / (M_PI * ratio));
	double thick = table_value(&t->thick, ratio), camber = table_value(&t->camber, ratio);
	for (int i = 0; i < POINTS; i++) {
		/* x = a^2 is smooth at the nose and does not stand still at the trailing edge */
		double a = 1 - 2.0 * i / (POINTS - 1), side = a > 0 ? 1 : -1, x = a * a;
		double along = (0.5 - x) * chord;
		double off = chord * (camber * mean_line(x) + side * thick * half_thickness(t, x));
		double forward = along * sin(angle) + off * cos(angle);
		double around = (along * cos(angle) - off * sin(angle)) / at;
		p[i] = vec3(forward, -at * sin(around), at * cos(around));
	}
}

static enum status make_blade(struct surface *out, const struct report *r)
{
	struct tables t = { 0 };
	struct vec3 line[POINTS], *p = malloc(sizeof *p * POINTS * SECTIONS);
	enum status st = p ? tables_init(&t, r) : ST_RESOURCE;
	for (int j = 0; j < SECTIONS && st == ST_OK; j++) {
		section_points(&t, (double)j / (SECTIONS - 1), line);
		for (int i = 0; i < POINTS; i++)
			p[i * SECTIONS + j] = line[i];
	}
	if (st == ST_OK)
		st = fit_surface(out, p, POINTS, SECTIONS, (int[2]){ 4, 4 }, FIT_UNIFORM, r);
	if (st == ST_OK)
		surface_reverse(out, 0); /* N outward */
	tables_finish(&t);
	free(p);
	return st;
}

/* A cylinder with elliptic ends, the forward one longer, a little thicker than where the blades
 * begin; its profile from forward to aft. */
static enum status make_hub(struct surface *out, const struct report *r)
{
	const double from = 0.17, to = -0.17, at = 1.05 * hub * radius;
	const struct vec3 zero = { 0, 0, 0 }, x = { 1, 0, 0 }, z = { 0, 0, 1 };
	struct curve parts[3] = { { 0 } }, profile = { 0 };
	enum status st = make_arc(&parts[0], zero, x, z, at, 0, M_PI / 2);
	if (st == ST_OK) {
		curve_transform(
		        &parts[0],
		        (double[3][4]){ { 1.4, 0, 0, from }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } });
		st = make_line(&parts[1], vec3(from, 0, at), vec3(to, 0, at));
	}
	if (st == ST_OK)
		st = make_arc(&parts[2], zero, x, z, at, M_PI / 2, M_PI);
	if (st == ST_OK) {
		curve_transform(
		        &parts[2],
		        (double[3][4]){ { 0.6, 0, 0, to }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } });
		st = make_composite(&profile, parts, 3, 1e-12, r);
	}
	if (st == ST_OK)
		st = make_revolution(out, &profile, zero, x, 0, 2 * M_PI);
	for (int i = 0; i < 3; i++)
		curve_finish(&parts[i]);
	curve_finish(&profile);
	return st;
}

enum status example_propeller(struct model *m, const struct report *r)
{
	static const char *const names[BLADES] = { "blade 1", "blade 2", "blade 3" };
	struct surface first, s;
	enum status st = make_blade(&first, r);
	for (int i = 0; i < BLADES && st == ST_OK; i++) {
		double c = cos(2 * M_PI * i / BLADES), d = sin(2 * M_PI * i / BLADES);
		st = surface_copy(&s, &first);
		if (st != ST_OK)
			break;
		surface_transform(
		        &s, (double[3][4]){ { 1, 0, 0, 0 }, { 0, c, -d, 0 }, { 0, d, c, 0 } });
		st = example_add(m, &s, names[i], 0xb8863b);
	}
	if (st == ST_OK)
		st = make_hub(&s, r);
	if (st == ST_OK)
		st = example_add(m, &s, "hub", 0x9c7a3a);
	surface_finish(&first);
	return st;
}
