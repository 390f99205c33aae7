"""`batten render`: pictures without a display; whole or not at all."""
import os
import re
import struct

import end

HULL = os.path.join(end.EXAMPLES, "hull.igs")


def render(project, *arguments, status=0):
    project.environment.pop("DISPLAY", None)
    project.environment.pop("WAYLAND_DISPLAY", None)
    project.environment["LIBGL_ALWAYS_SOFTWARE"] = "1"
    # Mesa unloads its driver before leaks are looked for, so the driver's own cannot be told by their
    # names any more; the view's own are looked for in its unit test
    project.environment["ASAN_OPTIONS"] = "detect_leaks=0:" + os.environ.get("ASAN_OPTIONS", "")
    done = project.run("batten", "render", *arguments, status=None)
    if "cannot draw without a window" in done.stderr:
        raise end.Skip(done.stderr.strip())
    assert done.returncode == status, f"{arguments}: {done.returncode}, {done.stderr}"
    return done


def content(project, name):
    with open(project.path(name), "rb") as f:
        return f.read()


def test_pictures_of_every_look(project):
    seen = set()
    for look in (["--look", "wire"], ["--look", "shaded"], ["--quantity", "H"], ["--theme", "dark"],
                 ["--view", "top:perspective"], ["--background", "#336699"], ["--scale", "1.5"]):
        render(project, HULL, "--size", "320x200", "-o", "a.png", *look)
        picture = content(project, "a.png")
        assert picture[:8] == b"\x89PNG\r\n\x1a\n"
        assert struct.unpack(">II", picture[16:24]) == (320, 200), look
        seen.add(picture)
    assert len(seen) == 7


def test_same_bytes_again(project):
    for name in ("a.png", "a.svg", "a.pdf"):
        render(project, HULL, "--size", "300x200", "-o", name)
        before = content(project, name)
        render(project, HULL, "--size", "300x200", "-o", name)
        assert before == content(project, name), name
    assert b"<svg" in content(project, "a.svg")[:100]
    assert content(project, "a.pdf")[:5] == b"%PDF-"


def test_views_beside_each_other(project):
    """The halves of a split picture are the pictures of each alone but for their rule and their headings."""
    seen = set()
    for split in ("one", "side", "uv", "curvatures"):
        for name in ("a.png", "a.svg", "a.pdf"):
            render(project, HULL, "--size", "300x200", "--split", split, "-o", name)
            before = content(project, name)
            render(project, HULL, "--size", "300x200", "--split", split, "-o", name)
            assert before == content(project, name), (split, name)
        seen.add(content(project, "a.png"))
        svg = content(project, "a.svg").decode()
        # maps are no lines: seven of them are one view
        assert svg.count("<svg") == (3 if split in ("side", "uv") else 1), (split, svg.count("<svg"))
        assert ("Parameter plane of hull-1" in svg) == (split == "uv"), split
    assert len(seen) == 4
    render(project, HULL, "--size", "300x200", "--split", "side", "--beside", "left", "-o", "a.png")
    assert content(project, "a.png") not in seen


def test_lines_of_a_result(project):
    render(project, HULL + "#1", "--size", "300x200", "-o", "without.png")
    project.run("batten-isophotes", HULL + "#1", "--from", "20", "--to", "140", "--count", "7", "-o", "hull")
    render(project, HULL + "#1", "--size", "300x200", "--lines", "hull.isophote", "-o", "with.png")
    assert content(project, "with.png") != content(project, "without.png")
    render(project, HULL + "#1", "--size", "300x200", "--lines", "hull.isophote", "-o", "with.svg")
    labels = re.findall(r">(\d+)\u00b0<", content(project, "with.svg").decode())
    assert labels and set(labels) <= {"60", "120"}, labels  # every third


def test_failures_leave_nothing(project):
    for status, said, arguments in (
            (2, "a picture is .png", [HULL, "-o", "a.jpg"]),
            (2, "expected wire, shaded or map", [HULL, "-o", "a.png", "--look", "x-ray"]),
            (2, "expected K, H", [HULL, "-o", "a.png", "--quantity", "J"]),
            (2, "expected three-quarter", [HULL, "-o", "a.png", "--view", "sideways"]),
            (2, "expected one, side, uv", [HULL, "-o", "a.png", "--split", "child"]),
            (2, "expected three-quarter", [HULL, "-o", "a.png", "--split", "side", "--beside", "sideways"]),
            (2, "expected WxH", [HULL, "-o", "a.png", "--size", "10"]),
            (2, "name what to draw", ["-o", "a.png"]),
            (2, "name what to draw", [HULL]),
            (1, "no such file", [HULL, "-o", "a.png", "--lines", "none.isophote"]),
            (1, "none.igs", ["none.igs", "-o", "a.png"]),
            (1, "nowhere", [HULL, "-o", "nowhere/a.png"])):
        done = render(project, *arguments, status=status)
        assert said in done.stderr, f"{arguments}: {done.stderr}"
        assert not [x for x in os.listdir(project.folder) if x.startswith("a.")], arguments


end.main()
