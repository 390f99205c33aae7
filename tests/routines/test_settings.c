/* test_settings.c - settings are stored, shown again as defaults, and drawn. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "acting.h"
#include "file.h"
#include "path.h"

/* Default of an argument as it would be asked for now; "-": none. */
static void assert_default(struct acting *a, const char *code, const char *name,
                           const char *expected)
{
	struct argument_row *rows;

	assert_int_equal(routine_rows(&rows, routine_find(code), &a->act), ST_OK);
	for (const struct argument_row *row = rows; row->name; row++)
		if (!strcmp(row->name, name)) {
			assert_string_equal(row->def ? row->def : "-", expected);
			routine_rows_free(rows);
			return;
		}
	fail_msg("%s has no %s", code, name);
}

static void assert_state(struct acting *a, const char *code, const char *expected)
{
	char state[48];

	routine_state(routine_find(code), a->place.world, state);
	assert_string_equal(state, expected);
}

static int open_both(void **state)
{
	acting_setup(state);
	struct acting *a = *state;
	place_diagonal(&a->place, "diagonal.base");
	acting_does(a, "V175 file=diagonal.base entity=1");
	return 0;
}

static void test_stored(void **state)
{
	struct acting *a = *state;
	struct world *w = a->place.world;

	assert_default(a, "V73", "azimuth", "-");
	acting_does(a, "V73 azimuth=30 intensity=2");
	assert_string_equal(world_default(w, "shading", "azimuth"), "30");
	assert_string_equal(world_default(w, "isophotes", "azimuth"), "30");
	assert_null(world_default(w, "isophotes", "intensity"));
	assert_true(world_sight(w)->light_azimuth == 30 && world_sight(w)->light_intensity == 2);
	assert_default(a, "V73", "azimuth", "30");
	acting_does(a, "V73 azimuth=auto");
	assert_null(world_default(w, "shading", "azimuth"));
	assert_string_equal(world_default(w, "shading", "intensity"), "2");

	assert_state(a, "V174", "default");
	acting_does(a, "V174 grid=400x200");
	assert_state(a, "V174", "400 × 200");
	acting_fails(a, "V174 grid=0x200", ST_PARAMETER, "grid is");
	acting_does(a, "V88 count=5 from=10 to=80");
	assert_state(a, "V88", "5, 10, 80");
	acting_does(a, "V77 reflectivity=0.5 stripes=4");
	assert_string_equal(world_default(w, "raytrace", "mirror"), "0.5");
	assert_state(a, "V79", "");
	assert_state(a, "V166", "");
}

static void test_display(void **state)
{
	struct acting *a = *state;
	const struct Ful *c = acting_thing(a, "diagonal"), *s = acting_thing(a, "diagonal-surface");

	acting_does(a, "V50 segments=12");
	acting_does(a, "V51 linetype=dashed");
	acting_does(a, "V53 samples=33");
	acting_does(a, "V54 scale=0.5");
	assert_true(c->display.segments == 12 && c->display.line == LINE_DASHED &&
	            c->display.quills == 33 && c->display.porcupine && c->display.quill == 0.5);
	assert_default(a, "V50", "segments", "12");
	assert_default(a, "V51", "linetype", "dashed");
	acting_does(a, "V54 scale=0");
	assert_false(c->display.porcupine);
	acting_does(a, "V56");
	assert_false(c->display.on);
	acting_does(a, "V55");
	assert_true(c->display.on);
	acting_fails(a, "V43 segments=12", ST_PARAMETER, "no curve in space");

	acting_does(a, "V57 lines_u=3 lines_v=4 segments=50");
	assert_true(s->display.lines_u == 3 && s->display.lines_v == 4 &&
	            s->display.segments == 50);
	assert_state(a, "V57", "3, 4, 50");
	assert_state(a, "V58", "default");
	acting_does(a, "V58 color=#FF8000");
	assert_state(a, "V58", "#FF8000");
	assert_true(s->display.has_color && s->display.color.r == 1 && s->display.color.b == 0);
	assert_default(a, "V72", "color", "#FF8000");
	acting_does(a, "V99 on=no");
	assert_false(s->display.on);
	assert_default(a, "V99", "on", "yes");
	assert_state(a, "V99", "off");
	acting_does(a, "V167 on=no");
	assert_false(world_sight(a->place.world)->bell);
	assert_state(a, "V167", "off");
	acting_does(a, "V157 color=#000000");
	assert_true(world_sight(a->place.world)->has_background);
	assert_null(world_undo_name(a->place.world)); /* none of this is an edit */
}

