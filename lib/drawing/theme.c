/* theme.c - color tokens: text on view and raised has a contrast of 4.5 or more, edges 3. */
#include "theme.h"

static const unsigned tokens[2][N_TOKENS] = {
	[THEME_LIGHT] = { [TOKEN_VIEW] = 0xEDEFF1,
	                  [TOKEN_RAISED] = 0xFFFFFF,
	                  [TOKEN_LINE] = 0xD6DBE0,
	                  [TOKEN_EDGE] = 0x7D868F,
	                  [TOKEN_TEXT] = 0x14181C,
	                  [TOKEN_TEXT2] = 0x434C55,
	                  [TOKEN_MUTED] = 0x5C656E },
	[THEME_DARK] = { [TOKEN_VIEW] = 0x14171A,
	                 [TOKEN_RAISED] = 0x252A30,
	                 [TOKEN_LINE] = 0x2E343B,
	                 [TOKEN_EDGE] = 0x6B747E,
	                 [TOKEN_TEXT] = 0xE8EBEE,
	                 [TOKEN_TEXT2] = 0xB1B9C1,
	                 [TOKEN_MUTED] = 0x969FA8 },
};

struct rgb theme_color(enum theme theme, enum token token)
{
	unsigned c = tokens[theme][token];
	return (struct rgb){ (c >> 16 & 255) / 255.0, (c >> 8 & 255) / 255.0, (c & 255) / 255.0 };
}
