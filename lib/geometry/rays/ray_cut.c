/* ray_cut.c - all surfaces of a scene into patches, scaled to the scene, and leaves. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ray_leaf.h"

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
	c->n_surfaces = n;
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

/* The surfaces' own box, nearly tight: cameras are fitted to it. */
static enum status cut_box(struct ray_cut *c, const struct surface *const *surfaces, int n)
{
	c->box = box_empty();
	for (int i = 0; i < n; i++) {
		struct box b;
		enum status st = surface_box(surfaces[i], 1e-4 * c->scale, &b);

		if (st != ST_OK)
			return st;
		box_add_box(&c->box, &b);
	}
	return ST_OK;
}

enum status ray_cut_init(struct ray_cut *c, const struct surface *const *surfaces, int n,
                         size_t memory, const struct report *r)
{
	memset(c, 0, sizeof *c);
	c->memory = memory;
	if (n < 1)
		return report_error(r, ST_INPUT, "nothing to see: no surface; give one or more");

	struct bezier_net *nets = calloc(n, sizeof *nets);
	enum status st = nets ? ST_OK : ST_RESOURCE;
	for (int i = 0; st == ST_OK && i < n; i++)
		st = bezier_net_init(&nets[i], surfaces[i]);
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
	for (int i = 0; i < c->n_surfaces; i++)
		free(c->points[i]);
	free(c->points);
	free(c->patches);
	free(c->leaves);
	free(c->bounds);
	memset(c, 0, sizeof *c);
}
