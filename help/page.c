/* page.c - a help text for the window: sections by their words, cells of the arguments by tabs. */
#include <string.h>

#include "help.h"
#include "text.h"

static void add_section(struct text *out, const char *word, const char *body)
{
	if (*body)
		text_addf(out, "\n%s\n%s\n", word, body);
}

static void add_links(struct text *out, const struct help *h, const char *see)
{
	if (*see)
		text_add(out, "\nSee also\n");
	while (*(see += strspn(see, " "))) {
		size_t n = strcspn(see, " ");
		char code[8] = "";

		memcpy(code, see, n < sizeof code ? n : sizeof code - 1);
		const struct help_text *t = help_find(h, code);
		text_addf(out, "%s %s\n", code, t ? t->title : "");
		see += n;
	}
}

char *help_page(const struct help *h, const struct help_text *t)
{
	struct text out = { 0 };

	text_addf(&out, "%s\n", t->purpose);
	if (t->n_arguments)
		text_add(&out, "\nArguments\n");
	for (int k = 0; k < t->n_arguments; k++)
		text_addf(&out, "%s\t%s\t%s\n", t->arguments[k].name, t->arguments[k].range,
		          t->arguments[k].meaning);
	add_section(&out, "Result", t->result);
	add_section(&out, "Example", t->example);
	add_links(&out, h, t->see);
	return text_take(&out);
}
