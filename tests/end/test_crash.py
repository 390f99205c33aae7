"""Whatever is killed, jobs end as they would have, with the same bytes."""
import hashlib
import os
import signal
import time

import end

TEAPOT = os.path.join(end.EXAMPLES, "teapot.igs")
JOB = ("raytrace", TEAPOT, "--size", "1500x1500", "--samples", "3")


def digest(path):
    with open(path, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()


def undisturbed(project):
    project.run("batten-raytrace", *JOB[1:], "-o", "undisturbed")
    return digest(project.path("undisturbed.trace.exr"))


def start(project):
    (job,) = project.submit(*JOB)
    end.until(lambda: project.jobs()[job]["done"], "a unit is done")
    return job


def test_a_killed_worker_fails_and_goes_on_when_retried(project):
    job = start(project)
    pid = project.jobs()[job]["pid"]
    end.kill(pid)
    project.run("batten", "wait", job, status=1)
    j = project.jobs()[job]
    assert j["state"] == "failed" and "signal 9" in j["reason"], j
    project.run("batten", "retry", job)
    project.run("batten", "wait", job)
    assert digest(project.path("teapot.trace.exr")) == undisturbed(project)


def test_a_killed_service_loses_no_job(project):
    job = start(project)
    (held,) = project.submit("shading", TEAPOT, "--size", "32x32", "--after", job)
    worker, service = project.jobs()[job]["pid"], project.service_pid()
    end.kill(service)
    end.until(lambda: end.process_state(worker) in (None, "Z"), "the worker ends with its service")
    jobs = project.jobs()
    assert jobs[job]["state"] in ("queued", "starting", "running"), jobs[job]
    project.run("batten", "wait", job, held)
    assert digest(project.path("teapot.trace.exr")) == undisturbed(project)


def test_a_suspended_job_stays_so_over_a_restart(project):
    job = start(project)
    project.run("batten", "suspend", job)
    end.kill(project.service_pid())
    j = project.jobs()[job]
    assert j["state"] == "suspended" and j["pid"] is None, j
    project.run("batten", "activate", job)
    project.run("batten", "wait", job)
    assert digest(project.path("teapot.trace.exr")) == undisturbed(project)


def test_shutdown_lets_jobs_go_on_at_the_next_start(project):
    job = start(project)
    began = time.monotonic()
    project.run("batten", "shutdown")
    assert time.monotonic() - began < 30
    project.run("batten", "wait", job)
    assert digest(project.path("teapot.trace.exr")) == undisturbed(project)


def test_two_services_never_own_one_folder(project):
    project.run("batten", "jobs")
    done = project.run("batten", "serve", status=1)
    assert str(project.service_pid()) in done.stderr


def test_a_worker_by_hand_goes_on_from_its_part_file(project):
    process = project.start("batten-raytrace", *JOB[1:], "-o", "x")
    end.until(lambda: any(name.endswith(".part") and os.path.getsize(project.path(name)) > 20000
                      for name in os.listdir(project.folder)), "units are in the part file")
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert not os.path.exists(project.path("x.trace.exr"))
    project.run("batten-raytrace", *JOB[1:], "-o", "x", "--threads", "2")
    assert digest(project.path("x.trace.exr")) == undisturbed(project)
    assert not [name for name in os.listdir(project.folder) if name.endswith(".part")]


def test_a_ledger_that_cannot_be_used_says_what_to_do(project):
    project.run("batten", "jobs")
    project.run("batten", "shutdown")
    path = project.path(".batten", "jobs.db")
    end.until(lambda: not os.path.exists(path + "-wal"), "the ledger is closed")
    with open(path, "rb") as f:
        whole = f.read()
    later = bytearray(whole)
    later[60:64] = (9).to_bytes(4, "big")  # SQLite's user_version
    for content, words in ((later, "later batten"), (b"rubbish" * 1000, "put a copy in its place")):
        with open(path, "wb") as f:
            f.write(content)
        said = project.run("batten", "jobs", status=1).stderr
        assert words in said and said.count("\n") == 1, said
    with open(path, "wb") as f:
        f.write(whole)
    project.run("batten", "jobs")


# Writes beside its output as the workers' shared main does, and waits there to be killed.
HALF = """#!/usr/bin/env python3
import json, os, struct, sys, time
if sys.argv[1:] == ["--describe"]:
    print(json.dumps({"name": "half", "title": "half", "version": 1, "parameters": [],
                      "outputs": [{"extension": ".half", "kind": "table", "when": None}]}))
    sys.exit()
def send(kind, **fields):
    text = json.dumps(fields).encode()
    os.write(1, struct.pack("<II", kind, len(text)) + text)
send(1, protocol=1, worker="half")
size = struct.unpack("<II", sys.stdin.buffer.read(8))[1]
job = json.load(open(json.loads(sys.stdin.buffer.read(size))["job"]))
folder, name = os.path.split(job["output"])
for end in ("", ".aB3xYz"):
    open(os.path.join(folder, f".{name}.half.{job['id']}.tmp{end}"), "w").write("half")
send(2, done=1, total=2, phase="writing")
time.sleep(1000)
"""


def test_what_was_half_written_goes_with_its_worker(project):
    folder = project.path(".batten", "workers")
    os.makedirs(folder)
    with open(os.path.join(folder, "batten-half"), "w") as f:
        f.write(HALF)
    os.chmod(f.name, 0o700)
    os.mkdir(project.path("out"))
    kept = {".x.half.999.tmp", ".xy.half.1.tmp", "x.half.1.tmp", ".x.half.1.tmp.other", "x.shade.exr"}
    for name in kept:
        open(project.path("out", name), "w").close()
    there = lambda: set(os.listdir(project.path("out")))
    (job,) = project.submit("half", TEAPOT + "#1", "-o", "out/x")
    assert job == 1
    running = lambda: project.jobs()[job]["done"]
    ways = (lambda: end.kill(project.jobs()[job]["pid"]), lambda: project.run("batten", "kill", job))
    for way in ways:
        end.until(running, "it writes")
        assert len(there()) == len(kept) + 2
        way()
        project.run("batten", "wait", job, status=1)
        assert there() == kept
        project.run("batten", "retry", job)
    end.until(running, "it writes")
    project.run("batten", "suspend", job)
    end.kill(project.service_pid())
    assert project.jobs()[job]["state"] == "suspended"
    assert there() == kept


end.main()
