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
	{ "Map file", "teap", "", NULL, FORM_TEXT, NULL, NULL, true, 4 },
	{ "Range", "2 – 98", "% of area", NULL, FORM_TEXT, NULL, NULL, false, 0 },
	{ "Scale", "arsinh", "", NULL, FORM_CHOICE, "linear|arsinh", NULL, false, 0 },
	{ "Symmetric", "yes", "about zero", NULL, FORM_YESNO, NULL, NULL, false, 0 },
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
	{ "Point", "5", "of 10", NULL, FORM_TEXT, NULL, NULL, false, 0 },
	{ "u", "6.5000", "", NULL, FORM_TEXT, NULL, NULL, true, 3 },
	{ "v", "4.3000", "", NULL, FORM_TEXT, NULL, NULL, false, 0 },
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
	  NULL, true, 3 },
	{ "Surface", "teapot lid, upper half, from the import of Tuesday", "", NULL, FORM_TEXT,
	  NULL, NULL, false, 0 },
	{ "Over", "shade", "", NULL, FORM_CHOICE, "wire|shade|map", NULL, false, 0 },
	{ "Light fixed", "no", "to the hull", NULL, FORM_YESNO, NULL, NULL, false, 0 },
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

const struct foot_model model_foot_kill = {
	.level = REPORT_WARNING,
	.message = "The disk of the project is nearly full, 120 MiB are free.",
	.message_hint = "F4 messages",
	.prompt = "Kill 2 jobs, 21 and 19? They keep their part files.",
	.rest = "y or n",
	.caret_on = true,
	.hints = { { "Y", "kill" }, { "N", "keep" } },
};

const struct probe_model model_probe = {
	.title = "teapot",
	.has_uv = true,
	.u = 1.9,
	.v = 3.6,
	.point = { -1.0088, -0.2832, 0.0227 },
	.normal = { -0.1042, -0.7613, -0.64 },
	.K = 0.1119,
	.H = -1.2668,
	.kmax = -0.045,
	.kmin = -2.4887,
	.unit = "m",
};

const struct key_model model_key = {
	.map = { .is_signed = true, .lo = -160, .hi = 160, .arsinh = true, .knee = 0.3 },
	.title = "Gaussian curvature",
	.symbol = "K",
	.unit = "1/m²",
	.below = 0.021,
	.above = 0.0004,
	.nothing = true,
};
const struct key_model model_key_none = { .title = "Mean curvature", .symbol = "H", .unit = "1/m" };

#define JOB(number, in, work, file, d, t, left, why)                                               \
	{                                                                                          \
		.id = number, .worker = work, .file_name = file, .state = in, .done = d,           \
		.total = t, .eta_s = left, .reason = why, .threads = 8, .phase = "tile",           \
		.started = 1.7e9, .submitted = 1.7e9, .wall_s = 13, .suspended_s = 0, .cpu_s = 94, \
		.peak_kib = 412 << 10                                                              \
	}
static struct job_output shaded = { "ship/teapot.shade.exr", "image", NULL };
static const struct Stats stats[] = {
	JOB(24, JOB_STARTING, "shading", "wave10.base", 0, 512, NAN, NULL),
	JOB(23, JOB_HELD, "raytrace", "teapot.base", 0, 0, NAN, "held by you"),
	JOB(22, JOB_QUEUED, "isophotes", "teapot.base", 0, 0, NAN, "waits for job 21"),
	JOB(21, JOB_RUNNING, "curvature", "teapot.base", 318, 512, 84, NULL),
	JOB(20, JOB_RUNNING, "geodesic", "parts/of/a/long/path/series_60_with_bulb.base", 41, 590,
	    8410, NULL),
	JOB(19, JOB_SUSPENDED, "raytrace", "teapot.base", 38, 100, 362, "by you at 14:01"),
	{ .id = 18,
	  .worker = "shading",
	  .file_name = "teapot.base",
	  .state = JOB_DONE,
	  .done = 512,
	  .total = 512,
	  .outputs = &shaded,
	  .n_outputs = 1,
	  .wall_s = 41,
	  .suspended_s = NAN,
	  .cpu_s = NAN,
	  .peak_kib = -1,
	  .eta_s = NAN },
	JOB(17, JOB_FAILED, "offset", "teapot.base", 83, 100, NAN,
	    "distance 0.9 m is greater than the smallest radius 0.340 m; take less, or trim first"),
	JOB(16, JOB_KILLED, "contours", "teapot.base", 71, 100, NAN, "by you; kept for retry"),
	JOB(15, JOB_LOST, "curvature", "propeller.base", 44, 100, NAN, "node c12 went away"),
	JOB(14, JOB_ENDING, "isophotes", "wave10.base", 9, 10, NAN, "stopping"),
};
static const struct Stats *const jobs[] = { stats,     stats + 1, stats + 2, stats + 3,
	                                    stats + 4, stats + 5, stats + 6, stats + 7,
	                                    stats + 8, stats + 9, stats + 10 };
