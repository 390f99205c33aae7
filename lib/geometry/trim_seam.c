/* trim_seam.c - loops that run over the seam of a closed surface, cut there. */
#include <stdlib.h>
#include <string.h>

#include "refine.h"
#include "trim_mender.h"
#include "trim_pieces.h"

/* A part of a curve between two seams. */
struct part {
	struct curve curve; /* owned */
	int strip;          /* periods from the domain */
};

struct parts {
	struct part *list; /* owned */
	int n;
};

/* Parts that follow each other in one strip, from seam to seam. */
struct run {
	int first, n, strip;
	double level[2]; /* the other coordinate at its start and end */
	int to[2];       /* run end that it is joined to along the seam: 2 run + end */
	bool upper[2];   /* that end lies at the strip's upper seam */
	bool done;
};

static void parts_finish(struct parts *p)
{
	for (int i = 0; i < p->n; i++)
		curve_finish(&p->list[i].curve);
	free(p->list);
}

static enum status parts_add(struct parts *p, struct curve *c, int strip)
{
	struct part *list = reallocarray(p->list, (size_t)p->n + 1, sizeof *list);
	if (!list) {
		curve_finish(c);
		return ST_RESOURCE;
	}
	p->list = list;
	list[p->n++] = (struct part){ *c, strip };
	return ST_OK;
}

/* Strip of a part, by its middle; `last` where it runs along a seam. */
static int strip_of(const struct mender *m, const struct curve *c, int d, int last)
{
	const double lo = m->s->domain[d][0];
	double x[3];
	for (int i = 0; i < 3; i++) {
		double t = 0.25 * (i + 1);
		struct vec3 p = curve_point(c, (1 - t) * c->domain[0] + t * c->domain[1]);
		x[i] = ((d ? p.y : p.x) - lo) / m->length[d];
	}
	const double seam = round(x[1]), near = m->near[d] / m->length[d];
	if (fabs(x[0] - seam) <= near && fabs(x[1] - seam) <= near && fabs(x[2] - seam) <= near)
		return last;
	return (int)floor(x[1]);
}

/* Cut one curve at all seams that it crosses. */
static enum status cut_curve(const struct mender *m, const struct curve *c, int d,
                             struct parts *out)
{
	double *at = NULL, from = c->domain[0];
	int n;
	enum status st = trim_curve_crossings(c, d, m->s->domain[d][0], m->length[d], &at, &n);
	for (int i = 0; i <= n && st == ST_OK; i++) {
		const double to = i < n ? at[i] : c->domain[1];
		const double least = 1e-9 * (c->domain[1] - c->domain[0]);
		struct curve part;
		if (i < n && (to - from <= least || c->domain[1] - to <= least))
			continue;
		st = curve_part(&part, c, from, to);
		if (st == ST_OK) {
			int last = out->n ? out->list[out->n - 1].strip : 0;
			int strip = strip_of(m, &part, d, last);
			st = parts_add(out, &part, strip);
		}
		from = to;
	}
	free(at);
	return st;
}

static enum status cut_all(const struct mender *m, const struct trim_loop *l, int d,
                           struct parts *out)
{
	enum status st = ST_OK;
	for (int i = 0; i < l->n && st == ST_OK; i++)
		st = cut_curve(m, &l->curves[i], d, out);
	return st;
}

/* Append a part, in the domain. */
static enum status put_part(const struct mender *m, const struct part *p, int d, int strip,
                            struct trim_loop *out)
{
	struct curve c;
	enum status st = curve_copy(&c, &p->curve);
	if (st != ST_OK)
		return st;
	trim_curve_move(&c, d, -strip * m->length[d]);
	return trim_loop_add(out, &c);
}

