/* test_panel_extreme.c - painters with models that nobody would make on purpose: empty, huge, no UTF-8, no
 * numbers. They come through, paint nothing outside, and give hits that can be used. */
#include "panel.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "cmocka_all.h"
#include "panel_screens.h"

enum { LONG = 500, MANY_JOBS = 10000, ROWS = 20, FIELDS = 30, CHIPS = 200 };

static char long_name[LONG + 1], long_words[LONG + 1];

/* What stands in every place where a text can be. */
static const char *const texts[] = {
	NULL,
	"",
	"x",
	long_name,
	long_words,
	"\xff\xfe\x80 caf\xe9 \xc3",
	"two\nlines\tand\ra\x01 sign",
	"\xf0\x9f\x9a\xa2 \xd9\x85\xd8\xb1\xd8\xad\xd8\xa8\xd8\xa7 \xe8\x88\xb9",
	"%s%n%d",
	"|||",
	" › › ",
};
enum { N_TEXTS = sizeof texts / sizeof *texts };
static const double numbers[] = {
	0, 1, -1, 0.5, NAN, INFINITY, -INFINITY, 1e300, -1e-300, 123456789
};
enum { N_NUMBERS = sizeof numbers / sizeof *numbers };
static const int counts[] = { 0, 1, -1, INT_MAX, INT_MIN, 7, 100 };
enum { N_COUNTS = sizeof counts / sizeof *counts };

static const struct box_px windows[] = { { 0, 0, 1024, 700 },
	                                 { 0, 0, 1280, 800 },
	                                 { 0, 0, 400, 300 },
	                                 { 0, 0, 1, 1 },
	                                 { 0, 0, 5000, 3000 } };
enum { N_WINDOWS = sizeof windows / sizeof *windows };

struct wild {
	const char *text;
	double number;
	int count;
};

static void paint_frame(struct canvas *c, const struct layout *l, const struct wild *w)
{
	struct chip chips[CHIPS];
	struct menu_row rows[ROWS];
	struct form_field fields[FIELDS];
	for (int i = 0; i < CHIPS; i++)
		chips[i] = (struct chip){ i, i % (N_JOB_STATES + 2), w->text, w->text, w->number };
	for (int i = 0; i < ROWS; i++)
		rows[i] = (struct menu_row){ (char)('0' + i), w->text,    w->text,
			                     i % 2,           i % 3 == 0, i % 5 == 0 };
	for (int i = 0; i < FIELDS; i++)
		fields[i] = (struct form_field){ w->text, w->text, w->text, i % 2 ? w->text : NULL,
			                         i % 3,   w->text, w->text, i == 7,  w->count };
	const struct top_model top = { w->text, w->text, chips, CHIPS };
	const struct menu_model menu = { .crumbs = w->text,
		                         .title = w->text,
		                         .rows = rows,
		                         .n_rows = ROWS,
		                         .form_title = w->text,
		                         .form_code = w->text,
		                         .fields = fields,
		                         .n_fields = FIELDS,
		                         .scroll = w->count,
		                         .main_button = w->text,
		                         .other_button = w->text,
		                         .other_key = w->text };
	const struct Mouse_Words words = { { w->text, w->text, w->text },
		                           { w->text, w->text, w->text } };
	const char *const many[8] = { w->text, w->text, w->text, w->text,
		                      w->text, w->text, w->text, w->text };
	const struct foot_model foot = { .level = REPORT_WARNING,
		                         .message = w->text,
		                         .message_hint = w->text,
		                         .prompt = w->text,
		                         .typed = w->text,
		                         .rest = w->text,
		                         .range = w->text,
		                         .caret = w->count,
		                         .caret_on = true,
		                         .hints = { { w->text, w->text }, { "Esc", w->text } },
		                         .candidates = many,
		                         .candidate_notes = many,
		                         .n_candidates = 8,
		                         .candidate = w->count };
	panel_top(c->cr, &l->top, &top, &c->look, &c->hits);
	panel_menu(c->cr, l, &menu, &c->look, &c->hits);
	panel_mouse(c->cr, &l->mouse, &words, &c->look);
	panel_foot(c->cr, l, &foot, &c->look, &c->hits);
}

