/* rows.c - what the leaves ask for. */
#include "rows.h"

#include <stddef.h>

/* clang-format off */
#define TEXT(n, p, d, h) { .name = n, .type = ARGUMENT_TEXT, .prompt = p, .def = d, .help = h }
#define KIND(t, n, p, d, h) { .name = n, .type = ARGUMENT_##t, .prompt = p, .def = d, .help = h }
#define MAY(t, n, p, u, h) { .name = n, .type = ARGUMENT_##t, .prompt = p, .unit = u, .help = h, .optional = true, .min = 1 }
#define WHOLE(n, p, d, lo, hi, h) { .name = n, .type = ARGUMENT_INTEGER, .prompt = p, .def = d, .min = lo, .max = hi, .help = h }
#define REAL(n, p, d, lo, hi, u, h) { .name = n, .type = ARGUMENT_NUMBER, .prompt = p, .def = d, .min = lo, .max = hi, .unit = u, .help = h }
#define CHOICE(n, p, d, c, h) { .name = n, .type = ARGUMENT_CHOICE, .prompt = p, .def = d, .choices = c, .help = h }
#define YESNO(n, p, d, h) { .name = n, .type = ARGUMENT_YESNO, .prompt = p, .def = d, .help = h }
#define READ(n, p, g, h) { .name = n, .type = ARGUMENT_FILE, .prompt = p, .pattern = g, .help = h }
#define WRITE(n, p, g, h) { .name = n, .type = ARGUMENT_OUTPUT, .prompt = p, .pattern = g, .help = h }
/* stored as defaults of jobs */
#define SET(t, n, p, lo, hi, u, s, h) { .name = n, .type = ARGUMENT_##t, .prompt = p, .min = lo, .max = hi, .unit = u, .help = h, .optional = true, .stores = s }
#define END { .name = NULL }
#define GEOMETRY "*.base *.igs *.iges *.g2"

const struct argument_row rows_open[] = {
	READ("file", "File", GEOMETRY, "geometry file"),
	MAY(ENTITIES, "entity", "Entities", NULL, "which of its entities, by comma: number, name, or D and Directory Entry number; or all"),
	END };
const struct argument_row rows_recall[] = { READ("name", "File", "*.base", "file in the project folder"), END };
const struct argument_row rows_entities_file[] = {
	READ("file", "IGES file", "*.igs *.iges", "IGES file"),
	MAY(ENTITIES, "entity", "Entities", NULL, "which of its entities, by comma; all of the kind where left out"),
	END };
const struct argument_row rows_save_as[] = {
	TEXT("name", "Name", NULL, "new name; the file is NAME.base"),
	YESNO("overwrite", "Overwrite", "no", "take the place of a file that is there"),
	END };
const struct argument_row rows_rename[] = { TEXT("name", "Name", NULL, "new name"), END };
const struct argument_row rows_close[] = {
	MAY(THING, "name", "Name", NULL, "what to close; the current surface, else the current curve, where left out"),
	YESNO("discard", "Discard edits", "no", "close it though it is not saved"),
	END };
const struct argument_row rows_export[] = {
	MAY(TEXT, "entities", "Entities", NULL, "names by comma, or all; the current thing where left out"),
	WRITE("to", "File", "*.igs *.iges *.g2 *.obj *.ply *.stl *.csv *.base", "file to write; its extension says in which format"),
	END };
const struct argument_row rows_picture[] = {
	WRITE("to", "File", "*.png *.svg *.pdf", "file to write; its extension says in which format"),
	KIND(SIZE, "size", "Size", "1920x1200", "width and height in px"),
	MAY(VIEW, "view", "View", NULL, "from where it is seen; as the window shows it where left out"),
	CHOICE("views", "Views", "shown", "shown|one|side|child|uv|curvatures", "what is beside each other; shown: as the window has it"),
	MAY(VIEW, "beside", "Beside", NULL, "from where the second of two sides is seen; as the window shows it where left out"),
	END };
const struct argument_row rows_quit[] = {
	{ .name = "unsaved", .type = ARGUMENT_CHOICE, .prompt = "Unsaved geometry", .choices = "save|discard|keep",
	  .optional = true, .help = "what becomes of geometry that is not saved; keep: the next start has it, and a script goes on; must be said where there is some" },
	CHOICE("jobs", "Running jobs", "leave", "leave|suspend|kill", "what becomes of running jobs"),
	END };

