/* level_chain.h - ends of branches on several faces, and which of them may meet. Private to this
 * folder. */
#ifndef BATTEN_LEVEL_CHAIN_H
#define BATTEN_LEVEL_CHAIN_H

#include "level_border.h"

enum { END_FEET = 8 };

struct joiner {
	const struct level_faces *faces;
	const struct level_joining *how;
	double size;
};

/* Where a branch begins (even k) or ends (odd k); k / 2 counts the branches of all faces. */
struct chain_end {
	size_t k, branch;
	int face;
	bool closed;            /* the branch has no ends */
	bool crossing;          /* others of its own face end here, too, at a crossing */
	bool inside;            /* not on the border of its face */
	bool crease;            /* another face is beyond the border, and its normal is another */
	bool node;              /* it ends here, with others */
	double reach;           /* how far the end may be that it is joined to */
	double length;          /* of its branch */
	struct vec3 p, out, at; /* place; unit, out of the branch; the crossing's middle */
	double uv[2];
	int own; /* among the feet: that on its own face's border; -1 */
	int n_feet;
	struct border_foot feet[END_FEET]; /* within the gap */
};

double faces_size(const struct level_faces *f);

/* Two for each of the n branches of all faces; *out is fresh. Errors: ST_RESOURCE. */
enum status chain_ends_make(const struct joiner *j, const struct level_result *results, size_t n,
                            struct chain_end **out);

/* May the curve that ends in a go on in b, which is at that distance and within reach of both? */
bool chain_ends_meet(const struct joiner *j, const struct chain_end *a, const struct chain_end *b,
                     double distance);

#endif
