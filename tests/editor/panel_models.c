/* panel_models.c - models of the window's parts. */
#include "panel_models.h"

#include <math.h>

#define N(a) ((int)(sizeof(a) / sizeof *(a)))

static const struct chip chips[] = {
	{ 21, JOB_RUNNING, "curvature 21", "1:24", 0.62 },
	{ 19, JOB_SUSPENDED, "raytrace 19", "38 %", 0.38 },
	{ 22, JOB_QUEUED, "isophotes 22", "after 21", NAN },
	{ 18, JOB_DONE, "shading 18", "done in 0:41", NAN },
	{ 17, JOB_FAILED, "offset 17", "bad parameter", NAN },
	{ 16, JOB_KILLED, "contours 16", "by you, at 71 %", NAN },
};
const struct top_model model_top = { "teapot.base", "32 surfaces, metres", chips, N(chips) };
const struct top_model model_top_none = { "ship", "project folder", NULL, 0 };

static const struct menu_row curvature[] = {
	{ '1', "READ CURVATURE", "1 map", false, false, false },
	{ '2', "CHANGE VIEW", "", false, false, false },
	{ '3', "ALL CURVATURES", "job", false, false, false },
	{ '4', "GAUSSIAN", "shown", false, true, false },
	{ '5', "MEAN", "", false, false, false },
	{ '6', "ABSOLUTE", "", false, false, false },
	{ '7', "MAXIMUM PRINCIPLE", "", false, false, false },
	{ '8', "MINIMUM PRINCIPLE", "", false, false, false },
	{ '9', "NORMAL U", "not in map", true, false, false },
	{ '0', "NORMAL V", "not in map", true, false, false },
	{ 'A', "SEGMENTATION", "400 × 200", false, false, false },
};
static const struct form_field asked[] = {
	{ "Map file", "teap", "", NULL, FORM_TEXT, NULL, true, 4 },
	{ "Range", "2 – 98", "% of area", NULL, FORM_TEXT, NULL, false, 0 },
	{ "Scale", "arsinh", "", NULL, FORM_CHOICE, "linear|arsinh", false, 0 },
	{ "Symmetric", "yes", "about zero", NULL, FORM_YESNO, NULL, false, 0 },
};
const struct menu_model model_menu = {
	.crumbs = "MAIN › INTERROGATION › SURFACE",
	.title = "CURVATURE",
	.code = "N50",
	.rows = curvature,
	.n_rows = N(curvature),
	.form_title = "GAUSSIAN",
	.form_code = "V80",
	.fields = asked,
	.n_fields = N(asked),
	.main_button = "Show",
	.other_button = "Defaults",
	.other_key = "R",
};

static const struct menu_row fourteen[] = {
	{ '1', "INPUT UV POINTS", "", false, false, false },
	{ '2', "OUTPUT UV POINTS", "", false, false, false },
	{ '3', "SHOW UV POINTS", "shown", false, false, false },
	{ '4', "ADD UV POINTS", "", false, false, false },
	{ '5', "INSERT UV POINTS", "", false, false, false },
	{ '6', "DELETE UV POINTS", "", false, false, false },
	{ '7', "MOVE UV POINTS", "", false, true, false },
	{ '8', "SELECT WINDOW", "all", false, false, false },
	{ '9', "FIT POINTS", "order 4, closed", false, false, false },
	{ '0', "MAKE SYSTEM CURVE", "", false, false, false },
	{ 'A', "SET STEPS", "100", false, false, false },
	{ 'B', "START AGAIN", "", false, false, false },
	{ 'C', "SHOW WIRE FRAME/CURVE", "no curve", true, false, false },
	{ 'D', "QUIT", "", false, false, true },
};
static const struct form_field point[] = {
	{ "Point", "5", "of 10", NULL, FORM_TEXT, NULL, false, 0 },
	{ "u", "6.5000", "", NULL, FORM_TEXT, NULL, true, 3 },
	{ "v", "4.3000", "", NULL, FORM_TEXT, NULL, false, 0 },
};
const struct menu_model model_menu_long = {
	.crumbs = "MAIN › PROCESSING › COS PROCESSING",
	.title = "UV",
	.code = "N70",
	.rows = fourteen,
	.n_rows = N(fourteen),
	.form_title = "MOVE UV POINTS",
	.form_code = "V146",
	.fields = point,
	.n_fields = N(point),
	.main_button = "Move",
};

