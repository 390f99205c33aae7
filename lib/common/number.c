/* number.c - decimal numbers, read exactly and written shortest.
 *
 * Reading: up to 19 digits are held exactly in 64 bits. With at most 2^53 and a power of ten up to
 * 10^22 both are exact doubles and one operation rounds right (Clinger 1990). Where long double
 * has 64 bits of mantissa, powers up to 10^27 are exact in it too: one operation there errs by half
 * a unit of its last place, which rounds right to double unless the extra bits lie next to a tie.
 * What is left goes to strtod.
 */
#include "number.h"

#include <errno.h>
#include <float.h>
#include <inttypes.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double power10[] = { 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
	                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
	                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };

enum { POWER_DOUBLE = 22, DIGITS_MAX = 19 };

#if LDBL_MANT_DIG == 64
enum { POWER_LONG = 27 };
static const long double power10_long[] = { 1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,
	                                    1e7L,  1e8L,  1e9L,  1e10L, 1e11L, 1e12L, 1e13L,
	                                    1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L, 1e20L,
	                                    1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L };

/* m 10^e by one rounding in 64 bits, where the second one, to 53, cannot go wrong. No extra bits
 * at all: exact by a rare chance, or an emulator (valgrind's is one) or a precision control that
 * leaves long double no more than a double has; neither is trusted. */
static bool scale_long(uint64_t m, int e, double *out)
{
	long double x = (long double)m;
	uint64_t bits;

	if (e < -POWER_LONG || e > POWER_LONG)
		return false;
	x = e < 0 ? x / power10_long[-e] : x * power10_long[e];
	memcpy(&bits, &x, sizeof bits);
	unsigned extra = bits & 0x7ff;
	if (extra == 0 || (extra >= 0x3ff && extra <= 0x401))
		return false;
	*out = (double)x;
	return fabs(*out) >= DBL_MIN;
}
#else
static bool scale_long(uint64_t m, int e, double *out)
{
	(void)m, (void)e, (void)out;
	return false;
}
#endif

/* The C locale's strtod on [s, end) with D exponents made E. */
static double read_slowly(const char *s, const char *end)
{
	char small[128], *copy = small;
	size_t n = (size_t)(end - s);
	static locale_t c_locale;

	if (!__atomic_load_n(&c_locale, __ATOMIC_ACQUIRE)) {
		locale_t made = newlocale(LC_ALL_MASK, "C", (locale_t)0), none = (locale_t)0;
		if (!__atomic_compare_exchange_n(&c_locale, &none, made, false, __ATOMIC_ACQ_REL,
		                                 __ATOMIC_ACQUIRE))
			freelocale(made);
	}
	if (n >= sizeof small) {
		copy = malloc(n + 1);
		if (!copy)
			return NAN;
	}
	for (size_t i = 0; i < n; i++)
		copy[i] = s[i] == 'd' || s[i] == 'D' ? 'e' : s[i];
	copy[n] = 0;
	double x = strtod_l(copy, NULL, c_locale);
	if (copy != small)
		free(copy);
	return x;
}

static inline bool is_digit(char c)
{
	return (unsigned char)(c - '0') < 10;
}

