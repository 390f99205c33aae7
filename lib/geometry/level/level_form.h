/* level_form.h - polynomials in two variables as arrays of Bernstein coefficients.
 *
 * c[i * (n + 1) + j], degree m in u and n in v. In the scaled form each coefficient is multiplied
 * by its binomials: then a product is a plain convolution, and taking the first or last row away
 * divides by u or 1 - u.
 */
#ifndef BATTEN_LEVEL_FORM_H
#define BATTEN_LEVEL_FORM_H

#include <stdbool.h>
#include <stddef.h>

/* out += weight a b, all scaled; degrees am x an and bm x bn. */
void form_product(const double *a, int am, int an, const double *b, int bm, int bn, double weight,
                  double *out);

/* out += weight a a. */
void form_square(const double *a, int m, int n, double weight, double *out);

/* To the scaled form, or back. */
void form_scale(double *c, int m, int n, const double *binomial, bool back);

/* Divide the scaled form by the linear factor that vanishes on side (d, upper), whose coefficients
 * there are dropped, and raise the degree back. */
void form_divide(double *c, int m, int n, int d, bool upper);

/* The same for coefficients of four numbers each. */
void form_scale4(double *c, int m, int n, const double *binomial, bool back);
void form_divide4(double *c, int m, int n, int d, bool upper);

/* out += a x b, of the first three numbers; the fourth stays. */
void form_cross4(const double *a, int am, int an, const double *b, int bm, int bn, double *out);

/* out += sign a w, w every fourth number of a form. */
void form_weigh4(const double *a, int m, int n, const double *w, int wm, int wn, double sign,
                 double *out);

/* Halve in direction d: `lower` receives the lower half, c keeps the upper one. */
void form_split(double *c, int m, int n, int d, double *lower);

/* The part from lo to hi, in [0, 1], in direction d; what doing so in both directions rounds off. */
void form_part(double *c, int m, int n, int d, double lo, double hi);
double form_part_error(const double *c, int m, int n);

void form_range(const double *c, size_t count, double *lo, double *hi);

/*
 * What is known of a form's coefficients (those not scaled): none is larger than `size`, none
 * further than `error` from the exact one. Outward: what computing these two rounds off is less
 * than the places where they are generous.
 * Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., chapter 3.
 */
struct bound {
	double size, error;
};

#define UNIT_ROUNDOFF 1.1102230246251565e-16

struct bound bound_sum(struct bound a, double weight, struct bound b);

/* Of a product of degrees m x n, as form_product makes it from scaled forms, and scaled back. */
struct bound bound_product(struct bound a, struct bound b, int m, int n);

/* .. where no coefficient is a sum of more than so many products. */
struct bound bound_product_of(struct bound a, struct bound b, double terms, int m, int n);

/* Largest coefficient. */
double form_most(const double *c, size_t count);

/* Value and derivatives. */
void form_evaluate(const double *c, int m, int n, double u, double v, double *f, double *fu,
                   double *fv);

/* .. of four numbers each. */
void form_evaluate4(const double *c, int m, int n, double u, double v, double f[4], double fu[4],
                    double fv[4]);

#endif
