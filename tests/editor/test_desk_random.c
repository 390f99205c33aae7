/* test_desk_random.c - keys, clicks and texts at random: whatever is done, the desk stays whole and can be left.
 * Arguments: seed, how many events. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "desk_stand.h"
#include "file.h"
#include "open.h"
#include "path.h"

enum { SEEDS = 3, EVENTS = 1000, PAINT_EACH = 8, MOUSE_WORD = 24 };

static uint64_t first_seed = 1;
static int n_seeds = SEEDS, n_events = EVENTS;

struct hand {
	struct stand *s;
	uint64_t state;
	bool down[3];
};

/* xorshift64* */
static uint32_t roll(struct hand *h, uint32_t sides)
{
	h->state ^= h->state >> 12;
	h->state ^= h->state << 25;
	h->state ^= h->state >> 27;
	return (uint32_t)((h->state * 0x2545F4914F6CDD1Dull) >> 33) % sides;
}

/* ------------------------------------------------------------ events */

static void press_key(struct hand *h)
{
	static const enum desk_key often[] = { KEY_ENTER, KEY_ESCAPE, KEY_TAB,  KEY_UP,
		                               KEY_DOWN,  KEY_LEFT,   KEY_RIGHT };
	const enum desk_key k =
	        roll(h, 3) ? often[roll(h, 7)] : (enum desk_key)roll(h, KEY_CTRL_Z + 1);

	desk_key(h->s->desk, k, roll(h, 3) ? 0 : roll(h, 8));
	if (k == KEY_SPACE && roll(h, 2))
		desk_space_up(h->s->desk);
}

static void type_some(struct hand *h)
{
	static const uint32_t odd[] = { 0,       7,      0x7F,   0xFC,     0x20AC, 0x4E2D,
		                        0x1F600, 0xD800, 0xFFFF, 0x110000, '"',    '\\' };
	static const char plain[] = "0123456789abcdefghijklmnopqrstuvwxyzABCDFTWXYZ.,;#-=+ ?";
	int n = 1 + (int)roll(h, 6);

	for (int k = 0; k < n; k++)
		desk_text(h->s->desk, roll(h, 8) ? (uint32_t)plain[roll(h, sizeof plain - 1)]
		                                 : odd[roll(h, sizeof odd / sizeof *odd)]);
}

/* A leaf by its code, as it is found. */
static void find_some(struct hand *h)
{
	int n = 0;
	char code[8];

	while (routine_table[n].code)
		n++;
	do
		n = (int)roll(h, (uint32_t)n);
	while (!routine_table[n].run && n);
	snprintf(code, sizeof code, "%s", routine_table[n].code);
	for (uint32_t k = roll(h, 4); k; k--)
		desk_key(h->s->desk, KEY_ESCAPE, 0);
	desk_key(h->s->desk, KEY_CTRL_A + 'K' - 'A', MOD_CTRL);
	for (const char *p = code; *p; p++)
		desk_text(h->s->desk, (unsigned char)*p);
	desk_key(h->s->desk, KEY_ENTER, 0);
	if (roll(h, 2))
		type_some(h);
	if (roll(h, 2))
		desk_key(h->s->desk, KEY_ENTER, 0);
}

static void move_mouse(struct hand *h)
{
	const struct hits *hits = desk_hits(h->s->desk, (enum desk_part)roll(h, N_DESK_PARTS));

	if (hits->n && roll(h, 2)) {
		const struct hit *at = &hits->hit[roll(h, (uint32_t)hits->n)];
		desk_move(h->s->desk, at->x + at->width / 2, at->y + at->height / 2);
	} else {
		desk_move(h->s->desk, (double)roll(h, 1400) - 60, (double)roll(h, 900) - 50);
	}
}

static void use_button(struct hand *h)
{
	const uint32_t b = roll(h, 3);

	if (h->down[b])
		desk_release(h->s->desk, (enum desk_button)b);
	else
		desk_press(h->s->desk, (enum desk_button)b, roll(h, 3) ? 0 : roll(h, 8));
	h->down[b] = !h->down[b];
}

