/* level_private.h - what the files of the tracer share.
 *
 * Words: a cell is a box in a patch, made by halving; an arc the part of a curve in one certified
 * cell; a piece one cubic of it; a strand all arcs of a patch that hang together; a branch all
 * strands of the surface that do. u and v in a patch run over [0, 1].
 */
#ifndef BATTEN_LEVEL_PRIVATE_H
#define BATTEN_LEVEL_PRIVATE_H

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "level.h"
#include "level_form.h"

enum {
	NORMAL_DEGREE_MAX = 3 * (ORDER_MAX - 1) - 1,
	FIELD_DEGREE_MAX = 4 * NORMAL_DEGREE_MAX, /* of lines of curvature; of others half */
	CELL_DEPTH_MAX = 24,                      /* smallest cell: 2^-24 of a patch */
	N_SCRATCH = 2 * CELL_DEPTH_MAX + 2,
	LINE_BITS = CELL_DEPTH_MAX, /* a line in a patch is a multiple of 2^-24 */
};

/* Normals that differ by less over a knot line make no crease: 0.06 degrees, what CAD systems call
 * tangent. */
#define SMOOTH_ANGLE 1e-3

/* Where all coefficients are below this share of the field's terms, f counts as zero. */
#define ZERO_SHARE 1e-12

/* What lies between two patches, or between a patch and nothing. */
enum edge_kind {
	EDGE_BORDER, /* the surface ends */
	EDGE_SHARED, /* both sides have the same coefficients there, to the bit */
	EDGE_SMOOTH, /* same normals, other coefficients (geometric continuity, rounded data) */
	EDGE_CREASE, /* normals differ, at least somewhere on it */
	EDGE_GAP,    /* the patches do not meet */
	EDGE_POLE,   /* the surface ends in one point */
};

/* Bounds over a patch: weights, reach from the first point, first and second (uu, uv, vv)
 * derivatives of S. */
struct patch_shape {
	double weight[2], radius, first[2], second[3];
};

/* Chebyshev's nodes, Hermite's polynomials there (four of four nodes), and the cosines that take values in the nodes to
 * coefficients. */
enum { PROOF_NODES = 12, PROOF_GROUPS = PROOF_NODES / 4 };
struct proof_tables {
	double t[PROOF_GROUPS][4], h[PROOF_GROUPS][4][4]; /* node j is in group j % PROOF_GROUPS */
	double cosine[PROOF_NODES][PROOF_NODES / 2];
};

struct root_tables; /* level_root.h */

/* What does not depend on the value: net, normals, edges. */
struct level_surface {
	struct bezier_net net;
	enum level_kind kind;
	enum quantity quantity;          /* LEVEL_CURVATURE */
	double frame[3][3];              /* rows: right-handed, the last along the direction */
	double point[3], eye[3], gap[3]; /* of the field, in `frame`; gap: point - eye */
	int degree[2];                   /* of the normals' components */
	double *normals; /* owned; a patch (degree + 1)^2 x 4, in `frame`, the fourth 0 */
	unsigned char
	        *edges[2];    /* owned; edges[0]: (spans[0] + 1) x spans[1], lines u = breaks[0][i];
	                            edges[1]: spans[0] x (spans[1] + 1), lines v = breaks[1][j] */
	double reach, weight; /* largest |w S| and w of the control points */
	double extent[3];     /* largest |w x|, |w y|, |w z| of the control points */
	struct bound of_points, of_weights; /* any component of w S; w */
	double far,
	        steps; /* largest |S| of the control points; roundings of a Bezier point, relative */
	unsigned char *factors; /* owned; four a patch: how often a factor was taken out of the
	                               normals on side 2 d + upper */
	struct root_tables
	        *root;        /* owned; NULL where not needed: curvatures and oblique isophotes */
	double *normal_error; /* owned; one a patch: of each component's coefficients */
	struct patch_shape *shapes; /* owned; one a patch */
	struct proof_tables proof;
	unsigned char *bent[2];    /* owned; like edges: derivatives of f may jump there */
	double *binomial;          /* owned; triangle of rows, see binomial_row */
	double *heights;           /* owned; LEVEL_PLANE: direction . (w S) of each control point */
	double (*height_range)[2]; /* owned; .. of each patch where S is not rational */
};

