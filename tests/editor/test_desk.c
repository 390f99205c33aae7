/* test_desk.c - the editor without its window: events in, models out. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "desk.h"
#include "path.h"
#include "text.h"

struct stand {
	char folder[64];
	struct project project;
	struct world *world;
	struct menu_set menus;
	struct help *help;
	struct desk *desk;
	cairo_surface_t *paper;
	bool closed, keep_errands;
	int bells;
	struct errand *errand; /* kept, not run */
	enum message_type asked;
	int64_t ids[8];
	int n_ids;
	struct pick pick;
};

/* ------------------------------------------------------------ ports */

static void port_close(void *data)
{
	((struct stand *)data)->closed = true;
}

static void port_bell(void *data)
{
	((struct stand *)data)->bells++;
}

static void port_ask(void *data, enum message_type type, const int64_t *ids, int n)
{
	struct stand *s = data;

	if (type == MESSAGE_LOG)
		return;
	s->asked = type;
	s->n_ids = n < 8 ? n : 8;
	memcpy(s->ids, ids, (size_t)s->n_ids * sizeof *ids);
}

static bool port_start(void *data, struct errand *e)
{
	struct stand *s = data;

	if (s->keep_errands)
		s->errand = e;
	return s->keep_errands;
}

static bool port_pick(void *data, const struct view_state *v, double x, double y, bool points,
                      int skip, struct pick *out)
{
	struct stand *s = data;

	(void)v;
	(void)x;
	(void)y;
	(void)skip;
	*out = s->pick;
	return s->pick.thing && (!points || s->pick.is_point);
}

/* ------------------------------------------------------------ set up */

static int set_up(void **state)
{
	struct stand *s = calloc(1, sizeof *s);
	struct desk_ports ports = { .pick = port_pick,
		                    .ask_jobs = port_ask,
		                    .start = port_start,
		                    .bell = port_bell,
		                    .close = port_close,
		                    .data = s };

	*state = s;
	strcpy(s->folder, "/tmp/batten-desk-XXXXXX");
	assert_non_null(mkdtemp(s->folder));
	assert_int_equal(project_find(&s->project, s->folder, NULL), ST_OK);
	assert_int_equal(project_make(&s->project, NULL), ST_OK);
	assert_int_equal(world_create(&s->world, s->folder), ST_OK);
	assert_int_equal(menu_set_read(&s->menus, NULL, 0, NULL), ST_OK);
	assert_int_equal(help_read(&s->help, getenv("BATTEN_HELP"), NULL, 0, NULL), ST_OK);
	struct desk_house house = { s->world, &s->project, &s->menus, s->help, THEME_DARK };
	assert_int_equal(desk_create(&s->desk, &house, &ports), ST_OK);
	s->paper = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1280, 800);
	desk_tick(s->desk, 1000);
	return 0;
}

static int tear_down(void **state)
{
	struct stand *s = *state;
	char *command = text_print("rm -rf %s", s->folder);

	desk_destroy(s->desk);
	cairo_surface_destroy(s->paper);
	help_destroy(s->help);
	menu_set_finish(&s->menus);
	world_destroy(s->world);
	project_finish(&s->project);
	assert_int_equal(system(command), 0);
	free(command);
	free(s);
	return 0;
}

/* A bent plate of 4 x 4 points. */
static int add_plate(struct stand *s, const char *name)
{
	const int order[2] = { 4, 4 }, n[2] = { 4, 4 };
	struct entity e;
	int id = 0;

	entity_init(&e, ENTITY_SURFACE);
	assert_int_equal(surface_init(&e.geometry, order, n), ST_OK);
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 4; j++)
			surface_set_point(&e.geometry, i, j,
			                  (struct vec3){ i, j, 0.2 * i * (3 - i) }, 1);
	for (int k = 0; k < 8; k++)
		e.geometry.knots[0][k] = e.geometry.knots[1][k] = k >= 4;
	for (int k = 0; k < 2; k++)
		e.geometry.domain[k][1] = 1;
	assert_int_equal(world_add(s->world, "add plate", name, &e, &id, NULL), ST_OK);
	desk_resize(s->desk, 1280, 800, 1); /* whatever comes first lets it look at the world */
	return id;
}

/* ------------------------------------------------------------ hands and eyes */

