/* light.c - the card of the light: its direction on a dial, from straight above in the middle to straight
 * below at the rim, and its intensity. */
#include <math.h>
#include <stdio.h>

#include "paint.h"

enum { EDGE = 16, RADIUS = 84, DIAL_Y = 138 };

static void paint_dial(const struct paint *p, double x, double y)
{
	static const struct {
		int degrees;
		const char *text;
	} rings[] = { { 45, NULL }, { 90, "90°" }, { 135, NULL }, { 180, NULL } };
	paint_rule(p, x - RADIUS, y, 2 * RADIUS);
	paint_rule_down(p, x, y - RADIUS, 2 * RADIUS);
	for (int i = 0; i < 4; i++) {
		const double radius = RADIUS * rings[i].degrees / 180.0;
		const bool strong = rings[i].degrees % 90 == 0; /* the horizon, and the rim */
		paint_circle(p, x, y, radius, strong ? 1.25 : 1, strong ? TOKEN_EDGE : TOKEN_LINE);
		if (rings[i].text)
			paint_text(p, LABEL_RING, TOKEN_MUTED, x + radius - 3, y - 8, 1,
			           rings[i].text);
	}
	paint_text(p, LABEL_NOTE, TOKEN_MUTED, x + RADIUS + 8, y, 0, "+x");
	paint_text(p, LABEL_NOTE, TOKEN_MUTED, x - RADIUS - 8, y, 1, "−x");
	paint_text(p, LABEL_NOTE, TOKEN_MUTED, x, y - RADIUS - 10, 0.5, "+y");
	paint_text(p, LABEL_NOTE, TOKEN_MUTED, x, y + RADIUS + 11, 0.5, "−y");
}

void panel_light(cairo_t *cr, const struct box_px *b, const struct light_model *m,
                 const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const double left = b->x + EDGE, right = b->x + b->width - EDGE;
	const double x = b->x + b->width / 2, y = b->y + DIAL_Y;
	const double azimuth = isfinite(m->azimuth) ? m->azimuth * M_PI / 180 : 0;
	const double away = fmin(fmax(m->incidence, 0), 180) / 180 * RADIUS;
	const double at_x = x + away * cos(azimuth), at_y = y - away * sin(azimuth);
	const double low = b->y + b->height - 26;
	char text[32];
	paint_card(&p, b->x, b->y, b->width, b->height, 8);
	paint_hit(&p, HIT_NONE, 0, 0, b->x, b->y, b->width, b->height);
	paint_text(&p, LABEL_HEADING, TOKEN_TEXT, left, b->y + 22, 0, "Light source");
	paint_text(&p, LABEL_NOTE, TOKEN_MUTED, right, b->y + 22, 1,
	           m->incidence > 90 ? "from below" : "from above");

	paint_dial(&p, x, y);
	paint_line(&p, x, y, at_x, at_y, 1.5, TOKEN_TEXT);
	if (paint_hot(&p, HIT_LIGHT, 0, 0) || paint_focused(&p, HIT_LIGHT, 0, 0))
		paint_circle(&p, at_x, at_y, 11, 1.5, TOKEN_ACCENT);
	paint_dot(&p, at_x, at_y, 6.5, TOKEN_TEXT);
	paint_hit(&p, HIT_LIGHT, 0, 0, x - RADIUS, y - RADIUS, 2 * RADIUS, 2 * RADIUS);

	const double slider = left + 76, width = right - 56 - slider;
	const bool hot = paint_hot(&p, HIT_LIGHT, 1, 0) || paint_focused(&p, HIT_LIGHT, 1, 0);
	paint_text(&p, LABEL_FORM, TOKEN_TEXT2, left, low, 0, "Intensity");
	paint_slider(&p, slider, low, width, m->intensity, hot);
	snprintf(text, sizeof text, "%.0f %%", 100 * fmin(fmax(m->intensity, 0), 99));
	paint_text(&p, LABEL_FORM, TOKEN_TEXT, right, low, 1, text);
	paint_hit(&p, HIT_LIGHT, 1, 0, slider, low - 12, width, 24);
}
