/* view_place.c - a world with shapes, and pictures of it in memory. */
#include "view_place.h"

#include <dlfcn.h>
#include <link.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <epoxy/gl.h>
#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>

#include "construct.h"
#include "refine.h"

static struct offscreen *screen;
static struct view *the_view;
static GLuint frame, buffer;

static bool place_open(struct report_store *why)
{
	report_store_init(why);
	if (offscreen_create(&screen, &why->report) != ST_OK)
		return false;
	glGenFramebuffers(1, &frame);
	glGenRenderbuffers(1, &buffer);
	glBindFramebuffer(GL_FRAMEBUFFER, frame);
	glBindRenderbuffer(GL_RENDERBUFFER, buffer);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, SIDE, SIDE);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer);
	return true;
}

/* What a driver leaves behind can be told from our own only while it is loaded. */
static int keep_loaded(struct dl_phdr_info *library, size_t size, void *data)
{
	(void)size;
	(void)data;
	if (*library->dlpi_name)
		dlopen(library->dlpi_name, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
	return 0;
}

static void place_close(void)
{
	dl_iterate_phdr(keep_loaded, NULL);
	glDeleteFramebuffers(1, &frame);
	glDeleteRenderbuffers(1, &buffer);
	view_destroy(the_view);
	offscreen_destroy(screen);
}

int place_tests(int (*run)(void))
{
	struct report_store why;
	if (!place_open(&why)) {
		printf("1..0 # SKIP %s\n", why.error);
		return 0;
	}
	int failed = run();
	place_close();
	pango_cairo_font_map_set_default(NULL);
	cairo_debug_reset_static_data();
	FcFini();
	return failed;
}

struct view *place_view(void)
{
	return the_view;
}

struct world *place_world(void)
{
	struct world *w = NULL;
	assert_int_equal(world_create(&w, "/"), ST_OK);
	/* a view is of one world */
	view_destroy(the_view);
	the_view = NULL;
	assert_int_equal(view_create(&the_view, &report_none), ST_OK);
	return w;
}

static int add(struct world *w, struct entity *e)
{
	char name[16];
	int id = 0;
	snprintf(name, sizeof name, "thing%d", world_count(w));
	assert_int_equal(world_add(w, "add", name, e, &id, &report_none), ST_OK);
	return id;
}

static void set_look(struct world *w, int id, enum surface_look look)
{
	struct display d = world_by_id(w, id)->display;
	d.look = look;
	assert_int_equal(world_set_display(w, id, &d), ST_OK);
}

int place_surface(struct world *w, struct surface *s, struct trim *trim, enum surface_look look)
{
	struct entity e;
	entity_init(&e, ENTITY_SURFACE);
	e.geometry = *s;
	if (trim)
		e.trim = *trim;
	int id = add(w, &e);
	set_look(w, id, look);
	return id;
}

int place_curve(struct world *w, struct curve *c)
{
	struct entity e;
	entity_init(&e, ENTITY_CURVE);
	e.curve = *c;
	return add(w, &e);
}

int place_sphere(struct world *w, double radius, enum surface_look look)
{
	struct surface s;
	assert_int_equal(make_sphere(&s, vec3(0, 0, 0), radius), ST_OK);
	return place_surface(w, &s, NULL, look);
}

int place_torus(struct world *w, enum surface_look look)
{
	struct surface s;
	assert_int_equal(make_torus(&s, vec3(0, 0, 0), 2, 0.7), ST_OK);
	return place_surface(w, &s, NULL, look);
}

int place_holed(struct world *w, enum surface_look look)
{
	const struct vec3 corner[4] = { { -1, -1, 0 }, { 1, -1, 0 }, { -1, 1, 0 }, { 1, 1, 0 } };
	struct surface s;
	struct trim trim = { 0 };
	struct trim_loop loop = { .outer = false };
	struct curve circle;
	assert_int_equal(make_bilinear(&s, corner), ST_OK);
	/* in u, v from 0 to 1: half as large */
	assert_int_equal(make_arc(&circle, vec3(0.5, 0.5, 0), vec3(1, 0, 0), vec3(0, 1, 0), 0.25, 0,
	                          2 * M_PI),
	                 ST_OK);
	curve_reverse(&circle);
	assert_int_equal(trim_loop_add(&loop, &circle), ST_OK);
	assert_int_equal(trim_add(&trim, &loop), ST_OK);
	assert_int_equal(trim_mend(&trim, &s, 1e-9, "square", &report_none), ST_OK);
	return place_surface(w, &s, &trim, look);
}

void place_bare(struct world *w, int id)
{
	struct display d = world_by_id(w, id)->display;
	d.lines_u = d.lines_v = 0;
	assert_int_equal(world_set_display(w, id, &d), ST_OK);
}

struct view_state place_state(const struct world *w, const char *view)
{
	struct view_state s = {
		.theme = THEME_LIGHT, .scale = 1, .quantity = -1, .hover_point = -1
	};
	assert_int_equal(view_fit(&s, w, view, SIDE, SIDE, &report_none), ST_OK);
	return s;
}

void place_draw(const struct world *w, const struct view_state *s, unsigned pixels[SIDE * SIDE])
{
	static unsigned char bytes[SIDE * SIDE][4];
	struct report_store said;
	report_store_init(&said);
	glBindFramebuffer(GL_FRAMEBUFFER, frame);
	bool more = true;
	for (int k = 0; k < 1000 && more; k++) {
		if (view_draw(the_view, w, s, 0, 0, SIDE, SIDE, &more, &said.report) != ST_OK)
			fail_msg("%s", said.error);
		more = more && !s->moving;
	}
	assert_false(more);
	assert_int_equal(glGetError(), GL_NO_ERROR);
	glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
	for (int y = 0; y < SIDE; y++)
		for (int x = 0; x < SIDE; x++) {
			const unsigned char *p = bytes[(SIDE - 1 - y) * SIDE + x];
			pixels[y * SIDE + x] = (unsigned)p[0] << 16 | (unsigned)p[1] << 8 | p[2];
		}
}

int color_apart(unsigned a, unsigned b)
{
	int most = 0;
	for (int shift = 0; shift < 24; shift += 8) {
		int d = abs((int)(a >> shift & 255) - (int)(b >> shift & 255));
		most = d > most ? d : most;
	}
	return most;
}

unsigned color_bytes(struct rgb c)
{
	return (unsigned)lrint(255 * c.r) << 16 | (unsigned)lrint(255 * c.g) << 8 |
	       (unsigned)lrint(255 * c.b);
}
