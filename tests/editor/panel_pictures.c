/* panel_pictures.c - write a PNG of every screen to a folder, to look at: panel-pictures FOLDER. */
#include <stdio.h>
#include <stdlib.h>

#include "canvas.h"
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
			struct canvas c;
			char path[4096];
			canvas_init(&c, sizes[j].width, sizes[j].height, sizes[j].scale,
			            sizes[j].theme, 0);
			c.look.hover_kind = HIT_MENU_ROW;
			c.look.hover_index = 4;
			screen_draw(c.cr, &screens[i], sizes[j].width, sizes[j].height, &c.look,
			            NULL);
			snprintf(path, sizeof path, "%s/%s-%s.png", argv[1], screens[i].name,
			         sizes[j].name);
			cairo_status_t st = cairo_surface_write_to_png(c.surface, path);
			canvas_finish(&c);
			if (st != CAIRO_STATUS_SUCCESS) {
				fprintf(stderr, "panel-pictures: cannot write '%s': %s\n", path,
				        cairo_status_to_string(st));
				return 1;
			}
		}
	return 0;
}
