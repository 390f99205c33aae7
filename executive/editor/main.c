/* main.c - the program batten-editor: one mode a way to start it; files alone open the window. */
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "file.h"
#include "modes.h"

static const struct mode {
	const char *name;
	int (*run)(int argc, char **argv); /* what stands behind the name; exit status */
} modes[] = {
#ifdef BATTEN_VIEW
	{ "--render", mode_render },
#endif
	{ "--routines", mode_routines },
	{ "--script", mode_script },
#ifdef BATTEN_WINDOW
	{ "--window", mode_window },
#endif
};
enum { N_MODES = sizeof modes / sizeof *modes };

int main(int argc, char **argv)
{
	file_hold_standard();
	signal(SIGXFSZ, SIG_IGN); /* a file grown too large is a write that fails */
	for (int k = 0; k < N_MODES; k++)
		if (argc > 1 && !strcmp(argv[1], modes[k].name))
			return modes[k].run(argc - 2, argv + 2);
#ifdef BATTEN_WINDOW
	if (argc < 2 || strncmp(argv[1], "--", 2))
		return mode_window(argc - 1, argv + 1);
#endif
	fprintf(stderr, "batten-editor: expected files or a mode:");
	for (int k = 0; k < N_MODES; k++)
		fprintf(stderr, " %s", modes[k].name);
	fprintf(stderr, "; it is started by batten\n");
	return 2;
}
