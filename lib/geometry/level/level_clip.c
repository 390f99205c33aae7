/* level_clip.c - what the trims of a face leave of its branches. */
#include <stdlib.h>
#include <string.h>

#include "level_border.h"
#include "level_meet.h"

/* A branch runs along a trimming curve, and does not just touch it, where this part of the samples
 * is nearer than an eighth of what is near: of a parabola a third is. An eighth is the branch's error. */
static const double along_part = 0.6, along_near = 0.125;

/* A shorter run, in tolerances, is a touch. */
enum { SHORT = 4, SAMPLES = 32, BISECTIONS = 60 };

/* A part of a branch between two places where it meets trims. */
struct stretch {
	double t[2];
	bool run; /* near a trimming curve all the way */
	bool in;
};

struct clipper {
	const struct trim_test *test;
	const struct surface *surface;
	const struct level_branch *branch;
	struct level_span *spans; /* owned */
	size_t n;
	double tolerance, size;
	struct list meets;     /* of struct level_meet */
	struct list stretches; /* of struct stretch */
};

/* Eight times the branch's error. A bound far above the tolerance says nothing of it. */
static double near_of(const struct clipper *c)
{
	return larger(smaller(c->branch->max_error, c->tolerance) / along_near, c->tolerance);
}

/* Lengths of the parameters where the span is, and where that is a pole at least a little. */
static struct level_metric metric_at(const struct clipper *c, const struct level_span *s)
{
	struct level_metric m = { .near = near_of(c) };
	double uv[2], duv[2];
	struct vec3 p, d[2];
	level_span_uv(s, 0.5 * (s->t[0] + s->t[1]), uv, duv);
	surface_tangents(c->surface, uv[0], uv[1], &p, &d[0], &d[1]);
	for (int k = 0; k < 2; k++) {
		const double range = c->surface->domain[k][1] - c->surface->domain[k][0];
		m.scale[k] = larger(vec3_length(d[k]), 1e-3 * c->size / range);
	}
	return m;
}

static const struct level_span *span_of(const struct clipper *c, double t)
{
	size_t lo = 0, hi = c->n;
	while (hi - lo > 1) {
		const size_t middle = (lo + hi) / 2;
		if (c->spans[middle].t[0] <= t)
			lo = middle;
		else
			hi = middle;
	}
	return &c->spans[lo];
}

static bool inside_at(const struct clipper *c, double t)
{
	double uv[2], duv[2];
	level_span_uv(span_of(c, t), t, uv, duv);
	return trim_test_inside(c->test, uv[0], uv[1]);
}

static int by_start(const void *pa, const void *pb)
{
	const struct level_meet *a = pa, *b = pb;
	if (a->t[0] != b->t[0])
		return a->t[0] < b->t[0] ? -1 : 1;
	return (a->t[1] > b->t[1]) - (a->t[1] < b->t[1]);
}

static void stretch_add(struct clipper *c, double a, double b, bool run)
{
	struct stretch *s = list_add(&c->stretches, sizeof *s);
	if (s)
		*s = (struct stretch){ { a, b }, run, !run && inside_at(c, 0.5 * (a + b)) };
}

/* All places where the branch meets trims; where u or v jumps counts as one. */
static void meets_find(struct clipper *c)
{
	const struct trim_pieces *p = &c->test->pieces;
	for (size_t i = 0; i < c->n; i++) {
		const struct level_metric m = metric_at(c, &c->spans[i]);
		if (i > 0 && c->spans[i].cut) {
			struct level_meet *x = list_add(&c->meets, sizeof *x);
			if (x)
				x->t[0] = x->t[1] = c->spans[i].t[0];
		}
		for (int k = 0; k < p->n; k++)
			level_meet_piece(&c->spans[i], &p->pieces[k], &m, &c->meets);
	}
	if (c->meets.n > 0)
		qsort(c->meets.p, c->meets.n, sizeof(struct level_meet), by_start);
}

/* The branch from meet to meet; meets that touch are one run. */
static void stretches_make(struct clipper *c)
{
	const struct level_meet *m = c->meets.p;
	const double end = c->branch->uv.domain[1], same = 1e-9 * end;
	double at = 0;
	for (size_t i = 0; i < c->meets.n;) {
		double a = m[i].t[0], b = m[i].t[1];
		for (i++; i < c->meets.n && m[i].t[0] <= b + same; i++)
			b = larger(b, m[i].t[1]);
		if (a > at + same)
			stretch_add(c, at, a, false);
		else
			a = smaller(a, at);
		if (b > a)
			stretch_add(c, a, b, true);
		at = larger(at, b);
	}
	if (at < end - same)
		stretch_add(c, at, end, false);
}

/* How far from the trims the branch is at t, in parts of what is near; 1: not near. */
static double nearness(const struct clipper *c, double t)
{
	const struct level_span *span = span_of(c, t);
	const struct level_metric m = metric_at(c, span);
	double uv[2], duv[2];
	level_span_uv(span, t, uv, duv);
	return level_meet_distance(&c->test->pieces, uv, &m, m.near) / m.near;
}

