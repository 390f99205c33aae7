/* gpu.c - triangles, polylines and points in the graphics memory. */
#include "gpu.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Made when first needed; indices are not bound yet. */
static void bind(GLuint *array, GLuint *vertices, GLuint *indices)
{
	if (!*array) {
		glGenVertexArrays(1, array);
		glGenBuffers(1, vertices);
		glGenBuffers(1, indices);
	}
	glBindVertexArray(*array);
	glBindBuffer(GL_ARRAY_BUFFER, *vertices);
}

void gpu_mesh_load(struct gpu_mesh *g, const struct mesh_made *m)
{
	const GLsizei size = sizeof(struct mesh_vertex_made);
	bind(&g->array, &g->vertices, &g->indices);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)m->n_vertices * size, m->vertices,
	             GL_STATIC_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g->indices);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER,
	             (GLsizeiptr)(m->n_indices + m->n_border) * (GLsizeiptr)sizeof(unsigned),
	             m->indices, GL_STATIC_DRAW);
	static const size_t at[3] = { offsetof(struct mesh_vertex_made, position),
		                      offsetof(struct mesh_vertex_made, normal),
		                      offsetof(struct mesh_vertex_made, uv) };
	for (GLuint i = 0; i < 3; i++) {
		glEnableVertexAttribArray(i);
		glVertexAttribPointer(i, i < 2 ? 3 : 2, GL_FLOAT, GL_FALSE, size,
		                      (const void *)at[i]);
	}
	glBindVertexArray(0);
	g->n = m->n_indices;
	g->n_border = m->n_border;
}

void gpu_tinted_load(struct gpu_mesh *g, const struct tinted *t)
{
	const GLsizeiptr n = (GLsizeiptr)(t->n_indices * sizeof(unsigned)),
	                 n_border = (GLsizeiptr)(t->n_border * sizeof(unsigned));
	gpu_mesh_finish(g);
	glGenVertexArrays(1, &g->array);
	glGenBuffers(1, &g->vertices);
	glGenBuffers(1, &g->indices);
	glBindVertexArray(g->array);
	glBindBuffer(GL_ARRAY_BUFFER, g->vertices);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(t->n_vertices * sizeof *t->vertices),
	             t->vertices, GL_STATIC_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g->indices);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, n + n_border, NULL, GL_STATIC_DRAW);
	glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, n, t->indices);
	glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, n, n_border, t->border);
	static const size_t at[3] = { offsetof(struct tinted_vertex, position),
		                      offsetof(struct tinted_vertex, normal),
		                      offsetof(struct tinted_vertex, color) };
	static const GLuint place[3] = { 0, 1, 3 };
	for (int i = 0; i < 3; i++) {
		glEnableVertexAttribArray(place[i]);
		glVertexAttribPointer(place[i], 3, GL_FLOAT, GL_FALSE, sizeof *t->vertices,
		                      (const void *)at[i]);
	}
	glBindVertexArray(0);
	g->n = t->n_indices;
	g->n_border = t->n_border;
}

void gpu_mesh_finish(struct gpu_mesh *g)
{
	glDeleteVertexArrays(1, &g->array);
	glDeleteBuffers(1, &g->vertices);
	glDeleteBuffers(1, &g->indices);
	*g = (struct gpu_mesh){ 0 };
}

/* Attributes 0 to 3: four vertices in a row; 4 and 5: lengths at the middle two. An instance is a
 * piece, so all step on by one vertex an instance. */
void gpu_poly_load(struct gpu_poly *g, const struct poly *p)
{
	const GLsizei size = sizeof *p->v;
	if (!g->array) {
		glGenVertexArrays(1, &g->array);
		glGenBuffers(1, &g->vertices);
		glGenBuffers(1, &g->lengths);
	}
	glBindVertexArray(g->array);
	glBindBuffer(GL_ARRAY_BUFFER, g->vertices);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)p->n * size, p->v, GL_STATIC_DRAW);
	for (GLuint i = 0; i < 4; i++) {
		glEnableVertexAttribArray(i);
		glVertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, size,
		                      (const void *)(size_t)(i * (GLuint)size));
		glVertexAttribDivisor(i, 1);
	}
	glBindVertexArray(0);
	g->n = p->n;
}

