/* desk_ask_keys.c - what is typed while a leaf asks. */
#include "desk_inside.h"

bool desk_ask_key(struct desk *d, enum desk_key key, unsigned mods)
{
	struct ask *a = &d->ask;
	struct typed *t = &a->field[a->focus];
	bool text = desk_ask_textual(d), changed = false;

	switch ((int)key) {
	case KEY_ENTER:
		if (a->candidate >= 0)
			desk_ask_candidate(d, a->candidate);
		else
			desk_ask_accept(d);
		return true;
	case KEY_TAB:
		if ((mods & MOD_SHIFT) || !text || !desk_ask_complete(d))
			desk_ask_focus(d, (a->focus + (mods & MOD_SHIFT ? a->n - 1 : 1)) % a->n);
		return true;
	case KEY_UP:
		return desk_ask_up_down(d, -1);
	case KEY_DOWN:
		return desk_ask_up_down(d, 1);
	case KEY_LEFT:
		if (text)
			typed_left(t);
		else
			desk_ask_step(d, -1);
		desk_ask_dirty(d);
		return true;
	case KEY_RIGHT:
		if (!text)
			desk_ask_step(d, 1);
		else if (!typed_right(t))
			desk_ask_complete(d);
		desk_ask_dirty(d);
		return true;
	case KEY_HOME:
		desk_ask_dirty(d);
		return text && (typed_home(t), true);
	case KEY_END:
		desk_ask_dirty(d);
		return text && (typed_end(t), true);
	case KEY_BACKSPACE:
		changed = mods & MOD_CTRL ? typed_backspace_word(t) : typed_backspace(t);
		break;
	case KEY_DELETE:
		changed = typed_delete(t);
		break;
	case KEY_CTRL_A + 'U' - 'A':
		changed = typed_clear(t);
		break;
	case KEY_CTRL_A + 'R' - 'A':
		desk_ask_defaults(d);
		return true;
	case KEY_CTRL_A + 'P' - 'A':
		desk_ask_recall(d, 1);
		return true;
	case KEY_CTRL_A + 'N' - 'A':
		desk_ask_recall(d, -1);
		return true;
	case KEY_CTRL_A + 'V' - 'A':
		if (text && d->ports.paste && d->ports.paste(d->ports.data)) {
			typed_insert_text(t, d->ports.paste(d->ports.data));
			changed = true;
		}
		break;
	case KEY_CTRL_A + 'C' - 'A':
		if (d->ports.copy)
			d->ports.copy(d->ports.data, t->s);
		return true;
	default:
		return false;
	}
	if (changed) {
		desk_ask_changed(d);
		desk_tool_changed(d);
	}
	return true;
}

bool desk_ask_text(struct desk *d, uint32_t c)
{
	struct ask *a = &d->ask;

	if (!a->routine)
		return false;
	if (!desk_ask_textual(d))
		return c == ' ' && desk_ask_step(d, 1);
	if (typed_insert(&a->field[a->focus], c)) {
		desk_ask_changed(d);
		desk_tool_changed(d);
	}
	return true;
}
