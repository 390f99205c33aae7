/* test_panel.c - laws of all that the window's painters paint: where things are, that nothing is cut
 * off, that what is under the mouse answers where it can be clicked, and that letters can be read. */
#include "panel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "cmocka_all.h"
#include "label.h"
#include "panel_models.h"
#include "panel_screens.h"

static const struct {
	int width, height;
} sizes[] = { { 1024, 700 }, { 1280, 800 }, { 1920, 1080 } };
static const double scales[] = { 1, 1.25, 1.5, 2, 3 };
enum { N_SIZES = sizeof sizes / sizeof *sizes, N_SCALES = sizeof scales / sizeof *scales };

static bool within(const struct box_px *b, double x, double y, double width, double height,
                   double slack)
{
	return x >= b->x - slack && y >= b->y - slack && x + width <= b->x + b->width + slack &&
	       y + height <= b->y + b->height + slack;
}

static bool apart(const struct box_px *a, const struct box_px *b)
{
	return a->width <= 0 || b->width <= 0 || a->height <= 0 || b->height <= 0 ||
	       a->x + a->width <= b->x || b->x + b->width <= a->x || a->y + a->height <= b->y ||
	       b->y + b->height <= a->y;
}

/* Parts lie in the window and beside each other, and together they are the window. */
static void test_layout(void **state)
{
	static const int heights[] = { 600, 639, 640, 700, 759, 760, 800, 1080, 2160 };
	static const struct {
		double width, panel;
	} widths[] = { { 1024, 320 }, { 1919, 320 }, { 1920, 352 }, { 2559, 352 }, { 2560, 384 } };
	(void)state;
	for (size_t i = 0; i < sizeof widths / sizeof *widths; i++)
		for (size_t j = 0; j < sizeof heights / sizeof *heights; j++)
			for (int rows = 0; rows <= 14; rows++)
				for (int shown = 0; shown < 2; shown++) {
					const double w = widths[i].width, h = heights[j];
					const struct box_px window = { 0, 0, w, h };
					struct layout l;
					layout_place(&l, w, h, shown, rows);
					const struct box_px *part[] = { &l.top,     &l.panel_top,
						                        &l.view,    &l.menu,
						                        &l.form,    &l.mouse,
						                        &l.message, &l.prompt };
					double area = 0;
					for (int a = 0; a < 8; a++) {
						assert_true(within(&window, part[a]->x, part[a]->y,
						                   part[a]->width, part[a]->height,
						                   0));
						area += part[a]->width * part[a]->height;
						for (int b = 0; b < a; b++)
							assert_true(apart(part[a], part[b]));
					}
					assert_true(fabs(area - w * h) < 1e-6);
					assert_true(l.menu.width == (shown ? widths[i].panel : 0));
					assert_true(l.menu_row == (h < 760 ? 24 : 28));
				}
}

/* Nothing that is asked for can be out of reach: with the longest menu the focused field is seen, and
 * the button can be pressed. */
static void test_form(void **state)
{
	(void)state;
	for (int height = 600; height <= 1080; height += 20) {
		struct form_field fields[5];
		struct menu_model m = model_menu_long;
		m.fields = fields;
		m.n_fields = 5;
		for (int focus = 0; focus < 5; focus++) {
			struct canvas c;
			struct layout l;
			bool field = false, button = false;
			for (int i = 0; i < 5; i++) {
				fields[i] = model_menu_long.fields[0];
				fields[i].focused = i == focus;
			}
			m.scroll = focus % 2 ? 0 : 1000;
			canvas_init(&c, 1, 1, 1, THEME_DARK, 0);
			layout_place(&l, 1024, height, true, m.n_rows);
			panel_menu(c.cr, &l, &m, &c.look, &c.hits);
			for (int i = 0; i < c.hits.n; i++) {
				const struct hit *t = &c.hits.hit[i];
				const bool in = within(&l.form, t->x, t->y, t->width, t->height, 0);
				field |= in && t->kind == HIT_FIELD && t->index == focus;
				button |= in && t->kind == HIT_BUTTON && t->index == 0;
			}
			if (!field || !button)
				fail_msg("height %d, focus %d: field %d, button %d", height, focus,
				         field, button);
			canvas_finish(&c);
		}
	}
}

static bool is_row(enum hit_kind kind)
{
	static const enum hit_kind rows[] = {
		HIT_MENU_ROW, HIT_FIELD,     HIT_CHOICE, HIT_BUTTON,    HIT_CHIP,  HIT_JOB_ROW,
		HIT_TAB,      HIT_CANDIDATE, HIT_RESULT, HIT_HELP_LINK, HIT_CRUMB, HIT_KEY_LOW,
		HIT_KEY_HIGH, HIT_SEARCH,    HIT_WORLD,  HIT_JOB_BOX
	};
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
		if (rows[i] == kind)
			return true;
	return false;
}

