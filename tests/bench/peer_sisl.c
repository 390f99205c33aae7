/* peer_sisl.c - the SINTEF Spline Library. */
#include "peer.h"

#include <math.h>
#include <sisl.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

/* A surface and where s1506 puts what it finds. */
struct sisl {
	SISLSurf *s;
	double *derivatives, *normals, *values; /* owned; room for n x n */
	int n;
	const double *sum; /* what to add up: n x n rows of sum_step, the first sum_count of each */
	int sum_step, sum_count;
};

static void *surface(const struct peer_net *x)
{
	struct sisl *out = calloc(1, sizeof *out);
	const int dim = x->rational ? 4 : 3;
	double *points = bench_room((size_t)dim * x->n[0] * x->n[1]);
	if (!out)
		bench_fail("out of memory");
	for (int i = 0; i < x->n[0]; i++)
		for (int j = 0; j < x->n[1]; j++)
			memcpy(points + (size_t)dim * (j * x->n[0] + i),
			       x->points + (size_t)4 * (i * x->n[1] + j), sizeof(double) * dim);
	out->s = newSurf(x->n[0], x->n[1], x->order[0], x->order[1], (double *)x->knots[0],
	                 (double *)x->knots[1], points, x->rational ? 2 : 1, 3, 1);
	free(points);
	return out;
}

static void drop(void *data)
{
	struct sisl *x = data;
	freeSurf(x->s);
	free(x->derivatives);
	free(x->normals);
	free(x->values);
	free(x);
}

static void room(struct sisl *x, int n)
{
	if (x->n == n)
		return;
	x->n = n;
	x->derivatives = bench_room((size_t)18 * n * n);
	x->normals = bench_room((size_t)3 * n * n);
	x->values = bench_room((size_t)4 * n * n);
}

/* K, H, kmax, kmin from S Su Sv Suu Suv Svv, the plain way. */
static void plain_curvatures(const double *d, double out[4])
{
	const double *u = d + 3, *v = d + 6;
	const double n[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
		              u[0] * v[1] - u[1] * v[0] };
	double first[3] = { 0 }, second[3] = { 0 }, area2 = 0;
	for (int c = 0; c < 3; c++) {
		first[0] += u[c] * u[c];
		first[1] += u[c] * v[c];
		first[2] += v[c] * v[c];
		area2 += n[c] * n[c];
		for (int k = 0; k < 3; k++)
			second[k] += n[c] * d[9 + 3 * k + c];
	}
	out[0] = (second[0] * second[2] - second[1] * second[1]) / (area2 * area2);
	out[1] = (first[0] * second[2] - 2 * first[1] * second[1] + first[2] * second[0]) /
	         (2 * area2 * sqrt(area2));
	const double half = sqrt(fmax(out[1] * out[1] - out[0], 0));
	out[2] = out[1] + half;
	out[3] = out[1] - half;
}

static void grid_curvatures(void *data, const double *x, int n)
{
	struct sisl *p = data;
	int status;
	room(p, n);
	s1506(p->s, 2, n, (double *)x, n, (double *)x, p->derivatives, p->normals, &status);
	for (size_t i = 0; i < (size_t)n * n; i++)
		plain_curvatures(p->derivatives + 18 * i, p->values + 4 * i);
	p->sum = p->values;
	p->sum_step = 4;
	p->sum_count = 1;
}

static void grid_points(void *data, const double *x, int n)
{
	struct sisl *p = data;
	int status;
	room(p, n);
	s1506(p->s, 0, n, (double *)x, n, (double *)x, p->derivatives, p->normals, &status);
	p->sum = p->derivatives;
	p->sum_step = p->sum_count = 3;
}

static double grid_sum(void *data)
{
	const struct sisl *p = data;
	double sum = 0;
	for (size_t i = 0; i < (size_t)p->n * p->n; i++)
		for (int c = 0; c < p->sum_count; c++)
			sum += p->sum[i * p->sum_step + c];
	return sum;
}

static double points(void *data, const double *uv, int n)
{
	const struct sisl *x = data;
	int left[2] = { 0, 0 }, status;
	double p[3], normal[3], sum = 0;
	for (int i = 0; i < n; i++) {
		s1421(x->s, 0, (double *)uv + (size_t)2 * i, &left[0], &left[1], p, normal,
		      &status);
		sum += p[0] + p[1] + p[2];
	}
	return sum;
}

static double curvatures(void *data, const double *uv, int n)
{
	const struct sisl *x = data;
	int left[2] = { 0, 0 }, status;
	double d[18], normal[3], k[4], sum = 0;
	for (int i = 0; i < n; i++) {
		s1421(x->s, 2, (double *)uv + (size_t)2 * i, &left[0], &left[1], d, normal,
		      &status);
		plain_curvatures(d, k);
		sum += k[0];
	}
	return sum;
}

static bool curvature(void *data, double u, double v, double kh[2], double point[3])
{
	const struct sisl *x = data;
	int left[2] = { 0, 0 }, status;
	double at[2] = { u, v }, d[18], normal[3], k[4];
	s1421(x->s, 2, at, &left[0], &left[1], d, normal, &status);
	plain_curvatures(d, k);
	memcpy(kh, k, sizeof *kh * 2);
	memcpy(point, d, sizeof *point * 3);
	return status >= 0 && isfinite(k[0]);
}

