/* stroke.c - curves in space as cubic Bezier pieces in the image. */
#include "stroke.h"

#include <math.h>
#include <stdlib.h>

enum { HALVINGS_MAX = 14 };
static const double tolerance = 0.05; /* px */

void stroke_finish(struct stroke *s)
{
	free(s->pieces);
	*s = (struct stroke){ .pieces = NULL };
}

static enum status append(struct stroke *s, const struct stroke_piece *piece)
{
	if (s->n == s->cap) {
		size_t cap = s->cap ? 2 * s->cap : 16;
		struct stroke_piece *more = realloc(s->pieces, cap * sizeof *more);
		if (!more)
			return ST_RESOURCE;
		s->pieces = more;
		s->cap = cap;
	}
	s->pieces[s->n++] = *piece;
	return ST_OK;
}

/* What is drawn, and how far it has come. */
struct pen {
	struct stroke *out;
	const struct camera *camera;
	const struct curve *curve;
	bool up; /* the next piece begins anew */
};

/* Image point and its derivative by t; false behind the eye. */
static bool look(const struct pen *pen, double t, double point[2], double slope[2])
{
	const struct camera *c = pen->camera;
	struct vec3 d[2];
	double depth;
	curve_derivatives(pen->curve, t, 1, d);
	if (!camera_project(c, d[0], &point[0], &point[1], &depth))
		return false;
	double scale = 1 / camera_pixel(c, d[0]), recede = 0;
	if (c->kind == CAMERA_PERSPECTIVE)
		recede = vec3_dot(d[1], c->ahead) / depth;
	slope[0] = scale * vec3_dot(d[1], c->right) - (point[0] - c->width / 2.0) * recede;
	slope[1] = -scale * vec3_dot(d[1], c->up) - (point[1] - c->height / 2.0) * recede;
	return isfinite(point[0] + point[1] + slope[0] + slope[1]);
}

/* The cubic with the curve's end points and end slopes between a and b. */
static bool fit(const struct pen *pen, double a, double b, struct stroke_piece *piece)
{
	double from[2], to[2];
	/* the slope at b is that of the span which ends there */
	if (!look(pen, a, piece->p[0], from) || !look(pen, nextafter(b, a), piece->p[3], to))
		return false;
	for (int k = 0; k < 2; k++) {
		piece->p[1][k] = piece->p[0][k] + from[k] * (b - a) / 3;
		piece->p[2][k] = piece->p[3][k] - to[k] * (b - a) / 3;
	}
	return true;
}

static void piece_point(const struct stroke_piece *piece, double t, double out[2])
{
	double s = 1 - t;
	for (int k = 0; k < 2; k++)
		out[k] = s * s * (s * piece->p[0][k] + 3 * t * piece->p[1][k]) +
		         t * t * (3 * s * piece->p[2][k] + t * piece->p[3][k]);
}

static bool close_enough(const struct pen *pen, double a, double b,
                         const struct stroke_piece *piece, int samples)
{
	for (int i = 1; i < samples; i++) {
		double t = (double)i / samples, want[2], got[2], slope[2];
		if (!look(pen, a + t * (b - a), want, slope))
			return false;
		piece_point(piece, t, got);
		if (hypot(want[0] - got[0], want[1] - got[1]) > tolerance)
			return false;
	}
	return true;
}

static enum status put(struct pen *pen, struct stroke_piece *piece)
{
	piece->begins = pen->up;
	pen->up = false;
	return append(pen->out, piece);
}

static enum status draw_span(struct pen *pen, double a, double b, int halvings)
{
	struct stroke_piece piece;
	bool seen = fit(pen, a, b, &piece);
	if (seen && (halvings == HALVINGS_MAX || close_enough(pen, a, b, &piece, 5)))
		return put(pen, &piece);
	if (halvings == HALVINGS_MAX) {
		pen->up = true;
		return ST_OK;
	}
	double middle = a + (b - a) / 2;
	enum status st = draw_span(pen, a, middle, halvings + 1);
	return st ? st : draw_span(pen, middle, b, halvings + 1);
}

/* Spans first .. last - 1 as one piece where that is close enough. */
static enum status draw_joined(struct pen *pen, const double *breaks, int first, int last)
{
	struct stroke_piece piece;
	double a = breaks[first], b = breaks[last];
	if (last - first == 1)
		return draw_span(pen, a, b, 0);
	if (fit(pen, a, b, &piece) && close_enough(pen, a, b, &piece, 4 * (last - first)))
		return put(pen, &piece);
	int middle = (first + last) / 2;
	enum status st = draw_joined(pen, breaks, first, middle);
	return st ? st : draw_joined(pen, breaks, middle, last);
}

enum status stroke_add(struct stroke *s, const struct camera *camera, const struct curve *curve,
                       bool join)
{
	struct pen pen = { .out = s, .camera = camera, .curve = curve, .up = true };
	double *breaks = malloc((curve->n + 2) * sizeof *breaks);
	if (!breaks)
		return ST_RESOURCE;
	int n = knots_breaks(curve->order, curve->n, curve->knots, curve->domain[0],
	                     curve->domain[1], breaks);
	enum status st = ST_OK;
	if (join)
		st = draw_joined(&pen, breaks, 0, n - 1);
	else
		for (int i = 0; i + 1 < n && !st; i++)
			st = draw_span(&pen, breaks[i], breaks[i + 1], 0);
	free(breaks);
	return st;
}

static double piece_length(const struct stroke_piece *q)
{
	double chord = hypot(q->p[3][0] - q->p[0][0], q->p[3][1] - q->p[0][1]), polygon = 0;
	for (int i = 0; i < 3; i++)
		polygon += hypot(q->p[i + 1][0] - q->p[i][0], q->p[i + 1][1] - q->p[i][1]);
	return (chord + polygon) / 2;
}

double stroke_length(const struct stroke *s)
{
	double sum = 0;
	for (size_t i = 0; i < s->n; i++)
		sum += piece_length(&s->pieces[i]);
	return sum;
}

void stroke_point(const struct stroke *s, double share, double out[2])
{
	double left = share * stroke_length(s);
	for (size_t i = 0; i < s->n; i++) {
		double length = piece_length(&s->pieces[i]);
		if (left <= length || i + 1 == s->n) {
			double t = length > 0 ? fmin(left / length, 1) : 0;
			piece_point(&s->pieces[i], t, out);
			return;
		}
		left -= length;
	}
}
