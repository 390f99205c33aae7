/* window_draw.c - paints what changed and puts it together. */
#include <math.h>
#include <stdio.h>

#include "window_inside.h"

static int px(const struct window *w, double logical)
{
	return (int)lround(logical * w->scale);
}

static void clear_views(struct window *w, enum theme theme)
{
	const struct sight *s = world_sight(w->world);
	struct rgb c = s->has_background ? s->background : theme_color(theme, TOKEN_VIEW);

	glDisable(GL_SCISSOR_TEST);
	glClearColor((float)c.r, (float)c.g, (float)c.b, 1);
	glClear(GL_COLOR_BUFFER_BIT);
}

/* What comes new is seen sooner as it is drawn while dragged: with less of the driver and no samples. */
static bool is_new(const struct window *w)
{
	return world_count(w->world) > w->shown;
}

static void draw_views(struct window *w)
{
	int n;
	const bool soon = is_new(w);
	struct desk_tile *tile = desk_tiles(w->desk, &n);
	struct report_store store;

	report_store_init(&store);
	w->again = false;
	if (compose_view_begin(w->compose, w->width, w->height, &store.report) != ST_OK) {
		desk_say(w->desk, REPORT_ERROR, "%s", store.error);
		return;
	}
	clear_views(w, tile[0].view.theme);
	window_feel_display(w);
	for (int i = n - 1; i >= 0; i--) { /* the one with the keyboard last: its key is told */
		const int k =
		        i ? (i == desk_tile_focus(w->desk) ? 0 : i) : desk_tile_focus(w->desk);
		const struct box_px *b = &tile[k].box;
		int x = px(w, b->x), y = px(w, b->y);
		int width = px(w, b->x + b->width) - x, height = px(w, b->y + b->height) - y;
		bool more = false;
		if (width <= 0 || height <= 0 || tile[k].is_uv)
			continue;
		struct view_state state = tile[k].view;
		state.moving |= soon;
		if (view_draw(w->view, w->world, &state, x, w->height - y - height, width, height,
		              &more, &store.report) != ST_OK)
			desk_say(w->desk, REPORT_ERROR, "%s", store.error);
		w->again |= more;
		window_feel_display(w);
	}
	compose_view_end(w->compose);
	w->soon = soon && w->again;
	w->shown = world_count(w->world);
}

static void paint_part(struct window *w, enum desk_part part)
{
	struct box_px b = desk_part_box(w->desk, part);
	struct sheet_part *p = &w->parts[part];

	if (b.width <= 0 || b.height <= 0) {
		p->width = 0;
		return;
	}
	int x = px(w, b.x), y = px(w, b.y);
	cairo_t *cr = compose_paint_begin(w->compose, p, x, y, px(w, b.x + b.width) - x,
	                                  px(w, b.y + b.height) - y, w->scale);
	if (!cr)
		return;
	desk_paint(w->desk, part, cr);
	window_feel_display(w);
	compose_paint_end(w->compose, p, cr);
	window_feel_display(w);
}

void window_draw(struct window *w, unsigned dirty)
{
	if (w->width <= 0 || w->height <= 0)
		return;
	if ((dirty & DESK_VIEW) && !desk_world_lent(w->desk)) {
		draw_views(w);
		dirty |= 1u << PART_OVER; /* the key says what was drawn */
	}
	for (int i = 0; i < N_DESK_PARTS; i++)
		if (dirty & 1u << i)
			paint_part(w, (enum desk_part)i);
	compose_show(w->compose, w->parts, N_DESK_PARTS, w->width, w->height);
	glfwSwapBuffers(w->glfw);
}
