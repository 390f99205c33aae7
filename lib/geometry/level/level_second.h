/* level_second.h - derivatives up to the second and the normal of a patch, as forms.
 *
 * With X = (P, w): A = w Pu - wu P, B = w Pv - wv P (Pu and Pv where w = 1), Duu = w Puu - wuu P and so on.
 */
#ifndef BATTEN_LEVEL_SECOND_H
#define BATTEN_LEVEL_SECOND_H

#include "level_term.h"

enum { DU, DV, DUU, DUV, DVV, N_DERIVATIVES };

/* What the forms of a patch are made of, in the frame, from its first point. */
struct second_parts {
	struct form x[4], d[N_DERIVATIVES][3], n[3];
};
void second_parts_make(struct tracer *t, struct second_parts *p);

/* out += weight a b, of the same degrees; rubbish where the tracer ends. */
void second_add_product(struct tracer *t, struct form *out, struct form a, struct form b,
                        double weight);

/* Fresh forms; rubbish where the tracer ends. */
struct form second_dot(struct tracer *t, const struct form a[3], const struct form b[3]);
struct form second_product(struct tracer *t, struct form a, struct form b);

/* The form is zero on a side of the patch, up to rounding. */
bool second_side_zero(const struct tracer *t, const struct form *f, int d, bool upper);

#endif
