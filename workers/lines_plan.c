/* lines_plan.c - the three views laid out on a sheet, each seen by a camera of its own. */
#include "lines_plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "plan_stroke.h"
#include "scene_lines.h"
#include "sheet.h"
#include "ticks.h"

enum { WIDTH = 1600, SIDE = 96, TOP = 76, HEAD = 34, FOOT = 44, GAP = 26 };
enum { LABEL_SIZE = 192 };

enum view_kind { VIEW_FORE, VIEW_AFT, VIEW_PROFILE, VIEW_BREADTH, N_VIEWS };

/* What is drawn of each view, from the ground up. */
enum layer { LAYER_GRID, LAYER_BORDER, LAYER_CURVES, LAYER_DRAUGHT, N_LAYERS };

/* Which curves a view shows, and which planes are straight lines there, along up or right. */
static const struct view_row {
	enum contour_kind curves, level, upright;
	const char *title;
} rows[N_VIEWS] = {
	[VIEW_FORE] = { CONTOUR_STATIONS, CONTOUR_WATERLINES, CONTOUR_BUTTOCKS, NULL },
	[VIEW_AFT] = { CONTOUR_STATIONS, CONTOUR_WATERLINES, CONTOUR_BUTTOCKS, "Body plan" },
	[VIEW_PROFILE] = { CONTOUR_BUTTOCKS, CONTOUR_WATERLINES, CONTOUR_STATIONS, "Profile" },
	[VIEW_BREADTH] = { CONTOUR_WATERLINES, CONTOUR_BUTTOCKS, CONTOUR_STATIONS, "Half-breadth" },
};

static const struct {
	struct rgb color;
	const char *prefix; /* of a straight line's label */
} kinds[] = {
	[CONTOUR_STATIONS] = { { 0.12, 0.35, 0.64 }, "" },
	[CONTOUR_WATERLINES] = { { 0.07, 0.45, 0.43 }, "WL " },
	[CONTOUR_BUTTOCKS] = { { 0.64, 0.27, 0.06 }, "B " },
};

struct view {
	struct camera camera;
	double lo[2], hi[2];       /* the ship in the image: left, top; right, bottom */
	struct plan_side sides[2]; /* what is shown */
	int n_sides;
};

struct drawing {
	const struct lines_plan *plan;
	struct scene_lines scene;
	struct view views[N_VIEWS];
	double length, breadth, depth, scale, enlarged; /* px in a unit; body plan's times that */
	char (*labels)[LABEL_SIZE];                     /* owned, one a text */
	size_t room;
	cairo_t *cr;
};

/* Look so that world point p comes to lie at (x, y). */
static void camera_place(struct camera *c, struct vec3 right, struct vec3 up, double scale,
                         int height, struct vec3 p, double x, double y)
{
	*c = (struct camera){ .kind = CAMERA_ORTHOGRAPHIC,
		              .width = WIDTH,
		              .height = height,
		              .right = right,
		              .up = up,
		              .ahead = vec3_cross(up, right),
		              .half = 0.5 * fmin(WIDTH, height) / scale };
	double a = vec3_dot(p, right) - (x - 0.5 * WIDTH) / scale;
	double b = vec3_dot(p, up) - (0.5 * height - y) / scale;
	c->eye = vec3_along(vec3_scale(right, a), b, up);
}

static void view_place(struct drawing *d, enum view_kind kind, struct vec3 right, struct vec3 up,
                       double scale, double x, double y)
{
	const struct box *b = &d->plan->sets->box;
	struct view *v = &d->views[kind];
	struct vec3 origin = { d->plan->forward > 0 ? b->lo.x : b->hi.x, 0, b->lo.z };
	camera_place(&v->camera, right, up, scale, d->scene.height, origin, x, y);
	double w = (kind == VIEW_FORE || kind == VIEW_AFT ? d->breadth : d->length) * scale;
	v->lo[0] = kind == VIEW_AFT ? x - w : x;
	v->hi[0] = kind == VIEW_AFT ? x : x + w;
	v->lo[1] = y - (kind == VIEW_BREADTH ? d->breadth : d->depth) * scale;
	v->hi[1] = y;
}

