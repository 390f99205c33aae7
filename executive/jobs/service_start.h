/* service_start.h - start a project's service, and wait until it listens. */
#ifndef BATTEN_SERVICE_START_H
#define BATTEN_SERVICE_START_H

#include "project.h"

/* In a session of its own, from the program that runs. Another one that is quicker does no harm. Errors:
 * ST_RESOURCE (no such program; it neither listens nor reads its ledger within ten seconds). */
enum status service_start(const struct project *p, const struct report *r);

#endif
