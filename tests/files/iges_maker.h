/* iges_maker.h - IGES files made from a table of entities, well or badly on purpose. */
#ifndef BATTEN_TEST_IGES_MAKER_H
#define BATTEN_TEST_IGES_MAKER_H

#include <stdio.h>
#include <string.h>

#include "text.h"

/* Parameters begin with the type; commas and semicolons stand for the delimiters. */
struct made_entity {
	int type, form;
	const char *parameters;
	int transform, color;
	const char *status, *label;
	int subscript;
};

struct made_file {
	const char *global;   /* NULL: millimetres, the usual delimiters */
	const char *line_end; /* NULL: "\n" */
	int columns;          /* parameters a line, 0: 64 */
	char letter;          /* of the first line, 0: 'S' */
	int sequence;         /* what sequence numbers begin with, 0: 1 */
	bool no_terminate, no_back_pointers, bad_data_pointers;
};

static inline void made_line(struct text *t, const struct made_file *f, const char *columns, int n,
                             char letter, int number)
{
	text_addf(t, "%-72.*s%c%7d%s", n, columns, letter, number,
	          f->line_end ? f->line_end : "\n");
}

/* A string may only run over the end of a line that is full. */
static inline int made_columns(const struct made_file *f, const struct made_entity *e)
{
	return f->columns && e->type != 406 ? f->columns : 64;
}

/* Lines that the parameters of one entity take. */
static inline int made_lines(const struct made_file *f, const struct made_entity *e)
{
	int columns = made_columns(f, e);
	return ((int)strlen(e->parameters) + columns - 1) / columns;
}

static inline void make_iges(struct text *t, const struct made_file *f,
                             const struct made_entity *entities, int n)
{
	static const char usual[] =
	        "1H,,1H;,,6Hx.iges,4Htest,4Htest,32,38,6,308,15,,1.0,2,2HMM,1,0.01,,1.0E-6,100.;";
	const char *global = f->global ? f->global : usual;
	int first = f->sequence ? f->sequence : 1, lines = 0;
	int n_g = 0, n_p = 0;
	made_line(t, f, "made for a test", 15, f->letter ? f->letter : 'S', first);
	for (const char *s = global; *s; s += strnlen(s, 72))
		made_line(t, f, s, (int)strnlen(s, 72), 'G', first + n_g++);
	for (int i = 0; i < n; i++) {
		const struct made_entity *e = &entities[i];
		char line[128];
		snprintf(line, sizeof line, "%8d%8d%8d%8d%8d%8d%8d%8d%8s", e->type,
		         f->bad_data_pointers ? 1 : lines + 1, 0, 0, 0, 0, e->transform, 0,
		         e->status ? e->status : "00000000");
		made_line(t, f, line, 72, 'D', first + 2 * i);
		snprintf(line, sizeof line, "%8d%8d%8d%8d%8d%8s%8s%8s%8d", e->type, 0, e->color,
		         made_lines(f, e), e->form, "", "", e->label ? e->label : "", e->subscript);
		made_line(t, f, line, 72, 'D', first + 2 * i + 1);
		lines += made_lines(f, e);
	}
	for (int i = 0; i < n; i++) {
		int columns = made_columns(f, &entities[i]);
		for (const char *s = entities[i].parameters; *s; s += strnlen(s, (size_t)columns)) {
			char line[128];
			int len = (int)strnlen(s, (size_t)columns);
			if (f->no_back_pointers)
				snprintf(line, sizeof line, "%-64.*s%8s", len, s, "");
			else
				snprintf(line, sizeof line, "%-64.*s%8d", len, s, 2 * i + 1);
			made_line(t, f, line, 72, 'P', first + n_p++);
		}
	}
	if (!f->no_terminate) {
		char line[128];
		snprintf(line, sizeof line, "S%7dG%7dD%7dP%7d", 1, n_g, 2 * n, n_p);
		made_line(t, f, line, 72, 'T', 1);
	}
}

#endif
