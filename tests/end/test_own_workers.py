"""Workers by anybody: a folder, an executable, a description; nothing else is told of them."""
import csv
import json
import math
import os
import shutil
import stat

import end

SOURCE = os.environ["BATTEN_SOURCE"]
OWN = os.path.join(end.BUILD, "examples", "workers")
SPHERE = os.path.join(end.EXAMPLES, "sphere.base")
WIGLEY = os.path.join(end.EXAMPLES, "wigley.base")
GOOD = {"name": "own", "title": "own", "version": 1, "parameters": [],
        "outputs": [{"extension": ".own", "kind": "text"}]}


def install(project, *names):
    folder = project.path(".batten", "workers")
    os.makedirs(folder, exist_ok=True)
    for name in names:
        shutil.copy(os.path.join(OWN, "batten-" + name), folder)


def write_worker(project, name, text):
    folder = project.path(".batten", "workers")
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "batten-" + name)
    with open(path, "w") as f:
        f.write(text)
    os.chmod(path, 0o755)


def listed(project, name):
    return {w["name"]: w for w in project.json("batten", "workers")["workers"]}[name]


def table(path):
    with open(path, newline="") as f:
        return list(csv.DictReader(f))


def test_they_are_small(_):
    with open(os.path.join(SOURCE, "examples", "workers", "lengths.py")) as f:
        assert len(f.readlines()) <= 60


def test_they_are_found_listed_and_described(project):
    assert "--along" not in project.run("batten", "help", "lengths").stdout
    install(project, "lengths", "hydrostatics")
    for name, parameter in (("lengths", "along"), ("hydrostatics", "draft")):
        w = listed(project, name)
        assert w["broken"] is None and w["outputs"][0]["kind"] == "table", w
        assert parameter in [p["name"] for p in w["parameters"]], w
        assert "--" + parameter in project.run("batten", "help", name).stdout
    done = project.run("batten", "submit", "lengths", SPHERE, "--along", "w", status=2)
    assert "one of u, v" in done.stderr, done.stderr
    project.run("batten", "submit", "lengths", SPHERE, "--lines", "1", status=2)
    done = project.run("batten", "submit", "lengths", SPHERE, "--shards", "2", status=2)
    assert "as a whole" in done.stderr, done.stderr


def test_lengths_of_a_sphere(project):
    install(project, "lengths")
    (sphere,) = project.json("batten", "info", SPHERE)["entities"]
    half = 10 * math.pi  # a meridian of radius 10
    (job,) = project.json("batten", "run", "lengths", SPHERE, "--along", "v", "--lines", "3")["jobs"]
    assert job["state"] == "done" and job["outputs"][0]["figures"] == {"lines": 3}, job
    rows = table(project.path("sphere.lengths.csv"))
    (a, b) = sphere["domain"][0]
    assert [float(r["parameter"]) for r in rows] == [a, (a + b) / 2, b], rows
    for r in rows:
        assert abs(float(r["length"]) - half) <= float(r["error"]) <= 1e-6 * half, r
    project.run("batten", "run", "lengths", SPHERE, "--along", "u", "--lines", "3", "-o", "around")
    rows = table(project.path("around.lengths.csv"))
    for r, expected in zip(rows, (0, 20 * math.pi, 0)):  # pole, equator, pole
        assert abs(float(r["length"]) - expected) <= float(r["error"]) + 1e-12, r


def test_hydrostatics_of_bodies_that_are_known(project):
    install(project, "hydrostatics")
    length, breadth, draft = 100, 10, 6.25  # the Wigley hull of the examples: both sides
    (job,) = project.json("batten", "run", "hydrostatics", WIGLEY)["jobs"]
    f = job["outputs"][0]["figures"]
    assert math.isclose(f["volume"], 4 / 9 * length * breadth * draft, rel_tol=1e-9), f
    assert math.isclose(f["waterplane"], 2 / 3 * length * breadth, rel_tol=1e-9), f
    assert math.isclose(f["center_z"], -3 / 8 * draft, rel_tol=1e-9), f
    assert abs(f["center_x"]) < 1e-9 and abs(f["center_y"]) < 1e-9, f
    for draft in (-5, 0, 2.5):  # a sphere of radius 10, cut h below the water
        (job,) = project.json("batten", "run", "hydrostatics", SPHERE, "--draft", draft)["jobs"]
        f = job["outputs"][0]["figures"]
        h = 10 + draft
        assert abs(f["volume"] - math.pi * h * h * (30 - h) / 3) <= f["volume_error"], f
        assert abs(f["waterplane"] - math.pi * h * (20 - h)) <= f["waterplane_error"], f
        assert abs(f["wetted"] - 20 * math.pi * h) <= f["wetted_error"], f
    rows = {r["quantity"]: r for r in table(project.path("sphere.hydrostatics.csv"))}
    assert float(rows["volume"]["value"]) == f["volume"], rows
    with open(project.path("sphere.hydrostatics.csv"), "rb") as one:
        before = one.read()
    project.run("batten", "run", "hydrostatics", SPHERE, "--draft", "2.5", "--shards", "3", "--force")
    with open(project.path("sphere.hydrostatics.csv"), "rb") as cut:
        assert cut.read() == before


