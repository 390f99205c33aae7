/* program.c - shaders compiled and linked. */
#include "program.h"

#include <string.h>

static const char *const program_names[N_PROGRAMS] = {
	[PROGRAM_SURFACE] = "surface", [PROGRAM_QUICK] = "quick surface", [PROGRAM_LINE] = "line",
	[PROGRAM_RIBBON] = "ribbon",   [PROGRAM_SPRITE] = "sprite",       [PROGRAM_PLATE] = "plate",
};

#define X(name, text) [UNIFORM_##name] = text,
static const char *const uniform_names[N_UNIFORMS] = { UNIFORM_MAP(X) };
#undef X

enum { LOG_SIZE = 512 };

static enum status compile(GLuint *out, GLenum kind, const char *source, const char *name,
                           const struct report *r)
{
	GLint done = 0;
	char log[LOG_SIZE] = "";
	*out = glCreateShader(kind);
	glShaderSource(*out, 1, &source, NULL);
	glCompileShader(*out);
	glGetShaderiv(*out, GL_COMPILE_STATUS, &done);
	if (done)
		return ST_OK;
	glGetShaderInfoLog(*out, sizeof log, NULL, log);
	return report_error(r, ST_INTERNAL, "the %s shader of '%s' does not compile: %s",
	                    kind == GL_VERTEX_SHADER ? "vertex" : "fragment", name, log);
}

static enum status link(GLuint program, const GLuint shader[2], const char *name,
                        const struct report *r)
{
	GLint done = 0;
	char log[LOG_SIZE] = "";
	for (int k = 0; k < 2; k++)
		glAttachShader(program, shader[k]);
	glLinkProgram(program);
	for (int k = 0; k < 2; k++)
		glDetachShader(program, shader[k]);
	glGetProgramiv(program, GL_LINK_STATUS, &done);
	if (done)
		return ST_OK;
	glGetProgramInfoLog(program, sizeof log, NULL, log);
	return report_error(r, ST_INTERNAL, "the shaders of '%s' do not link: %s", name, log);
}

enum status programs_init(struct programs *p, const struct report *r)
{
	enum status st = ST_OK;
	memset(p, 0, sizeof *p);
	for (int i = 0; i < N_PROGRAMS && st == ST_OK; i++) {
		GLuint shader[2] = { 0, 0 };
		st = compile(&shader[0], GL_VERTEX_SHADER, shader_source[i][0], program_names[i],
		             r);
		if (st == ST_OK)
			st = compile(&shader[1], GL_FRAGMENT_SHADER, shader_source[i][1],
			             program_names[i], r);
		p->id[i] = glCreateProgram();
		if (st == ST_OK)
			st = link(p->id[i], shader, program_names[i], r);
		for (int k = 0; k < 2; k++)
			glDeleteShader(shader[k]);
		for (int u = 0; u < N_UNIFORMS && st == ST_OK; u++)
			p->uniform[i][u] = glGetUniformLocation(p->id[i], uniform_names[u]);
	}
	if (st != ST_OK)
		programs_finish(p);
	return st;
}

void programs_finish(struct programs *p)
{
	for (int i = 0; i < N_PROGRAMS; i++)
		if (p->id[i])
			glDeleteProgram(p->id[i]);
	memset(p, 0, sizeof *p);
}