struct level {
	struct level_surface *surface;
	bool owner;          /* of surface; else it belongs to the level this one is like */
	double direction[4]; /* unit; plane: n and -d */
	double value, sine;  /* isophote: cosine and sine of the angle */
	bool oblique;        /* an isophote so near 90 degrees that f is linear in the normal */
	bool side;     /* f is a difference of squares, and a condition tells which root is meant */
	int degree[2]; /* of f */
	int side_degree[2];             /* of the side condition */
	double tolerance, tolerance_uv; /* in space; in the surface's parameters, INFINITY: any */
	struct bound plane;             /* LEVEL_PLANE: of f */
};

/* Kernels are built for wider vectors, too. Nothing is fused, so all give the same bits. (clang 14
 * emits such functions under a name that other files do not find.) */
#if defined(__x86_64__) && !defined(__clang__)
#define WIDE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define WIDE
#endif

/* Without the care for NaN that keeps fmax and fmin a call. */
static inline double larger(double a, double b)
{
	return a > b ? a : b;
}

static inline double smaller(double a, double b)
{
	return a < b ? a : b;
}

/* Where hypot's care for overflow costs too much. */
static inline double length2(double x, double y)
{
	return sqrt(x * x + y * y);
}

static inline struct vec3 vec3_of(const double p[3])
{
	return vec3(p[0], p[1], p[2]);
}

/* How f is made: its degree in the normal and in X = (w S, w). */
struct level_shape {
	unsigned char normal[2], point[2]; /* [value is not 0] */
	bool line, valued;                 /* has a direction; a value */
	bool side;                         /* has a side condition where the value is not 0 */
	bool several;                      /* is made in level_kind.c or level_curvature.c */
};
extern const struct level_shape level_shapes[N_LEVEL_KINDS];

static inline bool level_needs_normals(enum level_kind kind)
{
	return level_shapes[kind].normal[1] > 0;
}

size_t level_edge(const struct level_surface *s, int d, int i, int j);

/* of_points and of_weights on one patch: a mean of positive numbers is right to its own size. */
void level_patch_bounds(const struct level_surface *s, const double *points,
                        struct bound *of_points, struct bound *of_weights);

static inline size_t level_normals_size(const struct level_surface *s)
{
	return (size_t)4 * (s->degree[0] + 1) * (s->degree[1] + 1);
}

/* C(n, 0 .. n) */
static inline const double *binomial_row(const double *triangle, int n)
{
	return triangle + (size_t)n * (n + 1) / 2;
}

/* level_normal.c, level_edge.c */
enum status level_normals(struct level_surface *s);
enum status level_edges(struct level_surface *s); /* Errors: ST_RESOURCE */

/* The normals on both sides of edge (d, line, along), at `at` on it, make no crease there. */
bool level_smooth_at(const struct level_surface *s, int d, int line, int along, double at);

/* level_roots.c: polynomials in one variable, Bernstein coefficients c[0 .. n]; zero counts as
 * positive. */
bool root_single(const double *c, int n, double *t); /* one sign change: its place */
int roots_find(const double *c, int n, double *t);   /* all, rising; t holds n + 2 */

/* A list that grows; a failed one stays failed and holds what it had. It may begin in memory that is not its own. */
struct list {
	void *p;
	size_t n, cap;
	bool failed, lent; /* lent: p is not to be freed */
};
bool list_reserve(struct list *l, size_t more, size_t size);
void list_finish(struct list *l);

/* Room for one more, not cleared, or NULL. */
static inline void *list_next(struct list *l, size_t size)
{
	if (l->n == l->cap && !list_reserve(l, 1, size))
		return NULL;
	return (char *)l->p + size * l->n++;
}

static inline void *list_add(struct list *l, size_t size) /* cleared */
{
	void *p = list_next(l, size);
	return p ? memset(p, 0, size) : NULL;
}

/* One cubic in u,v and in space over t in [0, 1]: ends and tangents. */
struct piece {
	double uv[2][2], duv[2][2]; /* [end][u or v], in the patch */
	double p[2][3], dp[2][3];
	/* no point of both is further from the exact curve; the one in u,v, in the surface's parameters */
	double error, error_uv;
};

struct arc {
	int first, n;
};

/* Where an arc touches the border of its cell. */
struct arc_end {
	int line;               /* of the patch, in 2^-LINE_BITS */
	int arc, end;           /* which, and which of its two ends */
	unsigned char d, upper; /* line u = const (0) or v = const (1); cell above the line */
	double at;              /* the other parameter */
};

