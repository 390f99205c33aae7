/* record.c - JSON as stats_write_brief writes it, checked without taking it apart: lists are long. */
#include "record.h"

#include <stdio.h>
#include <string.h>

#include "text.h"

/* Deeper, longer and larger values are none of ours, and some readers of JSON refuse them. */
enum { DEPTH_MAX = 32, DIGITS_MAX = 18, FRACTION_MAX = 400, EXPONENT_MAX = 3 };
/* of the record, of its lists, of what stands in those */
enum { DEPTH_RECORD = 1, DEPTH_LIST = 2, DEPTH_ELEMENT = 3 };
/* what that must be */
enum elements { ELEMENTS_ANY, ELEMENTS_FILES, ELEMENTS_IDS };

struct scan {
	const char *p, *end;
	const char *id, *state; /* the values that the record must have, as they are written */
	bool has_id, has_state;
	enum elements elements; /* of the list that is being read */
};

struct span {
	const char *p;
	size_t n;
};

static bool next_is(struct scan *s, char c)
{
	if (s->p == s->end || *s->p != c)
		return false;
	s->p++;
	return true;
}

static bool span_is(struct span a, const char *text)
{
	return a.n == strlen(text) && !memcmp(a.p, text, a.n);
}

static bool escape(struct scan *s)
{
	static const char hex[] = "0123456789abcdef";
	if (s->p == s->end)
		return false;
	const char c = *s->p++;
	if (c != 'u')
		return memchr("\"\\/bfnrt", c, 8);
	/* a control character, which is all that is written so */
	const bool good = s->end - s->p >= 4 && !memcmp(s->p, "00", 2) &&
	                  (s->p[2] == '0' || s->p[2] == '1') && s->p[3] && strchr(hex, s->p[3]) &&
	                  memcmp(s->p, "0000", 4) != 0;
	s->p += good ? 4 : 0;
	return good;
}

static bool string(struct scan *s, struct span *out)
{
	if (!next_is(s, '"'))
		return false;
	out->p = s->p;
	while (s->p < s->end && *s->p != '"') {
		const unsigned char c = (unsigned char)*s->p;
		size_t n = 1;
		if (c < 0x20)
			return false;
		if (c == '\\') {
			s->p++;
			if (!escape(s))
				return false;
			continue;
		}
		if (c >= 0x80 && !(n = text_character(s->p, (size_t)(s->end - s->p))))
			return false;
		s->p += n;
	}
	out->n = (size_t)(s->p - out->p);
	return next_is(s, '"');
}

/* How many; 0: more than max as well. */
static size_t digits(struct scan *s, size_t max)
{
	const char *from = s->p;
	while (s->p < s->end && *s->p >= '0' && *s->p <= '9')
		s->p++;
	const size_t n = (size_t)(s->p - from);
	return n <= max ? n : 0;
}

static bool number(struct scan *s)
{
	next_is(s, '-');
	const char *first = s->p;
	const size_t n = digits(s, DIGITS_MAX);
	if (!n || (*first == '0' && n > 1))
		return false;
	if (next_is(s, '.') && !digits(s, FRACTION_MAX))
		return false;
	if (!next_is(s, 'e') && !next_is(s, 'E'))
		return true;
	/* what is too small is read as 0, what is too large not at all */
	if (next_is(s, '-'))
		return digits(s, EXPONENT_MAX);
	next_is(s, '+');
	return digits(s, EXPONENT_MAX - 1);
}

static bool word(struct scan *s, const char *text)
{
	const size_t n = strlen(text);
	if ((size_t)(s->end - s->p) < n || memcmp(s->p, text, n) != 0)
		return false;
	s->p += n;
	return true;
}

static bool value(struct scan *s, int depth);

static bool list(struct scan *s, int depth)
{
	const enum elements wanted = depth == DEPTH_LIST ? s->elements : ELEMENTS_ANY;
	if (next_is(s, ']'))
		return true;
	do {
		const bool opens = s->p < s->end && *s->p == '{';
		if ((wanted == ELEMENTS_FILES && !opens) ||
		    (wanted == ELEMENTS_IDS ? !digits(s, DIGITS_MAX) : !value(s, depth)))
			return false;
	} while (next_is(s, ','));
	return next_is(s, ']');
}

static enum elements elements_of(struct span key)
{
	if (span_is(key, "inputs") || span_is(key, "outputs"))
		return ELEMENTS_FILES;
	return span_is(key, "after") || span_is(key, "after_any") ? ELEMENTS_IDS : ELEMENTS_ANY;
}

static bool object(struct scan *s, int depth)
{
	bool has_path = depth != DEPTH_ELEMENT || s->elements != ELEMENTS_FILES;
	if (next_is(s, '}'))
		return has_path;
	do {
		struct span key, what;
		if (!string(s, &key) || !next_is(s, ':'))
			return false;
		if (depth == DEPTH_RECORD)
			s->elements = elements_of(key);
		what.p = s->p;
		if (!value(s, depth))
			return false;
		what.n = (size_t)(s->p - what.p);
		if (depth == DEPTH_RECORD) {
			s->has_id |= span_is(key, "id") && span_is(what, s->id);
			s->has_state |= span_is(key, "state") && span_is(what, s->state);
		}
		has_path |= span_is(key, "path") && *what.p == '"';
	} while (next_is(s, ','));
	return next_is(s, '}') && has_path;
}

static bool value(struct scan *s, int depth)
{
	struct span text;
	if (s->p == s->end || depth == DEPTH_MAX)
		return false;
	switch (*s->p) {
	case '"':
		return string(s, &text);
	case '{':
		s->p++;
		return object(s, depth + 1);
	case '[':
		s->p++;
		return list(s, depth + 1);
	case 't':
		return word(s, "true");
	case 'f':
		return word(s, "false");
	case 'n':
		return word(s, "null");
	default:
		return number(s);
	}
}

bool record_is_sound(const char *text, size_t n, int64_t id, const char *state)
{
	char id_text[24], state_text[32];
	struct scan s = { .p = text, .end = text + n, .id = id_text, .state = state_text };
	snprintf(id_text, sizeof id_text, "%lld", (long long)id);
	snprintf(state_text, sizeof state_text, "\"%s\"", state);
	return n && *text == '{' && value(&s, 0) && s.p == s.end && s.has_id && s.has_state;
}
