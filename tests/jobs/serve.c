/* serve.c - the service alone, under the name the client starts: `batten`, beside the tests. */
#include "service.h"

int main(void)
{
	struct project p;
	struct settings s = { 0 };
	struct report r = report_stderr("batten");
	enum status st = project_find(&p, NULL, &r);
	if (st == ST_OK)
		st = project_make(&p, &r);
	if (st == ST_OK)
		st = settings_read(&s, &p, &r);
	if (st == ST_OK)
		st = service_run(&p, &s, &r);
	settings_finish(&s);
	project_finish(&p);
	return status_exit(st);
}