/* Scales that fill the sheet; the body plan enlarged by a round number that is said. */
static void layout(struct drawing *d)
{
	static const double enlargements[] = { 12, 10, 8, 6, 5, 4, 3, 2.5, 2, 1.5 };
	const struct contour_sets *s = d->plan->sets;
	const double f = d->plan->forward, size = box_diagonal(&s->box), tiny = 1e-3 * size;
	d->length = fmax(s->box.hi.x - s->box.lo.x, tiny);
	d->depth = fmax(s->box.hi.z - s->box.lo.z, tiny);
	d->breadth = fmax(s->side > 0 ? s->box.hi.y : -s->box.lo.y, tiny);
	d->scale = fmin((WIDTH - 2 * SIDE) / d->length, 400 / fmax(d->depth, d->breadth));
	d->enlarged = 1;
	for (size_t i = sizeof enlargements / sizeof *enlargements; i-- > 0;) {
		const double scale = enlargements[i] * d->scale;
		if (2 * d->breadth * scale <= 0.62 * WIDTH && d->depth * scale <= 540)
			d->enlarged = enlargements[i];
	}
	const double body = d->enlarged * d->scale;
	const double y0 = TOP + HEAD + d->depth * body;
	const double y1 = y0 + FOOT + GAP + HEAD + d->depth * d->scale;
	const double y2 = y1 + FOOT + GAP + HEAD + d->breadth * d->scale;
	const double x = 0.5 * (WIDTH - d->length * d->scale);
	const struct vec3 port = { 0, s->side, 0 }, bow = { f, 0, 0 }, up = { 0, 0, 1 };
	d->scene.width = WIDTH;
	d->scene.height = (int)ceil(y2 + FOOT);
	view_place(d, VIEW_FORE, port, up, body, WIDTH / 2.0, y0);
	view_place(d, VIEW_AFT, vec3_scale(port, -1), up, body, WIDTH / 2.0, y0);
	view_place(d, VIEW_PROFILE, bow, up, d->scale, x, y1);
	view_place(d, VIEW_BREADTH, bow, port, d->scale, x, y2);

	/* one side of the ship; of the sections the half that a side of the body plan shows */
	const double eps = 1e-6 * size, mid = 0.5 * (s->box.lo.x + s->box.hi.x);
	for (int i = 0; i < N_VIEWS; i++) {
		struct view *v = &d->views[i];
		v->sides[v->n_sides++] = (struct plan_side){ port, -eps };
		if (i == VIEW_FORE)
			v->sides[v->n_sides++] = (struct plan_side){ bow, f * mid - eps };
		if (i == VIEW_AFT)
			v->sides[v->n_sides++] =
			        (struct plan_side){ vec3_scale(bow, -1), -f * mid - eps };
	}
}

static struct scene_line *layer_of(struct drawing *d, int view, enum layer layer)
{
	return &d->scene.lines[view * N_LAYERS + layer];
}

static void layers_init(struct drawing *d)
{
	static const struct {
		const char *what;
		double width, opacity;
	} styles[N_LAYERS] = {
		[LAYER_GRID] = { "wire", 0.75, 0.3 },
		[LAYER_BORDER] = { "border", 1.25, 0.9 },
		[LAYER_CURVES] = { "curve", 1, 1 },
		[LAYER_DRAUGHT] = { "draught", 1.25, 1 },
	};
	for (int i = 0; i < N_VIEWS * N_LAYERS; i++) {
		const enum layer l = i % N_LAYERS;
		struct rgb color = theme_color(THEME_LIGHT, TOKEN_TEXT);
		if (l == LAYER_CURVES)
			color = kinds[rows[i / N_LAYERS].curves].color;
		if (l == LAYER_DRAUGHT)
			color = kinds[CONTOUR_WATERLINES].color;
		d->scene.lines[i].style =
		        (struct line_style){ color, styles[l].width, styles[l].opacity };
		d->scene.lines[i].what = styles[l].what;
	}
}

/* Put a text with its middle, left or right end (align 0.5, 0, 1) at x, unless others lie there. */
static void label(struct drawing *d, enum label_style style, struct rgb color, double x,
                  double middle, double align, bool always, const char *text)
{
	struct scene_lines *s = &d->scene;
	if (s->n_texts == d->room)
		return;
	struct scene_text *t = &s->texts[s->n_texts];
	char *kept = d->labels[s->n_texts];
	snprintf(kept, LABEL_SIZE, "%s", text);
	*t = (struct scene_text){ .style = style, .color = color, .text = kept };
	t->width = label_width(d->cr, style, kept);
	t->x = x - align * t->width;
	t->y = label_baseline(style, middle);
	for (size_t i = 0; !always && i < s->n_texts; i++) {
		const struct scene_text *o = &s->texts[i];
		if (t->x < o->x + o->width + 3 && o->x < t->x + t->width + 3 &&
		    fabs(t->y - o->y) < 12)
			return;
	}
	s->n_texts++;
}

