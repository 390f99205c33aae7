/* hull.c - a frigate's hull, 142 m on the waterline: bulb, flare forward, transom, sheer.
 *
 * Lofted through sections from formulas of our own. x runs from the transom (0) forward to the
 * forward perpendicular (142), y to port, z up from the base line; draught 6.2. A section is a
 * quartic B-spline whose control points lie on ten lines that run the length of the ship, from the
 * keel (line 0) to the edge of the deck (line 9). Each line is a formula in t, from 0 at the stem
 * to 1 at the transom; x - stem goes with t^2 near the stem and breadths with t, so all surfaces
 * cross the centre plane at right angles: stem and bulb are round, however fine.
 */
#include <stdlib.h>

#include "construct.h"
#include "example.h"
#include "fit.h"
#include "refine.h"

enum { LINES = 10, SECTIONS = 57, ORDER = 5 };

static const double length = 142;

/* One line of control points. */
static const struct line {
	double stem_x, stem_z; /* where it meets the stem */
	double breadth, z;     /* half breadth and height amidships */
	double stern_breadth, stern_z;
	double hollow;   /* entrance: 4 starts along the centre plane, 0 and less is full */
	double entrance; /* length of the entrance over that of the ship */
	double round;    /* half breadth that the rounding of the stem adds near it */
	double bulb;     /* half breadth that the bulb adds */
} lines[LINES] = {
	{ 134.0, 0.00, 0.00, 0.00, 0.00, 5.30, 2.73, 0.84, 0.00, 0.00 },
	{ 138.5, 0.00, 2.80, 0.00, 2.90, 5.30, 2.73, 0.84, 0.25, 0.35 },
	{ 143.6, 0.00, 6.30, 0.55, 5.50, 5.45, 2.73, 0.84, 0.25, 0.80 },
	{ 147.6, 1.00, 8.85, 1.85, 7.20, 5.85, 2.60, 0.84, 0.25, 1.25 },
	{ 148.4, 4.00, 9.45, 3.90, 8.05, 6.60, 2.47, 0.83, 0.25, 1.20 },
	{ 142.0, 5.10, 9.55, 5.80, 8.45, 7.60, 2.22, 0.80, 0.25, 0.40 },
	{ 141.6, 7.00, 9.62, 7.60, 8.70, 8.60, 1.72, 0.76, 0.25, 0.08 },
	{ 144.6, 9.40, 9.68, 9.20, 8.88, 9.60, 0.84, 0.72, 0.30, 0.00 },
	{ 148.4, 12.00, 9.74, 10.60, 9.00, 10.50, -0.30, 0.67, 0.40, 0.00 },
	{ 151.8, 14.40, 9.80, 11.80, 9.10, 11.40, -1.31, 0.62, 0.50, 0.00 },
};

/* 0 at x <= 0, 1 at 1, two derivatives at 0, no inflection between. */
static double rise(double x)
{
	double q = x < 0 ? 0 : x;
	return q * q * q * (2 - q);
}

/* From 0 at the stem to 1 where the entrance ends, three derivatives there. */
static double entrance_curve(double q, double hollow)
{
	double rest = q < 1 ? 1 - q : 0;
	return 1 - rest * rest * rest * rest * (1 + hollow * q);
}

static double bell(double x)
{
	return exp(-x * x);
}

/* Control point of line k at t. */
static struct vec3 line_point(int k, double t)
{
	const struct line *l = &lines[k];
	/* distance from the stem over the length: quadratic at first, then nearly even; the keel,
	 * which comes from its end at full speed, somewhat ahead */
	double along = t * t * (2.2 - 1.2 * t);
	if (k == 0)
		along += 0.03 * t * bell(t / 0.3);
	double x = length * (1 - along) + (l->stem_x - length) * bell(t / 0.24);

	double entrance = l->breadth * entrance_curve(along / l->entrance, l->hollow);
	double nose = l->round * t / 0.05 * bell(t / 0.3);
	double bulb = l->bulb * t / 0.16 * exp(0.5 - 0.5 * (t / 0.16) * (t / 0.16));
	double y = sqrt(entrance * entrance + nose * nose) + bulb;

	double stern = rise((t - 0.42) / 0.58);
	y += (l->stern_breadth - l->breadth) * stern;
	double bow = bell(t / (k < 5 ? 0.26 : 0.26 + 0.05 * (k - 4)));
	double z = l->z + (l->stem_z - l->z) * bow + (l->stern_z - l->z) * stern;
	return vec3(x, k == 0 || t == 0 ? 0 : y, z);
}

