/* iges_trims.c - the loops of a face, 141 142 508, as curves in its surface's u, v. */
#include "iges_reader.h"

#include <stdlib.h>

#include "iges_course.h"
#include "project.h"
#include "refine.h"

static const double far_from = 1e-2;      /* of the size: a curve that belongs to something else */
static const double courses_agree = 1e-3; /* of the size: curves in u,v and in space */

/* A face being trimmed. */
struct trimmer {
	struct iges *g;
	int de; /* what the curves are of: the face, or a 142 */
	const struct surface *s;
	struct projector *p; /* owned */
	double size, tolerance;
	struct iges_course course[2]; /* owned; of the file's u and v */
	bool known, equal; /* the standard tells the file's parameters; they are those of s */
};

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
		int part = iges_int(&c);
		const struct iges_entry *e = iges_entry(g, part);
		if (c.st != ST_OK)
			st = c.st;
		else if (!e || (e->type != 116 && e->type != 132))
			st = add_parts(g, part, depth + 1, out);
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

/* The loop as a whole is brought into the domain. */
static void center_turns(const struct trimmer *t, struct trim_loop *loop)
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

/* One stretch: curves in u,v (0: none) or the one in space (0: none), whichever is of use. */
static enum status add_piece(struct trimmer *t, const int *uv, int n, int space, bool reversed,
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

/* ---- loops */

/* 142: how made, surface, curve in u,v, curve in space, preference. */
static enum status loop_142(struct trimmer *t, int de, struct trim_loop *loop)
{
	struct iges_cursor c;
	enum status st = iges_open(t->g, de, 142, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c), iges_int(&c);
	int uv = iges_int(&c), space = iges_int(&c);
	return c.st == ST_OK ? add_piece(t, &uv, 1, space, false, loop) : c.st;
}

/* Pointers to n curves, with `step` numbers before each. Fresh. */
static enum status read_list(struct iges_cursor *c, int n, int step, int **out)
{
	*out = calloc(n ? (size_t)n : 1, sizeof **out);
	if (!*out)
		return ST_RESOURCE;
	for (int i = 0; i < n && c->st == ST_OK; i++) {
		for (int k = 0; k < step; k++)
			iges_int(c);
		(*out)[i] = iges_int(c);
	}
	return c->st;
}

/* 141: type, preference, surface, then curves in space, their sense, their curves in u,v. */
static enum status loop_141(struct trimmer *t, int de, struct trim_loop *loop)
{
	struct iges_cursor c;
	enum status st = iges_open(t->g, de, 141, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c), iges_int(&c), iges_int(&c);
	int n = iges_count(&c, "number of curves", 0, iges_left(&c));
	for (int i = 0; i < n && st == ST_OK; i++) {
		int *uv = NULL, space = iges_int(&c), sense = iges_int(&c);
		int k = iges_count(&c, "number of curves in u,v", 0, iges_left(&c));
		st = read_list(&c, k, 0, &uv);
		if (st == ST_OK)
			st = add_piece(t, uv, k, space, sense == 2, loop);
		free(uv);
	}
	return st == ST_OK ? c.st : st;
}

/* 508: edge or vertex, list, place in it, sense, curves in u,v with their flags. A vertex without
 * a curve needs none: what it leaves open is closed by a line along the pole. */
static enum status loop_508(struct trimmer *t, int de, struct trim_loop *loop)
{
	struct iges_cursor c;
	enum status st = iges_open(t->g, de, 508, &c);
	if (st != ST_OK)
		return st;
	int n = iges_count(&c, "number of edges", 0, iges_left(&c));
	for (int i = 0; i < n && st == ST_OK; i++) {
		int *uv = NULL, edge = 0;
		int vertex = iges_int(&c), list = iges_int(&c), index = iges_int(&c);
		int sense = iges_int(&c);
		int k = iges_count(&c, "number of curves in u,v", 0, iges_left(&c));
		st = read_list(&c, k, 1, &uv);
		if (st == ST_OK && !vertex)
			st = iges_edge(t->g, list, index, &edge);
		if (st == ST_OK && !vertex && !edge && !k)
			st = iges_refuse(t->g, "edge %d of D%d is not there", index, list);
		if (st == ST_OK && (!vertex || k))
			st = add_piece(t, uv, k, edge, sense == 0, loop);
		free(uv);
	}
	return st == ST_OK ? c.st : st;
}

typedef enum status read_loop(struct trimmer *t, int de, struct trim_loop *loop);

static enum status trimmer_init(struct trimmer *t, struct iges *g, int de, int base,
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

static void trimmer_finish(struct trimmer *t)
{
	iges_course_finish(&t->course[0]);
	iges_course_finish(&t->course[1]);
	projector_destroy(t->p);
}

/* Read one loop into the trim; a lost inner one is counted and leaves the others. */
static enum status add_loop(struct trimmer *t, int de, read_loop *read, bool outer,
                            struct trim *out)
{
	struct trim_loop loop = { .outer = outer };
	enum status st = read(t, de, &loop);
	if (st == ST_OK && loop.n == 0)
		st = iges_refuse(t->g, "a loop without curves");
	if (st == ST_OK) {
		center_turns(t, &loop);
		return trim_add(out, &loop);
	}
	trim_loop_finish(&loop);
	if (st != ST_INPUT || outer)
		return st;
	return model_skip(t->g->m, iges_entry(t->g, de) ? iges_entry(t->g, de)->type : 0, de,
	                  t->g->reason);
}

/* 144: surface, has an outer loop, number of inner ones, outer loop, inner ones. Without an outer
 * loop the whole domain is meant. */
static enum status trim_144(struct trimmer *t, struct iges_cursor *c, struct trim *out)
{
	iges_int(c);
	bool has_outer = iges_int(c) != 0;
	int n = iges_count(c, "number of inner loops", 0, iges_left(c)), outer = iges_int(c);
	enum status st = c->st;
	if (st == ST_OK && has_outer)
		st = add_loop(t, outer, loop_142, true, out);
	for (int i = 0; i < n && st == ST_OK; i++) {
		int inner = iges_int(c);
		st = c->st == ST_OK ? add_loop(t, inner, loop_142, false, out) : c->st;
	}
	return st;
}

/* Twice the area that a loop encloses in u,v, by the points of its curves. */
static double loop_area(const struct trim_loop *l)
{
	enum { SAMPLES = 16 };
	double area = 0;
	const struct curve *end = &l->curves[l->n - 1];
	struct vec3 a = curve_point(end, end->domain[1]);
	for (int i = 0; i < l->n; i++)
		for (int k = 0; k <= SAMPLES; k++) {
			const struct curve *c = &l->curves[i];
			struct vec3 b = curve_point(
			        c, c->domain[0] + (c->domain[1] - c->domain[0]) * k / SAMPLES);
			area += a.x * b.y - a.y * b.x;
			a = b;
		}
	return fabs(area);
}

/* Loops that are not told apart: the largest is the outer one. */
static void find_outer(struct trim *t)
{
	int largest = 0;
	for (int i = 1; i < t->n; i++)
		if (loop_area(&t->loops[i]) > loop_area(&t->loops[largest]))
			largest = i;
	for (int i = 0; i < t->n; i++)
		t->loops[i].outer = i == largest;
}

/* 143: type, surface, boundaries; 510: surface, number, whether the first is the outer one. */
static enum status trim_listed(struct trimmer *t, struct iges_cursor *c, bool is_face,
                               struct trim *out)
{
	bool told = false;
	if (!is_face)
		iges_int(c);
	iges_int(c);
	int n = iges_count(c, "number of loops", 0, iges_left(c));
	if (is_face)
		told = iges_int(c) == 1;
	enum status st = c->st;
	for (int i = 0; i < n && st == ST_OK; i++) {
		int de = iges_int(c);
		if (c->st != ST_OK)
			return c->st;
		st = add_loop(t, de, is_face ? loop_508 : loop_141, told ? i == 0 : true, out);
	}
	if (st == ST_OK && !told && out->n)
		find_outer(out);
	return st;
}

enum status iges_trim(struct iges *g, int de, int base, const struct surface *s, struct trim *out)
{
	struct iges_cursor c;
	struct trimmer t;
	*out = (struct trim){ 0 };
	enum status st = trimmer_init(&t, g, de, base, s);
	if (st == ST_OK)
		st = iges_open(g, de, 0, &c);
	if (st == ST_OK && iges_entry(g, de)->type == 144)
		st = trim_144(&t, &c, out);
	else if (st == ST_OK)
		st = trim_listed(&t, &c, iges_entry(g, de)->type == 510, out);
	trimmer_finish(&t);
	if (st != ST_OK)
		trim_finish(out);
	return st;
}

enum status iges_trim_curves(struct iges *g, int de, const struct surface *s, struct trim_loop *uv)
{
	struct trimmer t;
	struct iges_cursor c;
	*uv = (struct trim_loop){ 0 };
	enum status st = iges_open(g, de, 142, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c);
	int base = iges_int(&c);
	st = trimmer_init(&t, g, de, base, s);
	if (st == ST_OK)
		st = loop_142(&t, de, uv);
	trimmer_finish(&t);
	if (st != ST_OK)
		trim_loop_finish(uv);
	return st;
}