static const struct contour_set *set_of(const struct lines_plan *p, enum contour_kind kind)
{
	for (int i = 0; i < p->sets->n; i++)
		if (p->sets->set[i].kind == kind)
			return &p->sets->set[i];
	return NULL;
}

/* Where the plane of a set at a value lies in a view, in px. */
static void plane_place(const struct view *v, enum contour_kind kind, double value, double *x,
                        double *y)
{
	double depth;
	struct vec3 p = { kind == CONTOUR_STATIONS ? value : 0,
		          kind == CONTOUR_BUTTOCKS ? value : 0,
		          kind == CONTOUR_WATERLINES ? value : 0 };
	camera_project(&v->camera, p, x, y, &depth);
}

/* The straight lines of one set in one view, with their numbers at the edge. */
static enum status planes_draw(struct drawing *d, int view, enum contour_kind kind, bool upright)
{
	const struct contour_set *set = set_of(d->plan, kind);
	const struct view *v = &d->views[view];
	const struct rgb color = kinds[kind].color;
	const bool level = kind == CONTOUR_WATERLINES;
	enum status st = ST_OK;
	for (int i = 0; set && st == ST_OK && i < set->n; i++) {
		char text[LABEL_SIZE];
		double x, y;
		plane_place(v, kind, set->values[i], &x, &y);
		if (upright ? x < v->lo[0] - 1 || x > v->hi[0] + 1
		            : y < v->lo[1] - 1 || y > v->hi[1] + 1)
			continue;
		snprintf(text, sizeof text, "%s%d", kinds[kind].prefix, set->first + i);
		struct stroke *s = &layer_of(d, view, LAYER_GRID)->stroke;
		st = upright ? plan_line(s, x, v->lo[1], x, v->hi[1] + 8)
		             : plan_line(s, v->lo[0] - 8, y, v->hi[0] + 8, y);
		if (upright)
			label(d, LABEL_NOTE, color, x, v->hi[1] + 18, 0.5, false, text);
		else if (view != VIEW_FORE)
			label(d, LABEL_NOTE, color, v->lo[0] - 14, y, 1, false, text);
		if (!upright && view != VIEW_AFT) {
			char value[TICK_TEXT];
			number_for_reader(value, level ? set->values[i] : fabs(set->values[i]), 4);
			label(d, LABEL_NOTE, theme_color(THEME_LIGHT, TOKEN_MUTED), v->hi[0] + 14,
			      y, 0, false, value);
		}
	}
	return st;
}

static enum status draught_draw(struct drawing *d, int view)
{
	const struct view *v = &d->views[view];
	double x, y;
	if (!d->plan->has_draught || view == VIEW_BREADTH)
		return ST_OK;
	plane_place(v, CONTOUR_WATERLINES, d->plan->draught, &x, &y);
	if (view != VIEW_AFT)
		label(d, LABEL_STRONG, kinds[CONTOUR_WATERLINES].color, v->hi[0] + 14, y, 0, true,
		      "DWL");
	return plan_line(&layer_of(d, view, LAYER_DRAUGHT)->stroke, v->lo[0] - 8, y, v->hi[0] + 8,
	                 y);
}

/* Of the pieces of one curve, the one that carries its number. */
struct labelled {
	size_t first, n; /* among the stroke's pieces */
	double extent;   /* length, or height in the body plan: not that of the deck */
};

static double piece_extent(const struct stroke *s, bool height)
{
	double lo = INFINITY, hi = -INFINITY;
	if (!height)
		return stroke_length(s);
	for (size_t i = 0; i < s->n; i++)
		for (int k = 0; k < 4; k += 3) {
			lo = fmin(lo, s->pieces[i].p[k][1]);
			hi = fmax(hi, s->pieces[i].p[k][1]);
		}
	return hi - lo;
}

