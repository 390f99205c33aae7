/* picture_map.c - a map of values in colors, with axes and key. */
#include <math.h>
#include <stdint.h>

#include "key.h"
#include "picture.h"
#include "sheet.h"
#include "ticks.h"

enum { PAD = 24, HEAD = 48, GAP = 24, SMALL_SIDE = 512, COLORS = 512 };

/* Where things are, px. */
struct place {
	int left, top;     /* of the map */
	int sx, sy;        /* pixels a value */
	int w, h;          /* of the map */
	double axis;       /* room for the numbers along v */
	int width, height; /* of the sheet */
	struct ticks u, v;
	struct key key;
};

static int enlarge(int n)
{
	return n < SMALL_SIDE ? SMALL_SIDE / n : 1;
}

/* Shares of the area beyond the range, and whether a value is missing anywhere. */
static void count(struct key *k, const struct picture_map *m)
{
	double below = 0, above = 0, all = 0;
	for (size_t i = 0; i < (size_t)m->width * m->height; i++) {
		double weight = m->weights ? m->weights[i] : 1;
		if (m->shade && isnan(m->shade[i]))
			continue;
		if (isnan(m->values[i])) {
			k->nothing = true;
			continue;
		}
		if (!(weight > 0))
			continue;
		all += weight;
		below += m->values[i] < m->map.lo ? weight : 0;
		above += m->values[i] > m->map.hi ? weight : 0;
	}
	k->below = all > 0 ? below / all : 0;
	k->above = all > 0 ? above / all : 0;
}

/* One value alone has no scale. */
static void axis_ticks(struct ticks *t, const double ends[2], int n, int pixels)
{
	t->n = 0;
	if (n > 1 && ends[1] > ends[0])
		ticks_linear(t, ends[0], ends[1], 56.0 / pixels);
}

static void lay_out(struct place *p, const struct picture_map *m, enum theme theme, cairo_t *cr)
{
	*p = (struct place){ .sx = m->axes ? enlarge(m->width) : 1,
		             .sy = m->axes ? enlarge(m->height) : 1 };
	p->w = m->width * p->sx;
	p->h = m->height * p->sy;
	p->left = PAD;
	p->top = PAD + HEAD;
	int foot = 0;
	if (m->axes) {
		axis_ticks(&p->u, m->axes, m->width, p->w);
		axis_ticks(&p->v, m->axes + 2, m->height, p->h);
		for (int i = 0; i < p->v.n; i++)
			p->axis = fmax(p->axis, label_width(cr, LABEL_NOTE, p->v.text[i]));
		p->left += 20 + (int)ceil(p->axis) + 10;
		foot = 42;
	}
	p->key =
	        (struct key){ .map = m->map, .symbol = m->symbol, .unit = m->unit, .theme = theme };
	p->key.bar = fmin(fmax(floor(0.28 * p->h), 196), 320);
	count(&p->key, m);
	double heading = fmax(label_width(cr, LABEL_HEADING, m->title),
	                      m->note ? label_width(cr, LABEL_NOTE, m->note) : 0);
	double width = p->left + p->w + GAP + key_width(cr, &p->key) + PAD;
	double height = p->top + fmax(p->h + foot, key_height(&p->key)) + PAD;
	p->width = (int)fmin(fmax(width, heading + 2 * PAD), INT32_MAX);
	p->height = (int)fmin(height, INT32_MAX);
}

static unsigned pack(struct rgb c, double factor)
{
	unsigned r = (unsigned)lrint(255 * fmin(fmax(c.r * factor, 0), 1));
	unsigned g = (unsigned)lrint(255 * fmin(fmax(c.g * factor, 0), 1));
	unsigned b = (unsigned)lrint(255 * fmin(fmax(c.b * factor, 0), 1));
	return r << 16 | g << 8 | b;
}

/* The map's colors between its ends, made once. */
struct palette {
	const struct colormap *map; /* borrowed */
	struct rgb between[COLORS];
};

static void palette_init(struct palette *p, const struct colormap *map)
{
	p->map = map;
	for (int i = 0; i < COLORS; i++)
		p->between[i] = colormap_at(map, (i + 0.5) / COLORS);
}

static struct rgb palette_color(const struct palette *p, double value)
{
	if (value < p->map->lo)
		return colormap_below(p->map);
	if (value > p->map->hi)
		return colormap_above(p->map);
	int i = (int)(colormap_position(p->map, value) * COLORS);
	return p->between[i < COLORS ? i : COLORS - 1];
}

