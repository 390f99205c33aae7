/* mouse.c - what the buttons of the mouse do now. */
#include <math.h>
#include <string.h>

#include "paint.h"

enum { BODY_WIDTH = 48, BODY_HEIGHT = 70, BUTTONS = 30, LINE = 14, WORDS_SIZE = 128 };

static bool has(const char *words)
{
	return words && words[0];
}

static void paint_sign(const struct paint *p, double x, double y, bool release)
{
	if (release)
		paint_circle(p, x, y, 3, 1.5, TOKEN_RELEASE);
	else
		paint_dot(p, x, y, 3.4, TOKEN_PRESS);
}

static void paint_legend(const struct paint *p, const struct box_px *b)
{
	const double middle = b->y + 18;
	double right = b->x + b->width - PAINT_PADDING;
	paint_text(p, LABEL_SECTION, TOKEN_TEXT, b->x + PAINT_PADDING, middle, 0, "Mouse");
	right -= paint_text(p, LABEL_NOTE, TOKEN_MUTED, right, middle, 1, "release") + 9;
	paint_sign(p, right, middle, true);
	right -= 18;
	right -= paint_text(p, LABEL_NOTE, TOKEN_MUTED, right, middle, 1, "press") + 9;
	paint_sign(p, right, middle, false);
}

static void paint_body(const struct paint *p, double x, double y, bool left, bool right)
{
	cairo_t *cr = p->cr;
	const double half = BODY_WIDTH / 2.0, radius = 22;
	paint_fill(p, x - half, y, BODY_WIDTH, BODY_HEIGHT, radius, TOKEN_RAISED);
	for (int side = 0; side < 2; side++)
		if (side ? right : left) {
			cairo_save(cr);
			paint_round(p, x - half, y, BODY_WIDTH, BODY_HEIGHT, radius);
			cairo_clip(cr);
			cairo_rectangle(cr, side ? x : x - half, y, half, BUTTONS);
			paint_set(p, TOKEN_HOVER, 1);
			cairo_fill(cr);
			cairo_restore(cr);
		}
	paint_border(p, x - half, y, BODY_WIDTH, BODY_HEIGHT, radius, 1.25, TOKEN_EDGE);
	paint_line(p, x - half, y + BUTTONS, x + half, y + BUTTONS, 1.25, TOKEN_EDGE);
	paint_line(p, x, y, x, y + BUTTONS, 1.25, TOKEN_EDGE);
	paint_fill(p, x - 5, y + 8, 10, 18, 5, TOKEN_BAR);
	paint_border(p, x - 5, y + 8, 10, 18, 5, 1.25, TOKEN_EDGE);
}

/* More than nine letters stand in two lines, as even as the words allow. */
static int split_words(char lines[2][WORDS_SIZE], const char *words)
{
	enum { SHORT = 9 };
	size_t n = strnlen(words, WORDS_SIZE - 1), best = 0;
	for (size_t i = 0; i < n && n > SHORT; i++)
		if (words[i] == ' ' && (!best || fabs(2.0 * (double)i - (double)n) <
		                                         fabs(2.0 * (double)best - (double)n)))
			best = i;
	memcpy(lines[0], words, best ? best : n);
	lines[0][best ? best : n] = 0;
	if (!best)
		return 1;
	memcpy(lines[1], words + best + 1, n - best - 1);
	lines[1][n - best - 1] = 0;
	return 2;
}

static void paint_side(const struct paint *p, double x, double y, double room, bool right,
                       const char *press, const char *release)
{
	const double away = right ? 1 : -1;
	for (int i = 0; i < 2; i++) {
		const char *words = i ? release : press;
		char line[2][WORDS_SIZE];
		if (!has(words))
			continue;
		paint_sign(p, x + 11 * away, y, i);
		int n = split_words(line, words);
		for (int j = 0; j < n; j++, y += LINE)
			paint_cut(p, LABEL_CAP, i ? TOKEN_RELEASE : TOKEN_PRESS, x + 20 * away, y,
			          right ? 0 : 1, room - 20, line[j]);
		y += 6;
	}
}

static void paint_middle(const struct paint *p, double x, double y, double room, const char *press,
                         const char *release)
{
	const double wide[2] = { has(press) ? paint_width(p, LABEL_CAP, press) + 12 : 0,
		                 has(release) ? paint_width(p, LABEL_CAP, release) + 12 : 0 };
	const double gap = wide[0] > 0 && wide[1] > 0 ? 16 : 0;
	const double all = fmin(wide[0] + wide[1] + gap, room);
	/* short of room, the shorter keeps all of its own up to a half */
	const double first = fmin(wide[0], fmax(all - gap - wide[1], (all - gap) / 2));
	double left = x - all / 2;
	if (has(press)) {
		paint_sign(p, left + 3, y, false);
		paint_cut(p, LABEL_CAP, TOKEN_PRESS, left + 12, y, 0, first - 12, press);
		left += first + gap;
	}
	if (has(release)) {
		paint_sign(p, left + 3, y, true);
		paint_cut(p, LABEL_CAP, TOKEN_RELEASE, left + 12, y, 0, x + all / 2 - left - 12,
		          release);
	}
}

/* No room for the icon: presses in one line, releases below. */
static void paint_lines(const struct paint *p, const struct box_px *b, const struct Mouse_Words *m)
{
	static const char *const name[] = { "L", "M", "R" };
	const double part = (b->width - 2 * PAINT_PADDING) / 3;
	for (int i = 0; i < 3; i++) {
		const double x = b->x + PAINT_PADDING + i * part;
		if (has(m->press[i]) || has(m->release[i]))
			paint_text(p, LABEL_NOTE, TOKEN_MUTED, x, b->y + 38, 0, name[i]);
		if (has(m->press[i]))
			paint_cut(p, LABEL_CAP, TOKEN_PRESS, x + 14, b->y + 38, 0, part - 18,
			          m->press[i]);
		if (has(m->release[i]))
			paint_cut(p, LABEL_CAP, TOKEN_RELEASE, x + 14, b->y + 56, 0, part - 18,
			          m->release[i]);
	}
}

void panel_mouse(cairo_t *cr, const struct box_px *b, const struct Mouse_Words *m,
                 const struct look *k)
{
	const struct paint p = { cr, k, NULL };
	const double x = b->x + b->width / 2, body = b->y + 36;
	const double room = b->width / 2 - BODY_WIDTH / 2.0 - PAINT_PADDING;
	if (b->width <= 0)
		return;
	paint_fill(&p, b->x, b->y, b->width, b->height, 0, TOKEN_BAR);
	paint_rule(&p, b->x, b->y, b->width);
	paint_rule_down(&p, b->x, b->y, b->height);
	paint_legend(&p, b);
	if (b->height < PAINT_MOUSE) {
		paint_lines(&p, b, m);
		return;
	}
	const bool middle = has(m->press[1]) || has(m->release[1]);
	if (middle)
		paint_line(&p, x, body + BODY_HEIGHT, x, b->y + 118, 1, TOKEN_LINE);
	paint_body(&p, x, body, has(m->press[0]) || has(m->release[0]),
	           has(m->press[2]) || has(m->release[2]));
	paint_side(&p, x - BODY_WIDTH / 2.0, body + 6, room, false, m->press[0], m->release[0]);
	paint_side(&p, x + BODY_WIDTH / 2.0, body + 6, room, true, m->press[2], m->release[2]);
	paint_middle(&p, x, b->y + 126, b->width - 2 * PAINT_PADDING, m->press[1], m->release[1]);
}
