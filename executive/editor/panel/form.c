/* form.c - what the entry asked for needs: fields, choices, switches, and its button. */
#include <math.h>
#include <string.h>

#include "paint.h"

enum { HEAD = 34, LABELS = 112, FIELD = 24, FOOT = 36, ERROR = 18, CHOICES_MAX = 12 };

struct form {
	const struct paint *p;
	const struct menu_model *m;
	double x, width, row;
};

static double field_height(const struct form *f, const struct form_field *field)
{
	return f->row + (field->error && field->error[0] ? ERROR : 0);
}

static bool is_yes(const char *value)
{
	return value && (!strcmp(value, "yes") || !strcmp(value, "true") || !strcmp(value, "1"));
}

static void paint_yesno(const struct form *f, const struct form_field *field, int i, double x,
                        double middle, double width)
{
	paint_toggle(f->p, x, middle, is_yes(field->value));
	const char *word = field->unit && field->unit[0] ? field->unit
	                   : is_yes(field->value)        ? "yes"
	                                                 : "no";
	double drawn =
	        paint_cut(f->p, LABEL_FORM, TOKEN_TEXT2, x + 38, middle, 0, width - 38, word);
	if (field->focused || paint_focused(f->p, HIT_CHOICE, i, 0))
		paint_ring(f->p, x - 2, middle - 10, 32, 20, 10);
	paint_hit(f->p, HIT_CHOICE, i, 0, x, middle - 12, 38 + drawn, FIELD);
}

static int split_choices(const char *choices, const char *at[CHOICES_MAX], size_t n[CHOICES_MAX])
{
	int found = 0;
	for (const char *c = choices ? choices : ""; *c && found < CHOICES_MAX; found++) {
		at[found] = c;
		n[found] = strcspn(c, "|");
		c += n[found] + (c[n[found]] == '|');
	}
	return found;
}

/* Words as wide as they must be, and the rest shared; false: they have no room beside each other. */
static bool paint_choice(const struct form *f, const struct form_field *field, int i, double x,
                         double middle, double width)
{
	enum { WORD = 64 };
	const struct paint *p = f->p;
	const char *at[CHOICES_MAX];
	size_t length[CHOICES_MAX];
	char word[CHOICES_MAX][WORD];
	double wide[CHOICES_MAX], all = 0;
	const int n = split_choices(field->choices, at, length);
	for (int j = 0; j < n; j++) {
		if (length[j] >= WORD)
			return false;
		memcpy(word[j], at[j], length[j]);
		word[j][length[j]] = 0;
		wide[j] = paint_width(p, LABEL_CAP, word[j]);
		all += wide[j];
	}
	const double spare = width - 4 - all;
	if (!n || spare < 8.0 * n)
		return false;
	paint_fill(p, x, middle - 12, width, FIELD, 5, TOKEN_FIELD);
	paint_border(p, x, middle - 12, width, FIELD, 5, field->focused ? 1.5 : 1,
	             field->focused ? TOKEN_ACCENT : TOKEN_LINE);
	/* equal parts where all words fit into them */
	bool equal = true;
	for (int j = 0; j < n; j++)
		equal &= wide[j] + 8 <= (width - 4) / n;
	double left = x + 2;
	for (int j = 0; j < n; j++) {
		const double part = equal ? (width - 4) / n : wide[j] + spare / n;
		const bool chosen = field->value && !strcmp(field->value, word[j]);
		if (chosen)
			paint_fill(p, left, middle - 10, part, 20, 4,
			           paint_is_dark(p) ? TOKEN_HOVER : TOKEN_TINT);
		paint_text(p, chosen ? LABEL_CAP : LABEL_NOTE,
		           chosen || paint_hot(p, HIT_CHOICE, i, j) ? TOKEN_TEXT : TOKEN_MUTED,
		           left + part / 2, middle, 0.5, word[j]);
		paint_hit(p, HIT_CHOICE, i, j, left, middle - 12, part, FIELD);
		left += part;
	}
	return true;
}

static void paint_field(const struct form *f, const struct form_field *field, int i, double x,
                        double middle, double width)
{
	const struct paint *p = f->p;
	const bool wrong = field->error && field->error[0];
	paint_fill(p, x, middle - 12, width, FIELD, 5, TOKEN_FIELD);
	paint_border(p, x, middle - 12, width, FIELD, 5, field->focused ? 1.5 : 1,
	             field->focused                  ? TOKEN_ACCENT
	             : paint_hot(p, HIT_FIELD, i, 0) ? TOKEN_EDGE
	                                             : TOKEN_LINE);
	if (wrong) {
		paint_round(p, x + 0.75, middle - 11.25, width - 1.5, FIELD - 1.5, 4);
		paint_set_rgb(p, glyph_color(p, JOB_FAILED));
		cairo_set_line_width(p->cr, paint_px(p, 1.5));
		cairo_stroke(p->cr);
	}
	double unit = 0;
	if (field->unit && field->unit[0])
		unit = paint_cut(p, LABEL_NOTE, TOKEN_MUTED, x + width - 8, middle, 1,
		                 width / 2 - 8, field->unit) +
		       8;
	const double room = width - 16 - unit;
	if (field->focused)
		paint_typed(p, LABEL_FORM, x + 8, middle, room, field->value, field->caret, true);
	else
		paint_path(p, LABEL_FORM, TOKEN_TEXT, x + 8, middle, room, field->value);
	if (field->empty && !(field->value && *field->value))
		paint_cut(p, LABEL_FORM, TOKEN_OFF, x + (field->focused ? 14 : 8), middle, 0, room,
		          field->empty);
	paint_hit(p, HIT_FIELD, i, 0, x, middle - 12, width, FIELD);
}

