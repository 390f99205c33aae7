/* main.c - the program `batten`. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command.h"
#include "editor_program.h"
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

static int run_verb(const struct command *c, int argc, char **argv)
{
	char name[64];

	for (int k = 0; k < argc && strcmp(argv[k], "--"); k++)
		if (is_help(argv[k])) {
			command_help(c, stdout);
			return 0;
		}
	snprintf(name, sizeof name, "batten %s", c->name);
	struct invocation i = { .report = report_stderr(name) };
	enum status st = invocation_parse(&i, c, argc, argv);
	int rc = st == ST_OK ? c->run(&i) : status_exit(st);
	invocation_finish(&i);
	if (fflush(stdout) || ferror(stdout)) {
		report_error(&i.report, ST_RESOURCE, "cannot write to standard output: %s",
		             strerror(errno));
		rc = rc ? rc : status_exit(ST_RESOURCE);
	}
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
	signal(SIGPIPE, SIG_IGN);
	if (argc < 2)
		return open_editor(0, NULL);
	if (is_help(argv[1])) {
		program_help(stdout);
		return 0;
	}
	if (!strcmp(argv[1], "--version")) {
		printf("batten %s\n", BATTEN_VERSION);
		return 0;
	}
	if (!strcmp(argv[1], "--man") || !strcmp(argv[1], "--completion"))
		return print_manual(argc, argv);
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
