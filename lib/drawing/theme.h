/* theme.h - color tokens of the two themes. */
#ifndef BATTEN_THEME_H
#define BATTEN_THEME_H

#include "colormap.h"

enum theme { THEME_LIGHT, THEME_DARK };

enum token {
	TOKEN_VIEW,
	TOKEN_RAISED,
	TOKEN_LINE,
	TOKEN_EDGE,
	TOKEN_TEXT,
	TOKEN_TEXT2,
	TOKEN_MUTED,
	N_TOKENS
};

struct rgb theme_color(enum theme theme, enum token token);

#endif
