/* team.h - the processes of one job that is cut. Private to the crew. */
#ifndef BATTEN_TEAM_H
#define BATTEN_TEAM_H

#include "crew.h"
#include "text.h"

/* One process: a shard's, or at the end the one that joins them. */
struct member {
	int64_t id;
	int64_t done, total; /* units; total 0: not known */
	int losses;
	bool live, waiting, greeted, finished, exited, drained, stopped;
	struct launcher_exit exit;
};

struct team {
	struct team *next;
	const struct launcher *launcher;   /* borrowed; where its processes run */
	const struct launcher_sink *above; /* borrowed; the queue's */
	struct Stats stats;                /* as it was started, for the processes begun later */
	struct member *members; /* owned; the shards, then the one that joins; NULL: not cut */
	int n_shards;
	bool greeted;   /* HELLO was passed on */
	bool ending;    /* somebody wants its end: nothing is begun again */
	bool failed;    /* one member failed: exit says how */
	bool joining;   /* the shards are done */
	bool suspended; /* as told above */
	struct text hosts;
	double cpu_s; /* of the members that ended */
	int64_t peak_kib;
	struct launcher_exit exit;
};

/* Start the shards; on failure none is left. pid, host and log of s are filled in. */
enum status team_start(struct team *t, struct Stats *s, const struct report *r);
void team_finish(struct team *t); /* lets go of members that are left */

/* What the queue asks of all members. */
enum status team_send(struct team *t, enum message_type type, const json_t *body);
void team_signal(struct team *t, enum launcher_signal signal);

/* What a member's launcher tells. */
struct member *team_member(struct team *t, int64_t id);
void team_packet(struct team *t, struct member *m, const struct message *packet);
void team_exited(struct team *t, struct member *m, const struct launcher_exit *e);
void team_drained(struct team *t, struct member *m);
void team_stopped(struct team *t, struct member *m, bool stopped);
void team_refused(struct team *t); /* one is not stopped: all go on */
void team_waits(struct team *t, struct member *m, const char *reason);

#endif
