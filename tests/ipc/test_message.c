/* test_message.c - packets: there and back, in any pieces, and everything that is none. */
#include "message.h"

#include <fcntl.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"

static const char *document;

enum { ALL_WAYS = FROM_WORKER | TO_WORKER | FROM_CLIENT | FROM_SERVICE };

/* A body that has every field of a row. */
static json_t *full_body(const struct message_row *row)
{
	json_t *o = json_object();
	for (const char *p = row->fields; *p; p += strspn(p, " ")) {
		char name[64];
		snprintf(name, sizeof name, "%.*s", (int)strcspn(p, ":"), p);
		p += strcspn(p, ":") + 1;
		json_t *value = *p == 's'   ? json_string("text \xc3\xa4\n")
		                : *p == 'i' ? json_integer(-7)
		                : *p == 'n' ? json_real(0.1)
		                : *p == 'o' ? json_pack("{s:n}", "K_min")
		                : *p == 'a' ? json_pack("[i, s]", 3, "x")
		                            : json_true();
		json_object_set_new(o, name, value);
		p += strcspn(p, " ");
	}
	return o;
}

static void fill(struct message_reader *r, const void *bytes, size_t n)
{
	size_t room;
	char *to = message_reader_room(r, n, &room);
	assert_non_null(to);
	assert_true(room >= n);
	memcpy(to, bytes, n);
	message_reader_filled(r, n);
}

/* Every row of the table in one stream, cut into pieces of every size. */
static void test_there_and_back(void **state)
{
	(void)state;
	struct text stream = { 0 };
	for (size_t i = 0; i < message_table_size; i++) {
		json_t *body = full_body(&message_table[i]);
		assert_int_equal(message_encode(&stream, message_table[i].number, body), ST_OK);
		json_decref(body);
	}
	static const size_t pieces[] = { 1, 2, 3, 7, 8, 9, 64, 1000, 1 << 20 };
	for (size_t k = 0; k < sizeof pieces / sizeof pieces[0]; k++) {
		struct message_reader r;
		struct message m;
		size_t seen = 0;
		message_reader_init(&r, ALL_WAYS);
		for (size_t at = 0; at < stream.n; at += pieces[k]) {
			size_t left = stream.n - at;
			fill(&r, stream.s + at, left < pieces[k] ? left : pieces[k]);
			while (message_reader_next(&r, &m) == 1) {
				json_t *body = full_body(&message_table[seen]);
				assert_int_equal(m.type, message_table[seen].number);
				assert_true(json_equal(m.body, body));
				json_decref(body);
				message_finish(&m);
				seen++;
			}
			assert_false(r.failed);
		}
		assert_int_equal(seen, message_table_size);
		assert_false(message_reader_partial(&r));
		message_reader_finish(&r);
	}
	text_finish(&stream);
}

static void test_wire(void **state)
{
	(void)state;
	struct text t = { 0 };
	json_t *body = json_pack("{s:s}", "job", "x");
	assert_int_equal(message_encode(&t, MESSAGE_START, body), ST_OK);
	assert_int_equal(message_encode(&t, MESSAGE_CANCEL, NULL), ST_OK);
	assert_int_equal(t.n, 8 + 11 + 8);
	assert_memory_equal(t.s, "\100\0\0\0\13\0\0\0{\"job\":\"x\"}\101\0\0\0\0\0\0\0", t.n);
	json_decref(body);
	text_finish(&t);
}

struct bad {
	const char *what;
	unsigned ways;
	uint32_t type;
	const char *text;
	const char *reason;
};

