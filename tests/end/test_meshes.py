"""`batten export` of triangles, read by readers of our own: closed where shapes are, the same in every
format, cancelled without a trace, refused with a sentence."""
import collections
import math
import os
import signal
import struct
import subprocess

import end
from iges_text import iges


def example(name, extension=".base"):
    return os.path.join(end.EXAMPLES, name + extension)


def read_obj(path):
    points, triangles, names = [], [], 0
    with open(path) as f:
        for line in f:
            word, *rest = line.split() or ["#"]
            if word == "v":
                points.append(tuple(map(float, rest)))
            elif word == "f":
                triangles.append([points[int(corner.split("//")[0]) - 1] for corner in rest])
            names += word == "o"
    return triangles, names


def read_stl(path):
    with open(path, "rb") as f:
        data = f.read()
    assert data[:5] != b"solid"
    n, = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * n
    values = (struct.unpack_from("<12fH", data, 84 + 50 * k) for k in range(n))
    return [[v[3:6], v[6:9], v[9:12]] for v in values]


def read_ply(path):
    with open(path, "rb") as f:
        head, data = f.read().split(b"end_header\n", 1)
    lines = head.decode().split("\n")
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    points = [struct.unpack_from("<3d3f", data, 36 * k) for k in range(counts["vertex"])]
    for p in points:
        assert abs(math.hypot(*p[3:]) - 1) < 1e-6
    faces = [struct.unpack_from("<B3I", data, 36 * len(points) + 13 * k) for k in range(counts["face"])]
    assert len(data) == 36 * len(points) + 13 * len(faces)
    assert all(f[0] == 3 for f in faces)
    return [[points[i][:3] for i in f[1:]] for f in faces]


def open_edges(triangles):
    uses = collections.Counter()
    for t in triangles:
        for a, b in zip(t, t[1:] + t[:1]):
            assert a != b
            uses[(a, b)] += 1
    return sum(count != 1 or uses[(b, a)] != 1 for (a, b), count in uses.items())


def volume(triangles):
    total = 0
    for a, b, c in triangles:
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                  + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


def test_meshes_are_closed_in_every_format(project):
    for name in ("sphere", "torus"):
        meshes = []
        for extension, read in ((".obj", lambda p: read_obj(p)[0]), (".stl", read_stl), (".ply", read_ply)):
            file = project.path(name + extension)
            told = project.json("batten", "export", example(name), "--to", file, "--angle", "20")
            triangles = read(file)
            assert told["triangles"] == len(triangles) and told["open_edges"] == 0, told
            assert open_edges(triangles) == 0, (name, extension)
            meshes.append(triangles)
        for a, b in zip(meshes[0], meshes[2]):
            assert a == b  # OBJ and PLY hold the points to the bit
        # every edge is used once each way; the volume is that of the sphere (or torus) within the tolerance
        box = project.json("batten", "info", example(name))["entities"][0]["box"]
        dx, _, dz = (hi - lo for lo, hi in zip(*box))
        exact = math.pi / 6 * dx ** 3 if name == "sphere" else 2 * math.pi ** 2 * (dx - dz) / 2 * (dz / 2) ** 2
        assert 0.97 * exact < abs(volume(meshes[0])) < exact


def test_faces_that_join_make_one_closed_mesh(project):
    told = project.json("batten", "export", example("hull"), "--to", "hull.obj")
    triangles, names = read_obj(project.path("hull.obj"))
    assert told["open_edges"] == 0 and open_edges(triangles) == 0
    assert names == told["entities"] > 1


def test_the_tolerance_and_the_angle_are_obeyed(project):
    counts = [project.json("batten", "export", example("torus"), "--to", "t.stl", "--angle", "180", "--tolerance",
                           t)["triangles"] for t in ("0.1", "0.01", "0.001")]
    assert counts[0] * 4 < counts[1] * 2 < counts[2], counts
    counts = [project.json("batten", "export", example("torus"), "--to", "t.stl", "--tolerance", "1", "--angle",
                           a)["triangles"] for a in ("40", "10")]
    assert counts[0] * 4 < counts[1], counts


READERS = {".obj": lambda p: read_obj(p)[0], ".stl": read_stl, ".ply": read_ply}

# closed shapes made of trimmed faces: Euler's characteristic, and the volume where it is known from the shape
CLOSED = {
    "hammer.iges": (2, None),
    "d150_wing.igs": (2, None),
    "naca_wing.iges": (2, None),
    "bounded_141_143.igs": (2, None),
    "sphere_rhino.igs": (2, 4 / 3 * math.pi),
    "torus_nurbs.igs": (0, 2 * math.pi ** 2 * 50 * 12.5 ** 2),
}


