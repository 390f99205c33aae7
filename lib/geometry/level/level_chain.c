/* level_chain.c - ends that meet over shared borders, nearest first; the chains that they make. */
#include "level_chain.h"

#include <stdint.h>
#include <stdlib.h>

static const size_t none = SIZE_MAX;

void level_chains_finish(struct level_chains *c)
{
	if (!c)
		return;
	free(c->parts);
	free(c->list);
	*c = (struct level_chains){ .n = 0 };
}

/* Two ends that may be joined. */
struct meeting {
	double distance;
	size_t a, b; /* a < b */
};

static int by_x(const void *pa, const void *pb)
{
	const struct chain_end *a = *(const struct chain_end *const *)pa,
	                       *b = *(const struct chain_end *const *)pb;
	if (a->p.x != b->p.x)
		return a->p.x < b->p.x ? -1 : 1;
	return a->k < b->k ? -1 : 1;
}

static int by_distance(const void *pa, const void *pb)
{
	const struct meeting *a = pa, *b = pb;
	if (a->distance != b->distance)
		return a->distance < b->distance ? -1 : 1;
	if (a->a != b->a)
		return a->a < b->a ? -1 : 1;
	return a->b < b->b ? -1 : a->b > b->b;
}

/* All pairs that may be joined, nearest first. ends: by x. */
static enum status meetings_find(const struct joiner *j, struct chain_end *const *ends, size_t n,
                                 struct list *meetings)
{
	double most = 0;
	for (size_t i = 0; i < n; i++)
		most = larger(most, ends[i]->reach);
	for (size_t i = 0; i < n; i++)
		for (size_t k = i + 1; k < n && ends[k]->p.x - ends[i]->p.x <= most; k++) {
			const struct chain_end *a = ends[i], *b = ends[k];
			const double d = vec3_length(vec3_sub(a->p, b->p));
			if (a->node || b->node || d > smaller(a->reach, b->reach) ||
			    !chain_ends_meet(j, a, b, d))
				continue;
			struct meeting *m = list_add(meetings, sizeof *m);
			if (!m)
				return ST_RESOURCE;
			*m = (struct meeting){ d, a->k < b->k ? a->k : b->k,
				               a->k < b->k ? b->k : a->k };
		}
	if (meetings->n > 0)
		qsort(meetings->p, meetings->n, sizeof(struct meeting), by_distance);
	return ST_OK;
}

static size_t root_of(size_t *parent, size_t i)
{
	while (parent[i] != i)
		i = parent[i] = parent[parent[i]];
	return i;
}

/*
 * Ends of one place, ends[i] for all i with root `root`: a node where, but for branches that both
 * begin and end here, three or more end, of three or more faces or at a crossing of one face.
 */
static bool is_node(struct chain_end *const *ends, size_t *parent, size_t n, size_t root,
                    size_t from)
{
	size_t count = 0, faces = 0;
	bool crossing = false;
	for (size_t i = from; i < n; i++) {
		bool loop = false, seen = false;
		if (root_of(parent, i) != root)
			continue;
		for (size_t k = from; k < n; k++) {
			if (k == i || root_of(parent, k) != root)
				continue;
			loop |= (ends[k]->k ^ 1) == ends[i]->k;
			seen |= k < i && ends[k]->face == ends[i]->face;
		}
		count += !loop;
		faces += !loop && !seen;
		crossing |= !loop && ends[i]->crossing;
	}
	return count >= 3 && (faces >= 3 || crossing);
}

static int by_place(const void *pa, const void *pb)
{
	const struct chain_end *a = *(const struct chain_end *const *)pa,
	                       *b = *(const struct chain_end *const *)pb;
	if (a->at.x != b->at.x)
		return a->at.x < b->at.x ? -1 : 1;
	return a->k < b->k ? -1 : 1;
}

