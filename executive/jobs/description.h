/* description.h - is what a worker says of itself right? */
#ifndef BATTEN_DESCRIPTION_H
#define BATTEN_DESCRIPTION_H

#include "roster.h"

/* NULL, or what is wrong with w's description; fresh. */
char *description_fault(const struct roster_worker *w);

#endif
