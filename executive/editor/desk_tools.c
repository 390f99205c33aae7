/* desk_tools.c - light, color and control points set with the mouse, live. What is seen meanwhile is
 * taken back with Esc; what is kept is one call of the routine. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"
#include "number.h"

static void touch(struct desk *d)
{
	world_touch(d->world);
	desk_world_changed(d);
	desk_dirty(d, DESK_VIEW | desk_bit(PART_CARD));
}

/* ------------------------------------------------------------ color */

static double channel(double h, double s, double v, double shift)
{
	double k = fmod(shift + h / 60, 6);

	return v - v * s * fmax(0, fmin(fmin(k, 4 - k), 1));
}

static struct rgb from_hsv(double h, double s, double v)
{
	return (struct rgb){ channel(h, s, v, 5), channel(h, s, v, 3), channel(h, s, v, 1) };
}

static void to_hsv(struct rgb c, double *h, double *s, double *v)
{
	double hi = fmax(c.r, fmax(c.g, c.b)), lo = fmin(c.r, fmin(c.g, c.b)), span = hi - lo;

	*v = hi;
	*s = hi > 0 ? span / hi : 0;
	if (span <= 0)
		return; /* grey: the hue stays where it was */
	if (hi == c.r)
		*h = 60 * fmod((c.g - c.b) / span + 6, 6);
	else if (hi == c.g)
		*h = 60 * ((c.b - c.r) / span + 2);
	else
		*h = 60 * ((c.r - c.g) / span + 4);
}

static bool parse_color(const char *s, struct rgb *out)
{
	unsigned r, g, b;
	char rest;

	if (!s || strlen(s) != 7 || sscanf(s, "#%2x%2x%2x%c", &r, &g, &b, &rest) != 3)
		return false;
	*out = (struct rgb){ r / 255., g / 255., b / 255. };
	return true;
}

/* The field that holds the color. */
static int color_field(const struct desk *d)
{
	for (int i = 0; d->ask.routine && i < d->ask.n; i++)
		if (d->ask.rows[i].type == ARGUMENT_COLOR)
			return i;
	return -1;
}

static bool for_background(const struct desk *d)
{
	return d->ask.routine && !strcmp(d->ask.routine->code, "V157");
}

/* Is it the current curve that is colored or changed, not the surface? */
static bool for_curve(const struct desk *d)
{
	const char *need = d->ask.routine ? d->ask.routine->needs : NULL;

	return need && strstr(need, "curve");
}

static void show_color(struct desk *d)
{
	int i = color_field(d);
	struct rgb c;

	if (i < 0 || !parse_color(d->ask.field[i].s, &c))
		return;
	to_hsv(c, &d->hue, &d->saturation, &d->value);
	if (for_background(d)) {
		world_sight(d->world)->background = c;
		world_sight(d->world)->has_background = true;
	} else if (d->display_thing) {
		const struct Ful *f = world_by_id(d->world, d->display_thing);
		struct display shown = f ? f->display : d->display_before;
		shown.has_color = true;
		shown.color = c;
		if (f)
			world_set_display(d->world, d->display_thing, &shown);
	}
	touch(d);
}

static void set_color(struct desk *d)
{
	struct rgb c = from_hsv(d->hue, d->saturation, d->value);
	int i = color_field(d);

	if (i < 0)
		return;
	desk_ask_set(d, d->ask.rows[i].name, "#%02X%02X%02X", (unsigned)lround(255 * c.r),
	             (unsigned)lround(255 * c.g), (unsigned)lround(255 * c.b));
	double h = d->hue, s = d->saturation;
	show_color(d);
	d->hue = h; /* not rounded to what the field can say */
	d->saturation = s;
}

struct color_model desk_color_model(struct desk *d)
{
	struct color_model m = { d->hue, d->saturation, d->value, { 0.5, 0.5, 0.5 }, "" };

	if (for_background(d)) {
		m.old = d->sight_before.has_background ? d->sight_before.background
		                                       : theme_color(d->theme, TOKEN_VIEW);
		m.what = "Background";
	} else {
		const struct Ful *f = world_by_id(d->world, d->display_thing);
		m.old = d->display_before.has_color ? d->display_before.color : m.old;
		m.what = f ? f->name : "";
	}
	return m;
}

/* ------------------------------------------------------------ light */

static void show_light(struct desk *d)
{
	struct sight *s = world_sight(d->world);
	const char *a = desk_ask_get(d, "azimuth"), *i = desk_ask_get(d, "incidence");
	const char *k = desk_ask_get(d, "intensity");
	double x;

	if (a && number_parse(a, &x))
		s->light_azimuth = x;
	if (i && number_parse(i, &x))
		s->light_incidence = x;
	if (k && number_parse(k, &x))
		s->light_intensity = x;
	touch(d);
}

/* Azimuth goes round from the right, counterclockwise; incidence from straight above in the middle to
 * straight below at the rim. */
static void set_light(struct desk *d, double x, double y)
{
	double azimuth = atan2(-y, x) * 180 / M_PI, incidence = 180 * fmin(1, hypot(x, y));

	desk_ask_set(d, "azimuth", "%.0f", azimuth < -0.5 ? azimuth + 360 : fabs(azimuth));
	desk_ask_set(d, "incidence", "%.0f", incidence);
	show_light(d);
}

/* ------------------------------------------------------------ begin, change, end */

