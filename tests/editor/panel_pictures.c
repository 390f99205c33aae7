/* panel_pictures.c - write a PNG of every screen to a folder, to look at: panel-pictures FOLDER. */
#include <stdio.h>
#include <stdlib.h>

#include "panel_screens.h"

static const struct {
	const char *name;
	int width, height;
	double scale;
	enum theme theme;
} sizes[] = {
	{ "dark", 1280, 800, 1, THEME_DARK },        { "light", 1280, 800, 1, THEME_LIGHT },
	{ "2x", 1280, 800, 2, THEME_DARK },          { "1024", 1024, 700, 1, THEME_DARK },
	{ "1024-light", 1024, 700, 1, THEME_LIGHT },
};

int main(int argc, char **argv)
{
	if (argc != 2) {
		fprintf(stderr, "usage: panel-pictures FOLDER\n");
		return 2;
	}
	for (int i = 0; i < n_screens; i++)
		for (size_t j = 0; j < sizeof sizes / sizeof *sizes; j++) {
			const double scale = sizes[j].scale;
			const struct look look = { .theme = sizes[j].theme,
				                   .scale = scale,
				                   .hover_kind = HIT_MENU_ROW,
				                   .hover_index = 4 };
			struct hits hits = { 0 };
			cairo_surface_t *s = cairo_image_surface_create(
			        CAIRO_FORMAT_ARGB32, (int)(sizes[j].width * scale),
			        (int)(sizes[j].height * scale));
			cairo_t *cr = cairo_create(s);
			char path[4096];
			screen_draw(cr, &screens[i], sizes[j].width, sizes[j].height, &look, &hits);
			cairo_destroy(cr);
			snprintf(path, sizeof path, "%s/%s-%s.png", argv[1], screens[i].name,
			         sizes[j].name);
			cairo_status_t st = cairo_surface_write_to_png(s, path);
			cairo_surface_destroy(s);
			hits_finish(&hits);
			if (st != CAIRO_STATUS_SUCCESS) {
				fprintf(stderr, "panel-pictures: cannot write '%s': %s\n", path,
				        cairo_status_to_string(st));
				return 1;
			}
		}
	return 0;
}
