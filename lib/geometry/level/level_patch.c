/* level_patch.c - the work on one patch, from f to strands as bytes.
 *
 * Arcs that meet on a line between two cells are linked here; what reaches the border of the patch
 * is left to level_join.
 */
#include "level_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "level_isophote.h"

/* Memory on the stack that serves patches of common degrees, in doubles, and with few arcs. */
enum { ROOM = 8192, LENT_PIECES = 64, LENT_ARCS = 16, FEW_ENDS = 32 };

/* Between cells one of which stayed undecided, ends are paired that lie this near. */
static const double near_on_line = 1e-7;

bool list_reserve(struct list *l, size_t more, size_t size)
{
	if (l->cap - l->n >= more)
		return true;
	size_t cap = l->cap ? 2 * l->cap : 64;
	cap = cap > l->n + more ? cap : l->n + more;
	void *p = l->failed ? NULL : realloc(l->lent ? NULL : l->p, cap * size);
	if (!p) {
		l->failed = true;
		return false;
	}
	if (l->lent)
		memcpy(p, l->p, l->n * size);
	l->lent = false;
	l->p = p;
	l->cap = cap;
	return true;
}

void list_finish(struct list *l)
{
	if (!l->lent)
		free(l->p);
	*l = (struct list){ 0 };
}

static int end_compare(const void *x, const void *y)
{
	const struct arc_end *a = x, *b = y;
	if (a->d != b->d)
		return a->d - b->d;
	if (a->line != b->line)
		return a->line < b->line ? -1 : 1;
	if (a->upper != b->upper)
		return a->upper - b->upper;
	if (a->at != b->at)
		return a->at < b->at ? -1 : 1;
	return 2 * a->arc + a->end - (2 * b->arc + b->end);
}

/* Mostly there are few. */
static void ends_sort(struct arc_end *e, int n)
{
	if (n > FEW_ENDS) {
		qsort(e, n, sizeof *e, end_compare);
		return;
	}
	for (int i = 1; i < n; i++) {
		const struct arc_end x = e[i];
		int k = i;
		for (; k > 0 && end_compare(&x, &e[k - 1]) < 0; k--)
			e[k] = e[k - 1];
		e[k] = x;
	}
}

/* What an arc's end leads to: another end as 2 arc + end, or one of these. */
enum { LINK_LOOSE = -1, LINK_BORDER = -2 };

struct patch_links {
	int *to;                    /* 2 an arc */
	const struct arc_end **end; /* the end's own record */
};

static void link_pair(struct patch_links *k, const struct arc_end *a, const struct arc_end *b)
{
	int x = 2 * a->arc + a->end, y = 2 * b->arc + b->end;
	k->to[x] = y;
	k->to[y] = x;
}

/* Ends a[0..n) from below a line and b[0..m) from above, both rising. */
static void link_line(struct patch_links *k, const struct arc_end *a, int n,
                      const struct arc_end *b, int m)
{
	if (n == m) {
		bool near = true;
		for (int i = 0; i < n; i++)
			near &= fabs(a[i].at - b[i].at) < near_on_line;
		for (int i = 0; near && i < n; i++)
			link_pair(k, &a[i], &b[i]);
		if (near)
			return;
	}
	for (int i = 0, j = 0; i < n && j < m;) {
		if (fabs(a[i].at - b[j].at) < near_on_line)
			link_pair(k, &a[i++], &b[j++]);
		else if (a[i].at < b[j].at)
			i++;
		else
			j++;
	}
}

static void link_arcs(struct tracer *t, struct patch_links *k)
{
	struct arc_end *e = t->ends.p;
	int n = (int)t->ends.n;
	ends_sort(e, n);
	for (int i = 0; i < n; i++) {
		k->to[2 * e[i].arc + e[i].end] = LINK_LOOSE;
		k->end[2 * e[i].arc + e[i].end] = &e[i];
	}
	for (int i = 0; i < n;) {
		int middle, end;
		for (middle = i; middle < n && e[middle].d == e[i].d &&
		                 e[middle].line == e[i].line && !e[middle].upper;)
			middle++;
		for (end = middle; end < n && e[end].d == e[i].d && e[end].line == e[i].line;)
			end++;
		if (e[i].line == 0 || e[i].line == 1 << LINE_BITS)
			for (int j = i; j < end; j++)
				k->to[2 * e[j].arc + e[j].end] = LINK_BORDER;
		else
			link_line(k, e + i, middle - i, e + middle, end - middle);
		i = end;
	}
}

