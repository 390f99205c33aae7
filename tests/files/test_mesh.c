/* test_mesh.c - OBJ, PLY and STL files, byte for byte where that is short. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "mesh_file.h"

/* Two triangles about the edge 1 2, each flat with a normal of its own: a roof. */
static struct vec3 points[4] = { { 0, 0, 0 }, { 1, 0, 0.1 }, { 0, 1, 0.1 }, { 1, 1, 0 } };
static struct vec3 normals[6] = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 },
	                          { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 } };
static struct mesh_corner triangles[2][3] = { { { 0, 0 }, { 1, 1 }, { 2, 2 } },
	                                      { { 1, 3 }, { 3, 4 }, { 2, 5 } } };
static struct mesh_part parts[2] = { { 0, 1 }, { 1, 1 } };
static const struct mesh roof = { points, normals, triangles, NULL, 4, 6, 2, parts, 2, 0 };
static const char *const names[2] = { "left side", NULL };

typedef enum status writer(const struct mesh *m, const struct mesh_labels *l, const char *path,
                           const struct report *r);

static char *written(writer *write, const struct mesh_labels *l, size_t *n)
{
	char folder[] = "/tmp/batten-mesh-XXXXXX", path[64], *bytes = NULL;
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/a", folder);
	assert_int_equal(write(&roof, l, path, NULL), ST_OK);
	assert_int_equal(file_read(path, 1 << 20, &bytes, n, NULL), ST_OK);
	unlink(path);
	assert_int_equal(rmdir(folder), 0); /* nothing is left beside it */
	return bytes;
}

static void obj_is_text(void **state)
{
	(void)state;
	const struct mesh_labels l = { .unit = "mm", .names = names };
	size_t n;
	char *s = written(obj_write, &l, &n);
	assert_string_equal(s, "# batten\n# unit mm\nv 0 0 0\nv 1 0 0.1\nv 0 1 0.1\nv 1 1 0\n"
	                       "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 1 0 0\nvn 1 0 0\nvn 1 0 0\n"
	                       "o left_side\nf 1//1 2//2 3//3\no 2\nf 2//4 4//5 3//6\n");
	free(s);
}

static uint64_t bytes_at(const char *s, size_t at, int n)
{
	uint64_t x = 0;
	for (int i = 0; i < n; i++)
		x |= (uint64_t)(unsigned char)s[at + (size_t)i] << 8 * i;
	return x;
}

static double double_at(const char *s, size_t at)
{
	uint64_t bits = bytes_at(s, at, 8);
	double x;
	memcpy(&x, &bits, sizeof x);
	return x;
}

static float float_at(const char *s, size_t at)
{
	uint32_t bits = (uint32_t)bytes_at(s, at, 4);
	float x;
	memcpy(&x, &bits, sizeof x);
	return x;
}

static void ply_is_binary(void **state)
{
	(void)state;
	const struct mesh_labels l = { 0 };
	size_t n;
	char *s = written(ply_write, &l, &n);
	const char *end = strstr(s, "end_header\n");
	assert_non_null(end);
	assert_non_null(strstr(s, "comment unit not known\nelement vertex 4\n"));
	const size_t data = (size_t)(end - s) + strlen("end_header\n");
	assert_int_equal(n, data + 4 * 36 + 2 * 13);
	assert_true(double_at(s, data + 36 + 16) == 0.1); /* z of point 1 */
	/* on the sharp edge the mean of both normals, else the only one */
	assert_true(float_at(s, data + 36 + 24) == (float)sqrt(0.5));
	assert_true(float_at(s, data + 36 + 32) == (float)sqrt(0.5));
	assert_true(float_at(s, data + 3 * 36 + 24) == 1.f);
	assert_int_equal(bytes_at(s, data + 4 * 36 + 13, 1), 3);
	assert_int_equal(bytes_at(s, data + 4 * 36 + 13 + 1 + 4, 4), 3); /* its second corner */
	free(s);
}

static void stl_is_binary(void **state)
{
	(void)state;
	const struct mesh_labels l = { .unit = "m" };
	size_t n;
	char *s = written(stl_write, &l, &n);
	assert_int_equal(n, 84 + 2 * 50);
	assert_string_equal(s, "batten, unit m");
	assert_int_equal(bytes_at(s, 80, 4), 2);
	/* its own normal, not the surface's: (-0.1, -0.1, 1) made a unit */
	assert_true(float_at(s, 84) == (float)(-0.1 / sqrt(1.02)));
	assert_true(float_at(s, 84 + 12 + 12) == 1.f && float_at(s, 84 + 12 + 20) == 0.1f);
	assert_int_equal(bytes_at(s, 84 + 48, 2), 0);
	free(s);
}

static void a_missing_folder_is_said(void **state)
{
	(void)state;
	static writer *const all[] = { obj_write, ply_write, stl_write };
	const struct mesh_labels l = { 0 };
	for (int k = 0; k < 3; k++) {
		struct report_store store;
		report_store_init(&store);
		assert_int_equal(all[k](&roof, &l, "/nowhere/at/all", &store.report), ST_INPUT);
		assert_non_null(strstr(store.error, "/nowhere/at/all"));
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(obj_is_text),
		cmocka_unit_test(ply_is_binary),
		cmocka_unit_test(stl_is_binary),
		cmocka_unit_test(a_missing_folder_is_said),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
