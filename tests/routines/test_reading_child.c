/* test_reading_child.c - foreign files in a child, which this program plays in bad ways, too. */
#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base.h"
#include "open.h"
#include "path.h"
#include "reading_child.h"
#include "text.h"

/* ------------------------------------------------------------ children */

static int put(int fd, const char *s)
{
	return write(fd, s, strlen(s)) < 0;
}

/* A model that is right, handed over. */
static int put_model(void)
{
	struct model m;
	struct entity e;
	struct text t = { 0 };

	model_init(&m);
	place_line(&e, 1);
	int failed = model_add(&m, &e) != ST_OK;
	base_format(&m, &t);
	failed |= put(3, t.s);
	text_finish(&t);
	model_finish(&m);
	return failed;
}

static int answer(void)
{
	return puts("{\"version\":1,\"skipped\":[{\"type\":416,\"count\":7,\"first_de\":9,"
	            "\"reason\":\"external\"}],\"warnings\":[\"the unit is a guess\"]}") < 0;
}

static int child_crash(void)
{
	signal(SIGABRT, SIG_DFL);
	put(STDERR_FILENO, "batten import: half a sent");
	raise(SIGKILL);
	return 0;
}

static int child_hang(void)
{
	put(4, "0.25\n0.");
	put(4, "5\n");
	while (pause() < 0)
		;
	return 0;
}

/* It has said all that it will and does not end. */
static int child_half_dead(void)
{
	put(4, "1\n");
	for (int fd = 0; fd < 5; fd++)
		close(fd);
	while (pause() < 0)
		;
	return 0;
}

static int child_nonsense(void)
{
	put(3, "batten base 1\nsurface {");
	return answer();
}

static int child_no_answer(void)
{
	return put_model();
}

static int child_liar(void)
{
	put(4, "7\n-1\nabc\n1e999\n0.5\n");
	put_model();
	return puts("[1,2") < 0;
}

static int child_flood(void)
{
	char line[4096];

	memset(line, 'x', sizeof line);
	for (int k = 0; k < 512; k++)
		if (write(4, line, sizeof line) < 0 || write(2, line, sizeof line) < 0)
			return 1;
	put(STDERR_FILENO, "\nbatten import: it was too much\n");
	return 1;
}

static int child_refuse(void)
{
	put(STDERR_FILENO, "batten import: warning: odd\nbatten import: no such thing\n");
	return 2;
}

static int child_silent(void)
{
	return 1;
}

static const struct {
	const char *name;
	int (*run)(void);
} children[] = {
	{ "crash", child_crash }, { "hang", child_hang },         { "half-dead", child_half_dead },
	{ "flood", child_flood }, { "nonsense", child_nonsense }, { "no-answer", child_no_answer },
	{ "liar", child_liar },   { "refuse", child_refuse },     { "silent", child_silent },
};

static int play(const char *path)
{
	for (size_t k = 0; k < sizeof children / sizeof *children; k++)
		if (!strncmp(path_file_name(path), children[k].name, strlen(children[k].name)))
			return children[k].run();
	return 99;
}

/* ------------------------------------------------------------ reading them */

static char program[4096];

static enum status read_with(struct place *p, const char *name, const struct progress *progress,
                             struct model *m)
{
	struct reading_child r = { program };
	char *path = place_path(p, name);
	FILE *f = fopen(path, "w");

	assert_non_null(f);
	fputs("something foreign\n", f);
	fclose(f);
	report_store_init(&p->said);
	enum status st = reading_child(&r, m, path, progress, &p->said.report);
	free(path);
	return st;
}

static void bad_children_cost_their_file_only(void **state)
{
	static const struct {
		const char *name, *says;
		enum status st;
	} cases[] = {
		{ "crash.igs", "reading '", ST_INPUT },
		{ "crash.igs", "Killed", ST_INPUT },
		{ "nonsense.igs", ":2:1: found", ST_INPUT },
		{ "no-answer.igs", "answer of batten import", ST_INPUT },
		{ "liar.igs", "answer of batten import", ST_INPUT },
		{ "flood.igs", "it was too much", ST_INPUT },
		{ "refuse.igs", "no such thing", ST_PARAMETER },
		{ "silent.igs", "exit status 1", ST_INPUT },
	};
	struct place *p = *state;

	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct model m;
		assert_int_equal(read_with(p, cases[k].name, NULL, &m), cases[k].st);
		assert_int_equal(p->said.n_errors, 1);
		if (!strstr(p->said.error, cases[k].says))
			fail_msg("%s: %s", cases[k].name, p->said.error);
		assert_int_equal(m.n, 0);
		model_finish(&m);
	}
}

static int count_open(void)
{
	DIR *folder = opendir("/proc/self/fd");
	int n = 0;

	assert_non_null(folder);
	while (readdir(folder))
		n++;
	closedir(folder);
	return n;
}

/* Neither descriptors nor children are left, whatever they did, and where there is room for none. */
static void nothing_is_left_of_bad_children(void **state)
{
	enum { ROUNDS = 20 };
	static const char *const names[] = { "crash", "nonsense", "liar", "refuse", "silent" };
	const int open_before = count_open();
	struct rlimit all, few;
	struct model m;

	for (int k = 0; k < ROUNDS; k++)
		for (size_t i = 0; i < sizeof names / sizeof *names; i++)
			assert_int_not_equal(read_with(*state, names[i], NULL, &m), ST_OK);
	getrlimit(RLIMIT_NOFILE, &all);
	for (int more = 1; more < 12; more++) {
		few = all;
		few.rlim_cur = (rlim_t)open_before + (rlim_t)more;
		setrlimit(RLIMIT_NOFILE, &few);
		enum status st = read_with(*state, "silent", NULL, &m);
		setrlimit(RLIMIT_NOFILE, &all);
		assert_true(st == ST_RESOURCE || st == ST_INPUT);
		assert_int_equal(((struct place *)*state)->said.n_errors, 1);
	}
	assert_int_equal(count_open(), open_before);
	assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
}

