/* job_text.h - what is said of a job in a line. */
#ifndef BATTEN_JOB_TEXT_H
#define BATTEN_JOB_TEXT_H

#include "stats.h"

enum { JOB_TEXT = 512 };

/* "1:24", "2 h 10"; "" for what is not known. */
void job_time(char out[JOB_TEXT], double seconds);
/* The last part of the input's name. */
const char *job_file(const struct Stats *s);
/* Why it waits or failed, how far it is, what came out. */
void job_says(char out[JOB_TEXT], const struct Stats *s, double now);
/* "14:03:06", local time. */
void job_clock(char out[JOB_TEXT], double seconds);

#endif
