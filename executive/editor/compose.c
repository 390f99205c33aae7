/* compose.c - pieces of the window as textures, put over each other with OpenGL. */
#include "compose.h"

#include <epoxy/gl.h>
#include <stdlib.h>

struct compose {
	GLuint program, array;
	GLint box, flip;
	GLuint frame, color, depth; /* the views */
	int width, height;
	GLint bound; /* framebuffer to go back to */
};

static const char vertex_text[] = "#version 330 core\n"
                                  "uniform vec4 box;\n" /* left, bottom, right, top in -1 .. 1 */
                                  "uniform bool flip;\n"
                                  "out vec2 at;\n"
                                  "void main() {\n"
                                  "	vec2 c = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
                                  "	at = flip ? vec2(c.x, 1.0 - c.y) : c;\n"
                                  "	gl_Position = vec4(mix(box.xy, box.zw, c), 0.0, 1.0);\n"
                                  "}\n";
static const char fragment_text[] = "#version 330 core\n"
                                    "uniform sampler2D image;\n"
                                    "in vec2 at;\n"
                                    "out vec4 color;\n"
                                    "void main() { color = texture(image, at); }\n";

static GLuint make_shader(GLenum kind, const char *text)
{
	GLuint s = glCreateShader(kind);
	GLint ok = 0;

	glShaderSource(s, 1, &text, NULL);
	glCompileShader(s);
	glGetShaderiv(s, GL_COMPILE_STATUS, &ok);
	if (ok)
		return s;
	glDeleteShader(s);
	return 0;
}

static GLuint make_program(void)
{
	GLuint v = make_shader(GL_VERTEX_SHADER, vertex_text);
	GLuint f = make_shader(GL_FRAGMENT_SHADER, fragment_text), p = 0;
	GLint ok = 0;

	if (v && f) {
		p = glCreateProgram();
		glAttachShader(p, v);
		glAttachShader(p, f);
		glLinkProgram(p);
		glGetProgramiv(p, GL_LINK_STATUS, &ok);
	}
	glDeleteShader(v);
	glDeleteShader(f);
	if (ok)
		return p;
	glDeleteProgram(p);
	return 0;
}

enum status compose_create(struct compose **out, const struct report *r)
{
	struct compose *c = calloc(1, sizeof *c);

	if (!c)
		return report_error(r, ST_RESOURCE, "memory ran out");
	c->program = make_program();
	if (!c->program) {
		free(c);
		return report_error(r, ST_RESOURCE,
		                    "this OpenGL driver does not compile the window's shaders");
	}
	c->box = glGetUniformLocation(c->program, "box");
	c->flip = glGetUniformLocation(c->program, "flip");
	glGenVertexArrays(1, &c->array);
	*out = c;
	return ST_OK;
}

static void drop_frame(struct compose *c)
{
	glDeleteFramebuffers(1, &c->frame);
	glDeleteTextures(1, &c->color);
	glDeleteRenderbuffers(1, &c->depth);
	c->frame = c->color = c->depth = 0;
	c->width = c->height = 0;
}

void compose_destroy(struct compose *c)
{
	if (!c)
		return;
	drop_frame(c);
	glDeleteVertexArrays(1, &c->array);
	glDeleteProgram(c->program);
	free(c);
}

/* ------------------------------------------------------------ views */

static GLuint make_texture(int width, int height, GLenum format)
{
	GLuint t;

	glGenTextures(1, &t);
	glBindTexture(GL_TEXTURE_2D, t);
	glTexImage2D(GL_TEXTURE_2D, 0, (GLint)format, width, height, 0, GL_BGRA,
	             GL_UNSIGNED_INT_8_8_8_8_REV, NULL);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	return t;
}

static bool make_frame(struct compose *c, int width, int height)
{
	glGenFramebuffers(1, &c->frame);
	glBindFramebuffer(GL_FRAMEBUFFER, c->frame);
	c->color = make_texture(width, height, GL_RGBA8);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, c->color, 0);
	glGenRenderbuffers(1, &c->depth);
	glBindRenderbuffer(GL_RENDERBUFFER, c->depth);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
	                          c->depth);
	c->width = width;
	c->height = height;
	return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

