"""Scripts: routines without a window, with a real service and real workers."""
import json
import os
import shutil

import end


def start(project, example="wigley.base"):
    shutil.copy(os.path.join(end.EXAMPLES, example), project.folder)


def script(project, *lines, status=0, options=()):
    return project.run("batten", "script", "-", *options, stdin="\n".join(lines) + "\n", status=status)


def read(project, *parts):
    with open(project.path(*parts), "rb") as f:
        return f.read()


def test_maps_and_lines(project):
    """All curvatures, one of them shown, isophotes; results are those of the verbs."""
    start(project)
    done = script(project,
                  "V175 file=wigley.base  # both sides",
                  "V159 surface=wigley-1",
                  "V174 grid=48x24",
                  "V79 wait=yes",
                  "V80", "V82 range=0,1 scale=linear symmetric=no",
                  "V88 count=3 from=20 to=80", "V90", "V91")
    assert "wigley-1.map.exr" in done.stdout and "wigley-1.isophote" in done.stdout, done.stdout
    jobs = project.jobs()
    # V80 and V82 show what V79 has computed
    assert [j["worker"] for j in jobs.values()] == ["curvature", "isophotes"], jobs
    assert all(j["state"] == "done" for j in jobs.values()), jobs
    project.run("batten", "run", "curvature", "wigley.base#1", "--grid", "48x24", "-o", "verb")
    assert read(project, "verb.map.exr") == read(project, "wigley-1.map.exr")
    project.run("batten", "run", "isophotes", "wigley.base#1", "--count", "3", "--from", "20", "--to", "80",
                "-o", "verb")
    assert read(project, "verb.isophote") == read(project, "wigley-1.isophote")


def test_isophotes_of_a_scene(project):
    """Of the current surface where a script does not say; of all shown as one, whose curves go over the border."""
    start(project)
    opened = ["V175 file=wigley.base", "V88 count=3 from=20 to=80"]
    done = script(project, *opened, "V90 surfaces=shown", "V91 surfaces=shown", "V159 surface=wigley-1", "V90")
    jobs = [j for j in project.jobs().values() if j["worker"] == "isophotes"]
    assert [len(j["inputs"]) for j in jobs] == [2, 1], jobs
    assert "wigley-1+wigley-2.isophote" in done.stdout and "wigley-1.isophote" in done.stdout, done.stdout
    project.run("batten", "run", "isophotes", "wigley.base", "--count", "3", "--from", "20", "--to", "80", "-o", "verb")
    assert read(project, "verb.isophote") == read(project, "wigley-1+wigley-2.isophote")
    script(project, *opened, "V91 surfaces=shown", "V91 surfaces=shown on=no", "V91 surfaces=current")
    script(project, *opened, "V159 surface=wigley-2", "V94 surfaces=current", "V95 surfaces=current",
           "V168 surfaces=current", "V169 surfaces=current")
    last = list(project.jobs().values())[-2:]
    assert [len(j["inputs"]) for j in last] == [1, 1], last
    # what is there is of one of them alone
    script(project, "V175 file=wigley.base", "V127 index=1,1 to=1,0.1,0.2", "V91 surfaces=shown")


def test_scenes_have_names_of_their_own(project):
    """Results of one surface, of several, and of others with the same first one: no file takes another's place."""
    start(project)
    start(project, "teapot.base")
    script(project, "V175 file=wigley.base entity=1", "V71 size=16x16", "V175 file=wigley.base entity=2", "V71 size=16x16",
           "V71 size=16x16 surfaces=current", "V175 file=teapot.base entity=1,2,3,4,5,6,7", "V71 size=16x16", "V180 name=seventh",
           "V71 size=16x16")
    names = sorted(n for n in os.listdir(project.folder) if n.endswith(".shade.exr"))
    assert len(names) == 5 and {"wigley-1.shade.exr", "wigley-2.shade.exr",
                                "wigley-1+wigley-2.shade.exr"} < set(names), names
    assert sum(n.startswith("wigley-1+8-") for n in names) == 2, names
    # pictures are drawn by Mesa, whose own leaks cannot be told by their names any more
    project.environment["ASAN_OPTIONS"] = "detect_leaks=0:" + os.environ.get("ASAN_OPTIONS", "")
    script(project, "V175 file=wigley.base", "V79 grid=8x8 surfaces=shown", "V57 lines_u=3 surfaces=shown",
           "V189 on=no", "V179 to=seven.png size=320x200")
    maps = [n for n in os.listdir(project.folder) if n.endswith(".map.exr")]
    assert sorted(maps) == ["wigley-1.map.exr", "wigley-2.map.exr"], maps


def test_missing_map_is_computed(project):
    """V80 alone starts the worker; after an edit, again, on geometry that lies in no file."""
    start(project, "sphere.base")
    script(project, "V175 file=sphere.base", "V174 grid=16x16", "V80", "V127 index=1,1 to=2,2,2",
           "V80", "V182", "V81")
    jobs = project.jobs()
    assert len(jobs) == 3, jobs
    inputs = [j["inputs"][0]["path"] for j in jobs.values()]
    assert inputs[0] == inputs[2] != inputs[1], inputs


def test_contours_and_reflection(project):
    start(project)
    script(project, "V175 file=wigley.base", "V60 count=3", "V61 family=waterlines", "V63 tolerance_uv=1e-5",
           "V64 tolerance=0.001", "V168", "V169",
           "V65 count=2", "V66 axis=1,0,0 radius=1", "V67 distance=0.5", "V170", "V171",
           "V92 count=3", "V94", "V95")
    set_ = [j["parameters"] for j in project.jobs().values() if j["worker"] == "contours"][0]
    assert (set_["tolerance"], set_["tolerance-uv"], set_["waterlines"]) == ("0.001", "1e-5", "3"), set_
    levels = [j["outputs"][0]["figures"]["levels"] for j in project.jobs().values()
              if j["worker"] == "contours"]
    assert [l["kind"] for l in levels[0]] == ["waterline"] * 3, levels
    assert [(l["kind"], l["value"]) for l in levels[1]] == [("cylinder", 1), ("cylinder", 1.5)], levels
    assert os.path.exists(project.path("wigley-1+wigley-2.reflect"))


