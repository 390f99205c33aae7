/* shaders.c - the programs of the view in GLSL 3.30. */
#include "program.h"

/* Attributes: 0 position from the thing's origin, 1 normal, 2 u and v from 0 to 1 over the domain. */
static const char surface_vertex[] = "#version 330 core\n"
                                     "layout(location = 0) in vec3 position;\n"
                                     "layout(location = 1) in vec3 normal;\n"
                                     "layout(location = 2) in vec2 parameter;\n"
                                     "uniform mat4 matrix;\n"
                                     "uniform float bias;\n"
                                     "out vec3 place, across;\n"
                                     "out vec2 uv;\n"
                                     "void main()\n"
                                     "{\n"
                                     "	place = position;\n"
                                     "	across = normal;\n"
                                     "	uv = parameter;\n"
                                     "	gl_Position = matrix * vec4(position, 1.0);\n"
                                     "	gl_Position.z += bias * gl_Position.w;\n"
                                     "}\n";

/*
 * Light as in the shading worker's pictures, and some from the viewer's shoulder (fill), so that what
 * lies in the light's shade is read too.
 * eye: position of the eye, or direction towards it (w = 0).
 */
#define LIGHTING                                                                                   \
	"uniform vec4 eye, color;\n"                                                               \
	"uniform vec3 light, fill, sky;\n"                                                         \
	"uniform vec4 strength;\n" /* ambient, diffuse, highlight, its sharpness */                \
	"vec3 srgb(vec3 l)\n"                                                                      \
	"{\n"                                                                                      \
	"	l = clamp(l, 0.0, 1.0);\n"                                                               \
	"	return mix(12.92 * l, 1.055 * pow(l, vec3(1.0 / 2.4)) - 0.055,\n"                        \
	"	           step(0.0031308, l));\n"                                                       \
	"}\n"                                                                                      \
	"vec3 seen_from(vec3 place)\n"                                                             \
	"{\n"                                                                                      \
	"	return normalize(eye.xyz - eye.w * place);\n"                                            \
	"}\n"                                                                                      \
	"vec3 lit(vec3 color, vec3 n, vec3 to_eye)\n" /* n: towards the eye */                     \
	"{\n"                                                                                      \
	"	float facing = dot(n, to_eye);\n"                                                        \
	"	float scattered = strength.x * (0.7 + 0.3 * dot(n, sky)) *\n"                            \
	"	                  (0.75 + 0.25 * facing);\n"                                             \
	"	scattered += 0.4 * max(dot(n, fill), 0.0);\n"                                            \
	"	float slope = dot(n, light), shine = 0.0;\n"                                             \
	"	if (slope > 0.0) {\n"                                                                    \
	"		float half_way = max(dot(n, normalize(light + to_eye)), 0.0);\n"                        \
	"		scattered += strength.y * slope;\n"                                                     \
	"		shine = strength.z * pow(half_way, strength.w);\n"                                      \
	"	}\n"                                                                                     \
	"	return srgb(color * scattered + shine);\n"                                               \
	"}\n"

/*
 * look: 0 lit color, 1 map of values. The values of a map stand at the corners of its cells, the last
 * row of the texture being the first v; between them is their mean, but where one is missing the nearest.
 */
static const char surface_fragment[] =
        "#version 330 core\n"
        "in vec3 place, across;\n"
        "in vec2 uv;\n"
        "uniform vec4 nothing;\n"
        "uniform vec3 below, above;\n"
        "uniform int look;\n"
        "uniform sampler2D values, colors;\n"
        "uniform vec4 range;\n" /* lo, hi after compression, knee or 0, place of zero or -1 */
        "uniform ivec2 grid;\n"
        "uniform float scale;\n" /* device pixels a logical pixel */
        "out vec4 result;\n" LIGHTING "float value_at(ivec2 at)\n"
        "{\n"
        "	return texelFetch(values, ivec2(at.x, grid.y - 1 - at.y), 0).r;\n"
        "}\n"
        "float value()\n"
        "{\n"
        "	vec2 at = clamp(uv, 0.0, 1.0) * vec2(grid - 1);\n"
        "	ivec2 low = ivec2(min(floor(at), vec2(max(grid - 2, 0))));\n"
        "	vec2 share = at - vec2(low);\n"
        "	ivec2 high = min(low + 1, grid - 1);\n"
        "	vec4 corner = vec4(value_at(low), value_at(ivec2(high.x, low.y)),\n"
        "	                   value_at(ivec2(low.x, high.y)), value_at(high));\n"
        "	if (any(isnan(corner)))\n"
        "		return value_at(ivec2(at + 0.5));\n"
        "	return mix(mix(corner.x, corner.y, share.x), mix(corner.z, corner.w, share.x),\n"
        "	           share.y);\n"
        "}\n"
        "vec3 mapped(float x)\n"
        "{\n"
        "	if (isnan(x) || isinf(x)) {\n"
        "		vec2 at = floor(gl_FragCoord.xy / scale);\n"
        "		return nothing.rgb * (mod(at.x + at.y, 6.0) < 2.0 ? 0.8 : 1.0);\n"
        "	}\n"
        "	float y = range.z > 0.0 ? asinh(x / range.z) : x;\n"
        "	float t = (y - range.x) / (range.y - range.x);\n"
        "	if (t < 0.0)\n"
        "		return below;\n"
        "	if (t > 1.0)\n"
        "		return above;\n"
        "	return texture(colors, vec2((t * 511.0 + 0.5) / 512.0, 0.5)).rgb;\n"
        "}\n"
        "void main()\n"
        "{\n"
        "	vec3 n = normalize(across);\n"
        "	vec3 to_eye = seen_from(place);\n"
        "	if (dot(n, to_eye) < 0.0)\n"
        "		n = -n;\n"
        "	if (look == 1) {\n"
        "		float rim = 1.0 - dot(n, to_eye);\n"
        "		result = vec4(mapped(value()) * (1.0 - 0.14 * rim * rim), 1.0);\n"
        "		return;\n"
        "	}\n"
        "	result = vec4(lit(color.rgb, n, to_eye), color.a);\n"
        "}\n";

