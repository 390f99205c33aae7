/* desk_stand.c - a desk for tests to sit at: a world, ports that note what they are asked, hands and eyes. */
#include "desk_stand.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "path.h"
#include "text.h"

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

enum status stand_picture(const struct world *w, const struct picture_wish *wish,
                          const struct report *r)
{
	(void)w;
	return file_write(wish->path, "a picture", 9, r);
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

/* ------------------------------------------------------------ set up */

int stand_set_up_drawing(void **state, errand_picture *picture)
{
	struct stand *s = calloc(1, sizeof *s);
	struct desk_ports ports = { .pick = port_pick,
		                    .ask_jobs = port_ask,
		                    .start = port_start,
		                    .picture = picture,
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

int stand_set_up(void **state)
{
	return stand_set_up_drawing(state, stand_picture);
}

int stand_tear_down(void **state)
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
int stand_add_plate(struct stand *s, const char *name)
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

unsigned stand_paint(struct stand *s)
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

const struct hit *stand_hit(struct stand *s, enum hit_kind kind, int index, int part)
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

void stand_click_with(struct stand *s, enum hit_kind kind, int index, int part, unsigned mods)
{
	stand_paint(s);
	const struct hit *h = stand_hit(s, kind, index, part);
	assert_non_null(h);
	desk_move(s->desk, h->x + h->width / 2, h->y + h->height / 2);
	desk_press(s->desk, BUTTON_LEFT, mods);
	desk_release(s->desk, BUTTON_LEFT);
	stand_paint(s);
}

void stand_click(struct stand *s, enum hit_kind kind, int index)
{
	stand_click_with(s, kind, index, -1, 0);
}

void stand_type(struct stand *s, const char *ascii)
{
	for (; *ascii; ascii++)
		desk_text(s->desk, (unsigned char)*ascii);
	stand_paint(s);
}

void stand_key(struct stand *s, enum desk_key k)
{
	desk_key(s->desk, k, 0);
	stand_paint(s);
}

const char *stand_title(struct stand *s)
{
	return desk_menu_model(s->desk)->title;
}

const char *stand_message(struct stand *s)
{
	return desk_foot_model(s->desk)->message;
}

/* Go to a leaf as a user would who knows its code. */
void stand_leaf(struct stand *s, const char *code)
{
	stand_type(s, "/");
	stand_type(s, code);
	assert_non_null(desk_search_model(s->desk));
	assert_true(desk_search_model(s->desk)->n > 0);
	assert_string_equal(desk_search_model(s->desk)->results[0].code, code);
	stand_key(s, KEY_ENTER);
}

int stand_row_of(struct stand *s, const char *name)
{
	const struct menu_model *m = desk_menu_model(s->desk);

	for (int i = 0; i < m->n_rows; i++)
		if (!strcmp(m->rows[i].name, name))
			return i;
	fail_msg("there is no %s in %s", name, m->title);
	return -1;
}

const struct menu_row *stand_row(struct stand *s, const char *name)
{
	int i = stand_row_of(s, name);

	return &desk_menu_model(s->desk)->rows[i];
}

const struct form_field *stand_field(struct stand *s, const char *label)
{
	const struct menu_model *m = desk_menu_model(s->desk);

	for (int i = 0; i < m->n_fields; i++)
		if (!strcmp(m->fields[i].label, label))
			return &m->fields[i];
	fail_msg("no field %s", label);
	return NULL;
}

/* ------------------------------------------------------------ jobs */

void stand_put_job(struct stand *s, int64_t id, enum job_state state, const char *reason)
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

void stand_some_jobs(struct stand *s)
{
	stand_put_job(s, 1, JOB_RUNNING, NULL);
	stand_put_job(s, 2, JOB_SUSPENDED, NULL);
	stand_put_job(s, 3, JOB_FAILED, "grid of 0; give 1 or more");
	stand_put_job(s, 4, JOB_QUEUED, "slots full");
	desk_jobs_changed(s->desk, LINK_UP, "");
}
