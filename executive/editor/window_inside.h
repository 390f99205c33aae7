/* window_inside.h - what the files of the window share. */
#ifndef BATTEN_WINDOW_INSIDE_H
#define BATTEN_WINDOW_INSIDE_H

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <pthread.h>
#include <stdatomic.h>

#include "compose.h"
#include "desk.h"
#include "reading_child.h"

struct window {
	GLFWwindow *glfw;
	struct report report;
	struct project project;
	struct menu_set menus;
	struct help *help;
	struct reading_child reading; /* of foreign files */
	struct world *world;
	struct desk *desk;
	struct jobs_link *link;
	struct compose *compose;
	struct view *view;
	struct sheet_part parts[N_DESK_PARTS];
	int width, height; /* of the framebuffer, device px */
	double scale;      /* device px a logical px */
	double per_screen; /* device px a screen coordinate of GLFW */
	double x, y;       /* of the mouse, logical; told to the desk before anything else is */
	bool moved, closing, again; /* again: a view can be drawn better than it was */
	bool soon;                  /* at once: what came new was drawn as while it is dragged */
	int shown;                  /* things when the views were drawn last; -1: they never were */
	pthread_t loader;
	bool loading;
	atomic_bool woken;
	struct errand *errand; /* borrowed from the desk while its thread runs */
	enum link_state link_state;
	unsigned kept_revision; /* of the session on disk */
	double kept_at;
	char title[256];
};

/* window_display.c. Errors: ST_RESOURCE. */
enum status window_connect(struct window *w);
enum status window_open(struct window *w);
void window_mind_display(struct window *w); /* once it is open: see to the end of the X server */
void window_feel_display(struct window *w); /* ends the editor where the X server went away */

/* window_start.c: a thread loads the driver's code, which a software driver has much of; joined before
 * the window is opened. Letters: each kind is drawn once, so that its font is there. */
void window_load_begin(struct window *w);
void window_load_end(struct window *w);
void window_load_letters(void);

/* window_input.c */
void window_listen(struct window *w);
void window_flush_move(struct window *w);
void window_measure(struct window *w); /* sizes and scale, to the desk */

/* window_draw.c */
void window_draw(struct window *w, unsigned dirty);

#endif
