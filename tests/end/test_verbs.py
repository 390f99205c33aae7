"""Every verb has help, a man page and completion, says what is wrong, and exits as it should."""
import json
import os
import re
import subprocess

import end

VERBS = ("activate config doctor eval export help hold import info jobs kill log priority prune release retry run "
         "serve shutdown submit suspend wait workers").split()


def test_every_verb_has_help_and_a_man_page(project):
    for verb in VERBS:
        said = project.run("batten", verb, "--help").stdout
        assert said.startswith(f"usage: batten {verb}"), said
        assert "--json" in said
        page = project.run("batten", "--man", verb).stdout
        assert page.startswith(f".TH BATTEN-{verb} 1")
        assert os.path.exists(os.path.join(end.BUILD, "executive", f"batten-{verb}.1"))


def test_the_completion_is_bash(project):
    path = os.path.join(end.BUILD, "executive", "batten.bash")
    script = f"source {path}; COMP_WORDS=(batten sus); COMP_CWORD=1; _batten; echo ${{COMPREPLY[*]}}"
    said = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=end.GUARD_S)
    assert said.stdout.split() == ["suspend"], said
    options = script.replace("batten sus", "batten wait --t").replace("CWORD=1", "CWORD=2")
    said = subprocess.run(["bash", "-c", options], capture_output=True, text=True, timeout=end.GUARD_S)
    assert said.stdout.split() == ["--timeout"], said


def test_what_is_wrong_is_said_on_standard_error(project):
    for arguments in (["nonsense"], ["jobs", "--nonsense"], ["suspend"], ["suspend", "x"], ["suspend", "1", "--all"],
                      ["wait", "--timeout"], ["wait", "--timeout", "-1"], ["log"], ["run"], ["run", "shading"],
                      ["run", "nonsense", "x.igs"], ["config", "nonsense"], ["config", "jobs", "many"],
                      ["help", "nonsense"], ["eval"], ["jobs", "--color", "blue"]):
        done = project.run("batten", *arguments, status=2)
        assert done.stdout == "", arguments
        assert done.stderr.strip(), arguments
    for arguments in (["info", "missing.igs"], ["eval", "missing.igs", "0", "0"], ["import", "missing.igs"],
                      ["run", "shading", "missing.igs"], ["suspend", "77"], ["log", "77"], ["wait", "77"]):
        done = project.run("batten", *arguments, status=1)
        assert done.stderr.startswith("batten "), (arguments, done.stderr)


def test_without_a_display_the_editor_says_so(project):
    project.environment.pop("DISPLAY", None)
    project.environment.pop("WAYLAND_DISPLAY", None)
    for arguments in ([], [os.path.join(end.EXAMPLES, "torus.igs")]):
        done = project.run("batten", *arguments, status=1)
        assert done.stdout == "", arguments
        assert done.stderr.startswith("batten: ") and done.stderr.count("\n") == 1, done.stderr
    assert not os.path.exists(os.path.join(project.folder, ".batten"))


def test_reading_makes_no_project(project):
    torus = os.path.join(end.EXAMPLES, "torus.igs")
    project.run("batten", "info", torus)
    project.run("batten", "eval", torus, "0.1", "0.1")
    project.run("batten", "help")
    project.run("batten", "workers")
    assert not os.path.exists(project.path(".batten"))


def test_settings_are_kept(project):
    project.run("batten", "config", "jobs", "3")
    assert project.run("batten", "config", "jobs").stdout.strip() == "3"
    project.environment["BATTEN_JOBS"] = "5"
    rows = {row["key"]: row for row in project.json("batten", "config")["settings"]}
    assert rows["jobs"]["value"] == "5" and rows["jobs"]["source"] == "environment"
    assert rows["nice"]["source"] == "default"


def test_the_workers_describe_themselves(project):
    workers = {w["name"]: w for w in project.json("batten", "workers")["workers"]}
    for name in ("contours", "curvature", "isocurvature", "isophotes", "raytrace", "reflection", "shading"):
        w = workers[name]
        assert not w["broken"] and w["title"] and w["version"] >= 1 and w["parameters"] and w["outputs"], w
        direct = json.loads(project.run(f"batten-{name}", "--describe").stdout)
        assert direct["parameters"] == w["parameters"]
        for p in w["parameters"]:
            assert p["help"] and {"name", "type", "default", "min", "max", "unit", "choices"} <= set(p), p
        assert "--" + w["parameters"][0]["name"] in project.run("batten", "help", name).stdout


