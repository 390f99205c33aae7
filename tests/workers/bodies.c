/* bodies.c - what tests of the real workers share. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base.h"
#include "construct.h"
#include "json.h"

struct surface body_sphere(struct vec3 center, double radius)
{
	struct surface s;
	assert_int_equal(make_sphere(&s, center, radius), ST_OK);
	return s;
}

struct surface body_torus(struct vec3 center, double major, double minor)
{
	struct surface s;
	assert_int_equal(make_torus(&s, center, major, minor), ST_OK);
	return s;
}

struct surface body_corners(struct vec3 a, struct vec3 b, struct vec3 c, struct vec3 d)
{
	struct surface s;
	assert_int_equal(make_bilinear(&s, (struct vec3[4]){ a, b, c, d }), ST_OK);
	return s;
}

struct surface body_square(double r, double z)
{
	return body_corners(vec3(-r, -r, z), vec3(r, -r, z), vec3(-r, r, z), vec3(r, r, z));
}

void bodies_write(const char *path, const char *unit, struct surface *s, int n)
{
	struct model m;
	model_init(&m);
	m.unit = unit ? strdup(unit) : NULL;
	for (int i = 0; i < n; i++) {
		struct entity e = { .kind = ENTITY_SURFACE, .surface = -1, .geometry = s[i] };
		assert_int_equal(model_add(&m, &e), ST_OK);
	}
	model_number(&m);
	assert_int_equal(base_write(&m, path, NULL), ST_OK);
	model_finish(&m);
}

void body_write(const char *path, const char *unit, struct surface s)
{
	bodies_write(path, unit, &s, 1);
}

int bodies_leave(void **state)
{
	place_leave(*state);
	return 0;
}

void run_well(const char *worker, ...)
{
	va_list list;
	va_start(list, worker);
	struct ran r = run_list(worker, list);
	va_end(list);
	if (r.exit_status)
		fail_msg("exit status %d: %s", r.exit_status, r.err);
	ran_finish(&r);
}

void near(double a, double b, double tolerance)
{
	if (!(fabs(a - b) <= tolerance))
		fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

json_t *figures_of(const struct model *m)
{
	json_t *figures;
	const char *text = model_get_attribute(m, "figures");
	assert_non_null(text);
	assert_int_equal(json_parse_object(text, strlen(text), "figures", &figures, NULL), ST_OK);
	return figures;
}

double figure_of(const struct exr_picture *p, const char *name)
{
	const char *text = exr_text(p, "figures");
	json_t *figures;

	assert_non_null(text);
	assert_int_equal(json_parse_object(text, strlen(text), "figures", &figures, NULL), ST_OK);
	assert_true(json_is_number(json_object_get(figures, name)));
	double x = json_number(figures, name, NAN);
	json_decref(figures);
	return x;
}

void expect_refusals(const char *worker, const struct refusal *list, size_t n, const char *output)
{
	for (size_t i = 0; i < n; i++) {
		const char *const *a = list[i].arguments;
		struct ran r = run_hand(worker, list[i].input, "-o", "wrong", a[0], a[1], a[2],
		                        a[3], a[4], a[5], NULL);
		if (r.exit_status != list[i].exit_status || !strstr(r.err, list[i].says))
			fail_msg("case %zu: exit status %d: %s", i, r.exit_status, r.err);
		assert_false(there(output));
		ran_finish(&r);
	}
}
