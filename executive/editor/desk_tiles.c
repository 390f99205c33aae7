/* desk_tiles.c - the views: where they are, what each shows, and from where it looks. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

/* ------------------------------------------------------------ where they are */

static void place_tiles(struct desk *d)
{
	const struct box_px v = d->layout.view;
	struct tile_px px[N_QUANTITIES];
	const int n = view_tiles(d->split, d->n_tiles == N_QUANTITIES, v.width, v.height, px);

	for (int i = 0; i < n; i++)
		d->tiles[i].box =
		        (struct box_px){ v.x + px[i].x, v.y + px[i].y, px[i].width, px[i].height };
}

static void size_camera(struct desk_tile *t)
{
	t->view.camera.width = (int)t->box.width;
	t->view.camera.height = (int)t->box.height;
}

/* Which of the things a view shows; a child that is not there yet leaves its view empty. */
static void choose_things(struct desk *d)
{
	for (int i = 0; i < d->n_tiles; i++)
		d->tiles[i].view.only = view_tile_only(d->world, d->split, i);
}

/* The second view of the same begins beside the first. */
static void look_beside(struct desk *d)
{
	const struct sight *s = world_sight(d->world);
	struct view_state *v = &d->tiles[1].view;

	if (s->has_beside)
		v->camera = s->beside;
	size_camera(&d->tiles[1]);
	if (!s->has_beside && world_count(d->world))
		view_fit(v, d->world, "top", v->camera.width, v->camera.height, &report_none);
}

static void split_views(struct desk *d)
{
	const struct sight *s = world_sight(d->world);
	const enum view_split was = d->split;
	const int before = d->n_tiles;
	const bool seven = world_shows_seven(d->world);

	d->split = seven ? SPLIT_ONE : s->split;
	d->n_tiles = seven ? N_QUANTITIES : d->split == SPLIT_ONE ? 1 : 2;
	for (int i = 0; i < d->n_tiles; i++) {
		if (i >= before)
			d->tiles[i].view = d->tiles[0].view;
		d->tiles[i].is_uv = i == 1 && d->split == SPLIT_UV;
	}
	if (d->tile >= d->n_tiles)
		d->tile = 0;
	choose_things(d);
	d->split_anew |= before != d->n_tiles || was != d->split;
}

/* Nobody has moved since everything was fitted into the view. */
static bool is_as_fitted(const struct desk *d)
{
	const struct camera *c = &d->tiles[0].view.camera, *f = &d->camera_fitted;

	return d->fitted && c->kind == f->kind && c->half == f->half &&
	       !memcmp(&c->eye, &f->eye, sizeof c->eye) &&
	       !memcmp(&c->ahead, &f->ahead, sizeof c->ahead);
}

void desk_views_place(struct desk *d)
{
	const struct box_px was = d->tiles[0].box;

	if (!d->errand)
		split_views(d);
	const int n = d->n_tiles;
	place_tiles(d);
	const bool resized =
	        was.width != d->tiles[0].box.width || was.height != d->tiles[0].box.height;
	const bool again = resized && is_as_fitted(d);
	for (int i = 0; i < n; i++) {
		struct view_state *v = &d->tiles[i].view;
		v->theme = d->theme;
		v->scale = d->scale;
		v->place = i;
		v->quantity = n == N_QUANTITIES ? i : -1;
		v->axes = n <= 2;
		size_camera(&d->tiles[i]);
		if (!v->hover_thing)
			v->hover_point = -1;
	}
	if ((!d->split_anew && !again) || d->errand || !d->fitted)
		return;
	d->tile = 0;
	desk_views_fit(d, NULL); /* what was seen in one view is seen in each */
}

/* ------------------------------------------------------------ from where they look */

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

/* Is that view turned by itself? */
static bool stands_alone(const struct desk *d, int tile)
{
	return d->split == SPLIT_SIDE && tile == 1;
}

static void give_camera(struct desk *d, const struct camera *c)
{
	for (int i = 0; i < d->n_tiles; i++)
		if (!stands_alone(d, i)) {
			d->tiles[i].view.camera = *c;
			size_camera(&d->tiles[i]);
		}
	d->fitted = true;
	if (d->split_anew && d->split == SPLIT_SIDE)
		look_beside(d);
	d->split_anew = false;
	desk_dirty(d, DESK_VIEW | desk_bit(PART_PROBE));
}

/* A routine has set it. */
void desk_views_adopt(struct desk *d)
{
	const struct sight *s = world_sight(d->world);

	if (!s->has_camera || !memcmp(&s->camera, &d->camera_seen, sizeof s->camera))
		return;
	d->camera_seen = s->camera;
	give_camera(d, &d->camera_seen);
}

/* Views look from the same place, but for one that stands alone; the world keeps it for the session. */
void desk_views_spread(struct desk *d, int from)
{
	struct sight *s = world_sight(d->world);
	const struct camera c = d->tiles[from].view.camera;

	if (stands_alone(d, from)) {
		s->beside = c;
		s->has_beside = true;
		desk_dirty(d, DESK_VIEW | desk_bit(PART_PROBE));
	} else {
		give_camera(d, &c);
		s->camera = c;
		s->has_camera = true;
		d->camera_seen = s->camera;
	}
	name_view(d);
}

void desk_views_fit(struct desk *d, const char *view)
{
	struct desk_tile *t = &d->tiles[d->tile];
	struct sight *s = world_sight(d->world);
	struct report_store store;

	if (d->errand || !world_count(d->world))
		return;
	if (t->is_uv && d->fitted && (!view || !strcmp(view, "three-quarter"))) {
		desk_uv_fit(d);
		return;
	}
	if (t->is_uv)
		t = &d->tiles[0];
	report_store_init(&store);
	if (!view && !d->fitted && s->has_camera) { /* as the last session left it */
		desk_views_adopt(d);
		return;
	}
	if (!view && !d->fitted)
		view = "three-quarter";
	if (t->view.only < 0) /* nothing is there to be fitted */
		t = &d->tiles[0];
	if (view_fit(&t->view, d->world, view, (int)t->box.width, (int)t->box.height,
	             &store.report) != ST_OK) {
		desk_say(d, REPORT_ERROR, "%s", store.error);
		return;
	}
	desk_views_spread(d, (int)(t - d->tiles));
	d->camera_fitted = d->tiles[0].view.camera;
}

/* ------------------------------------------------------------ one or two */

/* By key from one way to split to the next that has something to show. */
void desk_split_next(struct desk *d)
{
	const struct Ful *parent, *child;
	enum view_split to = d->split;

	if (desk_busy(d))
		return;
	do
		to = (enum view_split)((to + 1) % N_SPLITS);
	while ((to == SPLIT_CHILD && !world_family(d->world, &parent, &child)) ||
	       (to == SPLIT_UV && !desk_uv_surface(d)));
	desk_run_code(d, "V188", "views", view_split_words[to]);
}

/* ------------------------------------------------------------ asked from outside */

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
