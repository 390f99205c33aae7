/* batch.c - values at many points of a surface in one call. */
#include "batch.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "batch_kernel.h"
#include "parallel.h"

/* Points that are sorted at once: many enough to meet in a span, results still in the cache. */
enum { CHUNK = 16384 };

/* A point of the chunk and its span. */
struct place {
	int32_t span[2];
	uint32_t index;
};

struct batch {
	const struct surface *s; /* borrowed, like all that the caller gave */
	const struct batch_kernel *kernel;
	unsigned what;
	double *const *out;
	struct place *places, *other; /* owned: CHUNK each */
	uint32_t *count;              /* owned: a span of either direction each, and one more */
	struct batch_span span;
	struct grid_block block;
	_Alignas(64) double at[2][GRID_BLOCK];
};

static const struct batch_kernel *kernel_choose(void)
{
#ifdef GRID_LEVELS_X86
	static const struct batch_kernel *const kernels[] = { &batch_kernel_v4, &batch_kernel_v3 };
	for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
		if (!strcmp(vector_level(), kernels[i]->level))
			return kernels[i];
#endif
	return &batch_kernel_baseline;
}

static void batch_destroy(struct batch *b)
{
	if (!b)
		return;
	free(b->places);
	free(b->other);
	free(b->count);
	free(b);
}

static struct batch *batch_create(const struct surface *s, size_t n)
{
	const size_t room = n < CHUNK ? n : CHUNK;
	const int longer = s->n[0] > s->n[1] ? s->n[0] : s->n[1];
	struct batch *b = aligned_alloc(64, (sizeof *b + 63) / 64 * 64);
	if (!b)
		return NULL;
	b->s = s;
	b->kernel = kernel_choose();
	b->places = malloc(sizeof *b->places * room);
	b->other = malloc(sizeof *b->other * room);
	b->count = malloc(sizeof *b->count * ((size_t)longer + 1));
	if (b->places && b->other && b->count)
		return b;
	batch_destroy(b);
	return NULL;
}

/* Sort n places by their span in direction d, equal ones as they come. */
static void places_sort(struct batch *b, size_t n, int d)
{
	memset(b->count, 0, sizeof *b->count * ((size_t)b->s->n[d] + 1));
	for (size_t i = 0; i < n; i++)
		b->count[b->places[i].span[d] + 1]++;
	for (int k = 0; k < b->s->n[d]; k++)
		b->count[k + 1] += b->count[k];
	for (size_t i = 0; i < n; i++)
		b->other[b->count[b->places[i].span[d]]++] = b->places[i];
	struct place *swap = b->places;
	b->places = b->other;
	b->other = swap;
}

/*
 * Lengths are taken from the control point of the span that is towards the nearer ends of the
 * surface: a pole may be there, and beside it differences must keep their digits.
 */
static void span_set(struct batch_span *x, const struct surface *s, const int span[2])
{
	int side[2];
	x->rational = s->rational;
	for (int d = 0; d < 2; d++) {
		const int order = s->order[d];
		const double *k = s->knots[d] + span[d];
		double *inverse = x->inverse[d];
		x->order[d] = order;
		x->knots[d] = k;
		for (int j = 1; j < order; j++)
			for (int i = 0; i < j; i++)
				*inverse++ = 1 / (k[i + 1] - k[1 - j + i]);
		side[d] = 2 * span[d] > s->n[d] + order ? order - 1 : 0;
	}
	const int ku = s->order[0], kv = s->order[1];
	const double *p = s->points + 4 * ((size_t)(span[0] - ku + 1) * s->n[1] + span[1] - kv + 1);
	const double *o = p + 4 * ((size_t)s->n[1] * side[0] + side[1]);
	for (int c = 0; c < 3; c++)
		x->center[c] = o[c] / o[3];
	for (int i = 0; i < ku; i++, p += (size_t)4 * s->n[1])
		for (int j = 0; j < kv; j++) {
			double *to = x->points[i * kv + j];
			for (int c = 0; c < 3; c++)
				to[c] = p[4 * j + c] - p[4 * j + 3] * x->center[c];
			to[3] = p[4 * j + 3];
		}
}

/* Normal and quantities of a point that the kernel has left to the slow way. */
static void point_alone(struct batch *b, const double *uv, size_t lane)
{
	struct surface_shape p;
	surface_shape(b->s, uv[0], uv[1], &p);
	for (int q = 0; q < N_QUANTITIES; q++)
		b->block.channel[q][lane] = p.value[q];
	b->block.channel[GRID_NORMAL_X][lane] = p.normal.x;
	b->block.channel[GRID_NORMAL_Y][lane] = p.normal.y;
	b->block.channel[GRID_NORMAL_Z][lane] = p.normal.z;
}

/* At most GRID_BLOCK points of the span that is set. */
static void points_of_span(struct batch *b, const double *uv, const struct place *places, size_t n,
                           size_t first)
{
	const size_t padded = (n + GRID_PAD - 1) / GRID_PAD * GRID_PAD;
	for (size_t i = 0; i < padded; i++) {
		/* Lanes that only fill up repeat the last point. */
		const double *p = uv + (size_t)2 * places[i < n ? i : n - 1].index;
		b->at[0][i] = p[0];
		b->at[1][i] = p[1];
	}
	if (b->kernel->block(&b->span, b->what, b->at[0], b->at[1], padded, &b->block) > 0)
		for (size_t i = 0; i < n; i++)
			if (!(b->block.area2[i] > 0))
				point_alone(b, uv + (size_t)2 * places[i].index, i);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		if (b->what & GRID_BIT(c))
			for (size_t i = 0; i < n; i++)
				b->out[c][first + places[i].index] = b->block.channel[c][i];
}

static void chunk_do(struct batch *b, const double *uv, size_t n, size_t first)
{
	const struct surface *s = b->s;
	for (size_t i = 0; i < n; i++) {
		b->places[i].index = (uint32_t)i;
		for (int d = 0; d < 2; d++)
			b->places[i].span[d] = knots_domain_span(s->order[d], s->n[d], s->knots[d],
			                                         s->domain[d], uv[2 * i + d]);
	}
	places_sort(b, n, 1);
	places_sort(b, n, 0);
	for (size_t i = 0, end; i < n; i = end) {
		const int *span = b->places[i].span;
		for (end = i + 1; end < n && end - i < GRID_BLOCK; end++)
			if (b->places[end].span[0] != span[0] || b->places[end].span[1] != span[1])
				break;
		if (i == 0 || memcmp(b->places[i - 1].span, span, sizeof b->places[i].span) != 0)
			span_set(&b->span, s, span);
		points_of_span(b, uv, b->places + i, end - i, first);
	}
}

enum status surface_shapes(const struct surface *s, const double *uv, size_t n, unsigned what,
                           double *const out[N_GRID_CHANNELS])
{
	struct batch *b = n ? batch_create(s, n) : NULL;
	if (!b)
		return n ? ST_RESOURCE : ST_OK;
	b->what = what;
	b->out = out;
	for (size_t first = 0; first < n; first += CHUNK)
		chunk_do(b, uv + 2 * first, n - first < CHUNK ? n - first : CHUNK, first);
	batch_destroy(b);
	return ST_OK;
}
