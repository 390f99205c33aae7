/* plates.c - texts and pictures as textures. */
#include <stdlib.h>
#include <string.h>

#include "view_private.h"

void plate_finish(struct plate *p)
{
	if (p->texture)
		glDeleteTextures(1, &p->texture);
	*p = (struct plate){ 0 };
}

/* Cairo's ARGB32 is BGRA in memory, colors multiplied by alpha. */
void plate_load(struct plate *p, cairo_surface_t *surface)
{
	cairo_surface_flush(surface);
	p->width = cairo_image_surface_get_width(surface);
	p->height = cairo_image_surface_get_height(surface);
	if (!p->texture)
		glGenTextures(1, &p->texture);
	glBindTexture(GL_TEXTURE_2D, p->texture);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, cairo_image_surface_get_stride(surface) / 4);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, p->width, p->height, 0, GL_BGRA,
	             GL_UNSIGNED_INT_8_8_8_8_REV, cairo_image_surface_get_data(surface));
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void plate_draw(const struct drawing *d, const struct plate *p, double x, double y, double width,
                double height)
{
	const GLint *u = program_use(d->frame.programs, PROGRAM_PLATE);
	const GLboolean tested = glIsEnabled(GL_DEPTH_TEST);
	glUniform4f(u[UNIFORM_PLACE], (float)x, (float)y, (float)width, (float)height);
	glUniform2f(u[UNIFORM_VIEWPORT], (float)d->frame.width, (float)d->frame.height);
	glUniform1i(u[UNIFORM_PICTURE], 0);
	glActiveTexture(GL_TEXTURE0);
	glBindTexture(GL_TEXTURE_2D, p->texture);
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
	glBindVertexArray(d->view->empty);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
	glBindVertexArray(0);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	if (tested)
		glEnable(GL_DEPTH_TEST);
}

enum { PLATE_PAD = 6, PLATE_HIGH = 18, PLATE_RADIUS = 4 };

static void paint_text(cairo_t *cr, const struct drawing *d, const char *text,
                       enum label_style style, bool on_ground, double width)
{
	if (on_ground) {
		const double r = PLATE_RADIUS, w = width, h = PLATE_HIGH;
		cairo_arc(cr, w - r, r, r, -M_PI / 2, 0);
		cairo_arc(cr, w - r, h - r, r, 0, M_PI / 2);
		cairo_arc(cr, r, h - r, r, M_PI / 2, M_PI);
		cairo_arc(cr, r, r, r, M_PI, 1.5 * M_PI);
		cairo_close_path(cr);
		cairo_set_source_rgba(cr, d->ground.r, d->ground.g, d->ground.b, 0.85);
		cairo_fill(cr);
	}
	label_draw(cr, style, drawing_color(d, TOKEN_TEXT), width / 2,
	           label_baseline(style, PLATE_HIGH / 2.0), 0.5, text);
}

/* All that the pixels of a text depend on beside its letters. */
static unsigned style_of(const struct drawing *d, enum label_style style, bool on_ground)
{
	const unsigned ground = (unsigned)lrint(255 * d->ground.r) << 16 |
	                        (unsigned)lrint(255 * d->ground.g) << 8 |
	                        (unsigned)lrint(255 * d->ground.b);
	return (unsigned)lrint(64 * d->frame.scale) * 2654435761U ^
	       (ground * 16 + (unsigned)style) * 2 * 31 ^ (unsigned)on_ground ^
	       (unsigned)d->set << 1;
}

static struct plate make_text(const struct drawing *d, const char *text, enum label_style style,
                              bool on_ground)
{
	const double scale = d->frame.scale;
	struct plate plate = { 0 };
	cairo_surface_t *probe = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
	cairo_t *cr = cairo_create(probe);
	const double width = ceil(label_width(cr, style, text)) + (on_ground ? 2 * PLATE_PAD : 2);
	cairo_destroy(cr);
	cairo_surface_destroy(probe);
	cairo_surface_t *surface = cairo_image_surface_create(
	        CAIRO_FORMAT_ARGB32, (int)ceil(width * scale), (int)ceil(PLATE_HIGH * scale));
	cr = cairo_create(surface);
	cairo_scale(cr, scale, scale);
	paint_text(cr, d, text, style, on_ground, width);
	if (cairo_status(cr) == CAIRO_STATUS_SUCCESS)
		plate_load(&plate, surface);
	cairo_destroy(cr);
	cairo_surface_destroy(surface);
	return plate;
}

/* NULL where memory ran out: a label is missing then. */
static struct text_plate *find_text(struct drawing *d, const char *text, enum label_style style,
                                    bool on_ground)
{
	struct view *v = d->view;
	const unsigned of = style_of(d, style, on_ground);
	for (int i = 0; i < v->n_texts; i++)
		if (v->texts[i].style == of && !strcmp(v->texts[i].text, text))
			return &v->texts[i];
	struct text_plate *all = reallocarray(v->texts, (size_t)v->n_texts + 1, sizeof *all);
	if (!all || strlen(text) >= LABEL_ROOM)
		return NULL;
	v->texts = all;
	struct text_plate *t = &all[v->n_texts++];
	*t = (struct text_plate){ .style = of };
	memcpy(t->text, text, strlen(text) + 1);
	t->plate = make_text(d, text, style, on_ground);
	return t;
}

double text_width(struct drawing *d, const char *text, enum label_style style, bool on_ground)
{
	struct text_plate *t = find_text(d, text, style, on_ground);
	return t ? t->plate.width : 0;
}

void text_draw(struct drawing *d, const char *text, enum label_style style, bool on_ground,
               double x, double y)
{
	struct text_plate *t = find_text(d, text, style, on_ground);
	if (!t || !t->plate.texture)
		return;
	t->used = true;
	/* texels on pixels: sharp */
	plate_draw(d, &t->plate, round(x - t->plate.width / 2.0), round(y - t->plate.height / 2.0),
	           t->plate.width, t->plate.height);
}

void texts_begin(struct view *v)
{
	for (int i = 0; i < v->n_texts; i++)
		v->texts[i].used = false;
}

void texts_end(struct view *v)
{
	enum { KEPT = 256 }; /* not used now, but perhaps again */
	int n = 0;
	for (int i = 0; i < v->n_texts; i++)
		if (v->texts[i].used || v->n_texts <= KEPT)
			v->texts[n++] = v->texts[i];
		else
			plate_finish(&v->texts[i].plate);
	v->n_texts = n;
}

void texts_finish(struct view *v)
{
	for (int i = 0; i < v->n_texts; i++)
		plate_finish(&v->texts[i].plate);
	free(v->texts);
	v->texts = NULL;
	v->n_texts = 0;
}
