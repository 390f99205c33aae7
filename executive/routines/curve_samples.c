/* curve_samples.c - curvature and torsion along a curve. */
#include "curve_samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "on_surface.h"
#include "text.h"

static void take_one(double row[N_SAMPLE_COLUMNS], const struct Ful *f, const struct surface *on,
                     double at)
{
	struct curve_shape shape;
	struct on_surface_shape with = { .normal_curvature = NAN, .geodesic_curvature = NAN };

	if (on) {
		on_surface_shape(&(struct on_surface){ &f->entity.curve, on }, at, &with);
		shape = with.space;
	} else
		curve_shape(&f->entity.curve, at, &shape);
	row[SAMPLE_T] = at;
	row[SAMPLE_X_] = shape.point.x;
	row[SAMPLE_Y] = shape.point.y;
	row[SAMPLE_Z] = shape.point.z;
	row[SAMPLE_CURVATURE] = shape.curvature;
	row[SAMPLE_TORSION] = shape.torsion;
	row[SAMPLE_NORMAL] = with.normal_curvature;
	row[SAMPLE_GEODESIC] = with.geodesic_curvature;
}

enum status curve_samples_take(struct curve_samples *out, const struct world *w,
                               const struct Ful *f, int n)
{
	const struct Ful *base = f->on ? world_by_id(w, f->on) : NULL;
	const double *domain = f->entity.curve.domain;

	*out = (struct curve_samples){ .n = n, .on_surface = base != NULL };
	out->row = calloc((size_t)n, sizeof *out->row);
	if (!out->row)
		return ST_RESOURCE;
	for (int k = 0; k < n; k++) {
		double *row = out->row[k], *before = out->row[k ? k - 1 : 0];
		take_one(row, f, base ? &base->entity.geometry : NULL,
		         domain[0] + (domain[1] - domain[0]) * k / (n - 1));
		const struct vec3 step =
		        vec3(row[SAMPLE_X_] - before[SAMPLE_X_], row[SAMPLE_Y] - before[SAMPLE_Y],
		             row[SAMPLE_Z] - before[SAMPLE_Z]);
		row[SAMPLE_LENGTH] = before[SAMPLE_LENGTH] + vec3_length(step);
	}
	return ST_OK;
}

void curve_samples_finish(struct curve_samples *s)
{
	free(s->row);
	*s = (struct curve_samples){ 0 };
}

double curve_samples_sharpest(const struct curve_samples *s)
{
	double most = 0;

	for (int k = 0; k < s->n; k++)
		most = fmax(most, s->row[k][SAMPLE_CURVATURE]);
	return most;
}

enum status curve_samples_write(const struct curve_samples *s, const char *path,
                                const struct report *r)
{
#define X(name, word) word,
	static const char *const words[] = { SAMPLE_MAP(X) };
#undef X
	const int columns = s->on_surface ? N_SAMPLE_COLUMNS : SAMPLE_NORMAL;
	struct text t = { 0 };

	for (int c = 0; c < columns; c++)
		text_addf(&t, "%s%s", c ? "," : "", words[c]);
	for (int k = 0; k < s->n; k++) {
		text_add(&t, "\n");
		for (int c = 0; c < columns; c++) {
			text_add(&t, c ? "," : "");
			if (s->row[k][c] == s->row[k][c])
				text_add_number(&t, s->row[k][c]);
		}
	}
	text_add(&t, "\n");
	enum status st = t.failed ? report_error(r, ST_RESOURCE, "memory ran out")
	                          : file_write(path, t.s, t.n, r);
	text_finish(&t);
	return st;
}
