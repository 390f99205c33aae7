/* desk_uv.c - the plane of the current surface's parameters beside it: what is seen of it, what lies under
 * the mouse there, and what is painted. */
#include <math.h>
#include <string.h>

#include "desk_inside.h"

enum { REACH = 8, SAMPLES_A_SPAN = 12, SAMPLES_MAX = 4096 };

static const double MARGIN = 0.04, RANGE_LEAST = 1e-9, RANGE_MOST = 100;

/* ------------------------------------------------------------ what is seen of it */

const struct Ful *desk_uv_surface(const struct desk *d)
{
	return view_plane_surface(d->world);
}

void desk_uv_fit(struct desk *d)
{
	const struct Ful *f = desk_uv_surface(d);

	d->uv_of = f ? f->id : 0;
	for (int k = 0; f && k < 2; k++) {
		const double *domain = f->entity.geometry.domain[k];
		const double more = MARGIN * (domain[1] - domain[0]);
		d->uv_range[k][0] = domain[0] - more;
		d->uv_range[k][1] = domain[1] + more;
	}
	desk_dirty(d, desk_bit(PART_OVER));
}

/* The surface, with a range that is its own; NULL: none. */
static const struct Ful *look(struct desk *d)
{
	const struct Ful *f = desk_uv_surface(d);

	if (f && f->id != d->uv_of)
		desk_uv_fit(d);
	return f;
}

static struct box_px square(const struct desk *d)
{
	return panel_uv_square(&d->tiles[1].box);
}

void desk_uv_pan(struct desk *d, double dx, double dy)
{
	const struct box_px b = square(d);
	const double by[2] = { -dx / b.width, dy / b.height };

	if (!look(d))
		return;
	for (int k = 0; k < 2; k++) {
		const double shift = by[k] * (d->uv_range[k][1] - d->uv_range[k][0]);
		d->uv_range[k][0] += shift;
		d->uv_range[k][1] += shift;
	}
	desk_dirty(d, desk_bit(PART_OVER));
}

/* What is under (x, y) stays there. */
void desk_uv_zoom(struct desk *d, double factor, double x, double y)
{
	const struct box_px b = square(d);
	const double share[2] = { (x - b.x) / b.width, 1 - (y - b.y) / b.height };
	const struct Ful *f = look(d);

	if (!f)
		return;
	for (int k = 0; k < 2; k++) {
		const double *domain = f->entity.geometry.domain[k];
		const double whole = domain[1] - domain[0];
		double *r = d->uv_range[k], was = r[1] - r[0];
		const double now =
		        fmin(fmax(was / factor, RANGE_LEAST * whole), RANGE_MOST * whole);
		r[0] += share[k] * (was - now);
		r[1] = r[0] + now;
	}
	desk_dirty(d, desk_bit(PART_OVER));
}

/* ------------------------------------------------------------ what lies under the mouse */

bool desk_uv_at(struct desk *d, double x, double y, double uv[2])
{
	const struct box_px b = square(d);
	const double share[2] = { (x - b.x) / b.width, 1 - (y - b.y) / b.height };
	const struct Ful *f = look(d);
	bool inside = f != NULL;

	for (int k = 0; f && k < 2; k++) {
		const double *domain = f->entity.geometry.domain[k], *r = d->uv_range[k];
		uv[k] = r[0] + share[k] * (r[1] - r[0]);
		inside = inside && uv[k] >= domain[0] && uv[k] <= domain[1];
	}
	return inside;
}

/* The curve on that surface whose control points are shown. */
static const struct Ful *edited(const struct desk *d, const struct Ful *surface)
{
	const struct Ful *f = world_current(d->world, true);

	return f && f->on == surface->id && f->display.net ? f : NULL;
}

static bool pick_point(struct desk *d, const struct Ful *f, struct pick *out)
{
	const struct box_px b = square(d);
	double best = REACH;

	for (int i = 0; i < f->entity.curve.n; i++) {
		const struct vec3 p = curve_get_point(&f->entity.curve, i, NULL);
		const double *u = d->uv_range[0], *v = d->uv_range[1];
		const double x = b.x + b.width * (p.x - u[0]) / (u[1] - u[0]);
		const double y = b.y + b.height * (v[1] - p.y) / (v[1] - v[0]);
		const double away = hypot(x - d->x, y - d->y);
		if (away >= best)
			continue;
		best = away;
		*out = (struct pick){
			.thing = f->id, .is_point = true, .index = i, .u = p.x, .v = p.y
		};
	}
	return best < REACH;
}

bool desk_uv_pick(struct desk *d, bool points, struct pick *out)
{
	const struct Ful *f = look(d), *curve = f && points ? edited(d, f) : NULL;
	double uv[2];

	*out = (struct pick){ .index = -1 };
	if (curve && pick_point(d, curve, out))
		return true;
	if (!f || !desk_uv_at(d, d->x, d->y, uv))
		return false;
	*out = (struct pick){ .thing = f->id,
		              .index = -1,
		              .u = uv[0],
		              .v = uv[1],
		              .point = surface_point(&f->entity.geometry, uv[0], uv[1]) };
	return true;
}

