/* test_slurm_end.c - what srun's exit and its words say of how a process ended. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#include "shard.h"
#include "slurm_end.h"

static void ends_are_read_from_what_srun_says(void **state)
{
	static const struct {
		const char *words;
		int status, signal; /* srun's */
		int becomes_status, becomes_signal;
		bool lost;
		const char *why; /* "" for nothing */
	} cases[] = {
		{ "", 0, 0, 0, 0, false, "" },
		{ "", 3, 0, 3, 0, false, "" },
		{ "srun: error: n1: task 0: Exited with exit code 2\n", 2, 0, 2, 0, false, "" },
		{ "srun: error: n1: task 0: Segmentation fault\n", 139, 0, 0, 11, false, "" },
		{ "srun: error: n1: task 0: Killed\n", 137, 0, 0, 9, false, "" },
		{ "", 255, 0, 255, 0, false, "" },
		{ "", 0, 9, 0, 9, true, "its srun was killed from outside" },
		{ "srun: error: Node failure on n2\n", 0, 0, 1, 0, true, "the node failed" },
		{ "slurmstepd-n1: error: *** STEP 8.0 ON n1 CANCELLED AT 2020-01-01T00:00:00 DUE "
		  "TO NODE FAILURE, SEE SLURMCTLD LOG FOR DETAILS ***\n",
		  143, 0, 143, 0, true, "the node failed" },
		{ "slurmstepd: error: *** STEP 8.0 ON n1 CANCELLED AT 2020-01-01T00:00:00 DUE TO "
		  "PREEMPTION ***\n",
		  143, 0, 143, 0, true, "Slurm took its node for another job" },
		{ "slurmstepd: error: *** STEP 8.0 ON n1 CANCELLED AT 2020-01-01T00:00:00 DUE TO "
		  "TIME LIMIT ***\n",
		  143, 0, 143, 0, false, "it took longer than Slurm allows" },
		{ "slurmstepd-n2: error: *** STEP 5.0 ON n2 CANCELLED AT 2020-01-01T00:00:00 ***\n"
		  "srun: error: n2: task 0: Terminated\n",
		  143, 0, 143, 0, false, "it was cancelled in Slurm from outside" },
		{ "srun: error: invalid partition specified: nope\n"
		  "srun: error: Unable to allocate resources: Invalid partition name specified\n",
		  1, 0, 1, 0, false, "Slurm refuses it: Invalid partition name specified" },
		{ "srun: error: Invalid --time specification\n", 255, 0, 255, 0, false,
		  "Slurm refuses it: --time specification" },
		{ "srun: unrecognized option '--nope'\n", 255, 0, 255, 0, false, "slurm-options" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct launcher_exit e = { .status = cases[i].status,
			                   .signal = cases[i].signal,
			                   .cpu_s = 1,
			                   .peak_kib = 1 };
		slurm_end(&e, cases[i].words);
		if (e.status != cases[i].becomes_status || e.signal != cases[i].becomes_signal ||
		    e.lost != cases[i].lost || !strstr(e.why, cases[i].why) ||
		    !*e.why != !*cases[i].why)
			fail_msg("case %zu: status %d signal %d lost %d why '%s'", i, e.status,
			         e.signal, e.lost, e.why);
		assert_true(isnan(e.cpu_s) && e.peak_kib == -1);
	}
}

static void a_long_line_is_cut(void **state)
{
	char words[2000] = "srun: error: Unable to allocate resources: ";
	struct launcher_exit e = { .status = 1 };
	(void)state;
	memset(words + strlen(words), 'x', sizeof words - strlen(words) - 1);
	slurm_end(&e, words);
	assert_int_equal(strlen(e.why), sizeof e.why - 1);
}

static void unknown_reasons_stay_as_they_are(void **state)
{
	(void)state;
	assert_string_equal(slurm_reason("Resources"), "no node is free");
	assert_string_equal(slurm_reason("SomethingNew"), "SomethingNew");
}

static void shards_have_numbers_of_their_own(void **state)
{
	static const int64_t jobs[] = { 1, 12, 1000000, ((int64_t)1 << 40) - 1 };
	(void)state;
	for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++) {
		assert_int_equal(shard_of(jobs[i]), -1);
		assert_int_equal(shard_job(jobs[i]), jobs[i]);
		for (int shard = 0; shard < SHARDS_MAX; shard++) {
			int64_t id = shard_id(jobs[i], shard);
			assert_true(id > jobs[i]);
			assert_int_equal(shard_of(id), shard);
			assert_int_equal(shard_job(id), jobs[i]);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(ends_are_read_from_what_srun_says),
		cmocka_unit_test(a_long_line_is_cut),
		cmocka_unit_test(unknown_reasons_stay_as_they_are),
		cmocka_unit_test(shards_have_numbers_of_their_own),
	};
	return cmocka_run_group_tests_name("slurm_end", tests, NULL, NULL);
}
