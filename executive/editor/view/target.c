/* target.c - images off the screen, with and without multisampling. */
#include "view_private.h"

void target_finish(struct target *t)
{
	glDeleteFramebuffers(1, &t->frame);
	glDeleteRenderbuffers(1, &t->color);
	glDeleteRenderbuffers(1, &t->depth);
	*t = (struct target){ 0 };
}

enum status target_init(struct target *t, int width, int height, int samples,
                        const struct report *r)
{
	GLint most = 0;
	if (t->width == width && t->height == height && t->samples == samples)
		return ST_OK;
	target_finish(t);
	glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
	if (width > most || height > most)
		return report_error(
		        r, ST_RESOURCE,
		        "cannot draw %d x %d pixels: the graphics driver takes %d a side", width,
		        height, (int)most);
	glGenFramebuffers(1, &t->frame);
	glGenRenderbuffers(1, &t->color);
	glGenRenderbuffers(1, &t->depth);
	glBindFramebuffer(GL_FRAMEBUFFER, t->frame);
	glBindRenderbuffer(GL_RENDERBUFFER, t->color);
	glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width, height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, t->color);
	glBindRenderbuffer(GL_RENDERBUFFER, t->depth);
	glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width,
	                                 height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, t->depth);
	if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
		target_finish(t);
		return report_error(
		        r, ST_RESOURCE,
		        "cannot draw %d x %d pixels: no graphics memory; make the picture "
		        "smaller",
		        width, height);
	}
	t->width = width;
	t->height = height;
	t->samples = samples;
	return ST_OK;
}
