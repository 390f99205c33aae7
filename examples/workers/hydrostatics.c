/* hydrostatics.c - a worker in one file: what a hull displaces at a draft.
 *
 * The volume under water is bounded by the hull and by the plane of the water, so by the theorem of
 * Gauss its integrals are integrals over the wetted hull alone: with N the outward normal times the
 * element of area, and z counted from the water,
 *	volume = z N_z,  moments = x z N_z, y z N_z, z^2 N_z / 2,  waterplane area = -N_z.
 */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "worker.h"

static const struct param hydrostatics_params[] = {
	{ .name = "draft",
	  .type = PARAM_REAL,
	  .def = "0",
	  .min = -INFINITY,
	  .max = INFINITY,
	  .unit = "file",
	  .help = "z of the water's surface" },
	{ .name = "density",
	  .type = PARAM_REAL,
	  .def = "1025",
	  .min = 0,
	  .max = INFINITY,
	  .help = "mass of a cubic unit of water" },
	{ .name = "half",
	  .type = PARAM_FLAG,
	  .def = "no",
	  .help = "the surfaces are one side of a ship that is the same on the other side of y = 0" },
	{ .name = "depth",
	  .type = PARAM_INTEGER,
	  .def = "6",
	  .min = 1,
	  .max = 12,
	  .help = "how often a piece that the water cuts is quartered" },
	{ .name = NULL },
};

/* The integrals. */
enum { VOLUME, MOMENT_X, MOMENT_Y, MOMENT_Z, WATERPLANE, WETTED, N_SUMS };

struct sums {
	double value[N_SUMS], error[N_SUMS];
};

/* A unit is one patch between knots of one surface. */
struct patch {
	int surface;
	double u[2], v[2];
};

struct state {
	struct patch *patches; /* owned */
	size_t n;
	double draft;
	int depth;
};

static void hydrostatics_end(struct work *w)
{
	struct state *s = w->state;
	if (s)
		free(s->patches);
	free(s);
	w->state = NULL;
}

/* The breaks of a direction's knots inside its domain, ends with them; owned by the caller. */
static double *breaks(const struct surface *s, int d, int *n)
{
	double *b = malloc(sizeof *b * ((size_t)s->n[d] + (size_t)s->order[d]));
	*n = b ? knots_breaks(s->order[d], s->n[d], s->knots[d], s->domain[d][0], s->domain[d][1],
	                      b)
	       : 0;
	return b;
}

static enum status patches_add(struct state *s, const struct surface *surface, int index)
{
	int nu, nv;
	double *u = breaks(surface, 0, &nu), *v = breaks(surface, 1, &nv);
	size_t more = nu > 1 && nv > 1 ? (size_t)(nu - 1) * (size_t)(nv - 1) : 0;
	struct patch *p = u && v ? realloc(s->patches, (s->n + more + 1) * sizeof *p) : NULL;
	if (p)
		s->patches = p;
	for (int i = 0; p && i + 1 < nu; i++)
		for (int j = 0; j + 1 < nv; j++)
			p[s->n++] = (struct patch){ .surface = index,
				                    .u = { u[i], u[i + 1] },
				                    .v = { v[j], v[j + 1] } };
	free(u);
	free(v);
	return p ? ST_OK : ST_RESOURCE;
}

static enum status hydrostatics_begin(struct work *w)
{
	struct state *s = w->state = calloc(1, sizeof *s);
	enum status st = s ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < w->n_surfaces && st == ST_OK; i++)
		st = patches_add(s, w->surfaces[i], i);
	if (st != ST_OK)
		return report_error(&w->report, st, "no memory for the patches of the hull");
	s->draft = work_real(w, "draft");
	s->depth = (int)work_integer(w, "depth");
	if (!s->n)
		return report_error(&w->report, ST_INPUT,
		                    "the surfaces have no area; choose others");
	return ST_OK;
}

static size_t hydrostatics_units(const struct work *w)
{
	const struct state *s = w->state;
	return s->n;
}

/* Four points of Gauss and Legendre on 0..1: exact to degree 7. */
static const double nodes[4] = { 0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
	                         0.93056815579702629 };
static const double weights[4] = { 0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
	                           0.17392742256872693 };

/* Add the integrals over a piece where it is wet, by 16 points, and to `most` those of all points
 * without sign. Returns how many points are wet. */
static int piece_add(const struct state *s, const struct surface *f, const struct patch *p,
                     double sums[N_SUMS], double most[N_SUMS])
{
	double du = p->u[1] - p->u[0], dv = p->v[1] - p->v[0];
	int wet = 0;
	for (int i = 0; i < 16; i++) {
		double a = weights[i / 4] * weights[i % 4] * du * dv;
		struct vec3 x, xu, xv;
		surface_tangents(f, p->u[0] + nodes[i / 4] * du, p->v[0] + nodes[i % 4] * dv, &x,
		                 &xu, &xv);
		struct vec3 n = vec3_cross(xu, xv);
		double z = x.z - s->draft;
		const double here[N_SUMS] = {
			[VOLUME] = z * n.z,         [MOMENT_X] = x.x * z * n.z,
			[MOMENT_Y] = x.y * z * n.z, [MOMENT_Z] = z * z / 2 * n.z,
			[WATERPLANE] = -n.z,        [WETTED] = vec3_length(n),
		};
		for (int k = 0; k < N_SUMS; k++) {
			sums[k] += z < 0 ? a * here[k] : 0;
			most[k] += a * fabs(here[k]);
		}
		wet += z < 0;
	}
	return wet;
}

/* Quarter a piece until the water does not cut it. The error is what the last quartering changes; of
 * a piece that is still cut, all of it. */