struct cell {
	int level[2];      /* size 2^-level */
	unsigned index[2]; /* lower corner index x size */
	double error;      /* of the coefficients: what is less has no certain sign */
	int made;          /* the sum of levels at which f was made */
};

struct undecided {
	int level[2], index[2], flat, graze;
};

/* level_umbilic.c: on a patch. UMBILIC_FLAT: a, b, c there are zero up to rounding. */
enum umbilic_kind { UMBILIC_ONE, UMBILIC_POLE, UMBILIC_FLAT, UMBILIC_UNSURE, N_UMBILIC_KINDS };
struct umbilic {
	double lo[2], hi[2], at[2];
	int kind,
	        turn; /* turn: how principal directions turn about it, 1 with, -1 against; 0 not known */
};

/* Work on one patch. */
struct tracer {
	const struct level *level;
	int patch, place[2];
	bool bent[2][2]; /* its side (d, upper) is one where derivatives of f may jump */
	const double *points, *normals;
	double *field;          /* coefficients of f */
	size_t n_field, n_side; /* coefficients of f, and of the side condition behind them */
	bool own_field;         /* f is evaluated from `field` (a factor was taken out) */
	bool cleaned;           /* a side of rounding became zero */
	int n_again;            /* how often f was made once more */
	struct bound bound; /* of f in the cell; its size that of the terms that f is a sum of */
	double field_error; /* of `field` */
	double side_error;
	double most; /* largest coefficient of f */
	struct list arcs, pieces, ends, undecided, umbilics;
	double *scratch[N_SCRATCH]; /* cells on the way down, one array a depth */
	double *product;            /* room for scaled factors of a product */
	size_t n_product;           /* used of it */
	double *room;               /* what is left of the memory on the stack */
	size_t n_room;
	const double *stack; /* all of it */
	const struct level_stop *stop;
	bool failed;  /* memory ran out, or stopped */
	bool stopped; /* was asked to */
};

/* Before every step that takes long: is there no sense in going on? */
static inline bool tracer_ends(struct tracer *t)
{
	if (!t->failed && t->stop && t->stop->asked(t->stop->data))
		t->stopped = t->failed = true;
	return t->failed;
}

/* level_field.c: what LEVEL_PLANE prepares. Errors: ST_RESOURCE. */
enum status level_plane_prepare(struct level_surface *s);
void level_plane_bound(struct level *l);
bool level_plane_misses(const struct level *l,
                        size_t patch); /* a quick look; never of other kinds */

/* level_field.c: false where the patch holds no curve. `out`: f, then the side condition. */
bool level_field_make(struct tracer *t, double *out);

/* X = (w S, w) and the normal, with their derivatives in u and v. */
struct field_jets {
	double x[3][4], n[3][4];
};

struct field_point {
	double f, fu, fv;
	double p[3], su[3], sv[3];
};
void level_field_at(const struct tracer *t, double u, double v, struct field_point *out);

/* level_kind.c: the kinds that are products of several forms. `out` receives f and the side
 * condition; false where there is no curve. */
bool level_kind_make(struct tracer *t, double *out);
void level_kind_at(const struct level *l, const struct field_jets *j, struct field_point *out);
size_t level_kind_room(const struct level *l);

/* level_curvature.c: the degrees of f and of the side condition; f on a patch. */
void level_curvature_degree(struct level *l);
bool level_curvature_make(struct tracer *t, double *out);
size_t level_curvature_room(const struct level *l);

/* level_umbilic.c */
void level_umbilics_find(struct tracer *t);

/* level_curvature.c: the mean curvature, in a place of a patch. Errors: ST_RESOURCE. */
enum status level_mean_at(const struct level_surface *s, int patch, const double uv[2],
                          double *mean);

/* Gaussian and mean curvature agree on both sides of the edge between two patches, at n places on it.
 * Errors: ST_RESOURCE. */
enum status level_curvature_agrees(const struct level_surface *s, const int patch[2], int d,
                                   const double *at, int n, bool *agrees);

/* level_net.c: degree 1 to 2 in direction d; halve these spans of it. Errors: ST_RESOURCE. */
enum status level_net_raise(struct bezier_net *net, int d);
enum status level_net_halve(struct bezier_net *net, int d, const bool *spans);
enum status level_net_even(struct bezier_net *net); /* halve where weights are far apart */