const struct argument_row rows_segments[] = { WHOLE("segments", "Segments", "0", 0, 100000, "segments of the curve; 0: as exact as can be seen"), END };
const struct argument_row rows_color[] = { KIND(COLOR, "color", "Color", "#C3CCD4", "color as #7CC4F8"), END };
const struct argument_row rows_linetype[] = { CHOICE("linetype", "Line type", "solid", "solid|dashed|dotted", "how the curve is drawn"), END };
const struct argument_row rows_samples[] = { WHOLE("samples", "Quills", "100", 2, 100000, "quills of the porcupine"), END };
const struct argument_row rows_view[] = { KIND(VIEW, "view", "View", "three-quarter", "three-quarter, front, back, left, right, top, bottom or AZIMUTH,ELEVATION in degrees; then :perspective or :orthographic, and @ANGLE"), END };
const struct argument_row rows_porcupine[] = {
	REAL("scale", "Scale", "0.2", 0, 100, NULL, "length of the longest quill, as a share of the curve's size; 0: off"),
	{ .name = "save", .type = ARGUMENT_OUTPUT, .prompt = "Graph", .pattern = "*.svg *.pdf *.csv", .optional = true,
	  .help = "file for curvature and torsion along the curve: .svg or .pdf a graph, .csv a table" },
	END };
const struct argument_row rows_surface_resolution[] = {
	WHOLE("lines_u", "Lines in u", "7", 0, 10000, "isoparametric lines between the borders, u constant"),
	WHOLE("lines_v", "Lines in v", "7", 0, 10000, "isoparametric lines between the borders, v constant"),
	WHOLE("segments", "Segments", "0", 0, 100000, "segments of a line; 0: as exact as can be seen"),
	END };
const struct argument_row rows_lines[] = { YESNO("on", "Shown", "yes", "draw them or not"), END };
const struct argument_row rows_image_on[] = { YESNO("on", "Shown", "yes", "draw images, or the things they are of"), END };
const struct argument_row rows_on[] = { YESNO("on", "Shown", "yes", "draw the current surface or not"), END };

#define FAMILY(n) "planes." n
const struct argument_row rows_plane_count[] = { SET(INTEGER, "count", "Planes", 1, 1000, NULL, FAMILY("count"), "how many planes"), END };
const struct argument_row rows_plane_start[] = {
	SET(VECTOR, "point", "Point", 1, 0, "file", FAMILY("point"), "a point of the first plane"),
	SET(VECTOR, "normal", "Normal", 1, 0, NULL, FAMILY("normal"), "direction across the planes, any length"),
	{ .name = "family", .type = ARGUMENT_CHOICE, .prompt = "Family", .choices = "stations|waterlines|buttocks",
	  .optional = true, .stores = FAMILY("family"), .help = "planes of a ship, instead of the normal" },
	END };
const struct argument_row rows_plane_distance[] = { SET(NUMBER, "distance", "Distance", 1e-300, 1e300, "file", FAMILY("distance"), "from one plane to the next"), END };
const struct argument_row rows_plane_tolerance_uv[] = { SET(NUMBER, "tolerance_uv", "Accuracy in u, v", 1e-300, 1e300, NULL, FAMILY("tolerance_uv"), "largest distance from the exact curve in the surface's parameters, too"), END };
const struct argument_row rows_plane_tolerance[] = { SET(NUMBER, "tolerance", "Accuracy", 1e-300, 1e300, "file", FAMILY("tolerance"), "largest distance from the exact curve"), END };
#undef FAMILY
#define FAMILY(n) "cylinders." n
const struct argument_row rows_cylinder_count[] = { SET(INTEGER, "count", "Cylinders", 1, 1000, NULL, FAMILY("count"), "how many cylinders"), END };
const struct argument_row rows_cylinder_start[] = {
	SET(VECTOR, "point", "Point", 1, 0, "file", FAMILY("point"), "a point of the axis"),
	SET(VECTOR, "axis", "Axis", 1, 0, NULL, FAMILY("axis"), "direction of the axis, any length"),
	SET(NUMBER, "radius", "Radius", 1e-300, 1e300, "file", FAMILY("radius"), "first radius"),
	END };
const struct argument_row rows_cylinder_distance[] = { SET(NUMBER, "distance", "Distance", 1e-300, 1e300, "file", FAMILY("distance"), "from one radius to the next"), END };
const struct argument_row rows_cylinder_tolerance_uv[] = { SET(NUMBER, "tolerance_uv", "Accuracy in u, v", 1e-300, 1e300, NULL, FAMILY("tolerance_uv"), "largest distance from the exact curve in the surface's parameters, too"), END };
const struct argument_row rows_cylinder_tolerance[] = { SET(NUMBER, "tolerance", "Accuracy", 1e-300, 1e300, "file", FAMILY("tolerance"), "largest distance from the exact curve"), END };
#undef FAMILY

