"""`batten export`: what is written is read again the same."""
import math
import os
import signal
import subprocess

import end
from iges_text import iges

SHAPES = "sphere torus wigley hull naca propeller teapot".split()


def example(name, extension=".base"):
    return os.path.join(end.EXAMPLES, name + extension)


def near(a, b, scale, tolerance, what):
    for x, y in zip(a, b):
        assert abs(x - y) <= tolerance * scale, f"{what}: {a} {b}"


def samples(entity):
    (u0, u1), (v0, v1) = entity["domain"]
    steps = (0, 0.13, 0.5, 0.77, 1)
    return "\n".join(f"{u0 + (u1 - u0) * i!r} {v0 + (v1 - v0) * j!r}" for i in steps for j in steps)


def test_base_comes_back_to_the_bit(project):
    for name in SHAPES:
        project.run("batten", "export", example(name), "--to", "out.base")
        with open(example(name), "rb") as a, open(project.path("out.base"), "rb") as b:
            assert a.read() == b.read(), name


def test_iges_and_g2_hold_the_same_shape(project):
    for name in SHAPES:
        before = project.json("batten", "info", example(name))["entities"]
        size = max(math.dist(*e["box"]) for e in before)
        for file in ("out.igs", "out.g2"):
            told = project.json("batten", "export", example(name), "--to", file)
            assert told["entities"] == len(before) and told["triangles"] is None, told
            after = project.json("batten", "info", file)["entities"]
            assert [e["kind"] for e in after] == [e["kind"] for e in before]
            for a, b in zip(before, after):
                what = f"{name} {a['number']} {file}"
                assert a["order"] == b["order"] and a["points"] == b["points"], what
                assert a["domain"] == b["domain"], what
                if a["kind"] != "surface":
                    continue
                points = [project.json("batten", "eval", f"{path}#{a['number']}", "-", stdin=samples(a))["points"]
                          for path in (example(name), file)]
                for p, q in zip(*points):
                    near(p["point"], q["point"], size, 1e-15, what)


SQUARE = ("128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,"
          "0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.;")
TRIMMED = {
    "hole": (1 - 0.16 * math.pi, [
        (144, 0, "144,3,0,1,0,5;"), (128, 0, SQUARE), (142, 0, "142,0,3,7,0,1;"),
        (100, 0, "100,0.,.5,.5,.9,.5,.9,.5;")]),
    "ring": (0.15 * math.pi, [
        (144, 0, "144,3,1,1,5,7;"), (128, 0, SQUARE), (142, 0, "142,0,3,9,0,1;"), (142, 0, "142,0,3,11,0,1;"),
        (100, 0, "100,0.,.5,.5,.9,.5,.9,.5;"), (100, 0, "100,0.,.5,.5,.6,.5,.6,.5;")]),
    "two regions": (0.02 * math.pi, [
        (143, 0, "143,0,3,2,5,7;"), (128, 0, SQUARE), (141, 0, "141,0,0,3,1,9,1,0;"), (141, 0, "141,0,0,3,1,11,1,0;"),
        (100, 0, "100,0.,.3,.3,.4,.3,.4,.3;"), (100, 0, "100,0.,.7,.7,.8,.7,.8,.7;")]),
    "cylinder": (0.72 * math.pi, [
        (144, 0, "144,3,1,0,5;"), (120, 0, "120,9,11,0.,3.141592653589793;"), (142, 0, "142,0,3,7,0,1;"),
        (100, 0, "100,0.,.5,1.5707963267948966,.8,1.5707963267948966,.8,1.5707963267948966;"),
        (110, 0, "110,0.,0.,0.,0.,0.,1.;"), (110, 0, "110,2.,0.,0.,2.,0.,4.;")]),
    "over the seam": (0.4 * math.pi, [
        (143, 0, "143,1,3,1,5;"), (122, 0, "122,9,1.,0.,2.;"), (141, 0, "141,1,2,3,1,0,1,1,7;"),
        (106, 63, "106,1,5,0.,.9,.25,1.1,.25,1.1,.75,.9,.75,.9,.25;"), (100, 0, "100,0.,0.,0.,1.,0.,1.,0.;")]),
}


def areas(project, file):
    return [e["area"] for e in project.json("batten", "info", file)["entities"] if e["kind"] == "surface"]


def occt_areas(project, file):
    lines = project.run(os.environ["BATTEN_OCCT_READ"], project.path(file)).stdout.split("\n")
    found = [float(x) for x in lines[1:] if x]
    assert lines[0] == f"faces {len(found)}", lines
    return found


def test_trims_come_back(project):
    for name, (area, entities) in TRIMMED.items():
        with open(project.path("in.igs"), "w") as f:
            f.write(iges(entities))
        project.run("batten", "export", "in.igs", "--to", "out.igs")
        for file in ("in.igs", "out.igs"):
            found = sum(areas(project, file))
            assert abs(found - area) <= 1e-5 * area, f"{name} {file}: {found}, expected {area}"


