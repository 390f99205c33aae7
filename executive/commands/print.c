/* print.c - JSON on standard output as it is made. */
#include "print.h"

#include <stdio.h>

#include "json.h"
#include "report.h"

enum { WAITING_MOST = 1 << 16 };

static void put_out(struct print *p)
{
	if (p->waiting.n && fwrite(p->waiting.s, 1, p->waiting.n, stdout) != p->waiting.n)
		p->failed = true;
	p->failed |= p->waiting.failed;
	text_reset(&p->waiting);
}

static void put_value(struct print *p, json_t *value, int depth)
{
	if (value)
		json_write_at(&p->waiting, value, depth);
	else
		p->failed = true;
	json_decref(value);
	if (!p->held && p->waiting.n > WAITING_MOST)
		put_out(p);
}

void print_begin(struct print *p, bool held)
{
	*p = (struct print){ .held = held };
	text_add(&p->waiting, "{\n  \"version\": 1");
}

void print_member(struct print *p, const char *name, json_t *value)
{
	text_addf(&p->waiting, ",\n  \"%s\": ", name);
	put_value(p, value, 1);
}

void print_rows(struct print *p, const char *name)
{
	text_addf(&p->waiting, ",\n  \"%s\": [", name);
	p->row = false;
}

void print_row(struct print *p, json_t *row)
{
	text_add(&p->waiting, p->row ? ",\n    " : "\n    ");
	put_value(p, row, 2);
	p->row = true;
}

void print_rows_end(struct print *p)
{
	text_add(&p->waiting, p->row ? "\n  ]" : "]");
}

int print_end(struct print *p)
{
	const struct report terminal = report_stderr("batten");
	text_add(&p->waiting, "\n}\n");
	put_out(p);
	const bool failed = p->failed | (fflush(stdout) != 0);
	print_forget(p);
	/* that standard output takes nothing is said at the end of the verb */
	if (failed && !ferror(stdout))
		report_error(&terminal, ST_RESOURCE, "memory ran out");
	return failed ? status_exit(ST_RESOURCE) : 0;
}

void print_forget(struct print *p)
{
	text_finish(&p->waiting);
	*p = (struct print){ 0 };
}
