"""Pictures of the program's own examples beside those kept in pictures/: test_pictures.py --renew makes these anew.

Drivers and versions of fonts differ in a few pixels; what a picture shows does not.
"""
import os
import struct
import sys
import zlib

import end

KEPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "pictures")
APART, SHARE = 32, 0.01  # of 255 in a channel; of all pixels so far apart
SIZE = ["--size", "240x160", "--scale", "0.5"]


def example(name):
    return os.path.join(end.EXAMPLES, name)


# name: files, what is computed first, how it is drawn
PICTURES = {
    "wire-dark": (["hull.igs"], None, ["--look", "wire", "--theme", "dark"]),
    "wire-light": (["hull.igs"], None, ["--look", "wire"]),
    "shaded-dark": (["propeller.igs"], None, ["--theme", "dark", "--view", "40,30:perspective"]),
    "shaded-light": (["teapot.igs"], None, []),
    "curvature": (["hull.igs"], None, ["--quantity", "H", "--theme", "dark"]),
    "absolute": (["torus.igs"], None, ["--quantity", "kabs", "--view", "30,50"]),
    "isophotes": (["hull.igs#1"],
                  ["batten-isophotes", "hull.igs#1", "--from", "20", "--to", "140", "--count", "7", "-o", "x"],
                  ["--lines", "x.isophote"]),
    "image": (["sphere.igs"],
              ["batten-shading", "sphere.igs", "--size", "120x80", "-o", "x"],
              ["--image", "x.shade.exr", "--theme", "dark"]),
    "split-side": (["hull.igs"], None, ["--split", "side", "--beside", "right", "--theme", "dark"]),
    "split-uv": (["hull.igs#1"], None, ["--split", "uv", "--look", "shaded"]),
    "split-curvatures": (["torus.igs"], None, ["--split", "curvatures", "--view", "30,50",
                         "--size", "480x240", "--scale", "0.5"]),
}


def pixels(data):
    """Width, height and the rows of RGB of a picture of eight bits, as batten writes them."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and color in (2, 6) and not interlaced, (depth, color)
            wide = 3 if color == 2 else 4
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    raw, rows, before = zlib.decompress(packed), [], bytearray(width * wide)
    for y in range(height):
        start = y * (1 + width * wide)
        way, row = raw[start], bytearray(raw[start + 1:start + 1 + width * wide])
        for i, x in enumerate(row):
            left, above = row[i - wide] if i >= wide else 0, before[i]
            corner = before[i - wide] if i >= wide else 0
            guess = left + above - corner
            near = min((abs(guess - p), k, p) for k, p in enumerate((left, above, corner)))[2]
            row[i] = (x + (0, left, above, (left + above) // 2, near)[way]) & 255
        rows.append([tuple(row[i:i + 3]) for i in range(0, len(row), wide)])
        before = row
    return width, height, rows


def draw(project, name):
    files, first, options = PICTURES[name]
    project.environment.pop("DISPLAY", None)
    project.environment.pop("WAYLAND_DISPLAY", None)
    project.environment["LIBGL_ALWAYS_SOFTWARE"] = "1"
    project.environment["ASAN_OPTIONS"] = "detect_leaks=0:" + os.environ.get("ASAN_OPTIONS", "")
    if first:
        project.run(*[example(a) if a.split("#")[0].endswith(".igs") else a for a in first])
    done = project.run("batten", "render", *[example(f) for f in files], *options,
                       *([] if "--size" in options else SIZE), "-o", "now.png",
                       status=None)
    if "cannot draw without a window" in done.stderr:
        raise end.Skip(done.stderr.strip())
    assert done.returncode == 0, done.stderr
    with open(project.path("now.png"), "rb") as f:
        return f.read()


def apart(a, b):
    """The share of pixels that are far apart."""
    (wide, high, now), (*size, kept) = pixels(a), pixels(b)
    if [wide, high] != size:
        return 1.0
    far = sum(max(abs(p - q) for p, q in zip(x, y)) > APART
              for row, other in zip(now, kept) for x, y in zip(row, other))
    return far / (wide * high)


def kept(name):
    with open(os.path.join(KEPT, name + ".png"), "rb") as f:
        return f.read()


def test_pictures_are_as_kept(project):
    for name in PICTURES:
        share = apart(draw(project, name), kept(name))
        assert share <= SHARE, f"{name}: {100 * share:.1f} % of the pixels differ from {KEPT}/{name}.png"


def test_another_picture_is_told_apart(project):
    del project
    names = list(PICTURES)
    for name, other in zip(names, names[1:] + names[:1]):
        assert apart(kept(name), kept(other)) > 4 * SHARE, (name, other)


def renew():
    os.makedirs(KEPT, exist_ok=True)
    for name in PICTURES:
        project = end.Project()
        try:
            data = draw(project, name)
        finally:
            project.close()
        with open(os.path.join(KEPT, name + ".png"), "wb") as f:
            f.write(data)


if __name__ == "__main__":
    if "--renew" in sys.argv:
        renew()
    else:
        end.main()