static int interpolate_curve(const double *xyz, int n)
{
	SISLCurve *out = NULL;
	double end, *parameters = NULL;
	int n_parameters = 0, status, *kinds = malloc(sizeof *kinds * n);
	if (!kinds)
		bench_fail("out of memory");
	for (int i = 0; i < n; i++)
		kinds[i] = 1;
	s1356((double *)xyz, n, 3, kinds, 0, 0, 1, 4, 0, &end, &out, &parameters, &n_parameters,
	      &status);
	const int found = out ? out->in : 0;
	if (out)
		freeCurve(out);
	free(parameters);
	free(kinds);
	return found;
}

static int interpolate_surface(const double *xyz, int n)
{
	SISLSurf *out = NULL;
	int status;
	s1536((double *)xyz, n, n, 3, 1, 0, 0, 0, 0, 4, 4, 1, 1, &out, &status);
	const int found = out ? out->in1 * out->in2 : 0;
	if (out)
		freeSurf(out);
	return found;
}

static void *offset(void *data, double distance, double tolerance)
{
	const struct sisl *x = data;
	struct sisl *out = calloc(1, sizeof *out);
	int status;
	if (!out)
		bench_fail("out of memory");
	s1365(x->s, distance, tolerance, 0, 3, &out->s, &status);
	if (status >= 0 && out->s)
		return out;
	free(out);
	return NULL;
}

static void poles(void *data, int n[2])
{
	const struct sisl *x = data;
	n[0] = x->s->in1;
	n[1] = x->s->in2;
}

/* What finds the curves of a kind, without their course; and what follows one. */
static void find_curves(SISLSurf *s, const struct peer_field *f, SISLIntcurve ***found, int *n)
{
	double p[3], d[3], *points = NULL;
	int n_points = 0, status = 0;
	memcpy(p, f->point, sizeof p);
	memcpy(d, f->direction, sizeof d);
	if (f->kind == PEER_PLANE)
		for (int c = 0; c < 3; c++)
			p[c] = f->value * d[c];
	if (f->kind == PEER_PLANE)
		s1851(s, p, d, 3, 0, f->tolerance, &n_points, &points, n, found, &status);
	else if (f->kind == PEER_CYLINDER)
		s1853(s, p, d, f->value, 3, 0, f->tolerance, &n_points, &points, n, found, &status);
	else if (f->kind == PEER_SILHOUETTE)
		s1860(s, d, 3, 0, f->tolerance, &n_points, &points, n, found, &status);
	else if (f->kind == PEER_EYE)
		s1510(s, p, 3, 0, f->tolerance, &n_points, &points, n, found, &status);
	free(points);
}

static void follow_curve(SISLSurf *s, const struct peer_field *f, SISLIntcurve *curve)
{
	double p[3], d[3];
	int status = 0;
	memcpy(p, f->point, sizeof p);
	memcpy(d, f->direction, sizeof d);
	if (f->kind == PEER_PLANE)
		for (int c = 0; c < 3; c++)
			p[c] = f->value * d[c];
	if (f->kind == PEER_PLANE)
		s1314(s, p, d, 3, 0, f->tolerance, 0, curve, 1, 0, &status);
	else if (f->kind == PEER_CYLINDER)
		s1316(s, p, d, f->value, 3, 0, f->tolerance, 0, curve, 1, 0, &status);
	else if (f->kind == PEER_SILHOUETTE)
		s1319(s, d, 3, 0, f->tolerance, 0, curve, 1, 0, &status);
	else
		s1514(s, p, 3, 0, f->tolerance, 0, curve, 1, 0, &status);
}

static void places_of(SISLCurve *c, peer_place *place, void *data)
{
	const double from = c->et[c->ik - 1], to = c->et[c->in];
	int left = 0, status;
	for (int i = 0; i < PEER_PLACES; i++) {
		double p[3];
		s1221(c, 0, from + (to - from) * (i + 0.5) / PEER_PLACES, &left, p, &status);
		place(p, data);
	}
}

static int curves(void *data, const struct peer_field *f, peer_place *place, void *place_data)
{
	const struct sisl *x = data;
	SISLIntcurve **found = NULL;
	int n = 0, followed = 0;
	find_curves(x->s, f, &found, &n);
	for (int i = 0; i < n; i++) {
		follow_curve(x->s, f, found[i]);
		if (!found[i]->pgeom)
			continue;
		followed++;
		if (place)
			places_of(found[i]->pgeom, place, place_data);
	}
	if (found)
		freeIntcrvlist(found, n);
	return followed;
}

const struct peer peer_sisl = {
	.name = "SISL",
	.surface = surface,
	.drop = drop,
	.grid_curvatures = grid_curvatures,
	.grid_points = grid_points,
	.grid_sum = grid_sum,
	.points = points,
	.curvatures = curvatures,
	.curvature = curvature,
	.interpolate_curve = interpolate_curve,
	.interpolate_surface = interpolate_surface,
	.offset = offset,
	.poles = poles,
	.curves = curves,
};