/* The curve's number: over its upper end in the body plan, where there is room; else on it. */
static void curve_label(struct drawing *d, const struct contour_set *set, int place,
                        const struct stroke *s)
{
	static const double shares[] = { 0.5, 0.68, 0.32, 0.84, 0.16 };
	enum { N_SHARES = sizeof shares / sizeof *shares };
	const struct rgb color = kinds[set->kind].color;
	char text[LABEL_SIZE];
	double at[2] = { 0, INFINITY };
	snprintf(text, sizeof text, "%d", set->first + place);
	for (size_t i = 0; set->kind == CONTOUR_STATIONS && i < s->n; i++)
		for (int k = 0; k < 4; k += 3)
			if (s->pieces[i].p[k][1] < at[1]) {
				at[0] = s->pieces[i].p[k][0];
				at[1] = s->pieces[i].p[k][1];
			}
	const size_t before = d->scene.n_texts;
	if (set->kind == CONTOUR_STATIONS)
		label(d, LABEL_NOTE, color, at[0], at[1] - 10, 0.5, false, text);
	/* neighbours begin to try at different places, where curves run close together */
	for (int i = 0; d->scene.n_texts == before && i < N_SHARES; i++) {
		stroke_point(s, shares[(i + place) % N_SHARES], at);
		label(d, LABEL_NOTE, color, at[0], at[1], 0.5, false, text);
	}
	if (d->scene.n_texts > before)
		d->scene.texts[before].plate = true;
}

static enum status curves_draw(struct drawing *d, int view)
{
	const struct lines_plan *p = d->plan;
	const struct view *v = &d->views[view];
	const struct contour_set *set = set_of(p, rows[view].curves);
	struct stroke *s = &layer_of(d, view, LAYER_CURVES)->stroke;
	enum status st = ST_OK;
	if (!set)
		return ST_OK;
	struct labelled *best = calloc((size_t)set->n, sizeof *best);
	if (!best)
		return ST_RESOURCE;
	for (size_t i = 0; st == ST_OK && i < p->n_curves; i++) {
		const struct plan_curve *c = &p->curves[i];
		if (c->of != set->kind)
			continue;
		const size_t first = s->n;
		st = plan_stroke(s, &v->camera, c->curve, v->sides, v->n_sides);
		const struct stroke part = { s->n > first ? s->pieces + first : NULL, s->n - first,
			                     0 };
		const double extent =
		        part.n > 0 ? piece_extent(&part, set->kind == CONTOUR_STATIONS) : 0;
		if (st == ST_OK && extent > best[c->place].extent)
			best[c->place] = (struct labelled){ first, part.n, extent };
	}
	for (int i = 0; st == ST_OK && i < set->n; i++) {
		if (!(best[i].extent > 24))
			continue;
		const struct stroke part = { s->pieces + best[i].first, best[i].n, 0 };
		curve_label(d, set, i, &part);
	}
	free(best);
	return st;
}

/* The borders of the surfaces: keel, stem, edge of the deck, transom. */
static enum status borders_draw(struct drawing *d, int view)
{
	const struct view *v = &d->views[view];
	struct stroke *s = &layer_of(d, view, LAYER_BORDER)->stroke;
	enum status st = ST_OK;
	for (int i = 0; st == ST_OK && i < d->plan->n_surfaces; i++)
		for (int k = 0; st == ST_OK && k < 4; k++)
			st = plan_border(s, &v->camera, d->plan->surfaces[i], k / 2, k % 2,
			                 v->sides, v->n_sides);
	for (size_t i = 0; st == ST_OK && i < d->plan->n_borders; i++)
		st = plan_stroke(s, &v->camera, &d->plan->borders[i], v->sides, v->n_sides);
	return st;
}

