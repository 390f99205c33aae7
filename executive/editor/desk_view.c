/* desk_view.c - the views: where they are, how the mouse and the keys turn them, the probe. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

enum { TURN_DEGREES = 5, PAN_PX = 40, CLICK_PX = 4 };

static const double ZOOM_STEP = 1.15;

/* ------------------------------------------------------------ where they are */

static void place_tiles(struct desk *d, int n)
{
	struct box_px v = d->layout.view;
	int columns = n == 1 ? 1 : n == 2 ? 1 : 4, rows = n == 1 ? 1 : 2;

	for (int i = 0; i < n; i++) {
		struct box_px *b = &d->tiles[i].box;
		double x0 = round(v.width * (i % columns) / columns);
		double x1 = round(v.width * (i % columns + 1) / columns);
		double y0 = round(v.height * (i / columns) / rows);
		double y1 = round(v.height * (i / columns + 1) / rows);
		*b = (struct box_px){ v.x + x0, v.y + y0, x1 - x0, y1 - y0 };
		if (n > 1) { /* the rule between them */
			b->width -= x1 < v.width;
			b->height -= y1 < v.height;
		}
	}
}

void desk_views_place(struct desk *d)
{
	bool all = !d->errand && world_sight(d->world)->all_curvatures;
	int n = d->errand ? d->n_tiles : all ? N_QUANTITIES : 1;

	int was = d->n_tiles;
	for (int i = was; i < n; i++)
		d->tiles[i].view = d->tiles[0].view;
	d->n_tiles = n;
	if (d->tile >= n)
		d->tile = 0;
	place_tiles(d, n);
	for (int i = 0; i < n; i++) {
		struct view_state *v = &d->tiles[i].view;
		v->theme = d->theme;
		v->scale = d->scale;
		v->quantity = n == N_QUANTITIES ? i : -1;
		v->axes = n == 1;
		v->camera.width = (int)d->tiles[i].box.width;
		v->camera.height = (int)d->tiles[i].box.height;
		if (!v->hover_thing)
			v->hover_point = -1;
	}
	if (n != was && d->fitted) /* what was seen in one view is seen in each */
		desk_views_fit(d, NULL);
}

/* In the form of a leaf that changes the view: the same in words. */
static void name_view(struct desk *d)
{
	const struct camera *c = &d->tiles[d->tile].view.camera;
	struct vec3 a = c->ahead;

	if (d->tool == TOOL_VIEW)
		desk_ask_set(d, "view", "%.2f,%.2f%s", atan2(-a.y, -a.x) * 180 / M_PI,
		             asin(fmax(-1, fmin(1, -a.z))) * 180 / M_PI,
		             c->kind == CAMERA_PERSPECTIVE ? ":perspective" : "");
}

/* A routine has set it. */
void desk_views_adopt(struct desk *d)
{
	const struct sight *s = world_sight(d->world);

	if (!s->has_camera || !memcmp(&s->camera, &d->camera_seen, sizeof s->camera))
		return;
	for (int i = 0; i < d->n_tiles; i++) {
		struct camera *c = &d->tiles[i].view.camera;
		*c = s->camera;
		c->width = (int)d->tiles[i].box.width;
		c->height = (int)d->tiles[i].box.height;
	}
	d->camera_seen = s->camera;
	d->fitted = true;
	desk_dirty(d, DESK_VIEW);
}

/* All views look from the same place; the world keeps it for the session. */
static void spread_camera(struct desk *d, int from)
{
	struct sight *s = world_sight(d->world);

	for (int i = 0; i < d->n_tiles; i++) {
		struct camera *c = &d->tiles[i].view.camera;
		*c = d->tiles[from].view.camera;
		c->width = (int)d->tiles[i].box.width;
		c->height = (int)d->tiles[i].box.height;
	}
	s->camera = d->tiles[from].view.camera;
	s->has_camera = true;
	d->camera_seen = s->camera;
	name_view(d);
	d->fitted = true;
	desk_dirty(d, DESK_VIEW | desk_bit(PART_PROBE));
}

void desk_views_fit(struct desk *d, const char *view)
{
	struct desk_tile *t = &d->tiles[d->tile];
	struct sight *s = world_sight(d->world);
	struct report_store store;

	if (d->errand || !world_count(d->world))
		return;
	report_store_init(&store);
	if (!view && !d->fitted && s->has_camera) { /* as the last session left it */
		desk_views_adopt(d);
		return;
	}
	if (!view && !d->fitted)
		view = "three-quarter";
	if (view_fit(&t->view, d->world, view, (int)t->box.width, (int)t->box.height,
	             &store.report) != ST_OK) {
		desk_say(d, REPORT_ERROR, "%s", store.error);
		return;
	}
	spread_camera(d, d->tile);
}

