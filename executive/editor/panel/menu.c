/* menu.c - the panel's menu: search and World, where one is, and the entries. */
#include <math.h>
#include <string.h>

#include "paint.h"

enum { ROWS_MAX = 14 };

static void paint_search_button(const struct paint *p, double x, double y)
{
	const double width = 184, height = 28, middle = y + height / 2;
	const bool hot = paint_hot(p, HIT_SEARCH, 0, 0);
	paint_fill(p, x, y, width, height, 6, TOKEN_FIELD);
	paint_border(p, x, y, width, height, 6, 1, hot ? TOKEN_EDGE : TOKEN_LINE);
	paint_lens(p, x + 15, middle - 1, 4);
	paint_text(p, LABEL_FORM, TOKEN_MUTED, x + 28, middle, 0, "Find a routine");
	paint_cap(p, x + width - 6, middle, 1, "/");
	if (paint_focused(p, HIT_SEARCH, 0, 0))
		paint_ring(p, x - 2, y - 2, width + 4, height + 4, 8);
	paint_hit(p, HIT_SEARCH, 0, 0, x, y, width, height);
}

static void paint_world_button(const struct paint *p, double x, double y, double width, bool open)
{
	const double height = 28, middle = y + height / 2;
	if (open) {
		paint_fill(p, x, y, width, height, 6, TOKEN_TINT);
		paint_border(p, x, y, width, height, 6, 1, TOKEN_ACCENT);
	} else {
		paint_raised(p, x, y, width, height, 6);
		if (paint_hot(p, HIT_WORLD, 0, 0)) {
			paint_fill(p, x, y, width, height, 6, TOKEN_HOVER);
			paint_border(p, x, y, width, height, 6, 1, TOKEN_EDGE);
		}
	}
	paint_text(p, LABEL_NAME, TOKEN_TEXT, x + 12, middle, 0, "World");
	paint_cap(p, x + width - 6, middle, 1, "W");
	if (paint_focused(p, HIT_WORLD, 0, 0))
		paint_ring(p, x - 2, y - 2, width + 4, height + 4, 8);
	paint_hit(p, HIT_WORLD, 0, 0, x, y, width, height);
}

static void paint_head(const struct paint *p, const struct box_px *b, const struct menu_model *m)
{
	const double left = b->x + PAINT_PADDING, right = b->x + b->width - PAINT_PADDING;
	const double middle = b->y + 43, cap = paint_cap_width(p, "F1");
	paint_crumbs(p, left, b->y + 20, right - left, m->crumbs);
	/* a long title takes the place of the word beside the key */
	const double word = paint_width(p, LABEL_NOTE, "help") + 8;
	const bool tight = left + paint_width(p, LABEL_TITLE, m->title) + 12 > right - cap - word;
	const double help = tight ? cap : cap + word;
	paint_cap(p, right, middle, 1, "F1");
	if (!tight)
		paint_text(p, LABEL_NOTE,
		           paint_hot(p, HIT_HELP_LINK, -1, 0) ? TOKEN_TEXT : TOKEN_MUTED,
		           right - cap - 8, middle, 1, "help");
	paint_hit(p, HIT_HELP_LINK, -1, 0, right - help - 4, middle - 10, help + 4, 20);
	if (paint_focused(p, HIT_HELP_LINK, -1, 0))
		paint_ring(p, right - help - 4, middle - 12, help + 8, 24, 6);
	paint_cut(p, LABEL_TITLE, TOKEN_TEXT, left, middle, 0, right - left - help - 12, m->title);
}

static void paint_row(const struct paint *p, const struct menu_row *r, int index, double x,
                      double y, double width, double height)
{
	const double middle = y + height / 2, right = x + width - PAINT_PADDING - 4;
	const char key[2] = { r->key, 0 };
	const bool hot = paint_hot(p, HIT_MENU_ROW, index, 0);
	const enum token number = r->greyed ? TOKEN_OFF : r->chosen ? TOKEN_ACCENT : TOKEN_MUTED;
	double end = right, name = x + 44;
	if (r->chosen || hot)
		paint_fill(p, x + 8, y, width - 16, height, 6,
		           r->chosen ? TOKEN_TINT : TOKEN_HOVER);
	if (r->is_menu && !r->greyed) {
		paint_chevron(p, end, middle, TOKEN_TEXT2);
		end -= 16;
	} else if (r->state && !r->greyed && !strcmp(r->state, "shown")) {
		paint_check(p, end - 4.5, middle, 9, TOKEN_ACCENT);
		end -= 18;
	}
	paint_text(p, LABEL_NAME, number, x + 26, middle, 0.5, key);
	/* the name comes first, the state has what is left, though never less than a third */
	const double wanted = paint_width(p, LABEL_ENTRY, r->name);
	const double room = fmax(end - name - wanted - 10, (end - name) / 3);
	const bool stated = r->state && r->state[0];
	if (stated)
		end -= paint_cut(p, LABEL_NOTE, r->greyed ? TOKEN_OFF : TOKEN_MUTED, end, middle, 1,
		                 room, r->state) +
		       10;
	paint_cut(p, r->chosen ? LABEL_PROMPT : LABEL_ENTRY, r->greyed ? TOKEN_OFF : TOKEN_TEXT,
	          name, middle, 0, end - name, r->name);
	if (paint_focused(p, HIT_MENU_ROW, index, 0))
		paint_ring(p, x + 8, y, width - 16, height, 6);
	paint_hit(p, HIT_MENU_ROW, index, 0, x + 8, y, width - 16, height);
}

void panel_menu(cairo_t *cr, const struct layout *l, const struct menu_model *m,
                const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const struct box_px *b = &l->menu, *top = &l->panel_top;
	const int n = m->n_rows < ROWS_MAX ? m->n_rows : ROWS_MAX;
	if (b->width <= 0)
		return;
	paint_fill(&p, b->x, top->y, b->width, l->mouse.y - top->y, 0, TOKEN_BAR);
	paint_rule_down(&p, b->x, top->y, l->mouse.y - top->y);
	paint_rule(&p, top->x, top->y + top->height - 1, top->width);
	const double world = 96, x = top->x + PAINT_PADDING;
	paint_search_button(&p, x, top->y + 10);
	paint_world_button(&p, x + 192, top->y + 10, world, m->world_open);

	paint_head(&p, b, m);
	for (int i = 0; i < n; i++)
		paint_row(&p, &m->rows[i], i, b->x, b->y + PAINT_MENU_HEAD + i * l->menu_row,
		          b->width, l->menu_row);
	if (m->form_title)
		paint_form(&p, l, m);
}