/* From t on while the branch is near, forwards or backwards. */
static double near_until(const struct clipper *c, double t, double step)
{
	const double end = c->branch->uv.domain[1], first = fabs(step);
	bool grow = true;
	while (fabs(step) >= first / 16) {
		const double next = smaller(larger(t + step, 0), end);
		const bool far = nearness(c, next) >= 1;
		grow &= !far;
		t = far ? t : next;
		if (t == 0 || t == end)
			return t;
		step *= grow ? 2 : 0.5;
	}
	return t;
}

/* Between a place on the run and its end: where the branch leaves the trims by more than `most`. */
static double run_end(const struct clipper *c, double on, double end, double most)
{
	if (nearness(c, end) <= most)
		return end;
	for (int k = 0; k < BISECTIONS; k++) {
		const double middle = 0.5 * (on + end);
		if (nearness(c, middle) <= most)
			on = middle;
		else
			end = middle;
	}
	return on;
}

/* Is it more than a touch? Then it ends where it leaves the trims: in their corners. */
static bool runs_along(const struct clipper *c, struct stretch *s)
{
	int n = 0;
	double off = 0;
	/* the parameter is about the length */
	const double length = larger(s->t[1] - s->t[0], c->tolerance);
	const double from = near_until(c, s->t[0], -length / 4);
	const double to = near_until(c, s->t[1], length / 4);
	if (s->t[1] - s->t[0] < SHORT * c->tolerance)
		return false;
	for (int i = 0; i < SAMPLES; i++) {
		const double x = nearness(c, from + (to - from) * (i + 0.5) / SAMPLES);
		n += x <= along_near;
		if (i >= SAMPLES / 4 && i < SAMPLES - SAMPLES / 4)
			off = larger(off, x);
	}
	if (n < along_part * SAMPLES)
		return false;
	const double middle = 0.5 * (from + to), most = larger(2 * off, 1e-6);
	s->t[0] = run_end(c, middle, s->t[0], most);
	s->t[1] = run_end(c, middle, s->t[1], most);
	return true;
}

/* The stretch before (step -1) or after i whose state is known; NULL: there is none. */
static struct stretch *known_beside(const struct clipper *c, size_t i, int step)
{
	struct stretch *s = c->stretches.p;
	const size_t n = c->stretches.n;
	for (size_t k = 1; k < n; k++) {
		const size_t at = step > 0 ? i + k : i + n - k;
		if (!c->branch->closed && (step > 0 ? at >= n : at < n))
			return NULL;
		if (!s[at % n].run)
			return &s[at % n];
	}
	return NULL;
}

/* Where the state changes in a run between two stretches: there they meet. */
static void run_part(const struct clipper *c, struct stretch *before, struct stretch *run,
                     struct stretch *after)
{
	double lo = run->t[0], hi = run->t[1];
	for (int k = 0; k < BISECTIONS; k++) {
		const double middle = 0.5 * (lo + hi);
		if (inside_at(c, middle) == before->in)
			lo = middle;
		else
			hi = middle;
	}
	before->t[1] = after->t[0] = lo;
	run->t[0] = run->t[1] = lo;
}

/* A run that is no more than a touch, or a crossing at a small angle, is as its neighbours are. */
static void runs_decide(struct clipper *c)
{
	struct stretch *s = c->stretches.p;
	const size_t n = c->stretches.n;
	for (size_t i = 0; i < n; i++)
		if (s[i].run && runs_along(c, &s[i])) {
			s[i].in = true;
			s[i].run = false;
		}
	for (size_t i = 0; i < n; i++) {
		if (!s[i].run)
			continue;
		struct stretch *before = known_beside(c, i, -1), *after = known_beside(c, i, 1);
		const bool beside = before && after && before + 1 == &s[i] && after == &s[i + 1];
		if (beside && before->in != after->in)
			run_part(c, before, &s[i], after);
		else if (before && after && before->in != after->in)
			s[i].in = inside_at(c, 0.5 * (s[i].t[0] + s[i].t[1]));
		else
			s[i].in = before  ? before->in
			          : after ? after->in
			                  : inside_at(c, 0.5 * (s[i].t[0] + s[i].t[1]));
	}
}

static enum status part_keep(const struct clipper *c, double from, double to, struct list *kept)
{
	struct level_branch *b = list_add(kept, sizeof *b);
	enum status st = b ? level_branch_part(b, c->branch, c->surface, from, to) : ST_RESOURCE;
	if (st != ST_OK && b)
		kept->n--;
	return st;
}

/* Neighbouring stretches that are on the face are one part; over the start of a closed branch, too. */
static enum status parts_keep(const struct clipper *c, struct list *kept)
{
	const struct stretch *s = c->stretches.p;
	const size_t n = c->stretches.n;
	const double end = c->branch->uv.domain[1];
	enum status st = ST_OK;
	size_t first = 0, last = n;
	double wrap = 0;
	if (c->branch->closed && n > 1 && s[0].in && s[n - 1].in) {
		while (first < n && s[first].in)
			first++;
		while (last > first && s[last - 1].in)
			last--;
		wrap = s[first].t[0];
		st = part_keep(c, s[last - 1].t[1], end + wrap, kept);
	}
	for (size_t i = first; st == ST_OK && i < last;) {
		size_t k = i;
		while (k < last && s[k].in)
			k++;
		if (k > i && s[k - 1].t[1] > s[i].t[0])
			st = part_keep(c, s[i].t[0], s[k - 1].t[1], kept);
		i = k > i ? k : i + 1;
	}
	return st;
}

