/* plan_stroke.h - what a lines plan draws with: parts of curves on one side of planes. */
#ifndef BATTEN_PLAN_STROKE_H
#define BATTEN_PLAN_STROKE_H

#include "stroke.h"
#include "surface.h"

/* P . normal >= value is drawn. */
struct plan_side {
	struct vec3 normal;
	double value;
};

/* Errors of all: ST_RESOURCE. */
enum status plan_stroke(struct stroke *s, const struct camera *camera, const struct curve *c,
                        const struct plan_side *sides, int n);

/* Border d = lower or upper end of a surface, likewise. */
enum status plan_border(struct stroke *s, const struct camera *camera,
                        const struct surface *surface, int d, int end,
                        const struct plan_side *sides, int n);

/* A straight line in px. */
enum status plan_line(struct stroke *s, double x0, double y0, double x1, double y1);

#endif