/* Runs of parts; the first begins with its strip, if there is more than one. */
static int find_runs(const struct mender *m, const struct parts *p, int d, struct run *runs)
{
	int begin = 0, n = 0;
	while (begin < p->n && p->list[begin].strip == p->list[(begin + p->n - 1) % p->n].strip)
		begin++;
	for (int k = 0; k < p->n; k++) {
		const int i = (begin + k) % p->n;
		if (n == 0 || p->list[i].strip != runs[n - 1].strip)
			runs[n++] = (struct run){ .first = i, .strip = p->list[i].strip };
		runs[n - 1].n++;
	}
	for (int k = 0; k < n; k++) {
		const int last = (runs[k].first + runs[k].n - 1) % p->n;
		double uv[2];
		trim_curve_end(&p->list[runs[k].first].curve, 0, uv);
		runs[k].level[0] = uv[1 - d];
		runs[k].upper[0] =
		        uv[d] > m->s->domain[d][0] + (runs[k].strip + 0.5) * m->length[d];
		trim_curve_end(&p->list[last].curve, 1, uv);
		runs[k].level[1] = uv[1 - d];
		runs[k].upper[1] =
		        uv[d] > m->s->domain[d][0] + (runs[k].strip + 0.5) * m->length[d];
	}
	return n;
}

/* A run's end on one side of a seam. */
struct end {
	int seam, run; /* run: 2 run + end */
	double level;
};

static int compare_ends(const void *a, const void *b)
{
	const struct end *x = a, *y = b;
	if (x->seam != y->seam)
		return x->seam < y->seam ? -1 : 1;
	if (x->level != y->level)
		return x->level < y->level ? -1 : 1;
	return x->run - y->run;
}

/* On each side of each seam the ends, by level, are joined two and two: what lies between is
 * inside the loop. */
static enum status link_runs(const struct mender *m, struct run *runs, int n)
{
	struct end *ends = malloc(2 * (size_t)n * sizeof *ends);
	if (!ends)
		return ST_RESOURCE;
	enum status st = ST_OK;
	for (int side = 0; side < 2 && st == ST_OK; side++) {
		int k = 0;
		for (int i = 0; i < 2 * n; i++)
			if (runs[i / 2].upper[i % 2] == side)
				ends[k++] = (struct end){ runs[i / 2].strip, i,
					                  runs[i / 2].level[i % 2] };
		qsort(ends, k, sizeof *ends, compare_ends);
		for (int i = 0; i < k && st == ST_OK; i += 2) {
			if (i + 1 == k || ends[i].seam != ends[i + 1].seam) {
				st = report_error(m->r, ST_INPUT,
				                  "%s: trimming loop %d meets the seam an odd "
				                  "number of times; expected it to come back",
				                  m->what, m->loop);
				break;
			}
			runs[ends[i].run / 2].to[ends[i].run % 2] = ends[i + 1].run;
			runs[ends[i + 1].run / 2].to[ends[i + 1].run % 2] = ends[i].run;
		}
	}
	free(ends);
	return st;
}

static void end_place(const struct mender *m, const struct run *runs, int d, int end, double uv[2])
{
	uv[d] = m->s->domain[d][runs[end / 2].upper[end % 2]];
	uv[1 - d] = runs[end / 2].level[end % 2];
}

/* A run's curves, from one end to the other, its ends on the seams to the bit. */
static enum status put_run(const struct mender *m, const struct parts *p, const struct run *runs,
                           int start, int d, struct trim_loop *out)
{
	const struct run *r = &runs[start / 2];
	const int before = out->n;
	enum status st = ST_OK;
	for (int k = 0; k < r->n && st == ST_OK; k++) {
		int i = start % 2 ? r->n - 1 - k : k;
		st = put_part(m, &p->list[(r->first + i) % p->n], d, r->strip, out);
		if (st == ST_OK && start % 2)
			curve_reverse(&out->curves[out->n - 1]);
	}
	if (st == ST_OK) {
		double uv[2];
		end_place(m, runs, d, start, uv);
		trim_curve_set_end(&out->curves[before], 0, uv);
		end_place(m, runs, d, start ^ 1, uv);
		trim_curve_set_end(&out->curves[out->n - 1], 1, uv);
	}
	return st;
}

/* From run to run along the seams, until one is back. */
static enum status walk(const struct mender *m, const struct parts *p, struct run *runs, int first,
                        int d, bool outer, struct trim *out)
{
	struct trim_loop l = { .outer = outer };
	enum status st = ST_OK;
	int start = 2 * first;
	do {
		double from[2], to[2];
		runs[start / 2].done = true;
		st = put_run(m, p, runs, start, d, &l);
		const int end = start ^ 1;
		start = runs[end / 2].to[end % 2];
		end_place(m, runs, d, end, from);
		end_place(m, runs, d, start, to);
		if (st == ST_OK)
			st = trim_add_line(&l, from, to);
	} while (st == ST_OK && start != 2 * first);
	if (st == ST_OK)
		st = trim_add(out, &l);
	trim_loop_finish(&l);
	return st;
}

