/* help.c - the page of help: over the menu and the view's edge, above the mouse. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "help_text.h"
#include "paint.h"

enum { EDGE = 24, HEAD = 78, TABLE_NAME = 88, TABLE_MEANING = 222, LINE = 21, EXAMPLE = 19 };

static struct box_px page_box(const struct layout *l)
{
	const double window = l->view.width + l->menu.width;
	const double wide = window >= 2560 ? 560 : window >= 1920 ? 520 : 472;
	const double width = fmin(wide, window);
	return (struct box_px){ window - width, l->view.y, width, fmax(l->mouse.y - l->view.y, 0) };
}

/* A pass over the text, that measures or paints. */
struct flow {
	const struct paint *p;
	bool paint;
	double x, y, width;
	double link; /* where the next one begins */
	int links;
	enum help_block before;
	double example;    /* top of the example's ground, 0: none is open */
	double top, below; /* seen of the page */
};

static const char *string(const struct text *t)
{
	return t->s ? t->s : "";
}

static double wrap(const struct flow *f, enum label_style style, enum token token, double x,
                   double y, double width, const char *text)
{
	if (!f->paint)
		return label_wrap_height(f->p->cr, style, width, 0, text);
	return label_wrap(f->p->cr, style, paint_color(f->p, token), x, y, width, 0, text);
}

static void flow_row(struct flow *f, const struct help_reader *r)
{
	const bool three = r->meaning.n > 0;
	const double value = f->x + TABLE_NAME;
	const double meaning = f->x + TABLE_MEANING;
	double tall =
	        wrap(f, LABEL_NAME, TOKEN_TEXT, f->x, f->y - 3, TABLE_NAME - 8, string(&r->text));
	if (r->value.n)
		tall = fmax(tall, wrap(f, LABEL_FORM, TOKEN_TEXT2, value, f->y - 3,
		                       (three ? meaning - 12 : f->x + f->width) - value,
		                       string(&r->value)));
	if (three)
		tall = fmax(tall, wrap(f, LABEL_FORM, TOKEN_MUTED, meaning, f->y - 3,
		                       f->x + f->width - meaning, string(&r->meaning)));
	f->y += tall > LINE ? tall + 6 : LINE;
}

static void flow_link(struct flow *f, const struct help_reader *r)
{
	const struct paint *p = f->p;
	const char *code = string(&r->text), *name = string(&r->value);
	const double code_width = paint_width(p, LABEL_FORM, code);
	const double width = fmin(
	        code_width + (r->value.n ? 6 + paint_width(p, LABEL_NAME, name) : 0), f->width);
	if (f->before != HELP_LINK)
		f->link = f->x;
	if (f->link > f->x && f->link + width > f->x + f->width) {
		f->link = f->x;
		f->y += LINE + 2;
	}
	if (f->paint) {
		const double middle = f->y + 6;
		const bool hot = paint_hot(p, HIT_HELP_LINK, f->links, 0);
		const double end = f->link + width;
		paint_text(p, LABEL_FORM, r->value.n ? TOKEN_MUTED : TOKEN_ACCENT, f->link, middle,
		           0, code);
		if (r->value.n)
			paint_cut(p, LABEL_NAME, TOKEN_ACCENT, f->link + code_width + 6, middle, 0,
			          end - f->link - code_width - 6, name);
		if (hot)
			paint_line(p, f->link, middle + 8, end, middle + 8, 1, TOKEN_ACCENT);
		if (paint_focused(p, HIT_HELP_LINK, f->links, 0))
			paint_ring(p, f->link - 4, middle - 11, width + 8, 22, 4);
		if (middle - 10 >= f->top && middle + 10 <= f->below)
			paint_hit(p, HIT_HELP_LINK, f->links, 0, f->link - 2, middle - 10,
			          width + 4, 20);
	}
	f->links++;
	f->link += width + 20;
}

/* Lines of an example share one ground; each is painted, or only measured. */
static double example_lines(const struct flow *f, const char *text, bool paint)
{
	enum { LONGEST = 1024, INSET = 12 };
	const struct paint *p = f->p;
	const double width = f->width - 2 * INSET;
	double y = f->y + 9;
	for (const char *at = text; *at;) {
		char line[LONGEST];
		const size_t n = strcspn(at, "\n"), kept = n < LONGEST ? n : LONGEST - 1;
		memcpy(line, at, kept);
		line[kept] = 0;
		if (paint)
			label_wrap(p->cr, LABEL_MONO, paint_color(p, TOKEN_TEXT), f->x + INSET, y,
			           width, 0, line);
		y += fmax(label_wrap_height(p->cr, LABEL_MONO, width, 0, line), EXAMPLE);
		at += n + (at[n] == '\n');
	}
	return y + 8 - f->y;
}

static void flow_example(struct flow *f, const struct help_reader *r)
{
	const double tall = example_lines(f, string(&r->text), false);
	if (f->paint) {
		paint_fill(f->p, f->x, f->y, f->width, tall, 6, TOKEN_FIELD);
		paint_border(f->p, f->x, f->y, f->width, tall, 6, 1, TOKEN_LINE);
		example_lines(f, string(&r->text), true);
	}
	f->y += tall + 8;
}

