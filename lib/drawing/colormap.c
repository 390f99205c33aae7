/* colormap.c - values to colors. */
#include "colormap.h"

#include <math.h>
#include <stdlib.h>

#define RGB(hex)                                                                                   \
	{                                                                                          \
		((hex) >> 16 & 255) / 255.0, ((hex) >> 8 & 255) / 255.0, ((hex)&255) / 255.0       \
	}

/* Two thirds of the area in a tenth of the colors: of a normal distribution there are a sixth. */
static const double crowd_width = 0.1, crowd_share = 2 / 3.0;

/* Lightness is symmetric about zero in the signed map and rises steadily in the other, for readers
 * of all kinds of color vision. */
static const struct scheme {
	struct rgb stops[9];
	int n;
	struct rgb below, above;
} schemes[2] = {
	{ { RGB(0x440154), RGB(0x472D7B), RGB(0x3B528B), RGB(0x2C728E), RGB(0x21918C),
	    RGB(0x28AE80), RGB(0x5EC962), RGB(0xADDC30), RGB(0xFDE725) },
	  9,
	  RGB(0x1D0226),
	  RGB(0xFFF7C2) },
	{ { RGB(0x1F58A4), RGB(0x5E97CC), RGB(0xAFCBE0), RGB(0xE6E6E3), RGB(0xEDC29B),
	    RGB(0xDA8544), RGB(0xA4460F) },
	  7,
	  RGB(0x0C2850),
	  RGB(0x571F05) },
};

const struct rgb colormap_nothing = RGB(0x7C7F82);

/* Source: IEC 61966-2-1. */
double rgb_to_linear(double s)
{
	return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

double rgb_from_linear(double l)
{
	return l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1 / 2.4) - 0.055;
}

static double mix(double a, double b, double t)
{
	return rgb_from_linear((1 - t) * rgb_to_linear(a) + t * rgb_to_linear(b));
}

static double compress(const struct colormap *m, double value)
{
	return m->arsinh ? asinh(value / m->knee) : value;
}

double colormap_position(const struct colormap *m, double value)
{
	double lo = compress(m, m->lo);
	return (compress(m, value) - lo) / (compress(m, m->hi) - lo);
}

double colormap_value(const struct colormap *m, double position)
{
	double lo = compress(m, m->lo), hi = compress(m, m->hi);
	double x = lo + position * (hi - lo);
	return m->arsinh ? m->knee * sinh(x) : x;
}

struct rgb colormap_at(const struct colormap *m, double position)
{
	const struct scheme *s = &schemes[m->is_signed];
	if (m->is_signed && m->lo < 0 && m->hi > 0 && m->lo != -m->hi) {
		double zero = colormap_position(m, 0);
		position = 0.5 + (position - zero) / (2 * fmax(zero, 1 - zero));
	}
	double x = fmin(fmax(position, 0), 1) * (s->n - 1);
	int i = x < s->n - 2 ? (int)x : s->n - 2;
	const struct rgb *a = &s->stops[i], *b = a + 1;
	double t = x - i;
	return (struct rgb){ mix(a->r, b->r, t), mix(a->g, b->g, t), mix(a->b, b->b, t) };
}

struct rgb colormap_below(const struct colormap *m)
{
	return schemes[m->is_signed].below;
}

struct rgb colormap_above(const struct colormap *m)
{
	return schemes[m->is_signed].above;
}

struct rgb colormap_color(const struct colormap *m, double value)
{
	if (isnan(value))
		return colormap_nothing;
	if (value < m->lo)
		return colormap_below(m);
	if (value > m->hi)
		return colormap_above(m);
	return colormap_at(m, colormap_position(m, value));
}

struct sample {
	float value, weight;
};

static int compare_samples(const void *a, const void *b)
{
	const struct sample *x = a, *y = b;
	if (x->value != y->value)
		return x->value < y->value ? -1 : 1;
	return (x->weight > y->weight) - (x->weight < y->weight);
}

/* Finite values with a weight, sorted; returns how many. */
static size_t collect(struct sample *s, const float *values, const float *weights, size_t n)
{
	size_t k = 0;
	for (size_t i = 0; i < n; i++) {
		float weight = weights ? weights[i] : 1;
		if (isfinite(values[i]) && isfinite(weight) && weight > 0)
			s[k++] = (struct sample){ values[i], weight };
	}
	qsort(s, k, sizeof *s, compare_samples);
	return k;
}

