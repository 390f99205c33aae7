/* fuzz_message.c - bytes to a packet reader, in pieces whose sizes the first byte says. */
#include "message.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct message_reader r;
	struct message m;
	if (n < 2)
		return 0;
	size_t piece = 1 + data[0];
	int got = 0;
	message_reader_init(&r, data[1]);
	for (size_t at = 2; at < n && got >= 0; at += piece) {
		size_t room, take = n - at < piece ? n - at : piece;
		char *to = message_reader_room(&r, take, &room);
		memcpy(to, data + at, take);
		message_reader_filled(&r, take);
		while ((got = message_reader_next(&r, &m)) > 0) {
			struct text again = { 0 };
			/* numbers may be written longer than they came: too long is no fault */
			if (!message_row(m.type) ||
			    message_encode(&again, m.type, m.body) == ST_RESOURCE)
				abort();
			text_finish(&again);
			message_finish(&m);
		}
		if (r.cap > 1 << 20)
			abort();
	}
	if (r.failed && !*r.reason)
		abort();
	message_reader_finish(&r);
	return 0;
}