static void flow_block(struct flow *f, enum help_block block, const struct help_reader *r)
{
	/* what has just ended keeps its distance */
	if (f->before == HELP_LINK && block != HELP_LINK)
		f->y += LINE + 6;
	switch (block) {
	case HELP_HEAD:
		f->y += f->before == HELP_END ? 0 : 6;
		if (f->paint)
			paint_cut(f->p, LABEL_SECTION, TOKEN_TEXT, f->x, f->y + 6, 0, f->width,
			          string(&r->text));
		f->y += LINE;
		break;
	case HELP_PARAGRAPH:
		f->y += wrap(f, LABEL_ENTRY, TOKEN_TEXT, f->x, f->y, f->width, string(&r->text)) +
		        10;
		break;
	case HELP_ROW:
		flow_row(f, r);
		break;
	case HELP_EXAMPLE:
		flow_example(f, r);
		break;
	case HELP_LINK:
		flow_link(f, r);
		break;
	case HELP_END:
		break;
	}
	f->before = block;
}

/* Gives the text's height. */
static double flow(struct flow *f, const char *text)
{
	const double top = f->y;
	struct help_reader r;
	enum help_block block;
	help_reader_init(&r, text);
	while ((block = help_reader_next(&r)) != HELP_END)
		flow_block(f, block, &r);
	flow_block(f, HELP_END, &r);
	help_reader_finish(&r);
	return f->y - top;
}

double panel_help_scroll(cairo_t *cr, const struct layout *l, const struct help_model *m)
{
	const struct look look = { .scale = 1 };
	const struct paint p = { cr, &look, NULL };
	const struct box_px b = page_box(l);
	struct flow f = { .p = &p, .width = b.width - 2 * EDGE };
	return fmax(flow(&f, m->text) + HEAD + EDGE - b.height, 0);
}

bool panel_help_link(const char *text, int index, char *code, size_t size)
{
	struct help_reader r;
	enum help_block block;
	bool found = false;
	help_reader_init(&r, text);
	while (!found && (block = help_reader_next(&r)) != HELP_END)
		if (block == HELP_LINK && index-- == 0)
			found = r.text.n < size;
	if (found)
		memcpy(code, r.text.s, r.text.n + 1);
	help_reader_finish(&r);
	return found;
}

static void paint_shadow(const struct paint *p, const struct box_px *b)
{
	enum { STEPS = 12 };
	const double strength = paint_is_dark(p) ? 0.16 : 0.05;
	for (int i = 0; i < STEPS; i++) {
		cairo_set_source_rgba(p->cr, 0, 0, 0, strength * (1 - (double)i / STEPS));
		cairo_rectangle(p->cr, b->x - 2 * (i + 1), b->y, 2, b->height);
		cairo_fill(p->cr);
	}
}

static void paint_head(const struct paint *p, const struct box_px *b, const struct help_model *m)
{
	const double x = b->x + EDGE, right = b->x + b->width - EDGE;
	double end = right - paint_cap(p, right, b->y + 24, 1, "Esc") - 12;
	paint_hit(p, HIT_HELP_LINK, -2, 0, right - 40, b->y + 12, 44, 24);
	if (paint_hot(p, HIT_HELP_LINK, -2, 0) || paint_focused(p, HIT_HELP_LINK, -2, 0))
		paint_ring(p, end + 10, b->y + 13, right - end - 8, 22, 5);
	const struct look still = { .theme = p->look->theme, .scale = p->look->scale };
	const struct paint unclickable = { p->cr, &still, NULL };
	paint_crumbs(&unclickable, x, b->y + 24, end - x, m->path);
	end = right - paint_text(p, LABEL_FORM, TOKEN_MUTED, right, b->y + 53, 1, m->code) - 12;
	if (m->kind && m->kind[0])
		end -= paint_text(p, LABEL_NOTE, TOKEN_MUTED, end, b->y + 53, 1, m->kind) + 12;
	paint_cut(p, LABEL_PAGE, TOKEN_TEXT, x, b->y + 52, 0, end - x, m->title);
}

void panel_help(cairo_t *cr, const struct layout *l, const struct help_model *m,
                const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const struct box_px b = page_box(l);
	if (b.width < 200 || b.height < HEAD + LINE)
		return;
	struct flow measure = { .p = &p, .width = b.width - 2 * EDGE };
	const double all = flow(&measure, m->text), room = b.height - HEAD - EDGE;
	const double most = fmax(all - room, 0);
	const double scroll = m->scroll > 0 ? fmin(m->scroll, most) : 0;
	paint_shadow(&p, &b);
	paint_fill(&p, b.x, b.y, b.width, b.height, 0, TOKEN_RAISED);
	paint_border(&p, b.x, b.y, b.width, b.height, 0, 1, TOKEN_LINE);
	paint_hit(&p, HIT_NONE, 0, 0, b.x, b.y, b.width, b.height);
	paint_head(&p, &b, m);

	struct flow f = { .p = &p,
		          .paint = true,
		          .x = b.x + EDGE,
		          .y = b.y + HEAD - scroll,
		          .width = b.width - 2 * EDGE,
		          .top = b.y + HEAD - 8,
		          .below = b.y + b.height - 2 };
	cairo_save(cr);
	cairo_rectangle(cr, b.x + 1, f.top, b.width - 2, f.below - f.top);
	cairo_clip(cr);
	flow(&f, m->text);
	cairo_restore(cr);
	if (scroll > 0)
		paint_rule(&p, b.x + 1, f.top, b.width - 2);
	paint_scroll(&p, b.x + b.width - 6, f.top, f.below - f.top - 4, (int)scroll, (int)room,
	             (int)ceil(all), GROUP_HELP);
}
