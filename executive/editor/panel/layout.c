/* layout.c - where the parts of the window are. */
#include <math.h>

#include "paint.h"

enum { ROWS_MAX = 14, FORM_MIN = 96 };

static double panel_width(double width)
{
	return width >= 2560 ? 384 : width >= 1920 ? 352 : 320;
}

double panel_key_bar(double view_height)
{
	double bar = round(0.28 * view_height);
	return fmin(fmax(bar, 140), 320);
}

void layout_place(struct layout *l, double width, double height, bool panel_shown, int menu_rows)
{
	const double panel = panel_shown ? fmin(panel_width(width), width) : 0;
	const double left = width - panel;
	const int rows = menu_rows < 0 ? 0 : menu_rows > ROWS_MAX ? ROWS_MAX : menu_rows;

	l->menu_row = height < 760 ? 24 : 28;
	const double menu = PAINT_MENU_HEAD + rows * l->menu_row + 8;
	/* the icon gives way before the form has no room for its button and two fields */
	const bool low = height < 640 || height - PAINT_TOP - menu - PAINT_MOUSE < FORM_MIN;
	const double mouse = low ? PAINT_MOUSE_LOW : PAINT_MOUSE;
	l->form_row = 30;
	l->top = (struct box_px){ 0, 0, left, PAINT_TOP };
	l->panel_top = (struct box_px){ left, 0, panel, PAINT_TOP };
	l->message = (struct box_px){ 0, height - PAINT_FOOT, left, PAINT_MESSAGE };
	l->prompt = (struct box_px){ 0, height - PAINT_FOOT + PAINT_MESSAGE, left,
		                     PAINT_FOOT - PAINT_MESSAGE };
	l->view = (struct box_px){ 0, PAINT_TOP, left, fmax(height - PAINT_TOP - PAINT_FOOT, 0) };
	l->mouse = (struct box_px){ left, height - mouse, panel, mouse };
	l->menu =
	        (struct box_px){ left, PAINT_TOP, panel, PAINT_MENU_HEAD + rows * l->menu_row + 8 };
	const double form = l->menu.y + l->menu.height;
	l->form = (struct box_px){ left, form, panel, fmax(l->mouse.y - form, 0) };
	l->key = (struct box_px){ fmax(left - 128, 0), PAINT_TOP + 12, fmin(128, left),
		                  panel_key_bar(l->view.height) + 152 };
}