const struct argument_row rows_shade_file[] = { READ("file", "Image", "*.shade.exr", "image made by the shading worker"), END };
const struct argument_row rows_trace_file[] = { READ("file", "Image", "*.trace.exr", "image made by the ray trace worker"), END };
const struct argument_row rows_map_file[] = { READ("file", "Map", "*.map.exr", "map made by the curvature worker"), END };
const struct argument_row rows_lines_file[] = { READ("file", "Lines", "*.isophote *.contour *.reflect", "curves made by a worker"), END };
const struct argument_row rows_light[] = {
	SET(NUMBER, "intensity", "Intensity", 0, 100, NULL, "shading.intensity raytrace.intensity", "strength of the light"),
	SET(NUMBER, "azimuth", "Azimuth", -360, 360, "deg", "shading.azimuth raytrace.azimuth isophotes.azimuth", "where the light stands, from +x towards +y"),
	SET(NUMBER, "incidence", "Incidence", 0, 180, "deg", "shading.incidence raytrace.incidence isophotes.incidence", "angle of the light from +z"),
	END };
const struct argument_row rows_material[] = {
	SET(COLOR, "color", "Color", 0, 0, NULL, "raytrace.color", "color of surfaces to which the file gives none"),
	SET(NUMBER, "specular", "Highlight", 0, 10, NULL, "raytrace.specular", "strength of the highlight"),
	SET(NUMBER, "reflectivity", "Reflectivity", 0, 1, NULL, "raytrace.mirror", "part of the light that the surface mirrors"),
	SET(NUMBER, "stripes", "Stripes", 0.1, 90, "deg", "raytrace.stripe-width", "angle that one stripe of the surroundings takes"),
	END };
const struct argument_row rows_grid_shade[] = { SET(SIZE, "grid", "Size", 1, 65536, "px", "shading.size", "width and height of the shaded image"), END };
const struct argument_row rows_grid_map[] = { SET(SIZE, "grid", "Grid", 1, 65536, NULL, "curvature.grid", "samples in u by samples in v"), END };
const struct argument_row rows_map[] = {
	{ .name = "range", .type = ARGUMENT_TEXT, .prompt = "Range", .def = "auto", .help = "values LO,HI at the ends of the key, or auto" },
	CHOICE("scale", "Scale", "auto", "linear|arsinh|auto", "how colors follow values; auto: arsinh where values crowd"),
	YESNO("symmetric", "Symmetric", "yes", "both ends as far from zero, of a quantity that has a sign"),
	END };
const struct argument_row rows_isophotes[] = {
	SET(INTEGER, "count", "Isophotes", 1, 1000, NULL, "isophotes.count", "how many angles"),
	SET(NUMBER, "from", "From", 0, 180, "deg", "isophotes.from", "first angle between normal and light"),
	SET(NUMBER, "to", "To", 0, 180, "deg", "isophotes.to", "last angle"),
	END };
const struct argument_row rows_reflection[] = {
	SET(INTEGER, "count", "Light lines", 1, 1000, NULL, "reflection.count", "how many light lines"),
	SET(NUMBER, "spacing", "Spacing", 1e-300, 1e300, "file", "reflection.spacing", "distance from one light line to the next"),
	SET(VECTOR, "point", "Point", 1, 0, "file", "reflection.point", "a point of the middle light line"),
	SET(VECTOR, "direction", "Direction", 1, 0, NULL, "reflection.direction", "direction of the light lines, any length"),
	SET(VECTOR, "across", "Across", 1, 0, NULL, "reflection.across", "direction from one line to the next, any length"),
	END };

#define AT(what) { .name = "index", .type = ARGUMENT_TEXT, .prompt = "Point", .help = what }
const struct argument_row rows_curve_edit[] = {
	AT("which control point, from 0"),
	MAY(VECTOR, "to", "To", "file", "where it goes; a curve on surface: U,V"),
	{ .name = "weight", .type = ARGUMENT_NUMBER, .prompt = "Weight", .min = 1e-9, .max = 1e9, .optional = true, .help = "its new weight" },
	END };
const struct argument_row rows_surface_edit[] = {
	AT("which control point, from 0: I,J, first along u"),
	MAY(VECTOR, "to", "To", "file", "where it goes"),
	{ .name = "weight", .type = ARGUMENT_NUMBER, .prompt = "Weight", .min = 1e-9, .max = 1e9, .optional = true, .help = "its new weight" },
	END };
