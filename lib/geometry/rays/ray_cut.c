/* ray_cut.c - all surfaces of a scene into patches, scaled to the scene, and leaves. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ray_leaf.h"
#include "refine.h"

static enum status nothing_left(const struct report *r)
{
	return report_error(r, ST_INPUT,
	                    "nothing to see: the surfaces are trimmed away wholly; give others, or "
	                    "do not trim them");
}

static enum status nets_box(const struct bezier_net *nets, int n, struct ray_cut *c,
                            const struct report *r)
{
	c->box = box_empty();
	for (int i = 0; i < n; i++) {
		const struct bezier_net *b = &nets[i];
		size_t points = (size_t)b->order[0] * b->order[1] * b->spans[0] * b->spans[1];

		for (size_t k = 0; k < points; k++) {
			const double *p = b->points + 4 * k;

			box_add_point(&c->box, vec3(p[0] / p[3], p[1] / p[3], p[2] / p[3]));
		}
	}
	if (box_is_empty(&c->box))
		return nothing_left(r);
	c->center = box_center(&c->box);
	c->scale = box_diagonal(&c->box) / 2;
	if (!(c->scale > 1e-9 * vec3_length(c->center)) || !(c->scale > 0) || !isfinite(c->scale))
		return report_error(
		        r, ST_INPUT,
		        "nothing to see: the surfaces are a point; give surfaces that have "
		        "an extent");
	return ST_OK;
}

/* Patches of one net; its points, moved and scaled to the scene, are kept. */
static enum status cut_add_net(struct ray_cut *c, int surface, const struct bezier_net *b)
{
	size_t n = (size_t)b->spans[0] * b->spans[1], size = bezier_patch_size(b);
	if (n == 0)
		return ST_OK;
	double *points = malloc(sizeof(double) * n * size);
	if (!points)
		return ST_RESOURCE;

	c->points[surface] = points;
	c->bytes += sizeof(double) * n * size;
	for (size_t k = 0; k < n * size; k += 4) {
		const double *p = b->points + k;

		points[k] = (p[0] - c->center.x * p[3]) / c->scale;
		points[k + 1] = (p[1] - c->center.y * p[3]) / c->scale;
		points[k + 2] = (p[2] - c->center.z * p[3]) / c->scale;
		points[k + 3] = p[3];
	}
	for (int i = 0; i < b->spans[0]; i++)
		for (int j = 0; j < b->spans[1]; j++)
			c->patches[c->n_patches++] = (struct ray_patch){
				.points = points + size * ((size_t)i * b->spans[1] + j),
				.order = { b->order[0], b->order[1] },
				.surface = surface,
				.rational = b->rational,
				.u = { b->breaks[0][i], b->breaks[0][i + 1] },
				.v = { b->breaks[1][j], b->breaks[1][j + 1] },
			};
	return ST_OK;
}

static enum status cut_nets(struct ray_cut *c, const struct bezier_net *nets, int n,
                            const struct report *r)
{
	size_t patches = 0;

	enum status st = nets_box(nets, n, c, r);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < n; i++)
		patches += (size_t)nets[i].spans[0] * nets[i].spans[1];
	c->points = calloc(n, sizeof *c->points);
	c->patches = calloc(patches, sizeof *c->patches);
	if (!c->points || !c->patches || patches > UINT32_MAX)
		return ST_RESOURCE;
	c->bytes += patches * sizeof *c->patches;
	for (int i = 0; i < n; i++) {
		st = cut_add_net(c, i, &nets[i]);
		if (st != ST_OK)
			return st;
	}
	for (size_t k = 0; k < c->n_patches; k++) {
		st = ray_cut_patch(c, (uint32_t)k);
		if (st != ST_OK)
			return st;
	}
	if (c->n_leaves == 0)
		return nothing_left(r);
	return ST_OK;
}

/* Give back what growing took too much. */
static void cut_settle(struct ray_cut *c)
{
	struct ray_leaf *leaves = aligned_alloc(64, c->n_leaves * sizeof *leaves);

	if (leaves) {
		memcpy(leaves, c->leaves, c->n_leaves * sizeof *leaves);
		free(c->leaves);
		c->leaves = leaves;
		c->capacity = c->n_leaves;
	}
	c->bytes += c->capacity * sizeof *c->leaves;
}

/* The part of a surface that holds what its trim leaves; order 0 where nothing is left. */
static enum status part_left(const struct ray_cut *c, const struct surface *s, int i,
                             struct surface *out)
{
	double range[2][2];

	*out = (struct surface){ .points = NULL };
	if (!trim_test_range(c->trims[i], range))
		return ST_OK;
	return surface_part(out, s, (const double(*)[2])range);
}

