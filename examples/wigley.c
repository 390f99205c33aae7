/* wigley.c - Wigley's parabolic hull, exact as one biquadratic patch a side.
 *
 * y = (B/2) (1 - (2x/L)^2) (1 - (z/T)^2), L/B = 10, L/T = 16.
 * Source: Wigley, Trans. INA 76 (1934), 124-141; ITTC Cooperative Experiments on Wigley Parabolic
 * Models (1983).
 */
#include "example.h"

/* Bernstein coefficients of x and of 1 - x^2 over [-1, 1], of z and of 1 - z^2 over [-1, 0]. */
static const double x_row[3] = { -1, 0, 1 }, x_factor[3] = { 0, 2, 0 };
static const double z_row[3] = { -1, -0.5, 0 }, z_factor[3] = { 0, 1, 1 };

enum status example_wigley(struct model *m, const struct report *r)
{
	const double length = 100, beam = 10, draught = 6.25;
	struct surface s;
	(void)r;
	enum status st = surface_init(&s, (int[2]){ 3, 3 }, (int[2]){ 3, 3 });
	if (st != ST_OK)
		return st;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			surface_set_point(&s, i, j,
			                  vec3(length / 2 * x_row[2 - i],
			                       beam / 2 * x_factor[i] * z_factor[j],
			                       draught * z_row[j]),
			                  1);
	for (int d = 0; d < 2; d++) {
		for (int i = 3; i < 6; i++)
			s.knots[d][i] = 1;
		s.domain[d][1] = 1;
	}
	return example_add_mirrored(m, &s, "wigley port", "wigley starboard", 0x8f6b4a);
}
