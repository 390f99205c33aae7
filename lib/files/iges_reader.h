/* iges_reader.h - what the files of the IGES reader share.
 *
 * The reader works on the file's own bytes: an index holds where each line of the directory (D) and
 * of the parameter data (P) begins, and a cursor walks over the 64 columns of data of P lines, a copy of
 * one at a time.
 * Sections, columns and field numbers are those of IGES 5.3 (US PRO, 1996), section 2.2.
 */
#ifndef BATTEN_IGES_READER_H
#define BATTEN_IGES_READER_H

#include <stdint.h>

#include "iges.h"
#include "iges_bytes.h"

enum {
	DATA_COLUMNS = 64,   /* of a P line; the rest is the back pointer, letter and number */
	HEADER_COLUMNS = 72, /* of an S or G line */
	LETTER_COLUMN = 72,  /* from 0 */
	LINE_MOST = 4096,    /* bytes of a line that are looked at */
	DATA_MOST = 256,     /* bytes of 64 columns, where characters take several */
	NESTING_MAX = 16,    /* entities made of entities made of ... */
	ENTRIES_BLOCK = 512,
};

struct iges_header {
	char delimiter, record;
	int unit_flag;
	double resolution; /* smallest distance that matters to the author, 0: not said */
};

/* Where lines begin: lines of one length are one run, as nearly all files have them. */
struct iges_lines {
	struct line_run {
		size_t at; /* of its first line, bytes */
		int first; /* that line's place, from 0 */
		unsigned stride;
	} * runs;      /* owned */
	int n_runs, n; /* lines in all */
	int last;      /* the run last asked for */
};

/* A directory entry. Its number is 2 i + 1 for entry i. */
struct iges_entry {
	int type, form;
	int data;      /* its first P line, from 1 */
	int lines;     /* how many P lines it says it has */
	int transform; /* directory entry of its 124, or 0 */
	int color;     /* 1 .. 8, or minus the directory entry of a 314 */
	int subscript;
	char label[8]; /* filled up with zeros */
	bool blanked;
	bool used;         /* another entity is made of it */
	bool pointed_even; /* by the number of its second line */
	bool reached;      /* a face, shell, solid or instance that has been placed */
	bool wanted;       /* named as transform or color */
	char state;        /* of a definition, while it is looked for circles */
	int uses;          /* last of its uses, in uses[], -1: none */
	int group;         /* in group_names[], of which it is a member; -1: of none with a name */
	int place;         /* in the model, of what was read of it, from 1; 0: nothing */
	int first_edge;    /* in bounds[]: curves that bound the faces on it; -1: none */
};

/* What shows a surface, a curve or points: a face that lies on it, an instance of a subfigure. */
struct iges_use {
	int face;   /* directory entry of the 143, 144 or 510, 0: none */
	int via;    /* of the outermost 408, 0: none */
	int matrix; /* in matrices[], -1: it stays where it is */
	int loops;  /* of the face */
	int next;   /* the use before this one, -1: none */
};

struct iges_bound {
	int de, next; /* a curve */
};

/* Kinds of warning that are counted and said once. */
enum iges_warning {
	WARN_RANGE_IGNORED,
	WARN_RANGE_CUT,
	WARN_RANGE_MISSING,
	WARN_BLANKED,
	WARN_BACK_POINTER,
	WARN_WEIGHTS,
	WARN_RULED,
	WARN_OFFSET,
	WARN_SEQUENCE,
	WARN_TWO_COURSES,
	WARN_PARAMETERS,
	WARN_FAR,
	WARN_UNPLACED,
	WARN_EVEN,
	WARN_LENT,
	WARN_FLAG,
	WARN_REPEATED,
	WARN_NESTING,
	WARN_OUTSIDE,
	WARN_ISLAND,
	N_IGES_WARNINGS,
};

/* An edge list (504): the curve of each edge. */
struct iges_edges {
	int list, n; /* its directory entry, 0: none loaded */
	int *curves; /* owned */
};

