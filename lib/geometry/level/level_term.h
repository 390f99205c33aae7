/* level_term.h - the forms that a field is a sum of products of, with bounds of their errors. */
#ifndef BATTEN_LEVEL_TERM_H
#define BATTEN_LEVEL_TERM_H

#include "level_private.h"

/* A form in scaled coefficients, in the room that the tracer has for them. */
struct form {
	double *c;
	int m, n;
	struct bound b; /* of the coefficients before scaling */
};

static inline size_t form_count(int m, int n)
{
	return (size_t)(m + 1) * (n + 1);
}

/* One more, zero, in t->product; the kinds count how many they need. */
struct form form_new(struct tracer *t, int m, int n);

/* out += weight a b, of the same degrees. */
void form_add_product(struct form *out, struct form a, struct form b, double weight);
void form_add_square(struct form *out, struct form a, double weight);

/* out += weight a, a of the same degrees or lower. */
void form_add(struct tracer *t, struct form *out, struct form a, double weight);

/* Let the bound's size be that of the coefficients, not of the terms they are sums of. */
void form_tighten(const struct tracer *t, struct form *f);

/* The normal's component d. */
struct form form_normal(struct tracer *t, int d);

/* Of a component of X - from w in the frame. */
struct bound form_moved_bound(const struct tracer *t, const double from[3]);

/* X - from w, in the frame: three components and w. */
void form_points(struct tracer *t, const double from[3], struct form out[4]);

/* level_root.c: a polynomial for the normal's length, whose error bounds value and slopes; `square`
 * is N . N. False where there is no bound. */
bool level_root_form(struct tracer *t, const struct form *square, struct form *out);

#endif
