/* window_start.c - what is made ready beside the window: the driver's code, the letters. */
#include <cairo.h>
#include <stdlib.h>

#include "window_inside.h"

#include "label.h"

static void *load_driver(void *data)
{
	struct offscreen *screen = NULL;

	(void)data;
	/* without EGL the window does it all; it will say what is wrong */
	if (offscreen_create(&screen, &report_none) == ST_OK)
		offscreen_destroy(screen);
	return NULL;
}

void window_load_begin(struct window *w)
{
	if (getenv("DISPLAY") || getenv("WAYLAND_DISPLAY"))
		w->loading = !pthread_create(&w->loader, NULL, load_driver, NULL);
}

void window_load_end(struct window *w)
{
	if (w->loading)
		pthread_join(w->loader, NULL);
	w->loading = false;
}

void window_load_letters(void)
{
	cairo_surface_t *s = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1, 1);
	cairo_t *cr = cairo_create(s);

	for (int i = 0; i < N_LABEL_STYLES; i++)
		label_draw(cr, (enum label_style)i, (struct rgb){ 0, 0, 0 }, 0, 0, 0,
		           "ABCDEFGHIJKLMNOPQRSTUVWXYZ abcdefghijklmnopqrstuvwxyz 0123456789");
	cairo_destroy(cr);
	cairo_surface_destroy(s);
}
