/* level.c - a surface made ready for tracing one field, and its life. */
#include "level_private.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "level_isophote.h"
#include "level_root.h"

/* Spans narrower than this part of the domain are not meant. */
static const double narrow_share = 1e-9;

/* Where a span is narrower, points are made with more digits. */
#define SLENDER_SHARE 1e-3

const struct level_shape level_shapes[N_LEVEL_KINDS] = {
	[LEVEL_PLANE] = { { 0, 0 }, { 1, 1 }, .line = true, .valued = true },
	[LEVEL_ISOPHOTE] = { { 1, 2 }, { 0, 0 }, .line = true, .valued = true, .side = true },
	[LEVEL_SILHOUETTE] = { { 1, 1 }, { 0, 0 }, .line = true },
	[LEVEL_CYLINDER] = { { 0, 0 }, { 2, 2 }, .line = true, .valued = true, .several = true },
	[LEVEL_EYE] = { { 1, 1 }, { 1, 1 }, .several = true },
	[LEVEL_HIGHLIGHT] = { { 1, 2 },
	                      { 1, 2 },
	                      .line = true,
	                      .valued = true,
	                      .side = true,
	                      .several = true },
	[LEVEL_REFLECTION] = { { 2, 2 }, { 2, 2 }, .line = true, .several = true },
	[LEVEL_CURVATURE] = { { 4, 4 }, { 0, 0 }, .valued = true, .several = true },
};

/* Above this degree rounding leaves so little of f that lines of curvature come to no end. */
enum { CURVATURE_DEGREE_MAX = 152 };

/* Right-handed rows of unit vectors, the last along d. */
static void frame_make(struct vec3 d, double frame[3][3])
{
	struct vec3 z = vec3_unit(d);
	struct vec3 a = fabs(z.x) <= fabs(z.y) && fabs(z.x) <= fabs(z.z) ? vec3(1, 0, 0)
	                : fabs(z.y) <= fabs(z.z)                         ? vec3(0, 1, 0)
	                                                                 : vec3(0, 0, 1);
	struct vec3 x = vec3_unit(vec3_cross(a, z)), y = vec3_cross(z, x);
	struct vec3 rows[3] = { x, y, z };
	for (int i = 0; i < 3; i++) {
		frame[i][0] = rows[i].x;
		frame[i][1] = rows[i].y;
		frame[i][2] = rows[i].z;
	}
}

static void surface_destroy(struct level_surface *s)
{
	if (!s)
		return;
	bezier_net_finish(&s->net);
	free(s->normals);
	free(s->edges[0]);
	free(s->edges[1]);
	free(s->bent[0]);
	free(s->bent[1]);
	free(s->normal_error);
	free(s->factors);
	free(s->root);
	free(s->shapes);
	free(s->binomial);
	free(s->heights);
	free(s->height_range);
	free(s);
}

/*
 * Take out spans so narrow that their patches are rounding (a domain that misses its knot by 1e-15).
 * What is left is moved together; breaks keep the ends of the domain.
 */
static void net_clean(struct bezier_net *net)
{
	int kept[2] = { 0, 0 }, spans[2] = { net->spans[0], net->spans[1] };
	size_t size = bezier_patch_size(net), at = 0;
	double width[2], end[2];
	for (int d = 0; d < 2; d++) {
		end[d] = net->breaks[d][spans[d]];
		width[d] = narrow_share * (end[d] - net->breaks[d][0]);
	}
	for (int i = 0; i < spans[0]; i++) {
		if (net->breaks[0][i + 1] - net->breaks[0][i] <= width[0])
			continue;
		for (int j = 0; j < spans[1]; j++)
			if (net->breaks[1][j + 1] - net->breaks[1][j] > width[1])
				memmove(net->points + size * at++,
				        net->points + size * ((size_t)i * spans[1] + j),
				        size * sizeof(double));
	}
	for (int d = 0; d < 2; d++) {
		double *b = net->breaks[d];
		for (int i = 0; i < spans[d]; i++)
			if (b[i + 1] - b[i] > width[d]) {
				double from = kept[d] > 0 ? b[i] : b[0];
				b[kept[d]++] = from;
			}
		b[kept[d]] = end[d];
		net->spans[d] = kept[d];
	}
}

/* Spans so narrow that rounding of the points matters to the differences between them. */
static bool slender(const struct bezier_net *net)
{
	for (int d = 0; d < 2; d++) {
		const double *b = net->breaks[d], all = b[net->spans[d]] - b[0];
		for (int i = 0; i < net->spans[d]; i++)
			if (b[i + 1] - b[i] < SLENDER_SHARE * all)
				return true;
	}
	return false;
}

