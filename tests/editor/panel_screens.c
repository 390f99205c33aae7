/* panel_screens.c - whole screens of the window. */
#include "panel_screens.h"

#include "panel_models.h"

static void ground(cairo_t *cr, const struct layout *l, const struct look *k)
{
	struct rgb c = theme_color(k->theme, TOKEN_VIEW);
	cairo_set_source_rgb(cr, c.r, c.g, c.b);
	cairo_rectangle(cr, l->view.x, l->view.y, l->view.width, l->view.height);
	cairo_fill(cr);
}

static void around(cairo_t *cr, const struct layout *l, const struct menu_model *menu,
                   const struct Mouse_Words *mouse, const struct foot_model *foot,
                   const struct top_model *top, const struct look *k, struct hits *h)
{
	ground(cr, l, k);
	panel_menu(cr, l, menu, k, h);
	panel_mouse(cr, &l->mouse, mouse, k);
	panel_top(cr, &l->top, top, k, h);
	panel_foot(cr, l, foot, k, h);
}

static void paint_main(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu, &model_mouse, &model_foot, &model_top, k, h);
}

static void paint_long(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu_long, &model_mouse_both, &model_foot_error, &model_top, k, h);
}

static void paint_wrong(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu_error, &model_mouse, &model_foot_error, &model_top, k, h);
}

const struct screen screens[] = {
	{ "main", 11, paint_main },
	{ "long", 14, paint_long },
	{ "wrong", 5, paint_wrong },
};
const int n_screens = sizeof screens / sizeof *screens;

void screen_draw(cairo_t *cr, const struct screen *s, double width, double height,
                 const struct look *k, struct hits *h)
{
	struct layout l;
	layout_place(&l, width, height, true, s->menu_rows);
	cairo_save(cr);
	cairo_scale(cr, k->scale, k->scale);
	s->paint(cr, &l, k, h);
	cairo_restore(cr);
}
