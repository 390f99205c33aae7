/* service.h - the service: the one process of a project folder that owns its jobs. */
#ifndef BATTEN_SERVICE_H
#define BATTEN_SERVICE_H

#include "project.h"
#include "settings.h"

/*
 * Serve the project's jobs until SHUTDOWN comes, SIGTERM or SIGINT (the same), or nothing was to do
 * for `idle` seconds. Takes the project's lock, resumes what was running, listens on its socket.
 * When it listens it closes the descriptor that the environment names in BATTEN_READY_FD.
 * The program must not have started threads; its working folder becomes the project's.
 *
 * Requests, beside those that just name jobs (jobs: ids, or group, or all; each replies with the
 * JOB records it changed, then END, or ERROR):
 *	SUBMIT   jobs: job objects with the fields of stats_to_json that a client knows: worker,
 *	         file_name, path_name, group, priority, inputs, parameters, output, after, threads,
 *	         memory_mib, force (the rest is the service's own); "after" may name an earlier job
 *	         of the same request as -1 - INDEX. An element that is a string is the path of a
 *	         JSON file of such an object or an array of them: for what fits no packet. All are
 *	         queued, or none.
 *	LIST     by default the jobs that have not ended and those that ended in the last hour.
 *	WATCH    JOB for each job named, then at each change, END when all named have ended. Without
 *	         jobs and group: every job that has not ended, the last 1,000 that have, and later
 *	         ones. stay: true: without end.
 *	WAIT     END when all named have ended; a JOB for each before it.
 *	LOG      TEXT pieces of the log, END; with follow: goes on until the job has ended.
 *	KILL     END when the jobs have ended. by: who, in words, for the reason.
 *	PRUNE    forget the jobs that have ended: JOB for each, END.
 *	SHUTDOWN END when running jobs have stopped at a unit and are queued for the next start.
 *
 * Errors: ST_RESOURCE (another service holds the folder, no ledger, no socket).
 */
enum status service_run(const struct project *p, const struct settings *s, const struct report *r);

#endif