bool number_read(const char **s, const char *end, double *out)
{
	const char *p = *s, *start = p;
	bool negative = false, any = false;
	uint64_t m = 0;
	int digits = 0, exponent = 0;

	if (p < end && (*p == '-' || *p == '+'))
		negative = *p++ == '-';
	for (; p < end && is_digit(*p); p++, any = true) {
		if (digits < DIGITS_MAX)
			m = 10 * m + (uint64_t)(*p - '0');
		digits += m > 0;
	}
	if (p < end && *p == '.') {
		const char *point = ++p;
		int kept = 0;
		for (; p < end && is_digit(*p); p++, any = true) {
			if (digits < DIGITS_MAX) {
				m = 10 * m + (uint64_t)(*p - '0');
				kept = (int)(p - point) + 1;
			}
			digits += m > 0;
		}
		exponent = -kept;
	}
	if (!any)
		return false;
	if (p < end && (*p == 'e' || *p == 'E' || *p == 'd' || *p == 'D')) {
		const char *q = p + 1;
		bool down = false;
		int e = 0;
		if (q < end && (*q == '-' || *q == '+'))
			down = *q++ == '-';
		if (q < end && is_digit(*q)) {
			for (; q < end && is_digit(*q); q++)
				if (e < 100000)
					e = 10 * e + (*q - '0');
			exponent += down ? -e : e;
			p = q;
		}
	}
	*s = p;

	double x = (double)m;
	if (digits <= DIGITS_MAX && m <= (UINT64_C(1) << 53) && exponent >= -POWER_DOUBLE &&
	    exponent <= POWER_DOUBLE)
		x = exponent < 0 ? x / power10[-exponent] : x * power10[exponent];
	else if (m == 0)
		x = 0;
	else if (digits > DIGITS_MAX || !scale_long(m, exponent, &x)) {
		*out = read_slowly(start, p);
		return !isnan(*out);
	}
	*out = negative ? -x : x;
	return true;
}

bool number_read_integer(const char **s, const char *end, int64_t *out)
{
	const char *p = *s;
	bool negative = false;
	int64_t x = 0;

	if (p < end && (*p == '-' || *p == '+'))
		negative = *p++ == '-';
	if (p >= end || !is_digit(*p))
		return false;
	for (; p < end && is_digit(*p); p++) {
		int digit = *p - '0';
		if (__builtin_mul_overflow(x, 10, &x) ||
		    __builtin_sub_overflow(x, digit, &x)) /* kept negative: one more value */
			return false;
	}
	if (!negative && x == INT64_MIN)
		return false;
	*out = negative ? x : -x;
	*s = p;
	return true;
}

bool number_parse(const char *s, double *out)
{
	const char *end = s + strlen(s);

	return number_read(&s, end, out) && s == end && isfinite(*out);
}

bool number_parse_integer(const char *s, int64_t *out)
{
	const char *end = s + strlen(s);

	return number_read_integer(&s, end, out) && s == end;
}

/* A number of thousandths, without sprintf. r / 1000 is rounded right, so is what reading rounds to: where
 * they are equal these digits are the shortest. False for another. */
static bool write_thousandths(char *out, double x, int *n)
{
	double a = fabs(x);
	if (!(a < 1e12))
		return false;
	uint64_t r = (uint64_t)(a * 1e3 + 0.5);
	if ((double)r / 1e3 != a || !r)
		return false;
	char digits[24], *p = digits + sizeof digits;
	unsigned rest = (unsigned)(r % 1000);
	int places = 3;
	for (r /= 1000; rest && rest % 10 == 0; places--)
		rest /= 10;
	if (rest) {
		for (; places; places--, rest /= 10)
			*--p = (char)('0' + rest % 10);
		*--p = '.';
	}
	do
		*--p = (char)('0' + r % 10);
	while (r /= 10);
	if (x < 0)
		*--p = '-';
	*n = (int)(digits + sizeof digits - p);
	memcpy(out, p, (size_t)*n);
	out[*n] = 0;
	return true;
}

/* Decimal digits d, the first of them worth 10^e, as printf's %g has them. */
static int write_digits(char *out, bool negative, uint64_t d, int e, int n_digits)
{
	char digits[DIGITS_MAX + 1], *p = out;
	int n = n_digits;

	for (int i = n - 1; i >= 0; i--, d /= 10)
		digits[i] = (char)('0' + d % 10);
	while (n > 1 && digits[n - 1] == '0')
		n--;
	if (negative)
		*p++ = '-';
	if (e < -4) {
		*p++ = digits[0];
		if (n > 1)
			*p++ = '.';
		memcpy(p, digits + 1, (size_t)n - 1);
		p += n - 1;
		return (int)(p - out) + sprintf(p, "e-%02d", -e);
	}
	if (e < 0) {
		*p++ = '0';
		*p++ = '.';
		for (int i = e + 1; i < 0; i++)
			*p++ = '0';
		memcpy(p, digits, (size_t)n);
		p += n;
	} else {
		for (int i = 0; i < n || i <= e; i++) {
			if (i == e + 1)
				*p++ = '.';
			*p++ = i < n ? digits[i] : '0';
		}
	}
	*p = 0;
	return (int)(p - out);
}

