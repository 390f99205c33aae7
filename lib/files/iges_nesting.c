/* iges_nesting.c - which loops of a face are outer ones, by which holds which. */
#include "iges_trimmer.h"

#include <stdlib.h>

enum {
	CHORDS = 8, /* of a curve, for each of its points */
	CHORDS_MOST = 800,
	WITNESSES = 5,     /* points of a loop that are looked at */
	LOOPS_MOST = 3000, /* more are left as the file has them: each is held against each */
};

/* A loop by its chords, in whatever order its curves are. */
struct outline {
	struct vec3 (*chords)[2]; /* owned */
	int n;
	struct box box;
	double area;    /* twice, counter-clockwise positive */
	double runs[2]; /* from where it begins to where it ends: some periods where it winds */
	int holders;    /* loops that hold it */
	bool twin;      /* of one before; holds nothing */
};

static enum status outline_init(struct outline *o, const struct trim_loop *l)
{
	size_t room = 0;
	*o = (struct outline){ .box = box_empty() };
	for (int i = 0; i < l->n; i++)
		room += CHORDS * (size_t)l->curves[i].n < CHORDS_MOST
		                ? CHORDS * (size_t)l->curves[i].n
		                : CHORDS_MOST;
	o->chords = calloc(room ? room : 1, sizeof *o->chords);
	if (!o->chords)
		return ST_RESOURCE;
	for (int i = 0; i < l->n; i++) {
		const struct curve *c = &l->curves[i];
		int n = c->n < CHORDS_MOST / CHORDS ? CHORDS * c->n : CHORDS_MOST;
		struct vec3 a = curve_point(c, c->domain[0]), first = a;
		for (int k = 1; k <= n; k++) {
			double t = c->domain[0] + (c->domain[1] - c->domain[0]) * k / n;
			struct vec3 b = curve_point(c, k == n ? c->domain[1] : t);
			o->chords[o->n][0] = a;
			o->chords[o->n++][1] = b;
			o->area += a.x * b.y - a.y * b.x;
			box_add_point(&o->box, b);
			a = b;
		}
		o->runs[0] += a.x - first.x;
		o->runs[1] += a.y - first.y;
	}
	return ST_OK;
}

static bool holds_point(const struct outline *o, double u, double v)
{
	bool inside = false;
	if (!(u >= o->box.lo.x && u <= o->box.hi.x && v >= o->box.lo.y && v <= o->box.hi.y))
		return false;
	for (int i = 0; i < o->n; i++) {
		struct vec3 a = o->chords[i][0], b = o->chords[i][1];
		if ((a.y <= v) != (b.y <= v) && u < a.x + (v - a.y) * (b.x - a.x) / (b.y - a.y))
			inside = !inside;
	}
	return inside;
}

/* Most of some points of x, which on a closed surface may stand a turn off. */
static bool holds(const struct trimmer *t, const struct outline *o, const struct outline *x)
{
	int votes = 0, looks = x->n < WITNESSES ? x->n : WITNESSES;
	const double period[2] = { projector_period(t->p, 0), projector_period(t->p, 1) };
	for (int k = 0; k < looks; k++) {
		const struct vec3 *c = x->chords[(size_t)x->n * k / looks];
		struct vec3 p = vec3_scale(vec3_add(c[0], c[1]), 0.5);
		bool held = false;
		for (int i = -1; i <= 1; i++)
			for (int j = -1; j <= 1; j++)
				if ((i == 0 || period[0] > 0) && (j == 0 || period[1] > 0))
					held |= holds_point(o, p.x + i * period[0],
					                    p.y + j * period[1]);
		votes += held;
	}
	return 2 * votes > looks;
}

static bool lies_on(const struct outline *o, struct vec3 p, double near)
{
	for (int i = 0; i < o->n; i++) {
		struct vec3 a = o->chords[i][0], d = vec3_sub(o->chords[i][1], a);
		double length = vec3_dot(d, d);
		double t = length > 0 ? vec3_dot(vec3_sub(p, a), d) / length : 0;
		struct vec3 foot = vec3_add(a, vec3_scale(d, fmin(fmax(t, 0), 1)));
		if (vec3_length(vec3_sub(p, foot)) <= near)
			return true;
	}
	return false;
}

