/* status.h - the one map of how things end: class, exit status, general text. */
#ifndef BATTEN_STATUS_H
#define BATTEN_STATUS_H

/* name, exit status of a program that ends with it, class in an ERROR packet, general text */
#define STATUS_MAP(X)                                                                              \
	X(OK, 0, "ok", "success")                                                                  \
	X(INPUT, 1, "input", "the input cannot be used")                                           \
	X(PARAMETER, 2, "parameter", "a parameter is wrong")                                       \
	X(RESOURCE, 1, "resource", "memory, disk or time ran out")                                 \
	X(INTERNAL, 1, "internal", "a fault in batten")                                            \
	X(CANCELLED, 130, "cancelled", "cancelled")

#define X(name, exit_status, class, text) ST_##name,
enum status { STATUS_MAP(X) N_STATUS };
#undef X

/* Exit status of a program that ends with st. */
int status_exit(enum status st);

/* Class of st as it stands in an ERROR packet ("input", ...); static text. */
const char *status_class(enum status st);

/* General text of st, for want of a better sentence; static text. */
const char *status_text(enum status st);

/* The status of a class name, or ST_INTERNAL where there is no such class. */
enum status status_from_class(const char *name);

/* Input for what the user named wrongly (ENOENT, EACCES, ...), resource for the rest. */
enum status status_from_errno(int error);

#endif
