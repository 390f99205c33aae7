/* settings.c - the settings table, read from two files and the environment. */
#include "settings.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "number.h"
#include "path.h"
#include "text.h"

enum { SETTINGS_FILE_MAX = 1 << 20 };

#define X(name, key, type, def, min, max, help) { key, type, def, min, max, help },
const struct setting_row settings_table[N_SETTINGS] = { SETTINGS_MAP(X) };
#undef X

/* What a word setting may be. */
static const char *const settings_words[N_SETTINGS] = {
	[SETTING_COLOR] = "auto, always or never",
	[SETTING_RESUME] = "auto, ask or never",
	[SETTING_BELL] = "on or off",
	[SETTING_LAUNCHER] = "local or slurm",
};

static bool word_allowed(const char *words, const char *value)
{
	size_t n = strlen(value);
	for (const char *p = words; n && (p = strstr(p, value)); p += n) {
		bool begins = p == words || p[-1] == ' ';
		if (begins && (!p[n] || p[n] == ',' || p[n] == ' ') && strcmp(value, "or"))
			return true;
	}
	return false;
}

/* where: "'FILE' line N" or "the environment". */
static enum status value_check(int which, const char *value, const char *where,
                               const struct report *r)
{
	const struct setting_row *row = &settings_table[which];
	int64_t i;
	double x;
	if (row->type == 't')
		return ST_OK;
	if (row->type == 'w') {
		if (word_allowed(settings_words[which], value))
			return ST_OK;
		return report_error(r, ST_PARAMETER, "%s: %s is '%s', expected %s", where, row->key,
		                    value, settings_words[which]);
	}
	if (row->type == 'i') {
		if (number_parse_integer(value, &i) && (double)i >= row->min &&
		    (double)i <= row->max)
			return ST_OK;
		return report_error(r, ST_PARAMETER,
		                    "%s: %s is '%s', expected a whole number from %.0f to %.0f",
		                    where, row->key, value, row->min, row->max);
	}
	if (number_parse(value, &x) && x >= row->min && x <= row->max)
		return ST_OK;
	return report_error(r, ST_PARAMETER, "%s: %s is '%s', expected seconds from %g to %g",
	                    where, row->key, value, row->min, row->max);
}

static enum status out_of_memory(const struct report *r)
{
	return report_error(r, ST_RESOURCE, "cannot read the settings: out of memory");
}

static enum status value_set(struct settings *s, int which, const char *value, const char *source,
                             const char *where, const struct report *r)
{
	enum status st = value_check(which, value, where, r);
	if (st != ST_OK)
		return st;
	char *v = strdup(value), *from = strdup(source);
	if (!v || !from) {
		free(v);
		free(from);
		return out_of_memory(r);
	}
	free(s->value[which]);
	free(s->source[which]);
	s->value[which] = v;
	s->source[which] = from;
	return ST_OK;
}

static int key_find(const char *key)
{
	for (int i = 0; i < N_SETTINGS; i++)
		if (!strcmp(key, settings_table[i].key))
			return i;
	return -1;
}

static char *trim(char *s)
{
	while (isspace((unsigned char)*s))
		s++;
	for (char *end = s + strlen(s); end > s && isspace((unsigned char)end[-1]);)
		*--end = '\0';
	return s;
}

static void cut_comment(char *s)
{
	for (char *c = s; *c; c++)
		if (*c == '#' && (c == s || isspace((unsigned char)c[-1])))
			*c = '\0';
}

/* "..." with \" and \\ inside, and nothing but a comment behind it: what stands in it, in place. False
 * for another value, which is left as it is. */
static bool unquote(char *s)
{
	char *from = s + 1;
	if (*s != '"')
		return false;
	for (; *from && *from != '"'; from++)
		from += *from == '\\' && from[1];
	if (!*from)
		return false;
	char *behind = from + 1 + strspn(from + 1, " \t\r");
	if (*behind && *behind != '#')
		return false;
	*from = '\0';
	for (from = s + 1; *from; *s++ = *from++)
		from += *from == '\\' && from[1];
	*s = '\0';
	return true;
}

/* Split "key = value  # comment"; false for a line that says nothing. *value is NULL without '='. */
static bool line_split(char *line, char **key, char **value)
{
	char *equals = line + strcspn(line, "=#");
	*value = NULL;
	if (*equals == '=') {
		*equals = '\0';
		*value = equals + 1 + strspn(equals + 1, " \t");
		if (!unquote(*value)) {
			cut_comment(*value);
			*value = trim(*value);
		}
		*key = trim(line);
		return true;
	}
	cut_comment(line);
	*key = trim(line);
	return **key;
}

static enum status file_lines(struct settings *s, const char *path, char *text,
                              const struct report *r)
{
	enum status st = ST_OK;
	int number = 0;
	for (char *line = text, *next; line && st == ST_OK; line = next) {
		char *key, *value;
		number++;
		next = strchr(line, '\n');
		if (next)
			*next++ = '\0';
		if (!line_split(line, &key, &value))
			continue;
		char *where = text_print("'%s' line %d", path, number);
		int which = key_find(key);
		if (!where)
			st = out_of_memory(r);
		else if (!value)
			st = report_error(r, ST_PARAMETER, "%s: expected 'key = value', found '%s'",
			                  where, key);
		else if (which < 0)
			st = report_error(
			        r, ST_PARAMETER,
			        "%s: there is no setting '%s'; 'batten config' lists them", where,
			        key);
		else
			st = value_set(s, which, value, path, where, r);
		free(where);
	}
	return st;
}

