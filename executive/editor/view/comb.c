/* comb.c - porcupines: quills that show a curve's curvature. */
#include <stdlib.h>

#include "on_surface.h"
#include "shape.h"

struct quill {
	struct vec3 point,
	        away;      /* away: curvature times the unit normal that points off its centre */
	struct vec3 about; /* binormal times curvature */
	double t;
	bool is;
};

static struct quill quill_at(const struct curve *c, const struct surface *on, double t)
{
	struct vec3 d[3];
	if (on) {
		const struct on_surface x = { c, on };
		on_surface_derivatives(&x, t, 2, d);
	} else {
		curve_derivatives(c, t, 2, d);
	}
	struct quill q = { .point = d[0], .t = t };
	double speed = vec3_length(d[1]);
	if (!(speed > 0))
		return q;
	q.about = vec3_scale(vec3_cross(d[1], d[2]), 1 / (speed * speed * speed));
	q.away = vec3_cross(vec3_scale(d[1], 1 / speed), q.about);
	q.is = isfinite(vec3_length(q.away));
	return q;
}

/*
 * The longest quill has the length given, the others are in proportion to their curvature. Quills
 * stand off the centre of curvature; which side that is is told by the binormal against the mean one.
 */
static void draw(struct poly *out, const struct quill *q, int n, double longest)
{
	double most = 0;
	struct vec3 about = vec3(0, 0, 0);
	for (int i = 0; i < n; i++)
		if (q[i].is) {
			most = fmax(most, vec3_length(q[i].away));
			about = vec3_add(about, q[i].about);
		}
	if (!(most > 0))
		return;
	if (!(vec3_length(about) > 1e-9 * most)) /* as much to one side as to the other */
		about = q[0].about;
	for (int i = 0; i < n; i++) {
		if (!q[i].is)
			continue;
		bool other = vec3_dot(q[i].about, about) < 0;
		struct poly *quills = &out[other ? SHAPE_QUILLS_OTHER : SHAPE_QUILLS];
		struct vec3 end = vec3_along(q[i].point, longest / most, q[i].away);
		poly_add(quills, q[i].point, q[i].t);
		poly_add(quills, end, q[i].t);
		poly_end(quills);
		poly_add(&out[SHAPE_ENVELOPE], end, q[i].t);
	}
	poly_end(&out[SHAPE_ENVELOPE]);
}

void comb_add(struct poly *out, const struct curve *c, const struct surface *on, double longest,
              int quills)
{
	if (quills < 2)
		return;
	struct quill *q = malloc((size_t)quills * sizeof *q);
	if (!q) {
		out[SHAPE_QUILLS].failed = true;
		return;
	}
	for (int i = 0; i < quills; i++)
		q[i] = quill_at(c, on,
		                i + 1 == quills ? c->domain[1]
		                                : c->domain[0] + (c->domain[1] - c->domain[0]) * i /
		                                                         (quills - 1));
	draw(out, q, quills, longest);
	free(q);
}
