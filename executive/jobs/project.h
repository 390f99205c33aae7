/* project.h - the project folder: where .batten/ is, and what lies in it. */
#ifndef BATTEN_PROJECT_H
#define BATTEN_PROJECT_H

#include "report.h"

struct project {
	char *folder; /* owned; absolute */
	char *hidden; /* owned; folder/.batten */
	char *socket; /* owned; $XDG_RUNTIME_DIR/batten/HASH, else /tmp/batten-UID/HASH */
};

/* The nearest folder upward from `from` (NULL: the current one) that holds .batten/, else `from`.
 * Nothing is made. Errors: ST_RESOURCE. */
enum status project_find(struct project *p, const char *from, const struct report *r);
void project_finish(struct project *p);

/* Can jobs be kept there? Their records are JSON, and name the folder. ST_INPUT where its name is no UTF-8. */
enum status project_check(const struct project *p, const struct report *r);

/* Make .batten/ with inputs/ parts/ jobs/ logs/, and the socket's folder (mode 700, owned by this
 * user; anything else there is an error). */
enum status project_make(const struct project *p, const struct report *r);

#endif