/* The same where triangles are as small as pixels: lit at their corners. */
static const char quick_vertex[] = "#version 330 core\n"
                                   "layout(location = 0) in vec3 position;\n"
                                   "layout(location = 1) in vec3 normal;\n"
                                   "layout(location = 3) in vec3 tint;\n"
                                   "uniform mat4 matrix;\n"
                                   "uniform float bias;\n"
                                   "noperspective out vec3 shade;\n" LIGHTING "void main()\n"
                                   "{\n"
                                   "	vec3 to_eye = seen_from(position);\n"
                                   "	vec3 n = dot(normal, to_eye) < 0.0 ? -normal : normal;\n"
                                   "	shade = lit(tint, n, to_eye);\n"
                                   "	gl_Position = matrix * vec4(position, 1.0);\n"
                                   "	gl_Position.z += bias * gl_Position.w;\n"
                                   "}\n";

static const char quick_fragment[] = "#version 330 core\n"
                                     "noperspective in vec3 shade;\n"
                                     "out vec4 result;\n"
                                     "void main()\n"
                                     "{\n"
                                     "	result = vec4(shade, 1.0);\n"
                                     "}\n";

/* What wide lines and ribbons are placed with. before_eye: p, moved towards q until it is before the eye. */
#define LINE_FUNCTIONS                                                                             \
	"vec4 before_eye(vec4 p, vec4 q)\n"                                                        \
	"{\n"                                                                                      \
	"	float low = 1e-6 * abs(q.w);\n"                                                          \
	"	return p.w > low ? p : mix(p, q, (low - p.w) / (q.w - p.w));\n"                          \
	"}\n"                                                                                      \
	"vec2 pixel(vec4 p)\n"                                                                     \
	"{\n"                                                                                      \
	"	return 0.5 * viewport * p.xy / p.w;\n"                                                   \
	"}\n"                                                                                      \
	"vec2 direction(vec2 d, vec2 otherwise)\n"                                                 \
	"{\n"                                                                                      \
	"	float l = length(d);\n"                                                                  \
	"	return l > 1e-4 ? d / l : otherwise;\n"                                                  \
	"}\n"

/*
 * A piece of a polyline is one instance, a quadrilateral of four corners: attributes 0 to 3 are the
 * vertex before it, its two, and the one behind; w < 0 marks a vertex that only keeps polylines
 * apart. Neighbours meet at a mitre, so that translucent lines have no spots. Attributes 4 and 5:
 * length in pixels from the beginning of the polyline, for dashes.
 */