static const bool picked[N(jobs)] = { [3] = true, [5] = true, [7] = true };
static const char *const log_lines[] = {
	"14:03:06 offset 1.2.0 on teapot.base, distance 0.9 m, tolerance 1e-4 m, 8 threads",
	"14:03:07 patch 1 of 3  19 x 14  order 4 x 4",
	"14:03:11 patch 2 of 3   4 x 81  order 4 x 6",
	"14:03:15 patch 3 of 3  16 x 10  order 4 x 4",
	"14:03:16 sampling 512 x 256, 8 threads",
	"14:03:18 largest error so far 3.1e-5 m, 412 spans inserted",
	"14:03:19 warning: near u 0.31 v 0.12 the offset folds, smallest radius 0.340 m",
	"14:03:19 error: distance 0.9 m is greater than the smallest radius 0.340 m",
	"take a distance below 0.340 m, or trim the dome first (V130 SPLIT), then retry",
};
const struct jobs_model model_jobs = {
	.jobs = jobs,
	.picked = picked,
	.n = N(jobs),
	.focus = 7,
	.count = { 11, 5, 2, 4 },
	.slots = "12 of 16 threads, 3 of 4 job slots in use",
	.log_title = "Log of job 17, offset",
	.log = log_lines,
	.n_log = N(log_lines),
	.now = 1.7e9 + 200,
	.can = { true, true, true, true, false },
};
const struct jobs_model model_jobs_none = { .focus = -1, .slots = "0 of 4 job slots in use" };

const struct search_model model_search = {
	.typed = "iso",
	.caret = 3,
	.results = { { "CALCULATE ISOPHOTE", "INTERROGATION › SURFACE › ISOPHOTES", "job", "V90",
	               false },
	             { "SHOW ISOPHOTE", "INTERROGATION › SURFACE › ISOPHOTES", "show", "V91",
	               false },
	             { "READ ISOPHOTE", "INTERROGATION › SURFACE › ISOPHOTES", "show", "V89",
	               false },
	             { "ISOPHOTES", "INTERROGATION › SURFACE", "menu", "N51", false },
	             { "FIT/APPROX n ISOPARAMETER", "GENERATION › SURFACES", "job", "V31", false },
	             { "SHOW WIRE FRAME/CURVE", "COSFAIR, help text: isoparametric lines",
	               "COSFAIR only", "V153", true } },
	.n = 6,
	.found = 6,
	.all = 173,
};
const struct search_model model_search_none = {
	.typed = "isofote",
	.caret = 7,
	.results = { { "ISOPHOTES", "INTERROGATION › SURFACE", "menu", "N51", false },
	             { "SHOW ISOPHOTE", "INTERROGATION › SURFACE › ISOPHOTES", "show", "V91",
	               false } },
	.n = 2,
	.all = 173,
};