def test_closed_shapes_are_closed_at_every_tolerance(project):
    data = os.environ.get("BATTEN_DATA")
    if not data:
        raise end.Skip("BATTEN_DATA is not set")
    for name, (characteristic, exact) in CLOSED.items():
        file = os.path.join(data, name)
        usual = project.json("batten", "export", file, "--to", "m.obj")["tolerance"]
        volumes = []
        for times in (0.1, 1, 10, 100):
            for extension, read in READERS.items():
                told = project.json("batten", "export", file, "--to", "m" + extension, "--tolerance",
                                    repr(usual * times))
                triangles = read(project.path("m" + extension))
                what = (name, times, extension, told)
                assert told["open_edges"] == told["multiple_edges"] == told["turned_edges"] == 0, what
                assert told["borders"] == [] and open_edges(triangles) == 0, what
                points = {p for t in triangles for p in t}
                # triangles too small for float fall out of STL
                least = 0.99 if extension == ".stl" else 1
                assert least * told["triangles"] <= len(triangles) <= told["triangles"], what
                assert least * told["points"] <= len(points) <= told["points"], what
                assert len(points) - len(triangles) // 2 == characteristic, what
            volumes.append(volume(triangles))
        assert min(volumes) > 0, (name, volumes)
        assert exact is None or abs(volumes[0] / exact - 1) < 2e-3, (name, volumes)


def test_open_borders_are_told_with_their_places(project):
    told = project.json("batten", "export", example("wigley"), "--to", "w.obj")
    border, = told["borders"]
    assert border["edges"] == told["open_edges"] > 0 and border["surfaces"] == [1, 2], told
    assert border["length"] > border["width"] > 0 and len(border["at"]) == 3, border
    text = project.run("batten", "export", example("wigley"), "--to", "w.obj").stdout
    assert f"{told['open_edges']} edges open in 1 border" in text and "surface 1" in text, text


def test_a_mesh_that_is_cancelled_leaves_no_file(project):
    for extension in READERS:
        before = sorted(os.listdir(project.folder))
        making = project.start("batten", "export", example("torus"), "--to", "big" + extension, "--tolerance", "1e-6",
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        # it takes minutes; the signal comes when the handler is there
        with open(f"/proc/{making.pid}/status") as f:
            path = f.name
        while making.poll() is None:
            with open(path) as f:
                caught = [line for line in f if line.startswith("SigCgt")]
            if caught and int(caught[0].split()[1], 16) >> (signal.SIGINT - 1) & 1:
                break
        making.send_signal(signal.SIGINT)
        said = making.communicate(timeout=60)[1]
        assert making.returncode == 130 and "cancelled" in said, (making.returncode, said)
        assert sorted(os.listdir(project.folder)) == before


def test_tolerances_out_of_reach_are_refused_or_settled(project):
    done = project.run("batten", "export", example("torus"), "--to", "t.stl", "--tolerance", "1e-12", status=1)
    assert "give a larger tolerance" in done.stderr and not os.path.exists(project.path("t.stl")), done.stderr
    for word in ("nan", "inf", "-1", "0", "1e400", ""):
        done = project.run("batten", "export", example("torus"), "--to", "t.stl", "--tolerance", word, status=None)
        assert done.returncode == (0 if word in ("inf",) and not done.stderr else 2), (word, done)
    told = project.json("batten", "export", example("torus"), "--to", "t.stl", "--tolerance", "1e12")
    assert told["open_edges"] == 0 and 8 < told["triangles"] < 2000, told


def plane(corners):
    """A bilinear surface over 0 .. 1."""
    points = ",".join(f"{float(x)!r}" for p in corners for x in p)
    return (128, 0, f"128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,{points},0.,1.,0.,1.;")


def test_stl_far_from_the_origin_says_what_it_cannot_hold(project):
    with open(project.path("far.igs"), "w") as f:
        f.write(iges([plane([(1e9 + x, y, 0) for y in (0, 1) for x in (0, 1)])]))
    done = project.run("batten", "export", "far.igs", "--to", "far.stl")
    assert "2 of 2 triangles are left out" in done.stderr and ".ply" in done.stderr, done.stderr
    assert read_stl(project.path("far.stl")) == []
    assert project.run("batten", "export", "far.igs", "--to", "far.ply").stderr == ""
    assert len(read_ply(project.path("far.ply"))) == 2


end.main()
