/* offscreen.c - an OpenGL context without a window, by EGL's surfaceless platform. */
#include <stdlib.h>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "view.h"

struct offscreen {
	EGLDisplay display;
	EGLContext context;
};

static enum status missing(const struct report *r, const char *what)
{
	return report_error(
	        r, ST_RESOURCE,
	        "cannot draw without a window: %s (EGL error 0x%04x); OpenGL 3.3 by EGL "
	        "is needed, Debian's libgl1-mesa-dri has it",
	        what, (unsigned)eglGetError());
}

static enum status make_current(struct offscreen *o, const struct report *r)
{
	static const EGLint want[] = { EGL_CONTEXT_MAJOR_VERSION,
		                       3,
		                       EGL_CONTEXT_MINOR_VERSION,
		                       3,
		                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
		                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
		                       EGL_NONE };
	if (!eglBindAPI(EGL_OPENGL_API))
		return missing(r, "EGL has no OpenGL");
	o->context = eglCreateContext(o->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, want);
	if (o->context == EGL_NO_CONTEXT)
		return missing(r, "no context of OpenGL 3.3 core");
	if (!eglMakeCurrent(o->display, EGL_NO_SURFACE, EGL_NO_SURFACE, o->context))
		return missing(r, "the context cannot be used without a surface");
	return ST_OK;
}

enum status offscreen_create(struct offscreen **out, const struct report *r)
{
	if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
		return missing(r, "EGL has no surfaceless platform");
	struct offscreen *o = calloc(1, sizeof *o);
	if (!o)
		return report_error(r, ST_RESOURCE, "cannot draw: memory ran out");
	enum status st = ST_OK;
	o->display =
	        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
	if (o->display == EGL_NO_DISPLAY || !eglInitialize(o->display, NULL, NULL))
		st = missing(r, "the surfaceless display does not start");
	else
		st = make_current(o, r);
	if (st != ST_OK) {
		offscreen_destroy(o);
		return st;
	}
	*out = o;
	return ST_OK;
}

void offscreen_destroy(struct offscreen *o)
{
	if (!o)
		return;
	if (o->display) {
		eglMakeCurrent(o->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
		if (o->context)
			eglDestroyContext(o->display, o->context);
		eglTerminate(o->display);
	}
	free(o);
}