const struct help_model model_help = {
	.code = "V80",
	.title = "Gaussian curvature",
	.kind = "show",
	.path = "CURVATURE › GAUSSIAN",
	.text = "purpose\n"
	        "Colors the current surface by K, the product of its two principal curvatures. "
	        "Orange is\nK above zero: the surface is a bowl or a dome. Blue is K below zero: a "
	        "saddle. Grey is K near zero: plate that can be rolled.\n\n"
	        "Values come from the surface itself at each sample, not from triangles. Where a "
	        "map of the same geometry is there, it is shown at once.\n\n"
	        "arguments\n"
	        "file | a name | the map to show\n"
	        "range | 2 – 98 % of area | percentiles, or two numbers in 1/m², below and above which "
	        "the colors stay the same\n"
	        "scale | arsinh | linear, or arsinh for wide ranges\n"
	        "symmetric | yes | zero in the middle of the key\n\n"
	        "result\n"
	        "The surface in its colors, and their key at the view's right edge. Drag an end of "
	        "the key to set the range by hand.\n\n"
	        "example\n"
	        "V80 file=teapot.map.exr range=2,98 scale=arsinh\n"
	        "V81 file=teapot.map.exr\n\n"
	        "see also\n"
	        "V81 MEAN, V84 MINIMUM PRINCIPLE, V174 SEGMENTATION\n",
};

static const struct key_row key_rows[] = {
	{ "1-9 0 A-D", "menu entry 1 to 14", false },
	{ "Enter", "main button", false },
	{ "Esc", "back one step", false },
	{ "/", "find a routine", false },
	{ "W", "world menu, again to return", false },
	{ "Tab", "next field, complete", false },
	{ "F", "fit the view", false },
	{ "Home", "standard view", false },
	{ "Space", "held: change the view", false },
	{ "Z", "undo: add point 10", false },
	{ "Shift Z", "redo: nothing to redo", true },
	{ "F1", "help for the entry under the mouse", false },
	{ "?", "this sheet", false },
	{ "J", "job list", false },
	{ "S", "suspend", true },
	{ "A", "activate", true },
	{ "K", "kill", true },
	{ "R", "retry", true },
	{ "O", "open the result", true },
	{ "L", "log", true },
	{ "X", "view along x", false },
	{ "Y", "view along y", false },
	{ "Ctrl 1-6", "six sides", false },
	{ "↑ ↓ ← →", "turn by 5°, Shift pan, Ctrl zoom", false },
	{ "F4", "last 200 messages", false },
	{ "F9", "show or hide the panel", false },
	{ "F10", "dark or light", false },
};
const struct keys_model model_keys = { key_rows, N(key_rows), 0 };

const struct color_model model_color = { 205, 0.30, 0.84, { 0.66, 0.71, 0.75 }, "Color of teapot" };
const struct light_model model_light = { -118, 38, 0.8 };
const struct bar_model model_bar = {
	REPORT_WARNING,
	"The job service has gone. Jobs go on; they are seen again when "
	"it is back.",
	"Start it again"
};
const struct bar_model model_bar_long = {
	REPORT_ERROR,
	"cannot read '/home/anna/projects/ship/menus/main.menu' line 212: 15 entries under GEOMETRY "
	"INTERROGATION, expected at most 14; take one away. The built-in menu is used until then.",
	"Read it again"
};
static const char *const recent[] = { "teapot.base", "wave10.iges" };
const struct empty_model model_empty = { recent, N(recent) };
static const char *const messages[] = {
	"14:02 Shading of teapot.base is done: teapot.shade.exr",
	"14:03 Job 17 failed: distance 0.9 m is greater than the smallest radius 0.340 m",
	"14:04 Isophotes of 3 surfaces are drawn, 94 branches",
};
const struct list_model model_list = { "Messages", messages, N(messages), 0, NULL, 0 };
static const char *const losses[] = {
	"lid, 4 edits since it was read", "handle, never saved",
	"2 jobs are running, 21 and 19; they go on without the window"
};
static const char *const answers[] = { "Quit without saving", "Save and quit", "Stay" };
const struct list_model model_question = {
	"Two things are not saved", losses, N(losses), 0, answers, N(answers),
};
