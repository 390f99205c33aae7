/* color.c - the card of a color: saturation and value in a square, hue beside it, and as numbers. */
#include <math.h>
#include <stdio.h>

#include "paint.h"

enum { EDGE = 16, SQUARE_W = 224, SQUARE_H = 164, HUE_W = 28, WIDTH = 300, HEIGHT = 356 };
enum { LIGHT_HEIGHT = 288, SAMPLES = 6, SLIDER = 116 };

static const unsigned samples[SAMPLES] = { 0xA9B4BE, 0xC9B48C, 0x8FA58A,
	                                   0xA7867C, 0x5E7F9E, 0xD8D8D2 };

static struct rgb hsv(double hue, double saturation, double value)
{
	double c[3];
	for (int i = 0; i < 3; i++) {
		const double h = fmod(fmod(hue / 60 + 5 - 2 * i, 6) + 6, 6);
		c[i] = value - value * saturation * fmax(fmin(fmin(h, 4 - h), 1), 0);
	}
	return (struct rgb){ c[0], c[1], c[2] };
}

static double within(double x, double lo, double hi)
{
	return x > lo ? fmin(x, hi) : lo; /* NaN becomes lo */
}

struct rgb panel_color_rgb(const struct color_model *m)
{
	return hsv(within(m->hue, 0, 360), within(m->saturation, 0, 1), within(m->value, 0, 1));
}

struct rgb panel_color_sample(int index)
{
	const unsigned c = samples[(unsigned)index % SAMPLES];
	return (struct rgb){ (c >> 16 & 255) / 255.0, (c >> 8 & 255) / 255.0, (c & 255) / 255.0 };
}

void panel_cards_place(const struct layout *l, struct box_px *color, struct box_px *light)
{
	const struct box_px *v = &l->view;
	const double right = v->x + v->width - EDGE;
	*color = (struct box_px){ right - WIDTH, v->y + EDGE, WIDTH, HEIGHT };
	*light = (struct box_px){ right - WIDTH, v->y + 2 * EDGE + HEIGHT, WIDTH, LIGHT_HEIGHT };
	if (light->y + light->height > v->y + v->height) {
		light->x -= WIDTH + EDGE;
		light->y = color->y;
	}
}

/* White to the hue from left to right, and both to black from the top down. */
static void paint_square(const struct paint *p, double x, double y, struct rgb hue)
{
	cairo_t *cr = p->cr;
	cairo_pattern_t *side = cairo_pattern_create_linear(x, 0, x + SQUARE_W, 0);
	cairo_pattern_t *down = cairo_pattern_create_linear(0, y, 0, y + SQUARE_H);
	cairo_pattern_add_color_stop_rgb(side, 0, 1, 1, 1);
	cairo_pattern_add_color_stop_rgb(side, 1, hue.r, hue.g, hue.b);
	cairo_pattern_add_color_stop_rgba(down, 0, 0, 0, 0, 0);
	cairo_pattern_add_color_stop_rgba(down, 1, 0, 0, 0, 1);
	paint_round(p, x, y, SQUARE_W, SQUARE_H, 6);
	cairo_set_source(cr, side);
	cairo_fill_preserve(cr);
	cairo_set_source(cr, down);
	cairo_fill(cr);
	cairo_pattern_destroy(side);
	cairo_pattern_destroy(down);
}

static void paint_hues(const struct paint *p, double x, double y)
{
	enum { STOPS = 24 };
	cairo_pattern_t *down = cairo_pattern_create_linear(0, y, 0, y + SQUARE_H);
	for (int i = 0; i <= STOPS; i++) {
		struct rgb c = hsv(360.0 * i / STOPS, 0.75, 0.9);
		cairo_pattern_add_color_stop_rgb(down, (double)i / STOPS, c.r, c.g, c.b);
	}
	paint_round(p, x, y, HUE_W, SQUARE_H, 6);
	cairo_set_source(p->cr, down);
	cairo_fill(p->cr);
	cairo_pattern_destroy(down);
}

void paint_slider(const struct paint *p, double x, double middle, double width, double at, bool hot)
{
	at = within(at, 0, 1);
	paint_bar(p, x, middle - 2, width, at, paint_color(p, TOKEN_TEXT2));
	paint_dot(p, x + width * at, middle, hot ? 7 : 6, TOKEN_TEXT);
}

