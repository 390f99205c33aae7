/* bench_panel.c - time what the window paints beside its views: each part, as when its model changed. */
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "canvas.h"
#include "panel_models.h"

enum { WIDTH = 1280, HEIGHT = 800, ROUNDS = 41 };
static const double limit_ms = 3;

struct part {
	const char *name;
	void (*paint)(struct canvas *c, const struct layout *l);
};

static void top(struct canvas *c, const struct layout *l)
{
	panel_top(c->cr, &l->top, &model_top, &c->look, &c->hits);
}

static void menu(struct canvas *c, const struct layout *l)
{
	panel_menu(c->cr, l, &model_menu, &c->look, &c->hits);
}

static void mouse(struct canvas *c, const struct layout *l)
{
	panel_mouse(c->cr, &l->mouse, &model_mouse, &c->look);
}

static void foot(struct canvas *c, const struct layout *l)
{
	panel_foot(c->cr, l, &model_foot, &c->look, &c->hits);
}

static void probe(struct canvas *c, const struct layout *l)
{
	panel_probe(c->cr, &l->view, 300, 300, &model_probe, &c->look);
}

static void key(struct canvas *c, const struct layout *l)
{
	panel_key(c->cr, &l->view, &model_key, &c->look, &c->hits);
}

static void jobs(struct canvas *c, const struct layout *l)
{
	panel_jobs(c->cr, &l->view, &model_jobs, &c->look, &c->hits);
}

static void search(struct canvas *c, const struct layout *l)
{
	(void)l;
	panel_search(c->cr, WIDTH, HEIGHT, &model_search, &c->look, &c->hits);
}

static void help(struct canvas *c, const struct layout *l)
{
	panel_help(c->cr, l, &model_help, &c->look, &c->hits);
}

static void color(struct canvas *c, const struct layout *l)
{
	struct box_px color_box, light_box;
	panel_cards_place(l, &color_box, &light_box);
	panel_color(c->cr, &color_box, &model_color, &c->look, &c->hits);
	panel_light(c->cr, &light_box, &model_light, &c->look, &c->hits);
}

static const struct part parts[] = {
	{ "top bar", top },       { "menu and form", menu },
	{ "mouse", mouse },       { "message and prompt", foot },
	{ "probe", probe },       { "color key", key },
	{ "list of jobs", jobs }, { "search", search },
	{ "help", help },         { "color and light", color },
};

static double median_ms(const struct part *p, double scale)
{
	struct canvas c;
	struct layout l;
	double *took = bench_room(ROUNDS);
	canvas_init(&c, WIDTH, HEIGHT, scale, THEME_DARK, 0);
	layout_place(&l, WIDTH, HEIGHT, true, model_menu.n_rows);
	for (int i = 0; i < ROUNDS; i++) {
		hits_reset(&c.hits);
		const double begin = bench_cpu();
		p->paint(&c, &l);
		cairo_surface_flush(c.surface);
		took[i] = 1e3 * (bench_cpu() - begin);
	}
	const double median = bench_median(took, ROUNDS);
	free(took);
	canvas_finish(&c);
	return median;
}

int main(void)
{
	for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
		for (int scale = 1; scale <= 2; scale++) {
			char what[64];
			snprintf(what, sizeof what, "paint %s, scale %d", parts[i].name, scale);
			bench_print(&(struct bench_row){ .row = "editor",
			                                 .what = what,
			                                 .unit = "ms",
			                                 .ours = median_ms(&parts[i], scale),
			                                 .target = limit_ms,
			                                 .less = true });
		}
	canvas_forget_fonts();
	return 0;
}