/* The net of a surface, or of that part of it; none: spans 0. */
static enum status net_of(const struct ray_cut *c, const struct surface *s, int i,
                          struct bezier_net *out)
{
	struct surface part;

	if (!c->trims[i])
		return bezier_net_init(out, s);
	enum status st = part_left(c, s, i, &part);
	if (st == ST_OK && part.points)
		st = bezier_net_init(out, &part);
	surface_finish(&part);
	return st;
}

/* Box of a surface's leaves, which stand together: from *k on. */
static struct box leaves_box(const struct ray_cut *c, int surface, size_t *k)
{
	struct box out = box_empty();

	for (; *k < c->n_leaves; (*k)++) {
		const struct ray_bounds *b = &c->bounds[*k];

		if (c->patches[c->leaves[*k].patch].surface != surface)
			break;
		struct vec3 lo = vec3((double)b->lo[0], (double)b->lo[1], (double)b->lo[2]);
		struct vec3 hi = vec3((double)b->hi[0], (double)b->hi[1], (double)b->hi[2]);
		box_add_point(&out, vec3_along(c->center, c->scale, lo));
		box_add_point(&out, vec3_along(c->center, c->scale, hi));
	}
	return out;
}

/* What the box of the part that is left and that of its leaves have in common. */
static enum status box_left(const struct ray_cut *c, const struct surface *s, int i,
                            const struct box *leaves, struct box *out)
{
	struct surface part;

	*out = box_empty();
	if (box_is_empty(leaves))
		return ST_OK;
	enum status st = part_left(c, s, i, &part);
	if (st == ST_OK)
		st = surface_box(&part, 1e-4 * c->scale, out);
	surface_finish(&part);
	out->lo = vec3(fmax(out->lo.x, leaves->lo.x), fmax(out->lo.y, leaves->lo.y),
	               fmax(out->lo.z, leaves->lo.z));
	out->hi = vec3(fmin(out->hi.x, leaves->hi.x), fmin(out->hi.y, leaves->hi.y),
	               fmin(out->hi.z, leaves->hi.z));
	return st;
}

/* The surfaces' own box, nearly tight: cameras are fitted to it. */
static enum status cut_box(struct ray_cut *c, const struct surface *const *surfaces, int n)
{
	size_t k = 0;

	c->box = box_empty();
	for (int i = 0; i < n; i++) {
		struct box b, leaves = leaves_box(c, i, &k);
		enum status st = c->trims[i] ? box_left(c, surfaces[i], i, &leaves, &b)
		                             : surface_box(surfaces[i], 1e-4 * c->scale, &b);

		if (st != ST_OK)
			return st;
		box_add_box(&c->box, &b);
	}
	return ST_OK;
}

enum status ray_cut_init(struct ray_cut *c, const struct surface *const *surfaces,
                         const struct trim *const *trims, int n, size_t memory,
                         const struct report *r)
{
	memset(c, 0, sizeof *c);
	c->memory = memory;
	if (n < 1)
		return report_error(r, ST_INPUT, "nothing to see: no surface; give one or more");

	struct bezier_net *nets = calloc(n, sizeof *nets);
	c->trims = calloc(n, sizeof(struct trim_test *));
	enum status st = nets && c->trims ? ST_OK : ST_RESOURCE;
	if (c->trims)
		c->n_surfaces = n;
	for (int i = 0; st == ST_OK && i < n; i++) {
		if (trims && trims[i] && trims[i]->n)
			st = trim_test_create(&c->trims[i], trims[i], surfaces[i]);
		if (st == ST_OK)
			st = net_of(c, surfaces[i], i, &nets[i]);
	}
	if (st == ST_OK)
		st = cut_nets(c, nets, n, r);
	if (st == ST_OK)
		st = cut_box(c, surfaces, n);
	for (int i = 0; nets && i < n; i++)
		bezier_net_finish(&nets[i]);
	free(nets);
	if (st == ST_OK) {
		cut_settle(c);
	} else {
		ray_cut_finish(c);
		if (st == ST_RESOURCE)
			report_error(
			        r, st,
			        "cannot prepare %d surfaces for rays: they take more memory than "
			        "there is or is allowed; allow more or take fewer surfaces",
			        n);
	}
	return st;
}

void ray_cut_finish(struct ray_cut *c)
{
	for (int i = 0; i < c->n_surfaces; i++) {
		if (c->points)
			free(c->points[i]);
		trim_test_destroy(c->trims[i]);
	}
	free(c->points);
	free(c->trims);
	free(c->patches);
	free(c->leaves);
	free(c->bounds);
	memset(c, 0, sizeof *c);
}
