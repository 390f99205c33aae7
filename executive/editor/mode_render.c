/* mode_render.c - a picture of geometry files without a window: what `batten render` starts. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "modes.h"
#include "number.h"
#include "path.h"
#include "view.h"

struct request {
	struct world *world;
	struct report report;
	struct render_options options;
	const char *out, *look, *lines, *map, *image;
	bool has_background;
	struct rgb background;
};

static enum status set_size(struct request *q, const char *value)
{
	const char *at = value, *end = value + strlen(value);
	int64_t size[2] = { 0, 0 };
	if (!number_read_integer(&at, end, &size[0]) || at == end || *at++ != 'x' ||
	    !number_read_integer(&at, end, &size[1]) || at != end || size[0] < 1 || size[1] < 1 ||
	    size[0] > 16384 || size[1] > 16384)
		return report_error(&q->report, ST_PARAMETER,
		                    "--size '%s': expected WxH, 1 to 16384 pixels a side", value);
	q->options.width = (int)size[0];
	q->options.height = (int)size[1];
	return ST_OK;
}

static enum status set_view(struct request *q, const char *value)
{
	q->options.view = value;
	return ST_OK;
}

static enum status set_look(struct request *q, const char *value)
{
	q->look = value;
	if (!strcmp(value, "wire") || !strcmp(value, "shaded") || !strcmp(value, "map"))
		return ST_OK;
	return report_error(&q->report, ST_PARAMETER, "--look '%s': expected wire, shaded or map",
	                    value);
}

static enum status set_quantity(struct request *q, const char *value)
{
	for (int k = 0; k < N_QUANTITIES; k++)
		if (!strcmp(value, quantity_table[k].channel)) {
			q->options.quantity = (enum quantity)k;
			q->options.has_quantity = true;
			return ST_OK;
		}
	return report_error(&q->report, ST_PARAMETER,
	                    "--quantity '%s': expected K, H, kabs, kmax, kmin, kn_u or kn_v",
	                    value);
}

static enum status set_theme(struct request *q, const char *value)
{
	q->options.theme = strcmp(value, "dark") ? THEME_LIGHT : THEME_DARK;
	if (!strcmp(value, "dark") || !strcmp(value, "light"))
		return ST_OK;
	return report_error(&q->report, ST_PARAMETER, "--theme '%s': expected dark or light",
	                    value);
}

static enum status set_scale(struct request *q, const char *value)
{
	if (number_parse(value, &q->options.scale) && q->options.scale >= 0.5 &&
	    q->options.scale <= 8)
		return ST_OK;
	return report_error(&q->report, ST_PARAMETER, "--scale '%s': expected 0.5 to 8", value);
}

static enum status set_background(struct request *q, const char *value)
{
	unsigned c = 0;
	char rest;
	if (strlen(value) != 7 || sscanf(value, "#%6x%c", &c, &rest) != 1)
		return report_error(&q->report, ST_PARAMETER,
		                    "--background '%s': expected a color as #RRGGBB", value);
	q->has_background = true;
	q->background =
	        (struct rgb){ (c >> 16 & 255) / 255.0, (c >> 8 & 255) / 255.0, (c & 255) / 255.0 };
	return ST_OK;
}

static enum status set_title(struct request *q, const char *value)
{
	q->options.title = value;
	return ST_OK;
}

static enum status set_out(struct request *q, const char *value)
{
	q->out = value;
	return ST_OK;
}

static enum status set_lines(struct request *q, const char *value)
{
	q->lines = value;
	return ST_OK;
}

static enum status set_map(struct request *q, const char *value)
{
	q->map = value;
	return ST_OK;
}

static enum status set_image(struct request *q, const char *value)
{
	q->image = value;
	return ST_OK;
}

static enum status set_split(struct request *q, const char *value)
{
	for (int k = PICTURE_ONE; k < N_PICTURE_VIEWS; k++)
		if (k != PICTURE_CHILD && !strcmp(value, picture_views_words[k])) {
			q->options.views = (enum picture_views)k;
			return ST_OK;
		}
	return report_error(&q->report, ST_PARAMETER,
	                    "--split '%s': expected one, side, uv or curvatures", value);
}

static enum status set_beside(struct request *q, const char *value)
{
	q->options.beside = value;
	return ST_OK;
}

static const struct setter {
	const char *name;
	enum status (*set)(struct request *q, const char *value);
} setters[] = {
	{ "--background", set_background },
	{ "--beside", set_beside },
	{ "--image", set_image },
	{ "--lines", set_lines },
	{ "--look", set_look },
	{ "--map", set_map },
	{ "--output", set_out },
	{ "--quantity", set_quantity },
	{ "--scale", set_scale },
	{ "--size", set_size },
	{ "--split", set_split },
	{ "--theme", set_theme },
	{ "--title", set_title },
	{ "--view", set_view },
};

static const struct setter *find_setter(const char *name)
{
	for (size_t i = 0; i < sizeof setters / sizeof *setters; i++)
		if (!strcmp(setters[i].name, name))
			return &setters[i];
	return NULL;
}

static enum status open_file(struct request *q, const char *argument)
{
	char *path = NULL, *selector = NULL;
	enum status st = model_split_name(argument, &path, &selector);
	if (st == ST_OK)
		st = world_open(q->world, path, selector, NULL, &q->report);
	else
		report_error(&q->report, st, "cannot open '%s': memory ran out", argument);
	free(path);
	free(selector);
	return st;
}

/* Lines of several surfaces are files of their own, NAME-3.isophote: each is drawn that is there. */
static enum status show(struct request *q, enum overlay_kind kind, const char *file, int thing)
{
	struct overlay o = { .kind = kind,
		             .thing = thing,
		             .file = (char *)file,
		             .quantity = q->options.quantity,
		             .scale = COLORMAP_AUTOMATIC };
	if (!path_exists(file))
		return report_error(&q->report, ST_INPUT, "cannot read '%s': no such file", file);
	return world_show(q->world, &o);
}

