/* render_tiles.c - the views of a picture: where each is, from where it looks, and its words. */
#include <math.h>

#include "render.h"

enum { KEY_COLUMN = 112 };

static enum view_split split_of(const struct world *w, enum picture_views views)
{
	const struct sight *s = world_sight((struct world *)w);

	return views == PICTURE_SHOWN        ? world_shows_seven(w) ? SPLIT_ONE : s->split
	       : views == PICTURE_CURVATURES ? SPLIT_ONE
	                                     : (enum view_split)(views - PICTURE_ONE);
}

/* From where each looks: as the one there is, but for the second of two sides. */
static enum status place_cameras(struct render_tiles *tiles, const struct world *w,
                                 const struct render_options *o, enum view_split split,
                                 const struct report *r)
{
	const struct sight *sight = world_sight((struct world *)w);
	enum status st = ST_OK;
	for (int i = 0; i < tiles->n && st == ST_OK; i++) {
		struct render_tile *t = &tiles->tile[i];
		struct camera *c = &t->state.camera;
		const bool beside = i && split == SPLIT_SIDE;
		const int width = (int)fmax(lrint(t->seen / o->scale), 1),
		          height = (int)fmax(lrint(t->height / o->scale), 1);
		const int only = t->state.only;
		if (beside && (o->beside || !sight->has_beside))
			st = view_fit(&t->state, w, o->beside ? o->beside : "top", width, height,
			              r);
		else if (i && !beside)
			*c = tiles->tile[0].state.camera;
		else if (beside)
			*c = sight->beside;
		else if (o->view || !sight->has_camera) {
			t->state.only = 0; /* what is seen in one view is seen in each */
			st = view_fit(&t->state, w, o->view, width, height, r);
			t->state.only = only;
		} else
			*c = sight->camera;
		c->width = width;
		c->height = height;
	}
	return st;
}

/* Beside seven there is room to say what all are of. */
static void add_eighth(struct render_tiles *tiles, const struct world *w,
                       const struct render_options *o)
{
	const struct render_tile *above = &tiles->tile[3], *left = &tiles->tile[6];
	struct render_tile *t = &tiles->tile[tiles->n++];
	*t = (struct render_tile){ .x = above->x,
		                   .y = left->y,
		                   .width = above->width,
		                   .height = left->height,
		                   .seen = above->width,
		                   .is_empty = true };
	if (o->title)
		text_add(&t->title, o->title);
	else
		render_add_names(&t->title, w);
	render_add_note(&t->note, w, o->title != NULL);
}

enum status render_tiles_init(struct render_tiles *tiles, const struct world *w,
                              const struct render_options *o, bool lines, const struct report *r)
{
	const enum view_split split = split_of(w, o->views);
	const bool curvatures = !lines && (o->views == PICTURE_CURVATURES ||
	                                   (o->views == PICTURE_SHOWN && world_shows_seven(w)));
	struct tile_px px[N_QUANTITIES];
	tiles->n = view_tiles(split, curvatures, o->width, o->height, px);
	const double column = fmin(KEY_COLUMN * o->scale, px[0].width / 2);
	for (int i = 0; i < tiles->n; i++) {
		struct render_tile *t = &tiles->tile[i];
		*t = (struct render_tile){
			.x = (int)px[i].x,
			.y = (int)px[i].y,
			.width = (int)px[i].width,
			.height = (int)px[i].height,
			.seen = (int)(px[i].width - (curvatures ? column : 0)),
			.is_plane = i && split == SPLIT_UV,
			.has_key = !i || curvatures || split == SPLIT_CHILD,
			.state = { .theme = o->theme,
			           .scale = o->scale,
			           .place = i,
			           .quantity = curvatures        ? i
			                       : o->has_quantity ? (int)o->quantity
			                                         : -1,
			           .only = view_tile_only(w, split, i),
			           .axes = tiles->n <= 2,
			           .hover_point = -1 },
		};
		if (curvatures) /* each has its own */
			render_add_quantity(&t->title, i);
		else if (tiles->n == 1 || !view_tile_words(w, split, i, &t->title, &t->note))
			render_words(w, o, &t->title, &t->note);
	}
	if (curvatures)
		add_eighth(tiles, w, o);
	return place_cameras(tiles, w, o, split, r);
}

void render_tiles_finish(struct render_tiles *tiles)
{
	for (int i = 0; i < tiles->n; i++) {
		text_finish(&tiles->tile[i].title);
		text_finish(&tiles->tile[i].note);
	}
}