static void piece_sum(const struct state *s, const struct surface *f, const struct patch *p,
                      int depth, struct sums *out)
{
	double u = (p->u[0] + p->u[1]) / 2, v = (p->v[0] + p->v[1]) / 2;
	double whole[N_SUMS] = { 0 }, parts[N_SUMS] = { 0 }, most[N_SUMS] = { 0 };
	struct patch quarter[4];
	int wet = piece_add(s, f, p, whole, most);
	for (int i = 0; i < 4; i++) {
		quarter[i] = (struct patch){ .u = { i & 1 ? u : p->u[0], i & 1 ? p->u[1] : u },
			                     .v = { i & 2 ? v : p->v[0], i & 2 ? p->v[1] : v } };
		wet += piece_add(s, f, &quarter[i], parts, most);
	}
	bool cut = wet && wet < 5 * 16;
	for (int i = 0; i < 4 && cut && depth; i++)
		piece_sum(s, f, &quarter[i], depth - 1, out);
	for (int k = 0; k < N_SUMS && !(cut && depth); k++) {
		out->value[k] += parts[k];
		out->error[k] += cut ? most[k] / 2 : fabs(parts[k] - whole[k]);
	}
}

static enum status hydrostatics_unit(struct work *w, size_t unit)
{
	const struct state *s = w->state;
	const struct patch *p = &s->patches[unit];
	struct sums sums = { 0 };
	piece_sum(s, w->surfaces[p->surface], p, s->depth, &sums);
	return work_put(w, unit, &sums, sizeof sums);
}

/* Normals point as each surface was made: one whose column of water is negative is turned. */
static void surface_turn(struct sums *s)
{
	for (int k = 0; k < WETTED && s->value[VOLUME] < 0; k++)
		s->value[k] = -s->value[k];
}

static enum status sums_read(struct work *w, struct sums *all)
{
	const struct state *s = w->state;
	struct sums one = { 0 }, part;
	for (size_t unit = 0; unit < s->n; unit++) {
		const char *bytes;
		size_t n;
		enum status st = work_get(w, unit, &bytes, &n);
		if (st != ST_OK)
			return st;
		if (n != sizeof part)
			return report_error(&w->report, ST_INTERNAL, "unit %zu has %zu bytes", unit,
			                    n);
		memcpy(&part, bytes, sizeof part);
		for (int k = 0; k < N_SUMS; k++) {
			one.value[k] += part.value[k];
			all->error[k] += part.error[k];
		}
		if (unit + 1 < s->n && s->patches[unit + 1].surface == s->patches[unit].surface)
			continue;
		surface_turn(&one);
		for (int k = 0; k < N_SUMS; k++)
			all->value[k] += one.value[k];
		one = (struct sums){ 0 };
	}
	return ST_OK;
}

/* quantity,value,error: one row a figure. */
static enum status table_write(void *data, const char *path, const struct report *r)
{
	const json_t *figures = data;
	struct text t = { 0 };
	const char *name;
	json_t *value;
	text_add(&t, "quantity,value,error\n");
	json_object_foreach((json_t *)figures, name, value)
	{
		char error[64];
		snprintf(error, sizeof error, "%s_error", name);
		if (strstr(name, "_error"))
			continue;
		text_addf(&t, "%s,", name);
		text_add_number(&t, json_number_value(value));
		text_add(&t, ",");
		if (json_object_get(figures, error))
			text_add_number(&t, json_number_value(json_object_get(figures, error)));
		text_add(&t, "\n");
	}
	enum status st = t.failed ? ST_RESOURCE : file_write(path, t.s, t.n, r);
	text_finish(&t);
	return st;
}

static enum status hydrostatics_finish(struct work *w)
{
	const struct state *s = w->state;
	struct sums a = { 0 };
	enum status st = sums_read(w, &a);
	double sides = work_flag(w, "half") ? 2 : 1;
	double volume = a.value[VOLUME];
	if (st != ST_OK)
		return st;
	if (!(volume > 0))
		return report_error(&w->report, ST_PARAMETER,
		                    "nothing is under water at --draft %g; the hull lies above it",
		                    s->draft);
	json_t *figures = json_pack(
	        "{s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "volume", sides * volume,
	        "volume_error", sides * a.error[VOLUME], "displacement",
	        sides * volume * work_real(w, "density"), "center_x", a.value[MOMENT_X] / volume,
	        "center_y", sides > 1 ? 0.0 : a.value[MOMENT_Y] / volume, "center_z",
	        s->draft + a.value[MOMENT_Z] / volume, "waterplane", sides * a.value[WATERPLANE],
	        "waterplane_error", sides * a.error[WATERPLANE], "wetted", sides * a.value[WETTED],
	        "wetted_error", sides * a.error[WETTED]);
	json_incref(figures);
	st = work_figures(w, figures);
	if (st == ST_OK)
		st = work_output(w, ".hydrostatics.csv", table_write, figures);
	json_decref(figures);
	return st;
}

static const struct worker_output hydrostatics_outputs[] = {
	{ ".hydrostatics.csv", "table", NULL },
	{ .extension = NULL },
};

const struct worker worker = {
	.name = "hydrostatics",
	.title = "hydrostatics",
	.version = 1,
	.help = "Volume, center of buoyancy, waterplane and wetted area of a hull at a draft, each "
	        "with the error it was checked to have.",
	.scene = true,
	.params = hydrostatics_params,
	.outputs = hydrostatics_outputs,
	.begin = hydrostatics_begin,
	.units = hydrostatics_units,
	.unit = hydrostatics_unit,
	.finish = hydrostatics_finish,
	.end = hydrostatics_end,
};
