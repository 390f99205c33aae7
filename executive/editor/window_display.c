/* window_display.c - the display, the window on it, and the day it goes away. */
#include <X11/Xlib.h>
#include <epoxy/glx.h>
#include <locale.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "window_inside.h"

enum { WIDTH = 1280, HEIGHT = 800, WIDTH_MIN = 640, HEIGHT_MIN = 480 };

/* Nothing of X may be called any more. What is open is kept; jobs are the service's. */
static void display_gone(Display *d, void *data)
{
	struct window *w = data;

	(void)d;
	fputs("batten: the display went away; jobs go on, and the session is kept\n", stderr);
	if (!desk_world_lent(w->desk))
		world_keep_session(w->world, &w->report);
	_exit(1);
}

/* Xlib hears of it when it next has something to send, which is seconds away in a large frame. */
void window_feel_display(struct window *w)
{
	Display *d = glXGetCurrentDisplay();

	if (!d)
		return;
	struct pollfd p = { .fd = ConnectionNumber(d) };
	if (poll(&p, 1, 0) == 1 && (p.revents & (POLLHUP | POLLERR)))
		display_gone(d, w);
}

/* Xlib would write a sentence of its own. */
static int display_error(Display *d)
{
	(void)d;
	return 0;
}

void window_mind_display(struct window *w)
{
	XSetIOErrorHandler(display_error);
	if (glXGetCurrentDisplay())
		XSetIOErrorExitHandler(glXGetCurrentDisplay(), display_gone, w);
}

enum status window_connect(struct window *w)
{
	const char *why = NULL;
	bool display = getenv("DISPLAY") || getenv("WAYLAND_DISPLAY");
	const char *locale = setlocale(LC_CTYPE, "");

	/* X drops what is typed beyond ASCII in a locale without it */
	if (!locale || !strcmp(locale, "C") || !strcmp(locale, "POSIX"))
		setlocale(LC_CTYPE, "C.UTF-8");

	if (!glfwInit()) {
		glfwGetError(&why);
		return report_error(&w->report, ST_RESOURCE,
		                    display ? "the display cannot be used: %s; batten run, script "
		                              "and render need none"
		                            : "there is no display (DISPLAY is not set)%.0s; "
		                              "batten run, script and render need none",
		                    why ? why : "no reason was given");
	}
	return ST_OK;
}

enum status window_open(struct window *w)
{
	const char *why = NULL;

	glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
	glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
	glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
	glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
	glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
	glfwWindowHint(GLFW_DEPTH_BITS, 0);
	glfwWindowHint(GLFW_STENCIL_BITS, 0);
	glfwWindowHintString(GLFW_X11_CLASS_NAME, "batten");
	glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "batten");
	int x, y, width = WIDTH, height = HEIGHT;
	glfwGetMonitorWorkarea(glfwGetPrimaryMonitor(), &x, &y, &width, &height);
	/* on a small screen as large as that is */
	w->glfw = glfwCreateWindow(width > 0 && width < WIDTH ? width : WIDTH,
	                           height > 0 && height < HEIGHT ? height : HEIGHT, "Batten", NULL,
	                           NULL);
	if (!w->glfw) {
		glfwGetError(&why);
		return report_error(&w->report, ST_RESOURCE,
		                    "no window with OpenGL 3.3 can be opened: %s; batten run, "
		                    "script and render need none",
		                    why ? why : "no reason was given");
	}
	glfwMakeContextCurrent(w->glfw);
	/* in software there is no picture to wait for */
	const char *renderer = (const char *)glGetString(GL_RENDERER);
	bool software = renderer && (strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe"));
	glfwSwapInterval(software ? 0 : 1);
	glfwSetWindowSizeLimits(w->glfw, WIDTH_MIN, HEIGHT_MIN, GLFW_DONT_CARE, GLFW_DONT_CARE);
	return ST_OK;
}
