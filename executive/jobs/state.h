/* state.h - what can happen to a job, and in which state. */
#ifndef BATTEN_STATE_H
#define BATTEN_STATE_H

#include <stdbool.h>

#include "stats.h"

/* name, what a user may ask for (as in "cannot be ..."), or NULL: it happens */
#define JOB_EVENT_MAP(X)                                                                           \
	X(HOLD, "held")                                                                            \
	X(RELEASE, "released")                                                                     \
	X(SUSPEND, "suspended")                                                                    \
	X(ACTIVATE, "activated")                                                                   \
	X(KILL, "killed")                                                                          \
	X(RETRY, "tried again")                                                                    \
	X(LAUNCH, NULL)    /* its turn has come */                                                 \
	X(REFUSE, NULL)    /* it cannot start: no process, or a job it waits for failed */         \
	X(GREET, NULL)     /* HELLO */                                                             \
	X(STOPPED, NULL)   /* its process stopped */                                               \
	X(CONTINUED, NULL) /* and goes on */                                                       \
	X(BREAK, NULL)     /* it did what no worker may */                                         \
	X(LATE, NULL)      /* its deadline passed */                                               \
	X(LEAVE, NULL)     /* the service ends */                                                  \
	X(GONE, NULL)      /* its pipe has ended and its exit has been seen */

#define X(name, asked) EV_##name,
enum job_event { JOB_EVENT_MAP(X) N_JOB_EVENTS };
#undef X

extern const char *const job_event_asked[N_JOB_EVENTS];

/* Is that possible in that state? */
bool job_can(enum job_state state, enum job_event event);

#endif
