/* test_desk_journal.c - every leaf that can be run, chosen at the desk: the journal of it, done elsewhere by
 * `batten script`, gives the same files, and done by the routines the same world. */
#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "client.h"
#include "desk_stand.h"
#include "file.h"
#include "journal_folders.h"
#include "json.h"
#include "modes.h"
#include "open.h"
#include "path.h"
#include "text.h"

/* What is chosen, and what is typed; a star in a file's name is the one result that fits. */
static const char *const steps[] = {
	"V175 file=spheres.base",
	"V5 name=ball.base",
	"V1 name=rod.base",
	"V9 name=diagonal.base",
	"V23 name=points.base",
	"V178 entities=ball,rod to=some.igs",
	"V6 file=some.igs entity=1",
	"V2 file=some.igs",
	"V10 file=trimmed.igs",
	"V25 points=0,0,0;1,1,0;2,0,1;3,1,2;4,4,4 order=4 name=fitted",
	"V30 curves=rod,fitted reverse=yes name=ruled",
	"V160 curve=fitted",
	"V43 segments=20",
	"V44 color=#112233",
	"V45 view=front",
	"V46 samples=50",
	"V47 scale=0.3 save=comb.csv",
	"V49",
	"V48",
	"V106 index=1 to=1,2,3 weight=2",
	"V107 order=5",
	"V108 knots=0.3,0.4",
	"V109 at=0.5",
	"V160 curve=diagonal",
	"V50 segments=30",
	"V51 linetype=dashed",
	"V52 view=top",
	"V53 samples=40",
	"V54 scale=0.2",
	"V56",
	"V55",
	"V117 index=0 to=0.5,-0.5",
	"V118 knots=0.4",
	"V119 at=0.5",
	"V181 name=ruled discard=yes",
	"V159 surface=ball",
	"V57 lines_u=5 lines_v=4",
	"V58 color=#AABBCC",
	"V59 view=left",
	"V60 count=3",
	"V61 point=0,0,0 normal=0,0,1",
	"V62 distance=0.25",
	"V63 tolerance_uv=0.001",
	"V64 tolerance=0.001",
	"V65 count=2",
	"V66 point=0,0,0 axis=0,0,1 radius=0.5",
	"V67 distance=0.25",
	"V68 tolerance_uv=0.001",
	"V69 tolerance=0.001",
	"V72 color=#FF0000",
	"V73 intensity=0.9 azimuth=30 incidence=40",
	"V74 view=back",
	"V77 color=#334455 specular=0.5",
	"V87 view=-40,10",
	"V88 count=2",
	"V92 count=3 spacing=0.5",
	"V173 grid=48x32",
	"V174 grid=16x12",
	"V99 on=no",
	"V99 on=yes",
	"V59 view=-20,30:perspective@40",
	"drag",
	"V179 to=dragged.png size=320x200",
	"V179 to=lines.svg size=320x200",
	"V179 to=back.png size=320x200 view=back",
	"drag",
	"V179 to=again.png size=320x200",
	"V79 surfaces=shown",
	"V71",
	"kill V76 size=4000x3000 samples=8", /* the shaded image is shown again */
	"V179 to=shaded.png size=320x200",
	"V76 size=32x24 samples=1",
	"V79",
	"V179 to=seven.png size=640x400",
	"V90",
	"V189 on=no",
	"V189 on=yes",
	"V90 surfaces=current",
	"V94",
	"V168",
	"V170",
	"V70 file=*.shade.exr",
	"V75 file=*.trace.exr",
	"V78 file=ball.map.exr",
	"V89 file=ball.isophote",
	"V93 file=*.reflect",
	"V80 range=-2,2 scale=linear",
	"V81",
	"V82 surfaces=current",
	"V83",
	"V84",
	"V85",
	"V86 symmetric=no",
	"V91",
	"V95",
	"V169",
	"V171 on=no",
	"V127 index=1,1 to=2,2,2",
	"V80 surfaces=current", /* what is there is of another shape */
	"V128 along=u order=4",
	"V129 along=v knots=0.5",
	"V130 along=u at=0.5",
	"V157 color=#203040",
	"V166 field=25",
	"V167 on=no",
	"V188 views=side",
	"V179 to=side.png size=320x200",
	"V179 to=side.svg size=320x200",
	"V179 to=plane.pdf size=320x200 views=uv",
	"V162",
	"V163",
	"V164",
	"V165",
	"V184 plane=x",
	"V185 by=1,0,0",
	"V186 angle=30",
	"V187 factor=2",
	"V182",
	"V183",
	"V180 name=renamed",
	"V176",
	"V177 name=mine",
	"V179 to=picture.png size=320x200",
	"drag", /* no leaf says where the window looks now */
	"V178 entities=all to=final.base",
	"V133",
};
enum { N_STEPS = sizeof steps / sizeof *steps };