struct desk_tile *desk_tiles(struct desk *d, int *n)
{
	*n = d->n_tiles;
	for (int i = 0; i < d->n_tiles; i++) {
		d->tiles[i].view.moving = desk_moving(d);
		d->tiles[i].view.light = d->tool == TOOL_LIGHT;
	}
	return d->tiles;
}

int desk_tile_focus(const struct desk *d)
{
	return d->tile;
}

bool desk_moving(const struct desk *d)
{
	return d->drag == DRAG_ROTATE || d->drag == DRAG_PAN || d->drag == DRAG_POINT;
}

int desk_tile_at(const struct desk *d, double x, double y)
{
	for (int i = 0; i < d->n_tiles; i++) {
		const struct box_px *b = &d->tiles[i].box;
		if (x >= b->x && y >= b->y && x < b->x + b->width && y < b->y + b->height)
			return i;
	}
	return -1;
}

/* ------------------------------------------------------------ what lies under the mouse */

static bool find(struct desk *d, bool points, struct pick *out)
{
	int i = desk_tile_at(d, d->x, d->y);

	*out = (struct pick){ 0 };
	if (i < 0 || !d->ports.pick || d->errand)
		return false;
	const struct desk_tile *t = &d->tiles[i];
	return d->ports.pick(d->ports.data, &t->view, d->x - t->box.x, d->y - t->box.y, points,
	                     d->skip, out) &&
	       out->thing;
}

void desk_hover(struct desk *d)
{
	if (d->tool != TOOL_POINTS && d->tool != TOOL_PICK)
		return;
	struct pick was = d->pick;
	int i = desk_tile_at(d, d->x, d->y);
	find(d, d->tool == TOOL_POINTS, &d->pick);
	if (d->pick.thing == was.thing && d->pick.is_point == was.is_point &&
	    d->pick.index == was.index)
		return;
	for (int k = 0; k < d->n_tiles; k++) {
		struct view_state *v = &d->tiles[k].view;
		v->hover_thing = k == i ? d->pick.thing : 0;
		v->hover_point = k == i && d->pick.is_point ? d->pick.index : -1;
	}
	desk_dirty(d, DESK_VIEW);
}

/* The circles of curvature, where the probe is. */
static void show_probe(struct desk *d)
{
	const struct Ful *f = world_by_id(d->world, d->pick.thing);
	bool on = d->probe_shown && f && f->entity.kind == ENTITY_SURFACE;

	for (int i = 0; i < d->n_tiles; i++)
		d->tiles[i].view.probe =
		        on ? (struct mark){ f->id, d->pick.u, d->pick.v } : (struct mark){ 0 };
	desk_dirty(d, desk_bit(PART_PROBE) | DESK_VIEW);
}

void desk_probe_hide(struct desk *d)
{
	d->probe_shown = false;
	show_probe(d);
}

static void probe(struct desk *d)
{
	struct pick p;
	bool found = find(d, false, &p);

	d->pick = p;
	d->probe_shown = found;
	d->probe_kept = false;
	d->probe_x = d->x;
	d->probe_y = d->y;
	show_probe(d);
}

static void keep_mark(struct desk *d)
{
	const struct Ful *f = world_by_id(d->world, d->pick.thing);
	struct mark m = { d->pick.thing, d->pick.u, d->pick.v };

	if (!d->probe_shown || !f)
		return;
	d->probe_kept = f->entity.kind == ENTITY_SURFACE && world_keep_mark(d->world, &m) == ST_OK;
	desk_dirty(d, desk_bit(PART_PROBE) | DESK_VIEW);
}

/* A picked thing goes into the field that asks for one. */
static void give_pick(struct desk *d)
{
	struct pick p;
	const struct Ful *f = find(d, false, &p) ? world_by_id(d->world, p.thing) : NULL;

	if (!f) {
		desk_say(d, REPORT_INFO, "Nothing lies there.");
		return;
	}
	if (d->ask.routine)
		desk_ask_set(d, d->ask.rows[d->ask.focus].name, "%s", f->name);
}

/* Does the field in focus want something that can be picked? */
static bool wants_pick(const struct desk *d)
{
	if (!d->ask.routine || d->ask.focus >= d->ask.n)
		return false;
	enum argument_type type = d->ask.rows[d->ask.focus].type;
	return type == ARGUMENT_SURFACE || type == ARGUMENT_CURVE || type == ARGUMENT_THING;
}

/* ------------------------------------------------------------ dragging */

