/* level_join.c - the strands of all patches become branches. */
#include "level_private.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void level_globalise(const struct level_surface *s, int patch, const double uv[2], double out[2])
{
	int place[2] = { patch / s->net.spans[1], patch % s->net.spans[1] };
	for (int d = 0; d < 2; d++)
		out[d] = level_global(s->net.breaks[d] + place[d], uv[d]);
}

void joint_end_get(const struct joint *j, size_t end, struct joint_end *out)
{
	const struct strand *s = &j->strands[end / 2];
	int e = end % 2;
	const struct piece *p = &j->pieces[s->first + (e ? s->n - 1 : 0)];
	double l = sqrt(p->dp[e][0] * p->dp[e][0] + p->dp[e][1] * p->dp[e][1] +
	                p->dp[e][2] * p->dp[e][2]);
	for (int d = 0; d < 3; d++) {
		out->p[d] = p->p[e][d];
		out->tangent[d] = l > 0 ? (e ? 1 : -1) * p->dp[e][d] / l : 0;
	}
	level_globalise(j->level->surface, j->patch[end / 2], p->uv[e], out->uv);
}

bool level_header_read(size_t patches, const char **at, const char *end, int last,
                       struct patch_header *h)
{
	if ((size_t)(end - *at) < sizeof *h)
		return false;
	memcpy(h, *at, sizeof *h);
	*at += sizeof *h;
	if (memcmp(h->magic, PATCH_MAGIC, sizeof h->magic) != 0 || h->patch <= last ||
	    (size_t)h->patch >= patches || h->n_strands < 0 || h->n_pieces < 0 ||
	    h->n_undecided < 0 || h->n_umbilics < 0)
		return false;
	size_t left = (size_t)(end - *at);
	return (size_t)h->n_strands <= left / sizeof(struct strand) &&
	       (size_t)h->n_pieces <= left / sizeof(struct piece) &&
	       (size_t)h->n_undecided <= left / sizeof(struct undecided) &&
	       (size_t)h->n_umbilics <= left / sizeof(struct umbilic) &&
	       h->n_strands * sizeof(struct strand) + h->n_pieces * sizeof(struct piece) +
	                       h->n_undecided * sizeof(struct undecided) +
	                       h->n_umbilics * sizeof(struct umbilic) <=
	               left;
}

bool level_strand_valid(const struct strand *s, const struct patch_header *h)
{
	for (int e = 0; e < 2; e++) {
		const struct strand_end *x = &s->end[e];
		if (x->kind < STRAND_BORDER || x->kind > STRAND_CLOSED || x->d < 0 || x->d > 1 ||
		    x->upper < 0 || x->upper > 1 || !(x->at >= 0 && x->at <= 1))
			return false;
	}
	return s->n > 0 && s->first >= 0 && s->first <= h->n_pieces - s->n &&
	       (s->end[0].kind == STRAND_CLOSED) == (s->end[1].kind == STRAND_CLOSED);
}

static bool undecided_valid(const struct undecided *u)
{
	for (int d = 0; d < 2; d++)
		if (u->level[d] < 0 || u->level[d] > CELL_DEPTH_MAX || u->index[d] < 0 ||
		    u->index[d] >= 1 << u->level[d])
			return false;
	return true;
}

static bool umbilic_valid(const struct umbilic *x)
{
	for (int d = 0; d < 2; d++)
		if (!(x->lo[d] >= 0 && x->lo[d] <= x->hi[d] && x->hi[d] <= 1 && x->at[d] >= 0 &&
		      x->at[d] <= 1))
			return false;
	return x->kind >= 0 && x->kind < N_UMBILIC_KINDS;
}

static bool box_add(struct joint *j, int patch, const struct undecided *u)
{
	struct level_box *b = list_add(&j->boxes, sizeof *b);
	double lo[2], hi[2];
	if (!b)
		return false;
	for (int d = 0; d < 2; d++) {
		lo[d] = ldexp(u->index[d], -u->level[d]);
		hi[d] = ldexp(u->index[d] + 1.0, -u->level[d]);
	}
	level_globalise(j->level->surface, patch, lo, b->lo);
	level_globalise(j->level->surface, patch, hi, b->hi);
	b->flat = u->flat;
	b->kind = u->graze ? LEVEL_GRAZE : LEVEL_POINT;
	return true;
}

/* Walk through all blocks: count (j->strands NULL) or fill. */
static enum status blocks_read(struct joint *j, const char *const *blocks, const size_t *sizes,
                               size_t n_blocks)
{
	bool fill = j->strands != NULL;
	int last = -1;
	j->n_strands = j->n_pieces = 0;
	for (size_t i = 0; i < n_blocks; i++) {
		if (!sizes[i])
			continue;
		const char *at = blocks[i], *end = at + sizes[i];
		while (at < end) {
			struct patch_header h;
			if (!level_header_read(level_patches(j->level), &at, end, last, &h))
				return ST_INTERNAL;
			last = h.patch;
			for (int k = 0; k < h.n_strands; k++, at += sizeof(struct strand)) {
				struct strand s;
				memcpy(&s, at, sizeof s);
				if (!level_strand_valid(&s, &h))
					return ST_INTERNAL;
				s.first += (int)j->n_pieces;
				if (fill) {
					j->strands[j->n_strands] = s;
					j->patch[j->n_strands] = h.patch;
				}
				j->n_strands++;
			}
			if (fill)
				memcpy(j->pieces + j->n_pieces, at,
				       sizeof(struct piece) * h.n_pieces);
			at += sizeof(struct piece) * h.n_pieces;
			j->n_pieces += h.n_pieces;
			if (j->n_pieces > INT_MAX / 4)
				return ST_RESOURCE;
			for (int k = 0; k < h.n_undecided; k++, at += sizeof(struct undecided)) {
				struct undecided u;
				memcpy(&u, at, sizeof u);
				if (!undecided_valid(&u))
					return ST_INTERNAL;
				if (fill && !box_add(j, h.patch, &u))
					return ST_RESOURCE;
			}
			for (int k = 0; k < h.n_umbilics; k++, at += sizeof(struct umbilic)) {
				struct patch_umbilic u = { .patch = h.patch };
				memcpy(&u.x, at, sizeof u.x);
				if (!umbilic_valid(&u.x))
					return ST_INTERNAL;
				struct patch_umbilic *to =
				        fill ? list_next(&j->umbilics, sizeof *to) : NULL;
				if (fill && !to)
					return ST_RESOURCE;
				if (to)
					*to = u;
			}
		}
	}
	return ST_OK;
}