/*
 * Bezier points are means of the control points, taken in each direction by a matrix: its numbers are
 * products of order - 1 ratios of knots, all positive, and so right to that many roundings each.
 */
static double mean_steps(const int order[2])
{
	return 8.0 * (order[0] + order[1]) * UNIT_ROUNDOFF;
}

static enum status net_create(struct level_surface *s, const struct surface *from)
{
	enum status st = bezier_net_init(&s->net, from);
	if (st != ST_OK)
		return st;
	net_clean(&s->net);
	s->steps = mean_steps(s->net.order);
	if (LDBL_MANT_DIG < 64 || !slender(&s->net))
		return ST_OK;
	bezier_net_finish(&s->net);
	st = bezier_net_init_exact(&s->net, from);
	if (st == ST_OK)
		net_clean(&s->net);
	s->steps = 2 * UNIT_ROUNDOFF;
	return st;
}

static void reach_find(struct level_surface *s, const struct surface *from)
{
	for (int i = 0; i < from->n[0]; i++)
		for (int j = 0; j < from->n[1]; j++) {
			double w;
			struct vec3 p = surface_get_point(from, i, j, &w);
			s->reach = larger(s->reach, w * vec3_length(p));
			s->far = larger(s->far, vec3_length(p));
			s->extent[0] = larger(s->extent[0], w * fabs(p.x));
			s->extent[1] = larger(s->extent[1], w * fabs(p.y));
			s->extent[2] = larger(s->extent[2], w * fabs(p.z));
			s->weight = larger(s->weight, w);
		}
	const double steps = s->steps;
	s->of_points = (struct bound){ s->reach * (1 + steps), s->reach * steps };
	s->of_weights =
	        (struct bound){ s->weight * (1 + steps), s->net.rational ? s->weight * steps : 0 };
}

void level_patch_bounds(const struct level_surface *s, const double *points,
                        struct bound *of_points, struct bound *of_weights)
{
	double heavy = 1;
	if (s->net.rational) {
		heavy = points[3];
		for (size_t i = 1; i < bezier_patch_size(&s->net) / 4; i++)
			heavy = larger(heavy, points[4 * i + 3]);
	}
	*of_weights =
	        (struct bound){ heavy * (1 + s->steps), s->net.rational ? heavy * s->steps : 0 };
	*of_points = (struct bound){ smaller(s->far * heavy, s->reach) * (1 + s->steps),
		                     smaller(s->far * heavy, s->reach) * s->steps };
}

static double *binomial_make(int n)
{
	double *b = malloc(sizeof *b * (n + 1) * (n + 2) / 2);
	for (int i = 0; b && i <= n; i++) {
		double *row = b + i * (i + 1) / 2;
		row[0] = row[i] = 1;
		for (int j = 1; j < i; j++)
			row[j] = row[j - i] + row[j - i - 1];
	}
	return b;
}

static enum status shapes_make(struct level_surface *s)
{
	const struct bezier_net *net = &s->net;
	size_t n = (size_t)net->spans[0] * net->spans[1], size = bezier_patch_size(net);
	s->shapes = malloc(sizeof *s->shapes * (n + 1));
	if (!s->shapes)
		return ST_RESOURCE;
	for (size_t i = 0; i < n; i++)
		level_shape_of_patch(net->points + size * i, net->order[0] - 1, net->order[1] - 1,
		                     &s->shapes[i]);
	return ST_OK;
}

static int larger_order(const struct level_surface *s)
{
	return s->net.order[0] > s->net.order[1] ? s->net.order[0] : s->net.order[1];
}

/* Second derivatives need degree 2. */
static enum status curvature_prepare(struct level_surface *s, enum quantity quantity)
{
	enum status st = ST_OK;
	s->quantity = quantity;
	for (int d = 0; st == ST_OK && d < 2; d++)
		if (s->net.order[d] == 2)
			st = level_net_raise(&s->net, d);
	s->root = quantity == QUANTITY_GAUSSIAN ? NULL : malloc(sizeof *s->root);
	return st != ST_OK || s->root || quantity == QUANTITY_GAUSSIAN ? st : ST_RESOURCE;
}