static enum drag_kind drag_of(const struct desk *d, enum desk_button b, unsigned mods)
{
	if (b == BUTTON_MIDDLE)
		return DRAG_PAN;
	if (b == BUTTON_LEFT && (d->space || d->tool == TOOL_VIEW))
		return mods & MOD_SHIFT ? DRAG_PAN : DRAG_ROTATE;
	if (d->tool == TOOL_POINTS)
		return b == BUTTON_LEFT ? DRAG_POINT : DRAG_ROTATE;
	if (d->tool == TOOL_LIGHT)
		return b == BUTTON_LEFT ? DRAG_LIGHT : DRAG_ROTATE;
	if (b == BUTTON_LEFT)
		return mods & MOD_SHIFT ? DRAG_PAN : DRAG_ROTATE;
	return DRAG_PROBE;
}

bool desk_view_press(struct desk *d, enum desk_button b, unsigned mods)
{
	int i = desk_tile_at(d, d->x, d->y);

	if (i < 0 || !world_count(d->world))
		return false;
	if (d->tile != i)
		desk_dirty(d, desk_bit(PART_OVER) | DESK_VIEW);
	d->tile = i;
	if (b == BUTTON_LEFT && wants_pick(d) && !d->space) {
		give_pick(d);
		return true;
	}
	d->drag = drag_of(d, b, mods);
	d->camera_before = d->tiles[i].view.camera;
	d->tiles[i].view.has_pivot = false;
	if (d->drag == DRAG_POINT && !desk_point_press(d))
		d->drag = DRAG_NONE;
	if (d->drag == DRAG_PROBE)
		probe(d);
	if (d->drag == DRAG_LIGHT)
		desk_tool_move(d);
	desk_dirty(d, desk_bit(PART_MOUSE));
	return true;
}

void desk_view_move(struct desk *d, double dx, double dy)
{
	struct view_state *v = &d->tiles[d->tile].view;

	switch (d->drag) {
	case DRAG_ROTATE:
		view_rotate(v, d->world, dx, dy);
		spread_camera(d, d->tile);
		break;
	case DRAG_PAN:
		view_pan(v, dx, dy);
		spread_camera(d, d->tile);
		break;
	case DRAG_PROBE:
		probe(d);
		break;
	case DRAG_POINT:
		desk_point_move(d);
		break;
	default:
		desk_tool_move(d);
		break;
	}
}

void desk_view_release(struct desk *d)
{
	enum drag_kind was = d->drag;

	d->drag = DRAG_NONE;
	if (was == DRAG_PROBE)
		keep_mark(d);
	if (was == DRAG_POINT)
		desk_point_release(d, true);
	if (was == DRAG_ROTATE || was == DRAG_PAN)
		desk_dirty(d, DESK_VIEW); /* at rest it is drawn better */
}

void desk_drag_cancel(struct desk *d)
{
	enum drag_kind was = d->drag;

	d->drag = DRAG_NONE;
	if (was == DRAG_ROTATE || was == DRAG_PAN) {
		d->tiles[d->tile].view.camera = d->camera_before;
		spread_camera(d, d->tile);
	}
	if (was == DRAG_POINT)
		desk_point_release(d, false);
	if (was == DRAG_PROBE)
		desk_probe_hide(d);
	desk_dirty(d, DESK_VIEW | desk_bit(PART_MOUSE) | desk_bit(PART_PROBE));
}

void desk_view_scroll(struct desk *d, double dy)
{
	int i = desk_tile_at(d, d->x, d->y);

	if (i < 0 || !world_count(d->world))
		return;
	d->tile = i;
	if (d->space)
		d->space_used = true;
	view_zoom(&d->tiles[i].view, d->world, pow(ZOOM_STEP, dy), d->x - d->tiles[i].box.x,
	          d->y - d->tiles[i].box.y);
	spread_camera(d, i);
}

/* ------------------------------------------------------------ keys */

static void arrow(struct desk *d, double x, double y, unsigned mods)
{
	struct desk_tile *t = &d->tiles[d->tile];
	/* as many px as turn by the step: the view's smaller side is half a turn */
	double px = fmin(t->box.width, t->box.height) * TURN_DEGREES / 180;

	if (mods & MOD_CTRL)
		view_zoom(&t->view, d->world, y < 0 || x > 0 ? ZOOM_STEP : 1 / ZOOM_STEP,
		          t->box.width / 2, t->box.height / 2);
	else if (mods & MOD_SHIFT)
		view_pan(&t->view, PAN_PX * x, PAN_PX * y);
	else
		view_rotate(&t->view, d->world, px * x, px * y);
	spread_camera(d, d->tile);
}

