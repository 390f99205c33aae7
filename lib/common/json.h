/* json.h - what the program needs around jansson: typed look-ups that never trust the text. */
#ifndef BATTEN_JSON_H
#define BATTEN_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "report.h"
#include "text.h"

/* A member as text, or fallback where it is missing, null or of another type. Borrowed from o. */
const char *json_text(const json_t *o, const char *key, const char *fallback);
int64_t json_int(const json_t *o, const char *key, int64_t fallback);
double json_number(const json_t *o, const char *key, double fallback);
bool json_flag(const json_t *o, const char *key, bool fallback);

/* Set a member; a NULL text, and a number that is not finite, is set to null. */
void json_set_text(json_t *o, const char *key, const char *value);
void json_set_int(json_t *o, const char *key, int64_t value);
void json_set_number(json_t *o, const char *key, double value);

/* A number, or null where it is not finite. New reference. */
json_t *json_real_or_null(double x);

/*
 * Parse n bytes as one JSON object. *out is a new reference.
 * `what` names the source in the sentence. Errors: ST_INPUT, ST_RESOURCE.
 */
enum status json_parse_object(const char *text, size_t n, const char *what, json_t **out,
                              const struct report *r);

/* Append v, indented as it stands within `depth` brackets. */
void json_write_at(struct text *t, const json_t *v, int depth);

/* Write o with shortest round-trip numbers, members in order of insertion. Caller frees; NULL:
 * memory ran out. */
char *json_write(const json_t *o, bool indented);

#endif
