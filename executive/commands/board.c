/* board.c - a live board of jobs in the terminal. */
#include "board.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "path.h"

enum { BAR = 20, LINES_FALLBACK = 24 };

void board_init(struct board *b, bool color)
{
	*b = (struct board){ .out = stderr, .live = isatty(STDERR_FILENO) };
	b->color = color && b->live;
	if (!b->live)
		return;
	sigset_t
	        gone_on; /* looked for at each drawing; a process that is stopped goes on all the same */
	sigemptyset(&gone_on);
	sigaddset(&gone_on, SIGCONT);
	sigprocmask(SIG_BLOCK, &gone_on, NULL);
}

void board_finish(struct board *b)
{
	job_list_finish(&b->list);
	free(b->told);
}

bool board_put(void *data, const struct Stats *s)
{
	struct board *b = data;

	job_list_put(&b->list, s);
	return true;
}

bool board_all_over(const struct board *b)
{
	for (size_t i = 0; i < b->list.n; i++)
		if (!job_state_table[b->list.jobs[i].state].over)
			return false;
	return true;
}

/* Eighths of a block make a bar of BAR columns move smoothly. */
static void draw_bar(double fraction, FILE *out)
{
	static const char *const part[] = { " ", "▏", "▎", "▍", "▌", "▋", "▊", "▉" };
	int eighths = isfinite(fraction) ? (int)(fraction * BAR * 8) : 0;

	for (int i = 0; i < BAR; i++) {
		int here = eighths - 8 * i;
		fputs(here >= 8 ? "█" : here > 0 ? part[here] : "·", out);
	}
}

static void draw_line(const struct board *b, const struct Stats *s)
{
	double fraction = stats_fraction(s);
	char time[16] = "", percent[8] = "";

	if (isfinite(fraction))
		snprintf(percent, sizeof percent, "%d%%", (int)(100 * fraction));
	format_seconds(job_state_table[s->state].over ? s->wall_s : s->eta_s, time);
	print_state_color(s->state, b->color, b->out);
	fprintf(b->out, "%s %-9s", job_state_table[s->state].glyph, job_state_table[s->state].word);
	print_plain(b->color, b->out);
	fprintf(b->out, " %4lld %-10.10s %-16.16s ", (long long)s->id, s->worker ? s->worker : "",
	        s->file_name ? path_file_name(s->file_name) : "");
	print_state_color(s->state, b->color, b->out);
	draw_bar(fraction, b->out);
	print_plain(b->color, b->out);
	fprintf(b->out, " %4s %7s", percent, time);
}

/* Does what was drawn last still stand where the cursor believes it does? A terminal of another size has
 * wrapped it anew, and behind a stop the shell has written. */
static void look_at_terminal(struct board *b)
{
	struct winsize size = { .ws_row = LINES_FALLBACK };
	const struct timespec at_once = { 0 };
	sigset_t gone_on;

	ioctl(STDERR_FILENO, TIOCGWINSZ, &size);
	if (b->drawn && (size.ws_row != b->rows || size.ws_col != b->columns)) {
		fputs("\033[H\033[2J", b->out);
		b->drawn = 0;
	}
	b->rows = size.ws_row;
	b->columns = size.ws_col;
	sigemptyset(&gone_on);
	sigaddset(&gone_on, SIGCONT);
	if (sigtimedwait(&gone_on, NULL, &at_once) == SIGCONT)
		b->drawn = 0;
}

/* What goes on is shown before what waits, and that before what is over. */
static int rank(const struct Stats *s)
{
	if (job_state_table[s->state].over)
		return 2;
	return s->state == JOB_QUEUED || s->state == JOB_HELD;
}

static void draw_live(struct board *b)
{
	look_at_terminal(b);
	int room = (b->rows > 3 ? b->rows : 4) - 2, n = 0, all = (int)b->list.n;

	fputs("\033[?7l", b->out); /* a line too long is cut, not wrapped */
	if (b->drawn)
		fprintf(b->out, "\033[%dF", b->drawn);
	for (int r = 0; r < 3 && all > room; r++) /* too many for the screen: the active ones */
		for (size_t i = 0; i < b->list.n && n < room - 1; i++)
			if (rank(&b->list.jobs[i]) == r) {
				draw_line(b, &b->list.jobs[i]);
				fputs("\033[K\n", b->out);
				n++;
			}
	for (size_t i = 0; i < b->list.n && all <= room; i++, n++) {
		draw_line(b, &b->list.jobs[i]);
		fputs("\033[K\n", b->out);
	}
	if (n < all) {
		fprintf(b->out, "and %d more\033[K\n", all - n);
		n++;
	}
	fputs("\033[J\033[?7h", b->out);
	b->drawn = n;
}

/* Not a terminal: a line when a job's state changes. */
static void tell_changes(struct board *b)
{
	if (b->list.n > b->n_told) {
		enum job_state *told = reallocarray(b->told, b->list.n, sizeof *told);
		if (!told)
			return;
		b->told = told;
		for (; b->n_told < b->list.n; b->n_told++)
			b->told[b->n_told] = N_JOB_STATES;
	}
	for (size_t i = 0; i < b->list.n; i++) {
		const struct Stats *s = &b->list.jobs[i];
		if (b->told[i] == s->state)
			continue;
		b->told[i] = s->state;
		fprintf(b->out, "%s %lld %s %s %s%s%s\n", job_state_table[s->state].glyph,
		        (long long)s->id, s->worker,
		        s->file_name ? path_file_name(s->file_name) : "",
		        job_state_table[s->state].word, s->reason ? ": " : "",
		        s->reason ? s->reason : "");
	}
}

void board_draw(struct board *b)
{
	if (b->live)
		draw_live(b);
	else
		tell_changes(b);
	fflush(b->out);
}