/* level_cell.c: nothing is known of the whole patch; `flat`: it has no normals. */
void level_patch_undecided(struct tracer *t, bool flat);

/* level_patch.c: n doubles, from the room or fresh; NULL: t->failed. */
double *level_room(struct tracer *t, size_t n);
void level_room_free(const struct tracer *t, double *p);

/* level_field.c: the normal's components on the tracer's patch. */
struct bound level_normal_bound(const struct tracer *t);

/* level_cell.c */
void level_search(struct tracer *t, double *c);

/* level_arc.c */
struct cell_range {
	double lo[2], hi[2];
};
/* c: f in the cell, and its error. */
void level_arc_follow(struct tracer *t, const struct cell_range *box, const double *c, double error,
                      int along, bool rising, const double ends[2][2]);

/* level_prove.c */
void level_shape_of_patch(const double *points, int m, int n, struct patch_shape *out);

/* Bounds that hold for all pieces of one cell. */
struct prover {
	const struct tracer *t;
	const struct patch_shape *shape;
	struct cell_range box;
	bool rational;
	double second[3],
	        spread[3]; /* second derivatives of f in the cell: the middle and how far from it */
	double error;      /* of f, where it is evaluated */
	double width[2];   /* of the patch, in the surface's parameters */
	double diameter, diameter_uv; /* of the cell, in space and in those parameters */
};

/* How far a piece may be from the exact curve: in space; the one in u,v in the surface's parameters.
 * `rounding`: the part that comes from the rounding of f, and stays however short the piece. */
struct proof {
	double space, uv, rounding[2];
	double used; /* which part of the tolerances, as far as known where nothing is proved */
	bool bent;   /* nothing is proved because f bends too much */
};
void level_prover_init(struct prover *p, const struct tracer *t, const struct cell_range *box,
                       const double *c, double error);

/*
 * A place near the middle of a piece: the step across the curve that changes f by 1, in u,v and in
 * space; and how the parameter in space is taken to that in u,v, t + t (1 - t) (match[0] + match[1] (1 - 2 t)
 * + match[2] t (1 - t)).
 */
struct proof_middle {
	double uv[2], across[2], step[3], match[3];
};

/* A point of the curve, with unit tangent in space. */
struct station {
	double uv[2], duv[2]; /* unit speed in space */
	double p[3], dp[3];
};

/*
 * level_fit.c: cubics between two points of the curve. `uv`: a place next to the curve's middle. False where
 * they lead out of the patch.
 */
bool level_fit(const struct tracer *t, const struct station *a, const struct station *b,
               double length, struct piece *x, struct proof_middle *mid, double uv[2]);

/* mid->uv set: the rest but how the parameters match. */
void level_fit_middle(const struct tracer *t, struct proof_middle *mid);

/* level_sample.c */
void level_proof_tables(struct proof_tables *p);

/* w (P - S + f M), M the step across, and f in the nodes of groups from .. to. */
void level_sample(const struct prover *p, const struct piece *x, const struct proof_middle *mid,
                  int from, int to, double out[PROOF_NODES][4]);

/* Sums of the Chebyshev coefficients' sizes. */
void level_sample_sums(const struct proof_tables *table, const double v[PROOF_NODES][4],
                       double out[4]);

/* False where nothing is known but out->used. */
bool level_prove(const struct prover *p, const struct piece *x, const struct proof_middle *mid,
                 struct proof *out);

/* A cell in which a curve is a graph over direction `along`, f rising in the other or falling; f there. */
struct strip {
	const struct cell_range *box;
	const double *c;
	const int *degree;
	double error;
	int along;
	bool rising;
};

/* level_strip.c: in the other direction the curve between two of its points is between these; false where one is only
 * the cell's border. */
bool level_strip_bound(const struct strip *s, const double a[2], const double b[2], double out[2]);

/* Ends of a strand on the border of its patch, or loose inside. */
enum strand_end_kind { STRAND_BORDER, STRAND_LOOSE, STRAND_CLOSED };
struct strand_end {
	int kind;
	int d, upper; /* side of the patch: d = 0: u = 0 or 1 */
	int unused;
	double at;
};
struct strand {
	int first, n; /* pieces */
	struct strand_end end[2];
};

