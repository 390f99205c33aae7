/* picture_image.c - linear light to a PNG. */
#include <math.h>

#include "picture.h"
#include "sheet.h"

static unsigned to_byte(double linear)
{
	if (!(linear > 0)) /* NaN too */
		return 0;
	return linear < 1 ? (unsigned)lrint(255 * rgb_from_linear(linear)) : 255;
}

enum status picture_image(const char *path, int width, int height, const float *const rgba[4],
                          enum theme theme, const struct report *r)
{
	struct sheet sheet;
	enum status st = sheet_init(&sheet, path, width, height, r);
	if (st)
		return st;
	struct rgb ground = theme_color(theme, TOKEN_VIEW);
	double behind[3] = { rgb_to_linear(ground.r), rgb_to_linear(ground.g),
		             rgb_to_linear(ground.b) };
	int stride;
	unsigned *pixels = sheet_pixels(&sheet, &stride);
	for (int y = 0; y < height; y++)
		for (int x = 0; x < width; x++) {
			size_t i = (size_t)y * width + x;
			double through = fmin(fmax(1 - rgba[3][i], 0), 1);
			unsigned p = 0;
			for (int c = 0; c < 3; c++)
				p = p << 8 | to_byte(rgba[c][i] + through * behind[c]);
			pixels[(size_t)y * stride + x] = p;
		}
	sheet_touched(&sheet);
	st = sheet_write(&sheet, path, r);
	sheet_finish(&sheet);
	return st;
}
