/* record.h - can a record be sent as it lies in the ledger? Private to the ledger. */
#ifndef BATTEN_RECORD_H
#define BATTEN_RECORD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Whether the text is, byte for byte, one that stats_write_brief could have written for that job in that
 * state: whoever reads it gets a job. False where that is not certain: then it is to be taken apart. */
bool record_is_sound(const char *text, size_t n, int64_t id, const char *state);

#endif
