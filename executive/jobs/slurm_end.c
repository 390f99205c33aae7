/* slurm_end.c - how a process in Slurm ended, from srun's exit and its last words. */
#include "slurm_end.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What srun and slurmstepd say (Slurm 22.05); the first that is found counts. */
static const struct {
	const char *says;
	bool lost;
	const char *means; /* NULL: the rest of its line */
} endings[] = {
	{ "error: Node failure on ", true, "the node failed" },
	{ "DUE TO NODE FAILURE", true, "the node failed" },
	{ "DUE TO PREEMPTION", true, "Slurm took its node for another job" },
	{ "DUE TO TIME LIMIT", false,
	  "it took longer than Slurm allows; give it more with --time or the setting slurm-time" },
	{ "Out Of Memory", false,
	  "it took more memory than Slurm allows; allow more with --memory" },
	{ "oom-kill", false, "it took more memory than Slurm allows; allow more with --memory" },
	{ "CANCELLED AT ", false, "it was cancelled in Slurm from outside" },
	{ "error: Unable to allocate resources: ", false, NULL },
	{ "srun: fatal: ", false, NULL },
	{ "srun: error: Invalid ", false, NULL },
	{ "srun: unrecognized option ", false, "srun does not know an option; see slurm-options" },
	{ "error: Unable to create step", false, NULL },
	{ "error: Unable to contact slurm controller", false, NULL },
};

void slurm_end(struct launcher_exit *e, const char *words)
{
	e->cpu_s = NAN; /* srun's own */
	e->peak_kib = -1;
	if (e->signal) {
		e->lost = true;
		snprintf(e->why, sizeof e->why, "its srun was killed from outside");
		return;
	}
	for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
		const char *at = strstr(words, endings[i].says);
		if (!at)
			continue;
		e->lost = endings[i].lost;
		if (!e->status)
			e->status = 1;
		at += strlen(endings[i].says);
		if (endings[i].means)
			snprintf(e->why, sizeof e->why, "%s", endings[i].means);
		else
			snprintf(e->why, sizeof e->why, "Slurm refuses it: %.*s",
			         (int)strcspn(at, "\n"), at);
		return;
	}
	if (e->status > 128 && e->status < 128 + 65) {
		e->signal = e->status - 128;
		e->status = 0;
	}
}

const char *slurm_reason(const char *reason)
{
	static const struct {
		const char *slurm, *means;
	} table[] = {
		{ "None", "it has not looked yet" },
		{ "Resources", "no node is free" },
		{ "Priority", "others are before it" },
		{ "PartitionConfig", "the partition has no such nodes" },
		{ "JobHeldUser", "held" },
		{ "JobHeldAdmin", "held by the administrator" },
		{ "ReqNodeNotAvail", "a node it needs is not available" },
		{ "BeginTime", "its time has not come" },
		{ "PartitionTimeLimit", "it asks for more time than the partition allows" },
		{ "QOSMaxJobsPerUserLimit", "you have as many jobs as you may" },
		{ "AssocGrpCpuLimit", "the account has used its processors" },
	};
	for (size_t i = 0; i < sizeof table / sizeof *table; i++)
		if (!strcmp(table[i].slurm, reason))
			return table[i].means;
	return reason;
}