enum status compose_view_begin(struct compose *c, int width, int height, const struct report *r)
{
	glGetIntegerv(GL_FRAMEBUFFER_BINDING, &c->bound);
	if (width != c->width || height != c->height) {
		drop_frame(c);
		if (!make_frame(c, width, height)) {
			glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)c->bound);
			return report_error(r, ST_RESOURCE, "no room for a picture of %d x %d",
			                    width, height);
		}
	}
	glBindFramebuffer(GL_FRAMEBUFFER, c->frame);
	return ST_OK;
}

void compose_view_end(struct compose *c)
{
	glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)c->bound);
}

/* ------------------------------------------------------------ parts */

void compose_part_finish(struct sheet_part *p)
{
	cairo_surface_destroy(p->surface);
	if (p->texture)
		glDeleteTextures(1, &p->texture);
	*p = (struct sheet_part){ 0 };
}

cairo_t *compose_paint_begin(struct compose *c, struct sheet_part *p, int x, int y, int width,
                             int height, double scale)
{
	(void)c;
	if (!p->surface || p->width != width || p->height != height) {
		compose_part_finish(p);
		p->surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
		if (cairo_surface_status(p->surface) != CAIRO_STATUS_SUCCESS) {
			compose_part_finish(p);
			return NULL;
		}
		p->texture = make_texture(width, height, GL_RGBA8);
	}
	p->x = x;
	p->y = y;
	p->width = width;
	p->height = height;
	cairo_t *cr = cairo_create(p->surface);
	cairo_set_operator(cr, CAIRO_OPERATOR_CLEAR);
	cairo_paint(cr);
	cairo_set_operator(cr, CAIRO_OPERATOR_OVER);
	cairo_translate(cr, -x, -y);
	cairo_scale(cr, scale, scale);
	return cr;
}

void compose_paint_end(struct compose *c, struct sheet_part *p, cairo_t *cr)
{
	(void)c;
	cairo_destroy(cr);
	cairo_surface_flush(p->surface);
	glBindTexture(GL_TEXTURE_2D, p->texture);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, cairo_image_surface_get_stride(p->surface) / 4);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, p->width, p->height, GL_BGRA,
	                GL_UNSIGNED_INT_8_8_8_8_REV, cairo_image_surface_get_data(p->surface));
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

static void put(struct compose *c, GLuint texture, int x, int y, int w, int h, int width,
                int height, bool flip)
{
	float left = 2.0f * (float)x / (float)width - 1,
	      right = 2.0f * (float)(x + w) / (float)width - 1;
	float top = 1 - 2.0f * (float)y / (float)height;
	float bottom = 1 - 2.0f * (float)(y + h) / (float)height;

	glBindTexture(GL_TEXTURE_2D, texture);
	glUniform4f(c->box, left, bottom, right, top);
	glUniform1i(c->flip, flip);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void compose_show(struct compose *c, const struct sheet_part *parts, int n, int width, int height)
{
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glViewport(0, 0, width, height);
	glDisable(GL_DEPTH_TEST);
	glDisable(GL_SCISSOR_TEST);
	glDisable(GL_CULL_FACE);
	glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glDisable(GL_FRAMEBUFFER_SRGB);
	glActiveTexture(GL_TEXTURE0);
	glBindVertexArray(c->array);
	glUseProgram(c->program);
	glDisable(GL_BLEND);
	if (c->color)
		put(c, c->color, 0, 0, c->width, c->height, width, height, false);
	glEnable(GL_BLEND);
	glBlendEquation(GL_FUNC_ADD);
	glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
	for (int i = 0; i < n; i++)
		if (parts[i].width > 0 && parts[i].texture)
			put(c, parts[i].texture, parts[i].x, parts[i].y, parts[i].width,
			    parts[i].height, width, height, true);
	glDisable(GL_BLEND);
	glBindVertexArray(0);
	glUseProgram(0);
}
