/* bench_editor.c - what a frame costs while something is dragged, at rest, and what a pick costs. */
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <epoxy/gl.h>

#include "bench.h"
#include "view.h"

enum { WIDTH = 1280, HEIGHT = 800, SIDE = 12, FRAMES = 40, PICKS = 200, TRIANGLES = 95000 };

/* A wavy sheet of 12 x 12 surfaces: nearly as many triangles as may be drawn while it is dragged. */
static void add_sheet(struct world *w, int at_u, int at_v)
{
	enum { N = 24 };
	struct entity e;
	char name[32];
	int id;
	entity_init(&e, ENTITY_SURFACE);
	if (surface_init(&e.geometry, (int[]){ 4, 4 }, (int[]){ N, N }) != ST_OK)
		bench_fail("memory");
	for (int d = 0; d < 2; d++) {
		for (int i = 0; i < N + 4; i++)
			e.geometry.knots[d][i] = fmin(fmax(i - 3, 0), N - 3);
		e.geometry.domain[d][1] = N - 3;
	}
	for (int i = 0; i < N; i++)
		for (int j = 0; j < N; j++) {
			double x = at_u + (double)i / (N - 1), y = at_v + (double)j / (N - 1);
			surface_set_point(&e.geometry, i, j,
			                  vec3(x, y, 0.3 * sin(7.5 * x) * cos(6.5 * y)), 1);
		}
	snprintf(name, sizeof name, "sheet-%d-%d", at_u, at_v);
	if (world_add(w, "add", name, &e, &id, &report_none) != ST_OK)
		bench_fail("a sheet");
	struct display d = world_by_id(w, id)->display;
	d.look = LOOK_SHADED;
	world_set_display(w, id, &d);
}

static GLuint make_target(void)
{
	GLuint frame, color;
	glGenFramebuffers(1, &frame);
	glGenRenderbuffers(1, &color);
	glBindFramebuffer(GL_FRAMEBUFFER, frame);
	glBindRenderbuffer(GL_RENDERBUFFER, color);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, WIDTH, HEIGHT);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
	return frame;
}

static double frame(struct view *v, const struct world *w, const struct view_state *s, bool *more)
{
	double begin = bench_wall();
	if (view_draw(v, w, s, 0, 0, WIDTH, HEIGHT, more, &report_none) != ST_OK)
		bench_fail("a frame");
	glFinish();
	return 1e3 * (bench_wall() - begin);
}

static void print(const char *what, double *ms, int n, double target)
{
	const struct bench_row row = { .row = "editor",
		                       .what = what,
		                       .unit = "ms",
		                       .ours = bench_median(ms, (size_t)n),
		                       .target = target,
		                       .less = true };
	bench_print(&row);
}

static void run(struct view *v, struct world *w)
{
	struct view_state s = {
		.theme = THEME_DARK, .scale = 1, .quantity = -1, .hover_point = -1
	};
	double ms[PICKS], cpu[FRAMES];
	bool more = true;
	if (view_fit(&s, w, NULL, WIDTH, HEIGHT, &report_none) != ST_OK)
		bench_fail("a camera");
	s.moving = true;
	frame(v, w, &s, &more);
	for (int i = 0; i < FRAMES; i++) {
		view_rotate(&s, w, 1, 0.2);
		double begin = bench_cpu();
		ms[i] = frame(v, w, &s, &more);
		cpu[i] = 1e3 * (bench_cpu() - begin);
	}
	print("frame while dragging, 1280 x 800, 100,000 triangles", ms, FRAMES, 45);
	print("the same, processor time of all threads", cpu, FRAMES, 0);
	if (view_triangles(v) < TRIANGLES)
		bench_fail("too few triangles were drawn");
	s.moving = false;
	for (more = true; more;)
		frame(v, w, &s, &more);
	for (int i = 0; i < FRAMES / 4; i++) {
		view_rotate(&s, w, 0.01, 0);
		ms[i] = frame(v, w, &s, &more);
	}
	print("frame at rest, the same, 4 samples a pixel", ms, FRAMES / 4, 0);
	for (int i = 0; i < FRAMES; i++) {
		s.probe = (struct mark){ world_at(w, 0)->id, 10 + 0.1 * i, 10 };
		ms[i] = frame(v, w, &s, &more);
	}
	print("frame with the probe following the mouse", ms, FRAMES, 16);
	struct pick pick;
	view_pick(v, w, &s, 1, 1, true, 0, &pick);
	for (int i = 0; i < PICKS; i++) {
		double begin = bench_wall();
		view_pick(v, w, &s, 340 + 3 * i, 400, true, 0, &pick);
		ms[i] = 1e3 * (bench_wall() - begin);
	}
	print("pick under the mouse, 144 surfaces", ms, PICKS, 5);
}

int main(void)
{
	struct offscreen *screen = NULL;
	struct world *w = NULL;
	struct view *v = NULL;
	struct report r = report_stderr("bench-editor");
	mallopt(M_MMAP_THRESHOLD, 32 << 20); /* as the window has it */
	mallopt(M_TRIM_THRESHOLD, 128 << 20);
	if (offscreen_create(&screen, &r) != ST_OK)
		return 77;
	if (view_create(&v, &r) != ST_OK || world_create(&w, "/") != ST_OK)
		bench_fail("the view");
	for (int i = 0; i < SIDE; i++)
		for (int j = 0; j < SIDE; j++)
			add_sheet(w, i, j);
	glBindFramebuffer(GL_FRAMEBUFFER, make_target());
	run(v, w);
	view_destroy(v);
	world_destroy(w);
	offscreen_destroy(screen);
	return 0;
}
