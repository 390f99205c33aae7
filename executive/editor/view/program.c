/* program.c - shaders compiled and linked. */
#include "program.h"

#include <stdio.h>
#include <string.h>

static const char *const program_names[N_PROGRAMS] = {
	[PROGRAM_SURFACE] = "surface", [PROGRAM_QUICK] = "quick surface", [PROGRAM_LINE] = "line",
	[PROGRAM_RIBBON] = "ribbon",   [PROGRAM_SPRITE] = "sprite",       [PROGRAM_PLATE] = "plate",
};

#define X(name, text) [UNIFORM_##name] = text,
static const char *const uniform_names[N_UNIFORMS] = { UNIFORM_MAP(X) };
#undef X

enum { LOG_SIZE = 512 };

static void fail(struct programs *p, const char *what, const char *name, const char *log)
{
	if (!p->failed)
		snprintf(p->why, sizeof p->why, "the %s of '%s' cannot be used: %s", what, name,
		         log);
	p->failed = true;
}

static GLuint compile(struct programs *p, GLenum kind, const char *source, const char *name)
{
	GLint done = 0;
	char log[LOG_SIZE] = "";
	const GLuint shader = glCreateShader(kind);
	glShaderSource(shader, 1, &source, NULL);
	glCompileShader(shader);
	glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
	if (!done) {
		glGetShaderInfoLog(shader, sizeof log, NULL, log);
		fail(p, kind == GL_VERTEX_SHADER ? "vertex shader" : "fragment shader", name, log);
	}
	return shader;
}

static void make(struct programs *p, enum program program)
{
	const char *name = program_names[program];
	const GLuint id = p->id[program] = glCreateProgram();
	GLint done = 0;
	char log[LOG_SIZE] = "";
	GLuint shader[2];
	for (int k = 0; k < 2; k++) {
		shader[k] = compile(p, k ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER,
		                    shader_source[program][k], name);
		glAttachShader(id, shader[k]);
	}
	glLinkProgram(id);
	for (int k = 0; k < 2; k++) {
		glDetachShader(id, shader[k]);
		glDeleteShader(shader[k]);
	}
	glGetProgramiv(id, GL_LINK_STATUS, &done);
	if (!done) {
		glGetProgramInfoLog(id, sizeof log, NULL, log);
		fail(p, "program", name, log);
	}
	for (int u = 0; u < N_UNIFORMS; u++)
		p->uniform[program][u] = done ? glGetUniformLocation(id, uniform_names[u]) : -1;
}

const GLint *program_use(struct programs *p, enum program program)
{
	if (!p->id[program])
		make(p, program);
	glUseProgram(p->id[program]);
	return p->uniform[program];
}

void programs_finish(struct programs *p)
{
	for (int i = 0; i < N_PROGRAMS; i++)
		if (p->id[i])
			glDeleteProgram(p->id[i]);
	memset(p, 0, sizeof *p);
}
