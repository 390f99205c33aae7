/* surface_second.c - point, first and second derivatives at once. */
#include "surface_second.h"

#include "basis_inline.h"

enum { S, SU, SV, SUU, SUV, SVV };

/* Homogeneous derivatives about *center, a control point near by. */
BATTEN_INLINE void evaluate(const struct surface *s, double u, double v, const int span[2],
                            const int ku, const int kv, struct point4 d[6], struct point4 *center)
{
	double bu[3][ORDER_MAX], bv[3][ORDER_MAX];
	basis_inline(ku, s->knots[0], span[0], u, bu[0], bu[1], bu[2]);
	basis_inline(kv, s->knots[1], span[1], v, bv[0], bv[1], bv[2]);
	const double *q = s->points + 4 * ((size_t)(span[0] - ku + 1) * s->n[1] + span[1] - kv + 1);
	const double *o =
	        q + 4 * ((size_t)s->n[1] * basis_heaviest(bu[0], ku) + basis_heaviest(bv[0], kv));
	const struct point4 c = point4_center(o, s->rational), zero = { { 0 }, { 0 } };
	struct point4 sum[6] = { zero, zero, zero, zero, zero, zero };
	for (int i = 0; i < ku; i++, q += (size_t)4 * s->n[1]) {
		struct point4 row = zero, row_v = zero, row_vv = zero;
		for (int j = 0; j < kv; j++) {
			const struct point4 x = point4_about(q + 4 * j, c);
			row = point4_along(row, bv[0][j], x);
			row_v = point4_along(row_v, bv[1][j], x);
			row_vv = point4_along(row_vv, bv[2][j], x);
		}
		sum[S] = point4_along(sum[S], bu[0][i], row);
		sum[SU] = point4_along(sum[SU], bu[1][i], row);
		sum[SUU] = point4_along(sum[SUU], bu[2][i], row);
		sum[SV] = point4_along(sum[SV], bu[0][i], row_v);
		sum[SUV] = point4_along(sum[SUV], bu[1][i], row_v);
		sum[SVV] = point4_along(sum[SVV], bu[0][i], row_vv);
	}
	for (int k = 0; k < 6; k++)
		d[k] = sum[k];
	*center = c;
}

void surface_second(const struct surface *s, double u, double v, int span[2],
                    struct surface_shape *out)
{
	const int ku = s->order[0], kv = s->order[1];
	struct point4 d[6], center;
	span[0] = knots_domain_span(ku, s->n[0], s->knots[0], s->domain[0], u);
	span[1] = knots_domain_span(kv, s->n[1], s->knots[1], s->domain[1], v);
	/* The commonest orders get code of their own, unrolled. */
	if (ku == 4 && kv == 4)
		evaluate(s, u, v, span, 4, 4, d, &center);
	else if (ku == 3 && kv == 3)
		evaluate(s, u, v, span, 3, 3, d, &center);
	else if (ku == 6 && kv == 6)
		evaluate(s, u, v, span, 6, 6, d, &center);
	else
		evaluate(s, u, v, span, ku, kv, d, &center);
	struct vec3 p = point4_vector(d[S]), du = point4_vector(d[SU]), dv = point4_vector(d[SV]);
	struct vec3 uu = point4_vector(d[SUU]), uv = point4_vector(d[SUV]),
	            vv = point4_vector(d[SVV]);
	if (s->rational) { /* quotient rule */
		const double w = 1 / point4_weight(d[S]);
		const double wu = -point4_weight(d[SU]), wv = -point4_weight(d[SV]);
		p = vec3_scale(p, w);
		du = vec3_scale(vec3_along(du, wu, p), w);
		dv = vec3_scale(vec3_along(dv, wv, p), w);
		uu = vec3_along(vec3_along(uu, 2 * wu, du), -point4_weight(d[SUU]), p);
		vv = vec3_along(vec3_along(vv, 2 * wv, dv), -point4_weight(d[SVV]), p);
		uv = vec3_along(vec3_along(uv, wu, dv), wv, du);
		uv = vec3_along(uv, -point4_weight(d[SUV]), p);
		uu = vec3_scale(uu, w);
		uv = vec3_scale(uv, w);
		vv = vec3_scale(vv, w);
	}
	out->point = vec3_add(p, point4_vector(center));
	out->du = du;
	out->dv = dv;
	out->duu = uu;
	out->duv = uv;
	out->dvv = vv;
}
