/* g2.c - reader of .g2: objects one after the other, each a header and numbers with blanks between.
 *
 * Source: GoTools (SINTEF), ClassType.h and the read functions of SplineCurve, SplineSurface,
 * PointCloud. A header is class, major and minor version, number of auxiliary integers, and those:
 * four of them are a color, red green blue alpha in 0 .. 255.
 */
#include "g2.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base_scan.h"
#include "g2_elementary.h"
#include "number.h"

enum { CLASS_CURVE = 100, CLASS_SURFACE = 200, CLASS_POINTS = 400, AUXILIARY_MAX = 64 };

static const struct class_row {
	int class;
	const char *name;
} class_table[] = {
	{ 100, "SplineCurve" },
	{ 110, "CurveOnSurface" },
	{ 120, "Line" },
	{ 130, "Circle" },
	{ 140, "Ellipse" },
	{ 150, "BoundedCurve" },
	{ 160, "Hyperbola" },
	{ 170, "Parabola" },
	{ 200, "SplineSurface" },
	{ 210, "BoundedSurface" },
	{ 211, "SurfaceOnVolume" },
	{ 220, "GoBaryPolSurface" },
	{ 230, "GoHBSplineParamSurface" },
	{ 240, "CompositeSurface" },
	{ 250, "Plane" },
	{ 260, "Cylinder" },
	{ 270, "Sphere" },
	{ 280, "Cone" },
	{ 290, "Torus" },
	{ 291, "SurfaceOfRevolution" },
	{ 292, "Disc" },
	{ 293, "LRSplineSurface" },
	{ 294, "TSplineSurface" },
	{ 300, "Go3dsObject" },
	{ 310, "GoHeTriang" },
	{ 320, "GoSdTriang" },
	{ 330, "GoQuadMesh" },
	{ 340, "GoHybridMesh" },
	{ 350, "ParamTriang" },
	{ 360, "GoVrmlGeometry" },
	{ 400, "PointCloud" },
	{ 410, "LineCloud" },
	{ 500, "GoTriangleSets" },
	{ 510, "RectGrid" },
	{ 700, "SplineVolume" },
	{ 710, "BoundedVolume" },
	{ 720, "Parallelepiped" },
	{ 721, "SphereVolume" },
	{ 722, "CylinderVolume" },
	{ 723, "ConeVolume" },
	{ 724, "TorusVolume" },
};

static const char *class_name(int64_t class)
{
	for (size_t i = 0; i < sizeof class_table / sizeof *class_table; i++)
		if (class_table[i].class == class)
			return class_table[i].name;
	return NULL;
}

static const char *pass_blanks(const char *s, const char *end)
{
	while (s < end && (*s == ' ' || *s == '\t' || *s == '\r'))
		s++;
	return s;
}

/* The line at s is a header and nothing else; `whole` false: as far as its four first numbers. */
static bool is_header(const char *s, const char *end, bool whole)
{
	int64_t x[4];
	for (int i = 0; i < 4; i++) {
		s = pass_blanks(s, end);
		if (!number_read_integer(&s, end, &x[i]) || (s < end && !strchr(" \t\r\n", *s)))
			return false;
	}
	if (!class_name(x[0]) || x[1] < 0 || x[1] > 9 || x[2] < 0 || x[2] > 9 || x[3] < 0 ||
	    x[3] > AUXILIARY_MAX)
		return false;
	for (int64_t i = 0, aux; i < x[3] && whole; i++) {
		s = pass_blanks(s, end);
		if (!number_read_integer(&s, end, &aux))
			return false;
	}
	s = pass_blanks(s, end);
	return !whole || s == end || *s == '\n';
}

bool g2_recognise(const char *bytes, size_t n)
{
	const char *s = bytes, *end = bytes + n;
	while (s < end && strchr(" \t\r\n", *s))
		s++;
	return is_header(s, end, false);
}

/* Go on at the next line that is a header, or the end. */
static void pass_object(struct scanner *p)
{
	while (p->s < p->end) {
		const char *line = memchr(p->s, '\n', (size_t)(p->end - p->s));
		p->s = line ? line + 1 : p->end;
		if (is_header(p->s, p->end, true))
			return;
	}
}

