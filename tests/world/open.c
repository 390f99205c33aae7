/* open.c - a project folder with geometry in it, and a world on it. */
#include "open.h"

#include <ftw.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base.h"
#include "construct.h"
#include "path.h"

void place_init(struct place *p)
{
	char folder[] = "/tmp/batten-world-XXXXXX";

	*p = (struct place){ 0 };
	assert_non_null(mkdtemp(folder));
	p->folder = strdup(folder);
	report_store_init(&p->said);
	assert_int_equal(world_create(&p->world, folder), ST_OK);
}

static int take_away(const char *path, const struct stat *s, int type, struct FTW *f)
{
	(void)s;
	(void)type;
	(void)f;
	return remove(path);
}

void place_finish(struct place *p)
{
	world_destroy(p->world);
	nftw(p->folder, take_away, 16, FTW_DEPTH | FTW_PHYS);
	free(p->folder);
}

int place_new(void **state)
{
	static struct place p;

	place_init(&p);
	*state = &p;
	return 0;
}

int place_gone(void **state)
{
	place_finish(*state);
	return 0;
}

char *place_path(const struct place *p, const char *name)
{
	char *path = path_join(p->folder, name);
	assert_non_null(path);
	return path;
}

void place_sphere(struct entity *out, double radius)
{
	entity_init(out, ENTITY_SURFACE);
	assert_int_equal(make_sphere(&out->geometry, vec3(0, 0, 0), radius), ST_OK);
}

void place_line(struct entity *out, double length)
{
	entity_init(out, ENTITY_CURVE);
	assert_int_equal(make_line(&out->curve, vec3(0, 0, 0), vec3(length, 0, 0)), ST_OK);
}

static void write_model(const struct place *p, const char *name, struct model *m)
{
	char *path = place_path(p, name);

	assert_int_equal(model_set_text(&m->unit, "m"), ST_OK);
	m->unit_in_mm = 1000;
	assert_int_equal(base_write(m, path, &p->said.report), ST_OK);
	model_finish(m);
	free(path);
}

void place_spheres(const struct place *p, const char *name, int n)
{
	struct model m;

	model_init(&m);
	for (int k = 0; k < n; k++) {
		struct entity e;
		place_sphere(&e, k + 1);
		assert_int_equal(model_add(&m, &e), ST_OK);
	}
	write_model(p, name, &m);
}

void place_diagonal(const struct place *p, const char *name)
{
	struct model m;
	struct entity e;

	model_init(&m);
	entity_init(&e, ENTITY_CURVE_ON_SURFACE);
	assert_int_equal(make_line(&e.curve, vec3(0, -1, 0), vec3(6, 1, 0)), ST_OK);
	e.surface = 1;
	assert_int_equal(model_add(&m, &e), ST_OK);
	place_sphere(&e, 3);
	e.used = true;
	assert_int_equal(model_add(&m, &e), ST_OK);
	write_model(p, name, &m);
}