/* What can be clicked lies in the window; no two rows of a kind share a place; each is found. */
static void test_hits(void **state)
{
	(void)state;
	for (int s = 0; s < n_screens; s++)
		for (int z = 0; z < N_SIZES; z++) {
			const struct box_px window = { 0, 0, sizes[z].width, sizes[z].height };
			struct canvas c;
			canvas_init(&c, 1, 1, 1, THEME_LIGHT, 0);
			screen_draw(c.cr, &screens[s], window.width, window.height, &c.look,
			            &c.hits);
			assert_true(c.hits.n > 0);
			for (int i = 0; i < c.hits.n; i++) {
				const struct hit *a = &c.hits.hit[i];
				const struct box_px box = { a->x, a->y, a->width, a->height };
				assert_true(within(&window, a->x, a->y, a->width, a->height, 0));
				if (a->kind == HIT_TIP)
					continue;
				const struct hit *top =
				        hits_at(&c.hits, a->x + a->width / 2, a->y + a->height / 2);
				assert_non_null(top);
				assert_true(top >= a);
				for (int j = 0; j < i && is_row(a->kind); j++) {
					const struct hit *b = &c.hits.hit[j];
					const struct box_px other = { b->x, b->y, b->width,
						                      b->height };
					/* a page hides what lies below it */
					if (b->kind == a->kind && !apart(&box, &other) &&
					    hits_at(&c.hits, b->x + b->width / 2,
					            b->y + b->height / 2) == b)
						fail_msg("%s: %d and %d of kind %d share a place",
						         screens[s].name, b->index, a->index,
						         a->kind);
				}
			}
			assert_null(hits_at(&c.hits, -1, -1));
			canvas_finish(&c);
		}
}

static void point_at(struct look *k, const struct hit *h, bool focus)
{
	if (focus) {
		k->focus_kind = h->kind;
		k->focus_index = h->index;
		k->focus_part = h->part;
	} else {
		k->hover_kind = h->kind;
		k->hover_index = h->index;
		k->hover_part = h->part;
	}
}

/* Does it answer the mouse by looks? Squares of color show by their own mark where the mouse is. */
static bool answers(const struct hit *h)
{
	return h->kind != HIT_NONE && h->kind != HIT_TIP && h->kind != HIT_COLOR_WHEEL;
}

/* What is under the mouse changes, and only where it can be clicked (and 4 px about it). */
static void test_hover(void **state)
{
	enum { KINDS = 32, EACH = 3 };
	const double near = 4;
	(void)state;
	for (int s = 0; s < n_screens; s++) {
		struct canvas still, c;
		int seen[KINDS] = { 0 };
		canvas_init(&still, 1024, 700, 1, THEME_DARK, 0);
		canvas_init(&c, 1024, 700, 1, THEME_DARK, 0);
		screen_draw(still.cr, &screens[s], 1024, 700, &still.look, &still.hits);
		for (int i = 0; i < still.hits.n; i++) {
			const struct hit *h = &still.hits.hit[i];
			const double x = h->x + h->width / 2, y = h->y + h->height / 2;
			struct box_px changed, box = { h->x, h->y, h->width, h->height };
			if (hits_at(&still.hits, x, y) != h || !answers(h) ||
			    seen[h->kind]++ >= EACH)
				continue;
			canvas_clear(&c);
			point_at(&c.look, h, false);
			screen_draw(c.cr, &screens[s], 1024, 700, &c.look, &c.hits);
			assert_int_equal(c.hits.n, still.hits.n);
			/* a row that is chosen already stays as it is; a slider's knob may stand apart */
			if (!canvas_extent(&c, &still, &changed))
				continue;
			assert_true(h->kind == HIT_LIGHT ||
			            within(&box, changed.x, changed.y, changed.width,
			                   changed.height, h->kind == HIT_COLOR_VALUE ? 8 : near));
		}
		canvas_finish(&still);
		canvas_finish(&c);
	}
}