static void test_bad(void **state)
{
	(void)state;
	static const struct bad rows[] = {
		{ "type 0", ALL_WAYS, 0, "{}", "unknown type 0" },
		{ "a retired or future type", ALL_WAYS, 8, "{}", "unknown type 8" },
		{ "a large type", ALL_WAYS, 0xffffffff, "{}", "unknown type" },
		{ "the wrong way", FROM_WORKER, MESSAGE_START, "{\"job\":\"x\"}",
		  "does not belong" },
		{ "no JSON", FROM_WORKER, MESSAGE_PROGRESS, "xyz", "not JSON" },
		{ "cut JSON", FROM_WORKER, MESSAGE_PROGRESS, "{\"done\":1,", "not JSON" },
		{ "two objects", FROM_WORKER, MESSAGE_PROGRESS, "{} {}", "not JSON" },
		{ "a list", FROM_WORKER, MESSAGE_PROGRESS, "[1]", "not a JSON object" },
		{ "no UTF-8", FROM_WORKER, MESSAGE_NOTE, "{\"level\":\"info\",\"text\":\"\xff\"}",
		  "not JSON" },
		{ "a NUL", FROM_WORKER, MESSAGE_NOTE, "{\"level\":\"info\",\"text\":\"\\u0000\"}",
		  "not JSON" },
		{ "a field missing", FROM_WORKER, MESSAGE_PROGRESS, "{\"done\":1}", "'total'" },
		{ "a field null", FROM_WORKER, MESSAGE_PROGRESS, "{\"done\":1,\"total\":null}",
		  "'total'" },
		{ "a text for an integer", FROM_WORKER, MESSAGE_PROGRESS,
		  "{\"done\":\"1\",\"total\":2}", "'done' of PROGRESS is not an integer" },
		{ "a real for an integer", FROM_WORKER, MESSAGE_UNIT, "{\"unit\":1.5}",
		  "not an integer" },
		{ "a text for figures", FROM_WORKER, MESSAGE_RESULT,
		  "{\"path\":\"a\",\"kind\":\"b\",\"figures\":\"c\"}", "not an object" },
		{ "a text for a number", FROM_WORKER, MESSAGE_DONE, "{\"wall_s\":\"1\"}",
		  "not a number" },
		{ "a number for a list", FROM_CLIENT, MESSAGE_SUBMIT, "{\"id\":1,\"jobs\":1}",
		  "not an array" },
		{ "a number for a truth", FROM_CLIENT, MESSAGE_LIST, "{\"id\":1,\"all\":1}",
		  "not true or false" },
		{ "nothing where fields are needed", FROM_WORKER, MESSAGE_UNIT, "", "'unit'" },
	};
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct message_reader r;
		struct message m;
		uint32_t n = (uint32_t)strlen(rows[i].text);
		unsigned char header[8] = { (unsigned char)rows[i].type,
			                    (unsigned char)(rows[i].type >> 8),
			                    (unsigned char)(rows[i].type >> 16),
			                    (unsigned char)(rows[i].type >> 24), (unsigned char)n };
		message_reader_init(&r, rows[i].ways);
		fill(&r, header, sizeof header);
		fill(&r, rows[i].text, n);
		assert_int_equal(message_reader_next(&r, &m), -1);
		if (!strstr(r.reason, rows[i].reason))
			fail_msg("%s: '%s' is not in '%s'", rows[i].what, rows[i].reason, r.reason);
		/* it stays failed, whatever good comes after */
		fill(&r, "\101\0\0\0\0\0\0\0", 8);
		r.ways = ALL_WAYS;
		assert_int_equal(message_reader_next(&r, &m), -1);
		message_reader_finish(&r);
	}
}

static void test_lengths(void **state)
{
	(void)state;
	struct message_reader r;
	struct message m;
	/* too long a length is refused at the header, before anything is stored for it */
	static const unsigned char lengths[][4] = {
		{ 1, 0, 1, 0 },
		{ 0, 0, 0, 0x80 },
		{ 0xff, 0xff, 0xff, 0xff },
	};
	for (size_t i = 0; i < 3; i++) {
		message_reader_init(&r, FROM_WORKER);
		fill(&r, "\3\0\0\0", 4);
		fill(&r, lengths[i], 4);
		assert_int_equal(message_reader_next(&r, &m), -1);
		assert_non_null(strstr(r.reason, "at most 65536"));
		message_reader_finish(&r);
	}
	/* the longest there is */
	char *longest = malloc(MESSAGE_TEXT_MAX);
	int frame = (int)strlen("{\"job\":\"\"}");
	memset(longest, 'x', MESSAGE_TEXT_MAX);
	for (int more = 0; more < 2; more++) {
		struct text t = { 0 };
		json_t *o = json_object();
		json_object_set_new(
		        o, "job", json_stringn(longest, (size_t)(MESSAGE_TEXT_MAX - frame + more)));
		assert_int_equal(message_encode(&t, MESSAGE_START, o), more ? ST_INTERNAL : ST_OK);
		message_reader_init(&r, TO_WORKER);
		if (t.n)
			fill(&r, t.s, t.n);
		assert_int_equal(message_reader_next(&r, &m), !more);
		message_finish(&m);
		message_reader_finish(&r);
		json_decref(o);
		text_finish(&t);
	}
	free(longest);
}

static void test_partial(void **state)
{
	(void)state;
	struct message_reader r;
	struct message m;
	message_reader_init(&r, TO_WORKER);
	assert_false(message_reader_partial(&r));
	assert_int_equal(message_reader_next(&r, &m), 0);
	fill(&r, "\101\0\0", 3);
	assert_int_equal(message_reader_next(&r, &m), 0);
	assert_true(message_reader_partial(&r));
	fill(&r, "\0\0\0\0\0", 5);
	assert_int_equal(message_reader_next(&r, &m), 1);
	assert_int_equal(json_object_size(m.body), 0);
	message_finish(&m);
	assert_false(message_reader_partial(&r));
	message_reader_finish(&r);
}

