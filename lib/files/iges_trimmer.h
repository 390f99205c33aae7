/* iges_trimmer.h - a face at hand whose loops are read. Private to this folder. */
#ifndef BATTEN_IGES_TRIMMER_H
#define BATTEN_IGES_TRIMMER_H

#include "iges_course.h"
#include "project_curve.h"

/* A face being trimmed. */
struct trimmer {
	struct iges *g;
	int de; /* what the curves are of: the face, or a 142 */
	const struct surface *s;
	struct projector *p; /* owned */
	double size, tolerance;
	struct iges_course course[2]; /* owned; of the file's u and v */
	bool known, equal; /* the standard tells the file's parameters; they are those of s */
};

/* Errors: ST_RESOURCE, ST_CANCELLED. */
enum status iges_trimmer_init(struct trimmer *t, struct iges *g, int de, int base,
                              const struct surface *s);
void iges_trimmer_finish(struct trimmer *t);

/*
 * One stretch of a loop: n curves in u,v (0: none) or the one in space (0: none), whichever is of
 * use. Errors: ST_INPUT with g->reason, ST_RESOURCE, ST_CANCELLED.
 */
enum status iges_add_piece(struct trimmer *t, const int *uv, int n, int space, bool reversed,
                           struct trim_loop *loop);

/* The loop as a whole is brought into the domain. */
void iges_center_turns(const struct trimmer *t, struct trim_loop *loop);

/*
 * iges_nesting.c: which loops are outer ones. told: the file says it, and is believed where that
 * leaves something; else those that no other holds are. by_sense: on a closed surface loops that
 * run clockwise are holes in all of it. Errors: ST_RESOURCE.
 */
enum status iges_nest(const struct trimmer *t, bool told, bool by_sense, struct trim *trim);

#endif
