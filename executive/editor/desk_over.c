/* desk_over.c - what lies over the view: headings, color keys, bars, the probe; and painting. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "curvature.h"
#include "desk_inside.h"
#include "path.h"

/* ------------------------------------------------------------ headings */

static const struct overlay *shown_map(const struct desk *d)
{
	for (int i = world_overlays(d->world) - 1; i >= 0; i--)
		if (world_overlay(d->world, i)->kind == OVERLAY_MAP)
			return world_overlay(d->world, i);
	return NULL;
}

static const char *in_capital(struct scraps *s, const char *text)
{
	char *out = (char *)scraps_print(s, "%s", text);

	if (*out >= 'a' && *out <= 'z')
		*out = (char)(*out - 'a' + 'A');
	return out;
}

/* The image that is in the view. */
const struct overlay *desk_image(const struct desk *d)
{
	for (int i = world_overlays(d->world) - 1; i >= 0; i--)
		if (world_overlay(d->world, i)->kind == OVERLAY_IMAGE &&
		    !world_sight(d->world)->no_image)
			return world_overlay(d->world, i);
	return NULL;
}

/* What the view shows, and where it comes from. */
static const char *heading(struct desk *d, struct scraps *s, const char **note)
{
	const struct Ful *f = world_current(d->world, false);
	int lines = 0, maps = 0, shown = 0;
	const struct overlay *map = shown_map(d), *image = desk_image(d), *line = NULL;

	*note = "";
	for (int i = 0; i < world_overlays(d->world); i++) {
		const struct overlay *o = world_overlay(d->world, i);
		lines += o->kind == OVERLAY_LINES;
		maps += o->kind == OVERLAY_MAP;
		if (o->kind == OVERLAY_LINES)
			line = o;
	}
	const struct overlay *of = image ? image : map;
	if (of == map && maps > 1)
		*note = scraps_print(s, "of %d surfaces", maps);
	else if (of && of->file)
		*note = of->job ? scraps_print(s, "arriving from job %lld", (long long)of->job)
		                : scraps_print(s, "%s", path_file_name(of->file));
	if (image) {
		*note = scraps_print(s, "%s; I shows the things again", *note);
		return "Image";
	}
	if (map)
		return in_capital(s, quantity_table[map->quantity].title);
	if (lines == 1 && line->job)
		*note = scraps_print(s, "lines arriving from job %lld", (long long)line->job);
	else if (lines == 1 && line->file)
		*note = scraps_print(s, "with the lines of %s", path_file_name(line->file));
	else if (lines)
		*note = scraps_print(s, "with the lines of %d results", lines);
	if (!f)
		f = world_current(d->world, true);
	for (int i = 0; i < world_count(d->world); i++)
		shown += world_at(d->world, i)->display.on;
	if (!lines && shown > 1)
		*note = scraps_print(s, "current of %d that are shown", shown);
	return f ? f->name : "";
}

/* Of a window split in two: which half it is. */
static const char *half_heading(struct desk *d, struct scraps *s, int half, const char *title,
                                const char **note)
{
	struct text name = { .s = NULL }, more = { .s = NULL };

	if (view_tile_words(d->world, d->split, half, &name, &more))
		title = scraps_print(s, "%s", name.s ? name.s : "");
	if (more.s)
		*note = scraps_print(s, "%s", more.s);
	text_finish(&name);
	text_finish(&more);
	return title;
}

static void tile_headings(struct desk *d, cairo_t *cr, struct scraps *s, double low)
{
	const char *note;

	for (int i = 0; i < d->n_tiles; i++) {
		const struct desk_tile *t = &d->tiles[i];
		const char *title = heading(d, s, &note);
		if (d->n_tiles == 2)
			title = half_heading(d, s, i, title, &note);
		if (t->view.quantity >= 0) {
			title = in_capital(s, quantity_table[t->view.quantity].title);
			note = "";
		}
		struct box_px box = t->box;
		box.y = fmax(box.y, d->layout.view.y + low);
		panel_heading(cr, &box, title, note, i == d->tile, &d->look);
	}
}