def test_failing_they_say_why(project):
    install(project, "lengths", "hydrostatics")
    (job,) = project.json("batten", "run", "hydrostatics", SPHERE, "--draft", "-11",
                          status=1)["jobs"]
    assert job["state"] == "failed" and "--draft -11" in job["reason"], job
    (job,) = project.json("batten", "run", "lengths", SPHERE, "--lines", "2", "-o", "no/folder/x",
                          status=1)["jobs"]
    assert job["state"] == "failed" and "no/folder" in job["reason"], job


def test_suspended_activated_and_killed(project):
    install(project, "lengths")
    (job,) = project.submit("lengths", SPHERE, "--lines", "1000")
    end.until(lambda: project.jobs()[job]["done"], "a line is measured")
    pid = project.jobs()[job]["pid"]
    project.run("batten", "suspend", job)
    assert end.process_state(pid) == "T"
    project.run("batten", "activate", job)
    assert end.process_state(pid) not in ("T", None)
    project.run("batten", "config", "cancel-grace", "0.1")
    project.run("batten", "kill", job)
    j = project.jobs()[job]
    assert j["state"] == "killed" and end.process_state(pid) is None, j
    assert not os.path.exists(project.path("sphere.lengths.csv"))


def parameter(**fields):
    return dict(GOOD, parameters=[dict({"name": "a", "type": "real"}, **fields)])


WRONG = (
    ("", "--describe"),
    ("{", "--describe"),
    ("[]", "--describe"),
    ({}, "it is 'nothing'"),
    (dict(GOOD, name="other"), "it is 'other'"),
    (dict(GOOD, name=7), "it is 'nothing'"),
    (dict(GOOD, version="1"), "no version"),
    (dict(GOOD, title=None), "no title"),
    (dict(GOOD, parameters=None), "no list of parameters"),
    (dict(GOOD, parameters={}), "no list of parameters"),
    (dict(GOOD, parameters=[7]), "parameter 1 has no name or type"),
    (parameter(name=None), "parameter 1 has no name or type"),
    (parameter(name="Big"), "'Big' is not named in small letters"),
    (parameter(name="../x"), "is not named in small letters"),
    (parameter(name="time"), "'time' has the name of an option"),
    (parameter(type="float"), "'a' has the type 'float', which is none"),
    (parameter(min="0"), "min or max of parameter 'a'"),
    (parameter(help=7), "help or unit of parameter 'a'"),
    (parameter(default=1), "default of parameter 'a' is not a text"),
    (parameter(default="x"), "default of parameter 'a' is wrong"),
    (parameter(default="5", min=0, max=1), "default of parameter 'a' is wrong"),
    (parameter(type="choice"), "'a' is a choice without choices"),
    (parameter(type="choice", choices=[1]), "choices of parameter 'a' are not texts"),
    (parameter(type="choice", choices=["x"], default="y"), "default of parameter 'a' is wrong"),
    (dict(GOOD, parameters=[{"name": "a", "type": "real"}] * 2), "'a' is there twice"),
    (dict(GOOD, outputs=None), "no list of outputs"),
    (dict(GOOD, outputs=[]), "no list of outputs"),
    (dict(GOOD, outputs=[{"kind": "text"}]), "output 1 has no extension"),
    (dict(GOOD, outputs=[{"extension": "own", "kind": "text"}]), "output 1 has no extension"),
    (dict(GOOD, outputs=[{"extension": "./../x", "kind": "t"}]), "output 1 has no extension"),
    (dict(GOOD, outputs=[{"extension": ".own"}]), "output '.own' has no kind"),
)


def test_a_wrong_description_is_listed_as_broken(project):
    for i, (description, why) in enumerate(WRONG):
        text = description if isinstance(description, str) else \
            json.dumps(dict(description, name=f"own{i}") if description.get("name") == "own"
                       else description)
        write_worker(project, f"own{i}", f"#!/bin/sh\ncat <<'END'\n{text}\nEND\n")
    write_worker(project, "fine", "#!/bin/sh\ncat <<'END'\n" + json.dumps(dict(GOOD, name="fine"))
                 + "\nEND\n")
    write_worker(project, "quits", "#!/bin/sh\nexit 3\n")
    write_worker(project, "none", "#!/nonexistent/python\n")
    workers = {w["name"]: w for w in project.json("batten", "workers")["workers"]}
    for i, (description, why) in enumerate(WRONG):
        w = workers[f"own{i}"]
        assert w["broken"] and why in w["broken"], (description, w["broken"])
    assert workers["fine"]["broken"] is None, workers["fine"]
    assert "status 3" in workers["quits"]["broken"]
    assert "cannot run it" in workers["none"]["broken"], workers["none"]
    done = project.run("batten", "submit", "own3", SPHERE, status=1)
    assert "own3" in done.stderr and "it is 'nothing'" in done.stderr, done.stderr
    assert workers["curvature"]["broken"] is None


def test_one_that_is_not_executable_is_not_there(project):
    install(project, "lengths")
    path = project.path(".batten", "workers", "batten-lengths")
    os.chmod(path, stat.S_IRUSR | stat.S_IWUSR)
    assert "lengths" not in [w["name"] for w in project.json("batten", "workers")["workers"]]


if __name__ == "__main__":
    end.main()
