/* level_net.c - make the patches of a net what fields need: of degree 2 at least, short, of weights that
 * are not far apart (products of many weights would be rounding where they are small). */
#include "level_private.h"

#include <stdlib.h>
#include <string.h>

/* Patches are halved so often at most, while their weights differ by more. */
enum { EVEN_ROUNDS = 5, EVEN_RATIO = 4 };

/* Rows of a patch's points in direction d: first point's place and step, in doubles. */
static size_t row_first(const struct bezier_net *net, int d, int row)
{
	return (size_t)4 * (d == 0 ? row : row * net->order[1]);
}

static size_t row_step(const struct bezier_net *net, int d)
{
	return (size_t)4 * (d == 0 ? net->order[1] : 1);
}

enum status level_net_raise(struct bezier_net *net, int d)
{
	struct bezier_net out = *net;
	const size_t patches = (size_t)net->spans[0] * net->spans[1];
	out.order[d] = 3;
	out.points = malloc(sizeof(double) * bezier_patch_size(&out) * patches);
	if (!out.points)
		return ST_RESOURCE;
	for (size_t i = 0; i < patches; i++)
		for (int row = 0; row < net->order[1 - d]; row++) {
			const double *from =
			        net->points + bezier_patch_size(net) * i + row_first(net, d, row);
			double *to =
			        out.points + bezier_patch_size(&out) * i + row_first(&out, d, row);
			const double *last = from + row_step(net, d);
			for (int c = 0; c < 4; c++) {
				to[c] = from[c];
				to[row_step(&out, d) + c] = 0.5 * (from[c] + last[c]);
				to[2 * row_step(&out, d) + c] = last[c];
			}
		}
	free(net->points);
	*net = out;
	return ST_OK;
}

/* A patch's halves, by de Casteljau: c keeps the upper one. */
static void patch_halve(const struct bezier_net *net, int d, double *c, double *lower)
{
	const int p = net->order[d] - 1;
	const size_t step = row_step(net, d);
	for (int row = 0; row < net->order[1 - d]; row++) {
		double *x = c + row_first(net, d, row), *y = lower + row_first(net, d, row);
		memcpy(y, x, sizeof(double[4]));
		for (int s = 1; s <= p; s++) {
			for (int i = 0; i <= p - s; i++)
				for (int k = 0; k < 4; k++)
					x[step * i + k] =
					        0.5 * (x[step * i + k] + x[step * (i + 1) + k]);
			memcpy(y + step * s, x, sizeof(double[4]));
		}
	}
}

enum status level_net_halve(struct bezier_net *net, int d, const bool *spans)
{
	int more = 0, to = 0;
	const size_t size = bezier_patch_size(net);
	for (int i = 0; i < net->spans[d]; i++)
		more += spans[i];
	struct bezier_net out = *net;
	out.spans[d] += more;
	out.points = malloc(sizeof(double) * size * out.spans[0] * out.spans[1]);
	out.breaks[d] = malloc(sizeof(double) * (out.spans[d] + 1));
	if (!out.points || !out.breaks[d]) {
		free(out.points);
		free(out.breaks[d]);
		return ST_RESOURCE;
	}
	for (int i = 0; i < net->spans[d]; i++) {
		const double *b = net->breaks[d];
		out.breaks[d][to] = b[i];
		if (spans[i])
			out.breaks[d][to + 1] = 0.5 * (b[i] + b[i + 1]);
		for (int k = 0; k < net->spans[1 - d]; k++) {
			const double *from =
			        d == 0 ? bezier_patch(net, i, k) : bezier_patch(net, k, i);
			int at[2] = { d == 0 ? to : k, d == 0 ? k : to };
			double *first = out.points + size * ((size_t)at[0] * out.spans[1] + at[1]);
			double *second = first + (d == 0 ? size * out.spans[1] : size);
			memcpy(spans[i] ? second : first, from, sizeof(double) * size);
			if (spans[i])
				patch_halve(net, d, second, first);
		}
		to += 1 + spans[i];
	}
	out.breaks[d][to] = net->breaks[d][net->spans[d]];
	free(net->points);
	free(net->breaks[d]);
	*net = out;
	return ST_OK;
}

/* How many times its least weight is the largest on a line of a patch in direction d. */
static double weight_ratio(const struct bezier_net *net, const double *patch, int d)
{
	double most = 1;
	for (int row = 0; row < net->order[1 - d]; row++) {
		const double *w = patch + row_first(net, d, row) + 3;
		double lo = *w, hi = *w;
		for (int i = 1; i < net->order[d]; i++) {
			lo = smaller(lo, w[row_step(net, d) * i]);
			hi = larger(hi, w[row_step(net, d) * i]);
		}
		most = larger(most, hi / lo);
	}
	return most;
}

enum status level_net_even(struct bezier_net *net)
{
	enum status st = ST_OK;
	for (int round = 0; st == ST_OK && net->rational && round < 2 * EVEN_ROUNDS; round++) {
		const int d = round % 2;
		bool any = false, *halve = calloc((size_t)net->spans[d], sizeof *halve);
		if (!halve)
			return ST_RESOURCE;
		for (int i = 0; i < net->spans[0]; i++)
			for (int j = 0; j < net->spans[1]; j++)
				if (weight_ratio(net, bezier_patch(net, i, j), d) > EVEN_RATIO)
					any = halve[d == 0 ? i : j] = true;
		if (any)
			st = level_net_halve(net, d, halve);
		free(halve);
	}
	return st;
}
