/* g2_elementary.c - lines, circles, planes, cylinders ... of .g2 as NURBS.
 *
 * Source: GoTools (SINTEF), what the read functions of these classes expect. Newer versions put
 * a range of parameters behind a flag that is 10 more, and end with a flag of direction; older ones
 * have neither.
 */
#include "g2_elementary.h"

#include "construct.h"
#include "refine.h"

/* Ranges that are a whole turn to this are meant to be one. */
static const double turn_within = 1e-4;

/* The numbers of an object, one after the other; what is missing is 0. */
struct numbers {
	const double *x;
	int n, at;
};

static double next(struct numbers *p)
{
	return p->at < p->n ? p->x[p->at++] : (p->at++, 0);
}

static struct vec3 next_vector(struct numbers *p, int dimension)
{
	double x = next(p), y = next(p);
	return vec3(x, y, dimension == 3 ? next(p) : 0);
}

/* Orthonormal axes about a place. */
struct frame {
	struct vec3 o, x, y, z;
};

static bool next_frame(struct numbers *p, int dimension, struct frame *f)
{
	f->o = next_vector(p, dimension);
	struct vec3 z = next_vector(p, dimension), x = next_vector(p, dimension);
	if (dimension == 2)
		z = vec3(0, 0, 1);
	f->z = vec3_unit(z);
	x = vec3_along(x, -vec3_dot(x, f->z), f->z);
	f->x = vec3_unit(x);
	f->y = vec3_cross(f->z, f->x);
	return vec3_length(z) > 0 && vec3_length(x) > 0;
}

/* Where it is (bound), as what parameters (domain), and whether they run otherwise. */
struct range {
	double bound[2][2], domain[2][2];
	bool bounded, turned;
};

static void next_pairs(struct numbers *p, double (*out)[2], int n)
{
	for (int d = 0; d < n; d++)
		for (int k = 0; k < 2; k++)
			out[d][k] = next(p);
}

static void copy_domain(struct range *r)
{
	for (int d = 0; d < 2; d++)
		for (int k = 0; k < 2; k++)
			r->domain[d][k] = r->bound[d][k];
}

/* A whole number that a flag or a dimension may be; -1 for all else. */
static int next_small(struct numbers *p)
{
	const double x = next(p);
	return x >= 0 && x <= 99 && x == floor(x) ? (int)x : -1;
}

/* A flag that says whether there are bounds, those, and at the end one of direction. */
static void next_flagged(struct numbers *p, int n, struct range *r)
{
	int flag = next_small(p);
	r->bounded = flag % 10 == 1;
	next_pairs(p, r->bound, r->bounded ? n : 0);
	copy_domain(r);
	if (flag >= 10)
		next_pairs(p, r->domain, r->bounded ? n : 0);
	r->turned = r->bounded && next(p) == 1;
}

/* Bounds first, then a flag of direction. */
static void next_bounds(struct numbers *p, int n, struct range *r)
{
	next_pairs(p, r->bound, n);
	copy_domain(r);
	int flag = next_small(p);
	if (flag >= 10)
		next_pairs(p, r->domain, n);
	r->bounded = true;
	r->turned = flag % 10 == 1;
}

static void close_turn(struct range *r, int d)
{
	double *bound = r->bound[d], end = bound[0] + 2 * M_PI;
	if (fabs(bound[1] - end) > turn_within)
		return;
	if (r->domain[d][0] == bound[0] && r->domain[d][1] == bound[1])
		r->domain[d][1] = end;
	bound[1] = end;
}

static bool rises(const double x[2])
{
	return x[1] > x[0] && isfinite(x[0]) && isfinite(x[1]);
}

/* ---- curves */

static enum status line(struct numbers *p, int dimension, struct range *r, struct curve *out)
{
	struct vec3 o = next_vector(p, dimension), d = next_vector(p, dimension);
	next_flagged(p, 1, r);
	if (!r->bounded || !rises(r->bound[0]) || !(vec3_length(d) > 0))
		return ST_PARAMETER;
	return make_line(out, vec3_along(o, r->bound[0][0], d), vec3_along(o, r->bound[0][1], d));
}

/* x and y half axes a and b: a circle, turned into what it is. */
static enum status ellipse(struct numbers *p, int dimension, double a, double b, struct range *r,
                           struct curve *out)
{
	struct frame f;
	bool good = next_frame(p, dimension, &f);
	next_bounds(p, 1, r);
	close_turn(r, 0);
	if (!good || !(a > 0 && b > 0))
		return ST_PARAMETER;
	enum status st = make_arc(out, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 1,
	                          r->bound[0][0], r->bound[0][1]);
	const double m[3][4] = { { a * f.x.x, b * f.y.x, f.z.x, f.o.x },
		                 { a * f.x.y, b * f.y.y, f.z.y, f.o.y },
		                 { a * f.x.z, b * f.y.z, f.z.z, f.o.z } };
	if (st == ST_OK)
		curve_transform(out, m);
	return st;
}

