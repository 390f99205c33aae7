/* scratch.c - lines and points that live for one frame. */
#include "view_private.h"

void scratch_begin(struct drawing *d, struct vec3 origin)
{
	poly_reset(&d->view->scratch_poly, origin);
}

void scratch_lines(struct drawing *d, const struct gpu_style *style)
{
	poly_end(&d->view->scratch_poly);
	gpu_poly_load(&d->view->scratch, &d->view->scratch_poly);
	gpu_draw_lines(&d->frame, &d->view->scratch, &d->view->scratch_poly, style);
}

void scratch_sprites(struct drawing *d, const struct gpu_sprite *style)
{
	poly_end(&d->view->scratch_poly);
	gpu_poly_load(&d->view->scratch, &d->view->scratch_poly);
	gpu_draw_sprites(&d->frame, &d->view->scratch, d->view->scratch_poly.origin, style);
}