struct g2_header {
	int class, n_auxiliary;
	int auxiliary[4];
};

static void scan_header(struct scanner *p, struct g2_header *h)
{
	h->class = scan_integer(p, "class of an object", 1, 9999);
	if (p->st == ST_OK && !class_name(h->class))
		scan_fail(p, "the header of an object: a class such as 100 or 200");
	scan_integer(p, "major version", 0, 9);
	scan_integer(p, "minor version", 0, 9);
	h->n_auxiliary = scan_integer(p, "number of auxiliary integers", 0, AUXILIARY_MAX);
	for (int i = 0; i < h->n_auxiliary && p->st == ST_OK; i++) {
		int x = scan_integer(p, "auxiliary integer", INT32_MIN, INT32_MAX);
		if (i < 4)
			h->auxiliary[i] = x;
	}
}

static void set_color(struct entity *e, const struct g2_header *h)
{
	if (h->n_auxiliary != 4)
		return;
	e->has_color = true;
	for (int k = 0; k < 3; k++)
		e->color[k] = (float)fmin(fmax(h->auxiliary[k] / 255.0, 0), 1);
}

/* Points of `dimension` coordinates (and weight) to homogeneous ones; a plane's have z = 0. */
static void scan_points(struct scanner *p, double *out, size_t n, int dimension, bool rational)
{
	for (size_t i = 0; i < n && p->st == ST_OK; i++) {
		for (int k = 0; k < dimension; k++)
			out[4 * i + k] = scan_number(p, "coordinate");
		out[4 * i + 3] = rational ? scan_number(p, "weight") : 1;
	}
}

static void scan_kind(struct scanner *p, int *dimension, bool *rational)
{
	*dimension = scan_integer(p, "dimension", 2, 3);
	*rational = scan_integer(p, "rational", 0, 1) == 1;
}

static void scan_basis(struct scanner *p, int *n, int *order)
{
	*n = scan_integer(p, "number of coefficients", ORDER_MIN, scan_numbers_left(p, 1));
	*order = scan_integer(p, "order", ORDER_MIN, ORDER_MAX);
}

static void scan_curve(struct scanner *p, struct entity *e)
{
	int dimension, n, order;
	bool rational;
	scan_kind(p, &dimension, &rational);
	scan_basis(p, &n, &order);
	if (p->st != ST_OK)
		return;
	scan_keep(p, curve_init(&e->curve, order, n));
	if (p->st != ST_OK)
		return;
	scan_numbers(p, e->curve.knots, (int64_t)n + order, "knot");
	scan_points(p, e->curve.points, (size_t)n, dimension, rational);
}

/* In the file u runs fastest. */
static void scan_surface(struct scanner *p, struct entity *e)
{
	int dimension, n[2], order[2];
	bool rational;
	double *knots = NULL;
	struct surface *s = &e->geometry;
	scan_kind(p, &dimension, &rational);
	scan_basis(p, &n[0], &order[0]);
	if (p->st == ST_OK && !(knots = malloc(((size_t)n[0] + order[0]) * sizeof *knots)))
		scan_no_memory(p);
	if (p->st == ST_OK)
		scan_numbers(p, knots, (int64_t)n[0] + order[0], "knot in u");
	scan_basis(p, &n[1], &order[1]);
	if (p->st == ST_OK && n[1] > scan_numbers_left(p, (int64_t)n[0] * dimension))
		scan_fail(p, "as many coefficients as %d x %d", n[0], n[1]);
	if (p->st == ST_OK)
		scan_keep(p, surface_init(s, order, n));
	if (p->st != ST_OK) {
		free(knots);
		return;
	}
	memcpy(s->knots[0], knots, ((size_t)n[0] + order[0]) * sizeof *knots);
	free(knots);
	scan_numbers(p, s->knots[1], (int64_t)n[1] + order[1], "knot in v");
	for (int j = 0; j < n[1]; j++)
		for (int i = 0; i < n[0] && p->st == ST_OK; i++)
			scan_points(p, s->points + 4 * ((size_t)i * n[1] + j), 1, dimension,
			            rational);
}

