/* test_panel_reference.c - pieces of the window against kept pictures of them. Where the type is not the
 * one they were made with, there is nothing to compare. panel-pictures --pieces makes them anew. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "cmocka_all.h"
#include "label.h"
#include "panel_models.h"
#include "panel_screens.h"

/* How far two pictures are from each other: mean of the channels' distances, and the share of pixels
 * with a channel that is far off. */
struct distance {
	double mean, far;
};

static struct distance between(const struct canvas *c, cairo_surface_t *kept)
{
	enum { FAR = 64 };
	struct distance d = { 0, 0 };
	cairo_surface_flush(c->surface);
	for (int y = 0; y < c->height; y++) {
		const unsigned char *row = cairo_image_surface_get_data(kept) +
		                           (size_t)y * (size_t)cairo_image_surface_get_stride(kept);
		for (int x = 0; x < c->width; x++) {
			const unsigned p = canvas_pixel(c, x, y);
			unsigned q;
			int largest = 0;
			memcpy(&q, row + 4 * (size_t)x, sizeof q);
			for (int shift = 0; shift < 24; shift += 8) {
				const int off =
				        abs((int)(p >> shift & 255) - (int)(q >> shift & 255));
				d.mean += off;
				largest = off > largest ? off : largest;
			}
			d.far += largest > FAR;
		}
	}
	const double n = (double)c->width * c->height;
	return (struct distance){ d.mean / (3 * n), d.far / n };
}

static cairo_surface_t *read_kept(const struct piece *p)
{
	char path[4096];
	snprintf(path, sizeof path, "%s/%s.png", REFERENCE, p->name);
	cairo_surface_t *s = cairo_image_surface_create_from_png(path);
	assert_int_equal(cairo_surface_status(s), CAIRO_STATUS_SUCCESS);
	assert_int_equal(cairo_image_surface_get_width(s), p->width);
	assert_int_equal(cairo_image_surface_get_height(s), p->height);
	return s;
}

static const double mean_most = 1, far_most = 0.005;

static void test_pieces(void **state)
{
	(void)state;
	for (int i = 0; i < n_pieces; i++) {
		struct canvas c;
		canvas_init(&c, pieces[i].width, pieces[i].height, 1, pieces[i].theme, 0);
		pieces[i].paint(c.cr, &c.look);
		cairo_surface_t *kept = read_kept(&pieces[i]);
		const struct distance d = between(&c, kept);
		if (!(d.mean <= mean_most && d.far <= far_most))
			fail_msg("%s: mean %.2f, %.2f %% far off", pieces[i].name, d.mean,
			         100 * d.far);
		cairo_surface_destroy(kept);
		canvas_finish(&c);
	}
}

/* Other words, or the same 2 px lower, are seen as different. */
static void test_notices(void **state)
{
	const struct box_px box = { 0, 0, 320, 148 }, lower = { 0, 2, 320, 148 };
	(void)state;
	cairo_surface_t *kept = read_kept(&pieces[0]);
	for (int i = 0; i < 2; i++) {
		struct canvas c;
		canvas_init(&c, 320, 148, 1, THEME_DARK, 0);
		panel_mouse(c.cr, i ? &lower : &box, i ? &model_mouse : &model_mouse_both, &c.look);
		const struct distance d = between(&c, kept);
		assert_true(d.far > far_most || d.mean > mean_most);
		canvas_finish(&c);
	}
	cairo_surface_destroy(kept);
}

static int forget(void **state)
{
	(void)state;
	canvas_forget_fonts();
	return 0;
}

/* As wide as Inter and DejaVu Sans Mono make them? */
static bool is_the_type(void)
{
	static const struct {
		enum label_style style;
		double width;
	} known[] = { { LABEL_TITLE, 183.797 }, { LABEL_NOTE, 112.094 }, { LABEL_CAP, 110.773 } };
	struct canvas c;
	bool same = true;
	canvas_init(&c, 1, 1, 1, THEME_DARK, 0);
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		same &= fabs(label_width(c.cr, known[i].style, "Hamburgefonts 0123") -
		             known[i].width) < 0.05;
	canvas_finish(&c);
	return same;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_pieces),
		cmocka_unit_test(test_notices),
	};
	if (!is_the_type()) {
		puts("1..0 # SKIP Inter is not installed, or another version of it");
		canvas_forget_fonts();
		return 0;
	}
	return cmocka_run_group_tests(tests, NULL, forget);
}
