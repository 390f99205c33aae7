/* bench_march.h - curves f = value by marching over a mesh: what one would write in an afternoon. */
#ifndef BATTEN_BENCH_MARCH_H
#define BATTEN_BENCH_MARCH_H

#include "level.h"
#include "peer.h"

struct march; /* a mesh of a surface, with f in its vertices */

/* Ends the program where there is no memory. f: the field, its value taken as 0. */
struct march *march_create(const struct surface *s, const struct level_field *f);
void march_destroy(struct march *m);

/* How many curves f = value has on the mesh. `place` may be NULL: two places of each segment. */
int march_curves(struct march *m, double value, peer_place *place, void *data);

#endif