static unsigned paint(struct stand *s)
{
	unsigned dirty = desk_take_dirty(s->desk);

	for (int i = 0; i < N_DESK_PARTS; i++)
		if (dirty & 1u << i) {
			cairo_t *cr = cairo_create(s->paper);
			desk_paint(s->desk, (enum desk_part)i, cr);
			cairo_destroy(cr);
		}
	return dirty;
}

static const struct hit *find_hit(struct stand *s, enum hit_kind kind, int index, int part)
{
	for (int p = N_DESK_PARTS - 1; p >= 0; p--) {
		const struct hits *h = desk_hits(s->desk, (enum desk_part)p);
		for (int i = 0; i < h->n; i++)
			if (h->hit[i].kind == kind && h->hit[i].index == index &&
			    (part < 0 || h->hit[i].part == part))
				return &h->hit[i];
	}
	return NULL;
}

static void click_with(struct stand *s, enum hit_kind kind, int index, int part, unsigned mods)
{
	paint(s);
	const struct hit *h = find_hit(s, kind, index, part);
	assert_non_null(h);
	desk_move(s->desk, h->x + h->width / 2, h->y + h->height / 2);
	desk_press(s->desk, BUTTON_LEFT, mods);
	desk_release(s->desk, BUTTON_LEFT);
	paint(s);
}

static void click(struct stand *s, enum hit_kind kind, int index)
{
	click_with(s, kind, index, -1, 0);
}

static void type(struct stand *s, const char *ascii)
{
	for (; *ascii; ascii++)
		desk_text(s->desk, (unsigned char)*ascii);
	paint(s);
}

static void key(struct stand *s, enum desk_key k)
{
	desk_key(s->desk, k, 0);
	paint(s);
}

static const char *title(struct stand *s)
{
	return desk_menu_model(s->desk)->title;
}

static const char *message(struct stand *s)
{
	return desk_foot_model(s->desk)->message;
}

/* Go to a leaf as a user would who knows its code. */
static void find_leaf(struct stand *s, const char *code)
{
	type(s, "/");
	type(s, code);
	assert_non_null(desk_search_model(s->desk));
	assert_true(desk_search_model(s->desk)->n > 0);
	assert_string_equal(desk_search_model(s->desk)->results[0].code, code);
	key(s, KEY_ENTER);
}

static int row_of(struct stand *s, const char *name)
{
	const struct menu_model *m = desk_menu_model(s->desk);

	for (int i = 0; i < m->n_rows; i++)
		if (!strcmp(m->rows[i].name, name))
			return i;
	fail_msg("there is no %s in %s", name, m->title);
	return -1;
}

static const struct menu_row *row(struct stand *s, const char *name)
{
	int i = row_of(s, name);

	return &desk_menu_model(s->desk)->rows[i];
}

static const struct form_field *field(struct stand *s, const char *label)
{
	const struct menu_model *m = desk_menu_model(s->desk);

	for (int i = 0; i < m->n_fields; i++)
		if (!strcmp(m->fields[i].label, label))
			return &m->fields[i];
	fail_msg("no field %s", label);
	return NULL;
}

/* ------------------------------------------------------------ menus */

static void the_menus_are_walked_by_mouse_and_by_keys(void **state)
{
	struct stand *s = *state;
	char top[48];

	paint(s);
	snprintf(top, sizeof top, "%s", title(s));
	static const char *const way[] = { "GEOMETRY INTERROGATION", "SURFACE", "CURVATURE" };
	for (int by_key = 0; by_key < 2; by_key++) {
		for (int i = 0; i < 3; i++) {
			assert_true(row(s, way[i])->is_menu);
			if (by_key)
				desk_text(s->desk, (unsigned char)row(s, way[i])->key);
			else
				click(s, HIT_MENU_ROW, row_of(s, way[i]));
			paint(s);
		}
		assert_string_equal(row(s, "GAUSSIAN")->name, "GAUSSIAN");
		assert_non_null(strstr(desk_menu_model(s->desk)->crumbs, "›"));
		if (by_key)
			for (int i = 0; i < 3; i++)
				key(s, KEY_ESCAPE);
		else
			click(s, HIT_CRUMB, 0);
		assert_string_equal(title(s), top);
	}
	key(s, KEY_ESCAPE); /* at the top nothing is left */
	assert_string_equal(title(s), top);
	assert_false(s->closed);
	key(s, KEY_TAB);
	key(s, KEY_ENTER);
	assert_string_not_equal(title(s), top);
}