/* ------------------------------------------------------------ jobs */

struct news {
	struct stand *stand;
	bool alive;
};

static bool take_record(void *data, const struct Stats *s)
{
	struct news *n = data;

	n->alive |= !job_state_table[s->state].over;
	assert_int_equal(job_shelf_put(desk_shelf(n->stand->desk), s), ST_OK);
	return true;
}

/* In the project's folder. */
static int run_in(const char *folder, const char *arguments)
{
	char *command = text_print("cd %s && %s %s", folder, getenv("BATTEN_PROGRAM"), arguments);
	int how = system(command);

	free(command);
	return WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

/* Every job has ended, and the desk knows. */
static void wait_for_jobs(struct stand *s)
{
	struct news n = { s, false };
	struct client *c;

	run_in(s->folder, "wait");
	assert_int_equal(client_connect(&c, &s->project, false, NULL), ST_OK);
	assert_int_equal(client_request(c, MESSAGE_LIST, json_pack("{s:b}", "all", 1), take_record,
	                                NULL, &n, NULL),
	                 ST_OK);
	client_close(c);
	assert_false(n.alive);
	desk_jobs_changed(s->desk, LINK_UP, "");
}

/* A job that is over stands in the list as if it ran: it can be steered whatever the machine's pace. */
static void steer_a_job(struct stand *s, const char *code)
{
	stand_put_job(s, 1, strcmp(code, "V164") ? JOB_RUNNING : JOB_SUSPENDED, NULL);
	desk_jobs_changed(s->desk, LINK_UP, "");
	stand_leaf(s, code);
	for (int k = 0; k < desk_jobs_model(s->desk)->n; k++)
		stand_key(s, KEY_DOWN);
	stand_type(s, !strcmp(code, "V163") ? "s" : !strcmp(code, "V164") ? "a" : "ky");
	stand_key(s, KEY_ESCAPE);
	wait_for_jobs(s);
}

/* ------------------------------------------------------------ hands */

/* Which field of the form has that name, and its row. */
static int find_row(struct stand *s, const struct routine *t, const char *name,
                    struct argument_row *out)
{
	struct act a = { .world = s->world, .project = &s->project };
	struct argument_row *rows;
	int at = -1;

	assert_int_equal(routine_rows(&rows, t, &a), ST_OK);
	for (int k = 0; rows[k].name; k++)
		if (!strcmp(rows[k].name, name)) {
			at = k;
			*out = rows[k];
		}
	if (at < 0)
		fail_msg("%s has no argument %s", t->code, name);
	routine_rows_free(rows);
	return at;
}

static void fill_field(struct stand *s, const struct routine *t, const char *name,
                       const char *value)
{
	struct argument_row row = { 0 };
	const int at = find_row(s, t, name, &row);

	for (int k = 0; k < 64 && !desk_menu_model(s->desk)->fields[at].focused; k++)
		desk_key(s->desk, KEY_TAB, MOD_SHIFT);
	assert_true(desk_menu_model(s->desk)->fields[at].focused);
	if (row.type == ARGUMENT_CHOICE || row.type == ARGUMENT_YESNO) {
		for (int k = 0; k < 16; k++)
			if (strcmp(desk_menu_model(s->desk)->fields[at].value, value))
				desk_key(s->desk, KEY_RIGHT, 0);
	} else {
		desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
		for (; *value; value++)
			desk_text(s->desk, (unsigned char)*value);
	}
}

/* The one file that fits a name with a star. Fresh. */
static char *find_file(struct stand *s, const char *value)
{
	char *pattern = text_print("%s/%s", s->folder, value), *out = NULL;
	glob_t found;

	if (*value == '*') {
		assert_int_equal(glob(pattern, 0, NULL, &found), 0);
		assert_int_equal(found.gl_pathc, 1);
		out = strdup(path_file_name(found.gl_pathv[0]));
		globfree(&found);
	}
	free(pattern);
	return out ? out : strdup(value);
}

/* The view is turned by hand. */
static void drag(struct stand *s)
{
	const struct vec3 before = world_sight(s->world)->camera.eye;
	int n;
	const struct desk_tile *t = desk_tiles(s->desk, &n);

	desk_move(s->desk, t[0].box.x + 100, t[0].box.y + 150);
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_move(s->desk, t[0].box.x + 163, t[0].box.y + 127);
	desk_release(s->desk, BUTTON_LEFT);
	stand_paint(s);
	assert_memory_not_equal(&before, &world_sight(s->world)->camera.eye, sizeof before);
}

static int set_up(void **state)
{
	return stand_set_up_drawing(state, editor_picture);
}

static bool add_unended(void *data, const struct Stats *s)
{
	struct text *ids = data;

	if (!job_state_table[s->state].over)
		text_addf(ids, " %lld", (long long)s->id);
	return true;
}

/* From elsewhere. */
static void kill_jobs(struct stand *s)
{
	struct text command = { 0 };
	struct client *c;

	text_add(&command, "kill");
	assert_int_equal(client_connect(&c, &s->project, false, NULL), ST_OK);
	assert_int_equal(client_request(c, MESSAGE_LIST, json_pack("{s:b}", "all", 1), add_unended,
	                                NULL, &command, NULL),
	                 ST_OK);
	client_close(c);
	assert_true(strlen(command.s) > 4);
	text_add(&command, " >/dev/null");
	assert_int_equal(run_in(s->folder, command.s), 0);
	text_finish(&command);
}

static void choose(struct stand *s, const char *step)
{
	const bool killed = !strncmp(step, "kill ", 5);
	char *copy = strdup(killed ? step + 5 : step), *rest = copy, *code = strsep(&rest, " "),
	     *pair;
	const struct routine *t = routine_find(code);

	stand_leaf(s, code);
	while ((pair = strsep(&rest, " "))) {
		char *value = strchr(pair, '=');
		*value++ = 0;
		char *given = find_file(s, value);
		fill_field(s, t, pair, given);
		free(given);
	}
	if (desk_menu_model(s->desk)->form_code)
		stand_key(s, KEY_ENTER);
	const struct foot_model *m = desk_foot_model(s->desk);
	if (m->level == REPORT_ERROR || desk_menu_model(s->desk)->form_code)
		fail_msg("%s: %s", step, m->message);
	stand_key(s, KEY_ESCAPE);
	if (killed)
		kill_jobs(s);
	if (t->kind == ROUTINE_JOB || (t->detail < N_QUANTITIES && !strncmp(code, "V8", 2)))
		wait_for_jobs(s);
	free(copy);
}

/* ------------------------------------------------------------ the world */

/* The session without what is the window's alone and what the disk says; paths from the folder. */
static char *session_of(struct world *w, const char *folder)
{
	size_t k;
	json_t *o, *x;

	assert_int_equal(world_keep_session(w, NULL), ST_OK);
	char *text = journal_text(folder, ".batten/session/session.json");
	for (char *p = text; (p = strstr(p, folder));)
		memset(p, '_', strlen(folder));
	assert_int_equal(json_parse_object(text, strlen(text), "session", &o, NULL), ST_OK);
	free(text);
	json_object_del(json_object_get(o, "sight"), "camera");
	json_object_del(json_object_get(o, "sight"), "beside");
	json_array_foreach(json_object_get(o, "things"), k, x) json_object_del(x, "stamp");
	text = json_write(o, true);
	json_decref(o);
	return text;
}

/* ------------------------------------------------------------ the test */

static void every_leaf_is_in_the_journal_and_done_again(void **state)
{
	struct stand *s = *state;
	char again[] = "/tmp/batten-desk-XXXXXX", twice[] = "/tmp/batten-desk-XXXXXX";
	struct report_store said;
	int failed;

	assert_non_null(mkdtemp(again));
	assert_non_null(mkdtemp(twice));
	journal_inputs(s->folder);
	journal_inputs(again);
	journal_inputs(twice);
	assert_int_equal(run_in(s->folder, "jobs >/dev/null"), 0); /* the service runs */
	for (int k = 0; k < N_STEPS; k++) {
		if (!strcmp(steps[k], "V163") || !strcmp(steps[k], "V164") ||
		    !strcmp(steps[k], "V165"))
			steer_a_job(s, steps[k]);
		else if (!strcmp(steps[k], "drag"))
			drag(s);
		else if (strcmp(steps[k], "V133"))
			choose(s, steps[k]);
	}
	stand_leaf(s, "V133");
	stand_type(s, "l");
	assert_true(s->closed);

	/* from where they are seen can be told from the pictures */
	assert_false(journal_same_file(s->folder, "dragged.png", "back.png"));
	assert_false(journal_same_file(s->folder, "dragged.png", "again.png"));

	char *journal = journal_text(s->folder, ".batten/journal");
	for (const struct routine *t = routine_table; t->code; t++) {
		char *line = text_print("\n%s ", t->code), *alone = text_print("\n%s\n", t->code);
		char *remark = text_print("\n# %s ", t->code); /* jobs by number */
		if (t->run && !strstr(journal, line) && !strstr(journal, alone) &&
		    !strstr(journal, remark) && strncmp(journal, line + 1, strlen(line + 1)))
			fail_msg("%s is not in the journal", t->code);
		free(line);
		free(alone);
		free(remark);
	}
	assert_non_null(strstr(journal, " wait=killed # job"));
	free(journal);

	char *path = text_print("%s/.batten/journal", s->folder);
	char *arguments = text_print("script %s >/dev/null", path);
	assert_int_equal(run_in(again, arguments), 0);
	assert_true(journal_same_folder(s->folder, again) > 20);
	assert_true(journal_same_folder(again, s->folder) > 20);
	free(arguments);

	struct project project;
	struct world *w;
	assert_int_equal(project_find(&project, twice, NULL), ST_OK);
	assert_int_equal(run_in(twice, "jobs >/dev/null"), 0);
	assert_int_equal(world_create(&w, twice), ST_OK);
	report_store_init(&said);
	struct act a = { .world = w,
		         .project = &project,
		         .report = said.report,
		         .wait = true,
		         .picture = editor_picture };
	if (script_run(&a, path, false, &failed) != ST_OK)
		fail_msg("%s", said.error);
	char *here = session_of(s->world, s->folder), *there = session_of(w, twice);
	assert_string_equal(here, there);
	free(here);
	free(there);
	world_destroy(w);
	project_finish(&project);
	free(path);
	assert_int_equal(run_in(s->folder, "shutdown >/dev/null"), 0);
	assert_int_equal(run_in(twice, "shutdown >/dev/null"), 0);
	assert_int_equal(run_in(again, "shutdown >/dev/null"), 0);
	path = text_print("rm -rf %s %s", again, twice);
	assert_int_equal(system(path), 0);
	free(path);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(every_leaf_is_in_the_journal_and_done_again, set_up,
		                                stand_tear_down),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
