/* number.h - decimal numbers, read exactly and written shortest. Independent of the locale. */
#ifndef BATTEN_NUMBER_H
#define BATTEN_NUMBER_H

#include <stdbool.h>
#include <stdint.h>

enum { NUMBER_SIZE = 32 }; /* room for any double written, with its zero byte */

/*
 * Write the shortest decimal that reads back to the same double; returns its length.
 * NaN and infinities are written nan, inf, -inf.
 */
int number_write(char out[NUMBER_SIZE], double x);

/*
 * Read a decimal number at *s, not beyond end; correctly rounded. On success *s is behind it.
 * Takes an optional sign, digits with an optional point, an exponent by e E d D (Fortran).
 * No white space, no hexadecimal, no nan. Too large a number reads as infinity.
 * Accuracy: the nearest double, ties to even.
 */
bool number_read(const char **s, const char *end, double *out);

/* Read a decimal integer at *s (optional sign), likewise; false on overflow. */
bool number_read_integer(const char **s, const char *end, int64_t *out);

/* The whole string is one finite number; for options and fields. */
bool number_parse(const char *s, double *out);
bool number_parse_integer(const char *s, int64_t *out);

#endif
