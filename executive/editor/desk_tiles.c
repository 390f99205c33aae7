/* desk_tiles.c - the views: where they are, and from where each looks. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

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
		v->place = i;
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
void desk_views_spread(struct desk *d, int from)
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
	desk_views_spread(d, d->tile);
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