bool desk_view_key(struct desk *d, enum desk_key key, unsigned mods)
{
	static const char *const side[] = { "front", "back", "left", "right", "top", "bottom" };

	if (!world_count(d->world))
		return false;
	if ((int)key >= KEY_CTRL_1 && (int)key <= KEY_CTRL_6) {
		desk_views_fit(d, side[key - KEY_CTRL_1]);
		return true;
	}
	switch ((int)key) {
	case KEY_LEFT:
		arrow(d, -1, 0, mods);
		return true;
	case KEY_RIGHT:
		arrow(d, 1, 0, mods);
		return true;
	case KEY_UP:
		arrow(d, 0, -1, mods);
		return true;
	case KEY_DOWN:
		arrow(d, 0, 1, mods);
		return true;
	case KEY_HOME:
		desk_views_fit(d, "three-quarter");
		return true;
	default:
		return false;
	}
}

bool desk_view_text(struct desk *d, uint32_t c)
{
	if (d->errand || !world_count(d->world))
		return false;
	switch (c) {
	case 'f':
	case 'F':
		desk_views_fit(d, NULL);
		return true;
	case 'x':
		desk_views_fit(d, "right");
		return true;
	case 'X':
		desk_views_fit(d, "left");
		return true;
	case 'y':
		desk_views_fit(d, "back");
		return true;
	case 'Y':
		desk_views_fit(d, "front");
		return true;
	default:
		return false;
	}
}

/* ------------------------------------------------------------ mouse words */

enum mouse_mode {
	MOUSE_IDLE,
	MOUSE_VIEW,
	MOUSE_POINTS,
	MOUSE_LIGHT,
	MOUSE_SURFACE,
	MOUSE_CURVE,
	MOUSE_THING,
	MOUSE_JOBS,
	MOUSE_LIST,
	MOUSE_QUESTION,
	MOUSE_BUSY,
	MOUSE_EMPTY,
	N_MOUSE_MODES
};

#define NO_WORDS                                                                                   \
	{                                                                                          \
		"", "", ""                                                                         \
	}
static const struct Mouse_Words word_table[N_MOUSE_MODES] = {
	[MOUSE_IDLE] = { { "ROTATE VIEW", "PAN VIEW", "PROBE POINT" },
	                 { "KEEP VIEW", "", "KEEP MARK" } },
	[MOUSE_VIEW] = { { "ROTATE VIEW", "PAN VIEW", "PROBE POINT" },
	                 { "KEEP VIEW", "", "KEEP MARK" } },
	[MOUSE_POINTS] = { { "PICK POINT", "PAN VIEW", "ROTATE VIEW" },
	                   { "PLACE POINT", "", "KEEP VIEW" } },
	[MOUSE_LIGHT] = { { "MOVE LIGHT", "PAN VIEW", "ROTATE VIEW" },
	                  { "KEEP LIGHT", "", "KEEP VIEW" } },
	[MOUSE_SURFACE] = { { "PICK SURFACE", "PAN VIEW", "PROBE POINT" },
	                    { "", "", "KEEP MARK" } },
	[MOUSE_CURVE] = { { "PICK CURVE", "PAN VIEW", "PROBE POINT" }, { "", "", "KEEP MARK" } },
	[MOUSE_THING] = { { "PICK THING", "PAN VIEW", "PROBE POINT" }, { "", "", "KEEP MARK" } },
	[MOUSE_JOBS] = { { "SELECT JOB", "SCROLL LIST", "" }, NO_WORDS },
	[MOUSE_LIST] = { { "CHOOSE LINE", "SCROLL LIST", "" }, NO_WORDS },
	[MOUSE_QUESTION] = { { "ANSWER", "", "" }, NO_WORDS },
	[MOUSE_BUSY] = { NO_WORDS, NO_WORDS },
	[MOUSE_EMPTY] = { { "CHOOSE ENTRY", "", "" }, NO_WORDS },
};

static enum mouse_mode mode_of(const struct desk *d)
{
	if (d->errand)
		return MOUSE_BUSY;
	if (d->page == PAGE_QUESTION)
		return MOUSE_QUESTION;
	if (d->page == PAGE_JOBS)
		return MOUSE_JOBS;
	if (d->page != PAGE_NONE)
		return MOUSE_LIST;
	if (!world_count(d->world))
		return MOUSE_EMPTY;
	if (d->space)
		return MOUSE_VIEW;
	if (wants_pick(d))
		return d->ask.rows[d->ask.focus].type == ARGUMENT_SURFACE ? MOUSE_SURFACE
		       : d->ask.rows[d->ask.focus].type == ARGUMENT_CURVE ? MOUSE_CURVE
		                                                          : MOUSE_THING;
	if (d->tool == TOOL_POINTS)
		return MOUSE_POINTS;
	if (d->tool == TOOL_LIGHT)
		return MOUSE_LIGHT;
	return MOUSE_IDLE;
}

struct Mouse_Words desk_mouse_words(const struct desk *d)
{
	return word_table[mode_of(d)];
}
