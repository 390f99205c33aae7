/* base_scan.c - tokens of a .base text. */
#include "base_scan.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "text.h"

void scan_init(struct scanner *p, const char *bytes, size_t n, const char *name, struct model *m,
               const struct progress *progress, const struct report *r)
{
	*p = (struct scanner){ .start = bytes,
		               .s = bytes,
		               .end = bytes + n,
		               .token = bytes,
		               .name = name,
		               .m = m,
		               .progress = progress,
		               .r = r };
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

void scan_blanks(struct scanner *p)
{
	while (p->s < p->end) {
		if (is_blank(*p->s)) {
			p->s++;
		} else if (*p->s == '#') {
			const char *eol = memchr(p->s, '\n', (size_t)(p->end - p->s));
			p->s = eol ? eol : p->end;
		} else {
			break;
		}
	}
	p->token = p->s;
}

static const char *token_end(const struct scanner *p)
{
	const char *e = p->token;
	while (e < p->end && !is_blank(*e) && *e != '#')
		e++;
	return e;
}

int scan_line(const struct scanner *p, const char *at, int *column)
{
	int line = 1;
	const char *bol = p->start;
	for (const char *q; (q = memchr(bol, '\n', (size_t)(at - bol))) != NULL; bol = q + 1)
		line++;
	*column = (int)(at - bol) + 1;
	return line;
}

void scan_fail(struct scanner *p, const char *expected, ...)
{
	if (p->st != ST_OK)
		return;
	char what[256];
	va_list args;
	va_start(args, expected);
	vsnprintf(what, sizeof what, expected, args);
	va_end(args);
	int column, line = scan_line(p, p->token, &column);
	int n = (int)(token_end(p) - p->token);
	if (p->token >= p->end)
		p->st = report_error(p->r, ST_INPUT,
		                     "%s:%d:%d: found the end of the file, expected %s", p->name,
		                     line, column, what);
	else
		p->st = report_error(p->r, ST_INPUT, "%s:%d:%d: found '%.*s'%s, expected %s",
		                     p->name, line, column, n > 40 ? 40 : n, p->token,
		                     n > 40 ? " (and more)" : "", what);
}

void scan_no_memory(struct scanner *p)
{
	if (p->st == ST_OK)
		p->st = report_error(p->r, ST_RESOURCE, "cannot read '%s': no memory", p->name);
}

void scan_keep(struct scanner *p, enum status st)
{
	if (st != ST_OK)
		scan_no_memory(p);
}

bool scan_word(struct scanner *p, const char *word)
{
	scan_blanks(p);
	size_t n = (size_t)(token_end(p) - p->token);
	if (n != strlen(word) || memcmp(p->token, word, n) != 0)
		return false;
	p->s = p->token + n;
	return true;
}

double scan_number(struct scanner *p, const char *what)
{
	double x = 0;
	if (p->st != ST_OK)
		return 0;
	scan_blanks(p);
	if (!number_read(&p->s, p->end, &x) || p->s != token_end(p) || !isfinite(x))
		scan_fail(p, "%s: a number", what);
	return x;
}

int scan_integer(struct scanner *p, const char *what, int64_t lo, int64_t hi)
{
	int64_t x = 0;
	if (p->st != ST_OK)
		return 0;
	scan_blanks(p);
	if (!number_read_integer(&p->s, p->end, &x) || p->s != token_end(p) || x < lo || x > hi)
		scan_fail(p, "%s: a whole number from %lld to %lld", what, (long long)lo,
		          (long long)hi);
	return (int)x;
}

int64_t scan_numbers_left(const struct scanner *p, int64_t each)
{
	int64_t n = ((int64_t)(p->end - p->s) / 2 + 1) / each;
	return n < INT_MAX - ORDER_MAX ? n : INT_MAX - ORDER_MAX;
}

bool scan_flag(struct scanner *p, const char *what)
{
	if (p->st != ST_OK)
		return false;
	bool yes = scan_word(p, "yes");
	if (!yes && !scan_word(p, "no"))
		scan_fail(p, "%s: yes or no", what);
	return yes;
}

static int hex_digit(char c)
{
	return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* The character that stands behind a backslash at *s. */
static bool read_escape(const char **s, const char *end, char *out)
{
	if (*s >= end)
		return false;
	*out = *(*s)++;
	if (*out == '"' || *out == '\\')
		return true;
	if (*out == 'n') {
		*out = '\n';
		return true;
	}
	if (*out != 'x' || end - *s < 2)
		return false;
	int hi = hex_digit((*s)[0]), lo = hex_digit((*s)[1]);
	*s += 2;
	*out = (char)(hi * 16 + lo);
	return hi >= 0 && lo >= 0 && *out != '\0';
}

char *scan_string(struct scanner *p, const char *what)
{
	if (p->st != ST_OK)
		return NULL;
	scan_blanks(p);
	const char *s = p->s;
	struct text t = { 0 };
	bool good = s < p->end && *s++ == '"';
	text_add(&t, "");
	while (good && s < p->end && *s != '"') {
		char c = *s++;
		good = c == '\\' ? read_escape(&s, p->end, &c) : c != '\n' && c != '\0';
		text_add_bytes(&t, &c, 1);
	}
	if (!good || s >= p->end) {
		text_finish(&t);
		scan_fail(p, "%s: a string in double quotes, closed on its line", what);
		return NULL;
	}
	p->s = s + 1;
	char *out = text_take(&t);
	if (!out)
		scan_no_memory(p);
	return out;
}

void scan_numbers(struct scanner *p, double *out, int64_t n, const char *what)
{
	for (int64_t i = 0; i < n && p->st == ST_OK; i++) {
		out[i] = scan_number(p, what);
		if ((i & 0xffff) == 0xffff) {
			enum status st =
			        progress_step(p->progress, (double)(p->s - p->start) /
			                                           (double)(p->end - p->start));
			if (st != ST_OK)
				p->st = st;
		}
	}
}
