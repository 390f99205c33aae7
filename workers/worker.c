/* worker.c - the main that all workers share: by hand, under the executive, or a description. */
#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "file.h"
#include "json.h"
#include "worker_private.h"

static const int watched[] = { SIGINT, SIGTERM, SIGHUP, SIGCONT };

static void *take_signals(void *data)
{
	struct run *run = data;
	sigset_t set;
	int signal_number;
	sigemptyset(&set);
	for (size_t i = 0; i < sizeof watched / sizeof watched[0]; i++)
		sigaddset(&set, watched[i]);
	while (sigwait(&set, &signal_number) == 0) {
		if (signal_number == SIGCONT)
			meter_repeat(&run->meter);
		else if (atomic_exchange(&run->stop, true))
			run_leave(run, status_exit(ST_CANCELLED));
	}
	return NULL;
}

enum status signals_watch(struct run *run)
{
	sigset_t set;
	pthread_t thread;
	sigemptyset(&set);
	for (size_t i = 0; i < sizeof watched / sizeof watched[0]; i++)
		sigaddset(&set, watched[i]);
	pthread_sigmask(SIG_BLOCK, &set, NULL);
	if (pthread_create(&thread, NULL, take_signals, run))
		return ST_RESOURCE;
	pthread_detach(thread);
	return ST_OK;
}

static int print_description(void)
{
	json_t *o = describe_json();
	char *text = json_write(o, true);
	if (text)
		puts(text);
	free(text);
	json_decref(o);
	return status_exit(text ? ST_OK : ST_RESOURCE);
}

static int print_help(void)
{
	struct text t = { 0 };
	describe_help(&t);
	if (!t.failed)
		fputs(t.s, stdout);
	int exit_status = status_exit(t.failed ? ST_RESOURCE : ST_OK);
	text_finish(&t);
	return exit_status;
}

static int run_packets(void)
{
	if (isatty(STDIN_FILENO)) {
		fprintf(stderr, "batten-%s: no input; name a file, or see --help\n", worker.name);
		return status_exit(ST_PARAMETER);
	}
	prctl(PR_SET_PDEATHSIG, SIGKILL);
	return link_main();
}

static int run_mode(enum mode mode, const struct task *t)
{
	switch (mode) {
	case MODE_DESCRIBE:
		return print_description();
	case MODE_HELP:
		return print_help();
	case MODE_VERSION:
		printf("batten-%s %d (batten " BATTEN_VERSION ")\n", worker.name, worker.version);
		return 0;
	case MODE_PACKETS:
		return run_packets();
	case MODE_RUN:
		break;
	}
	return hand_main(t);
}

int main(int argc, char **argv)
{
	char name[64];
	struct task t;
	enum mode mode;
	snprintf(name, sizeof name, "batten-%s", worker.name);
	struct report_store said;
	report_store_init(&said);
	file_hold_standard();
	signal(SIGPIPE, SIG_IGN);
	signal(SIGXFSZ, SIG_IGN); /* a file grown too large is a write that fails */
	/* tiles come and go: their memory is kept, not given back and asked for again page by page */
	mallopt(M_TRIM_THRESHOLD, 64 << 20);
	mallopt(M_MMAP_THRESHOLD, 32 << 20);
	enum status st = options_parse(&t, argc, argv, &mode, &said.report);
	if (st != ST_OK) {
		fprintf(stderr, "%s: %s\n", name, *said.error ? said.error : status_text(st));
		return status_exit(st);
	}
	int exit_status = run_mode(mode, &t);
	task_finish(&t);
	if (fflush(stdout) != 0 || ferror(stdout)) {
		fprintf(stderr, "%s: cannot write standard output\n", name);
		return status_exit(ST_RESOURCE);
	}
	return exit_status;
}
