/* theme.c - color tokens: text has a contrast of 4.5 or more on every ground, edges 3. */
#include "theme.h"

#define X(name, light, dark) [TOKEN_##name] = { [THEME_LIGHT] = light, [THEME_DARK] = dark },
static const unsigned tokens[N_TOKENS][2] = { TOKEN_MAP(X) };
#undef X

struct rgb theme_color(enum theme theme, enum token token)
{
	unsigned c = tokens[token][theme];
	return (struct rgb){ (c >> 16 & 255) / 255.0, (c >> 8 & 255) / 255.0, (c & 255) / 255.0 };
}
