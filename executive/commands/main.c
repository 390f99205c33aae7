/* main.c - the program `batten`. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command.h"
#include "editor_program.h"
#include "file.h"
#include "path.h"

/* What the build asks for: man pages and the completion, on standard output. */
static int print_manual(int argc, char **argv)
{
	if (argc == 2 && !strcmp(argv[1], "--completion")) {
		program_completion(stdout);
		return 0;
	}
	const struct command *c = argc == 3 ? command_find(argv[2]) : NULL;
	if (argc == 3 && !c)
		return status_exit(ST_PARAMETER);
	command_man(c, stdout);
	return 0;
}

static bool is_help(const char *word)
{
	return !strcmp(word, "--help") || !strcmp(word, "-h");
}

/* What was printed is there, or it is said that it is not. */
static int output_end(const struct report *r, int rc)
{
	if (!fflush(stdout) && !ferror(stdout))
		return rc;
	report_error(r, ST_RESOURCE, "cannot write to standard output: %s", strerror(errno));
	return rc ? rc : status_exit(ST_RESOURCE);
}

static int run_verb(const struct command *c, int argc, char **argv)
{
	const struct report terminal = report_stderr("batten");
	char name[64];

	for (int k = 0; k < argc && strcmp(argv[k], "--"); k++)
		if (is_help(argv[k])) {
			command_help(c, stdout);
			return output_end(&terminal, 0);
		}
	snprintf(name, sizeof name, "batten %s", c->name);
	struct invocation i = { .report = report_stderr(name) };
	enum status st = invocation_parse(&i, c, argc, argv);
	int rc = st == ST_OK ? c->run(&i) : status_exit(st);
	rc = output_end(&i.report, rc);
	invocation_finish(&i);
	return rc;
}

/* Files, or nothing: the editor's window. */
static int open_editor(int n, char **files)
{
	const struct report r = report_stderr("batten");
	char **words = calloc((size_t)n + 3, sizeof *words);

	if (!words)
		return status_exit(report_error(&r, ST_RESOURCE, "memory ran out"));
	words[0] = "batten-editor";
	words[1] = "--window";
	for (int k = 0; k < n; k++)
		words[2 + k] = files[k];
	int rc = editor_program_become(words, &r);
	free(words);
	return rc;
}

int main(int argc, char **argv)
{
	const struct report terminal = report_stderr("batten");

	file_hold_standard();
	signal(SIGPIPE, SIG_IGN);
	signal(SIGXFSZ, SIG_IGN); /* a file grown too large is a write that fails */
	if (argc < 2)
		return open_editor(0, NULL);
	if (is_help(argv[1])) {
		program_help(stdout);
		return output_end(&terminal, 0);
	}
	if (!strcmp(argv[1], "--version")) {
		printf("batten %s\n", BATTEN_VERSION);
		return output_end(&terminal, 0);
	}
	if (!strcmp(argv[1], "--man") || !strcmp(argv[1], "--completion"))
		return output_end(&terminal, print_manual(argc, argv));
	const struct command *c = command_find(argv[1]);
	if (!c && path_exists(argv[1]))
		return open_editor(argc - 1, argv + 1);
	if (!c) {
		fprintf(stderr,
		        "batten: there is no verb and no file '%s'; batten --help lists the verbs\n",
		        argv[1]);
		return status_exit(ST_PARAMETER);
	}
	return run_verb(c, argc - 2, argv + 2);
}
