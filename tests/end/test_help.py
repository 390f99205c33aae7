"""Help of the editor's menus and routines from the command line, with the user's own menus and texts."""
import os

import end

# the job routines, and the worker that each one runs
JOBS = {"V71": "shading", "V76": "raytrace", "V79": "curvature", "V90": "isophotes", "V94": "reflection",
        "V168": "contours", "V170": "contours"}


def write(project, name, text):
    path = project.path(".batten", *name.split("/"))
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as f:
        f.write(text)


def test_a_code_is_explained(project):
    said = project.run("batten", "help", "V79").stdout
    assert said.startswith("MAIN > GEOMETRY INTERROGATION > SURFACE > CURVATURE > ALL CURVATURES\nV79  "), said
    assert "\nWhat it asks for\n  grid " in said and "\n  V79 grid=400x200 wait=yes\n" in said
    assert project.run("batten", "help", "v79").stdout == said
    assert "WORLD > STATUS ROUTINES\nN56  " in project.run("batten", "help", "N56").stdout
    assert max(map(len, said.splitlines())) <= 80


def test_a_code_as_json(project):
    row, = project.json("batten", "help", "V80")["help"]
    assert row["code"] == "V80" and row["path"].endswith(" > CURVATURE > GAUSSIAN")
    assert [a["name"] for a in row["arguments"]] == ["range", "scale", "symmetric", "surfaces", "wait"]
    assert all(a["range"] and a["help"] for a in row["arguments"])
    assert "V79" in row["see"] and row["purpose"] and row["result"] and row["example"].startswith("V80")
    menu, = project.json("batten", "help", "N31")["help"]
    assert menu["result"] is None and menu["example"] is None and menu["arguments"] == []


def test_a_worker_comes_before_the_routines(project):
    said = project.run("batten", "help", "curvature").stdout
    assert said.startswith("curvature: ") and "--grid" in said
    assert said.index("--grid") < said.index("routines and menus:") < said.index("V79 ")
    both = project.json("batten", "help", "curvature")
    assert both["worker"]["name"] == "curvature" and both["found"] >= len(both["help"]) > 5
    none = project.json("batten", "help", "porcupine")
    assert none["worker"] is None and none["help"][0]["code"].startswith("V")


def test_several_words_must_all_occur(project):
    found = project.json("batten", "help", "porcupine", "scale")
    assert found["help"][0]["code"] == "V136"
    assert found["found"] < project.json("batten", "help", "porcupine")["found"]
    for words in (["V999"], ["N999"], ["xyzzy"], ["porcupine", "xyzzy"]):
        done = project.run("batten", "help", *words, status=2)
        assert done.stdout == "" and words[-1] in done.stderr, done
        assert project.run("batten", "help", *words, "--json", status=2).stdout == ""


def test_help_of_jobs_names_arguments_of_their_workers(project):
    workers = {w["name"]: w for w in project.json("batten", "workers")["workers"]}
    for code, worker in JOBS.items():
        row, = project.json("batten", "help", code)["help"]
        named = {a["name"] for a in row["arguments"]}
        takes = {p["name"] for p in workers[worker]["parameters"]}
        assert "wait" in named and named - {"wait", "surfaces"} <= takes, (code, named - takes)
        if code != "V170":  # planes and cylinders share one worker
            assert takes - named <= {"cylinder"}, (code, takes - named)


def test_own_menus_and_texts(project):
    write(project, "menus/world.menu", "2\nYARD\nYard Menu\nN900\n1\nJOBS\nV162\n1\nSHELL\nV900\n0\nEND MENU\n")
    write(project, "help/own.help", "@N900 Yard\nWhat the yard does.\n@V900 Shell\nExpands the shell.\n"
          ":result\nA drawing.\n:example\nV900\n")
    assert project.run("batten", "help", "V900").stdout.startswith("WORLD > SHELL\nV900  Shell\n")
    assert project.run("batten", "help", "V162").stdout.startswith("WORLD > JOBS\nV162  ")
    assert project.json("batten", "help", "expands", "shell")["help"][0]["code"] == "V900"


def test_broken_menus_and_texts_are_told(project):
    write(project, "menus/main.menu", "2\nMAIN MENU\n\n")
    write(project, "help/own.help", "@V79 All\n")
    done = project.run("batten", "help", "V79")
    assert "main.menu' line 3: found a blank line" in done.stderr and "built-in menu stands in" in done.stderr
    assert "own.help' line 1: V79 has no" in done.stderr
    assert done.stdout.startswith("MAIN > GEOMETRY INTERROGATION"), done.stdout


def test_help_makes_no_project(project):
    project.run("batten", "help", "V79")
    project.run("batten", "help", "curvature")
    assert not os.path.exists(project.path(".batten"))


end.main()