/* What the form leaves open is what is seen. */
static void fill_empty(struct desk *d, int color)
{
	const struct sight *s = world_sight(d->world);
	const char *value;

	if (d->tool == TOOL_COLOR && color >= 0 && !d->ask.field[color].n) {
		struct rgb c = desk_color_model(d).old;
		desk_ask_set(d, d->ask.rows[color].name, "#%02X%02X%02X",
		             (unsigned)lround(255 * c.r), (unsigned)lround(255 * c.g),
		             (unsigned)lround(255 * c.b));
	}
	if (d->tool != TOOL_LIGHT)
		return;
	if ((value = desk_ask_get(d, "intensity")) && !*value)
		desk_ask_set(d, "intensity", "%g", s->light_intensity);
	if ((value = desk_ask_get(d, "azimuth")) && !*value)
		desk_ask_set(d, "azimuth", "%g", s->light_azimuth);
	if ((value = desk_ask_get(d, "incidence")) && !*value)
		desk_ask_set(d, "incidence", "%g", s->light_incidence);
}

void desk_tool_begin(struct desk *d, enum tool tool)
{
	const struct Ful *f = world_current(d->world, for_curve(d));
	int i = color_field(d);
	struct rgb c;

	d->tool = tool;
	d->sight_before = *world_sight(d->world);
	d->display_thing = tool == TOOL_COLOR && !for_background(d) && f ? f->id : 0;
	if (f)
		d->display_before = f->display;
	fill_empty(d, i);
	if (tool == TOOL_COLOR && i >= 0 && parse_color(d->ask.field[i].s, &c))
		to_hsv(c, &d->hue, &d->saturation, &d->value);
	if (tool == TOOL_POINTS && f) {
		struct display shown = f->display;
		d->display_thing = f->id;
		shown.net = true;
		world_set_display(d->world, f->id, &shown);
	}
	desk_dirty(d, DESK_VIEW | desk_bit(PART_CARD) | desk_bit(PART_MOUSE) | desk_bit(PART_FOOT) |
	                      desk_bit(PART_OVER));
	desk_world_changed(d);
}

/* What was seen was a preview; what is kept is what the routine does. */
void desk_tool_end(struct desk *d)
{
	enum tool was = d->tool;

	if (was == TOOL_NONE || d->errand)
		return;
	d->tool = TOOL_NONE;
	if (was == TOOL_LIGHT || was == TOOL_COLOR) {
		struct sight *s = world_sight(d->world);
		struct camera camera = s->camera; /* turned meanwhile: that stays */
		*s = d->sight_before;
		s->camera = camera;
	}
	if (d->display_thing && world_by_id(d->world, d->display_thing))
		world_set_display(d->world, d->display_thing, &d->display_before);
	d->display_thing = 0;
	for (int i = 0; i < d->n_tiles; i++) {
		d->tiles[i].view.hover_thing = 0;
		d->tiles[i].view.hover_point = -1;
	}
	d->pick = (struct pick){ 0 };
	touch(d);
	desk_dirty(d, desk_bit(PART_MOUSE) | desk_bit(PART_FOOT) | desk_bit(PART_OVER));
}

void desk_tool_changed(struct desk *d)
{
	if (d->errand)
		return;
	if (d->tool == TOOL_LIGHT)
		show_light(d);
	if (d->tool == TOOL_COLOR)
		show_color(d);
}

/* ------------------------------------------------------------ the mouse on the cards */

static const struct hit *dragged_hit(const struct desk *d)
{
	const struct hits *h = &d->hits[PART_CARD];

	for (int i = 0; i < h->n; i++)
		if (h->hit[i].kind == d->card_kind && h->hit[i].index == d->card_index)
			return &h->hit[i];
	return NULL;
}

bool desk_tool_press(struct desk *d, const struct hit *h)
{
	if (desk_key_press(d, h))
		return true;
	if (h->kind != HIT_COLOR_WHEEL && h->kind != HIT_COLOR_VALUE && h->kind != HIT_LIGHT)
		return false;
	if (d->errand)
		return true;
	d->drag = DRAG_CARD;
	d->card_kind = h->kind;
	d->card_index = h->index;
	desk_tool_move(d);
	return true;
}

static double within(double x)
{
	return fmin(1, fmax(0, x));
}

static void set_rgb(struct desk *d, struct rgb c)
{
	to_hsv(c, &d->hue, &d->saturation, &d->value);
	set_color(d);
}

/* x and y: 0 to 1 within the hit's box, from its upper left corner. */
static void move_color(struct desk *d, double x, double y)
{
	if (d->card_kind == HIT_COLOR_WHEEL && d->card_index == 0) {
		d->saturation = x;
		d->value = 1 - y;
	} else if (d->card_kind == HIT_COLOR_WHEEL) {
		d->hue = 360 * y;
	} else if (d->card_index < 3) {
		double *to[] = { &d->hue, &d->saturation, &d->value };
		*to[d->card_index] = d->card_index ? x : 360 * x;
	} else if (d->card_index == 3) {
		set_rgb(d, desk_color_model(d).old);
		return;
	} else {
		set_rgb(d, panel_color_sample(d->card_index - 4));
		return;
	}
	set_color(d);
}

void desk_tool_move(struct desk *d)
{
	const struct box_px *b = &d->tiles[d->tile].box;
	double half = fmin(b->width, b->height) / 2;

	if (d->drag == DRAG_LIGHT) {
		set_light(d, (d->x - b->x - b->width / 2) / half,
		          (d->y - b->y - b->height / 2) / half);
		return;
	}
	if (d->drag == DRAG_KEY) {
		desk_key_move(d);
		return;
	}
	const struct hit *h = d->drag == DRAG_CARD ? dragged_hit(d) : NULL;
	if (!h)
		return;
	double x = within((d->x - h->x) / h->width), y = within((d->y - h->y) / h->height);
	if (d->card_kind != HIT_LIGHT) {
		move_color(d, x, y);
	} else if (d->card_index == 0) {
		set_light(d, 2 * x - 1, 2 * y - 1);
	} else {
		desk_ask_set(d, "intensity", "%.2f", x);
		show_light(d);
	}
}
