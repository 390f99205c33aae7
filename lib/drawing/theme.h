/* theme.h - color tokens of the two themes. */
#ifndef BATTEN_THEME_H
#define BATTEN_THEME_H

#include "colormap.h"

enum theme { THEME_LIGHT, THEME_DARK };

/* token, on light, on dark, what for */
#define TOKEN_MAP(X)                                                                               \
	X(VIEW, 0xEDEFF1, 0x14171A)   /* background of views */                                    \
	X(BAR, 0xF8F9FA, 0x1B1F23)    /* top bar, panel, foot */                                   \
	X(RAISED, 0xFFFFFF, 0x252A30) /* chips, cards, buttons */                                  \
	X(HOVER, 0xEEF1F4, 0x2B3138)  /* row under the mouse */                                    \
	X(TINT, 0xDCE8FB, 0x23344F)   /* chosen row */                                             \
	X(FIELD, 0xFFFFFF, 0x121518)  /* inputs, logs */                                           \
	X(LINE, 0xD6DBE0, 0x2E343B)   /* rules and borders */                                      \
	X(EDGE, 0x7D868F, 0x6B747E)   /* strokes that must be seen */                              \
	X(TEXT, 0x14181C, 0xE8EBEE)                                                                \
	X(TEXT2, 0x434C55, 0xB1B9C1)                                                               \
	X(MUTED, 0x5C656E, 0x969FA8)                                                               \
	X(OFF, 0x838C94, 0x6B747D)      /* greyed; a reason stands beside it */                    \
	X(ACCENT, 0x0A5BD3, 0x6AA5FF)   /* focus, choice, the main button */                       \
	X(ONACCENT, 0xFFFFFF, 0x0B1220) /* text on it */                                           \
	X(PRESS, 0x0A5BD3, 0x6AA5FF)    /* mouse words */                                          \
	X(RELEASE, 0x8A5200, 0xE9B872)                                                             \
	X(CURRENT, 0xB3127A, 0xFF86CC) /* current curve and its points */                          \
	X(NET, 0x69727B, 0x8A939C)     /* control net */

#define X(name, light, dark) TOKEN_##name,
enum token { TOKEN_MAP(X) N_TOKENS };
#undef X

struct rgb theme_color(enum theme theme, enum token token);

#endif