/* Is there a screen on which a thing of that kind shows that it is under the mouse or has the focus? */
static bool shows(enum hit_kind kind, bool focus)
{
	bool shown = false;
	for (int s = 0; s < n_screens && !shown; s++) {
		struct canvas still, c;
		struct box_px changed;
		canvas_init(&still, 1024, 700, 1, THEME_LIGHT, 0);
		screen_draw(still.cr, &screens[s], 1024, 700, &still.look, &still.hits);
		for (int i = 0; i < still.hits.n && !shown; i++) {
			const struct hit *h = &still.hits.hit[i];
			if (h->kind != kind || hits_at(&still.hits, h->x + 1, h->y + 1) != h)
				continue;
			canvas_init(&c, 1024, 700, 1, THEME_LIGHT, 0);
			point_at(&c.look, h, focus);
			screen_draw(c.cr, &screens[s], 1024, 700, &c.look, NULL);
			shown = canvas_extent(&c, &still, &changed);
			canvas_finish(&c);
		}
		canvas_finish(&still);
	}
	return shown;
}

static void test_answer(void **state)
{
	static const enum hit_kind hover[] = {
		HIT_MENU_ROW, HIT_CHIP,     HIT_SEARCH,  HIT_BUTTON,     HIT_TAB, HIT_CRUMB,
		HIT_WORLD,    HIT_JOB_ROW,  HIT_JOB_BOX, HIT_RESULT,     HIT_BAR, HIT_HELP_LINK,
		HIT_KEY_LOW,  HIT_KEY_HIGH, HIT_LIGHT,   HIT_COLOR_VALUE
	};
	static const enum hit_kind focus[] = { HIT_MENU_ROW,   HIT_CHIP,      HIT_SEARCH,
		                               HIT_BUTTON,     HIT_TAB,       HIT_CRUMB,
		                               HIT_WORLD,      HIT_BAR,       HIT_CHOICE,
		                               HIT_KEY_LOW,    HIT_HELP_LINK, HIT_LIGHT,
		                               HIT_COLOR_VALUE };
	(void)state;
	for (size_t k = 0; k < sizeof hover / sizeof *hover; k++)
		if (!shows(hover[k], false))
			fail_msg("kind %d does not answer the mouse", hover[k]);
	for (size_t k = 0; k < sizeof focus / sizeof *focus; k++)
		if (!shows(focus[k], true))
			fail_msg("kind %d does not show the focus", focus[k]);
}

/* The window's own texts and usual names have their room at every size and scale. */
static void test_cuts(void **state)
{
	static const char *const whole[] = { "main",  "jobs-none", "help", "search",  "search-none",
		                             "empty", "keys",      "list", "question" };
	(void)state;
	for (int s = 0; s < n_screens; s++) {
		bool checked = false;
		for (size_t i = 0; i < sizeof whole / sizeof *whole; i++)
			checked |= !strcmp(whole[i], screens[s].name);
		for (int z = 0; checked && z < N_SIZES; z++)
			for (int k = 0; k < N_SCALES; k++) {
				struct canvas c;
				canvas_init(&c, 1, 1, 1, THEME_DARK, 0);
				c.look.scale = scales[k];
				cairo_scale(c.cr, scales[k], scales[k]);
				screen_draw(c.cr, &screens[s], sizes[z].width, sizes[z].height,
				            &c.look, NULL);
				if (label_cuts(c.cr))
					fail_msg("%s: %d texts cut at %d x %d, scale %g",
					         screens[s].name, label_cuts(c.cr), sizes[z].width,
					         sizes[z].height, scales[k]);
				canvas_finish(&c);
			}
	}
}

/* The same model gives the same pixels, with layouts kept and without; nothing leaves the window. */
static void test_same(void **state)
{
	(void)state;
	for (int s = 0; s < n_screens; s++)
		for (int k = 0; k < 2; k++) {
			const double scale = k ? 1.25 : 1, margin = 8;
			struct canvas a, b;
			struct box_px box, window = { 0, 0, 1024 * scale, 700 * scale };
			canvas_init(&a, 1024, 700, scale, THEME_LIGHT, margin);
			canvas_init(&b, 1024, 700, scale, THEME_LIGHT, margin);
			screen_draw(a.cr, &screens[s], 1024, 700, &a.look, &a.hits);
			screen_draw(b.cr, &screens[s], 1024, 700, &b.look, &b.hits);
			assert_true(canvas_extent(&a, NULL, &box));
			assert_true(within(&window, box.x, box.y, box.width, box.height, 0.5));
			canvas_clear(&b);
			screen_draw(b.cr, &screens[s], 1024, 700, &b.look, &b.hits);
			assert_false(canvas_extent(&a, &b, &box));
			assert_int_equal(a.hits.n, b.hits.n);
			canvas_finish(&a);
			canvas_finish(&b);
		}
}