static void rules(struct desk *d, cairo_t *cr)
{
	struct rgb c = theme_color(d->theme, TOKEN_LINE);
	const struct box_px *v = &d->layout.view;

	cairo_set_source_rgb(cr, c.r, c.g, c.b);
	for (int i = 0; i < d->n_tiles; i++) {
		const struct box_px *b = &d->tiles[i].box;
		double right = b->x + b->width, low = b->y + b->height;
		if (right < v->x + v->width - 0.5)
			cairo_rectangle(cr, right, b->y, 1, b->height + 1);
		if (low < v->y + v->height - 0.5)
			cairo_rectangle(cr, b->x, low, b->width + 1, 1);
	}
	cairo_fill(cr);
}

/* Its height; what stands at the top of the view begins below it. */
static double bar(struct desk *d, cairo_t *cr, struct scraps *s)
{
	struct bar_model m = { REPORT_WARNING, in_capital(s, d->link_reason), "Start it again" };

	if (d->link != LINK_GONE)
		return 0;
	panel_bar(cr, &d->layout.view, &m, &d->look, &d->hits[PART_OVER]);
	return panel_bar_height(cr, &d->layout.view, &m);
}

void desk_paint_over(struct desk *d, cairo_t *cr)
{
	struct scraps *s = &d->scraps[PART_OVER];

	scraps_reset(s);
	if (!world_count(d->world)) {
		bar(d, cr, s);
		return;
	}
	for (int i = 0; i < d->n_tiles; i++)
		if (d->tiles[i].is_uv)
			desk_paint_uv(d, cr, s, &d->tiles[i].box);
	rules(d, cr);
	const double low = bar(d, cr, s);
	tile_headings(d, cr, s, low);
	desk_paint_keys(d, cr, s, low);
}

/* ------------------------------------------------------------ probe */

void desk_paint_probe(struct desk *d, cairo_t *cr)
{
	const struct Ful *f = world_by_id(d->world, d->pick.thing);
	struct probe_model m = { .kept = d->probe_kept };
	struct surface_shape p;

	if (!d->probe_shown || !f)
		return;
	m.title = f->name;
	m.unit = f->unit;
	m.u = d->pick.u;
	m.v = d->pick.v;
	m.point[0] = d->pick.point.x;
	m.point[1] = d->pick.point.y;
	m.point[2] = d->pick.point.z;
	m.normal[0] = m.normal[1] = m.normal[2] = m.K = m.H = m.kmax = m.kmin = NAN;
	if (f->entity.kind == ENTITY_SURFACE) {
		surface_shape(&f->entity.geometry, d->pick.u, d->pick.v, &p);
		m.has_uv = true;
		m.point[0] = p.point.x;
		m.point[1] = p.point.y;
		m.point[2] = p.point.z;
		m.normal[0] = p.normal.x;
		m.normal[1] = p.normal.y;
		m.normal[2] = p.normal.z;
		m.K = p.value[QUANTITY_GAUSSIAN];
		m.H = p.value[QUANTITY_MEAN];
		m.kmax = p.value[QUANTITY_KMAX];
		m.kmin = p.value[QUANTITY_KMIN];
	}
	panel_probe(cr, &d->layout.view, d->probe_x, d->probe_y, &m, &d->look);
}

/* ------------------------------------------------------------ painting */

static void paint_card(struct desk *d, cairo_t *cr)
{
	struct hits *h = &d->hits[PART_CARD];
	struct box_px color, light;

	if (!world_count(d->world)) {
		struct empty_model m = { 0 };
		panel_empty(cr, &d->layout.view, &m, &d->look, h);
		return;
	}
	panel_cards_place(&d->layout, &color, &light);
	if (d->tool == TOOL_COLOR) {
		struct color_model m = desk_color_model(d);
		panel_color(cr, &color, &m, &d->look, h);
	} else if (d->tool == TOOL_LIGHT) {
		const struct sight *s = world_sight(d->world);
		struct light_model m = { s->light_azimuth, s->light_incidence, s->light_intensity };
		panel_light(cr, &light, &m, &d->look, h);
	}
}

