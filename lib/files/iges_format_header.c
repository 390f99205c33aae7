/* iges_format_header.c - start and global section for the IGES writer. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "iges_writer.h"

enum { HEADER_COLUMNS = 72 };

/* Unit flag of global field 14; 3 says that the name in field 15 counts. */
static int unit_flag(const char *unit)
{
	static const char *const name[] = { "in", "mm",  NULL, "ft", "mi", "m",
		                            "km", "mil", "um", "cm", "uin" };
	for (size_t i = 0; unit && i < sizeof name / sizeof name[0]; i++)
		if (name[i] && strcmp(unit, name[i]) == 0)
			return (int)i + 1;
	return unit ? 3 : 2;
}

/* Header lines: text cut into 72 columns. Returns how many. */
static int put_header(struct text *out, char letter, const char *s, size_t n)
{
	int lines = 0;
	for (size_t i = 0; i < n || i == 0; i += HEADER_COLUMNS) {
		int here = (int)(n - i < HEADER_COLUMNS ? n - i : HEADER_COLUMNS);
		text_addf(out, "%-*.*s%c%7d\n", HEADER_COLUMNS, here, s + i, letter, ++lines);
	}
	return lines;
}

/* Largest coordinate of n points, `stride` doubles each, the weight behind them if there are four. */
static double largest_of(const double *p, size_t n, size_t stride)
{
	double x = 0;
	for (size_t i = 0; i < n; i++, p += stride)
		for (int k = 0; k < 3; k++)
			x = fmax(x, fabs(stride > 3 ? p[k] / p[3] : p[k]));
	return x;
}

/* Largest coordinate, which the header wants. */
static double largest_coordinate(const struct model *m)
{
	double x = 0;
	for (int i = 0; i < m->n; i++) {
		const struct entity *e = &m->entities[i];
		const struct curve *c = iges_curve_of(e);
		const struct surface *s = &e->geometry;
		if (!iges_holds(e))
			continue;
		if (c)
			x = fmax(x, largest_of(c->points, (size_t)c->n, 4));
		else if (e->kind == ENTITY_SURFACE)
			x = fmax(x, largest_of(s->points, (size_t)s->n[0] * (size_t)s->n[1], 4));
		else
			x = fmax(x, largest_of(e->points.values, (size_t)e->points.n, 3));
	}
	return x;
}

int iges_put_global(const struct model *m, struct text *out)
{
	struct text t = { 0 };
	char unit[16] = "MM", real[IGES_REAL_SIZE];
	if (m->unit)
		snprintf(unit, sizeof unit, "%s", m->unit);
	for (char *s = unit; *s; s++)
		*s = (char)toupper((unsigned char)*s);
	text_addf(&t, "1H,,1H;,,,6Hbatten,%zuH%s,32,38,6,308,15,,",
	          strlen("batten " BATTEN_VERSION), "batten " BATTEN_VERSION);
	iges_real_text(real, m->scale);
	text_addf(&t, "%s,%d,%zuH%s,1,,,", real, unit_flag(m->unit), strlen(unit), unit);
	double largest = largest_coordinate(m);
	iges_real_text(real, 1e-9 * (largest > 0 ? largest : 1));
	text_addf(&t, "%s,", real);
	iges_real_text(real, largest);
	text_add(&t, real);
	text_add(&t, ",,,11,0;");
	int lines = put_header(out, 'G', t.s ? t.s : "", t.n);
	out->failed |= t.failed;
	text_finish(&t);
	return lines;
}

int iges_put_start(struct text *out)
{
	static const char start[] = "geometry written by batten";
	return put_header(out, 'S', start, sizeof start - 1);
}
