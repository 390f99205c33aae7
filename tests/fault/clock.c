/* clock.c - put before a program (LD_PRELOAD), lets a test step the date under it: the file that
 * BATTEN_FAULT_CLOCK names holds the seconds to add. Time that only rises is left alone. */
#include <fcntl.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static long offset(void)
{
	const char *path = getenv("BATTEN_FAULT_CLOCK");
	char text[32] = "";
	int fd = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
	ssize_t n = fd < 0 ? 0 : read(fd, text, sizeof text - 1);
	if (fd >= 0)
		close(fd);
	return n > 0 ? strtol(text, NULL, 10) : 0;
}

int clock_gettime(clockid_t clock, struct timespec *t)
{
	int n = (int)syscall(SYS_clock_gettime, clock, t);
	if (!n && clock == CLOCK_REALTIME)
		t->tv_sec += offset();
	return n;
}

time_t time(time_t *out)
{
	struct timespec t;
	clock_gettime(CLOCK_REALTIME, &t);
	if (out)
		*out = t.tv_sec;
	return t.tv_sec;
}
