"""A job cut into shards: the same bytes as one process, whatever happens to its processes."""
import hashlib
import os
import signal

import end

TEAPOT = os.path.join(end.EXAMPLES, "teapot.igs")
SPHERE = os.path.join(end.EXAMPLES, "sphere.base")
LONG = ("raytrace", TEAPOT, "--size", "900x900", "--samples", "3")


def digest(path):
    with open(path, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()


def workers(project):
    """Processes of this project's workers: those that the service started."""
    found = []
    for pid in map(int, filter(str.isdigit, os.listdir("/proc"))):
        try:
            with open(f"/proc/{pid}/stat") as f:
                parent = int(f.read().rsplit(")", 1)[1].split()[1])
            with open(f"/proc/{pid}/cmdline") as f:
                line = f.read()
        except OSError:
            continue
        if parent == project.service_pid() and "/workers/batten-" in line:
            found.append(pid)
    return found


def start(project, shards=3):
    (job,) = project.submit(*LONG, "--shards", shards, "-o", "cut")
    end.until(lambda: project.jobs()[job]["done"], "a unit is done")
    return job


def same_as_one(project):
    project.run("batten-raytrace", *LONG[1:], "-o", "one")
    assert digest(project.path("cut.trace.exr")) == digest(project.path("one.trace.exr"))
    assert os.listdir(project.path(".batten", "parts")) == []


def test_every_worker_makes_the_same_bytes(project):
    cases = (("curvature", SPHERE, ".map.exr", ("--grid", "40x40")),
             ("contours", SPHERE, ".contour", ("--plane", "1,1,0", "--count", "4")),
             ("isophotes", SPHERE, ".isophote", ("--angle", "40")),
             ("isocurvature", SPHERE, ".isocurvature", ("--quantity", "kn_u", "--level", "-0.3")),
             ("reflection", SPHERE, ".reflect", ("--kind", "highlight", "--count", "3")),
             ("shading", SPHERE, ".shade.exr", ("--size", "64x64")),
             ("raytrace", SPHERE, ".trace.exr", ("--size", "64x64")))
    for worker, path, extension, more in cases:
        project.run("batten", "run", worker, path, *more, "-o", "one")
        one = digest(project.path("one" + extension))
        for shards in (2, 5, 100):  # 100: more than there are units
            name = f"cut{shards}"
            (job,) = project.json("batten", "run", worker, path, *more, "--shards", shards, "-o",
                                  name)["jobs"]
            assert job["state"] == "done" and job["shards"] == shards, job
            assert len(job["outputs"]) == 1, job
            assert digest(project.path(name + extension)) == one, (worker, shards)
    assert os.listdir(project.path(".batten", "parts")) == []


def test_what_is_up_to_date_is_not_done_again(project):
    command = ("run", "shading", SPHERE, "--size", "64x64", "--shards", "3")
    project.run("batten", *command)
    path = project.path("sphere.shade.exr")
    before = os.stat(path)
    (job,) = project.json("batten", *command)["jobs"]
    assert job["state"] == "done" and len(job["outputs"]) == 1, job
    assert os.stat(path).st_mtime_ns == before.st_mtime_ns
    project.run("batten", *command, "--force")
    assert os.stat(path).st_mtime_ns != before.st_mtime_ns


def test_progress_is_the_sum(project):
    project.run("batten", "config", "threads", "1")
    job = start(project)
    seen = []

    def over():
        j = project.jobs()[job]
        if j["total"]:
            seen.append((j["done"], j["total"]))
        return j["state"] == "done"

    end.until(over, "the job is done")
    (one,) = project.json("batten", "run", *LONG, "-o", "one")["jobs"]
    # until each has said how many units it has, the others count as long as the longest
    assert seen[-1][1] == one["total"] and seen[0][1] <= one["total"] + 3, (seen[0], seen[-1])
    assert all(done <= total for done, total in seen), seen
    assert [done for done, _ in seen] == sorted(done for done, _ in seen), seen


def test_a_lost_shard_is_done_again(project):
    job = start(project)
    for pid in workers(project)[:2]:
        end.kill(pid)
    project.run("batten", "wait", job)
    same_as_one(project)
    assert "begun again" in project.run("batten", "log", job).stdout


def test_suspend_activate_and_kill_reach_all(project):
    job = start(project)
    pids = workers(project)
    assert len(pids) == 3, pids
    project.run("batten", "suspend", job)
    assert [end.process_state(pid) for pid in pids] == ["T"] * 3
    assert project.jobs()[job]["state"] == "suspended"
    project.run("batten", "activate", job)
    assert project.jobs()[job]["state"] == "running"
    assert "T" not in [end.process_state(pid) for pid in pids]
    project.run("batten", "kill", job)
    assert project.jobs()[job]["state"] == "killed"
    assert workers(project) == []
    project.run("batten", "retry", job)
    project.run("batten", "wait", job)
    same_as_one(project)


def test_one_stopped_shard_does_not_suspend_the_job(project):
    job = start(project)
    pid = workers(project)[0]
    end.kill(pid, signal.SIGSTOP)
    end.until(lambda: end.process_state(pid) == "T", "it is stopped")
    assert project.jobs()[job]["state"] == "running"
    end.kill(pid, signal.SIGCONT)
    project.run("batten", "wait", job)
    same_as_one(project)


def test_a_killed_service_loses_no_shard(project):
    job = start(project)
    pids = workers(project)
    end.kill(project.service_pid())
    for pid in pids:
        end.until(lambda: end.process_state(pid) in (None, "Z"), "it ends with its service")
    project.run("batten", "wait", job)
    same_as_one(project)


def test_shutdown_stops_all_at_a_unit(project):
    job = start(project)
    project.run("batten", "shutdown")
    project.run("batten", "wait", job)
    same_as_one(project)


def test_a_shard_that_fails_fails_the_job(project):
    (job,) = project.json("batten", "run", "shading", SPHERE, "--size", "64x64", "--shards", "3",
                          "-o", "no/such/folder/x", status=1)["jobs"]
    assert job["state"] == "failed" and "no/such/folder" in job["reason"], job


def test_shards_are_checked(project):
    for n in ("0", "-1", "1025", "x"):
        project.run("batten", "submit", "shading", SPHERE, "--shards", n, status=2)
    done = project.run("batten", "submit", "shading", SPHERE, "--on", "moon", status=2)
    assert "local or slurm" in done.stderr, done.stderr


# The first process of a shard says HELLO and dies; those begun in its place say nothing.
MUTE = """#!/usr/bin/env python3
import json, os, signal, struct, sys, time
if sys.argv[1:] == ["--describe"]:
    print(json.dumps({"name": "mute", "title": "mute", "version": 1, "parameters": [], "shards": True,
                      "outputs": [{"extension": ".mute", "kind": "table", "when": None}]}))
    sys.exit()
def send(kind, **fields):
    text = json.dumps(fields).encode()
    os.write(1, struct.pack("<II", kind, len(text)) + text)
if os.path.exists("again"):
    time.sleep(1000)
send(1, protocol=1, worker="mute")
size = struct.unpack("<II", sys.stdin.buffer.read(8))[1]
if json.load(open(json.loads(sys.stdin.buffer.read(size))["job"]))["shard"][0] == 0:
    while not os.path.exists("again"):
        time.sleep(0.01)
    os.kill(os.getpid(), signal.SIGKILL)
time.sleep(1000)
"""


def test_a_shard_begun_again_must_say_hello_in_time(project):
    os.makedirs(project.path(".batten", "workers"))
    with open(project.path(".batten", "workers", "batten-mute"), "w") as f:
        f.write(MUTE)
    os.chmod(f.name, 0o700)
    project.environment["BATTEN_HELLO_GRACE"] = "2"  # python has to begin in it
    (job,) = project.submit("mute", SPHERE, "--shards", 2, "-o", "x")
    end.until(lambda: project.jobs()[job]["state"] == "running", "all have said HELLO")
    open(project.path("again"), "w").close()
    project.run("batten", "wait", job, status=1)
    j = project.jobs()[job]
    assert j["state"] == "failed" and "no HELLO within" in j["reason"], j


if __name__ == "__main__":
    end.main()