struct iges {
	struct iges_bytes bytes;
	const char *name;   /* of the file, borrowed */
	size_t stride;      /* bytes a line where no line ends are in the file, else 0 */
	char line_end;      /* '\n' or '\r' */
	bool odd_lines;     /* some P lines have their letter elsewhere than in column 73 */
	struct text global; /* G section */
	struct iges_lines d_lines, p_lines;
	int n_d, n_p;
	char terminate[HEADER_COLUMNS + 1]; /* T line; "" if there is none */
	struct iges_header header;
	/* owned; ENTRIES_BLOCK in each, NULL: all have been read and nothing refers to them */
	struct iges_entry **entries;
	int n_entries;
	int *first_lines; /* owned; by back pointer: first P line of each entry, from 1; or NULL */
	struct iges_use *uses;     /* owned */
	struct iges_bound *bounds; /* owned */
	double (*matrices)[3][4];  /* owned */
	int n_uses, n_bounds, n_matrices;
	char **group_names; /* owned */
	int n_groups;
	int64_t budget; /* P lines that may still be read on behalf of other entities: keeps files
	                   that refer to themselves in ever more ways from taking ever more time */
	int64_t copies; /* P lines whose entities instances may still repeat */
	uint64_t steps; /* P lines read */
	int far;        /* the last P line reached, for progress */
	struct {
		int count, first, last;
		double error; /* the largest, of what is approximated */
	} warned[N_IGES_WARNINGS];
	struct iges_edges edges; /* the list last looked at */
	struct {
		int count;
		char first[512];
	} mended;          /* notes on trims */
	struct model more; /* entities that come after the others: copies, curves on surfaces */
	bool quiet;        /* a first look: warnings are said at the second */
	int at;            /* the entity at hand, which warnings are about; 0: none */
	char reason[1024]; /* why the entity at hand cannot be read */
	struct report_store store; /* where kernel functions leave their sentence */
	struct model *m;
	const struct progress *progress;
	const struct report *r;
};

/* iges_lines.c. Errors: ST_INPUT (compressed or binary form, no T line), ST_RESOURCE. */
enum status iges_index(struct iges *g);
void iges_lines_finish(struct iges_lines *l);
/* Where line i (from 0) begins. */
size_t iges_lines_at(struct iges_lines *l, int i);
/* Data columns of P line i (from 0) into `out`; how many bytes. */
int iges_line(struct iges *g, int i, char out[DATA_MOST]);
/* The directory entry that P line i says it belongs to; 0 if it cannot be read. */
int iges_back_pointer(struct iges *g, int i);

/* iges_header.c: delimiters, unit and scale into g->header and g->m. Errors: ST_RESOURCE. */
enum status iges_read_header(struct iges *g);

/* iges_directory.c. Errors: ST_RESOURCE. */
enum status iges_read_directory(struct iges *g);
/* By the number of either of its lines; NULL where there is none, or none any more. */
struct iges_entry *iges_entry(struct iges *g, int de);
/* Curves up to entry i (from 0) have been read, points too if it says so: give up the block that ends there
 * if nothing refers to it. */
void iges_leave_entries(struct iges *g, int i, bool points);
void iges_finish_directory(struct iges *g);
/* The number of the first line; that it was the second's is told. */
int iges_mend_pointer(struct iges *g, int de);
void iges_warn(struct iges *g, enum iges_warning w, int de);
/* Of an approximation, with the error that it has. */
void iges_warn_error(struct iges *g, enum iges_warning w, int de, double error);
enum status iges_say_warnings(struct iges *g);

/* iges_cursor.c: parameters of one entity, one after the other. */
struct iges_cursor {
	struct iges *g;
	int de, line, last;  /* P lines from 0: at hand, the last that the entry counts */
	const char *s, *end; /* in text */
	char text[DATA_MOST];
	bool ended;     /* the record delimiter has been met */
	size_t missing; /* parameters asked for that are empty or behind the end */
	enum status st; /* a cursor that has failed stays failed */
};

/* Open entity `de`, behind its type number. type 0: any. Errors: ST_INPUT with g->reason,
 * ST_CANCELLED. */
enum status iges_open(struct iges *g, int de, int type, struct iges_cursor *c);
/* Likewise of any type, `depth` entities down from the one that is read. */
enum status iges_open_nested(struct iges *g, int de, int depth, struct iges_cursor *c);
double iges_real(struct iges_cursor *c); /* 0 where missing */
int iges_int(struct iges_cursor *c);
/* A count or an index: fails outside lo .. hi. */
int iges_count(struct iges_cursor *c, const char *what, int64_t lo, int64_t hi);
/* The next curve of a 102; points between curves carry no shape. False: c has failed, or it is a point. */
bool iges_part(struct iges_cursor *c, int *de);
/* n reals to out, `group` at a time, groups `stride` doubles apart. Missing ones fail. */
void iges_reals(struct iges_cursor *c, double *out, size_t n, int group, size_t stride);
/* n reals of an entity with so many; empty ones are 0, as the standard has it. */
void iges_few(struct iges_cursor *c, double *out, int n);
void iges_string(struct iges_cursor *c, struct text *out);
/* The most parameters that can follow. */
int64_t iges_left(const struct iges_cursor *c);
/* Fail for that reason unless failed already; gives the status. */
enum status iges_fail(struct iges_cursor *c, const char *format, ...)
        __attribute__((format(printf, 2, 3)));
