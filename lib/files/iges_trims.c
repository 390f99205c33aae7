/* iges_trims.c - stretches of trimming loops as curves in the surface's u, v. */
#include "iges_trimmer.h"

#include <stdlib.h>

#include "project_curve.h"
#include "refine.h"

static const double far_from = 1e-2;      /* of the size: a curve that belongs to something else */
static const double courses_agree = 1e-3; /* of the size: curves in u,v and in space */

/* ---- curves of the file, composites taken apart */

static enum status add_parts(struct iges *g, int de, int depth, struct trim_loop *out);

static enum status add_composite(struct iges *g, int de, int depth, struct trim_loop *out)
{
	struct iges_cursor c;
	int first = out->n;
	double m[3][4];
	bool any;
	enum status st = iges_open(g, de, 102, &c);
	int n = st == ST_OK ? iges_count(&c, "number of parts", 1, g->n_entries) : 0;
	if (st == ST_OK)
		st = c.st;
	for (int i = 0; i < n && st == ST_OK; i++) {
		int part;
		st = iges_part(&c, &part) ? add_parts(g, part, depth + 1, out) : c.st;
	}
	if (st == ST_OK)
		st = iges_matrix(g, iges_entry(g, de)->transform, m, &any);
	for (int i = first; st == ST_OK && any && i < out->n; i++)
		curve_transform(&out->curves[i], (const double(*)[4])m);
	return st;
}

static enum status add_parts(struct iges *g, int de, int depth, struct trim_loop *out)
{
	struct curve c;
	const struct iges_entry *e = iges_entry(g, de);
	if (depth > NESTING_MAX)
		return iges_refuse(g,
		                   "curves that are made of each other in a circle, or more "
		                   "than %d deep",
		                   NESTING_MAX);
	if (e && e->type == 102)
		return add_composite(g, de, depth, out);
	enum status st = iges_curve(g, de, depth, &c, NULL);
	return st == ST_OK ? trim_loop_add(out, &c) : st;
}

static void reverse_parts(struct trim_loop *l)
{
	for (int i = 0, j = l->n - 1; i < j; i++, j--) {
		struct curve c = l->curves[i];
		l->curves[i] = l->curves[j];
		l->curves[j] = c;
	}
	for (int i = 0; i < l->n; i++)
		curve_reverse(&l->curves[i]);
}

static struct box points_box(const struct curve *c)
{
	struct box b = box_empty();
	for (int i = 0; i < c->n; i++)
		box_add_point(&b, curve_get_point(c, i, NULL));
	return b;
}

/* ---- pieces of a loop */

static enum status add_uv(struct trimmer *t, int de, struct trim_loop *loop)
{
	int first = loop->n;
	enum status st = add_parts(t->g, de, 0, loop);
	for (int i = first; st == ST_OK && i < loop->n; i++)
		for (int k = 0; k < loop->curves[i].n; k++)
			loop->curves[i].points[4 * (size_t)k + 2] = 0;
	for (int i = first; st == ST_OK && !t->equal && i < loop->n; i++)
		st = iges_course_bring(t->course, t->s, t->tolerance, &loop->curves[i]);
	return st;
}

static double *part_of(struct vec3 *p, int d)
{
	return d ? &p->y : &p->x;
}

static void shift(struct curve *c, int d, double by)
{
	double m[3][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } };
	m[d][3] = by;
	if (by != 0)
		curve_transform(c, (const double(*)[4])m);
}

/* On a closed surface a curve may stand any number of turns away: beside the one before it. */
static void join_turns(const struct trimmer *t, const struct trim_loop *loop, struct curve *c)
{
	for (int d = 0; d < 2; d++) {
		double period = projector_period(t->p, d);
		struct vec3 start = curve_point(c, c->domain[0]), end;
		if (period == 0 || loop->n == 0)
			continue;
		const struct curve *last = &loop->curves[loop->n - 1];
		end = curve_point(last, last->domain[1]);
		shift(c, d, period * round((*part_of(&end, d) - *part_of(&start, d)) / period));
	}
}

void iges_center_turns(const struct trimmer *t, struct trim_loop *loop)
{
	struct box b = box_empty();
	for (int i = 0; i < loop->n; i++) {
		struct box own = points_box(&loop->curves[i]);
		box_add_box(&b, &own);
	}
	struct vec3 center = box_center(&b);
	for (int d = 0; d < 2; d++) {
		double period = projector_period(t->p, d), at = *part_of(&center, d);
		for (int i = 0; i < loop->n && period > 0; i++)
			shift(&loop->curves[i], d,
			      -period * floor((at - t->s->domain[d][0]) / period));
	}
}

static enum status project_parts(struct trimmer *t, int de, bool reversed, struct trim_loop *loop,
                                 double *worst)
{
	struct trim_loop space = { 0 };
	enum status st = add_parts(t->g, de, 0, &space);
	if (st == ST_OK && reversed)
		reverse_parts(&space);
	*worst = 0;
	for (int i = 0; i < space.n && st == ST_OK; i++) {
		struct curve c;
		double distance;
		struct box b = points_box(&space.curves[i]);
		if (!(box_diagonal(&b) > t->tolerance))
			continue; /* a pole written as an edge */
		st = progress_step(t->g->progress, t->g->n_p ? (double)t->g->far / t->g->n_p : 0);
		if (st == ST_OK)
			st = projector_curve(t->p, &space.curves[i], t->tolerance,
			                     far_from * t->size, &c, &distance);
		if (st != ST_OK)
			break;
		*worst = fmax(*worst, distance);
		join_turns(t, loop, &c);
		st = trim_loop_add(loop, &c);
	}
	trim_loop_finish(&space);
	return st;
}