static const struct form_field wrong[] = {
	{ "Distance", "0.9", "m", "greater than the smallest radius, 0.340 m", FORM_TEXT, NULL,
	  true, 3 },
	{ "Surface", "teapot lid, upper half, from the import of Tuesday", "", NULL, FORM_TEXT,
	  NULL, false, 0 },
	{ "Over", "shade", "", NULL, FORM_CHOICE, "wire|shade|map", false, 0 },
	{ "Light fixed", "no", "to the hull", NULL, FORM_YESNO, NULL, false, 0 },
};
const struct menu_model model_menu_error = {
	.crumbs = "MAIN › INTERROGATION › SURFACE",
	.title = "CURVATURE",
	.code = "N50",
	.rows = curvature,
	.n_rows = 5,
	.form_title = "OFFSET OF A SURFACE",
	.form_code = "V40",
	.fields = wrong,
	.n_fields = N(wrong),
	.main_button = "Start",
};

static const struct menu_row entries[] = {
	{ '1', "INPUT ROUTINES", "", false, false, true },
	{ '2', "GEOMETRY GENERATION", "", false, false, true },
	{ '3', "GEOMETRY INTERROGATION", "no file", true, false, true },
	{ '4', "GEOMETRY PROCESSING", "no file", true, false, true },
	{ '5', "FILES", "", false, false, true },
	{ '6', "QUIT", "", false, false, false },
};
const struct menu_model model_menu_main = {
	.crumbs = "batten",
	.title = "MAIN",
	.code = "N0",
	.rows = entries,
	.n_rows = N(entries),
};

static const struct menu_row status[] = {
	{ '1', "LIST JOBS", "shown", false, true, false },
	{ '2', "SUSPEND JOBS", "1 can", false, false, false },
	{ '3', "ACTIVATE JOBS", "1 can", false, false, false },
	{ '4', "KILL JOBS", "2 can", false, false, false },
};
const struct menu_model model_menu_jobs = {
	.crumbs = "WORLD",
	.title = "STATUS ROUTINES",
	.code = "N90",
	.rows = status,
	.n_rows = N(status),
	.world_open = true,
};

const struct Mouse_Words model_mouse = { { "ROTATE VIEW", "PAN VIEW", "PROBE POINT" },
	                                 { "KEEP VIEW", "", "KEEP MARK" } };
const struct Mouse_Words model_mouse_both = { { "CHOOSE CONTROL POINT", "SCALE OF PORCUPINES",
	                                        "HELP ON ENTRY" },
	                                      { "PUT IT THERE", "KEEP SCALE", "CLOSE" } };
const struct Mouse_Words model_mouse_few = { { "CHOOSE ENTRY", "", "HELP ON ENTRY" },
	                                     { "", "", "" } };

static const char *const candidates[] = { "teapot.map.exr", "teapot_faired.map.exr",
	                                  "teapot_lid.map.exr" };
static const char *const notes[] = { "today 14:02, 400 × 200", "today 11:37, 400 × 200",
	                             "Tuesday, 800 × 400" };
const struct foot_model model_foot = {
	.done = true,
	.message = "Shading of teapot.base is done: teapot.shade.exr",
	.message_hint = "O opens it",
	.prompt = "Map file",
	.typed = "teap",
	.rest = "ot.map.exr",
	.caret = 4,
	.caret_on = true,
	.hints = { { "Tab", "complete" }, { "Enter", "accept" }, { "Esc", "back" } },
	.candidates = candidates,
	.candidate_notes = notes,
	.n_candidates = 3,
};
const struct foot_model model_foot_choose = {
	.message = "Project folder ship: 2 IGES files, 4 .base files, no unfinished jobs.",
	.prompt = "Choose",
	.typed = "",
	.rest = "1 – 6, or / to find a routine",
	.caret_on = true,
	.hints = { { "F1", "help" }, { "?", "all keys" } },
};
const struct foot_model model_foot_error = {
	.level = REPORT_ERROR,
	.message = "Job 17 failed: distance 0.9 m is greater than the smallest radius 0.340 m.",
	.message_hint = "L opens the log",
	.prompt = "Incidence",
	.typed = "38",
	.range = "0 to 90°",
	.caret = 2,
	.caret_on = true,
	.hints = { { "↑ ↓", "1°" }, { "Tab", "next" }, { "Enter", "keep" }, { "Esc", "put back" } },
};
