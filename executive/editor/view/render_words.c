/* render_words.c - what a picture shows, in words. */
#include <ctype.h>

#include "path.h"
#include "render.h"
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

void render_add_names(struct text *t, const struct world *w)
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

void render_add_note(struct text *note, const struct world *w, bool named)
{
	int lines = 0;
	for (int k = 0; k < world_overlays(w); k++) {
		const struct overlay *x = world_overlay(w, k);
		if (x->kind == OVERLAY_LINES && x->file)
			text_addf(note, "%s%s", lines++ ? ", " : "lines of ",
			          path_file_name(x->file));
	}
	if (named) {
		text_add(note, lines ? "; " : "");
		render_add_names(note, w);
	}
}

void render_add_quantity(struct text *title, int quantity)
{
	const size_t at = title->n;
	text_add(title, quantity_table[quantity].title);
	if (title->s)
		title->s[at] = (char)toupper((unsigned char)title->s[at]);
}

void render_words(const struct world *w, const struct render_options *o, struct text *title,
                  struct text *note)
{
	const int quantity = render_quantity(w, o);
	const struct overlay *image = overlay_of(w, OVERLAY_IMAGE, 0);
	if (image && image->file && !world_sight((struct world *)w)->no_image) {
		if (o->title)
			text_add(title, o->title);
		else
			render_add_names(title, w);
		text_add(note, path_file_name(image->file));
		return;
	}
	if (o->title)
		text_add(title, o->title);
	else if (quantity >= 0)
		render_add_quantity(title, quantity);
	else
		render_add_names(title, w);
	render_add_note(note, w, quantity >= 0 || o->title);
}