static enum status add_space(struct trimmer *t, int de, bool reversed, struct trim_loop *loop)
{
	double worst;
	enum status st = project_parts(t, de, reversed, loop, &worst);
	if (st != ST_OK)
		return st;
	if (!(worst <= far_from * t->size))
		return iges_refuse(t->g, "its curve D%d lies up to %g from the surface", de, worst);
	if (worst > 1e-4 * t->size)
		iges_warn(t->g, WARN_FAR, t->g->at);
	return ST_OK;
}

static double distance_to_segment(struct vec3 x, struct vec3 a, struct vec3 b)
{
	struct vec3 d = vec3_sub(b, a), r = vec3_sub(x, a);
	double l = vec3_dot(d, d), s = l > 0 ? vec3_dot(r, d) / l : 0;
	return vec3_length(vec3_along(r, -fmin(fmax(s, 0), 1), d));
}

static double distance_to_curve(struct vec3 x, const struct curve *c)
{
	enum { LEAST = 32, MOST = 400 };
	int n = 4 * c->n < LEAST ? LEAST : 4 * c->n > MOST ? MOST : 4 * c->n;
	double best = INFINITY;
	struct vec3 a = curve_point(c, c->domain[0]);
	for (int i = 1; i <= n; i++) {
		struct vec3 b =
		        curve_point(c, c->domain[0] + (c->domain[1] - c->domain[0]) * i / n);
		best = fmin(best, distance_to_segment(x, a, b));
		a = b;
	}
	return best;
}

/* How far the curves from `first` on are, on the surface, from those in space. */
static double disagreement(const struct trimmer *t, const struct trim_loop *loop, int first,
                           const struct trim_loop *space)
{
	enum { SAMPLES = 3 };
	double worst = 0;
	for (int i = first; i < loop->n; i++)
		for (int k = 0; k < SAMPLES; k++) {
			const struct curve *c = &loop->curves[i];
			struct vec3 uv =
			        curve_point(c, c->domain[0] + (c->domain[1] - c->domain[0]) *
			                                              (k + 0.5) / SAMPLES);
			struct vec3 x = surface_point(
			        t->s, fmin(fmax(uv.x, t->s->domain[0][0]), t->s->domain[0][1]),
			        fmin(fmax(uv.y, t->s->domain[1][0]), t->s->domain[1][1]));
			double best = INFINITY;
			for (int j = 0; j < space->n; j++)
				best = fmin(best, distance_to_curve(x, &space->curves[j]));
			worst = fmax(worst, best);
		}
	return worst;
}

/* Where both courses are given and they disagree the one in space is taken, if it lies on the
 * surface. */
static enum status compare_courses(struct trimmer *t, int de, bool reversed, int first,
                                   struct trim_loop *loop)
{
	struct trim_loop space = { 0 }, other = { 0 };
	double off = 0, worst;
	enum status st = add_parts(t->g, de, 0, &space);
	if (st == ST_OK)
		off = disagreement(t, loop, first, &space);
	trim_loop_finish(&space);
	if (st == ST_INPUT || (st == ST_OK && off <= courses_agree * t->size))
		return ST_OK;
	if (st == ST_OK)
		st = project_parts(t, de, reversed, &other, &worst);
	if (st == ST_OK && other.n && worst < off) {
		while (loop->n > first)
			curve_finish(&loop->curves[--loop->n]);
		for (int i = 0; i < other.n && st == ST_OK; i++)
			st = trim_loop_add(loop, &other.curves[i]);
		iges_warn(t->g, WARN_TWO_COURSES, t->g->at);
	}
	trim_loop_finish(&other);
	return st == ST_INPUT ? ST_OK : st;
}

enum status iges_add_piece(struct trimmer *t, const int *uv, int n, int space, bool reversed,
                           struct trim_loop *loop)
{
	int first = loop->n;
	enum status st = ST_INPUT;
	bool given = n > 0 && uv[0] > 0;
	if (given && (t->equal || !space)) {
		st = ST_OK;
		for (int i = 0; i < n && st == ST_OK; i++)
			st = add_uv(t, uv[i], loop);
		if (st == ST_OK && !t->known)
			iges_warn(t->g, WARN_PARAMETERS, t->g->at);
		if (st == ST_OK && space)
			return compare_courses(t, space, reversed, first, loop);
		if (st != ST_INPUT || !space)
			return st;
		while (loop->n > first)
			curve_finish(&loop->curves[--loop->n]);
	}
	if (!space)
		return iges_refuse(t->g, "it has neither a curve in u,v nor one in space");
	return add_space(t, space, reversed, loop);
}

enum status iges_trimmer_init(struct trimmer *t, struct iges *g, int de, int base,
                              const struct surface *s)
{
	*t = (struct trimmer){ .g = g, .de = de, .s = s, .size = surface_size(s) };
	t->tolerance = iges_tolerance(g, t->size);
	enum status st = iges_surface_courses(g, base, t->course, &t->known);
	if (st == ST_INPUT) {
		t->known = false; /* curves in space will do */
		st = ST_OK;
	}
	t->equal = t->known && t->course[0].n + t->course[0].n_at + t->course[1].n == 0;
	return st == ST_OK ? projector_create(&t->p, s) : st;
}

void iges_trimmer_finish(struct trimmer *t)
{
	iges_course_finish(&t->course[0]);
	iges_course_finish(&t->course[1]);
	projector_destroy(t->p);
}
