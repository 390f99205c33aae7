/* homogeneous.c - checks of points and domains, derivatives of rational forms. */
#include "homogeneous.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

static void place_write(char out[48], int i, int n1)
{
	if (n1 > 1)
		snprintf(out, 48, "control point %d,%d", i / n1 + 1, i % n1 + 1);
	else
		snprintf(out, 48, "control point %d", i + 1);
}

enum status points_check(double *points, int n0, int n1, const char *what, bool *rational,
                         const struct report *r)
{
	const int n = n0 * n1;
	char place[48];
	bool differ = false;
	for (int i = 0; i < n; i++) {
		const double *p = points + (size_t)4 * i, w = p[3];
		differ |= w != points[3];
		if (isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]) && isfinite(w) && w > 0 &&
		    isfinite(p[0] / w) && isfinite(p[1] / w) && isfinite(p[2] / w))
			continue;
		place_write(place, i, n1);
		if (!isfinite(w) || !(w > 0))
			return report_error(
			        r, ST_INPUT,
			        "%s: %s has weight %g, expected more than 0; mend it or "
			        "export without weights",
			        what, place, w);
		return report_error(r, ST_INPUT, "%s: %s is %g %g %g, expected numbers", what,
		                    place, p[0] / w, p[1] / w, p[2] / w);
	}
	*rational = differ;
	if (!differ && points[3] != 1) {
		const double w = points[3];
		for (int i = 0; i < n; i++) {
			double *p = points + (size_t)4 * i;
			p[0] /= w;
			p[1] /= w;
			p[2] /= w;
			p[3] = 1;
		}
	}
	return ST_OK;
}

enum status domain_check(double domain[2], double a, double b, const char *what,
                         const struct report *r)
{
	if (domain[0] == domain[1]) {
		domain[0] = a;
		domain[1] = b;
	}
	const double slack = 1e-9 * (b - a);
	if (!(domain[0] < domain[1]))
		return report_error(r, ST_INPUT,
		                    "%s: domain from %.17g to %.17g, expected from < to", what,
		                    domain[0], domain[1]);
	if (domain[0] < a - slack || domain[1] > b + slack)
		return report_error(
		        r, ST_INPUT,
		        "%s: domain from %.17g to %.17g is not inside that of the knots, "
		        "%.17g to %.17g",
		        what, domain[0], domain[1], a, b);
	domain[0] = fmax(domain[0], a);
	domain[1] = fmin(domain[1], b);
	return ST_OK;
}

void quotient_curve(int top, const double (*h)[4], int d, struct vec3 *out)
{
	const double scale = 1 / h[0][3];
	for (int k = 0; k <= d; k++) {
		struct vec3 v = k <= top ? vec3(h[k][0], h[k][1], h[k][2]) : vec3(0, 0, 0);
		double choose = 1;
		for (int i = 1; i <= k && i <= top; i++) {
			choose = choose * (k - i + 1) / i;
			v = vec3_along(v, -choose * h[i][3], out[k - i]);
		}
		out[k] = vec3_scale(v, scale);
	}
}

void quotient_surface(const int top[2], const double (*h)[4], int stride, int d, struct vec3 *out)
{
	const double scale = 1 / h[0][3];
	for (int k = 0; k <= d; k++)
		for (int l = 0; k + l <= d; l++) {
			struct vec3 sum = vec3(0, 0, 0);
			if (k <= top[0] && l <= top[1]) {
				const double *a = h[k * stride + l];
				sum = vec3(a[0], a[1], a[2]);
			}
			double choose_k = 1;
			for (int i = 0; i <= k && i <= top[0]; i++) {
				if (i > 0)
					choose_k = choose_k * (k - i + 1) / i;
				double choose_l = 1;
				for (int j = 0; j <= l && j <= top[1]; j++) {
					if (j > 0)
						choose_l = choose_l * (l - j + 1) / j;
					if (i + j == 0)
						continue;
					const double w = h[i * stride + j][3];
					sum = vec3_along(sum, -choose_k * choose_l * w,
					                 out[(k - i) * (d + 1) + l - j]);
				}
			}
			out[k * (d + 1) + l] = vec3_scale(sum, scale);
		}
}