void piece_reverse(struct piece *p)
{
	for (int d = 0; d < 3; d++) {
		double x = p->p[0][d], y = p->dp[0][d];
		p->p[0][d] = p->p[1][d];
		p->p[1][d] = x;
		p->dp[0][d] = -p->dp[1][d];
		p->dp[1][d] = -y;
	}
	for (int d = 0; d < 2; d++) {
		double x = p->uv[0][d], y = p->duv[0][d];
		p->uv[0][d] = p->uv[1][d];
		p->uv[1][d] = x;
		p->duv[0][d] = -p->duv[1][d];
		p->duv[1][d] = -y;
	}
}

static struct strand_end strand_end(const struct patch_links *k, int at)
{
	struct strand_end e = { .kind = STRAND_LOOSE };
	if (k->to[at] == LINK_BORDER) {
		e.kind = STRAND_BORDER;
		e.d = k->end[at]->d;
		e.upper = k->end[at]->line != 0;
		e.at = k->end[at]->at;
	}
	return e;
}

/* The strands of a patch: `order` holds the ends by which their arcs are entered, one strand after another. */
struct patch_strands {
	struct strand *strand;
	int *order, n, n_arcs, n_pieces;
};

/* The strand that begins with arc end `from`; `closed`: it comes back to it. */
static void strand_add(const struct tracer *t, const struct patch_links *k, bool *done, int from,
                       bool closed, struct patch_strands *out)
{
	struct strand *s = &out->strand[out->n++];
	int at = from;
	memset(s, 0, sizeof *s);
	s->first = out->n_pieces;
	for (;;) {
		done[at / 2] = true;
		out->order[out->n_arcs++] = at;
		out->n_pieces += ((const struct arc *)t->arcs.p + at / 2)->n;
		int next = k->to[at ^ 1];
		if (next < 0 || done[next / 2])
			break;
		at = next;
	}
	s->n = out->n_pieces - s->first;
	if (closed) {
		s->end[0].kind = s->end[1].kind = STRAND_CLOSED;
	} else {
		s->end[0] = strand_end(k, from);
		s->end[1] = strand_end(k, at ^ 1);
	}
}

static void strands_make(struct tracer *t, struct patch_links *k, bool *done,
                         struct patch_strands *out)
{
	const size_t n = t->arcs.n;
	memset(done, 0, n);
	memset(k->to, 0, sizeof *k->to * 2 * n);
	link_arcs(t, k);
	for (size_t e = 0; e < 2 * n; e++)
		if (k->to[e] < 0 && !done[e / 2])
			strand_add(t, k, done, (int)e, false, out);
	for (size_t a = 0; a < n; a++)
		if (!done[a])
			strand_add(t, k, done, (int)(2 * a), true, out);
}

/* The arc's pieces, backwards where it is entered at its end 1. */
static void arc_write(const struct tracer *t, int from, struct text *out)
{
	const struct arc *a = (const struct arc *)t->arcs.p + from / 2;
	const struct piece *p = (const struct piece *)t->pieces.p + a->first;
	if (from % 2 == 0) {
		text_add_bytes(out, p, sizeof *p * a->n);
		return;
	}
	for (int i = a->n - 1; i >= 0; i--) {
		struct piece turned = p[i];
		piece_reverse(&turned);
		text_add_bytes(out, &turned, sizeof turned);
	}
}

static enum status patch_write(struct tracer *t, struct text *out)
{
	const size_t n = t->arcs.n;
	if (n == 0 && t->undecided.n == 0 && t->umbilics.n == 0)
		return ST_OK;
	struct patch_strands made = { .n = 0 };
	struct patch_links k;
	/* from wide to narrow */
	const size_t each = sizeof *made.strand + 2 * sizeof *k.end + 2 * sizeof *k.to +
	                    sizeof *made.order + sizeof(bool);
	double *room = level_room(t, n * each / sizeof *room + 1);
	if (!room)
		return ST_RESOURCE;
	made.strand = (struct strand *)room;
	k.end = (const struct arc_end **)(made.strand + n);
	k.to = (int *)(k.end + 2 * n);
	made.order = k.to + 2 * n;
	strands_make(t, &k, (bool *)(made.order + n), &made);
	struct patch_header h = { .magic = PATCH_MAGIC,
		                  .patch = t->patch,
		                  .n_strands = made.n,
		                  .n_pieces = made.n_pieces,
		                  .n_undecided = (int)t->undecided.n,
		                  .n_umbilics = (int)t->umbilics.n };
	text_add_bytes(out, &h, sizeof h);
	text_add_bytes(out, made.strand, made.n * sizeof *made.strand);
	for (int i = 0; i < made.n_arcs; i++)
		arc_write(t, made.order[i], out);
	text_add_bytes(out, t->undecided.p, t->undecided.n * sizeof(struct undecided));
	text_add_bytes(out, t->umbilics.p, t->umbilics.n * sizeof(struct umbilic));
	level_room_free(t, room);
	return out->failed ? ST_RESOURCE : ST_OK;
}

