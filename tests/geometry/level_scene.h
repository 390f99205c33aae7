/* level_scene.h - curves on several faces, joined, in one call; a surface cut into faces. */
#ifndef BATTEN_LEVEL_SCENE_H
#define BATTEN_LEVEL_SCENE_H

#include "arbitrary.h"
#include "level_check.h"
#include "level_faces.h"

enum { FACES_MAX = 600 };

/* One of each kind and a slanting plane, all with curves on shape_wavy. */
static const struct level_field every_field[] = {
	{ .kind = LEVEL_PLANE, .direction = { 0, 0, 1 }, .value = 0.31 },
	{ .kind = LEVEL_PLANE, .direction = { 0.48, 0.6, 0.64 }, .value = 5.1 },
	{ .kind = LEVEL_CYLINDER, .direction = { 1, 0.1, 0 }, .point = { 0, 5, 0 }, .value = 0.8 },
	{ .kind = LEVEL_ISOPHOTE, .direction = { 0.1, 0.2, 1 }, .value = 0.8 },
	{ .kind = LEVEL_SILHOUETTE, .direction = { 0.8, 0.36, 0.48 } },
	{ .kind = LEVEL_EYE, .eye = { 30, 18, 14 } },
	{ .kind = LEVEL_HIGHLIGHT,
	  .direction = { 0.2, 1, 0 },
	  .point = { 4, 0, 10 },
	  .value = 0.2 },
	{ .kind = LEVEL_REFLECTION,
	  .direction = { 0, 1, 0.1 },
	  .point = { 4, 0, 20 },
	  .eye = { 30, 18, 14 } },
	{ .kind = LEVEL_CURVATURE, .quantity = QUANTITY_MEAN, .value = 0.1 },
};
enum { N_FIELDS = sizeof every_field / sizeof *every_field };

/* Faces with results of one field, joined. */
struct scene {
	struct surface faces[FACES_MAX];
	struct trim trims[FACES_MAX];
	struct level_result results[FACES_MAX];
	int n;
	struct level_chains chains;
	double length;
};

static inline void scene_finish(struct scene *x)
{
	for (int i = 0; i < x->n; i++) {
		surface_finish(&x->faces[i]);
		trim_finish(&x->trims[i]);
		level_result_finish(&x->results[i]);
	}
	level_chains_finish(&x->chains);
	x->n = 0;
}

static inline void results_finish(struct scene *x)
{
	for (int i = 0; i < x->n; i++)
		level_result_finish(&x->results[i]);
	level_chains_finish(&x->chains);
}

static inline void trace_face(const struct surface *s, const struct level_field *field,
                              double tolerance, struct level_result *out)
{
	struct level *l;
	assert_int_equal(level_create(&l, s, field, tolerance, NULL), ST_OK);
	assert_int_equal(shape_trace_level(l, out, NULL), ST_OK);
	level_destroy(l);
}

static inline void scene_trace(struct scene *x, const struct level_field *field, double tolerance,
                               double gap)
{
	struct level_face faces[FACES_MAX];
	struct level_faces *f;
	const struct level_joining how = { field, tolerance, 1e-3 };
	for (int i = 0; i < x->n; i++) {
		faces[i] = (struct level_face){ &x->faces[i], &x->trims[i] };
		trace_face(&x->faces[i], field, tolerance, &x->results[i]);
	}
	assert_int_equal(level_faces_create(&f, faces, x->n, gap), ST_OK);
	for (int i = 0; i < x->n; i++)
		assert_int_equal(level_clip(f, i, tolerance, &x->results[i]), ST_OK);
	assert_int_equal(level_chains_join(f, &how, x->results, &x->chains), ST_OK);
	level_faces_destroy(f);
	x->length = 0;
	size_t parts = 0;
	for (int i = 0; i < x->n; i++) {
		x->length += x->results[i].length;
		parts += x->results[i].n_branches;
	}
	/* every branch stands in one chain */
	size_t in_chains = 0;
	for (size_t k = 0; k < x->chains.n; k++) {
		assert_int_equal(x->chains.list[k].first, in_chains);
		in_chains += x->chains.list[k].n;
	}
	assert_int_equal(in_chains, parts);
}

/* Another form of the same face; the normal stays. */
static inline void face_change(struct surface *s, int how)
{
	struct surface r;
	if (how & 1) {
		assert_int_equal(surface_exchange(s), ST_OK);
		surface_reverse(s, 1);
	}
	if (how & 2) {
		surface_reverse(s, 0);
		surface_reverse(s, 1);
	}
	if (how & 4) {
		surface_reparametrise(s, 0, -3, 5);
		surface_reparametrise(s, 1, 100, 100.5);
	}
	if (how & 8) {
		assert_int_equal(surface_elevate(&r, s, how & 1, 1), ST_OK);
		surface_finish(s);
		*s = r;
	}
}

/* Cut into n x m faces at these places, each in a form of its own. */
static inline void scene_cut(struct scene *x, const struct surface *s, const double *u, int n,
                             const double *v, int m, bool change)
{
	x->n = 0;
	for (int i = 0; i < n; i++)
		for (int j = 0; j < m; j++, x->n++) {
			const double range[2][2] = { { u[i], u[i + 1] }, { v[j], v[j + 1] } };
			assert_int_equal(surface_part(&x->faces[x->n], s, range), ST_OK);
			if (change)
				face_change(&x->faces[x->n], (7 * i + 5 * j + i * j) % 16);
		}
}

/* Joined to as much as the whole surface has. */
static inline void same_chains(const struct scene *a, const struct scene *b)
{
	assert_int_equal(a->chains.n, b->chains.n);
	assert_int_equal(a->chains.n_closed, b->chains.n_closed);
	assert_true(fabs(a->length - b->length) < 1e-4 * (1 + a->length));
}

/* The same on one face and on many. */
static inline void compare(struct scene *one, struct scene *many, const struct level_field *f)
{
	scene_trace(one, f, 1e-5, 1e-4);
	scene_trace(many, f, 1e-5, 1e-4);
	assert_int_equal(one->chains.n, one->results[0].n_branches);
	same_chains(one, many);
	assert_int_equal(many->chains.creases, 0);
	assert_true(many->chains.joins == 0 || many->chains.step < 1e-9);
	results_finish(one);
	results_finish(many);
}

#endif
