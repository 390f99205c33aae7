/* last_words.c - the last line of a log. */
#include "last_words.h"

#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { TAIL_BYTES = 4096 };

int64_t last_words_mark(const char *log)
{
	struct stat s;
	return stat(log, &s) ? 0 : s.st_size;
}

char *last_words(const char *log, int64_t mark)
{
	static const char speaker[] = "batten serve: ";
	char text[TAIL_BYTES + 1];
	int64_t size = last_words_mark(log);
	int fd = open(log, O_RDONLY | O_CLOEXEC);
	if (fd < 0)
		return NULL;
	int64_t from = size - TAIL_BYTES > mark ? size - TAIL_BYTES : mark;
	ssize_t n = from < size ? pread(fd, text, TAIL_BYTES, from) : 0;
	close(fd);
	while (n > 0 && text[n - 1] == '\n')
		n--;
	if (n <= 0)
		return NULL;
	text[n] = '\0';
	char *line = strrchr(text, '\n');
	line = line ? line + 1 : text;
	if (!strncmp(line, speaker, sizeof speaker - 1))
		line += sizeof speaker - 1;
	return strdup(line);
}
