/* render_words.c - what a picture of the world shows, in words. */
#include "render.h"

#include <ctype.h>

#include "path.h"
#include "view_private.h"

int render_quantity(const struct world *w, const struct render_options *o)
{
	for (int k = 0; k < world_count(w); k++) {
		const struct Ful *f = world_at(w, k);
		const struct overlay *map = overlay_of(w, OVERLAY_MAP, f->id);
		if (!f->display.on || f->entity.kind != ENTITY_SURFACE ||
		    f->display.look != LOOK_MAP)
			continue;
		if (o->has_quantity)
			return (int)o->quantity;
		if (map)
			return (int)map->quantity;
	}
	return -1;
}

static void add_names(struct text *t, const struct world *w)
{
	enum { NAMED = 3 };
	int n = 0;
	for (int k = 0; k < world_count(w); k++) {
		const struct Ful *f = world_at(w, k);
		if (f->display.on && n++ < NAMED)
			text_addf(t, "%s%s", n > 1 ? ", " : "", f->name);
	}
	if (n > NAMED)
		text_addf(t, " and %d more", n - NAMED);
}

void render_words(const struct world *w, const struct render_options *o, struct text *title,
                  struct text *note)
{
	const int quantity = render_quantity(w, o);
	int lines = 0;
	for (int k = 0; k < world_overlays(w); k++) {
		const struct overlay *x = world_overlay(w, k);
		if (x->kind == OVERLAY_LINES && x->file)
			text_addf(note, "%s%s", lines++ ? ", " : "lines of ",
			          path_file_name(x->file));
	}
	if (o->title)
		text_add(title, o->title);
	else if (quantity >= 0)
		text_add(title, quantity_table[quantity].title);
	else
		add_names(title, w);
	if (title->s && quantity >= 0 && !o->title)
		title->s[0] = (char)toupper((unsigned char)title->s[0]);
	if (quantity >= 0 || o->title) {
		text_add(note, lines ? "; " : "");
		add_names(note, w);
	}
}