static enum status make_curve(int class, struct numbers *p, int dimension, struct curve *out)
{
	struct range r = { 0 };
	enum status st;
	if (class == 120) {
		st = line(p, dimension, &r, out);
	} else {
		double a = next(p), b = class == 140 ? next(p) : a;
		st = ellipse(p, dimension, a, b, &r, out);
	}
	if (st != ST_OK || !rises(r.domain[0]))
		return st == ST_OK ? ST_PARAMETER : st;
	curve_reparametrise(out, r.domain[0][0], r.domain[0][1]);
	if (r.turned)
		curve_reverse(out);
	return st;
}

/* ---- surfaces */

static enum status plane(struct numbers *p, struct range *r, struct surface *out)
{
	struct frame f;
	struct vec3 corner[4];
	bool good = next_frame(p, 3, &f);
	next_flagged(p, 2, r);
	if (!good || !r->bounded)
		return ST_PARAMETER;
	for (int i = 0; i < 4; i++)
		corner[i] = vec3_along(vec3_along(f.o, r->bound[0][i % 2], f.x), r->bound[1][i / 2],
		                       f.y);
	return make_bilinear(out, corner);
}

/* A profile in the plane of x and z, turned about z: u is the angle. */
static enum status turn(struct curve *profile, const struct frame *f, struct range *r,
                        struct surface *out)
{
	close_turn(r, 0);
	enum status st = make_revolution(out, profile, f->o, f->z, r->bound[0][0], r->bound[0][1]);
	curve_finish(profile);
	return st == ST_OK ? surface_exchange(out) : st;
}

static enum status cone(struct numbers *p, bool pointed, struct range *r, struct surface *out)
{
	struct frame f;
	struct curve profile;
	struct vec3 end[2];
	double radius = next(p);
	bool good = next_frame(p, 3, &f);
	double slope = pointed ? tan(next(p)) : 0;
	next_flagged(p, 2, r);
	if (!good || !r->bounded || !isfinite(slope))
		return ST_PARAMETER;
	for (int k = 0; k < 2; k++) {
		double v = r->bound[1][k];
		end[k] = vec3_along(vec3_along(f.o, radius + v * slope, f.x), v, f.z);
	}
	enum status st = make_line(&profile, end[0], end[1]);
	return st == ST_OK ? turn(&profile, &f, r, out) : st;
}

/* A sphere has no major radius, and no choice between the parts of a torus that meets itself. */
static enum status torus(struct numbers *p, bool sphere, struct range *r, struct surface *out)
{
	struct frame f;
	struct curve profile;
	double major = sphere ? 0 : next(p), radius = next(p);
	bool good = next_frame(p, 3, &f);
	if (!sphere)
		next(p);
	next_bounds(p, 2, r);
	close_turn(r, 1);
	if (!good)
		return ST_PARAMETER;
	enum status st = make_arc(&profile, vec3_along(f.o, major, f.x), f.x, f.z, radius,
	                          r->bound[1][0], r->bound[1][1]);
	return st == ST_OK ? turn(&profile, &f, r, out) : st;
}

static enum status make_surface(int class, struct numbers *p, struct surface *out)
{
	struct range r = { 0 };
	enum status st = class == 250   ? plane(p, &r, out)
	                 : class <= 260 ? cone(p, false, &r, out)
	                 : class == 270 ? torus(p, true, &r, out)
	                 : class == 280 ? cone(p, true, &r, out)
	                                : torus(p, false, &r, out);
	if (st != ST_OK || !rises(r.domain[0]) || !rises(r.domain[1]))
		return st == ST_OK ? ST_PARAMETER : st;
	for (int d = 0; d < 2; d++)
		surface_reparametrise(out, d, r.domain[d][0], r.domain[d][1]);
	return r.turned ? surface_exchange(out) : ST_OK;
}

bool g2_is_elementary(int class, enum entity_kind *kind)
{
	*kind = class < 200 ? ENTITY_CURVE : ENTITY_SURFACE;
	return class == 120 || class == 130 || class == 140 || class == 250 || class == 260 ||
	       class == 270 || class == 280 || class == 290;
}

enum status g2_make_elementary(int class, const double *x, int n, struct entity *e,
                               const char **reason)
{
	struct numbers p = { x, n, 0 };
	int dimension = next_small(&p);
	*reason = "its numbers describe nothing, or it has no bounds; give it bounds or convert it "
	          "to splines";
	if (dimension != 3 && !(dimension == 2 && class < 200))
		return ST_INPUT;
	enum status st = class < 200 ? make_curve(class, &p, dimension, &e->curve)
	                             : make_surface(class, &p, &e->geometry);
	if (st == ST_OK && p.at > n + 1)
		st = ST_INPUT; /* more than the flag of direction is missing */
	return st == ST_PARAMETER ? ST_INPUT : st;
}