static void test_views(void **state)
{
	struct acting *a = *state;
	const struct camera *c = &world_sight(a->place.world)->camera;

	acting_does(a, "V59 view=top");
	assert_true(world_sight(a->place.world)->has_camera && c->ahead.z == -1 &&
	            c->kind == CAMERA_ORTHOGRAPHIC);
	const double half = c->half;
	/* in perspective and back: what is in the middle keeps its size */
	acting_does(a, "V166 field=40");
	assert_int_equal(c->kind, CAMERA_PERSPECTIVE);
	const double away = vec3_dot(vec3_sub(vec3(0, 0, 0), c->eye), c->ahead);
	assert_true(c->half * away > half * (1 - 1e-12) && c->half * away < half * (1 + 1e-12));
	acting_does(a, "V166 orthographic=yes near=1 far=90");
	assert_true(c->kind == CAMERA_ORTHOGRAPHIC && c->half > half * (1 - 1e-12) &&
	            c->half < half * (1 + 1e-12));
	assert_true(world_sight(a->place.world)->near_ == 1);
	acting_fails(a, "V166 near=5 far=2", ST_PARAMETER, "beyond near");
	acting_does(a, "V99 on=no");
	acting_does(a, "V56");
	acting_fails(a, "V59 view=top", ST_PARAMETER, "nothing is shown");
}

/* Values along a curve on a sphere of radius 3. */
static void test_table(void **state)
{
	struct acting *a = *state;
	char *path = place_path(&a->place, "comb.csv");

	acting_does(a, "V53 samples=11");
	acting_does(a, "V54 save=comb.csv");
	FILE *f = fopen(path, "r");
	assert_non_null(f);
	char line[512];
	assert_non_null(fgets(line, sizeof line, f));
	assert_string_equal(
	        line, "t,length,x,y,z,curvature,torsion,normal_curvature,geodesic_curvature\n");
	int rows = 0;
	double before = -1;
	for (; fgets(line, sizeof line, f); rows++) {
		double v[9];
		assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &v[0], &v[1],
		                        &v[2], &v[3], &v[4], &v[5], &v[6], &v[7], &v[8]),
		                 9);
		assert_true(v[1] > before);
		before = v[1];
		const double r = vec3_length(vec3(v[2], v[3], v[4]));
		assert_true(r > 3 - 1e-12 && r < 3 + 1e-12);
		assert_true(v[7] * v[7] > 1.0 / 9 - 1e-9 && v[7] * v[7] < 1.0 / 9 + 1e-9);
		assert_true(v[5] * v[5] - v[7] * v[7] - v[8] * v[8] < 1e-9);
	}
	assert_int_equal(rows, 11);
	fclose(f);
	free(path);
}

static char *read_file(struct acting *a, const char *name, size_t *n)
{
	char *path = place_path(&a->place, name), *bytes;

	assert_int_equal(file_read(path, 1 << 24, &bytes, n, NULL), ST_OK);
	free(path);
	return bytes;
}

/* Graphs of a curve in space and of one on a surface: the same bytes each time. */
static void test_graph(void **state)
{
	struct acting *a = *state;
	static const struct {
		const char *code, *one, *two, *begins;
	} cases[] = {
		{ "V54", "a.svg", "b.svg", "<?xml" },
		{ "V54", "a.pdf", "b.pdf", "%PDF" },
		{ "V47", "c.svg", "d.svg", "<?xml" },
	};

	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		char line[64];
		size_t n, m;
		if (!strcmp(cases[k].code, "V47"))
			acting_does(a, "V25 points=0,0,0;1,1,0;2,0,0;3,1,1 name=wire");
		snprintf(line, sizeof line, "%s save=%s", cases[k].code, cases[k].one);
		acting_does(a, line);
		snprintf(line, sizeof line, "%s save=%s", cases[k].code, cases[k].two);
		acting_does(a, line);
		char *one = read_file(a, cases[k].one, &n), *two = read_file(a, cases[k].two, &m);
		assert_true(n == m && n > 2000 && !memcmp(one, two, n));
		assert_memory_equal(one, cases[k].begins, strlen(cases[k].begins));
		free(one);
		free(two);
	}
	acting_fails(a, "V47 save=a.bmp", ST_PARAMETER, "a graph is .svg or .pdf");
	acting_fails(a, "V47 save=no/such/a.svg", ST_INPUT, "no/such");
}