/* Likewise without a cursor. */
enum status iges_refuse(struct iges *g, const char *format, ...)
        __attribute__((format(printf, 2, 3)));
/* Pass a failure on as ST_INPUT, a kernel function's sentence as the reason if it left one. */
enum status iges_pass(struct iges *g, enum status st);

/* iges_uses.c: which entities are parts of others. Errors: ST_RESOURCE, ST_CANCELLED. */
enum status iges_find_uses(struct iges *g);
/* The curve of edge `index` (from 1) of the list 504, 0 if it has no such edge. Errors: ST_INPUT. */
enum status iges_edge(struct iges *g, int list, int index, int *curve);

/* iges_place.c: which faces lie on which surface, what instances of subfigures show, and where.
 * Errors: ST_RESOURCE, ST_CANCELLED. */
enum status iges_place(struct iges *g);
bool iges_is_face(const struct iges_entry *e);
bool iges_is_group(const struct iges_entry *e);

/* iges_names.c: the label of entry `de` or its property as the name, its color; what is bad or not
 * there leaves them empty. `c` stands behind the entity's own parameters.
 * Errors: ST_RESOURCE, ST_CANCELLED. */
enum status iges_name_behind(struct iges_cursor *c, struct entity *out);
enum status iges_name(struct iges *g, int de, struct entity *out);
enum status iges_color(struct iges *g, int de, struct entity *out);

/* iges_groups.c: which groups (402) have names, and what is in them. Errors: ST_RESOURCE,
 * ST_CANCELLED. */
enum status iges_find_groups(struct iges *g);
/* The name of the group of entry `de` as the attribute "group", unless there is one. */
enum status iges_group(struct iges *g, int de, struct entity *out);
void iges_finish_groups(struct iges *g);

/* iges_faces.c: the uses of an entity that has been read: its trims, its place, its copies (to
 * g->more). Errors: ST_RESOURCE, ST_CANCELLED. */
enum status iges_show(struct iges *g, int de, struct entity *out);
/* A 142 that no face uses. Errors: also ST_INPUT with g->reason. */
enum status iges_curve_on_surface(struct iges *g, int de, struct entity *out);

/* iges_loops.c: the loops of face `de` on surface `base` as it stands without the face's place.
 * Loops that are lost are counted. Errors: ST_INPUT with g->reason, ST_RESOURCE, ST_CANCELLED. */
enum status iges_trim(struct iges *g, int de, int base, const struct surface *s, struct trim *out);
/* Curves of a 142, in u,v and in space. */
enum status iges_trim_curves(struct iges *g, int de, const struct surface *s, struct trim_loop *uv);

/* iges_transform.c: the matrix of an entry's 124 and all that those refer to. */
enum status iges_matrix(struct iges *g, int transform, double m[3][4], bool *any);
/* a = b after a. */
void iges_multiply(const double b[3][4], double a[3][4]);
enum status iges_point_at(struct iges *g, int de, struct vec3 *p);     /* a 116 */
enum status iges_direction_at(struct iges *g, int de, struct vec3 *d); /* a 123 */

/* iges_curves.c, iges_splines.c, iges_surfaces.c, iges_planes.c: entities as NURBS, 124 applied.
 * `c` may be NULL; else it is left behind the entity's own parameters. */
enum status iges_curve(struct iges *g, int de, int depth, struct curve *out, struct iges_cursor *c);
enum status iges_surface(struct iges *g, int de, int depth, struct surface *out,
                         struct iges_cursor *c);
enum status iges_points(struct iges *g, int de, struct point_list *out, struct iges_cursor *c);
/* The distance within which pieces of an entity of that size join. */
double iges_tolerance(const struct iges *g, double size);
bool iges_is_curve(const struct iges_entry *e);
bool iges_is_surface(const struct iges_entry *e);
bool iges_is_points(const struct iges_entry *e);

enum status iges_spline_curve(struct iges_cursor *c, struct curve *out);
enum status iges_spline_surface(struct iges_cursor *c, struct surface *out);
enum status iges_plane(struct iges_cursor *c, int depth, struct surface *out);
enum status iges_ruled(struct iges_cursor *c, int depth, struct surface *out);

#endif
