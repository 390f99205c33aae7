"""What a long night of jobs wants: a hook at the ends, limits, dependencies, the top, a unit for systemd."""
import os

import end

TORUS = os.path.join(end.EXAMPLES, "torus.igs")
TEAPOT = os.path.join(end.EXAMPLES, "teapot.igs")
LONG = ("raytrace", TEAPOT, "--size", "3000x3000", "--samples", "4")


def lines(path):
    return open(path).read().splitlines() if os.path.exists(path) else []


def test_the_hook_runs_at_the_end_of_each_job_and_of_the_group(project):
    said = project.path("said")
    project.run("batten", "config", "hook", f'echo "$BATTEN_EVENT $BATTEN_JOB $BATTEN_STATE $BATTEN_GROUP" >>{said}')
    ids = project.submit("shading", TORUS, "--size", "16x16", "-o", "a", "--group", "g")
    ids += project.submit("shading", TORUS, "--size", "16x16", "-o", "b", "--group", "g", "--after", ids[0])
    project.run("batten", "wait", *ids)
    wanted = {f"job {ids[0]} done g", f"job {ids[1]} done g", f"group {ids[1]} done g"}
    end.until(lambda: wanted <= set(lines(said)), "the hooks ran")  # several at once: in any order


def test_what_hooks_say_fills_no_disk(project):
    """The service's log is cut where it grows too large, whoever writes it."""
    project.run("batten", "config", "hook", "head -c 6000000 /dev/zero | tr '\\0' x >&2; echo '#' >hooked")
    (job,) = project.submit("shading", TORUS, "--size", "16x16", "-o", "a")
    end.until(lambda: lines(project.path("hooked")) == ["#"], "the hook ran, with all its words")
    log = project.path(".batten", "logs", "service.log")
    end.until(lambda: "what stood here was cut" in open(log).read(), "the log is cut")
    assert os.path.getsize(log) < 1000


def on_a_terminal(project, *words):
    """What a verb writes when both its ends are a terminal."""
    leader, follower = end.terminal()
    process = project.start(*words, stdout=follower, stderr=follower)
    os.close(follower)
    said = b""
    while True:
        try:
            piece = os.read(leader, 4096)
        except OSError:  # EIO: the terminal has no other end any more
            piece = b""
        if not piece:
            break
        said += piece
    os.close(leader)
    assert process.wait(end.GUARD_S) == 0, said
    return said


def test_the_bell_rings_at_the_end(project):
    run = ("batten", "run", "shading", TORUS, "--size", "16x16", "-o", "a", "--force")
    assert b"\a" not in on_a_terminal(project, *run)
    project.run("batten", "config", "bell", "on")
    assert on_a_terminal(project, *run).count(b"\a") == 1
    assert on_a_terminal(project, "batten", "wait").count(b"\a") == 1
    assert "\a" not in project.run(*run).stderr


def test_a_job_over_its_wall_time_fails(project):
    (job,) = project.submit(*LONG, "--wall", "0.3")
    project.run("batten", "wait", job, status=1)
    j = project.jobs()[job]
    assert j["state"] == "failed" and "limit of 0.3 s" in j["reason"], j


def test_after_any_end(project):
    (job,) = project.submit(*LONG)
    (later,) = project.submit("shading", TORUS, "--size", "16x16", "--after", f"{job}:any")
    project.run("batten", "kill", job)
    project.run("batten", "wait", later)
    assert project.jobs()[later]["state"] == "done"
    project.run("batten", "submit", "shading", TORUS, "--after", f"{job}:some", status=2)
    project.run("batten", "retry", "--all")
    assert project.jobs()[job]["state"] == "killed"


def states(project, *ids):
    jobs = project.jobs()
    return [jobs[i]["state"] for i in ids]


def test_hold_after_current(project):
    project.run("batten", "config", "jobs", "1")
    (job,) = project.submit(*LONG, "--group", "g")
    end.until(lambda: states(project, job) == ["running"], "it runs")
    small = ("shading", TORUS, "--size", "16x16")
    (inside,) = project.submit(*small, "-o", "a", "--group", "g")
    (outside,) = project.submit(*small, "-o", "b")
    # a group, then a job that is running, an ended one, one by name
    said = project.run("batten", "hold", "--after-current", "--group", "g").stdout
    assert said.split("\n")[:2] == [f"{job} running", f"{inside} held"], said
    assert states(project, job, inside, outside) == ["running", "held", "queued"]
    assert "cannot be held" in project.run("batten", "hold", job, status=1).stderr
    project.run("batten", "hold", "--after-current", job)
    assert states(project, job) == ["running"]
    # the whole queue, what comes too, also after the service died
    found = project.json("batten", "hold", "--after-current")["jobs"]
    assert {j["id"]: j["state"] for j in found} == {job: "running", inside: "held", outside: "held"}
    end.kill(project.service_pid())
    (later,) = project.submit(*small, "-o", "c")
    assert states(project, inside, outside, later) == ["held"] * 3
    assert "batten release --all" in project.jobs()[later]["reason"]
    end.until(lambda: states(project, job) == ["running"], "it goes on")
    project.run("batten", "kill", job)
    assert "cannot be held" in project.run("batten", "hold", "--after-current", job, status=1).stderr
    assert states(project, inside, outside, later) == ["held"] * 3
    project.run("batten", "release", "--all")
    (last,) = project.submit(*small, "-o", "d")
    project.run("batten", "wait", inside, outside, later, last)
    project.run("batten", "hold", "--after-current", "--all", inside, status=2)


def test_no_job_starts_where_its_output_cannot_fit(project):
    project.run("batten", "config", "disk-floor", str(1 << 30))
    (job,) = project.submit("shading", TORUS, "--size", "16x16")
    j = project.jobs()[job]
    assert j["state"] == "queued" and "make room" in j["reason"], j


def test_a_unit_for_systemd(project):
    path = project.run("batten", "serve", "--at-login").stdout.strip()
    text = open(path).read()
    assert f"WorkingDirectory={project.folder}\n" in text and f'ExecStart="{end.BATTEN}" serve\n' in text, text
    link = os.path.join(os.path.dirname(path), "default.target.wants", os.path.basename(path))
    assert os.path.realpath(link) == os.path.realpath(path)
    project.run("batten", "serve", "--not-at-login")
    assert not os.path.exists(path) and not os.path.lexists(link)
    project.run("batten", "serve", "--not-at-login", status=1)


end.main()
