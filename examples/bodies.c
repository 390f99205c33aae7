/* bodies.c - sphere and torus as rational biquadratic surfaces. */
#include "construct.h"
#include "example.h"

enum status example_sphere(struct model *m, const struct report *r)
{
	struct surface s;
	(void)r;
	enum status st = make_sphere(&s, vec3(0, 0, 0), 10);
	return st == ST_OK ? example_add(m, &s, "sphere", 0xc8a15a) : st;
}

enum status example_torus(struct model *m, const struct report *r)
{
	struct surface s;
	(void)r;
	enum status st = make_torus(&s, vec3(0, 0, 0), 10, 4);
	return st == ST_OK ? example_add(m, &s, "torus", 0x7d9bb5) : st;
}