#define ALONG CHOICE("along", "Along", "u", "u|v", "which parameter")
#define RAISE { .name = "order", .type = ARGUMENT_INTEGER, .prompt = "Order", .min = 2, .max = 26, .help = "the new order, degree + 1; not below the one there is" }
#define KNOTS TEXT("knots", "Knots", NULL, "parameters where knots go in, by comma")
#define PLACE { .name = "at", .type = ARGUMENT_NUMBER, .prompt = "At", .min = 1, .max = 0, .help = "parameter of the cut" }
const struct argument_row rows_elevate[] = { RAISE, END };
const struct argument_row rows_elevate_d[] = { ALONG, RAISE, END };
const struct argument_row rows_curve_insert[] = { KNOTS, END };
const struct argument_row rows_insert_d[] = { ALONG, KNOTS, END };
const struct argument_row rows_curve_split[] = { PLACE, END };
const struct argument_row rows_split_d[] = { ALONG, PLACE, END };
const struct argument_row rows_fit[] = {
	{ .name = "points", .type = ARGUMENT_POINTS, .prompt = "Points", .help = "X,Y,Z rows by semicolon, or the name of a point list that is open" },
	WHOLE("order", "Order", "4", 2, 26, "degree + 1"),
	CHOICE("parameters", "Parameters", "chord", "uniform|chord|centripetal", "how far apart the points are in the curve's parameter"),
	MAY(TEXT, "name", "Name", NULL, "of the new curve"),
	END };
const struct argument_row rows_ruled[] = {
	TEXT("curves", "Curves", NULL, "names of the two edges, by comma"),
	YESNO("reverse", "Reverse", "no", "turn the second one, if the surface would be twisted"),
	MAY(TEXT, "name", "Name", NULL, "of the new surface"),
	END };

#define WHAT MAY(THING, "name", "Name", NULL, "what to change; the current surface, else the current curve, where left out")
#define COPY YESNO("copy", "Copy", "no", "leave it as it is and change a copy")
const struct argument_row rows_mirror[] = {
	{ .name = "plane", .type = ARGUMENT_CHOICE, .prompt = "Plane", .choices = "x|y|z", .optional = true, .help = "plane x = 0, y = 0 or z = 0" },
	MAY(VECTOR, "point", "Point", "file", "a point of the plane"),
	MAY(VECTOR, "normal", "Normal", NULL, "direction across the plane, any length"),
	YESNO("copy", "Copy", "yes", "leave it as it is and mirror a copy"),
	WHAT, END };
const struct argument_row rows_move[] = {
	MAY(VECTOR, "by", "By", "file", "how far along x, y and z"),
	MAY(VECTOR, "from", "From", "file", "instead: a point"),
	MAY(VECTOR, "to", "To", "file", "and where that point goes"),
	COPY, WHAT, END };
const struct argument_row rows_rotate[] = {
	{ .name = "angle", .type = ARGUMENT_NUMBER, .prompt = "Angle", .min = -360, .max = 360, .unit = "deg", .help = "counterclockwise seen against the axis" },
	{ .name = "axis", .type = ARGUMENT_VECTOR, .prompt = "Axis", .def = "0,0,1", .help = "direction of the axis, any length" },
	{ .name = "point", .type = ARGUMENT_VECTOR, .prompt = "Point", .def = "0,0,0", .unit = "file", .help = "a point of the axis" },
	COPY, WHAT, END };
const struct argument_row rows_scale[] = {
	MAY(TEXT, "factor", "Factor", NULL, "one factor, or one each for x, y and z, by comma"),
	{ .name = "about", .type = ARGUMENT_VECTOR, .prompt = "About", .def = "0,0,0", .unit = "file", .help = "the point that stays" },
	{ .name = "unit", .type = ARGUMENT_CHOICE, .prompt = "Unit", .choices = "mm|cm|m|in|ft", .optional = true, .help = "instead: the unit it is to be in, from the unit of its file" },
	COPY, WHAT, END };

const struct argument_row rows_background[] = { KIND(COLOR, "color", "Color", NULL, "color of the background, as #101418"), END };
const struct argument_row rows_surface[] = { KIND(SURFACE, "surface", "Surface", NULL, "a surface that is open"), END };
const struct argument_row rows_curve[] = { KIND(CURVE, "curve", "Curve", NULL, "a curve that is open"), END };
const struct argument_row rows_jobs[] = { KIND(JOBS, "jobs", "Jobs", NULL, "numbers of jobs by comma, or all"), END };
const struct argument_row rows_bell[] = { YESNO("on", "Bell", "yes", "ring when a job ends"), END };
const struct argument_row rows_perspective[] = {
	REAL("field", "Field of view", "30", 1, 150, "deg", "angle across the smaller side of the view"),
	REAL("near", "Near", "0", 0, 1e300, "file", "what is nearer to the eye is cut away; 0: nothing"),
	REAL("far", "Far", "0", 0, 1e300, "file", "what is farther is cut away; 0: nothing"),
	YESNO("orthographic", "Orthographic", "no", "parallel rays, as if from far away"),
	END };
const struct argument_row rows_split_view[] = { CHOICE("views", "Views", "one", "one|side|child|uv", "one view; two from two sides; the parent and what was made from it; the surface and its u, v plane"), END };
/* clang-format on */
