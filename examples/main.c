/* main.c - batten-examples FOLDER: write every example there as .base and .igs. */
#include <stdio.h>
#include <stdlib.h>

#include "base.h"
#include "example.h"
#include "text.h"
#include "iges.h"

static const struct example {
	const char *name, *unit;
	example_make *make;
} examples[] = {
	{ "hull", "m", example_hull },           { "naca", "m", example_naca },
	{ "propeller", "m", example_propeller }, { "sphere", "mm", example_sphere },
	{ "teapot", "mm", example_teapot },      { "torus", "mm", example_torus },
	{ "wigley", "m", example_wigley },
};

typedef enum status write_model(const struct model *m, const char *path, const struct report *r);

static enum status write_as(const struct model *m, const char *folder, const char *name,
                            const char *extension, write_model *write, const struct report *r)
{
	char *path = text_print("%s/%s%s", folder, name, extension);
	enum status st = path ? write(m, path, r) : ST_RESOURCE;
	free(path);
	return st;
}

static enum status write_example(const struct example *e, const char *folder,
                                 const struct report *r)
{
	struct model m;
	model_init(&m);
	enum status st = e->make(&m, r);
	if (st == ST_OK) {
		m.unit = text_print("%s", e->unit);
		m.unit_in_mm = e->unit[1] ? 1 : 1000;
		m.scale = 1;
		if (!m.unit)
			st = ST_RESOURCE;
	}
	for (int i = 0; i < m.n && st == ST_OK; i++)
		st = surface_check(&m.entities[i].geometry, m.entities[i].name, r);
	model_number(&m);
	if (st == ST_OK)
		st = write_as(&m, folder, e->name, ".base", base_write, r);
	if (st == ST_OK)
		st = write_as(&m, folder, e->name, ".igs", iges_write, r);
	model_finish(&m);
	return st;
}

int main(int argc, char **argv)
{
	struct report r = report_stderr("batten-examples");
	if (argc != 2) {
		report_error(&r, ST_PARAMETER, "usage: batten-examples FOLDER");
		return status_exit(ST_PARAMETER);
	}
	for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
		enum status st = write_example(&examples[i], argv[1], &r);
		if (st != ST_OK) {
			report_error(&r, st, "cannot make the example %s: %s", examples[i].name,
			             status_text(st));
			return status_exit(st);
		}
	}
	return 0;
}