static void paint_page(struct desk *d, cairo_t *cr)
{
	struct hits *h = &d->hits[PART_PAGE];
	const struct look *k = &d->look;

	switch (d->page) {
	case PAGE_JOBS:
		d->job_rows = panel_jobs_rows(&d->layout.view);
		desk_fill_jobs(d);
		panel_jobs(cr, &d->layout.view, &d->jobs, k, h);
		break;
	case PAGE_SEARCH:
		desk_fill_search(d);
		panel_search(cr, d->width, d->height, &d->results, k, h);
		break;
	case PAGE_HELP:
		desk_fill_help(d);
		d->help_scroll = fmin(d->help_scroll, panel_help_scroll(cr, &d->layout, &d->help));
		d->help.scroll = d->help_scroll;
		panel_help(cr, &d->layout, &d->help, k, h);
		break;
	case PAGE_KEYS:
		panel_keys(cr, &(struct box_px){ 0, 0, d->width, d->height }, desk_keys_model(d),
		           k);
		break;
	case PAGE_MESSAGES:
	case PAGE_QUESTION:
		desk_fill_list(d);
		panel_list(cr, &d->layout.view, &d->list, k, h);
		break;
	default:
		break;
	}
}

void desk_paint(struct desk *d, enum desk_part part, cairo_t *cr)
{
	struct hits *h = &d->hits[part];
	struct Mouse_Words words;

	hits_reset(h);
	d->look.theme = d->theme;
	d->look.scale = d->scale;
	switch (part) {
	case PART_OVER:
		desk_paint_over(d, cr);
		break;
	case PART_PROBE:
		desk_paint_probe(d, cr);
		break;
	case PART_TOP:
		desk_fill_top(d);
		panel_top(cr, &d->layout.top, &d->top, &d->look, h);
		break;
	case PART_MENU:
		desk_fill_menu(d);
		panel_menu(cr, &d->layout, &d->menu, &d->look, h);
		if (d->page == PAGE_JOBS && !d->ask.routine &&
		    job_shelf_find(&d->shelf, d->job_focus))
			panel_job(cr, &d->layout, job_shelf_find(&d->shelf, d->job_focus),
			          &d->look);
		break;
	case PART_MOUSE:
		words = desk_mouse_words(d);
		panel_mouse(cr, &d->layout.mouse, &words, &d->look);
		break;
	case PART_FOOT:
		desk_fill_foot(d);
		panel_foot(cr, &d->layout, &d->foot, &d->look, h);
		break;
	case PART_CARD:
		paint_card(d, cr);
		break;
	case PART_PAGE:
		paint_page(d, cr);
		break;
	default:
		break;
	}
}

/* ------------------------------------------------------------ models for others */

const struct menu_model *desk_menu_model(struct desk *d)
{
	desk_fill_menu(d);
	return &d->menu;
}

const struct foot_model *desk_foot_model(struct desk *d)
{
	desk_fill_foot(d);
	return &d->foot;
}

const struct top_model *desk_top_model(struct desk *d)
{
	desk_fill_top(d);
	return &d->top;
}

const struct jobs_model *desk_jobs_model(struct desk *d)
{
	if (d->page != PAGE_JOBS)
		return NULL;
	desk_fill_jobs(d);
	return &d->jobs;
}

const struct search_model *desk_search_model(struct desk *d)
{
	if (d->page != PAGE_SEARCH)
		return NULL;
	desk_fill_search(d);
	return &d->results;
}

const struct help_model *desk_help_model(struct desk *d)
{
	if (d->page != PAGE_HELP)
		return NULL;
	desk_fill_help(d);
	return &d->help;
}

const struct list_model *desk_list_model(struct desk *d)
{
	if (d->page != PAGE_MESSAGES && d->page != PAGE_QUESTION)
		return NULL;
	desk_fill_list(d);
	return &d->list;
}

const struct keys_model *desk_keys_model(struct desk *d)
{
	d->keys = (struct keys_model){ .rows = desk_key_table, .scroll = d->page_scroll };
	while (desk_key_table[d->keys.n].key)
		d->keys.n++;
	return &d->keys;
}
