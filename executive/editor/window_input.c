/* window_input.c - what GLFW tells, told to the desk. */
#include <math.h>

#include "window_inside.h"

static struct window *of(GLFWwindow *g)
{
	return glfwGetWindowUserPointer(g);
}

static unsigned mods_of(int mods)
{
	return (mods & GLFW_MOD_SHIFT ? MOD_SHIFT : 0u) |
	       (mods & GLFW_MOD_CONTROL ? MOD_CTRL : 0u) | (mods & GLFW_MOD_ALT ? MOD_ALT : 0u);
}

/* Moves come in heaps; only the last before something else counts. */
void window_flush_move(struct window *w)
{
	if (w->moved)
		desk_move(w->desk, w->x, w->y);
	w->moved = false;
}

static const struct {
	int glfw;
	enum desk_key key;
} key_table[] = {
	{ GLFW_KEY_ESCAPE, KEY_ESCAPE },
	{ GLFW_KEY_ENTER, KEY_ENTER },
	{ GLFW_KEY_KP_ENTER, KEY_ENTER },
	{ GLFW_KEY_TAB, KEY_TAB },
	{ GLFW_KEY_BACKSPACE, KEY_BACKSPACE },
	{ GLFW_KEY_DELETE, KEY_DELETE },
	{ GLFW_KEY_LEFT, KEY_LEFT },
	{ GLFW_KEY_RIGHT, KEY_RIGHT },
	{ GLFW_KEY_UP, KEY_UP },
	{ GLFW_KEY_DOWN, KEY_DOWN },
	{ GLFW_KEY_HOME, KEY_HOME },
	{ GLFW_KEY_END, KEY_END },
	{ GLFW_KEY_PAGE_UP, KEY_PAGE_UP },
	{ GLFW_KEY_PAGE_DOWN, KEY_PAGE_DOWN },
	{ GLFW_KEY_SPACE, KEY_SPACE },
	{ GLFW_KEY_F1, KEY_F1 },
	{ GLFW_KEY_F4, KEY_F4 },
	{ GLFW_KEY_F9, KEY_F9 },
	{ GLFW_KEY_F10, KEY_F10 },
};

/* Letters with Ctrl by what is printed on the key, digits by the row of digits. */
static bool ctrl_key(int key, int scancode, enum desk_key *out)
{
	const char *name = glfwGetKeyName(key, scancode);
	char c = name && name[0] && !name[1] ? name[0] : 0;

	if (key >= GLFW_KEY_1 && key <= GLFW_KEY_6) {
		*out = (enum desk_key)(KEY_CTRL_1 + key - GLFW_KEY_1);
		return true;
	}
	if (c >= 'A' && c <= 'Z')
		c = (char)(c - 'A' + 'a');
	if (c < 'a' || c > 'z')
		return false;
	*out = (enum desk_key)(KEY_CTRL_A + c - 'a');
	return true;
}

static void on_key(GLFWwindow *g, int key, int scancode, int action, int mods)
{
	struct window *w = of(g);
	enum desk_key k;

	window_flush_move(w);
	if (action == GLFW_RELEASE) {
		if (key == GLFW_KEY_SPACE)
			desk_space_up(w->desk);
		return;
	}
	if ((mods & GLFW_MOD_CONTROL) && ctrl_key(key, scancode, &k)) {
		desk_key(w->desk, k, mods_of(mods));
		return;
	}
	for (size_t i = 0; i < sizeof key_table / sizeof *key_table; i++)
		if (key_table[i].glfw == key)
			desk_key(w->desk, key_table[i].key, mods_of(mods));
}

static void on_char(GLFWwindow *g, unsigned c)
{
	window_flush_move(of(g));
	desk_text(of(g)->desk, c);
}

static void on_move(GLFWwindow *g, double x, double y)
{
	struct window *w = of(g);

	w->x = x * w->per_screen / w->scale;
	w->y = y * w->per_screen / w->scale;
	w->moved = true;
}

static void on_button(GLFWwindow *g, int button, int action, int mods)
{
	struct window *w = of(g);
	enum desk_button b = button == GLFW_MOUSE_BUTTON_LEFT     ? BUTTON_LEFT
	                     : button == GLFW_MOUSE_BUTTON_MIDDLE ? BUTTON_MIDDLE
	                                                          : BUTTON_RIGHT;

	if (button > GLFW_MOUSE_BUTTON_MIDDLE)
		return;
	/* what came before may have changed what lies where */
	unsigned dirty = desk_take_dirty(w->desk);
	if (dirty)
		window_draw(w, dirty);
	window_flush_move(w);
	if (action == GLFW_PRESS)
		desk_press(w->desk, b, mods_of(mods));
	else
		desk_release(w->desk, b);
}

static void on_scroll(GLFWwindow *g, double dx, double dy)
{
	(void)dx;
	window_flush_move(of(g));
	desk_scroll(of(g)->desk, dy);
}

static void on_drop(GLFWwindow *g, int n, const char **paths)
{
	desk_open(of(g)->desk, paths, n);
}

static void on_close(GLFWwindow *g)
{
	glfwSetWindowShouldClose(g, GLFW_FALSE); /* when the desk says so */
	desk_close(of(g)->desk);
}

static void on_size(GLFWwindow *g, int width, int height)
{
	(void)width;
	(void)height;
	window_measure(of(g));
}

static void on_scale(GLFWwindow *g, float x, float y)
{
	(void)x;
	(void)y;
	window_measure(of(g));
}

/* What was on the screen is gone; the parts are still there. */
static void on_refresh(GLFWwindow *g)
{
	window_draw(of(g), 0);
}

void window_measure(struct window *w)
{
	float sx, sy;
	int width, height;

	glfwGetFramebufferSize(w->glfw, &w->width, &w->height);
	glfwGetWindowSize(w->glfw, &width, &height);
	glfwGetWindowContentScale(w->glfw, &sx, &sy);
	w->scale = sx > 0 ? fmax(1, round(4 * (double)sx) / 4) : 1;
	w->per_screen = width > 0 ? (double)w->width / width : 1;
	if (w->width > 0 && w->height > 0) /* not when it is made an icon */
		desk_resize(w->desk, w->width / w->scale, w->height / w->scale, w->scale);
}

void window_listen(struct window *w)
{
	GLFWwindow *g = w->glfw;

	glfwSetWindowUserPointer(g, w);
	glfwSetKeyCallback(g, on_key);
	glfwSetCharCallback(g, on_char);
	glfwSetCursorPosCallback(g, on_move);
	glfwSetMouseButtonCallback(g, on_button);
	glfwSetScrollCallback(g, on_scroll);
	glfwSetDropCallback(g, on_drop);
	glfwSetWindowCloseCallback(g, on_close);
	glfwSetFramebufferSizeCallback(g, on_size);
	glfwSetWindowContentScaleCallback(g, on_scale);
	glfwSetWindowRefreshCallback(g, on_refresh);
}