static void paint_over(struct canvas *c, const struct layout *l, const struct wild *w, double width,
                       double height)
{
	const double x = w->number;
	const struct probe_model probe = { .title = w->text,
		                           .has_uv = true,
		                           .u = x,
		                           .v = x,
		                           .point = { x, x, x },
		                           .normal = { x, x, x },
		                           .K = x,
		                           .H = x,
		                           .kmax = x,
		                           .kmin = -x,
		                           .unit = w->text };
	const struct key_model key = { .map = { .is_signed = true, .lo = -x, .hi = x, .knee = 1 },
		                       .symbol = w->text,
		                       .unit = w->text,
		                       .below = x,
		                       .above = x };
	struct search_model search = { .typed = w->text,
		                       .caret = w->count,
		                       .n = 8,
		                       .found = w->count,
		                       .all = w->count,
		                       .chosen = w->count };
	for (int i = 0; i < 8; i++)
		search.results[i] =
		        (struct search_result){ w->text, w->text, w->text, w->text, i % 2 };
	const struct help_model help = { w->text, w->text, w->text, w->text, w->text, x };
	struct key_row keys[ROWS];
	for (int i = 0; i < ROWS; i++)
		keys[i] = (struct key_row){ w->text, w->text, i % 2 };
	const struct keys_model sheet = { keys, ROWS, 0 };
	const struct color_model color = { x, x, x, { 0, 0, 0 }, w->text };
	const struct light_model light = { x, x, x };
	const struct bar_model bar = { REPORT_ERROR, w->text, w->text };
	const char *const many[3] = { w->text, w->text, w->text };
	const struct empty_model empty = { many, 3 };
	const struct list_model list = { w->text, many, 3, w->count, many, 3 };
	struct box_px color_box, light_box;
	char code[8];
	panel_heading(c->cr, &l->view, w->text, w->text, true, &c->look);
	panel_probe(c->cr, &l->view, width / 2, height / 2, &probe, &c->look);
	panel_key(c->cr, &l->view, &key, &c->look, &c->hits);
	panel_empty(c->cr, &l->view, &empty, &c->look, &c->hits);
	panel_keys(c->cr, &l->view, &sheet, &c->look);
	panel_cards_place(l, &color_box, &light_box);
	panel_color(c->cr, &color_box, &color, &c->look, &c->hits);
	panel_light(c->cr, &light_box, &light, &c->look, &c->hits);
	panel_bar(c->cr, &l->view, &bar, &c->look, &c->hits);
	panel_help(c->cr, l, &help, &c->look, &c->hits);
	assert_true(panel_help_scroll(c->cr, l, &help) >= 0);
	panel_help_link(w->text, 0, code, sizeof code);
	panel_list(c->cr, &l->view, &list, &c->look, &c->hits);
	panel_search(c->cr, width, height, &search, &c->look, &c->hits);
}

static void check(const struct canvas *c)
{
	assert_int_equal(cairo_status(c->cr), CAIRO_STATUS_SUCCESS);
	for (int i = 0; i < c->hits.n; i++) {
		const struct hit *h = &c->hits.hit[i];
		assert_true(isfinite(h->x) && isfinite(h->y) && h->width > 0 && h->height > 0);
		assert_true(isfinite(h->width) && isfinite(h->height));
	}
}

/* Every text, every number and every count comes by, in windows of all sizes. */
static void test_wild(void **state)
{
	(void)state;
	for (int i = 0; i < 2 * N_TEXTS * N_WINDOWS; i++) {
		const struct wild w = { texts[i % N_TEXTS], numbers[i % N_NUMBERS],
			                counts[i % N_COUNTS] };
		const struct box_px *window = &windows[i % N_WINDOWS];
		struct canvas c;
		struct layout l;
		canvas_init(&c, 64, 64, 1, i % 2, 0);
		layout_place(&l, window->width, window->height, i % 7 != 0, counts[i % N_COUNTS]);
		paint_frame(&c, &l, &w);
		check(&c);
		paint_over(&c, &l, &w, window->width, window->height);
		check(&c);
		canvas_finish(&c);
	}
}

/* 500 letters stay in their part: bars, panel and foot paint in their boxes only. */
static void test_long(void **state)
{
	const double margin = 60;
	(void)state;
	for (int t = 0; t < N_TEXTS; t++) {
		struct canvas c;
		struct layout l;
		struct box_px ink;
		const struct wild w = { texts[t], 0.5, 0 };
		canvas_init(&c, 1024, 700, 1, THEME_DARK, margin);
		layout_place(&l, 1024, 700, true, 14);
		paint_frame(&c, &l, &w);
		assert_true(canvas_extent(&c, NULL, &ink));
		if (ink.x < 0 || ink.y < 0 || ink.x + ink.width > 1024 || ink.y + ink.height > 700)
			fail_msg("text %d paints from %g, %g to %g, %g", t, ink.x, ink.y,
			         ink.x + ink.width, ink.y + ink.height);
		canvas_finish(&c);
	}
}

static void draw_jobs(struct canvas *c, const struct jobs_model *m, const struct layout *l)
{
	canvas_clear(c);
	panel_jobs(c->cr, &l->view, m, &c->look, &c->hits);
	check(c);
}

