/* picture.c - the world as a picture, for routines. */
#include <string.h>

#include "modes.h"
#include "view.h"

enum status editor_picture(const struct world *w, const struct picture_wish *wish,
                           const struct report *r)
{
	struct render_options o = { .view = wish->view,
		                    .beside = wish->beside,
		                    .width = wish->width,
		                    .height = wish->height,
		                    .theme = THEME_LIGHT };

	for (int k = 0; k < N_PICTURE_VIEWS; k++)
		if (wish->views && !strcmp(wish->views, picture_views_words[k]))
			o.views = (enum picture_views)k;
	return render_write(w, wish->path, &o, r);
}