/* Degrees, binomials, normals; for the length of the normal patches are halved. */
static enum status forms_prepare(struct level_surface *s, double tolerance)
{
	int factors = s->net.rational ? 3 : 2, highest = 0;
	for (int d = 0; d < 2; d++) {
		s->degree[d] = factors * (s->net.order[d] - 1) - 1;
		highest = highest > s->degree[d] ? highest : s->degree[d];
	}
	int most = 2 * (highest + larger_order(s));
	if (s->root || s->kind == LEVEL_CURVATURE)
		most = 4 * highest + 2 * ROOT_DEGREE;
	s->binomial = binomial_make(most);
	if (!s->binomial)
		return ST_RESOURCE;
	if (!level_needs_normals(s->kind))
		return ST_OK;
	enum status st = level_normals(s);
	if (st != ST_OK || !s->root)
		return st;
	level_root_tables(s->root, s->kind == LEVEL_ISOPHOTE ? ROOT_DEGREE_LOW : ROOT_DEGREE,
	                  s->degree, s->binomial);
	/* relative to the size of a patch, as a rule, and what rounding allows */
	double share = 1e-4 * tolerance / (s->net.size + 1e-300);
	if (s->kind == LEVEL_ISOPHOTE)
		share = smaller(larger(share / LEVEL_OBLIQUE, 1e-9), 1e-8);
	else
		share = smaller(larger(share, 1e-13), 1e-11);
	return level_root_refine(s, share);
}

static enum status edges_create(struct level_surface *s)
{
	for (int d = 0; d < 2; d++) {
		int lines[2] = { s->net.spans[0] + (d == 0), s->net.spans[1] + (d == 1) };
		s->edges[d] = calloc((size_t)lines[0] * lines[1], 1);
		s->bent[d] = calloc((size_t)lines[0] * lines[1], 1);
		if (!s->edges[d] || !s->bent[d])
			return ST_RESOURCE;
	}
	return ST_OK;
}

static enum status surface_create(struct level_surface **out, const struct surface *from,
                                  const struct level_field *field, double tolerance)
{
	struct level_surface *s = calloc(1, sizeof *s);
	if (!s)
		return ST_RESOURCE;
	enum status st = net_create(s, from);
	if (st != ST_OK)
		goto fail;
	reach_find(s, from);
	s->kind = field->kind;
	if (level_oblique(field)) {
		s->root = malloc(sizeof *s->root);
		if (!s->root) {
			st = ST_RESOURCE;
			goto fail;
		}
	}
	frame_make(level_shapes[s->kind].line ? field->direction : vec3(0, 0, 1), s->frame);
	for (int d = 0; d < 3; d++) {
		struct vec3 row = vec3_of(s->frame[d]);
		s->point[d] = vec3_dot(row, field->point);
		s->eye[d] = vec3_dot(row, field->eye);
		s->gap[d] = vec3_dot(row, vec3_sub(field->point, field->eye));
	}
	const int spans = s->net.spans[0] * s->net.spans[1];
	st = level_net_even(&s->net);
	if (s->kind == LEVEL_CURVATURE || s->net.spans[0] * s->net.spans[1] > spans)
		s->steps += mean_steps(s->net.order); /* halving adds roundings */
	if (st == ST_OK && s->kind == LEVEL_CURVATURE)
		st = curvature_prepare(s, field->quantity);
	if (st == ST_OK)
		st = forms_prepare(s, tolerance);
	if (st == ST_OK && s->kind == LEVEL_PLANE)
		st = level_plane_prepare(s);
	if (st == ST_OK)
		st = edges_create(s);
	if (st == ST_OK)
		st = shapes_make(s);
	if (st == ST_OK)
		st = level_edges(s);
	if (st != ST_OK)
		goto fail;
	level_proof_tables(&s->proof);
	*out = s;
	return ST_OK;
fail:
	surface_destroy(s);
	return st;
}