static void the_world_menu_is_a_key_away_and_back(void **state)
{
	struct stand *s = *state;
	char before[48];

	type(s, "1");
	snprintf(before, sizeof before, "%s", title(s));
	type(s, "w");
	assert_true(desk_menu_model(s->desk)->world_open);
	row_of(s, "STATUS ROUTINES");
	type(s, "W");
	assert_string_equal(title(s), before);
	click(s, HIT_WORLD, 0);
	assert_true(desk_menu_model(s->desk)->world_open);
	key(s, KEY_ESCAPE);
	assert_string_equal(title(s), before);
}

/* Whatever is chosen asks, runs, opens something, or says in words why it does not. */
static void every_leaf_does_something_or_says_why(void **state)
{
	struct stand *s = *state;
	int asked = 0, told = 0;

	add_plate(s, "plate");
	for (const struct routine *t = routine_table; t->code; t++) {
		const struct Menu_Entry *e = menu_set_find(&s->menus, t->code, NULL);
		assert_non_null(e);
		const char *greyed = routine_greyed(t, s->world);
		char *why = greyed ? strdup(greyed) : NULL, before[48];
		desk_say(s->desk, REPORT_INFO, "nothing was said");
		find_leaf(s, t->code);
		snprintf(before, sizeof before, "%s", title(s));
		const struct menu_model *m = desk_menu_model(s->desk);
		bool said = strcmp(message(s), "nothing was said") != 0;
		bool page = desk_jobs_model(s->desk) || desk_list_model(s->desk);
		bool menu = m->n_rows && !strstr(m->crumbs, "›");
		bool form = m->form_code && !strcmp(m->form_code, t->code);
		if (!(said || page || menu || form || s->closed))
			fail_msg("%s %s did nothing", t->code, e->name);
		if (why && !page && !menu && !s->closed && !strstr(message(s), why))
			fail_msg("%s %s is greyed for '%s' and said '%s'", t->code, e->name, why,
			         message(s));
		asked += form;
		told += said;
		free(why);
		s->closed = false;
		for (int i = 0; i < 6; i++)
			key(s, KEY_ESCAPE);
		assert_null(desk_menu_model(s->desk)->form_code);
	}
	assert_true(asked > 40);
	assert_true(told > 60);
}

static void greyed_rows_say_why(void **state)
{
	struct stand *s = *state;

	find_leaf(s, "V80");
	assert_non_null(strstr(message(s), routine_greyed(routine_find("V80"), s->world)));
	const struct menu_model *m = desk_menu_model(s->desk);
	for (int i = 0; i < m->n_rows; i++)
		if (m->rows[i].greyed)
			assert_true(*m->rows[i].state);
	assert_true(row(s, "GAUSSIAN")->greyed);
	add_plate(s, "plate");
	assert_false(row(s, "GAUSSIAN")->greyed);
}

/* ------------------------------------------------------------ asking */

static void a_form_takes_utf8_and_runs(void **state)
{
	struct stand *s = *state;
	int id = add_plate(s, "plate");
	char *journal = path_join(s->project.hidden, "journal");

	find_leaf(s, "V180");
	assert_true(field(s, "Name")->focused);
	desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
	desk_text(s->desk, 'R');
	desk_text(s->desk, 0xFC);
	desk_text(s->desk, 'd');
	desk_text(s->desk, 'e');
	desk_text(s->desk, 'r');
	desk_text(s->desk, 'w'); /* no World menu while it is typed */
	assert_string_equal(field(s, "Name")->value, "R\u00FCderw");
	assert_string_equal(desk_foot_model(s->desk)->typed, "R\u00FCderw");
	assert_int_equal(desk_foot_model(s->desk)->caret, 7);
	key(s, KEY_BACKSPACE);
	key(s, KEY_ENTER);
	assert_string_equal(world_by_id(s->world, id)->name, "R\u00FCder");
	assert_null(desk_menu_model(s->desk)->form_code);
	assert_true(path_exists(journal));
	free(journal);
}

