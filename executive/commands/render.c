/* render.c - a picture of geometry without a window; batten-editor draws it. */
#include <stdlib.h>

#include "editor_program.h"
#include "verbs.h"

static const struct option_row render_options[] = {
	{ "--output", "-o", "FILE", "picture to write: .png, or .svg or .pdf for lines" },
	{ "--size", NULL, "WxH", "pixels (default: 1280x800)" },
	{ "--view", NULL, "VIEW",
	  "three-quarter, front, back, left, right, top, bottom or AZIMUTH,ELEVATION in degrees; "
	  "then :perspective or :orthographic, and @ANGLE" },
	{ "--split", NULL, "VIEWS",
	  "what is beside each other: one; side, two sides; uv, the first surface and the plane of its "
	  "parameters; or curvatures, all seven (default: one)" },
	{ "--beside", NULL, "VIEW", "from where the second of two sides looks (default: top)" },
	{ "--look", NULL, "LOOK",
	  "wire, shaded or map (default: shaded; with a quantity or a map, map)" },
	{ "--quantity", NULL, "Q",
	  "what a map shows: K, H, kabs, kmax, kmin, kn_u or kn_v (default: K)" },
	{ "--map", NULL, "FILE,...", "values of a .map.exr, one file a surface, in their order" },
	{ "--lines", NULL, "FILE,...",
	  "lines to draw, of .isophote, .contour or .reflect, one file a surface, in their order" },
	{ "--image", NULL, "FILE",
	  "an image result instead, as .shade.exr, fitted into the picture" },
	{ "--theme", NULL, "NAME", "dark or light (default: light)" },
	{ "--background", NULL, "#RRGGBB", "color of the ground instead of the theme's" },
	{ "--scale", NULL, "S", "pixels for one of texts and line widths (default: 1)" },
	{ "--title", NULL, "TEXT", "heading instead of the names" },
	{ 0 },
};

/* Options by name and value, then "--" and the files. */
static int render_run(const struct invocation *i)
{
	if (!i->n_words || !invocation_value(i, "--output"))
		return status_exit(report_error(&i->report, ST_PARAMETER,
		                                "name what to draw, and the picture with -o"));
	char **words = calloc(2 * OPTIONS_MAX + (size_t)i->n_words + 4, sizeof *words);
	if (!words)
		return status_exit(report_error(&i->report, ST_RESOURCE, "memory ran out"));
	int n = 1;
	words[n++] = (char *)"--render";
	for (int k = 0; render_options[k].name; k++) {
		const char *value = invocation_value(i, render_options[k].name);
		if (!value)
			continue;
		words[n++] = (char *)render_options[k].name;
		words[n++] = (char *)value;
	}
	words[n++] = (char *)"--";
	for (int k = 0; k < i->n_words; k++)
		words[n++] = i->words[k];
	int rc = editor_program_become(words, &i->report);
	free(words);
	return rc;
}

const struct command command_render = {
	.name = "render",
	.usage = "FILE[#ENTITY]... -o PICTURE [--look LOOK] [--view VIEW]",
	.text = "draw geometry into a picture",
	.help = "The same drawing as in the window, without one: no display is needed. Maps without a file of\n"
	        "values are evaluated on a grid of 256 x 256; curvature jobs make finer ones. The picture\n"
	        "appears whole or not at all.",
	.options = render_options,
	.first_word = WORD_FILE,
	.words = WORD_FILE,
	.run = render_run,
};