/* Where three or more curves end in one point over several faces none goes on. */
static enum status nodes_find(const struct joiner *j, struct chain_end **ends, size_t n,
                              struct level_chains *out)
{
	const double near = 4 * j->how->tolerance;
	size_t *parent = malloc(sizeof *parent * (n + 1));
	if (!parent)
		return ST_RESOURCE;
	qsort(ends, n, sizeof *ends, by_place);
	for (size_t i = 0; i < n; i++)
		parent[i] = i;
	for (size_t i = 0; i < n; i++)
		for (size_t k = i + 1; k < n && ends[k]->at.x - ends[i]->at.x <= near; k++)
			if (vec3_length(vec3_sub(ends[k]->at, ends[i]->at)) <= near) {
				const size_t a = root_of(parent, i), b = root_of(parent, k);
				parent[a > b ? a : b] = a > b ? b : a;
			}
	for (size_t i = 0; i < n; i++) {
		size_t count = 0;
		if (parent[i] != i)
			continue;
		for (size_t k = i; k < n; k++)
			count += root_of(parent, k) == i;
		if (count < 3 || !is_node(ends, parent, n, i, i))
			continue;
		out->nodes++;
		for (size_t k = i; k < n; k++)
			if (root_of(parent, k) == i)
				ends[k]->node = true;
	}
	free(parent);
	return ST_OK;
}

/* Run from end k through its branch and on, until there is no further one. */
static void chain_walk(struct level_chains *c, const struct chain_end *ends, const size_t *partner,
                       bool *done, size_t *at, size_t k)
{
	struct level_chain *one = &c->list[c->n++];
	*one = (struct level_chain){ .first = *at };
	for (; k != none && !done[k / 2]; k = partner[k ^ 1]) {
		done[k / 2] = true;
		c->parts[(*at)++] = (struct level_part){ ends[k].face, ends[k].branch, k & 1 };
	}
	one->n = *at - one->first;
	one->closed = k != none;
	c->n_closed += one->closed;
}

/* Those with ends first, from the end whose branch comes first. */
static void chains_make(struct level_chains *c, const struct chain_end *ends, const size_t *partner,
                        bool *done, size_t n)
{
	size_t at = 0;
	for (size_t k = 0; k < 2 * n; k++)
		if (partner[k] == none && !done[k / 2])
			chain_walk(c, ends, partner, done, &at, k);
	for (size_t i = 0; i < n; i++)
		if (!done[i])
			chain_walk(c, ends, partner, done, &at, 2 * i);
}

static enum status partners_find(const struct joiner *j, struct chain_end *ends, size_t n,
                                 size_t *partner, struct level_chains *out)
{
	struct chain_end **open = malloc(sizeof(*open) * (2 * n + 1));
	struct list meetings = { 0 };
	size_t n_open = 0;
	if (!open)
		return ST_RESOURCE;
	for (size_t k = 0; k < 2 * n; k++) {
		partner[k] = ends[k].closed ? k ^ 1 : none;
		if (!ends[k].closed)
			open[n_open++] = &ends[k];
	}
	enum status st = nodes_find(j, open, n_open, out);
	qsort(open, n_open, sizeof(*open), by_x);
	if (st == ST_OK)
		st = meetings_find(j, open, n_open, &meetings);
	const struct meeting *m = meetings.p;
	for (size_t i = 0; st == ST_OK && i < meetings.n; i++)
		if (partner[m[i].a] == none && partner[m[i].b] == none) {
			partner[m[i].a] = m[i].b;
			partner[m[i].b] = m[i].a;
			out->joins++;
			out->step = larger(out->step, m[i].distance);
		}
	for (size_t k = 0; st == ST_OK && k < 2 * n; k++)
		out->creases += partner[k] == none && ends[k].crease;
	free(meetings.p);
	free(open);
	return st;
}

enum status level_chains_join(const struct level_faces *f, const struct level_joining *how,
                              struct level_result *results, struct level_chains *out)
{
	struct joiner j = { .faces = f, .how = how, .size = faces_size(f) };
	struct chain_end *ends = NULL;
	size_t n = 0, *partner = NULL;
	bool *done = NULL;
	*out = (struct level_chains){ .n = 0 };
	enum status st = level_doubles_drop(f, how->tolerance, results);
	if (st == ST_OK)
		st = level_specks_drop(f, how->tolerance, results);
	for (int i = 0; i < f->n; i++)
		n += results[i].n_branches;
	if (st == ST_OK)
		st = chain_ends_make(&j, results, n, &ends);
	partner = malloc(sizeof *partner * (2 * n + 1));
	done = calloc(n + 1, sizeof *done);
	out->parts = malloc(sizeof *out->parts * (n + 1));
	out->list = malloc(sizeof *out->list * (n + 1));
	if (!partner || !done || !out->parts || !out->list)
		st = ST_RESOURCE;
	if (st == ST_OK)
		st = partners_find(&j, ends, n, partner, out);
	if (st == ST_OK)
		chains_make(out, ends, partner, done, n);
	else
		level_chains_finish(out);
	free(ends);
	free(partner);
	free(done);
	return st;
}
