/* journal_folders.c - the folders of the test of the journal: what is there before, and what is there after. */
#include "journal_folders.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base.h"
#include "construct.h"
#include "file.h"
#include "model_write.h"
#include "open.h"
#include "path.h"

/* A plane of which a triangle is left. */
static void write_trimmed(const char *folder)
{
	static const double corner[4][2] = { { 1, 1 }, { 5, 1 }, { 3, 1.8 }, { 1, 1 } };
	struct trim_loop loop = { .outer = true };
	struct model m;
	struct entity e;
	struct curve c;

	model_init(&m);
	m.unit_in_mm = 1000;
	assert_int_equal(model_set_text(&m.unit, "m"), ST_OK);
	entity_init(&e, ENTITY_SURFACE);
	assert_int_equal(make_sphere(&e.geometry, vec3(0, 0, 0), 2), ST_OK);
	for (int k = 0; k < 3; k++) {
		assert_int_equal(make_line(&c, vec3(corner[k][0], corner[k][1] - 1, 0),
		                           vec3(corner[k + 1][0], corner[k + 1][1] - 1, 0)),
		                 ST_OK);
		assert_int_equal(trim_loop_add(&loop, &c), ST_OK);
	}
	assert_int_equal(trim_add(&e.trim, &loop), ST_OK);
	assert_int_equal(model_add(&m, &e), ST_OK);
	model_number(&m);
	char *path = path_join(folder, "trimmed.igs");
	assert_int_equal(model_write(&m, model_format_find(path, NULL), path,
	                             &(struct mesh_wishes){ .angle = 15 },
	                             &(struct mesh_figures){ 0 }, NULL),
	                 ST_OK);
	free(path);
	model_finish(&m);
}

void journal_inputs(const char *folder)
{
	const struct place p = { .folder = (char *)(size_t)folder };
	struct model m;
	struct entity e;
	char *path;

	place_spheres(&p, "spheres.base", 2);
	place_spheres(&p, "ball.base", 1);
	place_diagonal(&p, "diagonal.base");
	model_init(&m);
	m.unit_in_mm = 1000;
	assert_int_equal(model_set_text(&m.unit, "m"), ST_OK);
	place_line(&e, 3);
	assert_int_equal(model_add(&m, &e), ST_OK);
	path = path_join(folder, "rod.base");
	assert_int_equal(base_write(&m, path, NULL), ST_OK);
	free(path);
	entity_finish(&m.entities[0]);
	entity_init(&m.entities[0], ENTITY_POINTS);
	m.entities[0].points = (struct point_list){ 2, 3, calloc(6, sizeof(double)) };
	m.entities[0].number = 1;
	path = path_join(folder, "points.base");
	assert_int_equal(base_write(&m, path, NULL), ST_OK);
	free(path);
	model_finish(&m);
	write_trimmed(folder);
}

char *journal_text(const char *folder, const char *name)
{
	char *path = path_join(folder, name), *text = NULL;
	size_t n;

	if (file_read(path, 1 << 26, &text, &n, NULL) != ST_OK)
		fail_msg("%s is not there", path);
	free(path);
	return text;
}

bool journal_same_file(const char *folder, const char *a, const char *b)
{
	size_t n[2];
	char *path[2] = { path_join(folder, a), path_join(folder, b) }, *bytes[2];

	for (int k = 0; k < 2; k++)
		assert_int_equal(file_read(path[k], 1 << 26, &bytes[k], &n[k], NULL), ST_OK);
	const bool same = n[0] == n[1] && !memcmp(bytes[0], bytes[1], n[0]);
	for (int k = 0; k < 2; k++) {
		free(path[k]);
		free(bytes[k]);
	}
	return same;
}

int journal_same_folder(const char *a, const char *b)
{
	DIR *d = opendir(a);
	struct dirent *e;
	int n = 0;

	while ((e = readdir(d))) {
		char *here, *there, *text[2];
		size_t size[2];
		if (e->d_name[0] == '.')
			continue;
		here = path_join(a, e->d_name);
		there = path_join(b, e->d_name);
		assert_int_equal(file_read(here, 1 << 26, &text[0], &size[0], NULL), ST_OK);
		if (file_read(there, 1 << 26, &text[1], &size[1], NULL) != ST_OK)
			fail_msg("%s is not there", there);
		if (size[0] != size[1] || memcmp(text[0], text[1], size[0]))
			fail_msg("%s differs from %s", here, there);
		for (int k = 0; k < 2; k++)
			free(text[k]);
		free(here);
		free(there);
		n++;
	}
	closedir(d);
	return n;
}
