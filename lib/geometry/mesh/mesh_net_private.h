/* mesh_net_private.h - what the files of the triangulation of points share. Private to them. */
#ifndef BATTEN_MESH_NET_PRIVATE_H
#define BATTEN_MESH_NET_PRIVATE_H

#include <stddef.h>

#include "mesh_net.h"

/* The next corner of a triangle and the one before, counterclockwise. */
static const int net_turn_of[3] = { 1, 2, 0 }, net_back_of[3] = { 2, 0, 1 };

/* Room for n elements. Errors: ST_RESOURCE. */
enum status net_grow(void **p, int *room, int n, size_t size);

/* Twice the area of a b c: > 0 where c is left of a b. */
int64_t net_side(const struct net *x, int a, int b, int c);

/* d lies inside the circle through v, counterclockwise. */
bool net_in_circle(const struct net *x, const int v[3], int d);

/* The place of that vertex in t; -1: it is none of its corners. */
int net_corner_of(const struct net_triangle *t, int vertex);
/* The place in t of its neighbour `other`. */
int net_place_of(const struct net_triangle *t, int other);

/* Turn the edge across from corner i of t: t and its neighbour get the other diagonal. The new edge
 * is across from corner 0 of both. */
void net_flip(struct net *x, int t, int i);

#endif
