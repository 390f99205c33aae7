/* config.c - list, get and set the settings. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "json.h"
#include "settings.h"
#include "verbs.h"

static const struct option_row config_options[] = {
	{ "--user", NULL, NULL, "set it in the user's file, not in the project's" },
	{ 0 },
};

static int find_key(const char *key)
{
	for (int k = 0; k < N_SETTINGS; k++)
		if (!strcmp(settings_table[k].key, key))
			return k;
	return -1;
}

static int show_all(const struct invocation *i, const struct settings *s)
{
	json_t *all = json_array();

	for (int k = 0; k < N_SETTINGS; k++) {
		const struct setting_row *row = &settings_table[k];
		if (!i->json)
			printf("%-13s = %-8s # %s (%s)\n", row->key, s->value[k], row->help,
			       s->source[k]);
		json_array_append_new(all, json_pack("{s:s, s:s, s:s, s:s, s:s}", "key", row->key,
		                                     "value", s->value[k], "default", row->def,
		                                     "source", s->source[k], "help", row->help));
	}
	if (i->json)
		return print_json(json_pack("{s:o}", "settings", all));
	json_decref(all);
	return 0;
}

static int show_one(const struct invocation *i, const struct settings *s, int k)
{
	if (i->json)
		return print_json(json_pack("{s:s, s:s, s:s}", "key", settings_table[k].key,
		                            "value", s->value[k], "source", s->source[k]));
	puts(s->value[k]);
	return 0;
}

static int config_run(const struct invocation *i)
{
	struct project p;
	struct settings s = { 0 };
	int k = i->n_words ? find_key(i->words[0]) : 0;

	if (k < 0 || i->n_words > 2)
		return status_exit(
		        report_error(&i->report, ST_PARAMETER,
		                     k < 0 ? "there is no setting '%s'; batten config lists them"
		                           : "%s: give a key and one value",
		                     i->words[0]));
	enum status st = project_find(&p, NULL, &i->report);
	if (st == ST_OK && i->n_words == 2) {
		bool user = invocation_flag(i, "--user");
		if (!user)
			st = project_make(&p, &i->report);
		if (st == ST_OK)
			st = settings_write(&p, user, i->words[0], i->words[1], &i->report);
	}
	if (st == ST_OK)
		st = settings_read(&s, &p, &i->report);
	int rc = status_exit(st);
	if (st == ST_OK && !i->n_words)
		rc = show_all(i, &s);
	else if (st == ST_OK && (i->n_words == 1 || i->json))
		rc = show_one(i, &s, k);
	settings_finish(&s);
	project_finish(&p);
	return rc;
}

const struct command command_config = {
	.name = "config",
	.usage = "[KEY [VALUE]] [--user]",
	.text = "list, get and set the settings",
	.help = "Read in this order, later ones win: ~/.config/batten/config, .batten/config, the\n"
	        "environment (setting term-grace is BATTEN_TERM_GRACE).",
	.options = config_options,
	.run = config_run,
};
