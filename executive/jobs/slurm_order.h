/* slurm_order.h - run a program of Slurm without waiting for it, and hear what it says. */
#ifndef BATTEN_SLURM_ORDER_H
#define BATTEN_SLURM_ORDER_H

#include <stdbool.h>
#include <stdint.h>

#include <uv.h>

#include "report.h"

struct orders; /* opaque; those that run */

/* status: exit status, -1 where it could not be started or was ended. Loop thread, never from inside
 * order_run. */
typedef void order_done(void *data, int64_t tag, int status, const char *output);

/* of what it says; after so long it is killed */
enum { ORDER_OUTPUT_MAX = 16 << 20, ORDER_MS = 30000 };

/* loop is borrowed. Errors: ST_RESOURCE. */
enum status orders_create(struct orders **out, uv_loop_t *loop);
/* argv[0] is looked for in PATH. A false return: it could not be started, nothing is called. */
bool order_run(struct orders *c, char *const argv[], order_done *done, void *data, int64_t tag);
/* Hear no more of them: what was asked of Slurm is still done; free with orders_destroy after the loop has run out. */
void orders_close(struct orders *c);
void orders_destroy(struct orders *c); /* NULL is fine */

/* Run one and wait, at most `ms`. For the service's start, while no loop runs. False: it could not be
 * run, failed, or was ended for its time. said: it wrote something; may be NULL. */
bool order_wait(char *const argv[], int ms, bool *said);

#endif
