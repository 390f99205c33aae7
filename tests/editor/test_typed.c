/* test_typed.c - a line being typed, in UTF-8. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "typed.h"

static void keys(struct typed *t, const char *what)
{
	for (; *what; what++)
		switch (*what) {
		case '<':
			typed_left(t);
			break;
		case '>':
			typed_right(t);
			break;
		case '^':
			typed_home(t);
			break;
		case '$':
			typed_end(t);
			break;
		case '-':
			typed_backspace(t);
			break;
		case '~':
			typed_backspace_word(t);
			break;
		case '.':
			typed_delete(t);
			break;
		case '!':
			typed_clear(t);
			break;
		case 'o': /* two bytes, three, four */
			typed_insert(t, 0xF6);
			break;
		case 'e':
			typed_insert(t, 0x20AC);
			break;
		case 'm':
			typed_insert(t, 0x1F6A2);
			break;
		default:
			typed_insert(t, (unsigned char)*what);
			break;
		}
}

static void keys_do_what_they_say(void **state)
{
	static const struct {
		const char *keys, *text;
		int caret;
	} cases[] = {
		{ "", "", 0 },
		{ "abc", "abc", 3 },
		{ "ao", "a\u00F6", 3 },
		{ "aom", "a\u00F6\U0001F6A2", 7 },
		{ "aoe<<", "a\u00F6\u20AC", 1 },
		{ "aoe<-", "a\u20AC", 1 },
		{ "aoe^.", "\u00F6\u20AC", 0 },
		{ "aoe^>.", "a\u20AC", 1 },
		{ "m-", "", 0 },
		{ "-.<>", "", 0 },
		{ "ab^x$y", "xaby", 4 },
		{ "ab cd ~", "ab ", 3 },
		{ "abc!", "", 0 },
		{ "abc>>d", "abcd", 4 },
	};

	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct typed t = { 0 };
		keys(&t, cases[i].keys);
		assert_string_equal(t.s, cases[i].text);
		assert_int_equal(t.caret, cases[i].caret);
		assert_int_equal(t.n, (int)strlen(t.s));
	}
}

static void what_is_no_character_is_not_written(void **state)
{
	static const uint32_t bad[] = { 0, '\n', 27, 0x7F, 0x85, 0xD800, 0xDFFF, 0x110000, ~0u };
	struct typed t = { 0 };

	(void)state;
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
		assert_false(typed_insert(&t, bad[i]));
	assert_int_equal(t.n, 0);
	typed_insert_text(&t, "a\nb\tc");
	assert_string_equal(t.s, "abc");
}

static void a_full_line_keeps_whole_characters(void **state)
{
	struct typed t = { 0 };
	char many[2 * TYPED_BYTES + 1];

	(void)state;
	for (size_t i = 0; i + 1 < sizeof many; i += 2)
		memcpy(many + i, "\u00F6", 2);
	many[sizeof many - 1] = 0;
	typed_set(&t, many);
	assert_int_equal(t.n, TYPED_BYTES - 2);
	assert_false(typed_insert(&t, 0xF6));
	assert_true(typed_insert(&t, 'a'));
	assert_false(typed_insert(&t, 'a'));
	assert_int_equal(strlen(t.s), TYPED_BYTES - 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(keys_do_what_they_say),
		cmocka_unit_test(what_is_no_character_is_not_written),
		cmocka_unit_test(a_full_line_keeps_whole_characters),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
