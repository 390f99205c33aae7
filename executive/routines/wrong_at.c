/* wrong_at.c - the first wrong character of a value, for the caret. */
#include <string.h>

#include "number.h"
#include "private.h"

/* Numbers with these signs between them, in turn; NULL: none. */
static size_t numbers_to(const char *value, const char *between)
{
	const char *p = value, *end = value + strlen(value);
	double x;

	while (number_read(&p, end, &x) && between && p < end && strchr(between, *p))
		p++;
	return (size_t)(p - value);
}

static size_t choice_to(const char *choices, const char *value)
{
	size_t best = 0;

	for (const char *p = choices; p && *p; p += strcspn(p, "|"), p += *p == '|') {
		size_t n = 0;
		while (value[n] && value[n] == p[n] && p[n] != '|')
			n++;
		best = n > best ? n : best;
	}
	return best;
}

static size_t color_to(const char *value)
{
	if (*value != '#')
		return 0;
	const size_t n = strspn(value + 1, "0123456789abcdefABCDEF");
	return 1 + (n > 6 ? 6 : n);
}

size_t argument_wrong_at(const struct argument_row *row, const char *value)
{
	switch (row->type) {
	case ARGUMENT_NUMBER:
		return numbers_to(value, NULL);
	case ARGUMENT_INTEGER:
		return strspn(value, "+-0123456789");
	case ARGUMENT_VECTOR:
		return numbers_to(value, ",");
	case ARGUMENT_POINTS:
		return numbers_to(value, ",;");
	case ARGUMENT_SIZE:
		return numbers_to(value, "x");
	case ARGUMENT_JOBS:
		return strspn(value, "0123456789,");
	case ARGUMENT_COLOR:
		return color_to(value);
	case ARGUMENT_CHOICE:
		return choice_to(row->choices, value);
	default:
		return strlen(value);
	}
}
