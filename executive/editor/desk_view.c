/* desk_view.c - how the mouse and the keys turn the views. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

enum { TURN_DEGREES = 5, PAN_PX = 40 };

static const double ZOOM_STEP = 1.15;

static enum drag_kind drag_of(const struct desk *d, enum desk_button b, unsigned mods)
{
	if (b == BUTTON_MIDDLE)
		return DRAG_PAN;
	if (d->tiles[d->tile].is_uv && (b == BUTTON_RIGHT || d->space || d->tool != TOOL_POINTS))
		return b == BUTTON_RIGHT ? DRAG_PROBE : DRAG_PAN;
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
	if (b == BUTTON_LEFT && desk_pick_wanted(d) && !d->space) {
		desk_pick_give(d);
		return true;
	}
	d->drag = drag_of(d, b, mods);
	d->camera_before = d->tiles[i].view.camera;
	memcpy(d->uv_before, d->uv_range, sizeof d->uv_before);
	d->tiles[i].view.has_pivot = false;
	if (d->drag == DRAG_POINT && !desk_point_press(d, mods & MOD_SHIFT))
		d->drag = DRAG_NONE;
	if (d->drag == DRAG_PROBE)
		desk_probe(d);
	if (d->drag == DRAG_LIGHT)
		desk_tool_move(d);
	desk_dirty(d, desk_bit(PART_MOUSE));
	return true;
}

void desk_view_move(struct desk *d, double dx, double dy)
{
	struct view_state *v = &d->tiles[d->tile].view;

	if (d->tiles[d->tile].is_uv && d->drag == DRAG_PAN) {
		desk_uv_pan(d, dx, dy);
		return;
	}
	switch (d->drag) {
	case DRAG_ROTATE:
		view_rotate(v, d->world, dx, dy);
		desk_views_spread(d, d->tile);
		break;
	case DRAG_PAN:
		view_pan(v, dx, dy);
		desk_views_spread(d, d->tile);
		break;
	case DRAG_PROBE:
		desk_probe(d);
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
		desk_probe_keep(d);
	if (was == DRAG_POINT)
		desk_point_release(d, true);
	if (was == DRAG_KEY && d->drag_moved)
		desk_key_keep(d);
	if (was == DRAG_ROTATE || was == DRAG_PAN)
		desk_dirty(d, DESK_VIEW); /* at rest it is drawn better */
}

void desk_drag_cancel(struct desk *d)
{
	enum drag_kind was = d->drag;

	d->drag = DRAG_NONE;
	if (was == DRAG_ROTATE || was == DRAG_PAN) {
		memcpy(d->uv_range, d->uv_before, sizeof d->uv_range);
		d->tiles[d->tile].view.camera = d->camera_before;
		if (!d->tiles[d->tile].is_uv)
			desk_views_spread(d, d->tile);
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
	if (d->tiles[i].is_uv) {
		desk_uv_zoom(d, pow(ZOOM_STEP, dy), d->x, d->y);
		return;
	}
	view_zoom(&d->tiles[i].view, d->world, pow(ZOOM_STEP, dy), d->x - d->tiles[i].box.x,
	          d->y - d->tiles[i].box.y);
	desk_views_spread(d, i);
}

/* ------------------------------------------------------------ keys */

static void arrow(struct desk *d, double x, double y, unsigned mods)
{
	struct desk_tile *t = &d->tiles[d->tile];
	/* as many px as turn by the step: the view's smaller side is half a turn */
	double px = fmin(t->box.width, t->box.height) * TURN_DEGREES / 180;

	if (t->is_uv) {
		if (mods & MOD_CTRL)
			desk_uv_zoom(d, y < 0 || x > 0 ? ZOOM_STEP : 1 / ZOOM_STEP,
			             t->box.x + t->box.width / 2, t->box.y + t->box.height / 2);
		else
			desk_uv_pan(d, PAN_PX * x, PAN_PX * y);
		return;
	}
	if (mods & MOD_CTRL)
		view_zoom(&t->view, d->world, y < 0 || x > 0 ? ZOOM_STEP : 1 / ZOOM_STEP,
		          t->box.width / 2, t->box.height / 2);
	else if (mods & MOD_SHIFT)
		view_pan(&t->view, PAN_PX * x, PAN_PX * y);
	else
		view_rotate(&t->view, d->world, px * x, px * y);
	desk_views_spread(d, d->tile);
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