/* level_patch.c: what a patch's bytes begin with; strands, pieces, undecided, umbilics follow. */
struct patch_header {
	char magic[8]; /* level_join refuses others */
	int patch, n_strands, n_pieces, n_undecided, n_umbilics, unused;
};
#define PATCH_MAGIC "level 4"

/* level_join.c: the header of one patch's bytes at *at, behind `last` of all `patches`; false where they are
 * not whole. And whether a strand of it is one. */
bool level_header_read(size_t patches, const char **at, const char *end, int last,
                       struct patch_header *h);
bool level_strand_valid(const struct strand *s, const struct patch_header *h);

enum link_kind { LINK_NONE, LINK_STRAND, LINK_END };

/* Where a strand's end leads. An end is 2 strand + 0 or 1. */
struct link {
	enum link_kind kind;
	size_t other; /* the end it meets */
	bool cut;     /* u or v jumps there: a seam or a pole */
	bool on_edge; /* both lie on one edge: a gap between them is bridged along it */
	int mark;     /* LINK_END: where it ends, counted from 1 */
};

struct patch_umbilic {
	struct umbilic x; /* in the patch */
	int patch;
};

/* All patches' strands in one array. */
struct joint {
	const struct level *level;
	struct strand *strands; /* owned; `first` counts in `pieces` */
	int *patch;             /* owned; of each strand */
	struct piece *pieces;   /* owned */
	size_t n_strands, n_pieces;
	struct link *links;            /* owned, 2 a strand */
	struct list boxes;             /* struct level_box, undecided */
	struct list umbilics;          /* struct patch_umbilic */
	const struct level_box *marks; /* what they became */
};

/* A strand's end: place in space, unit tangent out of the strand, surface parameters. */
struct joint_end {
	double p[3], tangent[3], uv[2];
};
void joint_end_get(const struct joint *j, size_t end, struct joint_end *out);
void piece_reverse(struct piece *p);

/* From the lower to the upper end of the surface's parameter. */
static inline double level_range(const struct level_surface *s, int d)
{
	return s->net.breaks[d][s->net.spans[d]] - s->net.breaks[d][0];
}

/* A parameter of the surface from that of a patch, and its breaks. */
static inline double level_global(const double *breaks, double x)
{
	const double lo = breaks[0], hi = breaks[1];
	return x <= 0.5 ? lo + (hi - lo) * x : hi - (hi - lo) * (1 - x);
}

/* Parameters of the surface from those of the patch. */
void level_globalise(const struct level_surface *s, int patch, const double uv[2], double out[2]);

/* level_link.c: fill joint->links; ends that meet nothing leave a box. Errors: ST_RESOURCE. */
enum status level_link(struct joint *j);

/* level_branch.c: one branch from the ends by which its strands are entered. Errors: ST_RESOURCE. */
enum status level_branch_make(const struct joint *j, const size_t *entries, size_t n, bool closed,
                              struct level_branch *out);

/* level_region.c: boxes that touch become one, of one kind; say which strands end there. Errors:
 * ST_RESOURCE. */
enum status level_regions(struct joint *j, struct level_result *out);

/* Boxes that touch, over seams, too, as one each. *out is the caller's. Errors: ST_RESOURCE. */
enum status level_boxes_unite(const struct level_surface *s, struct level_box *b, size_t n,
                              struct level_box **out, size_t *n_out);

/* level_umbilics.c: those of all patches; before level_regions. Errors: ST_RESOURCE. */
enum status level_umbilics_join(struct joint *j, struct level_result *out);

/* The umbilic that the box is about; NULL: none, or several. */
const struct level_umbilic *level_umbilic_in(const struct level_surface *s,
                                             const struct level_result *x,
                                             const struct level_box *b);

/* Branches that reach such a mark end in one point there, if they can. */
static inline bool level_mark_joins(enum level_mark kind)
{
	return kind == LEVEL_CROSSING || kind == LEVEL_SINGULAR || kind == LEVEL_UMBILIC;
}

/* level_region.c: the place in a patch that has u, v, and which it is; a place beyond a seam at the lower end. */
int level_patch_at(const struct level_surface *s, const double uv[2], double out[2]);
void level_into_domain(const struct level_surface *s, double uv[2]);

/* The point of the surface at u, v. */
void level_point_at(const struct level_surface *s, const double uv[2], double p[3]);

#endif