void gpu_poly_finish(struct gpu_poly *g)
{
	glDeleteVertexArrays(1, &g->array);
	glDeleteBuffers(1, &g->vertices);
	glDeleteBuffers(1, &g->lengths);
	*g = (struct gpu_poly){ 0 };
}

/* Attributes 0 to 2: the vertex before, the corner's own, the one behind; each stands twice. */
static void lay_ribbon(void)
{
	const size_t twice = 2 * sizeof(struct poly_vertex);
	for (GLuint i = 0; i < 3; i++) {
		glEnableVertexAttribArray(i);
		glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(struct poly_vertex),
		                      (const void *)(i * twice));
	}
}

static int ribbon_indices(unsigned *out, const struct poly *p)
{
	int n = 0;
	for (int k = 1; k + 2 < p->n; k++) {
		const unsigned at = 2 * (unsigned)(k - 1);
		const unsigned corner[6] = { at, at + 1, at + 2, at + 2, at + 1, at + 3 };
		if (p->v[k].part < 0 || p->v[k + 1].part < 0)
			continue;
		memcpy(out + n, corner, sizeof corner);
		n += 6;
	}
	return n;
}

enum status gpu_ribbon_load(struct gpu_ribbon *g, const struct poly *p)
{
	g->n = 0;
	if (p->n < 4)
		return ST_OK;
	struct poly_vertex *twice = malloc(2 * (size_t)p->n * sizeof *twice);
	unsigned *indices = malloc(6 * (size_t)p->n * sizeof *indices);
	const bool made = twice && indices;
	if (made) {
		for (int i = 0; i < 2 * p->n; i++)
			twice[i] = p->v[i / 2];
		g->n = ribbon_indices(indices, p);
		bind(&g->array, &g->vertices, &g->indices);
		glBufferData(GL_ARRAY_BUFFER, 2 * (GLsizeiptr)p->n * (GLsizeiptr)sizeof *twice,
		             twice, GL_STATIC_DRAW);
		glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g->indices);
		glBufferData(GL_ELEMENT_ARRAY_BUFFER,
		             (GLsizeiptr)g->n * (GLsizeiptr)sizeof *indices, indices,
		             GL_STATIC_DRAW);
		lay_ribbon();
		glBindVertexArray(0);
	}
	free(indices);
	free(twice);
	return made ? ST_OK : ST_RESOURCE;
}

void gpu_ribbon_finish(struct gpu_ribbon *g)
{
	glDeleteVertexArrays(1, &g->array);
	glDeleteBuffers(1, &g->vertices);
	glDeleteBuffers(1, &g->indices);
	*g = (struct gpu_ribbon){ 0 };
}

void gpu_matrix(const struct gpu_frame *f, struct vec3 origin, float out[16])
{
	const double *m = f->matrix;
	for (int row = 0; row < 4; row++) {
		for (int column = 0; column < 3; column++)
			out[4 * column + row] = (float)m[4 * column + row];
		out[12 + row] = (float)(m[row] * origin.x + m[4 + row] * origin.y +
		                        m[8 + row] * origin.z + m[12 + row]);
	}
}

/* Length in px of the polylines up to each vertex, as they are seen now. */
static bool load_lengths(const struct gpu_frame *f, struct gpu_poly *g, const struct poly *p)
{
	float m[16], *lengths = malloc((size_t)p->n * sizeof *lengths);
	double x0 = 0, y0 = 0, sum = 0;
	if (!lengths)
		return false;
	gpu_matrix(f, p->origin, m);
	for (int i = 0; i < p->n; i++) {
		const struct poly_vertex *v = &p->v[i];
		double w = m[3] * v->x + m[7] * v->y + m[11] * v->z + m[15];
		double x = m[0] * v->x + m[4] * v->y + m[8] * v->z + m[12];
		double y = m[1] * v->x + m[5] * v->y + m[9] * v->z + m[13];
		x *= 0.5 * f->width / w;
		y *= 0.5 * f->height / w;
		bool follows = i > 0 && v->part >= 0 && p->v[i - 1].part >= 0 && w > 0;
		sum = follows ? sum + hypot(x - x0, y - y0) : 0;
		lengths[i] = isfinite(sum) ? (float)sum : 0;
		x0 = x;
		y0 = y;
	}
	glBindBuffer(GL_ARRAY_BUFFER, g->lengths);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)p->n * (GLsizeiptr)sizeof *lengths, lengths,
	             GL_STREAM_DRAW);
	free(lengths);
	for (GLuint i = 0; i < 2; i++) {
		glEnableVertexAttribArray(4 + i);
		glVertexAttribPointer(4 + i, 1, GL_FLOAT, GL_FALSE, sizeof(float),
		                      (const void *)((i + 1) * sizeof(float)));
		glVertexAttribDivisor(4 + i, 1);
	}
	return true;
}