def test_edit_undo_save(project):
    start(project)
    script(project, "V175 file=wigley.base entity=1", "V178 to=before.base", "V127 index=1,1 to=1,2,3",
           "V178 to=edited.base", "V182", "V178 to=undone.base", "V183", "V180 name=mine", "V176")
    assert read(project, "before.base") == read(project, "undone.base") != read(project, "edited.base")
    assert read(project, "mine.base") == read(project, "edited.base")
    lost = script(project, "V175 file=mine.base", "V185 by=1,0,0")
    assert "'mine' was not saved" in lost.stderr, lost.stderr


def test_jobs_from_the_world_menu(project):
    """Started without waiting, held up, let go and killed; by number and all."""
    start(project, "teapot.base")
    done = script(project, "V175 file=teapot.base entity=1",
                  "V71 size=4000x4000 samples=8 wait=no", "V163 jobs=1", "V162", "V164 jobs=1",
                  "V165 jobs=all", "V162")
    lines = done.stdout.splitlines()
    assert any(l.startswith("1 suspended") for l in lines), lines
    assert lines[-1].startswith("1 killed"), lines
    assert project.jobs()[1]["state"] == "killed"
    script(project, "V163 jobs=99", status=1)


def test_quit_ends_jobs(project):
    start(project, "teapot.base")
    script(project, "V175 file=teapot.base entity=1", "V71 size=4000x4000 samples=8 wait=no",
           "V133 jobs=suspend", "V182")
    assert project.jobs()[1]["state"] == "suspended"
    script(project, "V175 file=teapot.base entity=1", "V76 size=4000x4000 samples=8 wait=no", "V133 jobs=kill")
    states = {k: j["state"] for k, j in project.jobs().items()}
    assert states == {1: "suspended", 2: "killed"}, states
    project.run("batten", "kill", "1")


def test_failing_lines(project):
    start(project)
    lines = ["V175 file=wigley.base", "V79 grid=abc", "V180 name=one", "V79 grid=8x8 nothing=1", "V180 name=two"]
    with open(project.path("a.script"), "w") as f:
        f.write("\n".join(lines))
    stopped = project.run("batten", "script", "a.script", status=2)
    assert "a.script line 2: grid is 'abc'" in stopped.stderr and "(column 5)" in stopped.stderr, stopped.stderr
    assert "line 4" not in stopped.stderr
    on = project.run("batten", "script", "a.script", "--keep-going", status=2)
    assert "line 2" in on.stderr and "a.script line 4: V79 has no argument nothing" in on.stderr, on.stderr
    script(project, "V175 file=none.base", status=1)
    project.run("batten", "script", "none.script", status=1)
    project.run("batten", "script", status=2)


def test_journal(project):
    """What the journal says, done elsewhere, gives the same files."""
    start(project)
    script(project, "V175 file=wigley.base", "V174 grid=20x10", "V79", "V88 count=2", "V90",
           "V127 index=1,1 to=1,0.1,0.2", "V177 name=mine", "V80", options=["--journal"])
    other = end.Project()
    try:
        start(other)
        journal = read(project, ".batten", "journal").decode()
        assert "wait=yes" in journal, journal
        script(other, *journal.splitlines())
        for name in ("wigley-1.map.exr", "wigley-1.isophote", "mine.base", "mine.map.exr"):
            assert read(project, name) == read(other, name), name
    finally:
        other.close()


def test_routines(project):
    """The list of leaves: all there, with paths, and the arguments of their workers."""
    leaves = {r["code"]: r for r in project.json("batten", "routines")["routines"]}
    assert len(leaves) == 188
    for leaf in leaves.values():
        assert set(leaf) >= {"code", "path", "kind", "available", "arguments"}, leaf
        assert leaf["path"].split(" > ")[0] in ("MAIN", "UV", "COSFAIR", "WORLD"), leaf
        for a in leaf["arguments"]:
            assert set(a) >= {"name", "type", "default", "min", "max", "unit", "choices", "help"}, a
    assert leaves["V80"]["path"] == "MAIN > GEOMETRY INTERROGATION > SURFACE > CURVATURE > GAUSSIAN"
    grid = next(a for a in leaves["V79"]["arguments"] if a["name"] == "grid")
    assert grid["type"] == "size" and grid["default"] == "512x512", grid
    assert leaves["V79"]["arguments"][-1]["name"] == "wait"
    assert leaves["V79"]["available"] and not leaves["V0"]["available"]
    for code in (c for c, leaf in leaves.items() if leaf["available"]):
        told = [a["name"] for a in project.json("batten", "help", code)["help"][0]["arguments"]]
        assert sorted(told) == sorted(a["name"] for a in leaves[code]["arguments"]), code
    workers = {w["name"]: w for w in project.json("batten", "workers")["workers"]}
    names = [a["name"] for a in leaves["V90"]["arguments"][:-2]]
    assert names == [p["name"] for p in workers["isophotes"]["parameters"]], names
    table = project.run("batten", "routines").stdout
    assert "V79  job      MAIN > " in table and "(later)" in table
    assert "samples in u by samples in v" in project.run("batten", "routines", "V79").stdout
    project.run("batten", "routines", "V999", status=2)


if __name__ == "__main__":
    end.main()
