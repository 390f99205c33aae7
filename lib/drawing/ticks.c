/* ticks.c - marks at round numbers. */
#include "ticks.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char minus[] = "\xE2\x88\x92", times_ten[] = "\xC2\xB7"
                                                          "10";

static const char *const raised[] = { "\xE2\x81\xB0", "\xC2\xB9",     "\xC2\xB2",
	                              "\xC2\xB3",     "\xE2\x81\xB4", "\xE2\x81\xB5",
	                              "\xE2\x81\xB6", "\xE2\x81\xB7", "\xE2\x81\xB8",
	                              "\xE2\x81\xB9" };

static void append(char out[TICK_TEXT], const char *s)
{
	strncat(out, s, TICK_TEXT - 1 - strlen(out));
}

static void append_power(char out[TICK_TEXT], int exponent)
{
	char digits[16];
	append(out, times_ten);
	if (exponent < 0)
		append(out, "\xE2\x81\xBB");
	snprintf(digits, sizeof digits, "%d", abs(exponent));
	for (const char *d = digits; *d; d++)
		append(out, raised[*d - '0']);
}

/* Places behind the point: those of 10^place and above. powers: as a number times a power of ten. */
static void write_number(char out[TICK_TEXT], double x, int place, bool powers)
{
	char digits[TICK_TEXT];
	double size = fabs(x);
	int exponent = size > 0 ? (int)floor(log10(size) + 1e-12) : 0;
	out[0] = 0;
	if (size < 0.5 * pow(10, place)) {
		append(out, "0");
		return;
	}
	if (x < 0)
		append(out, minus);
	if (!powers) {
		if (place > 0)
			size = rint(size / pow(10, place)) * pow(10, place);
		snprintf(digits, sizeof digits, "%.*f", place < 0 ? -place : 0, size);
		append(out, digits);
		return;
	}
	int behind = exponent > place ? exponent - place : 0;
	snprintf(digits, sizeof digits, "%.*f", behind, size / pow(10, exponent));
	append(out, digits);
	append_power(out, exponent);
}

/* Numbers this large or steps this small are easier to read as powers of ten. */
static bool wants_powers(double largest, double step)
{
	return largest >= 1e5 || step < 1e-4 * (1 - 1e-9);
}

void number_for_reader(char out[TICK_TEXT], double x, int digits)
{
	double size = fabs(x);
	int exponent = size > 0 ? (int)floor(log10(size)) : 0;
	write_number(out, x, exponent - digits + 1, size > 0 && (size >= 1e5 || size < 1e-3));
	/* zeros behind the point that were not asked for as digits of a longer number */
	char *point = strchr(out, '.'), *power = strstr(out, times_ten);
	if (!point)
		return;
	char rest[TICK_TEXT] = "";
	if (power)
		strcpy(rest, power);
	char *end = power ? power : out + strlen(out);
	*end = 0;
	while (end > point && (end[-1] == '0' || end[-1] == '.'))
		*--end = 0;
	append(out, rest);
}

static void add(struct ticks *t, double value, int place, bool powers)
{
	if (t->n >= TICKS_MAX)
		return;
	t->value[t->n] = value;
	write_number(t->text[t->n], value, place, powers);
	t->n++;
}

void ticks_linear(struct ticks *t, double lo, double hi, double gap)
{
	static const int steps[] = { 1, 2, 5, 10 };
	double least = gap * (hi - lo);
	int place = (int)floor(log10(least));
	double power = pow(10, place);
	int i = 0;
	while (i < 3 && steps[i] * power < least * (1 - 1e-9))
		i++;
	if (i == 3)
		place++;
	double step = steps[i] * power, slack = 1e-9 * step;
	bool powers = wants_powers(fmax(fabs(lo), fabs(hi)), step);
	t->n = 0;
	for (double k = ceil((lo - slack) / step); k * step <= hi + slack; k++)
		add(t, k * step, place, powers);
}

/* Take a mark where it keeps its distance from those taken before. */
static void offer(struct ticks *t, const struct colormap *m, double gap, double value, int place,
                  bool powers)
{
	double at = colormap_position(m, value);
	if (at < -1e-9 || at > 1 + 1e-9)
		return;
	for (int i = 0; i < t->n; i++)
		if (fabs(colormap_position(m, t->value[i]) - at) < gap)
			return;
	add(t, value, place, powers);
}

static void sort(struct ticks *t)
{
	for (int i = 1; i < t->n; i++)
		for (int k = i; k > 0 && t->value[k] < t->value[k - 1]; k--) {
			char text[TICK_TEXT];
			double value = t->value[k];
			strcpy(text, t->text[k]);
			t->value[k] = t->value[k - 1];
			strcpy(t->text[k], t->text[k - 1]);
			t->value[k - 1] = value;
			strcpy(t->text[k - 1], text);
		}
}

void ticks_colormap(struct ticks *t, const struct colormap *m, double gap)
{
	static const int digits[] = { 1, 5, 2 };
	if (!m->arsinh) {
		ticks_linear(t, m->lo, m->hi, gap);
		return;
	}
	double reach = fmax(fabs(m->lo), fabs(m->hi));
	int top = (int)floor(log10(reach)), bottom = (int)floor(log10(m->knee)) - 1;
	bool powers = wants_powers(reach, m->knee);
	t->n = 0;
	offer(t, m, gap, 0, 0, powers);
	/* powers of ten first, from the ends inward; then what still fits between them */
	for (int d = 0; d < 3; d++)
		for (int place = top; place >= bottom; place--) {
			double value = digits[d] * pow(10, place);
			offer(t, m, gap, value, place, powers);
			offer(t, m, gap, -value, place, powers);
		}
	sort(t);
}
