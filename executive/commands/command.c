/* command.c - the table of verbs. */
#include "command.h"

#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "verbs.h"

const struct command *const command_table[] = {
	&command_activate, &command_config,  &command_doctor,
	&command_eval,     &command_export,  &command_help_verb,
	&command_hold,     &command_import,  &command_info,
	&command_jobs,     &command_kill,    &command_log,
	&command_priority, &command_prune,   &command_release,
	&command_render,   &command_retry,   &command_routines,
	&command_run,      &command_script,  &command_serve,
	&command_shutdown, &command_submit,  &command_suspend,
	&command_wait,     &command_workers, NULL,
};

const struct command *command_find(const char *name)
{
	for (int i = 0; command_table[i]; i++)
		if (!strcmp(command_table[i]->name, name))
			return command_table[i];
	return NULL;
}

int print_json(json_t *o)
{
	const struct report terminal = report_stderr("batten");
	json_t *all = json_pack("{s:i}", "version", 1);

	if (!o || !all || json_object_update(all, o)) {
		json_decref(o);
		json_decref(all);
		return status_exit(report_error(&terminal, ST_RESOURCE, "memory ran out"));
	}
	char *s = json_write(all, true);
	json_decref(o);
	json_decref(all);
	/* that standard output takes nothing is said at the end of the verb */
	if (!s)
		return status_exit(report_error(&terminal, ST_RESOURCE, "memory ran out"));
	int rc = puts(s) < 0 ? status_exit(ST_RESOURCE) : 0;
	free(s);
	return rc;
}