static void paint_value(const struct paint *p, int i, double x, double right, double middle,
                        const char *name, double at, double shown, const char *unit)
{
	char text[16];
	snprintf(text, sizeof text, "%.0f", shown);
	paint_text(p, LABEL_FORM, TOKEN_TEXT2, x, middle, 0, name);
	paint_slider(p, x + 76, middle, SLIDER, at, paint_hot(p, HIT_COLOR_VALUE, i, 0));
	if (paint_focused(p, HIT_COLOR_VALUE, i, 0))
		paint_ring(p, x + 66, middle - 11, SLIDER + 20, 22, 11);
	paint_fill(p, right - 60, middle - 12, 60, 24, 5, TOKEN_FIELD);
	paint_border(p, right - 60, middle - 12, 60, 24, 5, 1, TOKEN_LINE);
	paint_text(p, LABEL_FORM, TOKEN_TEXT, right - 24, middle, 1, text);
	paint_text(p, LABEL_NOTE, TOKEN_MUTED, right - 8, middle, 1, unit);
	paint_hit(p, HIT_COLOR_VALUE, i, 0, x + 76, middle - 12, SLIDER, 24);
}

static void paint_swatch(const struct paint *p, int index, double x, double y, double width,
                         double height, struct rgb c)
{
	paint_round(p, x, y, width, height, 4);
	paint_set_rgb(p, c);
	cairo_fill(p->cr);
	if (paint_hot(p, HIT_COLOR_VALUE, index, 0))
		paint_border(p, x - 2, y - 2, width + 4, height + 4, 6, 1, TOKEN_TEXT);
	if (paint_focused(p, HIT_COLOR_VALUE, index, 0))
		paint_ring(p, x - 3, y - 3, width + 6, height + 6, 7);
	paint_hit(p, HIT_COLOR_VALUE, index, 0, x, y, width, height);
}

void panel_color(cairo_t *cr, const struct box_px *b, const struct color_model *m,
                 const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const double hue = within(m->hue, 0, 360), saturation = within(m->saturation, 0, 1);
	const double value = within(m->value, 0, 1), x = b->x + EDGE, y = b->y + 42;
	const double right = b->x + b->width - EDGE, bar = right - HUE_W;
	const struct rgb color = panel_color_rgb(m);
	char text[16];
	paint_card(&p, b->x, b->y, b->width, HEIGHT, 8);
	paint_hit(&p, HIT_NONE, 0, 0, b->x, b->y, b->width, HEIGHT);
	paint_cut(&p, LABEL_HEADING, TOKEN_TEXT, x, b->y + 22, 0, right - x, m->what);

	paint_square(&p, x, y, hsv(hue, 1, 1));
	paint_hit(&p, HIT_COLOR_WHEEL, 0, 0, x, y, SQUARE_W, SQUARE_H);
	const double at_x = x + saturation * SQUARE_W, at_y = y + (1 - value) * SQUARE_H;
	cairo_new_path(cr);
	cairo_arc(cr, at_x, at_y, 7, 0, 2 * M_PI);
	cairo_set_source_rgb(cr, 0, 0, 0);
	cairo_set_line_width(cr, 1);
	cairo_stroke(cr);
	cairo_arc(cr, at_x, at_y, 6, 0, 2 * M_PI);
	cairo_set_source_rgb(cr, 1, 1, 1);
	cairo_set_line_width(cr, 2);
	cairo_stroke(cr);
	paint_hues(&p, bar, y);
	paint_hit(&p, HIT_COLOR_WHEEL, 1, 0, bar, y, HUE_W, SQUARE_H);
	paint_border(&p, bar - 3, y + hue / 360 * SQUARE_H - 4, HUE_W + 6, 8, 4, 2, TOKEN_TEXT);

	const double first = y + SQUARE_H + 24;
	paint_value(&p, 0, x, right, first, "Hue", hue / 360, hue, "°");
	paint_value(&p, 1, x, right, first + 30, "Saturation", saturation, 100 * saturation, "%");
	paint_value(&p, 2, x, right, first + 60, "Value", value, 100 * value, "%");

	const double last = first + 94;
	paint_round(&p, x, last - 12, 28, 24, 5);
	paint_set_rgb(&p, color);
	cairo_fill(cr);
	paint_swatch(&p, 3, x + 30, last - 12, 16, 24, m->old);
	snprintf(text, sizeof text, "#%02X%02X%02X", (unsigned)lrint(255 * color.r),
	         (unsigned)lrint(255 * color.g), (unsigned)lrint(255 * color.b));
	paint_text(&p, LABEL_FORM, TOKEN_TEXT2, x + 54, last, 0, text);
	for (int i = 0; i < SAMPLES; i++)
		paint_swatch(&p, 4 + i, right - (SAMPLES - i) * 25 + 5, last - 10, 20, 20,
		             panel_color_sample(i));
}