/* How far parts outside a domain that is not closed leave it, by the slope at its border. */
static void measure_beyond(struct mender *m, const struct parts *p, int d)
{
	enum { LOOKS = 16 };
	const double(*domain)[2] = m->s->domain;
	for (int i = 0; i < p->n; i++) {
		const struct curve *c = &p->list[i].curve;
		for (int k = 0; p->list[i].strip != 0 && k <= LOOKS; k++) {
			const double t = (double)k / LOOKS;
			const struct vec3 at =
			        curve_point(c, (1 - t) * c->domain[0] + t * c->domain[1]);
			const double uv[2] = { at.x, at.y };
			double in[2];
			struct vec3 point, slope[2];
			for (int e = 0; e < 2; e++)
				in[e] = fmin(fmax(uv[e], domain[e][0]), domain[e][1]);
			surface_tangents(m->s, in[0], in[1], &point, &slope[0], &slope[1]);
			m->beyond = fmax(m->beyond, fabs(uv[d] - in[d]) * vec3_length(slope[d]));
		}
	}
}

enum status trim_seam_cut(struct mender *m, const struct trim_loop *loop, int d, struct trim *out)
{
	struct parts p = { 0 };
	enum status st = cut_all(m, loop, d, &p);
	struct run *runs = st == ST_OK ? calloc(p.n, sizeof *runs) : NULL;
	if (!runs) {
		parts_finish(&p);
		return ST_RESOURCE;
	}
	const int n = find_runs(m, &p, d, runs);
	if (n == 1) {
		struct trim_loop l = { .outer = loop->outer };
		for (int i = 0; i < p.n && st == ST_OK; i++)
			st = put_part(m, &p.list[i], d, runs[0].strip, &l);
		if (st == ST_OK)
			st = trim_add(out, &l);
		trim_loop_finish(&l);
	} else {
		m->cut++;
		if (!m->closed[d])
			measure_beyond(m, &p, d);
		st = link_runs(m, runs, n);
		for (int i = 0; i < n && st == ST_OK; i++)
			if (!runs[i].done && (m->closed[d] || runs[i].strip == 0))
				st = walk(m, &p, runs, i, d, loop->outer, out);
	}
	free(runs);
	parts_finish(&p);
	return st;
}

enum status trim_seam_open(struct mender *m, const struct trim_loop *loop, int d, int way,
                           struct trim_loop *out)
{
	struct parts p = { 0 };
	enum status st = cut_all(m, loop, d, &p);
	int begin = 0, jumps = 0;
	for (int i = 1; i < p.n; i++)
		if (p.list[i].strip != p.list[i - 1].strip) {
			begin = i;
			jumps++;
		}
	/* one whole period has one seam inside, or begins and ends at seams */
	if (st == ST_OK &&
	    (jumps > 1 || (jumps == 1 && p.list[p.n - 1].strip != p.list[0].strip + way)))
		st = report_error(m->r, ST_INPUT,
		                  "%s: trimming loop %d winds around and crosses the seam more "
		                  "than once; expected it to cross once",
		                  m->what, m->loop);
	if (st == ST_OK && jumps)
		m->cut++;
	for (int k = 0; k < p.n && st == ST_OK; k++) {
		const struct part *part = &p.list[(begin + k) % p.n];
		st = put_part(m, part, d, part->strip, out);
	}
	if (st == ST_OK) {
		const double *range = m->s->domain[d];
		double from[2], to[2];
		trim_curve_end(&out->curves[0], 0, from);
		trim_curve_end(&out->curves[out->n - 1], 1, to);
		from[d] = range[way < 0];
		to[d] = range[way > 0];
		to[1 - d] = from[1 - d];
		trim_curve_set_end(&out->curves[0], 0, from);
		trim_curve_set_end(&out->curves[out->n - 1], 1, to);
	}
	parts_finish(&p);
	return st;
}
