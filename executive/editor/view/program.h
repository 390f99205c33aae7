/* program.h - shaders compiled and linked. Private to this folder. */
#ifndef BATTEN_VIEW_PROGRAM_H
#define BATTEN_VIEW_PROGRAM_H

#include <epoxy/gl.h>

#include <stdbool.h>

/* What is drawn, each by a program of its own. */
enum program {
	PROGRAM_SURFACE,
	PROGRAM_QUICK, /* surfaces of small triangles */
	PROGRAM_LINE,
	PROGRAM_RIBBON, /* lines of things that are dragged */
	PROGRAM_SPRITE,
	PROGRAM_PLATE,
	N_PROGRAMS
};

/* Uniforms of all of them; one that a program does not have is -1 there. */
#define UNIFORM_MAP(X)                                                                             \
	X(MATRIX, "matrix")                                                                        \
	X(EYE, "eye")                                                                              \
	X(COLOR, "color")                                                                          \
	X(LIGHT, "light")                                                                          \
	X(FILL, "fill")                                                                            \
	X(SKY, "sky")                                                                              \
	X(STRENGTH, "strength")                                                                    \
	X(LOOK, "look")                                                                            \
	X(VALUES, "values")                                                                        \
	X(COLORS, "colors")                                                                        \
	X(RANGE, "range")                                                                          \
	X(BELOW, "below")                                                                          \
	X(ABOVE, "above")                                                                          \
	X(NOTHING, "nothing")                                                                      \
	X(GRID, "grid")                                                                            \
	X(SCALE, "scale")                                                                          \
	X(VIEWPORT, "viewport")                                                                    \
	X(WIDTH, "width")                                                                          \
	X(BIAS, "bias")                                                                            \
	X(DASH, "dash")                                                                            \
	X(STROKE, "stroke")                                                                        \
	X(SIZE, "size")                                                                            \
	X(SHAPE, "shape")                                                                          \
	X(PICTURE, "picture")                                                                      \
	X(PLACE, "place")

#define X(name, text) UNIFORM_##name,
enum uniform { UNIFORM_MAP(X) N_UNIFORMS };
#undef X

/* Each is compiled when it is first used. A zeroed one is ready. */
struct programs {
	GLuint id[N_PROGRAMS];
	bool failed; /* why has the compiler's words */
	char why[600];
	GLint uniform[N_PROGRAMS][N_UNIFORMS];
};

/* Use it from now on; gives its uniforms. One that fails draws nothing and is told of in `failed`. */
const GLint *program_use(struct programs *p, enum program program);
void programs_finish(struct programs *p);

/* shaders.c: GLSL, vertex then fragment. */
extern const char *const shader_source[N_PROGRAMS][2];

#endif
