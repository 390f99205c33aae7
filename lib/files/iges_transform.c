/* iges_transform.c - 124: where an entity stands; 116 and 123: points and directions. */
#include "iges_reader.h"

#include <string.h>

static const double identity[3][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } };

void iges_multiply(const double b[3][4], double a[3][4])
{
	double out[3][4];
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 4; k++)
			out[i][k] = b[i][0] * a[0][k] + b[i][1] * a[1][k] + b[i][2] * a[2][k] +
			            (k == 3 ? b[i][3] : 0);
	memcpy(a, out, sizeof out);
}

enum status iges_matrix(struct iges *g, int transform, double m[3][4], bool *any)
{
	memcpy(m, identity, sizeof identity);
	*any = transform != 0;
	for (int depth = 0; transform; depth++) {
		struct iges_cursor c;
		double step[3][4];
		if (depth == NESTING_MAX)
			return iges_refuse(g,
			                   "its transforms (124) refer to each other in a circle "
			                   "or more than %d deep",
			                   NESTING_MAX);
		enum status st = iges_open(g, transform, 124, &c);
		if (st != ST_OK)
			return st;
		iges_few(&c, step[0], 12);
		for (int i = 0; i < 12; i++)
			if (c.st == ST_OK && !isfinite(step[i / 4][i % 4]))
				iges_fail(&c, "its transform D%d has a number that is not finite",
				          transform);
		if (c.st != ST_OK)
			return c.st;
		iges_multiply((const double(*)[4])step, m);
		transform = iges_entry(g, transform)->transform;
	}
	return ST_OK;
}

static struct vec3 apply(const double m[3][4], struct vec3 p, double w)
{
	return vec3(m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + w * m[0][3],
	            m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + w * m[1][3],
	            m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + w * m[2][3]);
}

/* Three numbers of an entity of that type, moved (w 1) or only turned (w 0) by its 124. */
static enum status vector_at(struct iges *g, int de, int type, double w, struct vec3 *out)
{
	struct iges_cursor c;
	double x[3], m[3][4];
	bool any;
	enum status st = iges_open(g, de, type, &c);
	if (st != ST_OK)
		return st;
	iges_few(&c, x, 3);
	if (c.st != ST_OK)
		return c.st;
	st = iges_matrix(g, iges_entry(g, de)->transform, m, &any);
	*out = apply(m, vec3(x[0], x[1], x[2]), w);
	return st;
}

enum status iges_point_at(struct iges *g, int de, struct vec3 *p)
{
	return vector_at(g, de, 116, 1, p);
}

enum status iges_direction_at(struct iges *g, int de, struct vec3 *d)
{
	return vector_at(g, de, 123, 0, d);
}