static const GLint *use(const struct gpu_frame *f, enum program program, struct vec3 origin)
{
	const GLint *u = program_use(f->programs, program);
	float m[16];
	gpu_matrix(f, origin, m);
	glUniformMatrix4fv(u[UNIFORM_MATRIX], 1, GL_FALSE, m);
	glUniform2f(u[UNIFORM_VIEWPORT], (float)f->width, (float)f->height);
	return u;
}

/* Uniforms of lines, with or without dashes. */
static const GLint *use_style(const struct gpu_frame *f, enum program program, struct vec3 origin,
                              const struct gpu_style *style)
{
	const GLint *u = use(f, program, origin);
	glUniform4f(u[UNIFORM_COLOR], (float)style->color.r, (float)style->color.g,
	            (float)style->color.b, (float)style->alpha);
	glUniform1f(u[UNIFORM_WIDTH], (float)(style->width * f->scale));
	glUniform1f(u[UNIFORM_BIAS], (float)(style->lift * f->scale * f->pixel_depth));
	return u;
}

void gpu_draw_lines(const struct gpu_frame *f, struct gpu_poly *g, const struct poly *p,
                    const struct gpu_style *style)
{
	if (g->n < 4)
		return;
	glBindVertexArray(g->array);
	bool dashed = style->dash[1] > 0 && load_lengths(f, g, p);
	const GLint *u = use_style(f, PROGRAM_LINE, p->origin, style);
	glUniform2f(u[UNIFORM_DASH], (float)(style->dash[0] * f->scale),
	            dashed ? (float)(style->dash[1] * f->scale) : 0);
	glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, g->n - 3);
	if (dashed)
		for (GLuint i = 4; i < 6; i++)
			glDisableVertexAttribArray(i);
	glBindVertexArray(0);
}

void gpu_draw_ribbon(const struct gpu_frame *f, const struct gpu_ribbon *g, struct vec3 origin,
                     const struct gpu_style *style)
{
	if (!g->n)
		return;
	use_style(f, PROGRAM_RIBBON, origin, style);
	glBindVertexArray(g->array);
	glDrawElements(GL_TRIANGLES, g->n, GL_UNSIGNED_INT, NULL);
	glBindVertexArray(0);
}

void gpu_draw_sprites(const struct gpu_frame *f, const struct gpu_poly *g, struct vec3 origin,
                      const struct gpu_sprite *style)
{
	if (g->n < 1)
		return;
	const GLint *u = use(f, PROGRAM_SPRITE, origin);
	glUniform4f(u[UNIFORM_COLOR], (float)style->fill.r, (float)style->fill.g,
	            (float)style->fill.b, (float)style->fill_alpha);
	glUniform4f(u[UNIFORM_STROKE], (float)style->stroke.r, (float)style->stroke.g,
	            (float)style->stroke.b, (float)style->stroke_alpha);
	glUniform1f(u[UNIFORM_SIZE], (float)(style->size * f->scale));
	glUniform1f(u[UNIFORM_WIDTH], (float)(style->width * f->scale));
	glUniform1f(u[UNIFORM_BIAS], (float)(style->lift * f->scale * f->pixel_depth));
	glUniform1i(u[UNIFORM_SHAPE], style->shape);
	glBindVertexArray(g->array);
	glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, g->n);
	glBindVertexArray(0);
}