static void a_bad_field_keeps_its_text_and_says_why(void **state)
{
	struct stand *s = *state;

	add_plate(s, "plate");
	find_leaf(s, "V57");
	click(s, HIT_FIELD, 1);
	desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
	type(s, "many");
	key(s, KEY_ENTER);
	assert_string_equal(desk_menu_model(s->desk)->form_code, "V57");
	const struct form_field *f = &desk_menu_model(s->desk)->fields[1];
	assert_string_equal(f->value, "many");
	assert_true(f->focused);
	assert_true(f->error && *f->error);
	assert_int_equal(desk_foot_model(s->desk)->level, REPORT_ERROR);
	desk_key(s->desk, KEY_CTRL_A + 'R' - 'A', MOD_CTRL); /* the defaults */
	assert_null(desk_menu_model(s->desk)->fields[1].error);
	key(s, KEY_UP); /* a step of a whole number */
	key(s, KEY_ENTER);
	assert_null(desk_menu_model(s->desk)->form_code);
	assert_int_equal(world_current(s->world, false)->display.lines_v, 8);
}

static void names_are_completed_and_values_come_back(void **state)
{
	struct stand *s = *state;

	add_plate(s, "bow");
	add_plate(s, "stern");
	find_leaf(s, "V159");
	desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
	type(s, "b");
	const struct foot_model *m = desk_foot_model(s->desk);
	assert_int_equal(m->n_candidates, 1);
	assert_string_equal(m->candidates[0], "bow");
	assert_string_equal(m->rest, "ow");
	key(s, KEY_TAB);
	assert_string_equal(desk_foot_model(s->desk)->typed, "bow");
	key(s, KEY_ENTER);
	assert_string_equal(world_current(s->world, false)->name, "bow");
	find_leaf(s, "V159");
	desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
	paint(s);
	click(s, HIT_CANDIDATE, 1);
	assert_string_equal(desk_foot_model(s->desk)->typed, "stern");
	key(s, KEY_ENTER);
	assert_string_equal(world_current(s->world, false)->name, "stern");
	find_leaf(s, "V159");
	desk_key(s->desk, KEY_CTRL_A + 'P' - 'A', MOD_CTRL);
	desk_key(s->desk, KEY_CTRL_A + 'P' - 'A', MOD_CTRL);
	assert_string_equal(desk_foot_model(s->desk)->typed, "bow");
}

static void a_surface_asked_for_can_be_picked(void **state)
{
	struct stand *s = *state;
	int id = add_plate(s, "bow");

	add_plate(s, "stern");
	find_leaf(s, "V159");
	assert_string_equal(desk_mouse_words(s->desk).press[0], "PICK SURFACE");
	s->pick = (struct pick){ .thing = id };
	desk_move(s->desk, 400, 300);
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_release(s->desk, BUTTON_LEFT);
	assert_string_equal(desk_foot_model(s->desk)->typed, "bow");
}

static void edits_are_undone_by_key(void **state)
{
	struct stand *s = *state;
	int id = add_plate(s, "plate");
	double x = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 0, 0, NULL).x;

	find_leaf(s, "V185");
	type(s, "1,0,0");
	key(s, KEY_ENTER);
	struct vec3 p = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 0, 0, NULL);
	assert_true(fabs(p.x - x - 1) < 1e-12);
	type(s, "z");
	p = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 0, 0, NULL);
	assert_true(p.x == x);
	type(s, "Z");
	p = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 0, 0, NULL);
	assert_true(fabs(p.x - x - 1) < 1e-12);
}

/* ------------------------------------------------------------ search, help, keys */

static void routines_are_found_by_name_code_and_help(void **state)
{
	struct stand *s = *state;
	bool found = false;

	type(s, "/isophote");
	const struct search_model *m = desk_search_model(s->desk);
	for (int i = 0; i < m->n; i++)
		found |= !strcmp(m->results[i].code, "V90");
	assert_true(found);
	assert_true(m->all > 180);
	key(s, KEY_DOWN);
	assert_int_equal(desk_search_model(s->desk)->chosen, 1);
	key(s, KEY_TAB); /* to its menu, not running it */
	assert_null(desk_search_model(s->desk));
	assert_null(desk_menu_model(s->desk)->form_code);
	desk_key(s->desk, KEY_CTRL_A + 'K' - 'A', MOD_CTRL);
	type(s, "zzzzqq");
	assert_int_equal(desk_search_model(s->desk)->n, 0);
	key(s, KEY_ENTER);
	key(s, KEY_ESCAPE);
	assert_null(desk_search_model(s->desk));
}