/* Results are read from files, and refused where they are something else. */
static void test_results(void **state)
{
	struct acting *a = *state;

	acting_fails(a, "V78 file=none.map.exr", ST_INPUT, "none.map.exr");
	acting_fails(a, "V70 file=diagonal.base", ST_INPUT, "diagonal.base");
	acting_fails(a, "V89 file=none.isophote", ST_INPUT, "none.isophote");
	acting_fails(a, "V91", ST_INPUT, "V90 computes it");
	acting_fails(a, "V169", ST_INPUT, "V168 computes it");
	acting_does(a, "V89 file=diagonal.base");
	assert_int_equal(world_overlays(a->place.world), 1);
	assert_int_equal(world_overlay(a->place.world, 0)->kind, OVERLAY_LINES);

	/* an image in the view gives way to what is asked for after it */
	const struct sight *s = world_sight(a->place.world);
	assert_false(s->no_image);
	const struct overlay image = { .kind = OVERLAY_IMAGE, .file = (char *)"a.shade.exr" };
	assert_int_equal(world_show(a->place.world, &image), ST_OK);
	acting_fails(a, "V89 file=none.isophote", ST_INPUT, "none.isophote");
	assert_false(s->no_image);
	acting_does(a, "V89 file=diagonal.base");
	assert_true(s->no_image);
	acting_does(a, "V189 on=yes");
	assert_false(s->no_image);
}

/* What cannot be read is told by its name: a folder, a link to nothing, no permission. */
static void test_unreadable(void **state)
{
	static const char *const lines[] = { "V175 file=%s.igs",      "V175 file=%s.base",
		                             "V70 file=%s.shade.exr", "V75 file=%s.trace.exr",
		                             "V78 file=%s.map.exr",   "V89 file=%s.isophote",
		                             "V93 file=%s.reflect" };
	static const char *const kinds[] = { "folder", "dangling", "locked" };
	struct acting *a = *state;
	const int n = world_count(a->place.world);

	for (size_t k = 0; k < sizeof lines / sizeof *lines; k++)
		for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
			char line[64];
			snprintf(line, sizeof line, lines[k], kinds[i]);
			char *path = path_join(a->place.folder, strchr(line, '=') + 1);
			if (i == 0)
				assert_int_equal(mkdir(path, 0777), 0);
			else if (i == 1)
				assert_int_equal(symlink("nothing", path), 0);
			else
				assert_int_equal(file_write(path, "x", 1, NULL), ST_OK);
			/* who may read everything finds that it is nothing */
			assert_int_equal(i == 2 ? chmod(path, 0) : 0, 0);
			acting_fails(a, line, ST_INPUT, kinds[i]);
			free(path);
		}
	assert_int_equal(world_count(a->place.world), n);
	assert_int_equal(world_overlays(a->place.world), 0);
}

/* The record of a job takes the place of what was shown while it ran. */
static void test_job_ended(void **state)
{
	struct acting *a = *state;
	struct world *w = a->place.world;
	const int id = acting_thing(a, "diagonal-surface")->id;
	struct Stats s;

	stats_init(&s);
	s.id = 7;
	for (int done = 1; done >= 0; done--) {
		assert_int_equal(world_show(w, &(struct overlay){ .kind = OVERLAY_MAP,
		                                                  .thing = id,
		                                                  .job = 7,
		                                                  .file = "7.part",
		                                                  .quantity = QUANTITY_KMIN }),
		                 ST_OK);
		struct job_output output = { (char *)"x.map.exr", (char *)"map", NULL };
		s.outputs = &output;
		s.n_outputs = done;
		s.state = JOB_RUNNING;
		routine_job_ended(w, &s);
		assert_string_equal(world_overlay(w, 0)->file, "7.part");
		s.state = done ? JOB_DONE : JOB_FAILED;
		routine_job_ended(w, &s);
		/* of the one that fails, what was shown before it */
		assert_int_equal(world_overlays(w), 1);
		assert_string_equal(world_overlay(w, 0)->file, "x.map.exr");
		assert_int_equal(world_overlay(w, 0)->quantity, QUANTITY_KMIN);
		assert_int_equal(world_overlay(w, 0)->job, 0);
	}
	s.outputs = NULL;
	s.n_outputs = 0;
	stats_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_stored, open_both, acting_teardown),
		cmocka_unit_test_setup_teardown(test_display, open_both, acting_teardown),
		cmocka_unit_test_setup_teardown(test_views, open_both, acting_teardown),
		cmocka_unit_test_setup_teardown(test_table, open_both, acting_teardown),
		cmocka_unit_test_setup_teardown(test_graph, open_both, acting_teardown),
		cmocka_unit_test_setup_teardown(test_results, open_both, acting_teardown),
		cmocka_unit_test_setup_teardown(test_unreadable, open_both, acting_teardown),
		cmocka_unit_test_setup_teardown(test_job_ended, open_both, acting_teardown),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