/* Fields that the table does not have are let be: a newer peer may send them. */
static void test_unknown_field(void **state)
{
	(void)state;
	struct text t = { 0 };
	struct message_reader r;
	struct message m;
	json_t *o = json_pack("{s:i, s:s}", "unit", 3, "color", "red");
	message_encode(&t, MESSAGE_UNIT, o);
	message_reader_init(&r, FROM_WORKER);
	fill(&r, t.s, t.n);
	assert_int_equal(message_reader_next(&r, &m), 1);
	assert_true(json_equal(m.body, o));
	message_finish(&m);
	message_reader_finish(&r);
	json_decref(o);
	text_finish(&t);
}

enum { SENT = 3000 };

static void *send_many(void *data)
{
	int fd = *(int *)data;
	for (int i = 0; i < SENT; i++) {
		json_t *o = json_pack("{s:i}", "unit", i);
		if (message_send(fd, MESSAGE_UNIT, o) != ST_OK)
			abort();
		json_decref(o);
	}
	close(fd);
	return NULL;
}

/* A pipe that fills up, at a writer that does not wait: nothing is lost. */
static void test_send(void **state)
{
	(void)state;
	int ends[2];
	pthread_t writer;
	struct message_reader r;
	struct message m;
	assert_int_equal(pipe2(ends, O_CLOEXEC), 0);
	assert_int_equal(fcntl(ends[1], F_SETFL, O_NONBLOCK), 0);
	assert_int_equal(pthread_create(&writer, NULL, send_many, &ends[1]), 0);
	message_reader_init(&r, FROM_WORKER);
	for (int seen = 0; seen <= SENT;) {
		int got = message_reader_next(&r, &m);
		assert_true(got >= 0);
		if (got == 1) {
			assert_int_equal(json_integer_value(json_object_get(m.body, "unit")),
			                 seen++);
			message_finish(&m);
			continue;
		}
		size_t room;
		char *to = message_reader_room(&r, 512, &room);
		ssize_t n = read(ends[0], to, room);
		if (n == 0) {
			assert_int_equal(seen, SENT);
			break;
		}
		message_reader_filled(&r, (size_t)n);
	}
	assert_false(message_reader_partial(&r));
	pthread_join(writer, NULL);
	message_reader_finish(&r);
	close(ends[0]);
	assert_int_equal(message_send(-1, MESSAGE_CANCEL, NULL), ST_RESOURCE);
}

static void test_table(void **state)
{
	(void)state;
	for (size_t i = 0; i < message_table_size; i++) {
		const struct message_row *row = &message_table[i];
		assert_ptr_equal(message_row(row->number), row);
		assert_true(row->ways != 0 && (row->ways & ~(unsigned)ALL_WAYS) == 0);
		for (const char *p = row->fields; *p; p += strspn(p, " ")) {
			p += strcspn(p, ":") + 1;
			assert_non_null(memchr("sinoab", *p, 6));
			p += 1 + (p[1] == '?');
			assert_true(*p == ' ' || *p == 0);
		}
	}
	assert_null(message_row(0));
}

/* docs/packets.md has each row as "| number | NAME | way | fields |", and no other. */
static void test_document(void **state)
{
	(void)state;
	static const char *const ways[] = { "worker", "to worker", "client", "service" };
	char *text;
	size_t n, rows = 0;
	assert_int_equal(file_read(document, 1 << 20, &text, &n, NULL), ST_OK);
	for (size_t i = 0; i < message_table_size; i++) {
		const struct message_row *row = &message_table[i];
		struct text line = { 0 };
		text_addf(&line, "\n| %u | %s | ", row->number, row->name);
		for (int way = 0, first = 1; way < 4; way++) {
			if (row->ways & 1u << way) {
				text_addf(&line, "%s%s", first ? "" : ", ", ways[way]);
				first = 0;
			}
		}
		text_addf(&line, " | %s%s%s |", *row->fields ? "`" : "", row->fields,
		          *row->fields ? "`" : "");
		if (!strstr(text, line.s))
			fail_msg("docs/packets.md lacks:%s", line.s);
		text_finish(&line);
	}
	for (const char *p = text; (p = strstr(p, "\n| ")); p++)
		rows += p[3] >= '0' && p[3] <= '9';
	assert_int_equal(rows, message_table_size);
	free(text);
}

int main(int argc, char **argv)
{
	if (argc < 2)
		return 1;
	document = argv[1];
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_there_and_back),
		cmocka_unit_test(test_wire),
		cmocka_unit_test(test_bad),
		cmocka_unit_test(test_lengths),
		cmocka_unit_test(test_partial),
		cmocka_unit_test(test_unknown_field),
		cmocka_unit_test(test_send),
		cmocka_unit_test(test_table),
		cmocka_unit_test(test_document),
	};
	return cmocka_run_group_tests_name("message", tests, NULL, NULL);
}