static void help_is_of_what_is_under_the_mouse(void **state)
{
	struct stand *s = *state;

	find_leaf(s, "V162");
	key(s, KEY_ESCAPE);
	paint(s);
	const struct hit *h = find_hit(s, HIT_MENU_ROW, row_of(s, "KILL JOBS"), -1);
	assert_non_null(h);
	desk_move(s->desk, h->x + 5, h->y + 5);
	key(s, KEY_F1);
	assert_string_equal(desk_help_model(s->desk)->code, "V165");
	assert_true(strlen(desk_help_model(s->desk)->text) > 100);
	key(s, KEY_F1);
	assert_null(desk_help_model(s->desk));
	type(s, "?");
	assert_true(desk_keys_model(s->desk)->n > 15);
	key(s, KEY_ESCAPE);
	desk_say(s->desk, REPORT_INFO, "first");
	desk_say(s->desk, REPORT_INFO, "second");
	key(s, KEY_F4);
	assert_string_equal(desk_list_model(s->desk)->lines[0], "second");
	for (int i = 0; i < 300; i++)
		desk_say(s->desk, REPORT_INFO, "line %d", i);
	assert_int_equal(desk_list_model(s->desk)->n, 200);
}

/* ------------------------------------------------------------ jobs */

static void put_job(struct stand *s, int64_t id, enum job_state state, const char *reason)
{
	struct Stats j;

	stats_init(&j);
	j.id = id;
	j.worker = strdup("curvature");
	j.file_name = strdup("hull.igs");
	j.state = state;
	j.reason = reason ? strdup(reason) : NULL;
	j.ended = job_state_table[state].over ? 990 : 0;
	assert_int_equal(job_shelf_put(desk_shelf(s->desk), &j), ST_OK);
	stats_finish(&j);
}

static void some_jobs(struct stand *s)
{
	put_job(s, 1, JOB_RUNNING, NULL);
	put_job(s, 2, JOB_SUSPENDED, NULL);
	put_job(s, 3, JOB_FAILED, "grid of 0; give 1 or more");
	put_job(s, 4, JOB_QUEUED, "slots full");
	desk_jobs_changed(s->desk, LINK_UP, "");
}

static void jobs_are_picked_and_steered(void **state)
{
	struct stand *s = *state;

	some_jobs(s);
	type(s, "j");
	const struct jobs_model *m = desk_jobs_model(s->desk);
	assert_int_equal(m->n, 4);
	assert_int_equal(m->jobs[0]->id, 4);
	click(s, HIT_JOB_ROW, 3);
	type(s, "s");
	assert_int_equal(s->asked, MESSAGE_SUSPEND);
	assert_int_equal(s->n_ids, 1);
	assert_int_equal(s->ids[0], 1);
	click(s, HIT_JOB_BOX, 2); /* job 2, too */
	assert_true(desk_jobs_model(s->desk)->can[0]);
	type(s, "a"); /* acts on those it applies to */
	assert_int_equal(s->asked, MESSAGE_ACTIVATE);
	assert_int_equal(s->ids[0], 2);
	s->asked = 0;
	type(s, "k");
	assert_non_null(strstr(desk_foot_model(s->desk)->prompt, "Kill 2 jobs"));
	key(s, KEY_ENTER); /* kills nothing */
	assert_int_equal(s->asked, 0);
	key(s, KEY_ESCAPE);
	assert_int_equal(s->asked, 0);
	assert_non_null(desk_jobs_model(s->desk));
	type(s, "ky");
	assert_int_equal(s->asked, MESSAGE_KILL);
	assert_int_equal(s->n_ids, 2);
	click_with(s, HIT_BUTTON, 0, GROUP_JOBS, 0);
	assert_int_equal(s->asked, MESSAGE_SUSPEND);
	click(s, HIT_TAB, 3);
	assert_int_equal(desk_jobs_model(s->desk)->n, 1);
	click(s, HIT_JOB_ROW, 0);
	assert_non_null(strstr(desk_jobs_model(s->desk)->log_title, "grid of 0"));
	type(s, "r");
	assert_int_equal(s->asked, MESSAGE_RETRY);
	assert_int_equal(s->ids[0], 3);
}

