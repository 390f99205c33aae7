/* gpu.h - what lies in the graphics memory, and drawing it. Private to this folder. */
#ifndef BATTEN_VIEW_GPU_H
#define BATTEN_VIEW_GPU_H

#include "colormap.h"
#include "mesh_made.h"
#include "poly.h"
#include "program.h"

/* Triangles. A zeroed one is empty. */
struct gpu_mesh {
	GLuint array, vertices, indices;
	int n, n_border; /* indices: of triangles; of the borders' edges, behind them */
};
void gpu_mesh_load(struct gpu_mesh *g, const struct mesh_made *m);
/* Triangles whose vertices have colors, as light. */
struct tinted_vertex {
	float position[3], normal[3], color[3];
};
struct tinted {
	struct tinted_vertex *vertices;
	unsigned *indices, *border;
	int n_vertices, n_indices, n_border;
};
void gpu_tinted_load(struct gpu_mesh *g, const struct tinted *t);
void gpu_mesh_finish(struct gpu_mesh *g);

/* Polylines, or points. */
struct gpu_poly {
	GLuint array, vertices, lengths;
	int n; /* vertices */
};
void gpu_poly_load(struct gpu_poly *g, const struct poly *p);
void gpu_poly_finish(struct gpu_poly *g);

/* Polylines that share the corners between their pieces: quicker, without dashes and round ends. */
struct gpu_ribbon {
	GLuint array, vertices, indices;
	int n; /* indices */
};
/* Errors: ST_RESOURCE. */
enum status gpu_ribbon_load(struct gpu_ribbon *g, const struct poly *p);
void gpu_ribbon_finish(struct gpu_ribbon *g);

/* Where things are drawn: clip = matrix x place in the world. */
struct gpu_frame {
	struct programs *programs;
	double matrix[16]; /* column by column */
	int width, height; /* device px */
	double scale;      /* device px a logical px */
	double pixel_depth; /* what one device pixel's length is in normalised depth, at the middle */
};

struct gpu_style {
	struct rgb color;
	double alpha, width; /* logical px */
	double dash[2];      /* on and off, logical px; 0: solid */
	double lift;         /* towards the eye, px */
};

/* Lines: those with dashes need the polylines they were loaded from. */
void gpu_draw_lines(const struct gpu_frame *f, struct gpu_poly *g, const struct poly *p,
                    const struct gpu_style *style);

void gpu_draw_ribbon(const struct gpu_frame *f, const struct gpu_ribbon *g, struct vec3 origin,
                     const struct gpu_style *style);

struct gpu_sprite {
	struct rgb fill, stroke;
	double fill_alpha, stroke_alpha;
	double size, width, lift; /* logical px */
	int shape;                /* 0 square, 1 disc */
};
void gpu_draw_sprites(const struct gpu_frame *f, const struct gpu_poly *g, struct vec3 origin,
                      const struct gpu_sprite *style);

/* The frame's matrix for places from an origin, as OpenGL takes it. */
void gpu_matrix(const struct gpu_frame *f, struct vec3 origin, float out[16]);

#endif