double *level_room(struct tracer *t, size_t n)
{
	double *p = t->room;
	if (n <= t->n_room) {
		t->room += n;
		t->n_room -= n;
		return p;
	}
	p = malloc(sizeof *p * n);
	if (!p)
		t->failed = true;
	return p;
}

void level_room_free(const struct tracer *t, double *p)
{
	if (p < t->stack || p >= t->stack + ROOM)
		free(p);
}

static void tracer_init(struct tracer *t, const struct level *l, size_t patch)
{
	const struct level_surface *s = l->surface;
	t->level = l;
	t->patch = (int)patch;
	t->place[0] = t->patch / s->net.spans[1];
	t->place[1] = t->patch % s->net.spans[1];
	t->points = bezier_patch(&s->net, t->place[0], t->place[1]);
	t->n_field = (size_t)(l->degree[0] + 1) * (l->degree[1] + 1);
	for (int k = 0; k < 2; k++) {
		t->bent[0][k] = s->bent[0][level_edge(s, 0, t->place[0] + k, t->place[1])];
		t->bent[1][k] = s->bent[1][level_edge(s, 1, t->place[0], t->place[1] + k)];
	}
	/* lengths of normals are made for each patch alone */
	for (int k = 0; l->oblique && k < 2; k++)
		t->bent[0][k] = t->bent[1][k] = true;
	if (s->normals)
		t->normals = s->normals + level_normals_size(s) * patch;
	if (l->side)
		t->n_side = (size_t)(l->side_degree[0] + 1) * (l->side_degree[1] + 1);
}

enum status level_patch(const struct level *l, size_t patch, const struct level_stop *stop,
                        struct text *out)
{
	const enum level_kind kind = l->surface->kind;
	if (level_plane_misses(l, patch))
		return ST_OK;
	double room[ROOM];
	struct piece pieces[LENT_PIECES];
	struct arc arcs[LENT_ARCS];
	struct arc_end ends[2 * LENT_ARCS];
	struct tracer t = { .stop = stop,
		            .room = room,
		            .stack = room,
		            .n_room = ROOM,
		            .pieces = { pieces, 0, LENT_PIECES, .lent = true },
		            .arcs = { arcs, 0, LENT_ARCS, .lent = true },
		            .ends = { ends, 0, 2 * LENT_ARCS, .lent = true } };
	enum status st = ST_RESOURCE;
	tracer_init(&t, l, patch);
	t.field = level_room(&t, t.n_field);
	t.product = level_room(&t, kind == LEVEL_CURVATURE      ? level_curvature_room(l)
	                           : level_shapes[kind].several ? level_kind_room(l)
	                                                        : level_isophote_room(l));
	double *c = level_room(&t, t.n_field + t.n_side);
	if (!t.failed && level_field_make(&t, c))
		level_search(&t, c);
	if (!t.failed && l->side && kind == LEVEL_CURVATURE && (l->owner || t.undecided.n > 0))
		level_umbilics_find(&t);
	if (t.stopped)
		st = ST_CANCELLED;
	else if (!t.failed)
		st = patch_write(&t, out);
	for (int i = 0; i < N_SCRATCH && t.scratch[i]; i++) /* filled in order */
		level_room_free(&t, t.scratch[i]);
	level_room_free(&t, t.field);
	level_room_free(&t, t.product);
	level_room_free(&t, c);
	list_finish(&t.arcs);
	list_finish(&t.pieces);
	list_finish(&t.ends);
	list_finish(&t.undecided);
	list_finish(&t.umbilics);
	return st;
}
