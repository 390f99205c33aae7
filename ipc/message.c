/* message.c - packets: encoding, decoding, and the checks on what comes from outside. */
#include "message.h"

#include <errno.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "json.h"

#define X(name, number, ways, fields) { #name, number, ways, fields },
const struct message_row message_table[] = { MESSAGE_MAP(X) };
#undef X
const size_t message_table_size = sizeof message_table / sizeof message_table[0];

const struct message_row *message_row(uint32_t number)
{
	for (size_t i = 0; i < message_table_size; i++)
		if (message_table[i].number == number)
			return &message_table[i];
	return NULL;
}

void message_finish(struct message *m)
{
	if (!m)
		return;
	json_decref(m->body);
	*m = (struct message){ 0 };
}

static void put_u32(unsigned char *p, uint32_t x)
{
	for (int i = 0; i < 4; i++)
		p[i] = (unsigned char)(x >> (8 * i));
}

static uint32_t get_u32(const char *bytes)
{
	const unsigned char *p = (const unsigned char *)bytes;
	return (uint32_t)p[3] << 24 | (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
}

enum status message_encode(struct text *out, uint32_t type, const json_t *body)
{
	char *text = NULL;
	size_t n = 0;
	if (body) {
		text = json_write(body, false);
		if (!text)
			return ST_RESOURCE;
		n = strlen(text);
		if (n > MESSAGE_TEXT_MAX) {
			free(text);
			return ST_INTERNAL;
		}
	}
	unsigned char header[MESSAGE_HEADER];
	put_u32(header, type);
	put_u32(header + 4, (uint32_t)n);
	text_add_bytes(out, header, sizeof header);
	if (n)
		text_add_bytes(out, text, n);
	free(text);
	return out->failed ? ST_RESOURCE : ST_OK;
}

/* All n bytes, in one write unless the pipe takes fewer. */
static enum status write_whole(int fd, const char *p, size_t n)
{
	while (n > 0) {
		ssize_t wrote = write(fd, p, n);
		if (wrote > 0) {
			p += wrote;
			n -= (size_t)wrote;
		} else if (wrote < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
			struct pollfd ready = { .fd = fd, .events = POLLOUT };
			if (poll(&ready, 1, -1) < 0 && errno != EINTR)
				return ST_RESOURCE;
		} else if (wrote == 0 || errno != EINTR) {
			return ST_RESOURCE;
		}
	}
	return ST_OK;
}

enum status message_send(int fd, uint32_t type, const json_t *body)
{
	struct text packet = { 0 };
	enum status st = message_encode(&packet, type, body);
	if (st == ST_OK)
		st = write_whole(fd, packet.s, packet.n);
	text_finish(&packet);
	return st;
}

void message_reader_init(struct message_reader *r, unsigned ways)
{
	*r = (struct message_reader){ .ways = ways };
}

void message_reader_finish(struct message_reader *r)
{
	free(r->bytes);
	r->bytes = NULL;
	r->n = r->cap = r->at = 0;
}

char *message_reader_room(struct message_reader *r, size_t n, size_t *room)
{
	if (r->at > 0) {
		memmove(r->bytes, r->bytes + r->at, r->n - r->at);
		r->n -= r->at;
		r->at = 0;
	}
	if (r->cap - r->n < n) {
		if (n > SIZE_MAX / 2 || r->n > SIZE_MAX / 4)
			return NULL;
		size_t cap = r->cap ? 2 * r->cap : 4096;
		if (cap < r->n + n)
			cap = r->n + n;
		char *bytes = realloc(r->bytes, cap);
		if (!bytes)
			return NULL;
		r->bytes = bytes;
		r->cap = cap;
	}
	*room = r->cap - r->n;
	return r->bytes + r->n;
}

void message_reader_filled(struct message_reader *r, size_t n)
{
	r->n += n;
}

bool message_reader_partial(const struct message_reader *r)
{
	return !r->failed && r->n > r->at;
}

__attribute__((format(printf, 2, 3))) static int fail(struct message_reader *r, const char *format,
                                                      ...)
{
	va_list args;
	va_start(args, format);
	vsnprintf(r->reason, sizeof r->reason, format, args);
	va_end(args);
	r->failed = true;
	return -1;
}

static bool field_fits(const json_t *value, char type)
{
	switch (type) {
	case 's':
		return json_is_string(value);
	case 'i':
		return json_is_integer(value);
	case 'n':
		return json_is_number(value);
	case 'o':
		return json_is_object(value);
	case 'a':
		return json_is_array(value);
	case 'b':
		return json_is_boolean(value);
	}
	return false;
}

static const char *field_type_name(char type)
{
	switch (type) {
	case 's':
		return "a string";
	case 'i':
		return "an integer";
	case 'n':
		return "a number";
	case 'o':
		return "an object";
	case 'a':
		return "an array";
	}
	return "true or false";
}

/* Every field of the row is there with its type; fields that the row does not have are let be. */
static int check_fields(struct message_reader *r, const struct message_row *row, const json_t *body)
{
	for (const char *p = row->fields; *p;) {
		size_t n = strcspn(p, " ");
		size_t name_n = (size_t)(strchr(p, ':') - p);
		char type = p[name_n + 1];
		bool optional = p[n - 1] == '?';
		char name[64];
		snprintf(name, sizeof name, "%.*s", (int)name_n, p);
		const json_t *value = json_object_get(body, name);
		if (!value || json_is_null(value)) {
			if (!optional)
				return fail(r, "%s without '%s'", row->name, name);
		} else if (!field_fits(value, type)) {
			return fail(r, "'%s' of %s is not %s", name, row->name,
			            field_type_name(type));
		}
		p += n;
		p += strspn(p, " ");
	}
	return 1;
}

bool message_reader_text(struct message_reader *r, enum message_type type, const char **text,
                         size_t *n)
{
	const char *p = r->bytes + r->at;
	const struct message_row *row = message_row(type);
	if (r->failed || r->n - r->at < MESSAGE_HEADER || get_u32(p) != type ||
	    !(row->ways & r->ways))
		return false;
	uint32_t length = get_u32(p + 4);
	if (length > MESSAGE_TEXT_MAX || r->n - r->at - MESSAGE_HEADER < length)
		return false;
	*text = p + MESSAGE_HEADER;
	*n = length;
	r->at += MESSAGE_HEADER + length;
	return true;
}

int message_reader_next(struct message_reader *r, struct message *out)
{
	*out = (struct message){ 0 };
	if (r->failed)
		return -1;
	if (r->n - r->at < MESSAGE_HEADER)
		return 0;
	const char *p = r->bytes + r->at;
	uint32_t type = get_u32(p), length = get_u32(p + 4);
	const struct message_row *row = message_row(type);
	if (!row)
		return fail(r, "packet of unknown type %u", type);
	if (!(row->ways & r->ways))
		return fail(r, "packet %s does not belong here", row->name);
	if (length > MESSAGE_TEXT_MAX)
		return fail(r, "packet %s of %u bytes, at most %d are allowed", row->name, length,
		            MESSAGE_TEXT_MAX);
	if (r->n - r->at - MESSAGE_HEADER < length)
		return 0;
	json_t *body;
	if (length == 0) {
		body = json_object();
		if (!body)
			return fail(r, "memory ran out");
	} else {
		json_error_t error;
		body = json_loadb(p + MESSAGE_HEADER, length, 0, &error);
		if (!body)
			return fail(r, "packet %s is not JSON: %s", row->name, error.text);
		if (!json_is_object(body)) {
			json_decref(body);
			return fail(r, "packet %s is not a JSON object", row->name);
		}
	}
	if (check_fields(r, row, body) < 0) {
		json_decref(body);
		return -1;
	}
	r->at += MESSAGE_HEADER + length;
	*out = (struct message){ .type = type, .body = body };
	return 1;
}
