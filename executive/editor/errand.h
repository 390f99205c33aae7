/* errand.h - one call of a routine with all that comes of it, on this thread or on one of its own.
 *
 * Who holds the world: from errand_start until errand_over says true the errand's thread does, and
 * nobody else may read or change it. The window goes on with what it has painted already. */
#ifndef BATTEN_ERRAND_H
#define BATTEN_ERRAND_H

#include "routine.h"
#include "text.h"

struct errand; /* opaque */

/* As the `picture` of an act. */
typedef enum status errand_picture(const struct world *w, const struct picture_wish *wish,
                                   const struct report *r);

/* world and project are borrowed until the errand is destroyed; names and values are copied. picture
 * may be NULL.
 * Errors: ST_RESOURCE. */
enum status errand_create(struct errand **out, const struct routine *t, struct world *w,
                          const struct project *p, const struct arguments *given,
                          errand_picture *picture);
void errand_destroy(struct errand *e); /* waits for its thread; NULL is fine */

/* Call the routine, which writes the journal. */
void errand_run(struct errand *e);
/* The same on a thread of its own; wake is called on that thread: at the end, and when there is
 * progress, ten times a second at most. Errors: ST_RESOURCE. */
enum status errand_start(struct errand *e, void (*wake)(void *data), void *data);
bool errand_over(struct errand *e);
void errand_stop(struct errand *e); /* it ends with ST_CANCELLED when it sees that */
/* NaN: not known. */
double errand_progress(struct errand *e, char what[128]);

/* Of one that is over. Borrowed. */
int errand_jobs(const struct errand *e); /* when it is over: how many it queued */
const struct routine *errand_routine(const struct errand *e);
const struct arguments *errand_given(const struct errand *e);
enum status errand_status(const struct errand *e);
const char *errand_error(const struct errand *e); /* "" if none */
const char *errand_said(const struct errand *e);  /* lines; "" if none */
const char *errand_warning(const struct errand *e);

#endif