static void the_world_menu_steers_jobs(void **state)
{
	struct stand *s = *state;

	some_jobs(s);
	find_leaf(s, "V163");
	assert_non_null(desk_jobs_model(s->desk));
	click(s, HIT_JOB_ROW, 3);
	click(s, HIT_MENU_ROW, row_of(s, "SUSPEND JOBS"));
	assert_int_equal(s->asked, MESSAGE_SUSPEND);
	assert_int_equal(s->ids[0], 1);
	click(s, HIT_MENU_ROW, row_of(s, "KILL JOBS"));
	type(s, "y");
	assert_int_equal(s->asked, MESSAGE_KILL);
	assert_string_equal(row(s, "KILL JOBS")->state, "3 can");
}

static void news_of_jobs_is_told_once_with_the_bell(void **state)
{
	struct stand *s = *state;

	world_sight(s->world)->bell = true;
	put_job(s, 1, JOB_RUNNING, NULL);
	put_job(s, 2, JOB_DONE, NULL); /* before we came */
	desk_jobs_changed(s->desk, LINK_UP, "");
	assert_int_equal(s->bells, 0);
	assert_int_equal(desk_top_model(s->desk)->n_chips, 2);
	put_job(s, 1, JOB_FAILED, "the disk is full");
	desk_jobs_changed(s->desk, LINK_UP, "");
	desk_jobs_changed(s->desk, LINK_UP, "");
	assert_int_equal(s->bells, 1);
	assert_non_null(strstr(message(s), "the disk is full"));
	type(s, "l"); /* its log, as the hint says */
	assert_non_null(desk_jobs_model(s->desk));
	key(s, KEY_ESCAPE);
	click(s, HIT_CHIP, 0);
	assert_non_null(desk_jobs_model(s->desk));
}

/* ------------------------------------------------------------ loss of work */

static void quitting_asks_only_where_something_is_lost(void **state)
{
	struct stand *s = *state;

	desk_close(s->desk);
	assert_true(s->closed);
	s->closed = false;
	add_plate(s, "plate");
	find_leaf(s, "V133");
	assert_false(s->closed);
	assert_non_null(desk_list_model(s->desk));
	key(s, KEY_ESCAPE);
	assert_false(s->closed);
	some_jobs(s);
	desk_close(s->desk);
	assert_int_equal(desk_list_model(s->desk)->n_buttons, 4);
	click_with(s, HIT_BUTTON, 1, GROUP_LIST, 0);
	assert_int_equal(s->asked, MESSAGE_SUSPEND);
	assert_int_equal(s->ids[0], 1);
	assert_true(s->closed);
	s->closed = false;
	desk_close(s->desk);
	type(s, "n");
	assert_false(s->closed);
	desk_close(s->desk);
	type(s, "l");
	assert_true(s->closed);
}

/* ------------------------------------------------------------ errands */

static void a_long_errand_holds_the_world_and_can_be_stopped(void **state)
{
	struct stand *s = *state;

	add_plate(s, "plate");
	paint(s);
	s->keep_errands = true;
	find_leaf(s, "V175");
	type(s, "nothing.igs");
	desk_key(s->desk, KEY_ESCAPE, 0);
	find_leaf(s, "V178");
	type(s, "plate.igs");
	desk_key(s->desk, KEY_ESCAPE, 0);
	const char *files[] = { "missing.igs" };
	desk_open(s->desk, files, 1);
	assert_non_null(s->errand);
	assert_true(desk_world_lent(s->desk));
	assert_string_equal(desk_mouse_words(s->desk).press[0], "");
	unsigned dirty = desk_take_dirty(s->desk);
	assert_false(dirty & (DESK_VIEW | 1u << PART_MENU | 1u << PART_OVER));
	assert_true(dirty & 1u << PART_FOOT);
	type(s, "z"); /* no undo meanwhile: says so */
	assert_non_null(strstr(message(s), "Esc"));
	key(s, KEY_ESCAPE);
	errand_run(s->errand);
	desk_errand_over(s->desk);
	assert_false(desk_world_lent(s->desk));
	assert_true(paint(s) & DESK_VIEW);
	assert_int_equal(desk_foot_model(s->desk)->level, REPORT_ERROR);
}

/* ------------------------------------------------------------ views and tools */

