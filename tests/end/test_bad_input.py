"""Bad input ends with a class and a sentence, no output file, no hang, no crash."""
import json
import os

import end

WORKERS = ("contours", "curvature", "isocurvature", "isophotes", "raytrace", "reflection", "shading")

RESULTS = (".exr", ".isophote", ".contour", ".reflect", ".csv", ".png", ".svg", ".part")


def base_of_sphere(project):
    project.run("batten", "import", os.path.join(end.EXAMPLES, "sphere.igs"), "--into", "made")
    (name,) = os.listdir(project.path("made"))
    with open(project.path("made", name)) as f:
        return f.read()


def broken_files(project):
    """Name and text of files that no worker can use."""
    good = base_of_sphere(project)
    lines = good.splitlines()
    knots = next(k for k, line in enumerate(lines) if line.strip().startswith("uknots"))
    yield "empty.base", ""
    yield "garbage.base", "\x01\x02\x03" * 100
    yield "cut.base", good[: len(good) // 2]
    yield "cut.igs", open(os.path.join(end.EXAMPLES, "torus.igs")).read()[:2000]
    yield "nan.base", good.replace(lines[-2].split()[0], "nan", 1)
    yield "knots.base", "\n".join(lines[:knots] + [lines[knots].replace("0", "9", 1)] + lines[knots + 1:])
    yield "order.base", good.replace("order 3", "order 27")


def outputs(project):
    return {name for name in os.listdir(project.folder) if name.endswith(RESULTS)}


def test_broken_files(project):
    for name, text in broken_files(project):
        with open(project.path(name), "w") as f:
            f.write(text)
        for worker in WORKERS:
            done = project.run(f"batten-{worker}", name, status=1)
            assert done.stderr.strip() and not outputs(project), (name, worker, done.stderr)
            assert name in done.stderr, (name, worker, done.stderr)
        done = project.run("batten", "submit", "shading", name, status=1)
        assert name in done.stderr
    project.run("batten-shading", "missing.igs", status=1)


def test_bad_parameters(project):
    torus = os.path.join(end.EXAMPLES, "torus.igs")
    for worker, *bad in (("curvature", "--grid", "0x0"), ("curvature", "--grid", "5"), ("curvature", "--nonsense", "1"),
                         ("shading", "--size", "0x100"), ("shading", "--view", "sideways"), ("shading", "--light", "0,0,0"),
                         ("isophotes", "--angle", "200"), ("isophotes", "--tolerance", "0"), ("isophotes", "--tolerance", "x"),
                         ("contours", "--count", "0"), ("contours", "--plane", "1,0"), ("contours", "--half", "perhaps"),
                         ("isocurvature", "--quantity", "kabs"), ("isocurvature", "--count", "1"), ("reflection", "--kind", "shine"), ("reflection", "--count", "2000"), ("reflection", "--eye", "x"),
                         ("raytrace", "--threads", "0"), ("raytrace", "--size", "nan")):
        done = project.run(f"batten-{worker}", torus, *bad, status=2)
        assert done.stderr.strip() and not outputs(project), (worker, bad, done.stderr)
        done = project.run("batten", "submit", worker, torus, *bad, status=None)
        known_later = bad in (["--light", "0,0,0"], ["--view", "sideways"], ["--tolerance", "0"])  # the worker says
        assert done.returncode == (0 if known_later else 2), (worker, bad, done.stderr)


def test_nowhere_to_write(project):
    torus = os.path.join(end.EXAMPLES, "torus.igs")
    for worker in WORKERS:
        done = project.run(f"batten-{worker}", torus, "-o", "nowhere/x", status=1)
        assert "nowhere" in done.stderr, done.stderr


def test_a_job_file_that_is_none(project):
    for text in ("", "{", "[]", "{}", json.dumps({"version": 99, "id": 1, "worker": "shading"})):
        with open(project.path("job.json"), "w") as f:
            f.write(text)
        done = project.run("batten-shading", "--job", "job.json", status=None)
        assert done.returncode in (1, 2) and done.stderr.strip(), (text, done)


end.main()