static void heading(struct drawing *d)
{
	const char *unit = d->plan->unit ? d->plan->unit : "";
	const struct rgb ink = theme_color(THEME_LIGHT, TOKEN_TEXT);
	const struct rgb muted = theme_color(THEME_LIGHT, TOKEN_MUTED);
	char text[LABEL_SIZE], l[TICK_TEXT], b[TICK_TEXT], h[TICK_TEXT];
	number_for_reader(l, d->length, 4);
	number_for_reader(b, 2 * d->breadth, 4);
	number_for_reader(h, d->depth, 4);
	label(d, LABEL_HEADING, ink, 24, 26, 0, true, "Lines plan");
	snprintf(text, sizeof text, "length %s, breadth %s, height %s %.16s", l, b, h, unit);
	label(d, LABEL_NOTE, muted, 24, 46, 0, true, text);
	for (int i = 0; i < N_VIEWS; i++) {
		const struct view *v = &d->views[i];
		const double y = v->lo[1] - HEAD + 2;
		if (!rows[i].title)
			continue;
		if (i == VIEW_AFT && d->enlarged != 1)
			snprintf(text, sizeof text, "%s, %g times as large", rows[i].title,
			         d->enlarged);
		else
			snprintf(text, sizeof text, "%s", rows[i].title);
		label(d, LABEL_STRONG, ink, d->views[VIEW_PROFILE].lo[0], y, 0, true, text);
	}
	const struct view *aft = &d->views[VIEW_AFT], *fore = &d->views[VIEW_FORE];
	label(d, LABEL_NOTE, muted, aft->lo[0], aft->hi[1] + 34, 0, true, "aft");
	label(d, LABEL_NOTE, muted, fore->hi[0], fore->hi[1] + 34, 1, true, "fore");
}

/* The plane of symmetry, in the views that show it as a line; the base line. */
static enum status centre_draw(struct drawing *d)
{
	const struct view *fore = &d->views[VIEW_FORE], *breadth = &d->views[VIEW_BREADTH];
	const struct view *profile = &d->views[VIEW_PROFILE], *aft = &d->views[VIEW_AFT];
	const double x = fore->lo[0];
	struct stroke *s = &layer_of(d, VIEW_FORE, LAYER_GRID)->stroke;
	enum status st = plan_line(s, x, fore->lo[1] - 8, x, fore->hi[1] + 8);
	if (st == ST_OK)
		st = plan_line(s, aft->lo[0] - 8, fore->hi[1], fore->hi[0] + 8, fore->hi[1]);
	if (st == ST_OK)
		st = plan_line(&layer_of(d, VIEW_PROFILE, LAYER_GRID)->stroke, profile->lo[0] - 8,
		               profile->hi[1], profile->hi[0] + 8, profile->hi[1]);
	if (st == ST_OK)
		st = plan_line(&layer_of(d, VIEW_BREADTH, LAYER_GRID)->stroke, breadth->lo[0] - 8,
		               breadth->hi[1], breadth->hi[0] + 8, breadth->hi[1]);
	return st;
}

static enum status views_draw(struct drawing *d)
{
	enum status st = centre_draw(d);
	for (int i = 0; st == ST_OK && i < N_VIEWS; i++) {
		st = draught_draw(d, i);
		if (st == ST_OK)
			st = planes_draw(d, i, rows[i].level, false);
		if (st == ST_OK)
			st = planes_draw(d, i, rows[i].upright, true);
		if (st == ST_OK)
			st = borders_draw(d, i);
		if (st == ST_OK)
			st = curves_draw(d, i);
	}
	return st;
}

enum status lines_plan_write(const struct lines_plan *p, const char *path, const struct report *r)
{
	struct drawing d = { .plan = p, .room = p->n_curves + 8 * (size_t)p->sets->n_values + 16 };
	struct sheet sheet;
	enum status st = sheet_init(&sheet, path, 0, 0, r);
	if (st != ST_OK)
		return st;
	d.cr = sheet.cr;
	d.scene.ground = theme_color(THEME_LIGHT, TOKEN_VIEW);
	d.scene.n_lines = N_VIEWS * N_LAYERS;
	d.scene.lines = calloc(d.scene.n_lines, sizeof *d.scene.lines);
	d.scene.texts = calloc(d.room, sizeof *d.scene.texts);
	d.labels = calloc(d.room, sizeof *d.labels);
	st = d.scene.lines && d.scene.texts && d.labels ? ST_OK : ST_RESOURCE;
	if (!d.scene.lines)
		d.scene.n_lines = 0;
	if (st == ST_OK) {
		layout(&d);
		layers_init(&d);
		heading(&d);
		st = views_draw(&d);
	}
	const struct scene_sheet sheets = {
		.width = d.scene.width, .height = d.scene.height, .scenes = &d.scene, .n = 1
	};
	st = st == ST_OK ? svg_write(&sheets, path, r)
	                 : report_error(r, st, "no memory to draw the lines plan");
	scene_lines_finish(&d.scene);
	free(d.labels);
	sheet_finish(&sheet);
	return st;
}
