/* hook.c - a user's command, run at the end of each job and of each group. */
#include "hook.h"

#include <stdlib.h>
#include <string.h>

#include "text.h"

extern char **environ;

/* commands at once; a command that never ends keeps only later ones waiting */
enum { HOOKS_AT_ONCE = 4, HOOKS_WAITING = 10000, HOOK_WORDS = 6 };

struct hook {
	uv_process_t process;
	struct hooks *hooks; /* borrowed */
	struct hook *next;
	char *words[HOOK_WORDS]; /* owned; KEY=VALUE */
};

struct hooks {
	uv_loop_t *loop;
	char *command;              /* owned */
	struct hook *first, **last; /* waiting */
	struct hook *running;
	int n_running, n_waiting;
	bool closing;
};

enum status hooks_create(struct hooks **out, uv_loop_t *loop, const char *command)
{
	struct hooks *h = calloc(1, sizeof *h);
	if (!h || !(h->command = strdup(command))) {
		free(h);
		return ST_RESOURCE;
	}
	h->loop = loop;
	h->last = &h->first;
	*out = h;
	return ST_OK;
}

bool hooks_wanted(const struct hooks *h)
{
	return *h->command;
}

static void hook_destroy(struct hook *k)
{
	for (int i = 0; i < HOOK_WORDS; i++)
		free(k->words[i]);
	free(k);
}

static void hooks_start(struct hooks *h);

static void on_closed(uv_handle_t *handle)
{
	hook_destroy(handle->data);
}

static void on_exit_seen(uv_process_t *process, int64_t status, int signal)
{
	struct hook *k = process->data, **at = &k->hooks->running;
	(void)status;
	(void)signal;
	while (*at != k)
		at = &(*at)->next;
	*at = k->next;
	k->hooks->n_running--;
	uv_close((uv_handle_t *)process, on_closed);
	hooks_start(k->hooks);
}

/* The service's own environment and the hook's words. */
static char **environment(const struct hook *k)
{
	size_t n = 0;
	while (environ[n])
		n++;
	char **e = calloc(n + HOOK_WORDS + 1, sizeof *e);
	if (!e)
		return NULL;
	memcpy(e, environ, n * sizeof *e);
	memcpy(e + n, k->words, sizeof k->words);
	return e;
}

static void hook_start(struct hook *k)
{
	struct hooks *h = k->hooks;
	char shell[] = "/bin/sh", option[] = "-c";
	char *words[] = { shell, option, h->command, NULL };
	uv_stdio_container_t io[] = {
		{ .flags = UV_IGNORE },
		{ .flags = UV_INHERIT_FD, .data.fd = 2 },
		{ .flags = UV_INHERIT_FD, .data.fd = 2 },
	};
	uv_process_options_t options = {
		.file = shell,
		.args = words,
		.env = environment(k),
		.stdio = io,
		.stdio_count = 3,
		.flags = UV_PROCESS_DETACHED,
		.exit_cb = on_exit_seen,
	};
	k->process.data = k;
	if (!options.env) {
		hook_destroy(k);
		return;
	}
	if (uv_spawn(h->loop, &k->process, &options)) {
		uv_close((uv_handle_t *)&k->process, on_closed);
	} else {
		k->next = h->running;
		h->running = k;
		h->n_running++;
	}
	free(options.env);
}

static void hooks_start(struct hooks *h)
{
	while (h->first && h->n_running < HOOKS_AT_ONCE && !h->closing) {
		struct hook *k = h->first;
		h->first = k->next;
		if (!h->first)
			h->last = &h->first;
		h->n_waiting--;
		hook_start(k);
	}
}

void hooks_run(struct hooks *h, const char *event, const struct Stats *s, const char *state)
{
	struct hook *k = h->closing || h->n_waiting >= HOOKS_WAITING ? NULL : calloc(1, sizeof *k);
	if (!k)
		return;
	k->hooks = h;
	k->words[0] = text_print("BATTEN_EVENT=%s", event);
	k->words[1] = text_print("BATTEN_JOB=%lld", (long long)s->id);
	k->words[2] = text_print("BATTEN_STATE=%s", state);
	k->words[3] = text_print("BATTEN_WORKER=%s", s->worker ? s->worker : "");
	k->words[4] = text_print("BATTEN_GROUP=%s", s->group ? s->group : "");
	k->words[5] = text_print("BATTEN_REASON=%s", s->reason ? s->reason : "");
	for (int i = 0; i < HOOK_WORDS; i++)
		if (!k->words[i]) {
			hook_destroy(k);
			return;
		}
	*h->last = k;
	h->last = &k->next;
	h->n_waiting++;
	hooks_start(h);
}

void hooks_close(struct hooks *h)
{
	struct hook *next;
	h->closing = true;
	for (struct hook *k = h->running; k; k = next) {
		next = k->next;
		uv_close((uv_handle_t *)&k->process, on_closed);
	}
	h->running = NULL;
	for (struct hook *k = h->first; k; k = next) {
		next = k->next;
		hook_destroy(k);
	}
	h->first = NULL;
}

void hooks_destroy(struct hooks *h)
{
	if (!h)
		return;
	free(h->command);
	free(h);
}
