/* level_edge.c - what lies between two patches, or between a patch and nothing.
 *
 * Shared sides are made equal to the bit, so that both patches see the same zeros of f there.
 */
#include "level_private.h"

#include <math.h>
#include <string.h>

enum { EDGE_SAMPLES = 7 };

/* Borders that differ by less, as a part of the size, do meet: what files with seven digits keep of
 * a closed surface. */
#define GAP_SHARE 1e-6

/* Derivatives that differ by less over a knot line are the same. */
#define SLOPE_SHARE 1e-9

size_t level_edge(const struct level_surface *s, int d, int i, int j)
{
	return d == 0 ? (size_t)i * s->net.spans[1] + j : (size_t)i * (s->net.spans[1] + 1) + j;
}

/* Coefficients on one side of a patch: first, step between them. */
struct side {
	double *c;
	size_t step;
	int degree;
};

static struct side side_of(double *patch, const int degree[2], int d, bool upper)
{
	size_t row = (size_t)4 * (degree[1] + 1);
	if (d == 0)
		return (struct side){ patch + (upper ? row * degree[0] : 0), 4, degree[1] };
	return (struct side){ patch + (upper ? (size_t)4 * degree[1] : 0), row, degree[0] };
}

static struct vec3 side_at(const struct side *s, const double *b)
{
	struct vec3 r = { 0 };
	for (int i = 0; i <= s->degree; i++) {
		const double *c = s->c + s->step * i;
		r = vec3_along(r, b[i], vec3(c[0], c[1], c[2]));
	}
	return r;
}

/* Largest difference of two sides, and in *size their largest number. */
static double side_difference(const struct side *a, const struct side *b, double *size)
{
	double most = 0;
	*size = 0;
	for (int i = 0; i <= a->degree; i++)
		for (int c = 0; c < 4; c++) {
			double x = a->c[a->step * i + c], y = b->c[b->step * i + c];
			most = larger(most, fabs(x - y));
			*size = larger(*size, larger(fabs(x), fabs(y)));
		}
	return most;
}

static bool smooth_at(const struct side *a, const struct side *b, double t)
{
	double w[NORMAL_DEGREE_MAX + 1];
	bernstein(a->degree + 1, t, w, NULL);
	struct vec3 x = vec3_unit(side_at(a, w)), y = vec3_unit(side_at(b, w));
	return vec3_length(vec3_sub(x, y)) <= SMOOTH_ANGLE;
}

static bool side_smooth(const struct side *a, const struct side *b)
{
	for (int i = 0; i < EDGE_SAMPLES; i++)
		if (!smooth_at(a, b, (i + 0.5) / EDGE_SAMPLES))
			return false;
	return true;
}

/* The patches below and above a line, the two ends of a seam being one line. */
static void patches_at(const struct level_surface *s, int d, int line, int along, int patch[2])
{
	int lines = s->net.spans[d], across = s->net.spans[1 - d];
	int at[2] = { line > 0 ? line - 1 : lines - 1, line < lines ? line : 0 };
	for (int k = 0; k < 2; k++)
		patch[k] = d == 0 ? at[k] * across + along : along * lines + at[k];
}

bool level_smooth_at(const struct level_surface *s, int d, int line, int along, double at)
{
	int patch[2];
	patches_at(s, d, line, along, patch);
	struct side a = side_of(s->normals + level_normals_size(s) * patch[0], s->degree, d, true);
	struct side b = side_of(s->normals + level_normals_size(s) * patch[1], s->degree, d, false);
	bool smooth = smooth_at(&a, &b, at);
	/* for want of memory it is one */
	if (smooth && s->kind == LEVEL_CURVATURE &&
	    level_curvature_agrees(s, patch, d, &at, 1, &smooth) != ST_OK)
		return false;
	return smooth;
}

static enum edge_kind edge_between(struct level_surface *s, int lower, int upper, int d)
{
	const struct bezier_net *net = &s->net;
	int degree[2] = { net->order[0] - 1, net->order[1] - 1 };
	size_t size = bezier_patch_size(net);
	double most;
	struct side a = side_of(net->points + size * lower, degree, d, true);
	struct side b = side_of(net->points + size * upper, degree, d, false);
	double gap = side_difference(&a, &b, &most);
	if (gap > GAP_SHARE * larger(net->size, most))
		return EDGE_GAP;
	if (!level_needs_normals(s->kind))
		return gap == 0 ? EDGE_SHARED : EDGE_SMOOTH;
	a = side_of(s->normals + level_normals_size(s) * lower, s->degree, d, true);
	b = side_of(s->normals + level_normals_size(s) * upper, s->degree, d, false);
	gap = side_difference(&a, &b, &most);
	if (gap <= 1e-10 * most) {
		/* a surface whose normals do agree is not further off than this */
		s->normal_error[upper] += gap;
		for (int i = 0; i <= a.degree; i++)
			memcpy(b.c + b.step * i, a.c + a.step * i, sizeof(double[4]));
		return EDGE_SHARED;
	}
	return side_smooth(&a, &b) ? EDGE_SMOOTH : EDGE_CREASE;
}

/* The first difference across a side, as a derivative by the surface's parameter, is the same on
 * the other side: `row` doubles of each coefficient, `width` those of the two spans. */
