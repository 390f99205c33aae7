"""Where results, ledger and socket go: names of every length, what stands there, modes, folders that are not there."""
import os
import shutil
import stat
import subprocess
import tempfile

import end

HULL = os.path.join(end.EXAMPLES, "hull.igs") + "#1"
MAP = ("--grid", "20x20")
NAME_MAX = 255


def left(folder):
    """What a worker wrote on its way and did not take away."""
    return [name for name in os.listdir(folder) if name.endswith((".tmp", ".part"))]


def mode(path):
    return stat.S_IMODE(os.stat(path).st_mode)


def masked(project, mask):
    """The project as one with that umask would use it."""
    run = subprocess.run
    return lambda *words: run(project.command(words), cwd=project.folder, env=project.environment, umask=mask,
                              check=True, capture_output=True, text=True)


def test_names_of_every_length(project):
    for n in (95, 96, 97, 150, 230, 238, 242, 245, 246, 247):
        for letter in ("x", "é"):
            base = letter * (n // len(letter.encode()))
            name = base + ".map.exr"
            project.run("batten-curvature", HULL, *MAP, "--png", "-o", base)
            by_hand = open(project.path(name), "rb").read()
            os.unlink(project.path(name))
            project.run("batten", "run", "curvature", HULL, *MAP, "--png", "-o", base)
            assert open(project.path(name), "rb").read() == by_hand
            project.run("batten", "run", "isophotes", HULL, "--angle", "30", "-o", base[:100])
    assert not left(project.folder), left(project.folder)


def test_a_name_too_long_is_refused_at_once(project):
    base = "x" * (NAME_MAX - len(".map.exr"))
    project.run("batten-curvature", HULL, *MAP, "-o", base)
    for words in (("batten-curvature",), ("batten", "submit", "curvature")):
        said = project.run(*words, HULL, *MAP, "-o", base + "x", status=2).stderr
        assert "256" in said and "255 are the most" in said, said
    assert not project.jobs()


def test_names_that_are_not_utf8_are_refused(project):
    """A record of a job is JSON: such names are refused with a sentence, before anything is read or written."""
    def said(folder, *words, status):
        done = subprocess.run(project.command(words), cwd=folder, env=project.environment, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=end.GUARD_S)
        assert done.returncode == status, (words, done)
        return done.stderr

    bad = os.fsencode(project.root) + b"/bad\xff"
    os.mkdir(bad)
    for words in (("run", "curvature", HULL, *MAP), ("submit", "curvature", HULL, *MAP), ("jobs",), ("jobs", "--json"),
                  ("kill", "--all"), ("serve",)):
        assert b"bad\xff' is not UTF-8" in said(bad, "batten", *words, status=1), words
    assert not os.listdir(bad), os.listdir(bad)
    shutil.copy(os.path.join(end.EXAMPLES, "hull.igs"), bad + b"/h.igs")
    for words in ((os.fsdecode(bad) + "/h.igs#1", *MAP), (HULL, *MAP, "-o", "\udcff"), (HULL, "--grid", "\udcff"),
                  (HULL, *MAP, "--group", "\udcff"), (HULL, *MAP, "-o", os.fsdecode(bad) + "/x")):
        assert b"is not UTF-8" in said(project.folder, "batten", "submit", "curvature", *words, status=2), words
    assert not project.jobs()


def test_folders_of_odd_names(project):
    for name in ("line\nbreak", "quo\"te'\\", "x" * 200, "h\x01\x7fé"):
        folder = os.path.join(project.root, name)
        os.mkdir(folder)
        project.folder = folder
        (done,) = project.submit("curvature", HULL, *MAP, "-o", "done")
        (bad,) = project.submit("curvature", HULL, *MAP, "-o", "none/at/all")
        project.run("batten", "wait", status=None)
        for turn in range(2):  # the second: read again from the ledger
            jobs = project.jobs()
            assert jobs[done]["state"] == "done", jobs
            assert jobs[done]["output"] == project.path("done")
            assert jobs[done]["log"] == project.path(".batten", "logs", f"{done}.log")
            assert "done.map.exr" in project.run("batten", "log", done).stdout
            project.run("batten", "shutdown")
        assert os.path.exists(project.path("done.map.exr"))
        if jobs[bad]["state"] == "failed":
            project.run("batten", "retry", bad)
            project.run("batten", "wait", bad, status=None)
            assert project.jobs()[bad]["state"] == "failed"
        project.run("batten", "shutdown")


def test_names_that_name_nothing(project):
    for name in ("", ".", "..", "folder/", "a/.."):
        for words in (("batten-curvature",), ("batten", "submit", "curvature")):
            said = project.run(*words, HULL, *MAP, "-o", name, status=2).stderr
            assert "names no file" in said, said
    assert os.listdir(os.path.dirname(project.folder)).count("project.map.exr") == 0


def test_what_stands_in_the_place(project):
    def refused(text, *more):
        for words in (("batten-curvature",), ("batten", "run", "curvature")):
            said = project.run(*words, HULL, *MAP, "-o", "there", *more, status=1).stderr
            assert text in said, said
        assert not left(project.folder), left(project.folder)

    os.mkdir(project.path("there.map.exr"))
    refused("a folder stands there")
    os.rmdir(project.path("there.map.exr"))
    os.mkfifo(project.path("there.map.png"))
    refused("what is no file stands there", "--png")
    os.unlink(project.path("there.map.png"))
    with open(project.path("there.map.exr"), "w") as f:
        f.write("kept")
    os.chmod(project.path("there.map.exr"), 0o444)
    refused("the file there is read-only")
    refused("the file there is read-only", "--force")
    assert open(project.path("there.map.exr")).read() == "kept"
    os.chmod(project.path("there.map.exr"), 0o644)
    project.run("batten", "run", "curvature", HULL, *MAP, "-o", "there")
    # one that is up to date is not written, so it may be read-only
    os.chmod(project.path("there.map.exr"), 0o444)
    project.run("batten", "run", "curvature", HULL, *MAP, "-o", "there")


def test_a_link_gives_way_and_what_it_names_is_kept(project):
    with open(project.path("target"), "w") as f:
        f.write("kept")
    for name, target in (("a", "target"), ("b", "nowhere"), ("c", "c.map.exr")):
        os.symlink(target, project.path(name + ".map.exr"))
        project.run("batten", "run", "curvature", HULL, *MAP, "-o", name)
        assert not os.path.islink(project.path(name + ".map.exr"))
    assert open(project.path("target")).read() == "kept"
    assert not os.path.exists(project.path("nowhere"))


def test_results_have_the_mode_of_who_asked(project):
    masked(project, 0o022)("batten", "jobs")  # the service is of this one
    for mask in (0o022, 0o077, 0o002, 0o027):
        run, want = masked(project, mask), 0o666 & ~mask
        by_hand, job, retried = f"hand{mask:o}", f"job{mask:o}", f"again{mask:o}"
        run("batten-curvature", HULL, *MAP, "--png", "-o", by_hand)
        run("batten", "run", "curvature", HULL, *MAP, "--png", "-o", job)
        run("batten", "run", "isophotes", HULL, "--angle", "30", "-o", job)
        (held,) = project.submit("curvature", HULL, *MAP, "-o", "x")
        project.run("batten", "wait", held)
        for name in (by_hand + ".map.exr", by_hand + ".map.png", job + ".map.exr", job + ".map.png",
                     job + ".isophote"):
            assert mode(project.path(name)) == want, (name, oct(mode(project.path(name))), oct(want))
        # over an end of the service, too
        run("batten", "submit", "curvature", HULL, *MAP, "-o", retried, "--after", held)
        end.kill(project.service_pid())
        project.run("batten", "wait")
        assert mode(project.path(retried + ".map.exr")) == want, retried


def test_shutdown_returns_when_the_service_is_gone(project):
    for turn in range(10):
        ids = project.submit("curvature", os.path.join(end.EXAMPLES, "teapot.igs"), "--grid", f"{40 + turn}x40",
                             "-o", f"t{turn}")
        pid = project.service_pid()
        project.run("batten", "shutdown")
        assert end.process_state(pid) in (None, "Z"), "the service is there after its shutdown"
        # SQLite takes its log away when it closes the ledger
        assert not os.path.exists(project.path(".batten", "jobs.db-wal"))
        assert ids
    project.run("batten", "wait")


def test_one_project_by_two_paths(project):
    link = os.path.join(project.root, "link")
    os.symlink(project.folder, link)
    other = os.path.join(project.root, "other")
    os.mkdir(other)
    project.submit("curvature", HULL, *MAP)
    os.symlink(project.path(".batten"), os.path.join(other, ".batten"))
    pid = project.service_pid()
    for folder in (link, other):
        said = subprocess.run([end.BATTEN, "jobs", "--json"], cwd=folder, env=dict(project.environment, PWD=folder),
                              capture_output=True, text=True, check=True).stdout
        assert '"id":1' in said, said
        assert project.service_pid() == pid
    project.run("batten", "wait")


def test_environments_that_lack_something(project):
    file = os.path.join(project.root, "file")
    open(file, "w").close()
    usual = dict(project.environment)
    for k, more in enumerate(({"TMPDIR": "/no/such"}, {"XDG_RUNTIME_DIR": "/no/such"}, {"XDG_RUNTIME_DIR": ""},
                              {"XDG_RUNTIME_DIR": file}, {"XDG_RUNTIME_DIR": "not/absolute"},
                              {"XDG_CONFIG_HOME": "/no/such", "HOME": "/no/such"})):
        project.environment = dict(usual, **more)
        project.run("batten", "run", "curvature", HULL, *MAP, "-o", f"r{k}")
        # one with the usual environment finds the service that the other one began
        project.environment = usual
        pid = project.service_pid()
        assert len(project.jobs()) == k + 1 and project.service_pid() == pid
        project.run("batten", "shutdown")


def test_a_runtime_folder_that_takes_nothing(project):
    """Root may write anywhere, so somebody else is asked."""
    nobody = 65534
    if os.geteuid() != 0 or not shutil.which("setpriv"):
        raise end.Skip("needs root and setpriv")
    if not subprocess.run(["setpriv", f"--reuid={nobody}", "--clear-groups", "test", "-x", end.BATTEN]).returncode == 0:
        raise end.Skip("nobody may not run the program where it lies")
    root = tempfile.mkdtemp(prefix="batten-end-")
    try:
        run, folder = os.path.join(root, "run"), os.path.join(root, "project")
        os.mkdir(run)
        os.mkdir(folder)
        os.chown(folder, nobody, nobody)
        for path, bits in ((root, 0o755), (run, 0o555), (folder, 0o755)):
            os.chmod(path, bits)
        setpriv = ["setpriv", f"--reuid={nobody}", f"--regid={nobody}", "--clear-groups"]
        for words in (["run", "curvature", os.path.join(end.EXAMPLES, "hull.base") + "#1", *MAP], ["shutdown"]):
            done = subprocess.run([*setpriv, end.BATTEN, *words], cwd=folder, capture_output=True, text=True,
                                  env=dict(project.environment, XDG_RUNTIME_DIR=run))
            assert done.returncode == 0, done.stderr
        assert os.path.exists(os.path.join(folder, "hull.map.exr"))
    finally:
        shutil.rmtree(root, ignore_errors=True)


def test_a_deep_folder(project):
    """Deeper than a socket's name, than SQLite's names, nearly as deep as names can be."""
    for deep in (150, 600, 3600):
        path = os.path.join(project.root, f"deep{deep}")
        while len(path) < deep - 200:
            path = os.path.join(path, "d" * 200)
        os.makedirs(path)
        done = []
        for words in (["run", "curvature", HULL, *MAP], ["jobs", "--json"], ["shutdown"], ["jobs", "--json"], ["shutdown"]):
            done.append(subprocess.run([end.BATTEN, *words], cwd=path, env=project.environment, capture_output=True,
                                       text=True))
            assert done[-1].returncode == 0, (deep, words, done[-1].stderr[-300:])
        assert '"state":"done"' in done[3].stdout
        assert os.path.exists(os.path.join(path, ".batten", "jobs.db"))
        assert os.path.exists(os.path.join(path, "hull.map.exr"))


def test_a_place_without_a_disk(project):
    """There is no room to be told of in /proc, and no job waits for it."""
    said = project.run("batten", "run", "curvature", HULL, *MAP, "-o", "/proc/r", status=1).stderr
    assert "cannot write" in said, said


end.main()