/* All pixels of one value. */
static void fill(unsigned *pixels, int stride, const struct place *p, int column, int row,
                 const struct palette *palette, double value, double shade)
{
	int x0 = p->left + column * p->sx, y0 = p->top + row * p->sy;
	unsigned color = isnan(value) ? 0 : pack(palette_color(palette, value), shade);
	for (int y = y0; y < y0 + p->sy; y++)
		for (int x = x0; x < x0 + p->sx; x++)
			pixels[(size_t)y * stride + x] =
			        isnan(value) ? pack(key_hatch(x, y), shade) : color;
}

static void draw_values(struct sheet *s, const struct place *p, const struct picture_map *m)
{
	struct palette palette;
	int stride;
	unsigned *pixels = sheet_pixels(s, &stride);
	palette_init(&palette, &m->map);
	for (int row = 0; row < m->height; row++)
		for (int column = 0; column < m->width; column++) {
			size_t i = (size_t)row * m->width + column;
			double shade = m->shade ? m->shade[i] : 1;
			if (!isnan(shade))
				fill(pixels, stride, p, column, row, &palette, m->values[i], shade);
		}
	sheet_touched(s);
}

static void set(cairo_t *cr, struct rgb c)
{
	cairo_set_source_rgb(cr, c.r, c.g, c.b);
}

/* Pixel of the middle of the value that has parameter t. */
static double along(double t, const double ends[2], int n, int scale)
{
	return ((t - ends[0]) / (ends[1] - ends[0]) * (n - 1) + 0.5) * scale;
}

static void draw_axes(cairo_t *cr, const struct place *p, const struct picture_map *m,
                      enum theme theme)
{
	struct rgb edge = theme_color(theme, TOKEN_EDGE), text = theme_color(theme, TOKEN_TEXT2);
	double bottom = p->top + p->h;
	cairo_set_line_width(cr, 1);
	set(cr, edge);
	cairo_rectangle(cr, p->left - 0.5, p->top - 0.5, p->w + 1, p->h + 1);
	cairo_stroke(cr);
	for (int i = 0; i < p->u.n; i++) {
		double x = p->left + floor(along(p->u.value[i], m->axes, m->width, p->sx)) + 0.5;
		set(cr, edge);
		cairo_move_to(cr, x, bottom + 1);
		cairo_line_to(cr, x, bottom + 6);
		cairo_stroke(cr);
		label_draw(cr, LABEL_NOTE, text, x, bottom + 18, 0.5, p->u.text[i]);
	}
	for (int i = 0; i < p->v.n; i++) {
		double up = along(p->v.value[i], m->axes + 2, m->height, p->sy);
		double y = ceil(bottom - up) - 0.5;
		set(cr, edge);
		cairo_move_to(cr, p->left - 1, y);
		cairo_line_to(cr, p->left - 6, y);
		cairo_stroke(cr);
		label_draw(cr, LABEL_NOTE, text, p->left - 10, label_baseline(LABEL_NOTE, y), 1,
		           p->v.text[i]);
	}
	label_draw(cr, LABEL_STRONG, text, p->left + p->w / 2.0, bottom + 36, 0.5, "u");
	label_draw(cr, LABEL_STRONG, text, PAD, label_baseline(LABEL_STRONG, p->top + p->h / 2.0),
	           0, "v");
}

static void draw(struct sheet *s, const struct place *p, const struct picture_map *m,
                 enum theme theme)
{
	set(s->cr, theme_color(theme, TOKEN_VIEW));
	cairo_paint(s->cr);
	draw_values(s, p, m);
	label_draw(s->cr, LABEL_HEADING, theme_color(theme, TOKEN_TEXT), PAD, PAD + 10, 0,
	           m->title);
	if (m->note)
		label_draw(s->cr, LABEL_NOTE, theme_color(theme, TOKEN_MUTED), PAD, PAD + 28, 0,
		           m->note);
	if (m->axes)
		draw_axes(s->cr, p, m, theme);
	key_draw(s->cr, &p->key, p->left + p->w + GAP, p->top);
}

enum status picture_map(const char *path, const struct picture_map *m, enum theme theme,
                        const struct report *r)
{
	struct sheet sheet;
	struct place p;
	enum status st = sheet_init(&sheet, path, 0, 0, r);
	if (st)
		return st;
	lay_out(&p, m, theme, sheet.cr);
	sheet_finish(&sheet);
	st = sheet_init(&sheet, path, p.width, p.height, r);
	if (st)
		return st;
	draw(&sheet, &p, m, theme);
	st = sheet_write(&sheet, path, r);
	sheet_finish(&sheet);
	return st;
}