static enum status file_settings(struct settings *s, const char *path, const struct report *r)
{
	char *text;
	size_t n;
	if (!path)
		return out_of_memory(r);
	if (!path_exists(path))
		return ST_OK;
	enum status st = file_read(path, SETTINGS_FILE_MAX, &text, &n, r);
	if (st != ST_OK)
		return st;
	st = file_lines(s, path, text, r);
	free(text);
	return st;
}

static enum status environment(struct settings *s, const struct report *r)
{
	enum status st = ST_OK;
	for (int i = 0; i < N_SETTINGS && st == ST_OK; i++) {
		char *name = text_print("BATTEN_%s", settings_table[i].key);
		if (!name)
			return out_of_memory(r);
		for (char *c = name; *c; c++)
			*c = *c == '-' ? '_' : (char)toupper((unsigned char)*c);
		const char *value = getenv(name);
		if (value && *value)
			st = value_set(s, i, value, "environment", name, r);
		free(name);
	}
	return st;
}

static char *user_file(void)
{
	const char *folder = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
	if (folder && folder[0] == '/')
		return text_print("%s/batten/config", folder);
	return text_print("%s/.config/batten/config", home && *home ? home : "/");
}

enum status settings_read(struct settings *s, const struct project *p, const struct report *r)
{
	memset(s, 0, sizeof *s);
	enum status st = ST_OK;
	for (int i = 0; i < N_SETTINGS && st == ST_OK; i++)
		st = value_set(s, i, settings_table[i].def, "default", "default", r);
	char *path = NULL;
	if (st == ST_OK)
		st = file_settings(s, path = user_file(), r);
	free(path);
	path = NULL;
	if (st == ST_OK && p)
		st = file_settings(s, path = path_join(p->hidden, "config"), r);
	free(path);
	if (st == ST_OK)
		st = environment(s, r);
	if (st != ST_OK)
		settings_finish(s);
	return st;
}

void settings_finish(struct settings *s)
{
	for (int i = 0; s && i < N_SETTINGS; i++) {
		free(s->value[i]);
		free(s->source[i]);
		s->value[i] = s->source[i] = NULL;
	}
}

double settings_number(const struct settings *s, enum setting which)
{
	double x;
	return number_parse(s->value[which], &x) ? x : NAN;
}

/* One that would not be read back as it is stands in quotes. */
static void add_value(struct text *out, const char *value)
{
	size_t n = strlen(value);
	bool plain =
	        !strchr(value, '#') && *value != '"' &&
	        (!n || (!isspace((unsigned char)*value) && !isspace((unsigned char)value[n - 1])));
	if (plain) {
		text_add(out, value);
		return;
	}
	text_add(out, "\"");
	for (const char *c = value; *c; c++)
		text_addf(out, *c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
	text_add(out, "\"");
}

static void add_line(struct text *out, const char *key, const char *value)
{
	text_addf(out, "%s = ", key);
	add_value(out, value);
	text_add(out, "\n");
}

/* The old text with the line of that key replaced, or a line added. Comments behind it go. */
static enum status text_with(struct text *out, char *old, const char *key, const char *value)
{
	bool written = false;
	for (char *line = old, *next; line && *line; line = next) {
		char *name, *ignored;
		next = strchr(line, '\n');
		if (next)
			*next++ = '\0';
		char *copy = strdup(line);
		if (!copy)
			return ST_RESOURCE;
		bool same = line_split(copy, &name, &ignored) && !strcmp(name, key);
		free(copy);
		if (!same)
			text_addf(out, "%s\n", line);
		else if (!written)
			add_line(out, key, value);
		written |= same;
	}
	if (!written)
		add_line(out, key, value);
	return out->failed ? ST_RESOURCE : ST_OK;
}

enum status settings_write(const struct project *p, bool user, const char *key, const char *value,
                           const struct report *r)
{
	struct text text = { 0 };
	char *old = NULL, *folder = NULL;
	size_t n;
	int which = key_find(key);
	if (which < 0)
		return report_error(r, ST_PARAMETER,
		                    "there is no setting '%s'; 'batten config' lists them", key);
	if (strpbrk(value, "\n\r"))
		return report_error(r, ST_PARAMETER, "cannot set %s: a setting is one line", key);
	enum status st = value_check(which, value, "cannot set it", r);
	if (st != ST_OK)
		return st;
	char *path = user ? user_file() : path_join(p->hidden, "config");
	if (path)
		folder = path_folder(path);
	if (!path || !folder) {
		st = report_error(r, ST_RESOURCE, "cannot set %s: out of memory", key);
		goto end;
	}
	if (path_exists(path))
		st = file_read(path, SETTINGS_FILE_MAX, &old, &n, r);
	if (st == ST_OK && (st = text_with(&text, old, key, value)) != ST_OK)
		report_error(r, st, "cannot set %s: out of memory", key);
	if (st == ST_OK)
		st = folder_make(folder, 0777, r);
	if (st == ST_OK)
		st = file_write(path, text.s, text.n, r);
end:
	text_finish(&text);
	free(old);
	free(folder);
	free(path);
	return st;
}