static int rows_among(const struct canvas *c, int *lowest)
{
	int n = 0;
	*lowest = INT_MAX;
	for (int i = 0; i < c->hits.n; i++)
		if (c->hits.hit[i].kind == HIT_JOB_ROW) {
			n++;
			if (c->hits.hit[i].index < *lowest)
				*lowest = c->hits.hit[i].index;
		}
	return n;
}

/* No job and ten thousand; any scroll gives a full page, the last one ends with the last job. */
static void test_jobs(void **state)
{
	static struct Stats stats[MANY_JOBS];
	static const struct Stats *jobs[MANY_JOBS];
	struct jobs_model m = { .focus = -1 };
	struct canvas c;
	struct layout l;
	int first;
	(void)state;
	canvas_init(&c, 1024, 700, 1, THEME_LIGHT, 0);
	layout_place(&l, 1024, 700, true, 4);
	draw_jobs(&c, &m, &l);
	assert_int_equal(rows_among(&c, &first), 0);

	for (int i = 0; i < MANY_JOBS; i++) {
		stats_init(&stats[i]);
		stats[i].id = i % 3 ? i : INT64_MAX - i;
		stats[i].state = i % N_JOB_STATES;
		stats[i].worker = (char *)texts[i % N_TEXTS];
		stats[i].file_name = (char *)texts[(i + 1) % N_TEXTS];
		stats[i].reason = (char *)texts[(i + 2) % N_TEXTS];
		stats[i].eta_s = numbers[i % N_NUMBERS];
		stats[i].wall_s = numbers[(i + 1) % N_NUMBERS];
		stats[i].done = i % 5 ? i : INT64_MAX;
		stats[i].total = i % 4;
		jobs[i] = &stats[i];
	}
	m = (struct jobs_model){ .jobs = jobs,
		                 .n = MANY_JOBS,
		                 .focus = 3,
		                 .log_title = "log",
		                 .log = texts + 1,
		                 .n_log = N_TEXTS - 1,
		                 .now = NAN };
	const int page = panel_jobs_rows(&l.view);
	assert_true(page > 3);
	const int scrolls[] = { 0, 1, 5000, MANY_JOBS - 1, INT_MAX, INT_MIN };
	for (size_t i = 0; i < sizeof scrolls / sizeof *scrolls; i++) {
		const int last = MANY_JOBS - page;
		m.scroll = scrolls[i];
		draw_jobs(&c, &m, &l);
		assert_int_equal(rows_among(&c, &first), page);
		assert_int_equal(first, scrolls[i] < 0 ? 0 : scrolls[i] > last ? last : scrolls[i]);
	}
	for (int i = 0; i < 40; i++)
		panel_job(c.cr, &l, jobs[i], &c.look);
	check(&c);
	canvas_finish(&c);
}

/* Whatever the light's and the color's numbers are, what is set is a color. */
static void test_color(void **state)
{
	(void)state;
	for (int i = 0; i < N_NUMBERS; i++)
		for (int j = 0; j < N_NUMBERS; j++) {
			const struct color_model m = {
				numbers[i], numbers[j], numbers[i], { 0, 0, 0 }, ""
			};
			const struct rgb c = panel_color_rgb(&m);
			assert_true(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 &&
			            c.b <= 1);
		}
	static const struct {
		double hue;
		struct rgb color;
	} known[] = { { 0, { 1, 0, 0 } },   { 60, { 1, 1, 0 } },  { 120, { 0, 1, 0 } },
		      { 180, { 0, 1, 1 } }, { 240, { 0, 0, 1 } }, { 300, { 1, 0, 1 } },
		      { 360, { 1, 0, 0 } } };
	for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
		const struct color_model m = { known[i].hue, 1, 1, { 0, 0, 0 }, "" };
		const struct rgb c = panel_color_rgb(&m);
		assert_true(fabs(c.r - known[i].color.r) + fabs(c.g - known[i].color.g) +
		                    fabs(c.b - known[i].color.b) <
		            1e-12);
	}
}

static int prepare(void **state)
{
	(void)state;
	memset(long_name, 'W', LONG);
	for (int i = 0; i < LONG; i++)
		long_words[i] = i % 7 == 6 ? ' ' : 'm';
	return 0;
}

static int forget(void **state)
{
	(void)state;
	canvas_forget_fonts();
	return 0;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_wild),
		cmocka_unit_test(test_long),
		cmocka_unit_test(test_jobs),
		cmocka_unit_test(test_color),
	};
	return cmocka_run_group_tests(tests, prepare, forget);
}