static void paint_asked(const struct form *f, int i, double y)
{
	const struct form_field *field = &f->m->fields[i];
	const double middle = y + 14, x = f->x + LABELS, width = f->width - LABELS;
	paint_cut(f->p, LABEL_FORM, TOKEN_TEXT2, f->x, middle, 0, LABELS - 8, field->label);
	if (field->kind == FORM_YESNO)
		paint_yesno(f, field, i, x, middle, width);
	else if (field->kind != FORM_CHOICE || !paint_choice(f, field, i, x, middle, width))
		paint_field(f, field, i, x, middle, width);
	if (field->error && field->error[0])
		label_fit(f->p->cr, LABEL_NOTE, glyph_color(f->p, JOB_FAILED), x + width,
		          label_baseline(LABEL_NOTE, y + f->row + ERROR / 2.0 - 3), 1, f->width,
		          LABEL_CUT_END, field->error);
}

/* Fields from `first` on that have room; gives how many. */
static int fields_shown(const struct form *f, int first, double room)
{
	int n = 0;
	for (int i = first; i < f->m->n_fields; i++, n++) {
		room -= field_height(f, &f->m->fields[i]);
		if (room < -4)
			break;
	}
	return n;
}

/* The first field to show: as scrolled, no further than needed, and so that the focus is seen. */
static int first_field(const struct form *f, double room)
{
	int first = f->m->scroll < 0 ? 0 : f->m->scroll;
	if (first >= f->m->n_fields)
		first = f->m->n_fields > 0 ? f->m->n_fields - 1 : 0;
	while (first > 0 && first - 1 + fields_shown(f, first - 1, room) >= f->m->n_fields)
		first--;
	for (int i = 0; i < f->m->n_fields; i++)
		if (f->m->fields[i].focused) {
			while (first < i && i >= first + fields_shown(f, first, room))
				first++;
			if (i < first)
				first = i;
		}
	return first;
}

static double paint_buttons(const struct form *f, double right, double y, bool both)
{
	const struct button main = { .text = f->m->main_button,
		                     .key = "Enter",
		                     .main = true,
		                     .kind = HIT_BUTTON,
		                     .part = GROUP_FORM };
	const struct button other = { .text = f->m->other_button,
		                      .key = f->m->other_key,
		                      .kind = HIT_BUTTON,
		                      .index = 1,
		                      .part = GROUP_FORM };
	if (main.text)
		right -= paint_button(f->p, right - paint_button_width(f->p, &main), y, &main) + 8;
	if (both && other.text && right - paint_button_width(f->p, &other) > f->x)
		right -= paint_button(f->p, right - paint_button_width(f->p, &other), y, &other);
	return right;
}

void paint_form(const struct paint *p, const struct layout *l, const struct menu_model *m)
{
	const struct box_px *b = &l->form;
	struct form f = { p, m, b->x + PAINT_PADDING, b->width - 2 * PAINT_PADDING, l->form_row };
	const double below = b->y + b->height, right = f.x + f.width;
	double fields = 0;
	if (b->height < HEAD)
		return;
	for (int i = 0; i < m->n_fields; i++)
		fields += field_height(&f, &m->fields[i]);
	/* short of room, the button goes up beside the title */
	const bool low =
	        HEAD + fields + FOOT + 8 > b->height && HEAD + 3 * f.row + FOOT > b->height;
	const double room = below - b->y - HEAD - (low || !m->main_button ? 0 : FOOT + 4);
	double title = right;
	paint_rule(p, f.x, b->y, f.width);
	if (low)
		title = paint_buttons(&f, right, b->y + 4, false);
	else if (m->form_code)
		title -= paint_text(p, LABEL_NOTE, TOKEN_MUTED, right, b->y + 20, 1, m->form_code) +
		         8;
	paint_cut(p, LABEL_SECTION, TOKEN_TEXT, f.x, b->y + 20, 0, title - f.x, m->form_title);

	const int first = first_field(&f, room), n = fields_shown(&f, first, room);
	double y = b->y + HEAD;
	for (int i = first; i < first + n; i++) {
		paint_asked(&f, i, y);
		y += field_height(&f, &m->fields[i]);
	}
	paint_scroll(p, b->x + b->width - 5, b->y + HEAD, room, first, n, m->n_fields, GROUP_FORM);
	if (!low)
		paint_buttons(&f, right, fmin(y + 6, below - FOOT), true);
}