static const char line_vertex[] =
        "#version 330 core\n"
        "layout(location = 0) in vec4 before;\n"
        "layout(location = 1) in vec4 from;\n"
        "layout(location = 2) in vec4 to;\n"
        "layout(location = 3) in vec4 behind;\n"
        "layout(location = 4) in float from_length;\n"
        "layout(location = 5) in float to_length;\n"
        "uniform mat4 matrix;\n"
        "uniform vec2 viewport;\n"
        "uniform float width, bias;\n"
        "noperspective out vec2 at;\n" /* along the piece and across it, px */
        "noperspective out float along;\n"
        "flat out float piece;\n"
        "flat out vec2 capped;\n" LINE_FUNCTIONS "void main()\n"
        "{\n"
        "	vec4 a = matrix * vec4(from.xyz, 1.0), b = matrix * vec4(to.xyz, 1.0);\n"
        "	gl_Position = vec4(2.0, 2.0, 2.0, 1.0);\n"
        "	at = vec2(0.0);\n"
        "	along = piece = 0.0;\n"
        "	capped = vec2(0.0);\n"
        "	if (from.w < 0.0 || to.w < 0.0 || (a.w <= 0.0 && b.w <= 0.0))\n"
        "		return;\n"
        "	vec4 p = before_eye(a, b), q = before_eye(b, a);\n"
        "	vec2 s = pixel(p), t = pixel(q), d = direction(t - s, vec2(1.0, 0.0));\n"
        "	vec4 x = matrix * vec4(before.xyz, 1.0), y = matrix * vec4(behind.xyz, 1.0);\n"
        "	bool joined_before = before.w >= 0.0 && x.w > 0.0 && a.w > 0.0;\n"
        "	bool joined_behind = behind.w >= 0.0 && y.w > 0.0 && b.w > 0.0;\n"
        "	bool last = gl_VertexID >= 2;\n"
        "	float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;\n"
        "	float half_width = 0.5 * width + 0.5;\n"
        "	vec2 across = vec2(-d.y, d.x), offset;\n"
        "	bool joined = last ? joined_behind : joined_before;\n"
        "	capped = vec2(joined_before ? 0.0 : 1.0, joined_behind ? 0.0 : 1.0);\n"
        "	piece = length(t - s);\n"
        "	offset = side * half_width * across;\n"
        "	if (joined) {\n"
        "		vec2 e = last ? direction(pixel(y) - t, d) : direction(s - pixel(x), d);\n"
        "		vec2 mitre = direction(d + e, d), n = vec2(-mitre.y, mitre.x);\n"
        "		float c = dot(n, across);\n"
        "		if (c > 0.5)\n"
        "			offset = side * half_width / c * n;\n"
        "		else\n"
        "			offset += (last ? 0.5 : -0.5) * width * d;\n"
        "	} else {\n"
        "		offset += (last ? 1.0 : -1.0) * half_width * d;\n"
        "	}\n"
        "	vec4 end = last ? q : p;\n"
        "	at = vec2((last ? piece : 0.0) + dot(offset, d), side * half_width);\n"
        "	along = last ? to_length : from_length;\n"
        "	vec2 out_at = (last ? t : s) + offset;\n"
        "	gl_Position = vec4(out_at * 2.0 / viewport, end.z / end.w - bias, 1.0);\n"
        "}\n";

static const char line_fragment[] =
        "#version 330 core\n"
        "noperspective in vec2 at;\n"
        "noperspective in float along;\n"
        "flat in float piece;\n"
        "flat in vec2 capped;\n"
        "uniform vec4 color;\n"
        "uniform float width;\n"
        "uniform vec2 dash;\n" /* on and off, px; off = 0: solid */
        "out vec4 result;\n"
        "void main()\n"
        "{\n"
        "	float away = abs(at.y);\n"
        "	if (capped.x > 0.0 && at.x < 0.0)\n"
        "		away = length(at);\n"
        "	if (capped.y > 0.0 && at.x > piece)\n"
        "		away = length(vec2(at.x - piece, at.y));\n"
        "	float shown = clamp(0.5 * width + 0.5 - away, 0.0, 1.0) * min(width, 1.0);\n"
        "	if (width > 1.0)\n"
        "		shown = clamp(0.5 * width + 0.5 - away, 0.0, 1.0);\n"
        "	if (dash.y > 0.0) {\n"
        "		float place = mod(along, dash.x + dash.y);\n"
        "		float outside = max(-place, place - dash.x);\n"
        "		outside = min(outside, dash.x + dash.y - place);\n"
        "		shown *= clamp(0.5 - outside, 0.0, 1.0);\n"
        "	}\n"
        "	if (shown <= 0.0)\n"
        "		discard;\n"
        "	result = vec4(color.rgb, color.a * shown);\n"
        "}\n";

/*
 * Lines while something is dragged: solid, and neighbours share the corners between them. The vertices
 * of a polyline stand twice, for its left and its right. Ends are cut off straight.
 */
static const char ribbon_vertex[] =
        "#version 330 core\n"
        "layout(location = 0) in vec3 before;\n"
        "layout(location = 1) in vec3 place;\n"
        "layout(location = 2) in vec3 behind;\n"
        "uniform mat4 matrix;\n"
        "uniform vec2 viewport;\n"
        "uniform float width, bias;\n"
        "noperspective out float across;\n" LINE_FUNCTIONS "void main()\n"
        "{\n"
        "	vec4 x = matrix * vec4(before, 1.0), y = matrix * vec4(behind, 1.0);\n"
        "	gl_Position = matrix * vec4(place, 1.0);\n"
        "	vec4 a = before_eye(gl_Position, y.w > x.w ? y : x);\n"
        "	vec2 p = pixel(a);\n"
        "	vec2 come = direction(p - pixel(before_eye(x, a)), vec2(0.0));\n"
        "	vec2 go = direction(pixel(before_eye(y, a)) - p, come);\n"
        "	vec2 mitre = direction(come + go, go);\n"
        "	vec2 normal = vec2(-mitre.y, mitre.x);\n"
        "	float side = (gl_VertexID & 1) == 0 ? -0.5 : 0.5;\n"
        "	across = side * (width + 1.0);\n"
        "	vec2 offset = across / max(dot(mitre, go), 0.5) * normal;\n"
        "	gl_Position.xy += offset * 2.0 / viewport * gl_Position.w;\n"
        "	gl_Position.z -= bias * gl_Position.w;\n"
        "}\n";

