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
	panel_heading(cr, &l->view, "Gaussian curvature",
	              "teapot.map.exr, 400 × 200 samples of the exact surface", true, k);
	panel_key(cr, &l->view, &model_key, k, h);
	panel_probe(cr, &l->view, 0.4 * l->view.width, 0.5 * l->view.height, &model_probe, k);
}

static void paint_long(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu_long, &model_mouse_both, &model_foot_error, &model_top, k, h);
	panel_key(cr, &l->view, &model_key_none, k, h);
}

static void paint_wrong(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu_error, &model_mouse, &model_foot_error, &model_top, k, h);
	panel_tip(cr, l->view.width + l->menu.width, 700, l->form.x + 180, l->form.y + 90,
	          model_menu_error.fields[1].value, k);
	panel_bar(cr, &l->view, &model_bar_long, k, h);
}

static void paint_jobs(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu_jobs, &model_mouse_few, &model_foot_kill, &model_top, k, h);
	panel_jobs(cr, &l->view, &model_jobs, k, h);
	panel_job(cr, l, model_jobs.jobs[7], k);
}

static void paint_jobs_none(cairo_t *cr, const struct layout *l, const struct look *k,
                            struct hits *h)
{
	around(cr, l, &model_menu_jobs, &model_mouse_few, &model_foot_choose, &model_top_none, k,
	       h);
	struct box_px rest = l->view;
	const double bar = panel_bar_height(cr, &l->view, &model_bar);
	rest.y += bar;
	rest.height -= bar;
	panel_jobs(cr, &rest, &model_jobs_none, k, h);
	panel_bar(cr, &l->view, &model_bar, k, h);
}

static void paint_help(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu, &model_mouse, &model_foot, &model_top, k, h);
	panel_help(cr, l, &model_help, k, h);
}

static void paint_search(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu, &model_mouse, &model_foot_choose, &model_top, k, h);
	panel_search(cr, l->view.width + l->menu.width, l->mouse.y + l->mouse.height, &model_search,
	             k, h);
}

static void paint_search_none(cairo_t *cr, const struct layout *l, const struct look *k,
                              struct hits *h)
{
	around(cr, l, &model_menu, &model_mouse, &model_foot_choose, &model_top, k, h);
	panel_search(cr, l->view.width + l->menu.width, l->mouse.y + l->mouse.height,
	             &model_search_none, k, h);
}

static void paint_color(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu_error, &model_mouse, &model_foot_error, &model_top, k, h);
	struct box_px color, light;
	panel_cards_place(l, &color, &light);
	panel_color(cr, &color, &model_color, k, h);
	panel_light(cr, &light, &model_light, k, h);
}

static void paint_empty(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu_main, &model_mouse_few, &model_foot_choose, &model_top_none, k,
	       h);
	panel_empty(cr, &l->view, &model_empty, k, h);
}

static void paint_keys(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu, &model_mouse, &model_foot_choose, &model_top, k, h);
	panel_keys(cr, &l->view, &model_keys, k);
}

static void paint_list(cairo_t *cr, const struct layout *l, const struct look *k, struct hits *h)
{
	around(cr, l, &model_menu, &model_mouse, &model_foot_choose, &model_top, k, h);
	panel_list(cr, &l->view, &model_list, k, h);
}

static void paint_question(cairo_t *cr, const struct layout *l, const struct look *k,
                           struct hits *h)
{
	around(cr, l, &model_menu, &model_mouse, &model_foot_choose, &model_top, k, h);
	panel_list(cr, &l->view, &model_question, k, h);
}

const struct screen screens[] = {
	{ "main", 11, paint_main },          { "long", 14, paint_long },
	{ "wrong", 5, paint_wrong },         { "jobs", 4, paint_jobs },
	{ "jobs-none", 4, paint_jobs_none }, { "help", 11, paint_help },
	{ "search", 11, paint_search },      { "search-none", 11, paint_search_none },
	{ "color", 5, paint_color },         { "empty", 6, paint_empty },
	{ "keys", 11, paint_keys },          { "list", 11, paint_list },
	{ "question", 11, paint_question },
};
const int n_screens = sizeof screens / sizeof *screens;

void screen_draw(cairo_t *cr, const struct screen *s, double width, double height,
                 const struct look *k, struct hits *h)
{
	struct layout l;
	layout_place(&l, width, height, true, s->menu_rows);
	s->paint(cr, &l, k, h);
}

static const struct box_px mouse_box = { 0, 0, 320, 148 };

static void piece_mouse(cairo_t *cr, const struct look *k)
{
	panel_mouse(cr, &mouse_box, &model_mouse, k);
}

static void piece_chips(cairo_t *cr, const struct look *k)
{
	const struct box_px box = { 0, 0, 640, 48 };
	panel_top(cr, &box, &model_top, k, NULL);
}

static void piece_probe(cairo_t *cr, const struct look *k)
{
	const struct box_px box = { 0, 0, 280, 220 };
	panel_probe(cr, &box, 0, 0, &model_probe, k);
}

static void piece_form(cairo_t *cr, const struct look *k)
{
	struct layout l;
	layout_place(&l, 320, 620, true, model_menu_error.n_rows);
	cairo_translate(cr, 0, -l.form.y);
	panel_menu(cr, &l, &model_menu_error, k, NULL);
}

const struct piece pieces[] = {
	{ "mouse", 320, 148, THEME_DARK, piece_mouse },
	{ "chips", 640, 48, THEME_LIGHT, piece_chips },
	{ "probe", 280, 220, THEME_DARK, piece_probe },
	{ "form", 320, 220, THEME_LIGHT, piece_form },
};
const int n_pieces = sizeof pieces / sizeof *pieces;
