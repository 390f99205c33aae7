/* window.c - the editor's window: what it stands on, and its loop. */
#include "modes.h"

#include <X11/Xlib.h>
#include <epoxy/glx.h>
#include <malloc.h>
#include <math.h>
#include <pango/pangocairo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "window_inside.h"

#include "path.h"

static const double KEEP_S = 60, AGAIN_S = 0.25;

static double now_s(void)
{
	struct timespec t;

	clock_gettime(CLOCK_REALTIME, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ------------------------------------------------------------ what the desk wants */

static void wake(void *data)
{
	struct window *w = data;

	if (!atomic_exchange(&w->woken, true))
		glfwPostEmptyEvent();
}

static bool port_pick(void *data, const struct view_state *v, double x, double y, bool points,
                      int skip, struct pick *out)
{
	struct window *w = data;

	return view_pick(w->view, w->world, v, x, y, points, skip, out) == ST_OK;
}

static bool port_key(void *data, struct key *out)
{
	struct window *w = data;

	return view_key(w->view, out);
}

static void port_ask_jobs(void *data, enum message_type type, const int64_t *ids, int n)
{
	struct window *w = data;

	if (w->link && jobs_link_ask(w->link, type, ids, n) != ST_OK)
		desk_say(w->desk, REPORT_ERROR, "no thread can be started to ask the service");
}

static void port_restart_jobs(void *data)
{
	struct window *w = data;

	jobs_link_restart(w->link);
}

static bool port_start(void *data, struct errand *e)
{
	struct window *w = data;

	if (errand_start(e, wake, w) != ST_OK)
		return false;
	w->errand = e;
	return true;
}

static void port_bell(void *data)
{
	struct window *w = data;
	Display *d = glXGetCurrentDisplay();

	(void)w;
	if (d)
		XBell(d, 0);
}

static void port_close(void *data)
{
	struct window *w = data;

	w->closing = true;
}

static void port_copy(void *data, const char *text)
{
	struct window *w = data;

	glfwSetClipboardString(w->glfw, text);
}

static const char *port_paste(void *data)
{
	struct window *w = data;

	return glfwGetClipboardString(w->glfw);
}

/* ------------------------------------------------------------ life */

static enum status make_house(struct window *w)
{
	enum status st = project_find(&w->project, NULL, &w->report);

	if (st == ST_OK)
		st = project_make(&w->project, &w->report);
	if (st == ST_OK)
		st = world_create(&w->world, w->project.folder);
	if (st == ST_OK)
		world_set_reader(w->world, reading_child, &w->reading);
	if (st == ST_OK)
		st = menu_set_load(&w->menus, w->project.folder, &w->report);
	if (st == ST_OK)
		st = help_load(&w->help, w->project.folder, &w->report);
	return st;
}

static enum status make_desk(struct window *w)
{
	const struct desk_ports ports = {
		.pick = port_pick,
		.key = port_key,
		.ask_jobs = port_ask_jobs,
		.restart_jobs = port_restart_jobs,
		.start = port_start,
		.picture = editor_picture,
		.bell = port_bell,
		.close = port_close,
		.copy = port_copy,
		.paste = port_paste,
		.data = w,
	};
	const struct desk_house house = { w->world, &w->project, &w->menus, w->help, THEME_DARK };
	struct report_store store;

	report_store_init(&store);
	enum status session = world_restore_session(w->world, &store.report);
	w->kept_revision = world_revision(w->world);
	w->kept_at = now_s();
	enum status st = desk_create(&w->desk, &house, &ports);
	if (st != ST_OK)
		return report_error(&w->report, st, "memory ran out");
	if (store.n_warnings)
		desk_say(w->desk, REPORT_WARNING, "%s", store.warning);
	if (session != ST_OK)
		desk_say(w->desk, REPORT_WARNING, "%s", store.error);
	desk_tick(w->desk, now_s());
	return ST_OK;
}

static enum status make_views(struct window *w)
{
	enum status st = compose_create(&w->compose, &w->report);

	if (st == ST_OK)
		st = view_create(&w->view, &w->report);
	if (st != ST_OK)
		return st;
	window_listen(w);
	window_mind_display(w);
	window_measure(w);
	return ST_OK;
}

static void keep_session(struct window *w)
{
	struct report_store store;

	if (desk_world_lent(w->desk) || world_revision(w->world) == w->kept_revision)
		return;
	report_store_init(&store);
	if (world_keep_session(w->world, &store.report) != ST_OK)
		desk_say(w->desk, REPORT_WARNING, "%s", store.error);
	w->kept_revision = world_revision(w->world);
	w->kept_at = now_s();
}

static void finish(struct window *w)
{
	window_load_end(w);
	if (w->link)
		keep_session(w);
	jobs_link_destroy(w->link);
	desk_destroy(w->desk);
	for (int i = 0; i < N_DESK_PARTS; i++)
		if (w->glfw)
			compose_part_finish(&w->parts[i]);
	view_destroy(w->view);
	compose_destroy(w->compose);
	if (w->glfw)
		glfwDestroyWindow(w->glfw);
	glfwTerminate();
	world_destroy(w->world);
	help_destroy(w->help);
	menu_set_finish(&w->menus);
	project_finish(&w->project);
}

/* ------------------------------------------------------------ the loop */

static void take_news(struct window *w)
{
	struct link_answer a;
	enum link_state state;
	char reason[256];

	if (!atomic_exchange(&w->woken, false))
		return;
	int n = jobs_link_take(w->link, desk_shelf(w->desk), &state, reason);
	if (n || state != w->link_state)
		desk_jobs_changed(w->desk, state, reason);
	w->link_state = state;
	while (jobs_link_answer(w->link, &a)) {
		desk_answer(w->desk, &a);
		link_answer_finish(&a);
	}
	if (w->errand && errand_over(w->errand)) {
		w->errand = NULL;
		desk_errand_over(w->desk);
	} else if (w->errand) {
		desk_errand_progress(w->desk);
	}
}

static void set_title(struct window *w)
{
	char title[sizeof w->title];

	if (desk_world_lent(w->desk))
		return;
	snprintf(title, sizeof title, "%.200s%s - Batten", desk_top_model(w->desk)->project,
	         world_unsaved(w->world) ? " *" : "");
	if (strcmp(title, w->title))
		glfwSetWindowTitle(w->glfw, title);
	memcpy(w->title, title, sizeof title);
}

static void wait_events(struct window *w)
{
	double now = now_s(), until = desk_next_tick(w->desk);

	if (w->again && !desk_moving(w->desk))
		until = fmin(until, now + AGAIN_S);
	if (!desk_world_lent(w->desk) && world_revision(w->world) != w->kept_revision)
		until = fmin(until, fmax(w->kept_at + KEEP_S, now + 1));
	if (w->soon && !desk_world_lent(w->desk))
		glfwPollEvents();
	else if (isinf(until))
		glfwWaitEvents();
	else
		glfwWaitEventsTimeout(fmax(until - now, 0.001));
}

static void loop(struct window *w)
{
	while (!w->closing) {
		window_flush_move(w);
		take_news(w);
		unsigned dirty = desk_take_dirty(w->desk);
		if (w->again && !desk_moving(w->desk))
			dirty |= DESK_VIEW;
		if (dirty) {
			window_draw(w, dirty);
			set_title(w);
		}
		if (w->closing)
			break;
		wait_events(w);
		desk_tick(w->desk, now_s());
		if (now_s() - w->kept_at > KEEP_S)
			keep_session(w);
	}
}

int mode_window(int argc, char **argv)
{
	/* a software driver takes megabytes for each frame and gives them back: they stay with us */
	mallopt(M_MMAP_THRESHOLD, 32 << 20);
	mallopt(M_TRIM_THRESHOLD, 128 << 20);
	struct window w = { .report = report_stderr("batten"),
		            .link_state = LINK_CONNECTING,
		            .shown = -1 };
	window_load_begin(&w);
	pango_cairo_font_map_get_default(); /* a thread of its own finds the fonts */
	enum status st = window_connect(&w);

	if (st == ST_OK)
		st = make_house(&w);
	if (st == ST_OK)
		st = make_desk(&w);
	if (st == ST_OK) { /* files are read while the driver makes the window */
		desk_open(w.desk, (const char *const *)argv, argc);
		window_load_letters();
		window_load_end(&w);
		st = window_open(&w);
	}
	if (st == ST_OK)
		st = make_views(&w);
	if (st == ST_OK)
		st = jobs_link_create(&w.link, &w.project, wake, &w, &w.report);
	if (st == ST_OK)
		loop(&w);
	finish(&w);
	return status_exit(st);
}