/* What lies under the mouse from now on. */
static void change_pick(struct hand *h)
{
	struct stand *s = h->s;

	s->pick = (struct pick){ .index = -1 };
	if (desk_world_lent(s->desk) || !world_count(s->world) || !roll(h, 4))
		return;
	const struct Ful *f = world_at(s->world, (int)roll(h, (uint32_t)world_count(s->world)));
	s->pick.thing = roll(h, 8) ? f->id : 999; /* it may be gone meanwhile */
	s->pick.is_point = roll(h, 2);
	s->pick.index = (int)roll(h, 20);
	if (f->entity.kind == ENTITY_SURFACE) {
		const struct surface *g = &f->entity.geometry;
		s->pick.u =
		        g->domain[0][0] + 0.01 * roll(h, 101) * (g->domain[0][1] - g->domain[0][0]);
		s->pick.v =
		        g->domain[1][0] + 0.01 * roll(h, 101) * (g->domain[1][1] - g->domain[1][0]);
	}
}

static void change_jobs(struct hand *h)
{
	const enum link_state link = (enum link_state)roll(h, 3);

	for (uint32_t k = roll(h, 4); k; k--)
		stand_put_job(h->s, 1 + roll(h, 30), (enum job_state)roll(h, N_JOB_STATES),
		              roll(h, 2) ? "a reason" : NULL);
	desk_jobs_changed(h->s->desk, link, link == LINK_GONE ? "the service went away" : "");
	struct link_answer a = { .type = MESSAGE_LOG, .job = 1 + roll(h, 30), .n = 1 };
	char log[] = "line one\nline two\n\nlast";
	a.text = log;
	if (roll(h, 2))
		a.type = (enum message_type)(MESSAGE_SUSPEND + (int)roll(h, 5));
	a.status = roll(h, 3) ? ST_OK : ST_INPUT;
	desk_answer(h->s->desk, &a);
}

static void drop_files(struct hand *h)
{
	static const char *const names[] = { "diagonal.base", "spheres.base", "no such file",
		                             "\xff\xfe", "" };
	char *path = NULL;
	const char *name = names[roll(h, 5)];

	assert_true(asprintf(&path, "%s/%s", h->s->folder, name) > 0);
	desk_open(h->s->desk, (const char *const *)&path, 1);
	free(path);
}

static void finish_errand(struct hand *h)
{
	struct errand *e = h->s->errand;

	h->s->errand = NULL;
	if (!e)
		return;
	errand_run(e);
	desk_errand_over(h->s->desk);
}

static void change_window(struct hand *h)
{
	static const double scales[] = { 1, 1.25, 1.5, 2, 3 };

	desk_resize(h->s->desk, 200 + roll(h, 1800), 150 + roll(h, 1200), scales[roll(h, 5)]);
	if (roll(h, 2))
		desk_resize(h->s->desk, 1280, 800, 1);
}

static void happen(struct hand *h)
{
	static void (*const often[])(struct hand *) = { press_key,  type_some,  move_mouse,
		                                        use_button, use_button, find_some };
	static void (*const seldom[])(struct hand *) = { change_pick, change_jobs, drop_files,
		                                         change_window };

	h->s->keep_errands = !roll(h, 8);
	if (h->s->errand && !roll(h, 3))
		finish_errand(h);
	else if (roll(h, 6))
		often[roll(h, 6)](h);
	else if (roll(h, 4))
		seldom[roll(h, 4)](h);
	else if (roll(h, 2))
		desk_scroll(h->s->desk, (double)roll(h, 9) - 4);
	else if (roll(h, 4))
		desk_tick(h->s->desk, 1000 + roll(h, 10000));
	else
		desk_close(h->s->desk);
}

/* ------------------------------------------------------------ what always holds */

