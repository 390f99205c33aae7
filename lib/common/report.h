/* report.h - where the sentence about a failure or a warning goes.
 *
 * The status travels up through the callers; the sentence is said once, where the thing happened,
 * to the report that the outermost caller gave: a terminal, a packet, a test. A sentence has no
 * capital, no full stop, and says what failed, where, what was expected and what to do:
 * cannot read 'hull.igs' line 212: order 0, expected 2 or more; export the surface again
 */
#ifndef BATTEN_REPORT_H
#define BATTEN_REPORT_H

#include <stddef.h>

#include "status.h"

enum report_level { REPORT_INFO, REPORT_WARNING, REPORT_ERROR };

typedef void report_say(void *data, enum report_level level, enum status st, const char *text);

struct report {
	report_say *say; /* NULL: nobody listens */
	void *data;      /* borrowed */
};

/* Nobody listens. */
extern const struct report report_none;

/*
 * Say one sentence. report_error gives st back, so that a failure is one statement:
 *	return report_error(r, ST_INPUT, "cannot read '%s': ...", path);
 * r may be NULL. Thread: any; `say` of a report used from several threads must allow that.
 */
enum status report_error(const struct report *r, enum status st, const char *format, ...)
        __attribute__((format(printf, 3, 4)));
void report_warning(const struct report *r, const char *format, ...)
        __attribute__((format(printf, 2, 3)));
void report_info(const struct report *r, const char *format, ...)
        __attribute__((format(printf, 2, 3)));

/* A report that keeps the last error and counts: for tests, and to pass a sentence on later. */
struct report_store {
	struct report report; /* give &store.report */
	char error[1024];     /* last error's sentence, cut there; "" if none */
	char warning[1024];   /* last warning's */
	enum status status;   /* last error's */
	size_t n_errors, n_warnings;
};
void report_store_init(struct report_store *s);

/* A report that writes lines to standard error: "NAME: SENTENCE", "NAME: warning: SENTENCE". */
struct report report_stderr(const char *name);

#endif
