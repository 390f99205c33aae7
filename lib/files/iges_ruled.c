/* iges_ruled.c - 118: ruled surfaces, by equal parameters or equal relative arc lengths. */
#include "iges_course.h"

#include "construct.h"
#include "refine.h"

/* A side of the surface: its curve and how the standard wants it to run, from 0 to 1 both. */
struct side {
	struct curve c;            /* owned */
	struct iges_course course; /* owned */
};

static void side_finish(struct side *s)
{
	curve_finish(&s->c);
	iges_course_finish(&s->course);
}

static enum status side_read(struct iges *g, int de, int depth, bool by_length, bool turned,
                             struct side *out)
{
	*out = (struct side){ 0 };
	enum status st = iges_curve(g, de, depth + 1, &out->c, NULL);
	if (st != ST_OK)
		return st;
	if (turned)
		curve_reverse(&out->c);
	curve_reparametrise(&out->c, 0, 1);
	if (by_length) {
		/* dear: as if it read as many lines more */
		g->budget -= (int64_t)out->c.n * (2 + out->c.order * out->c.order / 96);
		st = iges_course_even(&out->c, &out->course);
		return st == ST_INPUT ? ST_OK : st; /* a point runs as it likes */
	}
	st = iges_course_curve(g, de, &out->course);
	if (st == ST_OK)
		iges_course_unit(&out->course, turned);
	return st;
}

struct sides {
	struct side side[2];
	bool kept; /* both run alike already: the surface is exact, its parameter their course */
};

static void sides_finish(struct sides *s)
{
	side_finish(&s->side[0]);
	side_finish(&s->side[1]);
}

/* Behind the type number: two curves, whether the second is turned, developable. */
static enum status sides_read(struct iges_cursor *c, int depth, struct sides *out)
{
	struct iges *g = c->g;
	int first = iges_int(c), second = iges_int(c), turned = iges_int(c);
	bool by_length = iges_entry(g, c->de)->form == 0;
	iges_int(c);
	*out = (struct sides){ 0 };
	enum status st = c->st;
	if (st == ST_OK)
		st = side_read(g, first, depth, by_length, false, &out->side[0]);
	if (st == ST_OK)
		st = side_read(g, second, depth, by_length, turned, &out->side[1]);
	if (st == ST_OK)
		out->kept = iges_course_same(&out->side[0].course, &out->side[1].course);
	return st;
}

/* The side as it is to run; within the tolerance where that is no NURBS. */
static enum status side_paced(const struct side *s, double tolerance, struct curve *out,
                              double *error)
{
	*error = 0;
	if (iges_course_equal(&s->course))
		return curve_copy(out, &s->c);
	return iges_course_apply(&s->course, &s->c, tolerance, out, error);
}

static double side_size(const struct side *s)
{
	struct box b = box_empty();
	for (int i = 0; i < s->c.n; i++)
		box_add_point(&b, curve_get_point(&s->c, i, NULL));
	return box_diagonal(&b);
}

enum status iges_ruled(struct iges_cursor *c, int depth, struct surface *out)
{
	struct iges *g = c->g;
	struct sides s;
	enum status st = sides_read(c, depth, &s);
	if (st == ST_OK && s.kept) {
		st = make_ruled(out, &s.side[0].c, &s.side[1].c);
	} else if (st == ST_OK) {
		struct curve a = { 0 }, b = { 0 };
		double size = fmax(side_size(&s.side[0]), side_size(&s.side[1])), error[2];
		double tolerance = iges_tolerance(g, size);
		st = side_paced(&s.side[0], tolerance, &a, &error[0]);
		if (st == ST_OK)
			st = side_paced(&s.side[1], tolerance, &b, &error[1]);
		if (st == ST_OK)
			st = make_ruled(out, &a, &b);
		if (st == ST_OK)
			iges_warn_error(g, WARN_RULED, c->de, fmax(error[0], error[1]));
		curve_finish(&a);
		curve_finish(&b);
	}
	sides_finish(&s);
	return iges_pass(g, st);
}

/* v runs evenly; so does u where the sides had to be made to. */
enum status iges_ruled_course(struct iges_cursor *c, struct iges_course *u)
{
	struct sides s;
	enum status st = sides_read(c, 0, &s);
	if (st == ST_OK && s.kept) {
		*u = s.side[0].course;
		s.side[0].course = (struct iges_course){ 0 };
	}
	sides_finish(&s);
	return st;
}