static void look_at_words(const struct stand *s)
{
	const struct Mouse_Words w = desk_mouse_words(s->desk);

	for (int k = 0; k < 3; k++) {
		assert_non_null(w.press[k]);
		assert_non_null(w.release[k]);
		assert_true(strlen(w.press[k]) <= MOUSE_WORD);
	}
}

static void look(struct stand *s)
{
	int n;
	struct desk_tile *t = desk_tiles(s->desk, &n);

	assert_true(n == 1 || n == 2 || n == 7);
	assert_true(desk_tile_focus(s->desk) >= 0 && desk_tile_focus(s->desk) < n);
	for (int k = 0; k < n; k++)
		assert_true(isfinite(t[k].box.x + t[k].box.width + t[k].box.height));
	look_at_words(s);
	const struct foot_model *f = desk_foot_model(s->desk);
	assert_true(f->message && f->prompt && f->typed && f->rest && f->range);
	assert_true(f->caret >= 0 && f->caret <= (int)strlen(f->typed) + 64);
	stand_paint(s);
}

/* From wherever one is, a few steps back lead to the main menu; nothing is asked any more. */
static void leave_all(struct hand *h)
{
	struct stand *s = h->s;

	finish_errand(h);
	for (int b = 0; b < 3; b++)
		desk_release(s->desk, (enum desk_button)b);
	desk_space_up(s->desk);
	for (int k = 0; k < 40; k++) {
		stand_key(s, KEY_ESCAPE);
		finish_errand(h);
	}
	assert_null(desk_menu_model(s->desk)->form_code);
	assert_null(desk_list_model(s->desk));
	assert_null(desk_jobs_model(s->desk));
	assert_false(desk_menu_model(s->desk)->world_open);
	assert_false(desk_moving(s->desk));
	assert_int_equal(desk_part_box(s->desk, PART_CARD).width > 0, !world_count(s->world));
}

static int journal_lines(const struct stand *s)
{
	char *path = path_join(s->project.hidden, "journal"), *text = NULL;
	size_t bytes;
	int n = 0;

	if (file_read(path, 1 << 26, &text, &bytes, NULL) == ST_OK)
		for (const char *p = text; *p; p++)
			n += *p == '\n';
	free(text);
	free(path);
	return n;
}

static void play(uint64_t seed)
{
	void *state;

	assert_int_equal(stand_set_up(&state), 0);
	struct hand h = { .s = state, .state = seed * 0x9E3779B97F4A7C15ull + 1 };
	const struct place p = { .folder = h.s->folder };
	place_spheres(&p, "spheres.base", 2);
	place_diagonal(&p, "diagonal.base");
	stand_add_plate(h.s, "plate");
	for (int k = 0; k < n_events; k++) {
		happen(&h);
		if (k % PAINT_EACH == 0)
			look(h.s);
	}
	leave_all(&h);
	assert_true(journal_lines(h.s) >= n_events / 100); /* it got somewhere */
	while (world_undo_name(h.s->world)) /* all that was done can be undone */
		assert_int_equal(world_undo(h.s->world, NULL), ST_OK);
	while (world_redo_name(h.s->world))
		assert_int_equal(world_redo(h.s->world, NULL), ST_OK);
	assert_int_equal(world_keep_session(h.s->world, NULL), ST_OK);
	assert_int_equal(stand_tear_down(&state), 0);
}

static void whatever_is_done_the_desk_stays_whole(void **state)
{
	(void)state;
	for (int k = 0; k < n_seeds; k++) {
		print_message("# seed %llu\n", (unsigned long long)first_seed + (unsigned)k);
		play(first_seed + (unsigned)k);
	}
}

int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(whatever_is_done_the_desk_stays_whole),
	};

	if (argc > 1)
		first_seed = strtoull(argv[1], NULL, 10);
	if (argc > 2)
		n_events = atoi(argv[2]);
	if (argc > 3)
		n_seeds = atoi(argv[3]);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
