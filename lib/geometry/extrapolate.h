/* extrapolate.h - the limit at 0 of a smooth function known only beside it. Private to this folder. */
#ifndef BATTEN_EXTRAPOLATE_H
#define BATTEN_EXTRAPOLATE_H

enum { EXTRAPOLATE_NODES = 9 };

/* Where to take the function, as parts of the room there is: 1/4, 1/8, ... */
double extrapolate_node(int k);

/*
 * Value at 0 from f[k] at extrapolate_node(k), n of them. *error bounds it if f is smooth; it is
 * large where f has no limit. NaN and infinity where fewer than four values are numbers.
 * Source: Neville's scheme with the choice of the best entry, Ridders, Adv. Eng. Software 4 (1982).
 * Accuracy: 1e-10 of f where its Taylor series reaches over the room.
 */
double extrapolate(const double *f, int n, double *error);

#endif