/* Files by comma, one a surface in their order; a single one belongs to the first. */
static enum status show_all(struct request *q, enum overlay_kind kind, const char *files)
{
	char *list = strdup(files), *rest = list, *file;
	int k = 0;
	enum status st = list ? ST_OK : ST_RESOURCE;
	while (st == ST_OK && (file = strsep(&rest, ","))) {
		while (k < world_count(q->world) &&
		       world_at(q->world, k)->entity.kind != ENTITY_SURFACE)
			k++;
		if (kind != OVERLAY_IMAGE && k >= world_count(q->world))
			st = report_error(&q->report, ST_PARAMETER,
			                  "'%s': there are fewer surfaces than files for them",
			                  file);
		else
			st = show(q, kind, file,
			          kind == OVERLAY_IMAGE ? 0 : world_at(q->world, k++)->id);
	}
	free(list);
	return st;
}

static enum status set_looks(struct request *q)
{
	enum surface_look look = LOOK_WIRE;
	if (q->look)
		look = *q->look == 's' ? LOOK_SHADED : *q->look == 'm' ? LOOK_MAP : LOOK_WIRE;
	else if (q->map || q->options.has_quantity || q->options.views == PICTURE_CURVATURES)
		look = LOOK_MAP;
	else
		look = LOOK_SHADED;
	if (look == LOOK_MAP && !q->map)
		q->options.has_quantity = true; /* of the surfaces themselves */
	enum status st = ST_OK;
	for (int k = 0; k < world_count(q->world) && st == ST_OK; k++) {
		struct display d = world_at(q->world, k)->display;
		d.look = look;
		d.on = true;
		st = world_set_display(q->world, world_at(q->world, k)->id, &d);
	}
	if (q->has_background) {
		struct sight *s = world_sight(q->world);
		s->has_background = true;
		s->background = q->background;
		world_touch(q->world);
	}
	return st;
}

static enum status read_words(struct request *q, int argc, char **argv)
{
	enum status st = ST_OK;
	for (int i = 0; i < argc && st == ST_OK; i++) {
		const struct setter *x = find_setter(argv[i]);
		if (!strcmp(argv[i], "--")) {
			for (i++; i < argc && st == ST_OK; i++)
				st = open_file(q, argv[i]);
			break;
		}
		if (!x || i + 1 >= argc)
			return report_error(&q->report, ST_PARAMETER, "unknown word '%s'", argv[i]);
		st = x->set(q, argv[++i]);
	}
	return st;
}

int mode_render(int argc, char **argv)
{
	struct request q = { .report = report_stderr("batten"),
		             .options = { .width = 1280, .height = 800 } };
	enum status st = world_create(&q.world, ".");
	if (st != ST_OK)
		return status_exit(report_error(&q.report, st, "memory ran out"));
	st = read_words(&q, argc, argv);
	if (st == ST_OK && !q.out)
		st = report_error(&q.report, ST_PARAMETER, "name the picture with -o");
	if (st == ST_OK)
		st = set_looks(&q);
	if (st == ST_OK && q.lines)
		st = show_all(&q, OVERLAY_LINES, q.lines);
	if (st == ST_OK && q.map)
		st = show_all(&q, OVERLAY_MAP, q.map);
	if (st == ST_OK && q.image)
		st = show_all(&q, OVERLAY_IMAGE, q.image);
	if (st == ST_OK)
		st = render_write(q.world, q.out, &q.options, &q.report);
	world_destroy(q.world);
	return status_exit(st);
}
