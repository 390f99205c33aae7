/* ray_walk.h - a ray or a packet of them through the tree to the leaves it may meet. Private; included
 * by ray_packet.c only.
 *
 * Packets whose rays go much the same way are one bundle: intervals of origins and slopes, against
 * the eight boxes of a node at a time. Others are tested ray by ray, a box at a time. Either way a
 * leaf is tried with those rays only that meet its box.
 */
#ifndef BATTEN_RAY_WALK_H
#define BATTEN_RAY_WALK_H

#include "ray_single.h"
#include "ray_tree.h"

typedef int32_t i8 __attribute__((vector_size(32)));

/* Along a ray, in scene units: what rounding of slopes and products may come to. What it comes to
 * across the ray the boxes have for themselves. */
#define WALK_SLACK 2e-6f

INLINE v8 smaller8(v8 a, v8 b)
{
#if defined __AVX__
	return (v8)_mm256_min_ps((__m256)a, (__m256)b);
#else
	i8 m = a < b;

	return (v8)((m & (i8)a) | (~m & (i8)b));
#endif
}

INLINE v8 larger8(v8 a, v8 b)
{
#if defined __AVX__
	return (v8)_mm256_max_ps((__m256)a, (__m256)b);
#else
	i8 m = a > b;

	return (v8)((m & (i8)a) | (~m & (i8)b));
#endif
}

/* Bit k: a[k] <= b[k]. */
INLINE unsigned less8(v8 a, v8 b)
{
#if defined __AVX__
	return (unsigned)_mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LE_OQ));
#else
	i8 m = a <= b;
	unsigned bits = 0;

	for (int k = 0; k < TREE_WIDE; k++)
		bits |= (unsigned)m[k] & 1u << k;
	return bits;
#endif
}

INLINE v8 side_of(const struct ray_node *n, int side)
{
	v8 x;

	memcpy(&x, n->side[side], sizeof x);
	return x;
}

/* What is still before a walk. */
struct walk_step {
	float near;
	uint32_t child; /* as in struct ray_node */
	uint32_t place; /* of the child: node * TREE_WIDE + which */
};

struct walk {
	const struct ray_node *nodes;
	struct walk_step *step; /* the next */
	struct walk_step steps[TREE_STACK];
};

INLINE void walk_init(struct walk *w, const struct ray_scene *s)
{
	w->nodes = s->tree.nodes;
	w->step = w->steps;
}

/* The children `met` of a node are next, the nearest first of all. */
INLINE void walk_push(struct walk *w, uint32_t number, unsigned met, const float *near)
{
	const struct ray_node *n = &w->nodes[number];
	struct walk_step *first = w->step;

	for (; met; met &= met - 1) {
		int k = __builtin_ctz(met);
		struct walk_step *at = w->step++;

		for (; at > first && at[-1].near < near[k]; at--)
			*at = at[-1];
		*at = (struct walk_step){ near[k], n->child[k], number * TREE_WIDE + (uint32_t)k };
	}
}

/* One or two children are met, as most often: the next one comes back. rest: met but for the first. */
INLINE uint32_t walk_two(struct walk *w, const struct ray_node *n, unsigned met, unsigned rest,
                         const float *near)
{
	int a = __builtin_ctz(met);
	if (!rest)
		return n->child[a];

	int b = __builtin_ctz(rest);
	bool swap = near[b] < near[a];

	*w->step++ = (struct walk_step){ swap ? near[a] : near[b], n->child[swap ? a : b], 0 };
	return n->child[swap ? b : a];
}

/* Slopes that are not divided by zero. */
INLINE float slope_inverse(float d)
{
	return 1 / (fabsf(d) > 1e-18f ? d : 1e-18f);
}

/* ---- one ray ---- */

/* A ray as boxes are tested against it: distance to a side x is x * inverse - start. */
struct walk_ray {
	float inverse[3], start[3], from;
	int low[3], high[3]; /* sides where a ray comes in, where it goes out */
};

INLINE void walk_ray_init(struct walk_ray *r, const struct single *q)
{
	for (int e = 0; e < 3; e++) {
		r->inverse[e] = slope_inverse(q->d[e]);
		r->start[e] = (float)q->o[e] * r->inverse[e];
		r->low[e] = q->d[e] < 0 ? 3 + e : e;
		r->high[e] = q->d[e] < 0 ? e : 3 + e;
	}
	r->from = q->near > 0 ? q->near : 0;
}

INLINE unsigned ray_children(const struct walk_ray *r, const struct ray_node *n, float to,
                             float near[TREE_WIDE])
{
	v8 x0 = side_of(n, r->low[0]) * r->inverse[0] - r->start[0];
	v8 y0 = side_of(n, r->low[1]) * r->inverse[1] - r->start[1];
	v8 z0 = side_of(n, r->low[2]) * r->inverse[2] - r->start[2];
	v8 x1 = side_of(n, r->high[0]) * r->inverse[0] - r->start[0];
	v8 y1 = side_of(n, r->high[1]) * r->inverse[1] - r->start[1];
	v8 z1 = side_of(n, r->high[2]) * r->inverse[2] - r->start[2];
	v8 begin = larger8(larger8(x0, y0), larger8(z0, r->from - (v8){ 0 }));
	v8 end = smaller8(smaller8(x1, y1), smaller8(z1, to - (v8){ 0 }));

	memcpy(near, &begin, sizeof begin);
	return less8(begin, end + WALK_SLACK);
}

