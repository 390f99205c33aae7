"""`batten info` and `batten eval` against the reference values of real IGES files."""
import json
import math
import os

import end

NEAR_POINT = 1e-11       # of the net's size
NEAR_DERIVATIVE = 1e-10  # of the largest component
NEAR_CURVATURE = 1e-8    # relative; absolute in nearly flat spots: 1e-7 / size (squared for K)


def place(matrix, p, moves):
    if not matrix:
        return p
    return [sum(row[k] * p[k] for k in range(3)) + (row[3] if moves else 0) for row in matrix]


def close(got, expected, tolerance, what):
    error = max(abs(g - e) for g, e in zip(got, expected))
    assert error <= tolerance, f"{what}: got {got}, expected {expected}, off by {error:g}"


def check_surface(project, path, s):
    if not s["samples"]:
        return 0
    lines = "\n".join(f"{x['u']!r} {x['v']!r}" for x in s["samples"])
    got = project.json("batten", "eval", f"{path}#D{s['de']}", "-", stdin=lines)["points"]
    lo, hi = s["net_box"]
    size = max(b - a for a, b in zip(lo, hi)) or 1
    matrix = s.get("matrix")
    assert len(got) == len(s["samples"])
    for p, x in zip(got, s["samples"]):
        what = f"D{s['de']} u {x['u']} v {x['v']}"
        close(p["point"], place(matrix, x["S"], True), NEAR_POINT * size, what + " point")
        for ours, theirs in (("du", "Su"), ("dv", "Sv"), ("duu", "Suu"), ("duv", "Suv"), ("dvv", "Svv")):
            largest = max(map(abs, x[theirs] + [size]))
            close(p[ours], place(matrix, x[theirs], False), NEAR_DERIVATIVE * largest, f"{what} {ours}")
        if "N" in x and p["normal"]:
            close(p["normal"], place(matrix, x["N"], False), 1e-8, what + " normal")
        for ours, theirs, power in (("gaussian", "K", 2), ("mean", "H", 1)):
            if theirs in x and x[theirs] is not None and p[ours] is not None:
                slack = NEAR_CURVATURE * abs(x[theirs]) + 1e-7 / size ** power
                assert abs(p[ours] - x[theirs]) <= slack, f"{what} {ours}: {p[ours]} {x[theirs]}"
    return len(got)


def check_curve(project, path, c):
    lines = "\n".join(repr(x["u"]) for x in c["samples"])
    got = project.json("batten", "eval", f"{path}#D{c['de']}", "-", stdin=lines)["points"]
    matrix = c.get("matrix")
    size = max(max(map(abs, x["C"])) for x in c["samples"]) or 1
    for p, x in zip(got, c["samples"]):
        what = f"D{c['de']} t {x['u']}"
        close(p["point"], place(matrix, x["C"], True), NEAR_POINT * size, what + " point")
        for ours, theirs in (("d1", "Cu"), ("d2", "Cuu")):
            if theirs not in x:
                continue
            largest = max(map(abs, x[theirs] + [size]))
            close(p[ours], place(matrix, x[theirs], False), NEAR_DERIVATIVE * largest, f"{what} {ours}")
        if x.get("k") is not None and p["curvature"] is not None:
            assert abs(p["curvature"] - x["k"]) <= NEAR_CURVATURE * abs(x["k"]) + 1e-7 / size, what
    return len(got)


def references():
    folder = end.data_folder()
    for name in sorted(os.listdir(os.path.join(folder, "reference"))):
        with open(os.path.join(folder, "reference", name)) as f:
            yield os.path.join(folder, name[:-len(".json")]), json.load(f)


def test_points_derivatives_and_curvatures(project):
    surfaces = curves = 0
    for path, reference in references():
        for s in reference.get("raw128", []):
            surfaces += check_surface(project, path, s)
        for c in reference.get("raw126", []):
            curves += check_curve(project, path, c)
    assert surfaces >= 700 and curves >= 390, (surfaces, curves)


def test_units_domains_and_nets(project):
    for path, reference in references():
        o = project.json("batten", "info", path, status=None)
        of_file = reference["global"]
        name = os.path.basename(path)
        assert math.isclose(o["scale"], of_file["scale"]), name
        if name != "trout_lake_scale2.igs":  # names no unit that can be read
            assert math.isclose(o["unit_in_mm"], of_file["unit_in_mm"]), name
        by_de = {e["de"]: e for e in o["entities"]}
        for s in reference.get("raw128", []):
            e = by_de[s["de"]]
            assert e["order"] == s["order"] and e["points"] == s["net"], (name, e, s["order"])
            domain = [x for pair in e["domain"] for x in pair]
            for a, b in zip(domain, s["domain"]):
                assert math.isclose(a, b, abs_tol=1e-12), (name, s["de"], domain, s["domain"])
            assert e["rational"] == s["rational"], (name, s["de"])


def test_what_is_skipped_is_named(project):
    path = os.path.join(end.data_folder(), "all_entities_bench.igs")
    skipped = project.json("batten", "info", path)["skipped"]
    assert sum(row["count"] for row in skipped) > 100
    assert all(row["reason"] for row in skipped)
    assert {212, 214} <= {row["type"] for row in skipped}


def test_rewritten_files_hold_the_same_geometry(project):
    folder = end.data_folder()
    for one, other in (("series_60.iges", "series_60_delimiters.igs"), ("goteborg.iges", "goteborg_sparse.igs")):
        a, b = (project.json("batten", "info", os.path.join(folder, f))["entities"] for f in (one, other))
        assert len(a) == len(b)
        for x, y in zip(a, b):
            assert (x["order"], x["points"], x["domain"], x["box"]) == \
                (y["order"], y["points"], y["domain"], y["box"]), (one, x["de"], y["de"])


end.main()
