/* svg.c - laid out lines as an SVG file: paths relative, in hundredths of a pixel. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "scene_lines.h"
#include "text.h"

static unsigned byte(double x)
{
	return (unsigned)lrint(255 * fmin(fmax(x, 0), 1));
}

static void add_color(struct text *t, const char *name, struct rgb c)
{
	text_addf(t, " %s=\"#%02x%02x%02x\"", name, byte(c.r), byte(c.g), byte(c.b));
}

/* n hundredths, without zeros at the end, with a blank before where one is needed. */
static void add_hundredths(struct text *t, long n, bool first)
{
	char digits[32];
	int k = snprintf(digits, sizeof digits, "%s%ld.%02ld", n < 0 ? "-" : "", labs(n) / 100,
	                 labs(n) % 100);
	while (digits[k - 1] == '0')
		k--;
	if (digits[k - 1] == '.')
		k--;
	if (!first && n >= 0)
		text_add(t, " ");
	text_add_bytes(t, digits, k);
}

/* Beyond this a place is far outside of any image, and its hundredths still fit. */
static long hundredths(double px)
{
	return lrint(100 * fmin(fmax(px, -1e7), 1e7));
}

/* Is the piece a straight line within a hundredth? */
static bool straight(long p[4][2])
{
	double dx = (double)(p[3][0] - p[0][0]), dy = (double)(p[3][1] - p[0][1]);
	double length = hypot(dx, dy);
	for (int i = 1; i < 3; i++) {
		double x = (double)(p[i][0] - p[0][0]), y = (double)(p[i][1] - p[0][1]);
		double along = x * dx + y * dy;
		if (fabs(x * dy - y * dx) > length || along < 0 || along > length * length)
			return false;
	}
	return true;
}

/* Relative to the rounded place before, so that errors do not add up. */
static void add_path(struct text *t, const struct stroke *s)
{
	for (size_t i = 0; i < s->n; i++) {
		const struct stroke_piece *q = &s->pieces[i];
		long p[4][2];
		for (int k = 0; k < 4; k++)
			for (int d = 0; d < 2; d++)
				p[k][d] = hundredths(q->p[k][d]);
		if (q->begins) {
			text_add(t, "M");
			add_hundredths(t, p[0][0], true);
			add_hundredths(t, p[0][1], false);
		}
		bool line = straight(p);
		text_add(t, line ? "l" : "c");
		for (int k = line ? 3 : 1; k < 4; k++) {
			add_hundredths(t, p[k][0] - p[0][0], k == (line ? 3 : 1));
			add_hundredths(t, p[k][1] - p[0][1], false);
		}
	}
}

static void add_escaped(struct text *t, const char *s)
{
	for (; *s; s++)
		switch (*s) {
		case '&':
			text_add(t, "&amp;");
			break;
		case '<':
			text_add(t, "&lt;");
			break;
		case '>':
			text_add(t, "&gt;");
			break;
		default:
			/* control characters are not allowed in XML */
			text_add_bytes(t, (unsigned char)*s < 32 ? " " : s, 1);
		}
}

static void add_number(struct text *t, const char *name, double px)
{
	text_addf(t, " %s=\"", name);
	add_hundredths(t, hundredths(px), true);
	text_add(t, "\"");
}

static void add_line(struct text *t, const struct scene_line *l)
{
	if (!l->stroke.n)
		return;
	text_addf(t, "<path class=\"%s\"", l->what);
	add_color(t, "stroke", l->style.color);
	add_number(t, "stroke-width", l->style.width);
	if (l->style.opacity < 1)
		add_number(t, "stroke-opacity", l->style.opacity);
	text_add(t, " d=\"");
	add_path(t, &l->stroke);
	text_add(t, "\"/>\n");
}

static void add_text(struct text *t, const struct scene_text *x, struct rgb ground)
{
	if (x->plate) {
		double box[4];
		scene_plate(x, box);
		text_add(t, "<rect rx=\"4\" fill-opacity=\"0.85\"");
		add_number(t, "x", box[0]);
		add_number(t, "y", box[1]);
		add_number(t, "width", box[2]);
		add_number(t, "height", box[3]);
		add_color(t, "fill", ground);
		text_add(t, "/>\n");
	}
	text_add(t, "<text");
	/* centred, so that a text in another font stays on its plate */
	add_number(t, "x", x->plate ? x->x + x->width / 2 : x->x);
	add_number(t, "y", x->y);
	add_number(t, "font-size", label_size(x->style));
	text_addf(t, " font-weight=\"%d\"", label_weight(x->style));
	add_color(t, "fill", x->color);
	text_add(t, x->plate ? " text-anchor=\"middle\">" : ">");
	add_escaped(t, x->text);
	text_add(t, "</text>\n");
}

static void add_scene(struct text *t, const struct scene_lines *s)
{
	text_addf(t, "<rect width=\"%d\" height=\"%d\"", s->width, s->height);
	add_color(t, "fill", s->ground);
	text_add(t, "/>\n<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
	for (size_t i = 0; i < s->n_lines; i++)
		add_line(t, &s->lines[i]);
	text_addf(t, "</g>\n<g font-family=\"%s\">\n", label_families);
	for (size_t i = 0; i < s->n_texts; i++)
		add_text(t, &s->texts[i], s->ground);
	text_add(t, "</g>\n");
}

/* A scene of several is an image within the image, which cuts it at its edges. */
static void format(struct text *t, const struct scene_sheet *s)
{
	text_addf(t,
	          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
	          "viewBox=\"0 0 %d %d\">\n",
	          s->width, s->height, s->width, s->height);
	if (s->n == 1) {
		add_scene(t, s->scenes);
	} else {
		text_addf(t, "<rect width=\"%d\" height=\"%d\"", s->width, s->height);
		add_color(t, "fill", s->rule);
		text_add(t, "/>\n");
		for (int i = 0; i < s->n; i++) {
			const struct scene_lines *x = &s->scenes[i];
			text_addf(t, "<svg x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\">\n", x->x,
			          x->y, x->width, x->height);
			add_scene(t, x);
			text_add(t, "</svg>\n");
		}
	}
	text_add(t, "</svg>\n");
}

enum status svg_write(const struct scene_sheet *s, const char *path, const struct report *r)
{
	struct text t = { .s = NULL };
	format(&t, s);
	if (t.failed) {
		text_finish(&t);
		return report_error(r, ST_RESOURCE, "cannot draw '%s': no memory", path);
	}
	FILE *f = fopen(path, "wb");
	if (!f) {
		text_finish(&t);
		return report_error(r, status_from_errno(errno), "cannot write '%s': %s", path,
		                    strerror(errno));
	}
	bool written = fwrite(t.s, 1, t.n, f) == t.n;
	int error = errno;
	text_finish(&t);
	if (fclose(f) && written) {
		written = false;
		error = errno;
	}
	if (written)
		return ST_OK;
	unlink(path);
	return report_error(r, ST_RESOURCE, "cannot write '%s': %s; make room and try again", path,
	                    strerror(error));
}
