/* local.h - the launcher of workers on this machine. */
#ifndef BATTEN_LOCAL_H
#define BATTEN_LOCAL_H

#include <uv.h>

#include "launcher.h"
#include "project.h"

struct local; /* opaque */

/* loop and p are borrowed. Errors: ST_RESOURCE (no memory, no batten-launch).
 * Thread: the loop's, and that thread must live as long as the workers. */
enum status local_create(struct local **out, uv_loop_t *loop, const struct project *p, int niceness,
                         const struct report *r);
/*
 * For a launcher that stands on this one: the command to start for a job in place of its worker, at
 * most SPAWN_WORDS words and a NULL, all owned by the caller. Niceness and memory are then its business.
 */
typedef enum status local_words(void *data, const struct Stats *s, const char *worker,
                                char ***words, const struct report *r);
void local_wrap(struct local *l, local_words *words, void *data);
void local_words_free(char **words);

/* Seconds that each process has for its first packet; the queue itself sees only the first of a job that
 * is cut. 0, as at first: any time. */
void local_hello(struct local *l, double seconds);

/* The launcher to give to a queue, then the queue's sink to give back. */
const struct launcher *local_launcher(struct local *l);
void local_connect(struct local *l, struct launcher_sink sink);
/* Kill what is left and close every handle; free with local_destroy after the loop has run out. */
void local_close(struct local *l);
void local_destroy(struct local *l);

#endif
