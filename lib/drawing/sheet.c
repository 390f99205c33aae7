/* sheet.c - a Cairo surface in memory that becomes a PNG file. */
#include "sheet.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { SIDE_MAX = 32767 }; /* Cairo's image surfaces */

enum status sheet_init(struct sheet *s, const char *path, double width, double height,
                       const struct report *r)
{
	*s = (struct sheet){ .surface = NULL };
	if (!(width <= SIDE_MAX && height <= SIDE_MAX))
		return report_error(r, ST_RESOURCE,
		                    "cannot draw '%s': %.0f x %.0f pixels, a picture has at most "
		                    "%d a side; take a smaller size",
		                    path, width, height, SIDE_MAX);
	s->width = (int)width;
	s->height = (int)height;
	s->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, s->width, s->height);
	s->cr = cairo_create(s->surface);
	if (cairo_status(s->cr)) {
		sheet_finish(s);
		return report_error(r, ST_RESOURCE, "cannot draw '%s': no memory", path);
	}
	return ST_OK;
}

void sheet_finish(struct sheet *s)
{
	if (s->cr)
		cairo_destroy(s->cr);
	if (s->surface)
		cairo_surface_destroy(s->surface);
	*s = (struct sheet){ .surface = NULL };
}

unsigned *sheet_pixels(struct sheet *s, int *stride)
{
	cairo_surface_flush(s->surface);
	*stride = cairo_image_surface_get_stride(s->surface) / (int)sizeof(unsigned);
	return (unsigned *)(void *)cairo_image_surface_get_data(s->surface);
}

void sheet_touched(struct sheet *s)
{
	cairo_surface_mark_dirty(s->surface);
}

static cairo_status_t write_bytes(void *data, const unsigned char *bytes, unsigned n)
{
	FILE *f = data;
	return fwrite(bytes, 1, n, f) == n ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

enum status sheet_write(struct sheet *s, const char *path, const struct report *r)
{
	FILE *f = fopen(path, "wb");
	if (!f)
		return report_error(r, status_from_errno(errno), "cannot write '%s': %s", path,
		                    strerror(errno));
	errno = 0;
	cairo_surface_flush(s->surface);
	cairo_status_t drawn = cairo_status(s->cr);
	if (!drawn)
		drawn = cairo_surface_write_to_png_stream(s->surface, write_bytes, f);
	int error = errno;
	bool closed = fclose(f) == 0;
	if (!drawn && closed)
		return ST_OK;
	if (!drawn)
		error = errno;
	unlink(path);
	if (!drawn || drawn == CAIRO_STATUS_WRITE_ERROR)
		return report_error(r, ST_RESOURCE,
		                    "cannot write '%s': %s; make room and try again", path,
		                    strerror(error));
	return report_error(r, ST_RESOURCE, "cannot draw '%s': %s", path,
	                    cairo_status_to_string(drawn));
}
