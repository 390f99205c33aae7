/* render.c - the world as a picture in a file, without a window. */
#include "render.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "file.h"
#include "path.h"
#include "sheet.h"
#include "view_private.h"

enum { PAD = 16, KEY_RIGHT = 90, BELOW_HEADING = 24, SIDE_MAX = 16384 };

static const struct format {
	const char *extension;
	bool lines;
	enum picture_format format;
} formats[] = {
	{ ".png", false, PICTURE_PNG },
	{ ".svg", true, PICTURE_SVG },
	{ ".pdf", true, PICTURE_PDF },
};

static const struct format *find_format(const char *path)
{
	for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
		if (!strcasecmp(path_extension(path), formats[i].extension))
			return &formats[i];
	return NULL;
}

/* Rows come from the bottom, RGBA; Cairo's go down, as 0xRRGGBB. */
static enum status read_back(struct sheet *s, const struct report *r)
{
	const size_t n = (size_t)s->width * s->height;
	unsigned char *bytes = malloc(4 * n);
	int stride;
	if (!bytes)
		return report_error(r, ST_RESOURCE, "cannot draw: memory ran out");
	glPixelStorei(GL_PACK_ALIGNMENT, 4);
	glReadPixels(0, 0, s->width, s->height, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
	unsigned *pixels = sheet_pixels(s, &stride);
	for (int y = 0; y < s->height; y++)
		for (int x = 0; x < s->width; x++) {
			const unsigned char *p =
			        bytes + 4 * ((size_t)(s->height - 1 - y) * s->width + x);
			pixels[(size_t)y * stride + x] =
			        (unsigned)p[0] << 16 | (unsigned)p[1] << 8 | p[2];
		}
	sheet_touched(s);
	free(bytes);
	return ST_OK;
}

/* Of the values of a map, where all things that may have one are in the same unit. */
static const char *key_unit(const struct world *w, int quantity, char out[64])
{
	const char *unit = NULL;
	for (int i = 0; i < world_count(w); i++) {
		const struct Ful *f = world_at(w, i);
		if (f->entity.kind != ENTITY_SURFACE || !f->display.on)
			continue;
		if (!f->unit || (unit && strcmp(unit, f->unit) != 0)) {
			unit = NULL;
			break;
		}
		unit = f->unit;
	}
	snprintf(out, 64, "1/%.50s%s", unit ? unit : "length",
	         quantity_table[quantity < 0 ? 0 : quantity].power == 2 ? "²" : "");
	return out;
}

static void write_heading(cairo_t *cr, const struct render_tile *t, enum theme set)
{
	if (t->title.s)
		label_draw(cr, LABEL_HEADING, theme_color(set, TOKEN_TEXT), PAD, PAD + 12, 0,
		           t->title.s);
	if (t->note.s)
		label_draw(cr, LABEL_NOTE, theme_color(set, TOKEN_MUTED), PAD, PAD + 30, 0,
		           t->note.s);
}

static void write_key(cairo_t *cr, const struct world *w, const struct render_tile *t,
                      struct key *key, int quantity, double scale)
{
	const double high = t->height / scale;
	char unit[64];
	key->bar = fmin(fmax(floor(0.28 * high), 140), 320);
	key->unit = key_unit(w, quantity, unit);
	const double width = fmax(key_width(cr, key), KEY_RIGHT - PAD);
	key_draw(cr, key, floor(t->width / scale - PAD - width),
	         PAD + (t->seen < t->width ? BELOW_HEADING : 0));
}

static enum status draw_plane(cairo_t *cr, const struct world *w, const struct render_tile *t,
                              enum theme set)
{
	struct plane_lines p;
	enum status st = plane_lines_init(&p, w, t, set);
	p.lines.title = p.lines.note = NULL;
	if (st == ST_OK)
		st = picture_pane_draw(cr, &p.lines, set);
	plane_lines_finish(&p);
	return st;
}

static void clear(int x, int y, int width, int height, struct rgb c)
{
	glEnable(GL_SCISSOR_TEST);
	glScissor(x, y, width, height);
	glClearColor((float)c.r, (float)c.g, (float)c.b, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
}

/* The views into one image; *keys: of those that have one. */
static enum status draw_to(struct sheet *s, struct view *v, const struct world *w,
                           const struct render_tiles *tiles, struct key *keys, bool *has_key,
                           const struct report *r)
{
	const struct sight *sight = world_sight((struct world *)w);
	const struct rgb ground = sight->has_background
	                                  ? sight->background
	                                  : theme_color(tiles->tile[0].state.theme, TOKEN_VIEW);
	struct target t = { 0 };
	enum status st = target_init(&t, s->width, s->height, 0, r);
	glBindFramebuffer(GL_FRAMEBUFFER, t.frame);
	clear(0, 0, s->width, s->height, theme_color(tiles->tile[0].state.theme, TOKEN_LINE));
	for (int i = 0; i < tiles->n; i++) {
		const struct render_tile *x = &tiles->tile[i];
		struct view_state state = x->state;
		bool more = !x->is_plane && !x->is_empty;
		state.whole = true;
		clear(x->x, s->height - x->y - x->height, x->width, x->height, ground);
		/* values of a job that still runs are taken as they are; triangles are waited for */
		for (int k = 0; k < 10000 && more && st == ST_OK; k++) {
			glBindFramebuffer(GL_FRAMEBUFFER, t.frame);
			st = view_draw(v, w, &state, x->x, s->height - x->y - x->height, x->seen,
			               x->height, &more, r);
		}
		has_key[i] = x->has_key && view_key(v, &keys[i]);
	}
	glBindFramebuffer(GL_FRAMEBUFFER, t.frame);
	if (st == ST_OK)
		st = read_back(s, r);
	target_finish(&t);
	return st;
}

/* What Cairo draws, over the views. */
static enum status write_over(struct sheet *s, const struct world *w,
                              const struct render_tiles *tiles, struct key *keys,
                              const bool *has_key, const struct render_options *o)
{
	const struct sight *sight = world_sight((struct world *)w);
	const enum theme set = sight->has_background ? ground_theme(sight->background) : o->theme;
	enum status st = ST_OK;
	for (int i = 0; i < tiles->n && st == ST_OK; i++) {
		const struct render_tile *t = &tiles->tile[i];
		const int quantity =
		        t->state.quantity >= 0 ? t->state.quantity : render_quantity(w, o);
		cairo_save(s->cr);
		cairo_rectangle(s->cr, t->x, t->y, t->width, t->height);
		cairo_clip(s->cr);
		cairo_translate(s->cr, t->x, t->y);
		cairo_scale(s->cr, o->scale, o->scale);
		if (t->is_plane)
			st = draw_plane(s->cr, w, t, o->theme);
		write_heading(s->cr, t, t->is_plane ? o->theme : set);
		if (has_key[i])
			write_key(s->cr, w, t, &keys[i], quantity, o->scale);
		cairo_restore(s->cr);
	}
	return st;
}

static enum status render_png(const struct world *w, const char *path,
                              const struct render_options *o, const struct render_tiles *tiles,
                              const struct report *r)
{
	struct offscreen *screen = NULL;
	struct view *v = NULL;
	struct sheet sheet = { .surface = NULL };
	struct key keys[N_QUANTITIES + 1];
	bool has_key[N_QUANTITIES + 1];
	enum status st = offscreen_create(&screen, r);
	if (st == ST_OK)
		st = view_create(&v, r);
	if (st == ST_OK)
		st = sheet_init(&sheet, path, o->width, o->height, r);
	if (st == ST_OK)
		st = draw_to(&sheet, v, w, tiles, keys, has_key, r);
	if (st == ST_OK && write_over(&sheet, w, tiles, keys, has_key, o) != ST_OK)
		st = report_error(r, ST_RESOURCE, "cannot draw: memory ran out");
	if (st == ST_OK)
		st = sheet_write(&sheet, path, r);
	sheet_finish(&sheet);
	view_destroy(v);
	offscreen_destroy(screen);
	return st;
}

static enum status check(const struct world *w, const char *path, const struct render_options *o,
                         const struct format *f, const struct report *r)
{
	int shown = world_overlays(w);
	for (int k = 0; k < world_count(w); k++)
		shown += world_at(w, k)->display.on;
	if (!f)
		return report_error(r, ST_PARAMETER,
		                    "'%s': a picture is .png, or .svg or .pdf for lines", path);
	if (o->width < 1 || o->height < 1 || o->width > SIDE_MAX || o->height > SIDE_MAX)
		return report_error(r, ST_PARAMETER, "size %dx%d: expected 1 to %d pixels a side",
		                    o->width, o->height, SIDE_MAX);
	if (!shown)
		return report_error(r, ST_INPUT, "there is nothing to draw");
	return ST_OK;
}

/* Sentences name the file as the caller does, not as it is called until it is whole. */
struct naming {
	const struct report *to;
	const char *temporary, *path;
};

static void say_named(void *data, enum report_level level, enum status st, const char *text)
{
	const struct naming *n = data;
	const char *at = strstr(text, n->temporary);
	char *named = at ? text_print("%.*s%s%s", (int)(at - text), text, n->path,
	                              at + strlen(n->temporary))
	                 : NULL;
	if (n->to && n->to->say)
		n->to->say(n->to->data, level, st, named ? named : text);
	free(named);
}

enum status render_write(const struct world *w, const char *path, const struct render_options *o,
                         const struct report *r)
{
	struct render_options all = *o;
	struct render_tiles tiles = { .n = 0 };
	const struct format *f = find_format(path);
	if (!(all.scale > 0))
		all.scale = 1;
	struct whole_file file = { .stream = NULL };
	enum status st = check(w, path, &all, f, r);
	if (st == ST_OK)
		st = render_tiles_init(&tiles, w, &all, f->lines, r);
	if (st == ST_OK)
		st = whole_file_create(&file, path, r);
	if (st != ST_OK) {
		render_tiles_finish(&tiles);
		return st;
	}
	/* the writers open by name; a file that has none yet is found by its number */
	char *name =
	        file.temp ? strdup(file.temp) : text_print("/proc/self/fd/%d", fileno(file.stream));
	if (!name)
		st = report_error(r, ST_RESOURCE, "cannot write '%s': memory ran out", path);
	struct naming naming = { r, name, path };
	const struct report named = { say_named, &naming };
	if (name)
		st = f->lines ? render_lines(w, name, f->format, &tiles, &all, &named)
		              : render_png(w, name, &all, &tiles, &named);
	free(name);
	render_tiles_finish(&tiles);
	if (st == ST_OK)
		return whole_file_commit(&file, r);
	whole_file_abandon(&file);
	return st;
}
