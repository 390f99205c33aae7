/* interpolate.c - spline interpolation at Greville abscissae. */
#include "interpolate.h"

#include <stdlib.h>

#include "banded.h"

enum { DEGREE = SIDE_ORDER - 1, ROW = 2 * SIDE_ORDER - 1 };

static enum status side_room(struct side *s, int spans)
{
	size_t most = ((size_t)spans + 1) * SIDE_ORDER;
	*s = (struct side){ .spans = spans };
	s->breaks = calloc((size_t)spans + 1, sizeof *s->breaks);
	s->multiplicity = calloc((size_t)spans + 1, sizeof *s->multiplicity);
	s->error = calloc((size_t)spans, sizeof *s->error);
	s->knots = calloc(most, sizeof *s->knots);
	s->at = calloc(most, sizeof *s->at);
	s->band = calloc(most, ROW * sizeof *s->band);
	if (s->breaks && s->multiplicity && s->error && s->knots && s->at && s->band)
		return ST_OK;
	side_finish(s);
	return ST_RESOURCE;
}

void side_finish(struct side *s)
{
	free(s->breaks);
	free(s->multiplicity);
	free(s->error);
	free(s->knots);
	free(s->at);
	free(s->band);
	*s = (struct side){ 0 };
}

/* With breaks and multiplicities set: knots, abscissae, factors. */
static void prepare(struct side *s)
{
	int m = 0;
	for (int i = 0; i <= s->spans; i++)
		for (int k = 0; k < s->multiplicity[i]; k++)
			s->knots[m++] = s->breaks[i];
	s->n = m - SIDE_ORDER;
	for (int i = 0; i < s->n; i++) {
		const double *t = s->knots + i + 1;
		double sum = 0, basis[SIDE_ORDER];
		for (int k = 0; k < DEGREE; k++)
			sum += t[k];
		s->at[i] = t[0] == t[DEGREE - 1] ? t[0] : sum / DEGREE;
		int span = knots_span(SIDE_ORDER, s->n, s->knots, s->at[i]);
		knots_basis(SIDE_ORDER, s->knots, span, s->at[i], 0, basis);
		for (int k = 0; k <= DEGREE; k++) {
			int column = span - DEGREE + k - i + DEGREE;
			if (column >= 0 && column < ROW)
				s->band[(size_t)i * ROW + column] = basis[k];
		}
	}
	banded_factor(s->band, s->n, DEGREE);
}

enum status side_init(struct side *out, const struct surface *s, int d)
{
	int order = s->order[d], n = s->n[d];
	double *breaks = malloc(((size_t)n + 2) * sizeof *breaks);
	if (!breaks)
		return ST_RESOURCE;
	int spans =
	        knots_breaks(order, n, s->knots[d], s->domain[d][0], s->domain[d][1], breaks) - 1;
	enum status st = side_room(out, spans);
	for (int i = 0; i <= spans && st == ST_OK; i++) {
		int smooth = order - 1 - knots_multiplicity(order, n, s->knots[d], breaks[i]);
		int m = SIDE_ORDER - smooth;
		out->breaks[i] = breaks[i];
		out->multiplicity[i] = m < 1 ? 1 : m > DEGREE ? DEGREE : m;
	}
	if (st == ST_OK) {
		out->multiplicity[0] = out->multiplicity[spans] = SIDE_ORDER;
		prepare(out);
	}
	free(breaks);
	return st;
}

enum status side_halve(struct side *s, double limit)
{
	int more = 0, m = 0;
	for (int i = 0; i < s->spans; i++)
		more += s->error[i] > limit;
	struct side next;
	enum status st = side_room(&next, s->spans + more);
	if (st != ST_OK)
		return st;
	for (int i = 0; i <= s->spans; i++) {
		next.breaks[m] = s->breaks[i];
		next.multiplicity[m++] = s->multiplicity[i];
		if (i < s->spans && s->error[i] > limit) {
			next.breaks[m] = s->breaks[i] + (s->breaks[i + 1] - s->breaks[i]) / 2;
			next.multiplicity[m++] = 1;
		}
	}
	prepare(&next);
	side_finish(s);
	*s = next;
	return ST_OK;
}

void side_solve(const struct side *s, double *x, size_t columns)
{
	banded_solve(s->band, s->n, DEGREE, x, columns);
}