/* Is there a hit? Any one where the nearest is not wanted. */
static bool single_walk(struct single *q)
{
	struct walk_ray r;
	struct walk w;
	uint32_t child = 0;
	bool hit = false;

	walk_ray_init(&r, q);
	walk_init(&w, q->call.scene);
	for (;;) {
		if (child & TREE_LEAF) {
			hit |= single_trace(q, child & ~TREE_LEAF);
			if (hit && !q->call.nearest)
				return true;
		} else {
			const struct ray_node *n = &w.nodes[child];
			float near[TREE_WIDE];
			unsigned met = ray_children(&r, n, q->far, near);

			unsigned rest = met & (met - 1);

			if (met && !(rest & (rest - 1))) {
				child = walk_two(&w, n, met, rest, near);
				continue;
			}
			walk_push(&w, child, met, near);
		}
		do {
			if (w.step == w.steps)
				return hit;
		} while (!((--w.step)->near <= q->far));
		child = w.step->child;
	}
}

/* ---- packets ---- */

struct walk_rays {
	vf o[3], inverse[3], from;
};

/* All rays of a packet: turned so that they go up along each axis. */
struct bundle {
	float lo[3], hi[3];      /* of origins */
	float least[3], most[3]; /* of inverse slopes */
	float sign[3], from;
	int low[3], high[3];
};

/* Those of the lanes `act` that meet a child's box. */
INLINE vi lanes_meet(const struct packet *p, const struct walk_rays *r, const struct ray_node *n,
                     int k, vi act, vf *near)
{
	vf begin = r->from, end = p->far;

	for (int e = 0; e < 3; e++) {
		vf a = (n->side[e][k] - r->o[e]) * r->inverse[e];
		vf b = (n->side[3 + e][k] - r->o[e]) * r->inverse[e];

		begin = larger(begin, smaller(a, b));
		end = smaller(end, larger(a, b));
	}
	*near = begin;
	return act & (begin <= end + WALK_SLACK);
}

INLINE unsigned lanes_children(const struct packet *p, const struct walk_rays *r,
                               const struct ray_node *n, vi act, float near[TREE_WIDE])
{
	unsigned met = 0;

	for (int k = 0; k < TREE_WIDE && n->side[0][k] <= n->side[3][k]; k++) {
		vf begin;
		vi m = lanes_meet(p, r, n, k, act, &begin);

		if (!any(m))
			continue;
		met |= 1u << k;
		near[k] = begin[first_lane(m)];
	}
	return met;
}

INLINE unsigned bundle_children(const struct bundle *b, const struct ray_node *n, float to,
                                float near[TREE_WIDE])
{
	v8 begin = b->from - (v8){ 0 }, end = to - (v8){ 0 };

	for (int e = 0; e < 3; e++) {
		v8 x = side_of(n, b->low[e]) * b->sign[e] - b->hi[e];
		v8 y = side_of(n, b->high[e]) * b->sign[e] - b->lo[e];

		begin = larger8(begin, smaller8(x * b->least[e], x * b->most[e]));
		end = smaller8(end, larger8(y * b->least[e], y * b->most[e]));
	}
	memcpy(near, &begin, sizeof begin);
	return less8(begin, end + WALK_SLACK);
}

/* False where the rays of `act` do not all go the same way along each axis. */
static bool bundle_init(struct bundle *b, const struct walk_rays *r, vi act)
{
	b->from = INFINITY;
	for (int e = 0; e < 3; e++) {
		vi down = act & (r->inverse[e] < 0);
		bool turned = any(down);

		if (turned && any(act & ~down))
			return false;
		b->sign[e] = turned ? -1 : 1;
		b->low[e] = turned ? 3 + e : e;
		b->high[e] = turned ? e : 3 + e;
		b->lo[e] = b->least[e] = INFINITY;
		b->hi[e] = b->most[e] = -INFINITY;
		vf o = r->o[e] * b->sign[e], slope = r->inverse[e] * b->sign[e];
		vi m = act;
		b->lo[e] = lanes_least(m, o);
		b->hi[e] = -lanes_least(m, -o);
		b->least[e] = lanes_least(m, slope);
		b->most[e] = -lanes_least(m, -slope);
	}
	b->from = lanes_least(act, r->from);
	return true;
}

/* The lanes of `act` that have a hit; their results are in the packet where the nearest is wanted. */
static vi packet_walk(struct packet *p, const vf o[3], vi act, bool coherent)
{
	struct walk_rays r;
	struct bundle b;
	struct walk w;
	vi hits = act & ~act;

	if (!any(act))
		return hits;
	r.from = pick(p->near > 0, p->near, fill(0));
	for (int e = 0; e < 3; e++) {
		r.o[e] = o[e];
		r.inverse[e] = 1 / pick(size(p->d[e]) > 1e-18f, p->d[e], fill(1e-18f));
	}
	bool one = coherent && bundle_init(&b, &r, act);
	float to = -lanes_least(act, -p->far);

	walk_init(&w, p->call.scene);
	*w.step++ = (struct walk_step){ -INFINITY, 0, 0 };
	while (w.step > w.steps) {
		struct walk_step step = *--w.step;

		if (one && !(step.near <= to))
			continue;
		if (!(step.child & TREE_LEAF)) {
			const struct ray_node *n = &w.nodes[step.child];
			float near[TREE_WIDE];
			unsigned met = one ? bundle_children(&b, n, to, near)
			                   : lanes_children(p, &r, n, act, near);

			walk_push(&w, step.child, met, near);
			continue;
		}
		vf near;
		vi m = lanes_meet(p, &r, &w.nodes[step.place / TREE_WIDE],
		                  (int)(step.place % TREE_WIDE), act, &near);
		if (!any(m))
			continue;
		vi found = leaf_trace(p, step.child & ~TREE_LEAF, m);
		if (!any(found))
			continue;
		hits |= found;
		if (!p->call.nearest) {
			act &= ~found;
			if (!any(act))
				break;
		} else {
			to = -lanes_least(act, -p->far);
		}
	}
	return hits;
}

#endif
