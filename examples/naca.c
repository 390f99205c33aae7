/* naca.c - a swept and tapered wing, NACA 2412 at the root to 2410 at the tip, the tip rounded.
 *
 * x aft, y along the span to port, z up; half span 6 m, chords 2 and 0.9 m. The sections are
 * smooth in t where x = t^2, from 1 at the trailing edge over the upper side to -1, nose included.
 * Source: Jacobs, Ward and Pinkerton, NACA Report 460 (1933); the last coefficient of the
 * thickness closed to 0.1036 for a sharp trailing edge.
 */
#include "construct.h"
#include "example.h"
#include "fit.h"
#include "refine.h"

enum { POINTS = 81, SECTIONS = 9 };

static const double half_span = 6, sweep = 1.8, dihedral = 0.35;

static double lerp(double a, double b, double t)
{
	return a + t * (b - a);
}

/* Point of the section of unit chord at t. */
static void section_point(double t, double thickness, double *x, double *z)
{
	const double m = 0.02, p = 0.4;
	double c = t * t, root = fabs(t);
	double half = 5 * thickness *
	              (0.2969 * root + c * (-0.1260 + c * (-0.3516 + c * (0.2843 - 0.1036 * c))));
	double line = c < p ? m / (p * p) * c * (2 * p - c)
	                    : m / ((1 - p) * (1 - p)) * (1 - 2 * p + c * (2 * p - c));
	double slope = (c < p ? 2 * m / (p * p) : 2 * m / ((1 - p) * (1 - p))) * (p - c);
	double turn = atan(slope), side = t > 0 ? 1 : -1;
	*x = c - side * half * sin(turn);
	*z = line + side * half * cos(turn);
}

/* The section at s of the half span, 0 root to 1 tip. */
static enum status make_section(struct curve *out, double s, const struct report *r)
{
	struct vec3 p[POINTS];
	double chord = lerp(2, 0.9, s), twist = lerp(0, -3, s) * M_PI / 180;
	for (int i = 0; i < POINTS; i++) {
		double x, z;
		section_point(1 - 2.0 * i / (POINTS - 1), lerp(0.12, 0.10, s), &x, &z);
		if (i == 0 || i == POINTS - 1) {
			x = 1;
			z = 0;
		}
		x = (x - 0.25) * chord;
		z *= chord;
		p[i] = vec3(0.5 + sweep * s + x * cos(twist) + z * sin(twist), half_span * s,
		            dihedral * s - x * sin(twist) + z * cos(twist));
	}
	return fit_curve(out, p, POINTS, 4, FIT_UNIFORM, r);
}

/*
 * The tip: half ellipses, drawn out along y, from every point of the upper side to the one below.
 * The border is the wing's own: its two halves from the trailing edge to the nose.
 */
static enum status make_tip(struct surface *out, const struct surface *wing)
{
	struct curve tip, upper, lower;
	enum status st = surface_isoparametric(&tip, wing, 1, 1);
	if (st != ST_OK)
		return st;
	st = curve_part(&upper, &tip, 0, 0.5);
	if (st != ST_OK)
		goto end_tip;
	st = curve_part(&lower, &tip, 0.5, 1);
	if (st != ST_OK)
		goto end_upper;
	curve_reverse(&lower);
	st = surface_init(out, (int[2]){ upper.order, 3 }, (int[2]){ upper.n, 5 });
	if (st != ST_OK)
		goto end_lower;
	for (int i = 0; i < upper.n; i++) {
		struct vec3 a = curve_get_point(&upper, i, NULL);
		struct vec3 b = curve_get_point(&lower, i, NULL);
		struct vec3 middle = vec3_scale(vec3_add(a, b), 0.5);
		struct vec3 out_by = vec3(0, vec3_length(vec3_sub(a, b)) / 2, 0);
		const struct vec3 row[5] = { a, vec3_add(a, out_by), vec3_add(middle, out_by),
			                     vec3_add(b, out_by), b };
		for (int j = 0; j < 5; j++)
			surface_set_point(out, i, j, row[j], j % 2 ? sqrt(0.5) : 1);
	}
	for (int i = 0; i < upper.n + upper.order; i++)
		out->knots[0][i] = upper.knots[i];
	for (int i = 3; i < 8; i++)
		out->knots[1][i] = i < 5 ? 0.5 : 1;
	out->domain[0][1] = 0.5;
	out->domain[1][1] = 1;
	out->rational = true;
	surface_reverse(out, 1); /* N outward */
end_lower:
	curve_finish(&lower);
end_upper:
	curve_finish(&upper);
end_tip:
	curve_finish(&tip);
	return st;
}

enum status example_naca(struct model *m, const struct report *r)
{
	struct curve sections[SECTIONS] = { 0 };
	struct surface wing = { 0 }, tip = { 0 };
	enum status st = ST_OK;
	for (int i = 0; i < SECTIONS && st == ST_OK; i++)
		st = make_section(&sections[i], (double)i / (SECTIONS - 1), r);
	if (st == ST_OK)
		st = fit_loft(&wing, sections, SECTIONS, 4, FIT_UNIFORM, r);
	for (int i = 0; i < SECTIONS; i++)
		curve_finish(&sections[i]);
	if (st == ST_OK)
		st = make_tip(&tip, &wing);
	if (st == ST_OK) {
		surface_reverse(&wing, 0);
		st = example_add(m, &wing, "wing", 0xb4bcc4);
	}
	if (st == ST_OK)
		st = example_add(m, &tip, "tip", 0xb4bcc4);
	surface_finish(&wing);
	surface_finish(&tip);
	return st;
}
