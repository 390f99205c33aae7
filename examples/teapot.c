/* teapot.c - Newell's teapot, 32 bicubic patches, z up.
 *
 * Rim, body, lid and bottom are quarter turns of profiles; handle and spout are half patches and
 * their mirror images. The numbers are Newell's of 1975.
 * Source: Crow, The origins of the teapot, IEEE CG&A 7 (1) (1987), 8-19.
 */
#include <stdlib.h>

#include "example.h"
#include "text.h"

/* Radius and height of the four points of a profile. */
static const struct {
	const char *name;
	double at[4][2];
} profiles[] = {
	{ "rim", { { 1.4, 2.4 }, { 1.3375, 2.53125 }, { 1.4375, 2.53125 }, { 1.5, 2.4 } } },
	{ "upper body", { { 1.5, 2.4 }, { 1.75, 1.875 }, { 2, 1.35 }, { 2, 0.9 } } },
	{ "lower body", { { 2, 0.9 }, { 2, 0.45 }, { 1.5, 0.225 }, { 1.5, 0.15 } } },
	{ "lid knob", { { 0, 3.15 }, { 0.8, 3.15 }, { 0, 2.85 }, { 0.2, 2.7 } } },
	{ "lid", { { 0.2, 2.7 }, { 0.4, 2.55 }, { 1.3, 2.55 }, { 1.3, 2.4 } } },
	{ "bottom", { { 1.5, 0.15 }, { 1.5, 0.075 }, { 1.425, 0 }, { 0, 0 } } },
};

/* Newell's quarter circle is 0.56 of the radius long, and 0.45 of 0.8 on top of the knob. */
static double quarter(double radius)
{
	return radius == 0.8 ? 0.45 : 0.56 * radius;
}

/* Halves of handle and spout: outline points, the width of each row's inner two points. */
static const struct {
	const char *name, *mirrored;
	double x[4][4], z[4][4], width[4];
} halves[] = {
	{ "upper handle port",
	  "upper handle starboard",
	  { { -1.6, -1.6, -1.5, -1.5 },
	    { -2.3, -2.3, -2.5, -2.5 },
	    { -2.7, -2.7, -3, -3 },
	    { -2.7, -2.7, -3, -3 } },
	  { { 2.025, 2.025, 2.25, 2.25 },
	    { 2.025, 2.025, 2.25, 2.25 },
	    { 2.025, 2.025, 2.25, 2.25 },
	    { 1.8, 1.8, 1.8, 1.8 } },
	  { 0.3, 0.3, 0.3, 0.3 } },
	{ "lower handle port",
	  "lower handle starboard",
	  { { -2.7, -2.7, -3, -3 },
	    { -2.7, -2.7, -3, -3 },
	    { -2.5, -2.5, -2.65, -2.65 },
	    { -2, -2, -1.9, -1.9 } },
	  { { 1.8, 1.8, 1.8, 1.8 },
	    { 1.575, 1.575, 1.35, 1.35 },
	    { 1.125, 1.125, 0.9375, 0.9375 },
	    { 0.9, 0.9, 0.6, 0.6 } },
	  { 0.3, 0.3, 0.3, 0.3 } },
	{ "lower spout port",
	  "lower spout starboard",
	  { { 1.7, 1.7, 1.7, 1.7 },
	    { 2.6, 2.6, 3.1, 3.1 },
	    { 2.3, 2.3, 2.4, 2.4 },
	    { 2.7, 2.7, 3.3, 3.3 } },
	  { { 1.425, 1.425, 0.6, 0.6 },
	    { 1.425, 1.425, 0.825, 0.825 },
	    { 2.1, 2.1, 2.025, 2.025 },
	    { 2.4, 2.4, 2.4, 2.4 } },
	  { 0.66, 0.66, 0.25, 0.25 } },
	{ "upper spout port",
	  "upper spout starboard",
	  { { 2.7, 2.7, 3.3, 3.3 },
	    { 2.8, 2.8, 3.525, 3.525 },
	    { 2.9, 2.9, 3.45, 3.45 },
	    { 2.8, 2.8, 3.2, 3.2 } },
	  { { 2.4, 2.4, 2.4, 2.4 },
	    { 2.475, 2.475, 2.49375, 2.49375 },
	    { 2.475, 2.475, 2.5125, 2.5125 },
	    { 2.4, 2.4, 2.4, 2.4 } },
	  { 0.25, 0.25, 0.15, 0.15 } },
};

static enum status bicubic(struct surface *s)
{
	enum status st = surface_init(s, (int[2]){ 4, 4 }, (int[2]){ 4, 4 });
	for (int d = 0; d < 2 && st == ST_OK; d++) {
		for (int i = 4; i < 8; i++)
			s->knots[d][i] = 1;
		s->domain[d][1] = 1;
	}
	return st;
}

/* The quarter of a profile that begins `turns` quarters from the x axis. */
static enum status quarter_patch(struct surface *s, const double at[4][2], int turns)
{
	enum status st = bicubic(s);
	for (int i = 0; i < 4 && st == ST_OK; i++) {
		double radius = at[i][0], arm = quarter(radius);
		const double x[4] = { radius, radius, arm, 0 }, y[4] = { 0, arm, radius, radius };
		for (int j = 0; j < 4; j++) {
			double px = x[j], py = y[j];
			for (int k = 0; k < turns; k++) {
				double old = px;
				px = -py;
				py = old;
			}
			surface_set_point(s, i, j, vec3(px, py, at[i][1]), 1);
		}
	}
	return st;
}

static enum status half_patch(struct surface *s, int half)
{
	enum status st = bicubic(s);
	for (int i = 0; i < 4 && st == ST_OK; i++)
		for (int j = 0; j < 4; j++)
			surface_set_point(s, i, j,
			                  vec3(halves[half].x[i][j],
			                       j == 1 || j == 2 ? halves[half].width[i] : 0,
			                       halves[half].z[i][j]),
			                  1);
	return st;
}

enum status example_teapot(struct model *m, const struct report *r)
{
	enum status st = ST_OK;
	struct surface s;
	(void)r;
	for (size_t i = 0; i < sizeof profiles / sizeof *profiles; i++) {
		for (int turns = 0; turns < 4 && st == ST_OK; turns++) {
			char *name = text_print("%s %d", profiles[i].name, turns + 1);
			st = name ? quarter_patch(&s, profiles[i].at, turns) : ST_RESOURCE;
			if (st == ST_OK)
				st = example_add(m, &s, name, 0xd8cfc0);
			free(name);
		}
	}
	for (size_t i = 0; i < sizeof halves / sizeof *halves && st == ST_OK; i++) {
		st = half_patch(&s, (int)i);
		if (st == ST_OK)
			st = example_add_mirrored(m, &s, halves[i].name, halves[i].mirrored,
			                          0xd8cfc0);
	}
	return st;
}
