/* at_login.h - the unit that has systemd start a project's service at each login of its user. */
#ifndef BATTEN_AT_LOGIN_H
#define BATTEN_AT_LOGIN_H

#include "project.h"

/* Write $XDG_CONFIG_HOME/systemd/user/batten-HASH.service and enable it; says where it is on standard
 * output. Errors: ST_RESOURCE, ST_INPUT (not writable). */
enum status at_login_write(const struct project *p, const struct report *r);

/* Take it away. Errors: ST_INPUT (there is none). */
enum status at_login_remove(const struct project *p, const struct report *r);

#endif
