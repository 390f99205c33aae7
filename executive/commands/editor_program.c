/* editor_program.c - finding and becoming batten-editor. */
#include "editor_program.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "path.h"

/* From the folder of `batten`: installed side by side, the build tree, the private programs. */
static const char *const places[] = {
	"batten-editor",
	"editor/batten-editor",
	"../libexec/batten/batten-editor",
};

static char *find(void)
{
	char *folder = path_of_program(), *found = NULL;
	for (size_t i = 0; folder && !found && i < sizeof places / sizeof *places; i++) {
		found = path_join(folder, places[i]);
		if (found && access(found, X_OK) != 0) {
			free(found);
			found = NULL;
		}
	}
	free(folder);
	return found;
}

int editor_program_become(char **words, const struct report *r)
{
	char *program = find();
	if (!program)
		return status_exit(report_error(
		        r, ST_RESOURCE,
		        "cannot find batten-editor beside this program; it is built where glfw3 and "
		        "epoxy are installed: libglfw3-dev, libepoxy-dev"));
	words[0] = program;
	execv(program, words);
	enum status st =
	        report_error(r, ST_RESOURCE, "cannot start '%s': %s", program, strerror(errno));
	free(program);
	return status_exit(st);
}