static void scan_cloud(struct scanner *p, struct entity *e)
{
	struct point_list *l = &e->points;
	l->dimension = 3;
	int n = scan_integer(p, "number of points", 1, scan_numbers_left(p, 3));
	if (p->st != ST_OK)
		return;
	if (!(l->values = malloc((size_t)n * 3 * sizeof *l->values)))
		scan_no_memory(p);
	else
		scan_numbers(p, l->values, (int64_t)n * 3, "coordinate");
	l->n = n;
}

/* Keep the entity, or count it with the reason that the checks gave. */
static void keep(struct scanner *p, struct entity *e, int class)
{
	struct report_store store;
	enum status st = ST_OK;
	report_store_init(&store);
	if (e->kind == ENTITY_CURVE)
		st = curve_check(&e->curve, "the curve", &store.report);
	else if (e->kind == ENTITY_SURFACE)
		st = surface_check(&e->geometry, "the surface", &store.report);
	scan_keep(p, st == ST_OK ? model_add(p->m, e) : model_skip(p->m, class, 0, store.error));
}

/* All numbers up to the next header. */
static int scan_object(struct scanner *p, double out[G2_ELEMENTARY_MAX])
{
	int n = 0;
	for (scan_blanks(p); p->st == ST_OK && p->token < p->end; scan_blanks(p)) {
		bool begins_line = p->token == p->start || p->token[-1] == '\n';
		if (begins_line && is_header(p->token, p->end, true))
			break;
		double x = scan_number(p, n < G2_ELEMENTARY_MAX ? "number"
		                                                : "the header of the next object");
		if (n < G2_ELEMENTARY_MAX)
			out[n++] = x;
		else
			scan_fail(p, "the header of the next object");
	}
	return n;
}

static void parse_elementary(struct scanner *p, int class, struct entity *e)
{
	double x[G2_ELEMENTARY_MAX];
	const char *reason;
	int n = scan_object(p, x);
	if (p->st != ST_OK)
		return;
	enum status st = g2_make_elementary(class, x, n, e, &reason);
	if (st == ST_OK) {
		keep(p, e, class);
	} else if (st == ST_RESOURCE) {
		scan_no_memory(p);
	} else {
		char sentence[160];
		snprintf(sentence, sizeof sentence, "a %s: %s", class_name(class), reason);
		scan_keep(p, model_skip(p->m, class, 0, sentence));
	}
}

static void parse_object(struct scanner *p)
{
	enum entity_kind kind;
	struct g2_header h;
	struct entity e;
	scan_header(p, &h);
	if (p->st != ST_OK)
		return;
	bool elementary = g2_is_elementary(h.class, &kind);
	entity_init(&e, elementary                 ? kind
	                : h.class == CLASS_CURVE   ? ENTITY_CURVE
	                : h.class == CLASS_SURFACE ? ENTITY_SURFACE
	                                           : ENTITY_POINTS);
	set_color(&e, &h);
	if (elementary) {
		parse_elementary(p, h.class, &e);
		entity_finish(&e);
		return;
	}
	if (h.class == CLASS_CURVE)
		scan_curve(p, &e);
	else if (h.class == CLASS_SURFACE)
		scan_surface(p, &e);
	else if (h.class == CLASS_POINTS)
		scan_cloud(p, &e);
	else {
		char reason[80];
		snprintf(reason, sizeof reason, "a %s is not read; convert it to splines",
		         class_name(h.class));
		scan_keep(p, model_skip(p->m, h.class, 0, reason));
		pass_object(p);
		return;
	}
	if (p->st == ST_OK)
		keep(p, &e, h.class);
	entity_finish(&e);
}

enum status g2_parse(struct model *m, const char *bytes, size_t n, const char *name,
                     const struct progress *progress, const struct report *r)
{
	struct scanner p;
	scan_init(&p, bytes, n, name, m, progress, r);
	for (scan_blanks(&p); p.st == ST_OK && p.token < p.end; scan_blanks(&p)) {
		p.st = progress_step(progress, n ? (double)(p.token - bytes) / (double)n : 0);
		if (p.st == ST_OK)
			parse_object(&p);
	}
	if (p.st == ST_OK && m->n == 0)
		p.st = report_error(r, ST_INPUT, "cannot read '%s': %s", name,
		                    m->n_skipped ? m->skipped[0].reason : "it holds no object");
	if (p.st == ST_OK)
		model_number(m);
	return p.st;
}