/* Put what is left of a branch behind `kept`; the branch is moved there where nothing is cut. */
static enum status branch_clip(struct clipper *c, struct level_branch *b, struct list *kept)
{
	size_t in = 0;
	enum status st = level_spans(b, &c->spans, &c->n);
	c->branch = b;
	c->meets.n = c->stretches.n = 0;
	if (st == ST_OK) {
		meets_find(c);
		stretches_make(c);
		st = c->meets.failed || c->stretches.failed ? ST_RESOURCE : ST_OK;
	}
	if (st == ST_OK)
		runs_decide(c);
	for (size_t i = 0; st == ST_OK && i < c->stretches.n; i++) {
		const struct stretch *s = (const struct stretch *)c->stretches.p + i;
		in += s->in || s->t[0] == s->t[1];
	}
	if (st == ST_OK && in == c->stretches.n) {
		struct level_branch *to = list_add(kept, sizeof *to);
		st = to ? ST_OK : ST_RESOURCE;
		if (to) {
			*to = *b;
			*b = (struct level_branch){ .length = 0 };
		}
	} else if (st == ST_OK && in > 0) {
		st = parts_keep(c, kept);
	}
	free(c->spans);
	c->spans = NULL;
	return st;
}

/* Is none of the box on the face? Beyond the upper end of a closed surface it is at the lower one. */
static bool box_outside(const struct clipper *c, const struct level_box *b)
{
	const double(*domain)[2] = (const double(*)[2])c->surface->domain;
	bool outside = true;
	for (int k = 0; outside && k < 4; k++) {
		double lo[2], hi[2];
		bool some = true;
		for (int d = 0; d < 2; d++) {
			const bool beyond = k >> d & 1;
			const double move = beyond ? domain[d][1] - domain[d][0] : 0;
			lo[d] = beyond ? domain[d][0] : b->lo[d];
			hi[d] = beyond ? b->hi[d] - move : smaller(b->hi[d], domain[d][1]);
			some &= lo[d] <= hi[d];
		}
		outside = !some || trim_test_box(c->test, lo, hi) < 0;
	}
	return outside;
}

/* Undecided boxes that are not on the face go; marks follow, and their ends are counted anew. */
static enum status boxes_clip(const struct clipper *c, struct level_result *x)
{
	int *place = malloc(sizeof *place * (x->n_undecided + 1)), n = 0;
	if (!place)
		return ST_RESOURCE;
	for (size_t i = 0; i < x->n_undecided; i++) {
		place[i] = box_outside(c, &x->undecided[i]) ? -1 : n;
		if (place[i] < 0)
			continue;
		x->undecided[n] = x->undecided[i];
		x->undecided[n++].ends = 0;
	}
	x->n_undecided = (size_t)n;
	for (size_t i = 0; i < x->n_branches; i++)
		for (int e = 0; e < 2; e++) {
			int *mark = &x->branches[i].mark[e];
			*mark = *mark >= 0 ? place[*mark] : -1;
			if (*mark >= 0)
				x->undecided[*mark].ends++;
		}
	free(place);
	return ST_OK;
}

/* Umbilics likewise. */
static void umbilics_clip(const struct clipper *c, struct level_result *x)
{
	size_t n = 0;
	for (size_t i = 0; i < x->n_umbilics; i++) {
		const struct level_umbilic *u = &x->umbilics[i];
		struct level_box b = { .flat = false };
		for (int d = 0; d < 2; d++) {
			b.lo[d] = u->lo[d];
			b.hi[d] = u->hi[d];
		}
		if (!box_outside(c, &b))
			x->umbilics[n++] = x->umbilics[i];
	}
	x->n_umbilics = n;
}

enum status level_clip(const struct level_faces *f, int i, double tolerance, struct level_result *x)
{
	struct clipper c = { .test = f->tests[i],
		             .surface = f->faces[i].surface,
		             .tolerance = tolerance,
		             .size = surface_size(f->faces[i].surface) };
	struct list kept = { 0 };
	enum status st = ST_OK;
	if (!c.test)
		return ST_OK;
	for (size_t b = 0; st == ST_OK && b < x->n_branches; b++)
		st = branch_clip(&c, &x->branches[b], &kept);
	free(c.meets.p);
	free(c.stretches.p);
	if (st != ST_OK) {
		for (size_t k = 0; k < kept.n; k++) {
			struct level_branch *b = (struct level_branch *)kept.p + k;
			curve_finish(&b->uv);
			curve_finish(&b->space);
		}
		free(kept.p);
		return st;
	}
	for (size_t b = 0; b < x->n_branches; b++) {
		curve_finish(&x->branches[b].uv);
		curve_finish(&x->branches[b].space);
	}
	level_result_replace(x, &kept);
	umbilics_clip(&c, x);
	return boxes_clip(&c, x);
}