static const char ribbon_fragment[] =
        "#version 330 core\n"
        "noperspective in float across;\n"
        "uniform vec4 color;\n"
        "uniform float width;\n"
        "out vec4 result;\n"
        "void main()\n"
        "{\n"
        "	float shown = clamp(0.5 * width + 0.5 - abs(across), 0.0, 1.0);\n"
        "	result = vec4(color.rgb, color.a * shown * min(width, 1.0));\n"
        "}\n";

/* Squares and discs of a size in pixels at points in space. */
static const char sprite_vertex[] =
        "#version 330 core\n"
        "layout(location = 0) in vec4 point;\n"
        "uniform mat4 matrix;\n"
        "uniform vec2 viewport;\n"
        "uniform float size, bias;\n"
        "noperspective out vec2 at;\n"
        "void main()\n"
        "{\n"
        "	vec4 p = matrix * vec4(point.xyz, 1.0);\n"
        "	vec2 corner = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0,\n"
        "	                   gl_VertexID < 2 ? -1.0 : 1.0);\n"
        "	at = corner * (0.5 * size + 1.0);\n"
        "	gl_Position = vec4(2.0, 2.0, 2.0, 1.0);\n"
        "	if (point.w >= 0.0 && p.w > 0.0) {\n"
        "		/* middles stand on middles of pixels, so that squares are sharp */\n"
        "		vec2 middle = floor((p.xy / p.w * 0.5 + 0.5) * viewport) + 0.5;\n"
        "		gl_Position = vec4((middle + at) * 2.0 / viewport - 1.0,\n"
        "		                   p.z / p.w - bias, 1.0);\n"
        "	}\n"
        "}\n";

/* shape: 0 square, 1 disc. */
static const char sprite_fragment[] =
        "#version 330 core\n"
        "noperspective in vec2 at;\n"
        "uniform vec4 color, stroke;\n"
        "uniform float size, width;\n"
        "uniform int shape;\n"
        "out vec4 result;\n"
        "void main()\n"
        "{\n"
        "	float away = shape == 0 ? max(abs(at.x), abs(at.y)) : length(at);\n"
        "	float shown = clamp(0.5 * size + 0.5 - away, 0.0, 1.0);\n"
        "	float inner = clamp(0.5 * size - width + 0.5 - away, 0.0, 1.0);\n"
        "	if (shown <= 0.0)\n"
        "		discard;\n"
        "	result = mix(stroke, color, inner);\n"
        "	result.a *= shown;\n"
        "}\n";

/* A picture with its colors multiplied by alpha, in a rectangle of the image: x, y, width, height in
 * px, from the upper left corner. */
static const char plate_vertex[] =
        "#version 330 core\n"
        "uniform vec4 place;\n"
        "uniform vec2 viewport;\n"
        "out vec2 at;\n"
        "void main()\n"
        "{\n"
        "	at = vec2((gl_VertexID & 1) == 0 ? 0.0 : 1.0, gl_VertexID < 2 ? 0.0 : 1.0);\n"
        "	vec2 p = (place.xy + at * place.zw) / viewport * 2.0 - 1.0;\n"
        "	gl_Position = vec4(p.x, -p.y, -1.0, 1.0);\n"
        "}\n";

static const char plate_fragment[] = "#version 330 core\n"
                                     "in vec2 at;\n"
                                     "uniform sampler2D picture;\n"
                                     "out vec4 result;\n"
                                     "void main()\n"
                                     "{\n"
                                     "	result = texture(picture, at);\n"
                                     "}\n";

const char *const shader_source[N_PROGRAMS][2] = {
	[PROGRAM_SURFACE] = { surface_vertex, surface_fragment },
	[PROGRAM_QUICK] = { quick_vertex, quick_fragment },
	[PROGRAM_LINE] = { line_vertex, line_fragment },
	[PROGRAM_RIBBON] = { ribbon_vertex, ribbon_fragment },
	[PROGRAM_SPRITE] = { sprite_vertex, sprite_fragment },
	[PROGRAM_PLATE] = { plate_vertex, plate_fragment },
};
