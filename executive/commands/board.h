/* board.h - a live board of jobs in the terminal: glyph, color, bar, time left, a line a job. */
#ifndef BATTEN_BOARD_H
#define BATTEN_BOARD_H

#include "connection.h"

struct board {
	struct job_list list; /* owned: what is known of the jobs */
	FILE *out;            /* borrowed; standard error */
	bool live;            /* a terminal: lines are drawn again in place */
	bool color;
	int drawn;            /* lines on the screen */
	int rows, columns;    /* of the terminal, when they were drawn */
	enum job_state *told; /* owned: state last told of each job, where it is not live */
	size_t n_told;
};

void board_init(struct board *b, bool color);
void board_finish(struct board *b); /* leaves what is drawn */

bool board_put(void *data, const struct Stats *s); /* a client_job: remember, do not draw */
void board_draw(struct board *b);
bool board_all_over(const struct board *b);

#endif
