/* desk_words.c - what the mouse's buttons do now, in words. */
#include "desk_inside.h"

enum mouse_mode {
	MOUSE_IDLE,
	MOUSE_PLANE,
	MOUSE_VIEW,
	MOUSE_POINTS,
	MOUSE_LIGHT,
	MOUSE_SURFACE,
	MOUSE_CURVE,
	MOUSE_THING,
	MOUSE_JOBS,
	MOUSE_LIST,
	MOUSE_QUESTION,
	MOUSE_BUSY,
	MOUSE_EMPTY,
	N_MOUSE_MODES
};

#define NO_WORDS                                                                                   \
	{                                                                                          \
		"", "", ""                                                                         \
	}
static const struct Mouse_Words word_table[N_MOUSE_MODES] = {
	[MOUSE_IDLE] = { { "ROTATE VIEW", "PAN VIEW", "PROBE POINT" },
	                 { "KEEP VIEW", "", "KEEP MARK" } },
	[MOUSE_PLANE] = { { "TURN OR PAN", "PAN VIEW", "PROBE POINT" },
	                  { "KEEP VIEW", "", "KEEP MARK" } },
	[MOUSE_VIEW] = { { "ROTATE VIEW", "PAN VIEW", "PROBE POINT" },
	                 { "KEEP VIEW", "", "KEEP MARK" } },
	[MOUSE_POINTS] = { { "PICK POINT", "PAN VIEW", "ROTATE VIEW" },
	                   { "PLACE POINT", "", "KEEP VIEW" } },
	[MOUSE_LIGHT] = { { "MOVE LIGHT", "PAN VIEW", "ROTATE VIEW" },
	                  { "KEEP LIGHT", "", "KEEP VIEW" } },
	[MOUSE_SURFACE] = { { "PICK SURFACE", "PAN VIEW", "PROBE POINT" },
	                    { "", "", "KEEP MARK" } },
	[MOUSE_CURVE] = { { "PICK CURVE", "PAN VIEW", "PROBE POINT" }, { "", "", "KEEP MARK" } },
	[MOUSE_THING] = { { "PICK THING", "PAN VIEW", "PROBE POINT" }, { "", "", "KEEP MARK" } },
	[MOUSE_JOBS] = { { "SELECT JOB", "SCROLL LIST", "" }, NO_WORDS },
	[MOUSE_LIST] = { { "CHOOSE LINE", "SCROLL LIST", "" }, NO_WORDS },
	[MOUSE_QUESTION] = { { "ANSWER", "", "" }, NO_WORDS },
	[MOUSE_BUSY] = { NO_WORDS, NO_WORDS },
	[MOUSE_EMPTY] = { { "CHOOSE ENTRY", "", "" }, NO_WORDS },
};

static enum mouse_mode mode_of(const struct desk *d)
{
	if (d->errand)
		return MOUSE_BUSY;
	if (d->page == PAGE_QUESTION)
		return MOUSE_QUESTION;
	if (d->page == PAGE_JOBS)
		return MOUSE_JOBS;
	if (d->page != PAGE_NONE)
		return MOUSE_LIST;
	if (!world_count(d->world))
		return MOUSE_EMPTY;
	if (d->space)
		return MOUSE_VIEW;
	if (desk_pick_wanted(d))
		return d->ask.rows[d->ask.focus].type == ARGUMENT_SURFACE ? MOUSE_SURFACE
		       : d->ask.rows[d->ask.focus].type == ARGUMENT_CURVE ? MOUSE_CURVE
		                                                          : MOUSE_THING;
	if (d->tool == TOOL_POINTS)
		return MOUSE_POINTS;
	if (d->tool == TOOL_LIGHT)
		return MOUSE_LIGHT;
	return d->split == SPLIT_UV ? MOUSE_PLANE : MOUSE_IDLE;
}

struct Mouse_Words desk_mouse_words(const struct desk *d)
{
	return word_table[mode_of(d)];
}
