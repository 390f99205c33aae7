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


end.main()