/* ------------------------------------------------------------ what is painted */

/* Lines being collected; room for as many as were counted. */
struct lines {
	struct uv_line *line;
	int n, room;
};

static void add_curve(struct scraps *s, struct lines *l, const struct curve *c,
                      enum uv_line_kind kind)
{
	int n = (c->n - c->order + 1) * SAMPLES_A_SPAN + 1;

	n = n > SAMPLES_MAX ? SAMPLES_MAX : n < 2 ? 2 : n;
	double *uv = l->n < l->room ? scraps_array(s, 2 * (size_t)n, sizeof *uv) : NULL;
	for (int i = 0; uv && i < n; i++) {
		const double share = (double)i / (n - 1);
		const struct vec3 p =
		        curve_point(c, c->domain[0] + share * (c->domain[1] - c->domain[0]));
		uv[2 * i] = p.x;
		uv[2 * i + 1] = p.y;
	}
	if (uv)
		l->line[l->n++] = (struct uv_line){ kind, uv, n };
}

static void add_net(struct scraps *s, struct lines *l, struct uv_model *m, const struct curve *c)
{
	double *uv = l->n < l->room ? scraps_array(s, 2 * (size_t)c->n, sizeof *uv) : NULL;

	for (int i = 0; uv && i < c->n; i++) {
		const struct vec3 p = curve_get_point(c, i, NULL);
		uv[2 * i] = p.x;
		uv[2 * i + 1] = p.y;
	}
	if (!uv)
		return;
	l->line[l->n++] = (struct uv_line){ UV_LINE_NET, uv, c->n };
	m->points = uv;
	m->n_points = c->n;
}

static int count_lines(const struct desk *d, const struct Ful *f)
{
	int n = 1; /* the net */

	for (int i = 0; i < f->entity.trim.n; i++)
		n += f->entity.trim.loops[i].n;
	for (int k = 0; k < world_count(d->world); k++)
		n += world_at(d->world, k)->on == f->id;
	return n;
}

static void add_lines(struct desk *d, struct scraps *s, const struct Ful *f, struct uv_model *m)
{
	struct lines l = { .room = count_lines(d, f) };
	const struct Ful *current = world_current(d->world, true), *net = edited(d, f);

	l.line = scraps_array(s, (size_t)l.room, sizeof *l.line);
	if (!l.line)
		return;
	for (int i = 0; i < f->entity.trim.n; i++)
		for (int k = 0; k < f->entity.trim.loops[i].n; k++)
			add_curve(s, &l, &f->entity.trim.loops[i].curves[k], UV_LINE_TRIM);
	for (int k = 0; k < world_count(d->world); k++) {
		const struct Ful *c = world_at(d->world, k);
		if (c->on == f->id && c->display.on)
			add_curve(s, &l, &c->entity.curve,
			          c == current ? UV_LINE_CURRENT : UV_LINE_CURVE);
	}
	if (net)
		add_net(s, &l, m, &net->entity.curve);
	m->hover = net && d->pick.is_point && d->pick.thing == net->id ? d->pick.index : -1;
	m->lines = l.line;
	m->n_lines = l.n;
}

static void add_places(struct desk *d, struct scraps *s, const struct Ful *f, struct uv_model *m)
{
	double *uv = scraps_array(s, 2 * (size_t)world_marks(d->world) + 1, sizeof *uv);
	int n = 0;

	for (int k = 0; uv && k < world_marks(d->world); k++) {
		const struct mark *at = world_mark(d->world, k);
		if (at->thing != f->id)
			continue;
		uv[2 * n] = at->u;
		uv[2 * n++ + 1] = at->v;
	}
	m->marks = uv;
	m->n_marks = n;
	m->has_probe = d->probe_shown && d->pick.thing == f->id;
	m->probe[0] = d->pick.u;
	m->probe[1] = d->pick.v;
}

void desk_paint_uv(struct desk *d, cairo_t *cr, struct scraps *s, const struct box_px *pane)
{
	const struct Ful *f = look(d);
	struct uv_model m = { .hover = -1 };

	if (f) {
		const struct surface *g = &f->entity.geometry;
		memcpy(m.range, d->uv_range, sizeof m.range);
		memcpy(m.domain, g->domain, sizeof m.domain);
		for (int k = 0; k < 2; k++) {
			m.knots[k] = g->knots[k];
			m.n_knots[k] = g->n[k] + g->order[k];
		}
		add_lines(d, s, f, &m);
		add_places(d, s, f, &m);
	}
	panel_uv(cr, pane, &m, &d->look);
}