def test_open_cascade_reads_the_same_faces(project):
    if not os.environ.get("BATTEN_OCCT_READ"):
        raise end.Skip("Open CASCADE is not installed")
    for name, (area, entities) in TRIMMED.items():
        with open(project.path("in.igs"), "w") as f:
            f.write(iges(entities))
        project.run("batten", "export", "in.igs", "--to", "out.igs")
        found = occt_areas(project, "out.igs")
        # one for each outer loop; a face over the seam is cut there
        assert len(found) == (2 if name in ("two regions", "over the seam") else 1), (name, found)
        assert abs(sum(found) - area) <= 1e-5 * area, f"{name}: {found}, expected {area}"
    data = os.environ.get("BATTEN_DATA")
    for name in ("naca_wing.iges", "hammer.iges", "torus_nurbs.igs", "d150_wing.igs") if data else ():
        project.run("batten", "export", os.path.join(data, name), "--to", "out.igs")
        mine, theirs = areas(project, "out.igs"), occt_areas(project, "out.igs")
        assert len(mine) == len(theirs), f"{name}: {len(mine)} faces, Open CASCADE has {len(theirs)}"
        scale = project.json("batten", "info", "out.igs")["unit_in_mm"] ** 2
        assert abs(sum(mine) * scale - sum(theirs)) <= 1e-4 * sum(theirs), (name, sum(mine) * scale, sum(theirs))


def test_trims_may_be_left_out(project):
    with open(project.path("ring.igs"), "w") as f:
        f.write(iges(TRIMMED["ring"][1]))
    assert "1 trimmed surface" in project.run("batten", "export", "ring.igs", "--to", "ring.g2").stderr
    pictures = {}
    for name, words in (("as-is", []), ("yes", ["--trimmed", "yes"]), ("no", ["--trimmed", "no"]), ("equals", ["--trimmed=no"])):
        project.run("batten", "run", "shading", "ring.igs", *words, "--size", "64x48", "--output", name)
        with open(project.path(name + ".shade.exr"), "rb") as f:
            pictures[name] = f.read()
    assert pictures["as-is"] == pictures["yes"] and pictures["no"] == pictures["equals"]
    assert pictures["yes"] != pictures["no"]


def test_an_import_interrupted_leaves_whole_files(project):
    count = 3000
    with open(project.path("many.igs"), "w") as f:
        f.write(iges([(128, 0, SQUARE)] * count))
    importing = project.start("batten", "import", "many.igs", "--into", "into", stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE)
    first = importing.stdout.readline()
    importing.send_signal(signal.SIGINT)
    rest, said = importing.stdout.read(), importing.stderr.read()
    importing.wait(timeout=60)
    named = [first.strip()] + rest.split()
    assert importing.returncode == 130 and "cancelled" in said, (importing.returncode, said)
    there = sorted(os.path.join("into", x) for x in os.listdir(project.path("into")))
    assert sorted(named) == there, (len(named), len(there))
    assert len(named) < count
    for file in (named[0], named[-1]):
        assert abs(sum(areas(project, file)) - 1) < 1e-12


def test_same_input_same_bytes(project):
    for file in ("a.obj", "a.ply", "a.stl", "a.g2", "a.igs", "a.base"):
        bytes_of = []
        for _ in range(2):
            project.run("batten", "export", example("propeller"), "--to", file)
            with open(project.path(file), "rb") as f:
                bytes_of.append(f.read())
        assert bytes_of[0] == bytes_of[1], file


def test_points_in_columns(project):
    with open(project.path("in.csv"), "w") as f:
        f.write("# measured\r\nx;y;z\r\n1.5;-2D0;0.1\r\n4;5;6\r\n")
    info = project.json("batten", "info", "in.csv")["entities"]
    assert [(e["kind"], e["points"], e["box"]) for e in info] == [("points", [2], [[1.5, -2, 0.1], [4, 5, 6]])]
    project.run("batten", "export", "in.csv", "--to", "out.csv")
    with open(project.path("out.csv")) as f:
        assert f.read() == "x,y,z\n1.5,-2,0.1\n4,5,6\n"
    project.run("batten", "import", "in.csv")
    project.run("batten", "export", "in.base", "in.csv", "--to", "both.g2")
    assert [e["kind"] for e in project.json("batten", "info", "both.g2")["entities"]] == ["points", "points"]


def test_parts_and_several_files(project):
    told = project.json("batten", "export", example("hull") + "#2", example("hull") + "#1", "--to", "two.base")
    assert told["entities"] == 2
    whole = project.json("batten", "info", example("hull"))["entities"]
    two = project.json("batten", "info", "two.base")["entities"]
    assert [e["box"] for e in two] == [whole[1]["box"], whole[0]["box"]]


def test_what_is_wrong_is_said(project):
    for arguments in ([], [example("torus")], ["--to", "a.stl"], [example("torus"), "--to", "a.step"],
                      [example("torus"), "--to", "noextension"], [example("torus"), "--to", "a.stl", "--angle", "0"],
                      [example("torus"), "--to", "a.stl", "--angle", "181"],
                      [example("torus"), "--to", "a.stl", "--tolerance", "-1"],
                      [example("torus"), "--to", "a.stl", "--tolerance", "small"]):
        done = project.run("batten", "export", *arguments, status=2)
        assert done.stderr.strip() and not done.stdout, arguments
    for arguments in (["missing.igs", "--to", "a.stl"], [example("torus") + "#7", "--to", "a.stl"],
                      [example("torus"), "--to", "a.csv"], [example("torus"), "--to", "no/such/folder/a.stl"]):
        done = project.run("batten", "export", *arguments, status=1)
        assert done.stderr.startswith("batten "), (arguments, done.stderr)
    assert not [f for f in os.listdir(project.folder) if f.startswith("a.")]
    with open(project.path("bad.csv"), "w") as f:
        f.write("1,2,3\n4,five,6\n")
    assert "bad.csv:2:3: found 'five'" in project.run("batten", "info", "bad.csv", status=1).stderr


end.main()