/* Stopped by who is told how far it is, as the window is by Esc. */
struct watcher {
	atomic_bool stop;
	double last;
};

static void on_step(void *data, double fraction)
{
	struct watcher *x = data;

	assert_true(fraction >= x->last && fraction <= 1);
	x->last = fraction;
	if (fraction > 0.4)
		atomic_store(&x->stop, true);
}

static void one_that_never_ends_can_be_stopped(void **state)
{
	static const char *const names[] = { "hang.igs", "half-dead.igs" };

	for (int k = 0; k < 2; k++) {
		struct watcher x = { 0 };
		const struct progress p = { on_step, &x, &x.stop };
		struct model m;
		assert_int_equal(read_with(*state, names[k], &p, &m), ST_CANCELLED);
		assert_true(x.last > 0.4);
		assert_non_null(strstr(((struct place *)*state)->said.error, "stopped"));
	}
	assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* nobody is left */
}

static void a_missing_program_is_told(void **state)
{
	struct model m;
	char kept[sizeof program];

	memcpy(kept, program, sizeof kept);
	snprintf(program, sizeof program, "/no/such/batten");
	assert_int_equal(read_with(*state, "a.igs", NULL, &m), ST_RESOURCE);
	memcpy(program, kept, sizeof kept);
	assert_non_null(strstr(((struct place *)*state)->said.error, "cannot start"));
}

/* A world goes on with what it has. */
static void a_world_opens_what_is_left(void **state)
{
	struct place *p = *state;
	struct reading_child r = { program };
	struct model m;

	world_set_reader(p->world, reading_child, &r);
	place_diagonal(p, "diagonal.base"); /* our own: no child is asked */
	assert_int_equal(world_open(p->world, "diagonal.base", NULL, NULL, NULL), ST_OK);
	int n = world_count(p->world);
	read_with(p, "crash.igs", NULL, &m);
	assert_int_equal(world_open(p->world, "crash.igs", NULL, NULL, NULL), ST_INPUT);
	assert_int_equal(world_open(p->world, "missing.igs", NULL, NULL, NULL), ST_INPUT);
	assert_int_equal(world_count(p->world), n);
}

/* ------------------------------------------------------------ the real one */

static void same_rows(const struct model *a, const struct model *b)
{
	assert_int_equal(a->n_skipped, b->n_skipped);
	for (int k = 0; k < a->n_skipped; k++) {
		assert_int_equal(a->skipped[k].count, b->skipped[k].count);
		assert_int_equal(a->skipped[k].first_de, b->skipped[k].first_de);
		assert_string_equal(a->skipped[k].reason, b->skipped[k].reason);
	}
	assert_int_equal(a->n_warnings, b->n_warnings);
	for (int k = 0; k < a->n_warnings; k++)
		assert_string_equal(a->warnings[k], b->warnings[k]);
}

/* What comes through the child is what is read here, to the bit. */
static void same_through_the_child(const char *folder, const char *name)
{
	struct reading_child r = { getenv("BATTEN_PROGRAM") };
	char *path = text_print("%s/%s", folder, name);
	struct model here, there;
	struct text a = { 0 }, b = { 0 };

	assert_int_equal(model_read(&here, path, NULL, NULL), ST_OK);
	assert_int_equal(reading_child(&r, &there, path, NULL, NULL), ST_OK);
	base_format(&here, &a);
	base_format(&there, &b);
	assert_int_equal(a.n, b.n);
	assert_memory_equal(a.s, b.s, a.n);
	for (int e = 0; e < here.n; e++)
		assert_int_equal(here.entities[e].number, there.entities[e].number);
	assert_string_equal(here.file, there.file);
	same_rows(&here, &there);
	text_finish(&a);
	text_finish(&b);
	model_finish(&here);
	model_finish(&there);
	free(path);
}

static void nothing_is_lost_on_the_way(void **state)
{
	static const char *const ours[] = { "hull.igs", "teapot.igs", "torus.igs" };
	static const char *const data[] = { "all_entities_bench.igs", "bounded_141_143.igs",
		                            "trout_lake_scale2.igs", "surf114_bench.igs" };

	(void)state;
	for (size_t k = 0; k < sizeof ours / sizeof *ours; k++)
		same_through_the_child(getenv("BATTEN_EXAMPLES"), ours[k]);
	for (size_t k = 0; getenv("BATTEN_DATA") && k < sizeof data / sizeof *data; k++)
		same_through_the_child(getenv("BATTEN_DATA"), data[k]);
}

static int set_up(void **state)
{
	struct place *p = calloc(1, sizeof *p);

	place_init(p);
	*state = p;
	return 0;
}

static int tear_down(void **state)
{
	place_finish(*state);
	free(*state);
	return 0;
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		TEST(bad_children_cost_their_file_only), TEST(one_that_never_ends_can_be_stopped),
		TEST(nothing_is_left_of_bad_children),   TEST(one_that_never_ends_can_be_stopped),
		TEST(a_missing_program_is_told),         TEST(a_world_opens_what_is_left),
		TEST(nothing_is_lost_on_the_way),
	};

	if (argc > 1 && !strcmp(argv[1], "import"))
		return play(argv[argc - 1]);
	if (readlink("/proc/self/exe", program, sizeof program - 1) < 0)
		return 1;
	return cmocka_run_group_tests(tests, NULL, NULL);
}