static enum status joint_init(struct joint *j, const char *const *blocks, const size_t *sizes,
                              size_t n_blocks)
{
	enum status st = blocks_read(j, blocks, sizes, n_blocks);
	if (st != ST_OK)
		return st;
	j->strands = malloc(sizeof *j->strands * (j->n_strands + 1));
	j->patch = malloc(sizeof *j->patch * (j->n_strands + 1));
	j->pieces = malloc(sizeof *j->pieces * (j->n_pieces + 1));
	j->links = calloc(2 * j->n_strands + 1, sizeof *j->links);
	if (!j->strands || !j->patch || !j->pieces || !j->links)
		return ST_RESOURCE;
	return blocks_read(j, blocks, sizes, n_blocks);
}

static void joint_finish(struct joint *j)
{
	free(j->strands);
	free(j->patch);
	free(j->pieces);
	free(j->links);
	free(j->boxes.p);
	free(j->umbilics.p);
}

/*
 * The ends by which the strands from `from` on are entered; a closed run comes back to `from`.
 * Returns their number.
 */
static size_t run_follow(const struct joint *j, size_t from, bool *done, size_t *entries)
{
	size_t n = 0, at = from;
	for (;;) {
		done[at / 2] = true;
		entries[n++] = at;
		const struct link *l = &j->links[at ^ 1];
		if (l->kind != LINK_STRAND || done[l->other / 2])
			return n;
		at = l->other;
	}
}

static void entries_reverse(size_t *e, size_t n)
{
	for (size_t i = 0; i < n / 2; i++) {
		size_t x = e[i];
		e[i] = e[n - 1 - i];
		e[n - 1 - i] = x;
	}
}

/* Turn a closed run round so that it begins where u or v jumps, if it does. */
static void run_begin_at_cut(const struct joint *j, size_t *entries, size_t n)
{
	size_t first = 0;
	while (first < n && !j->links[entries[first]].cut)
		first++;
	if (first == n)
		return;
	entries_reverse(entries, first);
	entries_reverse(entries + first, n - first);
	entries_reverse(entries, n);
}

static enum status branch_add(const struct joint *j, size_t *entries, size_t n, bool closed,
                              struct list *branches, struct level_result *out)
{
	struct level_branch *b = list_add(branches, sizeof *b);
	if (!b)
		return ST_RESOURCE;
	if (closed)
		run_begin_at_cut(j, entries, n);
	out->branches = branches->p;
	out->n_branches = branches->n;
	enum status st = level_branch_make(j, entries, n, closed, b);
	if (st != ST_OK)
		return st;
	out->n_closed += closed;
	out->length += b->length;
	out->max_error = larger(out->max_error, b->max_error);
	out->max_error_uv = larger(out->max_error_uv, b->max_error_uv);
	return ST_OK;
}

static enum status branches_make(const struct joint *j, struct level_result *out)
{
	struct list branches = { 0 };
	bool *done = calloc(j->n_strands + 1, sizeof *done);
	size_t *entries = malloc(sizeof *entries * (j->n_strands + 1));
	enum status st = done && entries ? ST_OK : ST_RESOURCE;
	for (size_t e = 0; st == ST_OK && e < 2 * j->n_strands; e++)
		if (!done[e / 2] && j->strands[e / 2].end[0].kind != STRAND_CLOSED &&
		    j->links[e].kind == LINK_END)
			st = branch_add(j, entries, run_follow(j, e, done, entries), false,
			                &branches, out);
	for (size_t s = 0; st == ST_OK && s < j->n_strands; s++)
		if (!done[s])
			st = branch_add(j, entries, run_follow(j, 2 * s, done, entries), true,
			                &branches, out);
	free(done);
	free(entries);
	return st;
}

enum status level_join(const struct level *l, const char *const *blocks, const size_t *sizes,
                       size_t n_blocks, struct level_result *out, const struct report *r)
{
	struct joint j = { .level = l };
	*out = (struct level_result){ 0 };
	enum status st = joint_init(&j, blocks, sizes, n_blocks);
	if (st == ST_OK)
		st = level_link(&j);
	if (st == ST_OK)
		st = level_umbilics_join(&j, out);
	if (st == ST_OK)
		st = level_regions(&j, out);
	if (st == ST_OK)
		st = branches_make(&j, out);
	joint_finish(&j);
	if (st == ST_OK)
		return st;
	level_result_finish(out);
	return report_error(r, st,
	                    st == ST_INTERNAL
	                            ? "traced curves are damaged or of another version of the "
	                              "program; remove the part file and start again"
	                            : "no memory to join the traced curves");
}

void level_result_finish(struct level_result *x)
{
	if (!x)
		return;
	for (size_t i = 0; i < x->n_branches; i++) {
		curve_finish(&x->branches[i].uv);
		curve_finish(&x->branches[i].space);
	}
	free(x->branches);
	free(x->undecided);
	free(x->umbilics);
	*x = (struct level_result){ 0 };
}