/* Value, tolerance and what follows from them. */
static enum status level_set(struct level *l, const struct level_field *field, double tolerance,
                             const struct report *r)
{
	const struct level_surface *s = l->surface;
	const struct level_shape *shape = &level_shapes[field->kind];
	bool angle = field->kind == LEVEL_ISOPHOTE, radius = field->kind == LEVEL_CYLINDER;
	if (!isfinite(field->value) || (angle && fabs(field->value) > 1) ||
	    (radius && !(field->value > 0)))
		return report_error(r, ST_PARAMETER, "level %g, expected %s", field->value,
		                    angle    ? "a cosine from -1 to 1"
		                    : radius ? "a radius greater than 0"
		                             : "a finite number");
	l->tolerance = tolerance;
	l->tolerance_uv = INFINITY;
	l->value = shape->valued ? field->value : 0;
	if (angle && fabs(l->value) <= LEVEL_COSINE_ZERO)
		l->value = 0;
	l->oblique = s->root && level_oblique(field);
	l->side = shape->side && l->value != 0;
	l->sine = sqrt(larger(0, (1 - l->value) * (1 + l->value)));
	for (int d = 0; d < 3; d++)
		l->direction[d] = s->frame[2][d];
	l->direction[3] = shape->line ? -l->value / vec3_length(field->direction) : 0;
	for (int d = 0; d < 2; d++) {
		l->degree[d] = shape->normal[l->value != 0] * s->degree[d] +
		               shape->point[l->value != 0] * (s->net.order[d] - 1);
		l->side_degree[d] = l->degree[d] / 2;
		if (l->oblique && l->degree[d] < s->root->degree)
			l->degree[d] = s->root->degree;
	}
	if (field->kind == LEVEL_PLANE)
		level_plane_bound(l);
	if (field->kind == LEVEL_CURVATURE) {
		level_curvature_degree(l);
		const int degree = l->degree[0] > l->degree[1] ? l->degree[0] : l->degree[1];
		if (degree > CURVATURE_DEGREE_MAX)
			return report_error(
			        r, ST_PARAMETER,
			        "orders %d and %d of a surface give these lines of curvature an "
			        "equation of degree %d, expected %d at most; lower the degree",
			        s->net.order[0], s->net.order[1], degree, CURVATURE_DEGREE_MAX);
		l->side = s->quantity == QUANTITY_KMAX || s->quantity == QUANTITY_KMIN;
	}
	return ST_OK;
}

static enum status level_new(struct level **out, struct level_surface *s, bool owner,
                             const struct level_field *field, double tolerance,
                             const struct report *r)
{
	struct level *l = calloc(1, sizeof *l);
	if (!l)
		return report_error(r, ST_RESOURCE, "no memory to trace curves on a surface");
	l->surface = s;
	enum status st = level_set(l, field, tolerance, r);
	if (st != ST_OK) {
		free(l);
		return st;
	}
	l->owner = owner;
	*out = l;
	return ST_OK;
}

enum status level_create(struct level **out, const struct surface *s,
                         const struct level_field *field, double tolerance, const struct report *r)
{
	struct level_surface *made = NULL;
	double length = vec3_length(field->direction);
	if (!isfinite(vec3_length(field->point)) || !isfinite(vec3_length(field->eye)))
		return report_error(r, ST_PARAMETER, "a point of the field is not finite");
	if (level_shapes[field->kind].line && (!(length > 0) || !isfinite(length)))
		return report_error(r, ST_PARAMETER,
		                    "direction %g,%g,%g, expected one of finite length above 0",
		                    field->direction.x, field->direction.y, field->direction.z);
	if (!(tolerance > 0) || !isfinite(tolerance))
		return report_error(r, ST_PARAMETER,
		                    "tolerance %g, expected a length greater than 0", tolerance);
	if (field->kind == LEVEL_CURVATURE &&
	    (field->quantity == QUANTITY_ABSOLUTE || field->quantity >= N_QUANTITIES))
		return report_error(
		        r, ST_PARAMETER,
		        "lines of constant absolute curvature are not traced; take kmax "
		        "or kmin");
	enum status st = surface_create(&made, s, field, tolerance);
	if (st != ST_OK)
		return report_error(r, st, "no memory for the Bezier patches of a surface");
	st = level_new(out, made, true, field, tolerance, r);
	if (st != ST_OK)
		surface_destroy(made);
	return st;
}

enum status level_create_like(struct level **out, const struct level *first, double value,
                              const struct report *r)
{
	const double *d = first->direction;
	struct level_field field = { .kind = first->surface->kind,
		                     .quantity = first->surface->quantity,
		                     .direction = vec3(d[0], d[1], d[2]),
		                     .value = value };
	enum status st = level_new(out, first->surface, false, &field, first->tolerance, r);
	if (st == ST_OK)
		(*out)->tolerance_uv = first->tolerance_uv;
	return st;
}

enum status level_set_tolerance_uv(struct level *l, double tolerance, const struct report *r)
{
	if (!(tolerance > 0))
		return report_error(r, ST_PARAMETER,
		                    "tolerance %g in u,v, expected a number greater than 0",
		                    tolerance);
	l->tolerance_uv = tolerance;
	return ST_OK;
}

void level_destroy(struct level *l)
{
	if (!l)
		return;
	if (l->owner)
		surface_destroy(l->surface);
	free(l);
}

size_t level_patches(const struct level *l)
{
	return (size_t)l->surface->net.spans[0] * l->surface->net.spans[1];
}
