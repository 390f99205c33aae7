/* desk_colorkey.c - the key of the map that is shown; its ends are dragged to set the range by hand, a
 * double click goes back to the one found from the values. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"
#include "number.h"
#include "text.h"

static const double DOUBLE_CLICK_S = 0.4;

static const struct overlay *shown_map(const struct desk *d)
{
	if (desk_image(d)) /* it covers the map */
		return NULL;
	for (int i = world_overlays(d->world) - 1; i >= 0; i--)
		if (world_overlay(d->world, i)->kind == OVERLAY_MAP)
			return world_overlay(d->world, i);
	return NULL;
}

static const char *unit_of(struct desk *d, struct scraps *s, const struct overlay *o,
                           enum quantity q)
{
	const struct Ful *f = world_by_id(d->world, o->thing);
	const char *unit = f && f->unit ? f->unit : "unit";

	return quantity_table[q].power == 2 ? scraps_print(s, "1/%s²", unit)
	                                    : scraps_print(s, "1/%s", unit);
}

static const char *note_of(struct scraps *s, const struct colormap *m)
{
	return scraps_print(s, "%s%s\n%s", m->by_hand ? "by hand" : "2 – 98 %",
	                    m->is_signed && m->lo == -m->hi ? "\nsymmetric" : "",
	                    m->arsinh ? "arsinh" : "linear");
}

static const char *const symbol[N_QUANTITIES] = { "K", "H", "|k|", "k max", "k min", "k u", "k v" };

/* The surface is to show values, and those it had belong to what it was. */
static void paint_no_values(struct desk *d, cairo_t *cr, const struct box_px *view)
{
	const struct Ful *f = world_current(d->world, false);
	struct key_model m = { .title = "", .note = "", .unit = "" };

	if (!f || f->display.look != LOOK_MAP || !f->display.on || desk_image(d))
		return;
	m.symbol = symbol[d->quantity];
	m.button = "CALCULATE";
	panel_key(cr, view, &m, &d->look, &d->hits[PART_OVER]);
}

/* Its button. */
void desk_key_calculate(struct desk *d)
{
	char code[16];

	snprintf(code, sizeof code, "V%d", 80 + (int)d->quantity);
	desk_run_code(d, world_sight(d->world)->all_curvatures ? "V79" : code, NULL, NULL);
}

/* low: what a bar takes at the top. */
void desk_paint_keys(struct desk *d, cairo_t *cr, struct scraps *s, double low)
{
	struct box_px view = d->layout.view;
	const struct overlay *o = shown_map(d);
	struct key_model m = { .title = "", .note = "", .symbol = "", .unit = "" };
	struct key k;

	view.y += low;
	view.height -= low;
	if (!o) {
		paint_no_values(d, cr, &view);
		return;
	}
	d->quantity = o->quantity;
	/* of seven views the key is that of the one with the keyboard, in the place of an eighth */
	bool seven = d->n_tiles == N_QUANTITIES;
	enum quantity q = seven ? (enum quantity)d->tile : o->quantity;
	struct box_px eighth = d->tiles[N_QUANTITIES - 1].box;
	eighth.x = d->tiles[3].box.x;
	m.symbol = symbol[q];
	m.title = quantity_table[q].title;
	m.unit = unit_of(d, s, o, q);
	if (d->ports.key && d->ports.key(d->ports.data, &k)) {
		m.map = k.map;
		m.below = k.below;
		m.above = k.above;
		m.nothing = k.nothing;
		m.note = note_of(s, &k.map);
		d->key_map = k.map;
	} else {
		m.note = "no values yet";
	}
	panel_key(cr, seven ? &eighth : &view, &m, &d->look, &d->hits[PART_OVER]);
}

/* Of every map that is shown: they have one key. */
static void set_range(struct desk *d, bool given, double lo, double hi)
{
	for (int k = 0; k < world_overlays(d->world); k++) {
		struct overlay o = *world_overlay(d->world, k);
		char *file = o.file ? strdup(o.file) : NULL; /* the old one goes */
		if (o.kind == OVERLAY_MAP) {
			o.range_given = given;
			o.lo = lo;
			o.hi = hi;
			o.symmetric = false;
			o.file = file;
			if (world_show(d->world, &o) != ST_OK)
				desk_say(d, REPORT_ERROR, "memory ran out");
		}
		free(file);
	}
	desk_dirty(d, DESK_VIEW | desk_bit(PART_OVER));
}

/* As the leaf that shows the quantity would have set it. Of seven views there is no such leaf. */
void desk_key_keep(struct desk *d)
{
	static const char *const scale[] = { [COLORMAP_LINEAR] = "linear",
		                             [COLORMAP_ARSINH] = "arsinh",
		                             [COLORMAP_AUTOMATIC] = "auto" };
	const struct overlay *o = shown_map(d);
	char code[16], lo[NUMBER_SIZE], hi[NUMBER_SIZE];

	if (!o || d->n_tiles == N_QUANTITIES)
		return;
	snprintf(code, sizeof code, "V%d", 80 + (int)o->quantity);
	number_write(lo, o->lo);
	number_write(hi, o->hi);
	char *range = o->range_given ? text_print("%s,%s", lo, hi) : strdup("auto");
	const char *const pairs[] = { "range",     range ? range : "auto",
		                      "scale",     scale[o->scale],
		                      "symmetric", "no",
		                      "surfaces",  "shown",
		                      NULL };
	desk_journal(d, code, pairs);
	free(range);
}

bool desk_key_press(struct desk *d, const struct hit *h)
{
	if (h->kind != HIT_KEY_LOW && h->kind != HIT_KEY_HIGH)
		return false;
	if (d->errand)
		return true;
	if (d->now - d->click_at < DOUBLE_CLICK_S) {
		set_range(d, false, 0, 1);
		desk_key_keep(d);
		return true;
	}
	d->click_at = d->now;
	d->drag = DRAG_KEY;
	d->card_kind = h->kind;
	d->key_before = d->key_map;
	d->key_px = 2 * (h->height - 14); /* each half has 14 px beyond its end */
	return true;
}

/* An end goes with the mouse along the scale as it was when it was taken. */
void desk_key_move(struct desk *d)
{
	const struct colormap *m = &d->key_before;
	double shift = (d->down_y - d->y) / fmax(d->key_px, 1);
	double lo = m->lo, hi = m->hi;

	if (d->card_kind == HIT_KEY_HIGH)
		hi = colormap_value(m, 1 + shift);
	else
		lo = colormap_value(m, shift);
	if (lo < hi)
		set_range(d, true, lo, hi);
}