static void the_mouse_turns_and_words_tell(void **state)
{
	struct stand *s = *state;
	int n;

	assert_string_equal(desk_mouse_words(s->desk).press[2], "");
	add_plate(s, "plate");
	find_leaf(s, "V99"); /* anything that runs: the view is fitted */
	key(s, KEY_ENTER);
	key(s, KEY_HOME);
	assert_string_equal(desk_mouse_words(s->desk).press[0], "ROTATE VIEW");
	struct camera before = desk_tiles(s->desk, &n)[0].view.camera;
	desk_move(s->desk, 400, 300);
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_move(s->desk, 460, 330);
	assert_true(desk_moving(s->desk));
	struct camera turned = desk_tiles(s->desk, &n)[0].view.camera;
	assert_true(vec3_dot(before.ahead, turned.ahead) < 0.999);
	key(s, KEY_ESCAPE); /* as before */
	assert_true(vec3_dot(before.ahead, desk_tiles(s->desk, &n)[0].view.camera.ahead) >
	            1 - 1e-12);
	desk_move(s->desk, 400, 300);
	desk_scroll(s->desk, 1);
	assert_true(desk_tiles(s->desk, &n)[0].view.camera.half < before.half);
	desk_key(s->desk, KEY_LEFT, 0);
	assert_true(vec3_dot(before.ahead, desk_tiles(s->desk, &n)[0].view.camera.ahead) < 0.9999);
	world_sight(s->world)->all_curvatures = true;
	world_touch(s->world);
	desk_take_dirty(s->desk);
	desk_tiles(s->desk, &n);
	assert_int_equal(n, 7);
}

static void the_probe_is_kept_as_a_mark(void **state)
{
	struct stand *s = *state;
	int id = add_plate(s, "plate");

	s->pick = (struct pick){ .thing = id, .u = 0.25, .v = 0.5 };
	desk_move(s->desk, 400, 300);
	desk_press(s->desk, BUTTON_RIGHT, 0);
	assert_true(desk_part_box(s->desk, PART_PROBE).width > 0);
	assert_int_equal(world_marks(s->world), 0);
	desk_release(s->desk, BUTTON_RIGHT);
	assert_int_equal(world_marks(s->world), 1);
	assert_true(world_mark(s->world, 0)->u == 0.25);
	key(s, KEY_ESCAPE);
	assert_true(desk_part_box(s->desk, PART_PROBE).width == 0);
}

static void the_light_is_dragged_live_and_taken_back(void **state)
{
	struct stand *s = *state;

	add_plate(s, "plate");
	find_leaf(s, "V73");
	assert_string_equal(desk_mouse_words(s->desk).press[0], "MOVE LIGHT");
	double azimuth = world_sight(s->world)->light_azimuth;
	paint(s);
	const struct hit *h = find_hit(s, HIT_LIGHT, 0, -1);
	assert_non_null(h);
	double x = h->x + h->width / 2, y = h->y + h->height / 2, quarter = h->width / 4;
	desk_move(s->desk, x, y - quarter);
	desk_press(s->desk, BUTTON_LEFT, 0);
	assert_true(fabs(world_sight(s->world)->light_azimuth - 90) < 1);
	assert_true(fabs(world_sight(s->world)->light_incidence - 45) < 1.5);
	assert_string_equal(field(s, "Azimuth")->value, "90");
	desk_move(s->desk, x - quarter, y);
	desk_release(s->desk, BUTTON_LEFT);
	assert_true(fabs(world_sight(s->world)->light_azimuth - 180) < 1);
	key(s, KEY_ESCAPE);
	assert_true(world_sight(s->world)->light_azimuth == azimuth);
	find_leaf(s, "V73");
	desk_move(s->desk, 480, 100); /* in the view, above its middle */
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_release(s->desk, BUTTON_LEFT);
	key(s, KEY_ENTER);
	assert_true(fabs(world_sight(s->world)->light_azimuth - 90) < 5);
}

static void a_color_is_seen_while_it_is_chosen(void **state)
{
	struct stand *s = *state;

	add_plate(s, "plate");
	find_leaf(s, "V157");
	paint(s);
	const struct hit *h = find_hit(s, HIT_COLOR_WHEEL, 0, -1);
	assert_non_null(h);
	desk_move(s->desk, h->x + h->width - 1, h->y + 1); /* full saturation, full value */
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_release(s->desk, BUTTON_LEFT);
	assert_true(world_sight(s->world)->has_background);
	struct rgb c = world_sight(s->world)->background;
	assert_true(fmax(c.r, fmax(c.g, c.b)) > 0.95);
	assert_true(fmin(c.r, fmin(c.g, c.b)) < 0.05);
	key(s, KEY_ESCAPE);
	assert_false(world_sight(s->world)->has_background);
}

