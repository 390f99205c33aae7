/* search.c - the texts in which all words occur, best first. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "texts.h"

enum { WORDS_MAX = 16, WORD_MAX = 48 };

/* What a word found there is worth. A name is what a user reads in the menu, so it counts most. */
enum {
	SCORE_CODE = 10000,
	SCORE_WHOLE_TITLE = 600, /* the title is the word, and nothing else */
	SCORE_WHOLE_NAME = 300,  /* many entries are called COLOR or RUN: not enough by itself */
	SCORE_NAME = 240,
	SCORE_TITLE = 200,
	SCORE_WHOLE_PATH = 120, /* a menu above is called so */
	SCORE_PATH = 60,
	SCORE_ARGUMENT = 40,
	SCORE_PURPOSE = 20,
	SCORE_REST = 5,
};

/* The word at the beginning of a word of s counts whole, inside of one half; several places do not
 * count more. Letters beyond ASCII are compared as they are. */
static int found(const char *s, const char *word, int score)
{
	size_t n = strlen(word);
	int best = 0;

	for (const char *p = s; (p = strcasestr(p, word)); p += n) {
		bool begins = p == s || !(isalnum((unsigned char)p[-1]) || p[-1] & 0x80);

		if (begins)
			return score;
		best = score / 2;
	}
	return best;
}

static int found_name(const char *s, const char *word, int whole, int score)
{
	return strcasecmp(s, word) ? found(s, word, score) : whole;
}

static int score_names(const struct help_text *t, const struct menu_set *menus, const char *word)
{
	const struct Menu_Entry *e = menus ? menu_set_find(menus, t->code, NULL) : NULL;
	int sum = strcasecmp(t->code, word) ? 0 : SCORE_CODE, best = 0;

	sum += found_name(t->title, word, SCORE_WHOLE_TITLE, SCORE_TITLE);
	if (!e)
		return sum;
	sum += found_name(e->name, word, SCORE_WHOLE_NAME, SCORE_NAME);
	for (e = e->parent; e; e = e->parent) {
		int here = found_name(e->name, word, SCORE_WHOLE_PATH, SCORE_PATH);
		best = here > best ? here : best;
	}
	return sum + best;
}

static int score_word(const struct help_text *t, const struct menu_set *menus, const char *word)
{
	int sum = score_names(t, menus, word) + found(t->purpose, word, SCORE_PURPOSE) +
	          found(t->result, word, SCORE_REST) + found(t->example, word, SCORE_REST);
	int best = 0;

	for (int k = 0; k < t->n_arguments; k++) {
		int name = found(t->arguments[k].name, word, SCORE_ARGUMENT);
		int here = name ? name : found(t->arguments[k].meaning, word, SCORE_REST);
		best = here > best ? here : best;
	}
	return sum + best;
}

static int split(const char *words, char out[WORDS_MAX][WORD_MAX])
{
	int n = 0;

	while (*(words += strspn(words, " \t")) && n < WORDS_MAX) {
		size_t length = strcspn(words, " \t");

		snprintf(out[n++], WORD_MAX, "%.*s", (int)(length < WORD_MAX ? length : WORD_MAX),
		         words);
		words += length;
	}
	return n;
}

static int by_score(const void *a, const void *b)
{
	const struct help_hit *x = a, *y = b;

	if (x->score != y->score)
		return y->score > x->score ? 1 : -1;
	/* routines before menus, then by number */
	if (x->text->code[0] != y->text->code[0])
		return x->text->code[0] == 'V' ? -1 : 1;
	return help_text_order(x->text, y->text);
}

size_t help_search(const struct help *h, const struct menu_set *menus, const char *words,
                   struct help_hit *hits, size_t max)
{
	char word[WORDS_MAX][WORD_MAX];
	int n_words = split(words, word);
	struct help_hit *all = n_words ? calloc(h->source.n, sizeof *all) : NULL;
	size_t n = 0;

	for (size_t k = 0; all && k < h->source.n; k++) {
		const struct help_text *t = &h->source.texts[k];
		int sum = 0, score = 1;

		for (int i = 0; i < n_words && score; i++) {
			score = score_word(t, menus, word[i]);
			sum += score;
		}
		if (score)
			all[n++] = (struct help_hit){ t, sum };
	}
	if (n && max) {
		qsort(all, n, sizeof *all, by_score);
		memcpy(hits, all, (n < max ? n : max) * sizeof *all);
	}
	free(all);
	return n;
}