#ifdef __SIZEOF_INT128__
typedef unsigned __int128 wide;

static wide wide_power10(int k)
{
	static const uint64_t power[] = { 1,
		                          10,
		                          100,
		                          1000,
		                          10000,
		                          100000,
		                          1000000,
		                          10000000,
		                          100000000,
		                          1000000000,
		                          10000000000,
		                          100000000000,
		                          1000000000000,
		                          10000000000000,
		                          100000000000000,
		                          1000000000000000,
		                          10000000000000000,
		                          100000000000000000,
		                          1000000000000000000 };
	return k <= 18 ? power[k] : (wide)power[18] * power[k - 18];
}

/*
 * What printf and reading it back would come to, in whole numbers of 128 bits: x is m 2^-s, its
 * digits are m 10^k 2^-s rounded, and they read back as x where they are off by less than half of
 * x's last place, 10^k / 2 in the same unit. False where that does not fit, or where the place below
 * x is narrower.
 */
static bool write_exact(char *out, double x, int *n)
{
	uint64_t bits, m;

	memcpy(&bits, &x, sizeof bits);
	const int s = 1075 - (int)(bits >> 52 & 0x7ff);
	m = bits & ((UINT64_C(1) << 52) - 1);
	if (s < 4 || s > 69 || m == 0)
		return false;
	m |= UINT64_C(1) << 52;
	/* floor of the logarithm, or one less: 315653 / 2^20 is a little below log10(2) */
	int e = ((52 - s) * 315653) >> 20;
	if (m * wide_power10(16 - e) >> s >= wide_power10(17))
		e++;
	for (int digits = 15; digits <= 17; digits++) {
		const int k = digits - 1 - e;
		const wide exact = m * wide_power10(k), one = (wide)1 << s,
		           rest = exact & (one - 1);
		uint64_t d = (uint64_t)(exact >> s);
		const bool up = 2 * rest > one || (2 * rest == one && (d & 1));
		const wide off = 2 * (up ? one - rest : rest), half = wide_power10(k);

		if (off > half || (off == half && (m & 1)))
			continue;
		d += up;
		if (d == (uint64_t)wide_power10(digits)) {
			d /= 10;
			e++;
		}
		*n = write_digits(out, x < 0, d, e, digits);
		return true;
	}
	return false;
}
#else
static bool write_exact(char *out, double x, int *n)
{
	(void)out, (void)x, (void)n;
	return false;
}
#endif

int number_write(char out[NUMBER_SIZE], double x)
{
	if (isnan(x))
		return sprintf(out, "nan");
	if (isinf(x))
		return sprintf(out, x < 0 ? "-inf" : "inf");
	int n = 0;
	if (write_thousandths(out, x, &n))
		return n;
	if (fabs(x) < 1e15 && x == (double)(int64_t)x && !(x == 0 && signbit(x)))
		return sprintf(out, "%" PRId64, (int64_t)x);
	if (write_exact(out, x, &n))
		return n;
	for (int digits = 15; digits <= 17; digits++) {
		double back;
		n = sprintf(out, "%.*g", digits, x);
		for (int i = 0; i < n; i++) /* a locale's point */
			if (out[i] == ',')
				out[i] = '.';
		const char *s = out;
		if (number_read(&s, out + n, &back) && back == x)
			break;
	}
	return n;
}
