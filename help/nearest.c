/* nearest.c - the routines whose names are most like what was typed, for when nothing is found. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "texts.h"

enum { TYPED_MAX = 64 };

static int least(int a, int b, int c)
{
	const int m = a < b ? a : b;

	return m < c ? m : c;
}

/* How many letters must change, come or go until `typed` (of n letters) is a part of `name`: Sellers,
 * The theory and computation of evolutionary distances, 1980. */
static int changes(const char *typed, size_t n, const char *name)
{
	int row[TYPED_MAX + 1], best;

	for (size_t i = 0; i <= n; i++)
		row[i] = (int)i;
	best = row[n];
	for (; *name; name++) {
		int above = 0; /* the part may begin anywhere */
		for (size_t i = 1; i <= n; i++) {
			const int other = toupper((unsigned char)typed[i - 1]) !=
			                  toupper((unsigned char)*name);
			const int here = least(above + other, row[i] + 1, row[i - 1] + 1);
			above = row[i];
			row[i] = here;
		}
		best = row[n] < best ? row[n] : best;
	}
	return best;
}

static int by_changes(const void *a, const void *b)
{
	const struct help_hit *x = a, *y = b;

	if (x->score != y->score)
		return y->score > x->score ? 1 : -1;
	return help_text_order(x->text, y->text);
}

size_t help_nearest(const struct help *h, const struct menu_set *menus, const char *typed,
                    struct help_hit *hits, size_t max)
{
	size_t n = 0, length;

	typed += strspn(typed, " \t");
	length = strnlen(typed, TYPED_MAX);
	while (length && isspace((unsigned char)typed[length - 1]))
		length--;
	struct help_hit *all = length ? calloc(h->source.n, sizeof *all) : NULL;
	for (size_t k = 0; all && k < h->source.n; k++) {
		const struct help_text *t = &h->source.texts[k];
		const struct Menu_Entry *e = menus ? menu_set_find(menus, t->code, NULL) : NULL;
		if (*t->code != 'V')
			continue;
		int off = changes(typed, length, t->title);
		if (e) {
			const int there = changes(typed, length, e->name);
			off = there < off ? there : off;
		}
		all[n++] = (struct help_hit){ t, -off };
	}
	if (n)
		qsort(all, n, sizeof *all, by_changes);
	n = n < max ? n : max;
	if (n)
		memcpy(hits, all, n * sizeof *all);
	free(all);
	return n;
}