def test_the_doctor_finds_nothing_bad(project):
    findings = project.json("batten", "doctor")["findings"]
    assert {f["what"] for f in findings} >= {"processor", "project", "disk", "settings", "workers", "service"} - {
        "workers"}
    assert all(f["verdict"] != "bad" for f in findings), findings


def test_eval_takes_blanks_and_commas(project):
    sphere = os.path.join(end.EXAMPLES, "sphere.base")
    box = project.json("batten", "info", sphere)["entities"][0]
    (u0, u1), (v0, v1) = box["domain"]
    middle = f"{(u0 + u1) / 2!r}", f"{(v0 + v1) / 2!r}"
    one = project.json("batten", "eval", sphere, *middle)["points"]
    many = project.json("batten", "eval", sphere, "-", stdin=f"{middle[0]},{middle[1]}\n\n {middle[0]} {middle[1]}\n")
    assert many["points"] == one * 2
    done = project.run("batten", "eval", sphere, repr(u1 + 1), middle[1], status=2)
    assert re.search(r"outside the domain of surface 1", done.stderr)
    project.run("batten", "eval", sphere, "-", stdin="1\n", status=2)


def shell(project, script, *words):
    """The words as "$@" of a bash script."""
    return subprocess.run(["bash", "-c", script, "bash", *project.command(("batten", *words))], cwd=project.folder,
                          env=project.environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=end.GUARD_S)


def test_what_cannot_be_printed_is_said_once(project):
    teapot = os.path.join(end.EXAMPLES, "teapot.igs")
    for words in (["jobs"], ["jobs", "--json"], ["info", teapot], ["info", teapot, "--json"], ["workers"],
                  ["eval", teapot + "#1", "0.5", "0.5", "--json"], ["config", "--json"], ["--help"], ["--version"],
                  ["jobs", "--help"], ["--man", "jobs"], ["prune", "--json"]):
        for script in ('"$@" >&-', '"$@" >/dev/full'):
            done = shell(project, script, *words)
            assert done.returncode == 1, (words, done)
            assert done.stderr.count("\n") == 1 and "cannot write to standard output" in done.stderr, (words, done)


def test_nothing_that_is_said_goes_into_a_file(project):
    """With standard streams closed no file of ours gets their numbers."""
    teapot = os.path.join(end.EXAMPLES, "teapot.igs")
    project.run("batten", "import", teapot, "--into", "whole")
    sphere = os.path.join(end.EXAMPLES, "sphere.igs") + "#1"
    for script in ('"$@" 2>&-', '"$@" <&- 2>&-', '"$@" <&- >&- 2>&-'):
        assert shell(project, script, "import", teapot, "--into", "closed").returncode == (1 if ">&- 2" in script else 0)
        for name in os.listdir(project.path("whole")):
            with open(project.path("whole", name)) as a, open(project.path("closed", name)) as b:
                assert a.read() == b.read(), (script, name)
        done = shell(project, script, "run", "curvature", sphere, "--grid", "20x20", "-o", "c", "--force")
        assert done.returncode == (1 if ">&- 2" in script else 0), done
        assert project.run("batten-curvature", sphere, "--grid", "20x20", "-o", "c").stderr.count("up to date")


def test_a_limit_of_files_sizes_is_a_sentence(project):
    teapot = os.path.join(end.EXAMPLES, "teapot.igs")
    for words in (["import", teapot, "--into", "all"], ["export", teapot + "#1", "--to", "one.igs"]):
        done = shell(project, 'ulimit -f 0; "$@"', *words)
        assert done.returncode == 1 and "cannot write" in done.stderr, done
    assert not os.path.exists(project.path("one.igs")) and not os.listdir(project.path("all"))


def test_eval_shows_no_infinite_number(project):
    steep = os.path.join(project.folder, "steep.base")
    with open(steep, "w") as f:
        f.write("batten base 1\ntype curve\norder 3\nncontpts 3\nknots 0 0 0 1 1 1\n"
                "contpts 0 0 0 1e-300  1e300 1e300 0 1e300  2 0 0 1\nend\n")
    point = project.json("batten", "eval", steep, "0")["points"][0]
    assert point["point"] == [0, 0, 0] and point["d1"] is None, point
    text = project.run("batten", "eval", steep, "0").stdout
    assert "inf" not in text and re.search(r"d1 +- +- +0", text), text


end.main()
