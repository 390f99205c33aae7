/* curvature.h - normal and curvatures of a surface at a point. Units: 1/length, Gaussian 1/length^2.
 *
 * N = Su x Sv / |Su x Sv|; H = (E Lvv - 2 F Luv + G Luu) / 2 (EG - F^2) with L.. = S.. . N, so a
 * sphere with outward N has H = -1/R; kmax >= kmin.
 * Source: do Carmo, Differential Geometry of Curves and Surfaces (1976), section 3.3.
 */
#ifndef BATTEN_CURVATURE_H
#define BATTEN_CURVATURE_H

#include <stdbool.h>

#include "surface.h"

/* The quantities: name, EXR channel, JSON name, menu code, title, signed (1) or not (0), power of
 * 1/length. Order is that of struct and masks. absolute is |kmax| + |kmin|. */
#define QUANTITY_MAP(X)                                                                            \
	X(GAUSSIAN, "K", "gaussian", "V80", "Gaussian curvature", 1, 2)                            \
	X(MEAN, "H", "mean", "V81", "mean curvature", 1, 1)                                        \
	X(ABSOLUTE, "kabs", "absolute", "V82", "absolute curvature", 0, 1)                         \
	X(KMAX, "kmax", "kmax", "V83", "maximum principal curvature", 1, 1)                        \
	X(KMIN, "kmin", "kmin", "V84", "minimum principal curvature", 1, 1)                        \
	X(NORMAL_U, "kn_u", "normal_u", "V85", "normal curvature in u", 1, 1)                      \
	X(NORMAL_V, "kn_v", "normal_v", "V86", "normal curvature in v", 1, 1)

#define X(name, channel, json, code, title, is_signed, power) QUANTITY_##name,
enum quantity { QUANTITY_MAP(X) N_QUANTITIES };
#undef X

struct quantity_row {
	const char *channel, *json, *code, *title;
	bool is_signed;
	int power;
};
extern const struct quantity_row quantity_table[N_QUANTITIES];

/* What one point of a surface has. NaN where a value does not exist (normal too). */
struct surface_shape {
	struct vec3 point, du, dv, duu, duv, dvv;
	struct vec3 normal;
	double value[N_QUANTITIES];
	bool limit; /* Su x Sv vanishes there and normal and values are limits */
};

/*
 * Everything at (u, v). At a degenerate point (a pole) normal and curvatures are the limits from
 * inside the domain where all directions agree, and `limit` is set; NaN where they do not. All
 * directions means, where an isoparametric line is shrunk to the point, those across it from the
 * whole line; but normal_u and normal_v, whose directions turn along such a line, are limits at
 * this u, v. Where only the normal's sign differs (two sides of a pole inside the domain) the
 * values that do not depend on it are given without a normal. Su x Sv counts as zero below 1e-9 of
 * its largest in the span.
 * Accuracy: of a limit 1e-6 relative where the surface is smooth there (1e-9 on a sphere); beside a
 * degenerate point, where the formulas lose digits, likewise.
 */
void surface_shape(const struct surface *s, double u, double v, struct surface_shape *out);

/* Unit normal alone, with the same limits; false (and NaN) where there is none. */
bool surface_normal(const struct surface *s, double u, double v, struct vec3 *normal);

/* Normal curvature in the direction a Su + b Sv (Meusnier); NaN for a = b = 0. */
double shape_normal_curvature(const struct surface_shape *p, double a, double b);

/* Principal directions as unit vectors in space, of kmax then kmin; false at an umbilic. */
bool shape_principal_directions(const struct surface_shape *p, struct vec3 out[2]);

#endif