static bool slopes_agree(const struct side *a, const struct side *b, ptrdiff_t inwards,
                         const double width[2])
{
	double off = 0, most = 0;
	for (int i = 0; i <= a->degree; i++)
		for (int c = 0; c < 4; c++) {
			const double *x = a->c + a->step * i + c, *y = b->c + b->step * i + c;
			double below = (x[0] - *(x - inwards)) / width[0];
			double above = (y[inwards] - y[0]) / width[1];
			off = larger(off, fabs(below - above));
			most = larger(most, larger(fabs(below), fabs(above)));
		}
	return off <= SLOPE_SHARE * most;
}

/* The derivatives of f may jump: a curve that touches the line need not go on as it came. */
static bool edge_bent(const struct level_surface *s, int lower, int upper, int d)
{
	const struct bezier_net *net = &s->net;
	int degree[2] = { net->order[0] - 1, net->order[1] - 1 }, at[2] = { lower, upper };
	size_t size = bezier_patch_size(net), row = d == 0 ? (size_t)4 * net->order[1] : 4;
	double width[2];
	for (int k = 0; k < 2; k++) {
		int place = d == 0 ? at[k] / net->spans[1] : at[k] % net->spans[1];
		width[k] = net->breaks[d][place + 1] - net->breaks[d][place];
	}
	struct side a = side_of(net->points + size * lower, degree, d, true);
	struct side b = side_of(net->points + size * upper, degree, d, false);
	if (!slopes_agree(&a, &b, (ptrdiff_t)row, width))
		return true;
	if (!level_needs_normals(s->kind))
		return false;
	row = d == 0 ? (size_t)4 * (s->degree[1] + 1) : 4;
	a = side_of(s->normals + level_normals_size(s) * lower, s->degree, d, true);
	b = side_of(s->normals + level_normals_size(s) * upper, s->degree, d, false);
	return !slopes_agree(&a, &b, (ptrdiff_t)row, width);
}

/* The points on one side of a patch are one point. */
static enum edge_kind edge_outside(const struct level_surface *s, int patch, int d, bool upper)
{
	const struct bezier_net *net = &s->net;
	int degree[2] = { net->order[0] - 1, net->order[1] - 1 };
	struct side a = side_of(net->points + bezier_patch_size(net) * patch, degree, d, upper);
	for (int i = 1; i <= a.degree; i++)
		for (int c = 0; c < 3; c++) {
			const double *p = a.c + a.step * i;
			if (fabs(p[c] / p[3] - a.c[c] / a.c[3]) > 1e-9 * net->size)
				return EDGE_BORDER;
		}
	return EDGE_POLE;
}

/* The two ends of direction d meet, if not as nearly as the net asks for. */
static bool ends_meet(const struct level_surface *s, int d)
{
	const struct bezier_net *net = &s->net;
	int degree[2] = { net->order[0] - 1, net->order[1] - 1 };
	size_t size = bezier_patch_size(net);
	double most;
	for (int a = 0; a < net->spans[1 - d]; a++) {
		int patch[2];
		patches_at(s, d, 0, a, patch);
		struct side x = side_of(net->points + size * patch[0], degree, d, true);
		struct side y = side_of(net->points + size * patch[1], degree, d, false);
		if (side_difference(&x, &y, &most) > GAP_SHARE * larger(net->size, most))
			return false;
	}
	return true;
}

/* Curvatures may jump where normals do not. */
static enum status edge_curved(const struct level_surface *s, const int patch[2], int d,
                               enum edge_kind *kind)
{
	double at[EDGE_SAMPLES];
	bool agrees;
	if (s->kind != LEVEL_CURVATURE || (*kind != EDGE_SHARED && *kind != EDGE_SMOOTH))
		return ST_OK;
	for (int i = 0; i < EDGE_SAMPLES; i++)
		at[i] = (i + 0.5) / EDGE_SAMPLES;
	enum status st = level_curvature_agrees(s, patch, d, at, EDGE_SAMPLES, &agrees);
	*kind = agrees ? EDGE_SMOOTH : EDGE_CREASE;
	return st;
}

/*
 * Say what every edge is, and make shared sides equal: first over all lines of u, then of v, each
 * from the lower patch to the upper, so that all patches round a corner have the same number there.
 */
enum status level_edges(struct level_surface *s)
{
	const struct bezier_net *net = &s->net;
	for (int d = 0; d < 2; d++) {
		int lines = net->spans[d], across = net->spans[1 - d];
		s->net.closed[d] = net->closed[d] || ends_meet(s, d);
		for (int line = 0; line <= lines; line++)
			for (int a = 0; a < across; a++) {
				int patch[2];
				patches_at(s, d, line, a, patch);
				bool inside = (line > 0 && line < lines) || net->closed[d];
				enum edge_kind k = inside ? edge_between(s, patch[0], patch[1], d)
				                   : line == 0 ? edge_outside(s, patch[1], d, false)
				                               : edge_outside(s, patch[0], d, true);
				enum status st = inside ? edge_curved(s, patch, d, &k) : ST_OK;
				if (st != ST_OK)
					return st;
				size_t at = d == 0 ? level_edge(s, 0, line, a)
				                   : level_edge(s, 1, a, line);
				s->edges[d][at] = k;
				s->bent[d][at] = !inside || s->kind == LEVEL_CURVATURE ||
				                 edge_bent(s, patch[0], patch[1], d);
			}
	}
	return ST_OK;
}