/* A text that was cut is told whole under the mouse, and not through a page that lies over it. */
static void test_tips(void **state)
{
	static const char name[] = "teapot lid, upper half, from the import of Tuesday";
	struct canvas c;
	struct layout l;
	struct box_px ink, window = { 0, 0, 1024, 700 };
	int tips = 0;
	(void)state;
	canvas_init(&c, 1024, 700, 1, THEME_DARK, 0);
	layout_place(&l, 1024, 700, true, model_menu_error.n_rows);
	panel_menu(c.cr, &l, &model_menu_error, &c.look, &c.hits);
	for (int i = 0; i < c.hits.n; i++) {
		const struct hit *h = &c.hits.hit[i];
		const double x = h->x + h->width / 2, y = h->y + h->height / 2;
		if (h->kind != HIT_TIP)
			continue;
		tips++;
		assert_string_equal(h->tip, name);
		assert_ptr_equal(hits_tip(&c.hits, x, y), h->tip);
		assert_int_equal(hits_at(&c.hits, x, y)->kind, HIT_FIELD);
	}
	assert_int_equal(tips, 1);
	assert_null(hits_tip(&c.hits, 1, 1));
	panel_search(c.cr, 1024, 700, &model_search, &c.look, &c.hits);
	for (int x = 0; x < 1024; x += 4)
		for (int y = 0; y < 700; y += 4)
			assert_null(hits_tip(&c.hits, x, y));
	/* it is painted in the window, wherever the mouse is */
	for (int corner = 0; corner < 4; corner++) {
		canvas_clear(&c);
		panel_tip(c.cr, 1024, 700, corner % 2 * 1023, corner / 2 * 699, name, &c.look);
		assert_true(canvas_extent(&c, NULL, &ink));
		assert_true(within(&window, ink.x, ink.y, ink.width, ink.height, 0));
		assert_true(ink.width > 200);
	}
	canvas_finish(&c);
}

static double luminance(struct rgb c)
{
	return 0.2126 * rgb_to_linear(c.r) + 0.7152 * rgb_to_linear(c.g) +
	       0.0722 * rgb_to_linear(c.b);
}

static double contrast(struct rgb a, struct rgb b)
{
	const double x = luminance(a), y = luminance(b);
	return (fmax(x, y) + 0.05) / (fmin(x, y) + 0.05);
}

static struct rgb hex(const char *text)
{
	const unsigned long c = strtoul(text + 1, NULL, 16);
	return (struct rgb){ (double)(c >> 16 & 255) / 255, (double)(c >> 8 & 255) / 255,
		             (double)(c & 255) / 255 };
}

/* WCAG 2: 4.5 for letters, 3 for strokes that carry a meaning. */
static void test_contrast(void **state)
{
	static const enum token grounds[] = { TOKEN_VIEW,  TOKEN_BAR,   TOKEN_RAISED,
		                              TOKEN_FIELD, TOKEN_HOVER, TOKEN_TINT };
	static const enum token letters[] = { TOKEN_TEXT,   TOKEN_TEXT2, TOKEN_MUTED,
		                              TOKEN_ACCENT, TOKEN_PRESS, TOKEN_RELEASE };
	static const enum token strokes[] = { TOKEN_EDGE, TOKEN_NET, TOKEN_CURRENT };
	(void)state;
	for (int theme = 0; theme < 2; theme++) {
		for (size_t g = 0; g < sizeof grounds / sizeof *grounds; g++) {
			const struct rgb ground = theme_color(theme, grounds[g]);
			for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
				assert_true(contrast(theme_color(theme, letters[i]), ground) >=
				            4.5);
			for (int i = 0; i < N_JOB_STATES; i++)
				assert_true(contrast(hex(theme == THEME_DARK
				                                 ? job_state_table[i].dark
				                                 : job_state_table[i].light),
				                     ground) >= 4.5);
			for (size_t i = 0; i < sizeof strokes / sizeof *strokes; i++)
				if (grounds[g] != TOKEN_HOVER && grounds[g] != TOKEN_TINT)
					assert_true(contrast(theme_color(theme, strokes[i]),
					                     ground) >= 3);
		}
		assert_true(contrast(theme_color(theme, TOKEN_ONACCENT),
		                     theme_color(theme, TOKEN_ACCENT)) >= 4.5);
	}
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
		cmocka_unit_test(test_layout),   cmocka_unit_test(test_form),
		cmocka_unit_test(test_hits),     cmocka_unit_test(test_hover),
		cmocka_unit_test(test_answer),   cmocka_unit_test(test_cuts),
		cmocka_unit_test(test_same),     cmocka_unit_test(test_tips),
		cmocka_unit_test(test_contrast),
	};
	return cmocka_run_group_tests(tests, NULL, forget);
}
