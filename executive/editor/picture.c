/* picture.c - the world as a picture, for routines. */
#include "modes.h"
#include "view.h"

enum status editor_picture(const struct world *w, const char *path, const char *view, int width,
                           int height, const struct report *r)
{
	return render_picture(w, path, view, width, height, THEME_LIGHT, r);
}