/* Do two outlines lie upon each other but for a little? */
static bool alike(const struct outline *a, const struct outline *b)
{
	static const double little = 1e-6; /* of the outline */
	const double near = little * box_diagonal(&a->box);
	bool all = fabs(fabs(a->area) - fabs(b->area)) <= little * fabs(a->area) &&
	           vec3_length(vec3_sub(a->box.lo, b->box.lo)) <= near &&
	           vec3_length(vec3_sub(a->box.hi, b->box.hi)) <= near;
	for (int i = 0; i < a->n && all; i++)
		all = lies_on(b, a->chords[i][0], near);
	return all;
}

/* Loops of a face that does not tell which are outer ones may be there twice: one of them counts. */
static void find_twins(struct outline *o, int n)
{
	for (int i = 0; i < n; i++)
		for (int j = 0; j < i && !o[i].twin; j++)
			o[i].twin = !o[j].twin && alike(&o[i], &o[j]);
}

static bool winds(const struct trimmer *t, const struct outline *o)
{
	for (int d = 0; d < 2; d++) {
		double period = projector_period(t->p, d);
		if (period > 0 && fabs(o->runs[d]) > 0.5 * period)
			return true;
	}
	return false;
}

/* Loops that none holds are outer ones, those that one holds are holes. */
static void by_holders(const struct trimmer *t, const struct outline *o, struct trim *trim)
{
	int n = 0;
	for (int i = 0; i < trim->n; i++) {
		if (o[i].holders > 1) {
			iges_warn(t->g, WARN_ISLAND, t->g->at);
			trim_loop_finish(&trim->loops[i]);
			continue;
		}
		struct trim_loop l = trim->loops[i];
		l.outer = o[i].holders == 0;
		trim->loops[n++] = l;
	}
	trim->n = n;
}

/* The file's word, unless an inner loop holds the outer one; inner ones outside it cut nothing. */
static void by_word(const struct trimmer *t, const struct outline *o, struct trim *trim)
{
	int outer = 0;
	while (outer < trim->n && !trim->loops[outer].outer)
		outer++;
	if (outer == trim->n)
		return;
	if (o[outer].holders) {
		iges_warn(t->g, WARN_NESTING, t->g->at);
		by_holders(t, o, trim);
		return;
	}
	for (int i = 0; i < trim->n; i++)
		if (i != outer && o[i].holders == 0)
			iges_warn(t->g, WARN_OUTSIDE, t->g->at);
}

static bool all_clockwise(const struct outline *o, int n)
{
	bool all = true;
	for (int i = 0; i < n; i++)
		all &= o[i].area < 0;
	return all;
}

enum status iges_nest(const struct trimmer *t, bool told, bool by_sense, struct trim *trim)
{
	int n = trim->n;
	bool any = false, closed = projector_period(t->p, 0) > 0 || projector_period(t->p, 1) > 0;
	if (n == 0 || n > LOOPS_MOST || (told && n == 1))
		return ST_OK;
	struct outline *o = calloc((size_t)n, sizeof *o);
	enum status st = o ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < n && st == ST_OK; i++) {
		st = outline_init(&o[i], &trim->loops[i]);
		any |= winds(t, &o[i]);
	}
	if (st == ST_OK && !any && !told)
		find_twins(o, n);
	for (int i = 0; i < n && st == ST_OK && !any; i++)
		for (int j = 0; j < n; j++)
			o[i].holders += i != j && !o[j].twin &&
			                !(o[i].twin && alike(&o[i], &o[j])) &&
			                holds(t, &o[j], &o[i]);
	/* what loops around a closed surface leave is on their left: no loop is an outer one */
	if (st == ST_OK && (any || (by_sense && !told && closed && all_clockwise(o, n))))
		for (int i = 0; i < n; i++)
			trim->loops[i].outer = any && told && trim->loops[i].outer;
	else if (st == ST_OK && told)
		by_word(t, o, trim);
	else if (st == ST_OK)
		by_holders(t, o, trim);
	for (int i = 0; o && i < n; i++)
		free(o[i].chords);
	free(o);
	return st;
}
