/* tiles.c - views beside each other: where each is, and what it shows. */
#include <math.h>

#include "view.h"

const char *const picture_views_words[N_PICTURE_VIEWS] = { "shown", "one", "side",
	                                                   "child", "uv",  "curvatures" };

int view_tiles(enum view_split split, bool curvatures, double width, double height,
               struct tile_px out[N_QUANTITIES])
{
	const int n = curvatures ? N_QUANTITIES : split == SPLIT_ONE ? 1 : 2;
	const int columns = n == 1 ? 1 : n == 2 ? (split == SPLIT_UV) + 1 : 4;
	const int rows = (n + columns - 1) / columns;

	for (int i = 0; i < n; i++) {
		const double x0 = round(width * (i % columns) / columns);
		const double x1 = round(width * (i % columns + 1) / columns);
		const double y0 = round(height * (i / columns) / rows);
		const double y1 = round(height * (i / columns + 1) / rows);
		out[i] = (struct tile_px){ x0, y0, x1 - x0, y1 - y0 };
		if (n > 1) { /* the rule between them */
			out[i].width -= x1 < width;
			out[i].height -= y1 < height;
		}
	}
	return n;
}

int view_tile_only(const struct world *w, enum view_split split, int half)
{
	const struct Ful *parent = NULL, *child = NULL;

	if (split != SPLIT_CHILD)
		return 0;
	world_family(w, &parent, &child);
	const struct Ful *f = half ? child : parent;
	return f ? f->id : -1;
}

const struct Ful *view_plane_surface(const struct world *w)
{
	const struct Ful *f = world_selected(w);

	if (f && f->entity.kind == ENTITY_CURVE_ON_SURFACE && world_by_id(w, f->on))
		return world_by_id(w, f->on);
	return world_current(w, false);
}

bool view_tile_words(const struct world *w, enum view_split split, int half, struct text *title,
                     struct text *note)
{
	const struct Ful *parent, *child, *f;

	if (split == SPLIT_SIDE && half)
		text_add(note, "from another side");
	if (split == SPLIT_UV && half && (f = view_plane_surface(w))) {
		const double(*domain)[2] = (const double(*)[2])f->entity.geometry.domain;
		text_addf(title, "Parameter plane of %s", f->name);
		text_addf(note, "u %g to %g, v %g to %g; thin lines are knots", domain[0][0],
		          domain[0][1], domain[1][0], domain[1][1]);
		return true;
	}
	if (split != SPLIT_CHILD)
		return false;
	if (!world_family(w, &parent, &child) && half) {
		text_add(title, "No child yet");
		text_add(note, "what is copied or offset from it will stand here");
		return true;
	}
	text_add(title, half ? child->name : parent ? parent->name : "");
	text_add(note, half ? "child" : "parent");
	if (half && child->offset_of == parent->id)
		text_addf(note, ", %g from its parent", child->offset);
	return true;
}
