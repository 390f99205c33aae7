"""The main job from the command line: submitted, followed, steered, done again, and refused."""
import json
import os
import signal
import subprocess

import end

TORUS = os.path.join(end.EXAMPLES, "torus.igs")
TEAPOT = os.path.join(end.EXAMPLES, "teapot.igs")
WORKERS = {"shading": ".shade.exr", "curvature": ".map.exr", "isophotes": ".isophote", "raytrace": ".trace.exr",
           "contours": ".contour", "reflection": ".reflect", "isocurvature": ".isocurvature"}
DRAWN = ("isophotes", "contours", "reflection", "isocurvature")
LONG = ("raytrace", TEAPOT, "--size", "3000x3000", "--samples", "4")


def start_long(project, **more):
    (job,) = project.submit(*LONG)
    end.until(lambda: project.jobs()[job]["state"] == "running" and project.jobs()[job]["done"], "a unit is done")
    return job


def test_all_workers_at_once(project):
    ids = {name: project.submit(name, TORUS, *(("--svg",) if name in DRAWN else ("--png",)))
           for name in WORKERS}
    project.run("batten", "wait")
    jobs = project.jobs()
    for name, extension in WORKERS.items():
        for job in ids[name]:
            j = jobs[job]
            assert j["state"] == "done" and j["fraction"] == 1 and j["color"] == "#74E695", j
            assert j["wall_s"] >= 0 and j["cpu_s"] >= 0 and j["peak_kib"] > 0 and j["reason"] is None, j
            first = j["outputs"][0]
            assert first["path"].endswith(extension) and first["figures"], j
            assert all(os.path.getsize(o["path"]) for o in j["outputs"]) and len(j["outputs"]) > 1
    assert not os.listdir(project.path(".batten", "parts"))


def test_run_follows_to_the_end(project):
    o = project.json("batten", "run", "shading", TORUS, "--size", "64x48", "-o", "picture")
    (job,) = o["jobs"]
    assert job["state"] == "done" and job["outputs"][0]["path"] == project.path("picture.shade.exr")
    done = project.run("batten", "run", "shading", TORUS, "--size", "64x48", "-o", "picture.shade.exr")
    assert done.stdout == project.path("picture.shade.exr") + "\n"
    assert "done" in done.stderr


def test_what_is_up_to_date_is_not_done_again(project):
    make = ("batten", "run", "curvature", TORUS, "--grid", "50x40", "-o", "m")
    first = project.json(*make)["jobs"][0]
    before = os.stat(project.path("m.map.exr"))
    second = project.json(*make)["jobs"][0]
    assert os.stat(project.path("m.map.exr")).st_mtime_ns == before.st_mtime_ns
    assert second["outputs"][0]["figures"] == first["outputs"][0]["figures"]
    project.json(*make, "--force")
    assert os.stat(project.path("m.map.exr")).st_mtime_ns > before.st_mtime_ns


def test_a_file_of_many_surfaces_makes_a_group(project):
    ids = project.submit("curvature", TEAPOT, "--grid", "8x8")
    assert len(ids) == 32
    group = {job["group"] for job in project.jobs().values()}
    assert len(group) == 1 and None not in group
    project.run("batten", "wait", "--group", group.pop())
    assert os.path.exists(project.path("teapot-1.map.exr")) and os.path.exists(project.path("teapot-32.map.exr"))


def test_suspend_activate_and_kill(project):
    job = start_long(project)
    pid = project.jobs()[job]["pid"]
    assert project.run("batten", "suspend", job).stdout.split() == [str(job), "suspended"]
    assert end.process_state(pid) == "T"
    assert project.jobs()[job]["state"] == "suspended"
    project.run("batten", "activate", job)
    assert end.process_state(pid) in ("R", "S")
    project.run("batten", "suspend", job)
    project.run("batten", "kill", job)
    assert end.process_state(pid) is None
    j = project.jobs()[job]
    assert j["state"] == "killed" and j["reason"], j
    assert not os.path.exists(project.path("teapot.trace.exr"))
    assert os.listdir(project.path(".batten", "parts"))


def test_hold_release_and_after(project):
    project.run("batten", "config", "jobs", "1")
    long_job = start_long(project)
    (a,) = project.submit("shading", TORUS, "--size", "32x32", "-o", "a")
    (b,) = project.submit("shading", TORUS, "--size", "32x32", "-o", "b", "--after", a)
    jobs = project.jobs()
    assert jobs[a]["state"] == "queued" and "slots" in jobs[a]["reason"], jobs[a]
    assert jobs[b]["reason"] and str(a) in jobs[b]["reason"], jobs[b]
    assert project.run("batten", "hold", a).stdout.split()[1] == "held"
    project.run("batten", "kill", long_job)
    assert project.jobs()[a]["state"] == "held"
    project.run("batten", "release", a)
    project.run("batten", "wait", a, b)
    jobs = project.jobs()
    assert jobs[a]["state"] == jobs[b]["state"] == "done"
    assert jobs[a]["ended"] <= jobs[b]["started"]


def test_wait_tells_how_it_went(project):
    job = start_long(project)
    project.run("batten", "wait", job, "--timeout", "0.05", status=124)
    project.run("batten", "kill", job)
    project.run("batten", "wait", job, status=1)


def test_ctrl_c_kills_and_the_job_can_be_retried(project):
    process = project.start("batten", "run", *LONG, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    end.until(lambda: any(j["state"] == "running" for j in project.jobs().values()), "it runs")
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130, process.returncode
    (job,) = project.jobs()
    assert project.jobs()[job]["state"] == "killed"
    project.run("batten", "retry", job)
    end.until(lambda: project.jobs()[job]["state"] == "running", "it runs again")
    project.run("batten", "kill", job)


def test_a_lost_terminal_leaves_the_job_running(project):
    process = project.start("batten", "run", *LONG, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    (job,) = end.until(lambda: [k for k, j in project.jobs().items() if j["state"] == "running"], "it runs")
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=60)
    assert project.jobs()[job]["state"] == "running"
    project.run("batten", "kill", job)


def test_a_failed_job_says_why(project):
    o = project.json("batten", "run", "shading", TORUS, "-o", "nowhere/x", status=1)
    (job,) = o["jobs"]
    assert job["state"] == "failed" and "nowhere" in job["reason"], job
    project.run("batten", "log", job["id"])


def test_prune_forgets_what_ended(project):
    (job,) = project.submit("shading", TORUS, "--size", "32x32")
    project.run("batten", "wait", job)
    for name in os.listdir(project.path(".batten", "inputs")):
        os.utime(project.path(".batten", "inputs", name), (0, 0))  # a young one may be about to be submitted
    project.run("batten", "prune")
    assert not project.jobs()
    assert not os.listdir(project.path(".batten", "inputs")) and os.path.exists(project.path("torus.shade.exr"))


end.main()