static double total_weight(const struct sample *s, size_t n)
{
	double sum = 0;
	for (size_t i = 0; i < n; i++)
		sum += s[i].weight;
	return sum;
}

/* The value that a share of the weight lies below. */
static double quantile(const struct sample *s, size_t n, double share)
{
	double want = share * total_weight(s, n), sum = 0;
	for (size_t i = 0; i < n; i++) {
		sum += s[i].weight;
		if (sum >= want)
			return s[i].value;
	}
	return s[n - 1].value;
}

/* Is there a window of that width which holds that share of the weight? */
static bool crowded(const struct sample *s, size_t n, double width, double share)
{
	double want = share * total_weight(s, n), sum = 0;
	for (size_t first = 0, i = 0; i < n; i++) {
		sum += s[i].weight;
		while (s[i].value - s[first].value > width)
			sum -= s[first++].weight;
		if (sum > want)
			return true;
	}
	return false;
}

/* The next number of the form 1, 2 or 5 times a power of ten, not below x > 0. */
static double round_up(double x)
{
	static const double steps[] = { 1, 2, 5, 10 };
	double power = pow(10, floor(log10(x)));
	for (int i = 0; i < 4; i++)
		if (steps[i] * power >= x * (1 - 1e-12))
			return steps[i] * power;
	return 10 * power;
}

/* Half of the weight has values nearer to zero than this. */
static double median_size(struct sample *s, size_t n)
{
	for (size_t i = 0; i < n; i++)
		s[i].value = fabsf(s[i].value);
	qsort(s, n, sizeof *s, compare_samples);
	return quantile(s, n, 0.5);
}

static void set_range(struct colormap *m, const struct sample *s, size_t n, double rounding)
{
	double first = s[0].value, last = s[n - 1].value;
	double largest = fmax(fabs(first), fabs(last));
	m->lo = quantile(s, n, 0.02);
	m->hi = quantile(s, n, 0.98);
	m->one = last - first <= fmax(1e-4 * largest, rounding);
	if (m->one) {
		/* one value: in the middle between the neutral color and the end */
		m->hi = largest > rounding ? round_up(1.5 * largest) : fmax(rounding, 0);
		m->lo = 0;
	}
	if (m->is_signed) {
		m->hi = fmax(fabs(m->lo), fabs(m->hi));
		m->hi = fmax(m->hi, rounding);
		m->lo = -m->hi;
	} else if (m->lo > 0 && m->lo < 0.05 * m->hi) {
		m->lo = 0;
	} else if (m->hi - m->lo < rounding) {
		m->hi = m->lo + rounding;
	}
	if (!(m->hi > m->lo)) {
		/* most of the area has one value, and the rest is what differs */
		m->lo = m->is_signed ? -largest : fmin(first, 0);
		m->hi = largest > m->lo ? largest : m->lo + 1;
	}
}

enum status colormap_fit(struct colormap *m, bool is_signed, enum colormap_scale scale,
                         double rounding, const float *values, const float *weights, size_t n)
{
	*m = (struct colormap){
		.is_signed = is_signed, .lo = is_signed ? -1 : 0, .hi = 1, .knee = 1
	};
	struct sample *s = malloc((n ? n : 1) * sizeof *s);
	if (!s)
		return ST_RESOURCE;
	n = collect(s, values, weights, n);
	if (n) {
		set_range(m, s, n, rounding);
		double reach = fmax(fabs(m->lo), fabs(m->hi));
		m->arsinh = scale == COLORMAP_ARSINH ||
		            (scale == COLORMAP_AUTOMATIC && !m->one &&
		             crowded(s, n, crowd_width * (m->hi - m->lo), crowd_share));
		double knee = fmin(fmax(median_size(s, n), 1e-4 * reach), 0.2 * reach);
		m->knee = round_up(knee);
	}
	free(s);
	return ST_OK;
}

void colormap_set_range(struct colormap *m, double lo, double hi)
{
	double before = fmax(fabs(m->lo), fabs(m->hi)), after = fmax(fabs(lo), fabs(hi));
	m->lo = lo;
	m->hi = hi;
	m->by_hand = true;
	m->one = false;
	m->knee = round_up(fmax(m->knee * after / before, 1e-4 * after));
}
