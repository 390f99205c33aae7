/* scene_lines.h - what picture_lines draws, laid out: strokes and texts in px, for any writer. */
#ifndef BATTEN_SCENE_LINES_H
#define BATTEN_SCENE_LINES_H

#include "label.h"
#include "picture.h"
#include "stroke.h"

struct line_style {
	struct rgb color;
	double width, opacity;
};

/* A set of strokes of one style. */
struct scene_line {
	struct stroke stroke; /* owned */
	struct line_style style;
	const char *what; /* "wire", "border", "curve" */
};

/* A text with its left end and baseline; on a plate of the ground's color where it lies on lines. */
struct scene_text {
	double x, y, width;
	enum label_style style;
	struct rgb color;
	bool plate;
	const char *text; /* borrowed */
};

struct scene_lines {
	int x, y; /* of its upper left corner on the sheet */
	int width, height;
	struct rgb ground;
	struct scene_line *lines; /* owned */
	size_t n_lines;
	struct scene_text *texts; /* owned */
	size_t n_texts;
};

/* cr: to measure texts with. Errors: ST_RESOURCE, others as of surface_isoparametric. */
enum status scene_lines_init(struct scene_lines *s, const struct picture_lines *lines,
                             enum theme theme, cairo_t *cr);
void scene_lines_finish(struct scene_lines *s);

/* Where a text's plate lies. */
void scene_plate(const struct scene_text *t, double box[4]);

/* What one or several scenes are on. */
struct scene_sheet {
	int width, height;
	struct rgb rule; /* between scenes */
	struct scene_lines *scenes;
	int n;
};

/* SVG 1.1, the same text for the same scenes. */
enum status svg_write(const struct scene_sheet *s, const char *path, const struct report *r);

#endif
