/* canvas.c - a surface to paint screens on. */
#include "canvas.h"

#include <math.h>
#include <string.h>

#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>

void canvas_init(struct canvas *c, double width, double height, double scale, enum theme theme,
                 double margin)
{
	memset(c, 0, sizeof *c);
	c->width = (int)ceil((width + 2 * margin) * scale);
	c->height = (int)ceil((height + 2 * margin) * scale);
	c->surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, c->width, c->height);
	cairo_surface_set_device_offset(c->surface, margin * scale, margin * scale);
	c->cr = cairo_create(c->surface);
	cairo_scale(c->cr, scale, scale);
	c->look = (struct look){ .theme = theme, .scale = scale };
}

void canvas_finish(struct canvas *c)
{
	cairo_destroy(c->cr);
	cairo_surface_destroy(c->surface);
	hits_finish(&c->hits);
}

void canvas_clear(struct canvas *c)
{
	cairo_save(c->cr);
	cairo_set_operator(c->cr, CAIRO_OPERATOR_CLEAR);
	cairo_paint(c->cr);
	cairo_restore(c->cr);
	hits_reset(&c->hits);
}

static const unsigned char *row(const struct canvas *c, int y)
{
	return cairo_image_surface_get_data(c->surface) +
	       (size_t)y * (size_t)cairo_image_surface_get_stride(c->surface);
}

unsigned canvas_pixel(const struct canvas *c, int x, int y)
{
	unsigned p;
	memcpy(&p, row(c, y) + 4 * (size_t)x, sizeof p);
	return p;
}

bool canvas_extent(const struct canvas *a, const struct canvas *b, struct box_px *out)
{
	int lo[2] = { a->width, a->height }, hi[2] = { -1, -1 };
	double margin[2];
	cairo_surface_flush(a->surface);
	if (b)
		cairo_surface_flush(b->surface);
	for (int y = 0; y < a->height; y++) {
		const unsigned char *p = row(a, y), *q = b ? row(b, y) : NULL;
		if (q && !memcmp(p, q, 4 * (size_t)a->width))
			continue;
		for (int x = 0; x < a->width; x++) {
			static const unsigned char nothing[4];
			if (!memcmp(p + 4 * x, q ? q + 4 * x : nothing, 4))
				continue;
			lo[0] = x < lo[0] ? x : lo[0];
			lo[1] = y < lo[1] ? y : lo[1];
			hi[0] = x > hi[0] ? x : hi[0];
			hi[1] = y > hi[1] ? y : hi[1];
		}
	}
	cairo_surface_get_device_offset(a->surface, &margin[0], &margin[1]);
	*out = (struct box_px){ lo[0] - margin[0], lo[1] - margin[1], hi[0] + 1 - lo[0],
		                hi[1] + 1 - lo[1] };
	return hi[0] >= 0;
}

void canvas_forget_fonts(void)
{
	pango_cairo_font_map_set_default(NULL);
	cairo_debug_reset_static_data();
	FcFini();
}
