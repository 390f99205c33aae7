/* report.c - saying sentences. */
#include "report.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { SENTENCE_MAX = 4096 };

const struct report report_none = { NULL, NULL };

static void say(const struct report *r, enum report_level level, enum status st, const char *format,
                va_list list)
{
	char text[SENTENCE_MAX];

	if (!r || !r->say)
		return;
	vsnprintf(text, sizeof text, format, list);
	r->say(r->data, level, st, text);
}

enum status report_error(const struct report *r, enum status st, const char *format, ...)
{
	va_list list;

	va_start(list, format);
	say(r, REPORT_ERROR, st, format, list);
	va_end(list);
	return st;
}

void report_warning(const struct report *r, const char *format, ...)
{
	va_list list;

	va_start(list, format);
	say(r, REPORT_WARNING, ST_OK, format, list);
	va_end(list);
}

void report_info(const struct report *r, const char *format, ...)
{
	va_list list;

	va_start(list, format);
	say(r, REPORT_INFO, ST_OK, format, list);
	va_end(list);
}

static void store_say(void *data, enum report_level level, enum status st, const char *text)
{
	struct report_store *s = data;

	if (level == REPORT_ERROR) {
		snprintf(s->error, sizeof s->error, "%s", text);
		s->status = st;
		s->n_errors++;
	} else if (level == REPORT_WARNING) {
		snprintf(s->warning, sizeof s->warning, "%s", text);
		s->n_warnings++;
	}
}

void report_store_init(struct report_store *s)
{
	memset(s, 0, sizeof *s);
	s->report = (struct report){ store_say, s };
}

static void stderr_say(void *data, enum report_level level, enum status st, const char *text)
{
	const char *name = data;

	(void)st;
	fprintf(stderr, "%s: %s%s\n", name, level == REPORT_WARNING ? "warning: " : "", text);
}

struct report report_stderr(const char *name)
{
	return (struct report){ stderr_say, (void *)(size_t)name };
}