static enum status make_section(struct curve *c, double t)
{
	enum status st = curve_init(c, ORDER, LINES);
	if (st != ST_OK)
		return st;
	for (int k = 0; k < LINES; k++)
		curve_set_point(c, k, line_point(k, t), 1);
	for (int i = 0; i < LINES + ORDER; i++) {
		int at = i - ORDER + 1, last = LINES - ORDER + 1;
		c->knots[i] = (double)(at < 0 ? 0 : at > last ? last : at) / last;
	}
	c->domain[1] = 1;
	return ST_OK;
}

/* Port side: u from keel to deck, v from stem to transom. */
static enum status make_side(struct surface *out, const struct report *r)
{
	struct curve sections[SECTIONS] = { 0 };
	enum status st = ST_OK;
	for (int i = 0; i < SECTIONS && st == ST_OK; i++)
		st = make_section(&sections[i], (double)i / (SECTIONS - 1));
	if (st == ST_OK)
		st = fit_loft(out, sections, SECTIONS, ORDER, FIT_UNIFORM, r);
	for (int i = 0; i < SECTIONS; i++)
		curve_finish(&sections[i]);
	/* the right angle at the stem, which interpolation has but nearly; the keel goes on */
	for (int k = 1; k < LINES && st == ST_OK; k++) {
		struct vec3 stem = surface_get_point(out, k, 0, NULL);
		double y = surface_get_point(out, k, 1, NULL).y;
		surface_set_point(out, k, 1, vec3(stem.x, y, stem.z), 1);
	}
	return st;
}

static void mirror_curve(struct curve *c)
{
	static const double mirror[3][4] = { { 1, 0, 0, 0 }, { 0, -1, 0, 0 }, { 0, 0, 1, 0 } };
	curve_transform(c, mirror);
}

/* Between a border of the port side and its mirror image; the border is u or v at its end. */
static enum status make_between(struct surface *out, const struct surface *side, int d)
{
	struct curve port, starboard = { 0 };
	enum status st = surface_isoparametric(&port, side, d, side->domain[d][1]);
	if (st != ST_OK)
		return st;
	st = curve_copy(&starboard, &port);
	if (st == ST_OK) {
		mirror_curve(&starboard);
		st = make_ruled(out, &port, &starboard);
	}
	curve_finish(&port);
	curve_finish(&starboard);
	return st;
}

/*
 * Parabolic camber of a fiftieth of the breadth: the middle of three rows across goes up, on the
 * deck everywhere, on the transom (flat) more and more towards the deck, so that both end alike.
 */
static enum status camber(struct surface *s, bool flat)
{
	struct surface raised;
	enum status st = surface_elevate(&raised, s, 1, 1);
	surface_finish(s);
	if (st != ST_OK)
		return st;
	int last = raised.n[0] - 1;
	for (int i = 0; i <= last; i++) {
		struct vec3 p = surface_get_point(&raised, i, 1, NULL);
		double half = surface_get_point(&raised, flat ? last : i, 0, NULL).y;
		double part = flat ? (double)i / last : 1;
		p.z += 0.08 * half * part * part;
		surface_set_point(&raised, i, 1, vec3(p.x, 0, p.z), 1);
	}
	*s = raised;
	return ST_OK;
}

enum status example_hull(struct model *m, const struct report *r)
{
	struct surface side, deck = { 0 }, transom = { 0 };
	enum status st = make_side(&side, r);
	if (st != ST_OK)
		return st;
	st = make_between(&deck, &side, 0);
	if (st == ST_OK)
		st = camber(&deck, false);
	if (st == ST_OK)
		st = make_between(&transom, &side, 1);
	if (st == ST_OK)
		st = camber(&transom, true);
	if (st == ST_OK) { /* N outward */
		surface_reverse(&side, 1);
		surface_reverse(&transom, 1);
		st = example_add_mirrored(m, &side, "hull port", "hull starboard", 0x6b7f8c);
	}
	if (st == ST_OK)
		st = example_add(m, &transom, "transom", 0x6b7f8c);
	if (st == ST_OK)
		st = example_add(m, &deck, "deck", 0x9a8f7a);
	surface_finish(&side);
	surface_finish(&deck);
	surface_finish(&transom);
	return st;
}
