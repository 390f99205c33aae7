/* panel_pictures.c - write a PNG of every screen to a folder, to look at, or of the pieces that
 * test_panel_reference.c compares: panel-pictures [--pieces] FOLDER. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
enum { N_SIZES = sizeof sizes / sizeof *sizes };

static bool save(struct canvas *c, const char *folder, const char *name, const char *size)
{
	char path[4096];
	snprintf(path, sizeof path, "%s/%s%s%s.png", folder, name, size ? "-" : "",
	         size ? size : "");
	cairo_status_t st = cairo_surface_write_to_png(c->surface, path);
	canvas_finish(c);
	if (st != CAIRO_STATUS_SUCCESS)
		fprintf(stderr, "panel-pictures: cannot write '%s': %s\n", path,
		        cairo_status_to_string(st));
	return st == CAIRO_STATUS_SUCCESS;
}

static bool save_screens(const char *folder)
{
	for (int i = 0; i < n_screens * N_SIZES; i++) {
		const struct screen *s = &screens[i / N_SIZES];
		const int z = i % N_SIZES;
		struct canvas c;
		canvas_init(&c, sizes[z].width, sizes[z].height, sizes[z].scale, sizes[z].theme, 0);
		c.look.hover_kind = HIT_MENU_ROW;
		c.look.hover_index = 4;
		screen_draw(c.cr, s, sizes[z].width, sizes[z].height, &c.look, NULL);
		if (!save(&c, folder, s->name, sizes[z].name))
			return false;
	}
	return true;
}

static bool save_pieces(const char *folder)
{
	for (int i = 0; i < n_pieces; i++) {
		struct canvas c;
		canvas_init(&c, pieces[i].width, pieces[i].height, 1, pieces[i].theme, 0);
		pieces[i].paint(c.cr, &c.look);
		if (!save(&c, folder, pieces[i].name, NULL))
			return false;
	}
	return true;
}

int main(int argc, char **argv)
{
	const bool only_pieces = argc == 3 && !strcmp(argv[1], "--pieces");
	if (argc != 2 && !only_pieces) {
		fprintf(stderr, "usage: panel-pictures [--pieces] FOLDER\n");
		return 2;
	}
	return (only_pieces ? save_pieces(argv[2]) : save_screens(argv[1])) ? 0 : 1;
}