static void a_drag_of_a_point_is_one_step(void **state)
{
	struct stand *s = *state;
	int id = add_plate(s, "plate");

	key(s, KEY_HOME);
	find_leaf(s, "V127");
	assert_string_equal(desk_mouse_words(s->desk).press[0], "PICK POINT");
	s->pick = (struct pick){ .thing = id, .is_point = true, .index = 5 };
	struct vec3 before =
	        surface_get_point(&world_by_id(s->world, id)->entity.geometry, 1, 1, NULL);
	desk_move(s->desk, 480, 390);
	desk_press(s->desk, BUTTON_LEFT, 0);
	assert_string_equal(desk_menu_model(s->desk)->fields[0].value, "1,1");
	for (int i = 1; i < 20; i++)
		desk_move(s->desk, 480 + 10 * i, 390 - 5 * i);
	struct vec3 meanwhile =
	        surface_get_point(&world_by_id(s->world, id)->entity.geometry, 1, 1, NULL);
	assert_true(vec3_length(vec3_sub(meanwhile, before)) > 0.1);
	desk_release(s->desk, BUTTON_LEFT);
	struct vec3 after =
	        surface_get_point(&world_by_id(s->world, id)->entity.geometry, 1, 1, NULL);
	assert_true(vec3_length(vec3_sub(after, meanwhile)) < 1e-6);
	assert_string_equal(desk_menu_model(s->desk)->form_code, "V127"); /* for the next point */
	key(s, KEY_ESCAPE);
	type(s, "z");
	after = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 1, 1, NULL);
	assert_true(vec3_length(vec3_sub(after, before)) == 0);
}

static void keys_of_the_window_paint_what_they_change(void **state)
{
	struct stand *s = *state;

	add_plate(s, "plate");
	paint(s);
	assert_int_equal(desk_take_dirty(s->desk), 0);
	desk_move(s->desk, 500, 400);
	assert_int_equal(desk_take_dirty(s->desk) & DESK_VIEW, 0); /* hovering draws no view */
	double width = desk_part_box(s->desk, PART_TOP).width;
	desk_key(s->desk, KEY_F9, 0);
	assert_true(desk_part_box(s->desk, PART_TOP).width > width);
	assert_true(desk_part_box(s->desk, PART_MENU).width == 0);
	desk_key(s->desk, KEY_F9, 0);
	int n;
	enum theme theme = desk_tiles(s->desk, &n)[0].view.theme;
	desk_key(s->desk, KEY_F10, 0);
	assert_int_not_equal(desk_tiles(s->desk, &n)[0].view.theme, theme);
	assert_true(desk_take_dirty(s->desk) & DESK_VIEW);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(the_menus_are_walked_by_mouse_and_by_keys),
		TEST(the_world_menu_is_a_key_away_and_back),
		TEST(every_leaf_does_something_or_says_why),
		TEST(greyed_rows_say_why),
		TEST(a_form_takes_utf8_and_runs),
		TEST(a_bad_field_keeps_its_text_and_says_why),
		TEST(names_are_completed_and_values_come_back),
		TEST(a_surface_asked_for_can_be_picked),
		TEST(edits_are_undone_by_key),
		TEST(routines_are_found_by_name_code_and_help),
		TEST(help_is_of_what_is_under_the_mouse),
		TEST(jobs_are_picked_and_steered),
		TEST(the_world_menu_steers_jobs),
		TEST(news_of_jobs_is_told_once_with_the_bell),
		TEST(quitting_asks_only_where_something_is_lost),
		TEST(a_long_errand_holds_the_world_and_can_be_stopped),
		TEST(the_mouse_turns_and_words_tell),
		TEST(the_probe_is_kept_as_a_mark),
		TEST(the_light_is_dragged_live_and_taken_back),
		TEST(a_color_is_seen_while_it_is_chosen),
		TEST(a_drag_of_a_point_is_one_step),
		TEST(keys_of_the_window_paint_what_they_change),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
