"""Jobs on a Slurm cluster of two nodes, made for the test on this machine."""
import atexit
import hashlib
import os
import shutil
import tempfile

import cluster
import end

TEAPOT = os.path.join(end.EXAMPLES, "teapot.igs")
SPHERE = os.path.join(end.EXAMPLES, "sphere.base")
LONG = ("raytrace", TEAPOT, "--size", "900x900", "--samples", "3")
there = None


def with_cluster(project):
    """The two nodes, started by the first test that needs them."""
    global there
    if not there:
        folder = tempfile.mkdtemp(prefix="batten-slurm-")
        try:
            there = cluster.Cluster(folder, nodes=2, cpus=2)
        except cluster.Missing as why:
            shutil.rmtree(folder)
            raise end.Skip(str(why))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        atexit.register(there.stop)
    project.environment["SLURM_CONF"] = there.environment["SLURM_CONF"]
    return there


def digest(path):
    with open(path, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()


def start(project, *more):
    (job,) = project.submit(*LONG, "--on", "slurm", "-o", "far", *more)
    end.until(lambda: project.jobs()[job]["done"], "a unit is done")
    return job


def same_as_here(project):
    project.run("batten-raytrace", *LONG[1:], "-o", "here")
    assert digest(project.path("far.trace.exr")) == digest(project.path("here.trace.exr"))
    assert os.listdir(project.path(".batten", "parts")) == []


def ours(slurm):
    return [line for line in slurm.queue() if " batten-" in line and "COMPLETING" not in line]


def remote_workers(slurm):
    """On this one machine they can be seen: those that a slurmstepd started."""
    conf = ("SLURM_CONF=" + slurm.environment["SLURM_CONF"]).encode()
    found = []
    for pid in map(int, filter(str.isdigit, os.listdir("/proc"))):
        try:
            with open(f"/proc/{pid}/environ", "rb") as f:
                environment = f.read().split(b"\0")
            with open(f"/proc/{pid}/comm") as f:
                name = f.read()
        except OSError:
            continue
        if name.startswith("batten-") and conf in environment \
                and any(e.startswith(b"SLURMD_NODENAME=") for e in environment):
            found.append(pid)
    return found


class Full:
    """Both nodes taken by somebody else."""

    def __init__(self, slurm):
        self.slurm = slurm
        self.others = [slurm.start_program("srun", "--quiet", "--exclusive", "--nodes=1",
                                   "--job-name=other", "sleep", "600") for _ in range(2)]
        slurm.until(lambda: sum("other RUNNING" in line for line in slurm.queue()) == 2,
                    "the nodes are taken")

    def __enter__(self):
        return self

    def __exit__(self, *why):
        self.slurm.run("scancel", "--name=other")
        for other in self.others:
            other.wait()


def test_a_job_runs_on_a_node(project):
    slurm = with_cluster(project)
    (job,) = project.json("batten", "run", *LONG, "--on", "slurm", "-o", "far")["jobs"]
    assert job["state"] == "done" and job["on"] == "slurm", job
    assert job["host"] in ("n1", "n2"), job
    assert job["cpu_s"] > 0 and job["peak_kib"] > 0, job
    same_as_here(project)
    assert ours(slurm) == []


def test_the_setting_says_where(project):
    with_cluster(project)
    project.run("batten", "config", "launcher", "slurm")
    (job,) = project.json("batten", "run", "shading", SPHERE, "--size", "32x32")["jobs"]
    assert job["state"] == "done" and job["on"] == "slurm", job
    (job,) = project.json("batten", "run", "shading", SPHERE, "--size", "33x33", "--on",
                          "local")["jobs"]
    assert job["on"] == "local" and not job["host"] in ("n1", "n2"), job


def test_shards_run_on_several_nodes(project):
    slurm = with_cluster(project)
    job = start(project, "--shards", "4")
    project.run("batten", "wait", job)
    assert sorted(project.jobs()[job]["host"].split(",")) == ["n1", "n2"], project.jobs()[job]
    same_as_here(project)
    assert ours(slurm) == []


def test_suspend_activate_and_kill_reach_the_node(project):
    slurm = with_cluster(project)
    job = start(project, "--shards", "2")
    pids = remote_workers(slurm)
    assert len(pids) == 2, pids
    project.run("batten", "suspend", job)
    assert project.jobs()[job]["state"] == "suspended"
    for pid in pids:
        end.until(lambda: end.process_state(pid) == "T", "the worker is stopped")
    project.run("batten", "activate", job)
    for pid in pids:
        end.until(lambda: end.process_state(pid) != "T", "the worker goes on")
    project.run("batten", "kill", job)
    assert project.jobs()[job]["state"] == "killed"
    end.until(lambda: not remote_workers(slurm) and not ours(slurm), "nothing is left")
    project.run("batten", "retry", job)
    project.run("batten", "wait", job)
    same_as_here(project)


def test_orders_on_each_others_heels(project):
    """Slurm takes no signal while the one before is on its way: it is given again."""
    slurm = with_cluster(project)
    for _ in range(8):
        job = start(project)
        project.run("batten", "suspend", job)
        project.run("batten", "kill", job)
        assert project.jobs()[job]["state"] == "killed"
        end.until(lambda: not remote_workers(slurm) and not ours(slurm), "nothing is left")
    (job,) = project.submit("raytrace", TEAPOT, "--size", "4000x4000", "--on", "slurm")
    (worker,) = end.until(lambda: project.jobs()[job]["done"] and remote_workers(slurm), "it runs")
    for _ in range(4):
        project.run("batten", "suspend", job)
        project.run("batten", "activate", job)
    end.until(lambda: end.process_state(worker) != "T", "it goes on")
    assert project.jobs()[job]["state"] == "running"
    project.run("batten", "suspend", job)
    end.until(lambda: end.process_state(worker) == "T", "it is stopped")
    assert "does not take" not in project.run("batten", "log", job).stdout
    project.run("batten", "kill", job)


def test_why_it_waits_is_said(project):
    slurm = with_cluster(project)
    with Full(slurm):
        (job, ) = project.submit("shading", SPHERE, "--size", "32x32", "--on", "slurm")
        end.until(lambda: "waits: " in (project.jobs()[job]["reason"] or ""), "the reason")
        assert project.jobs()[job]["state"] == "starting"
        # the slots of this machine are free for others
        project.run("batten", "run", "shading", SPHERE, "--size", "33x33", "-o", "other")
    project.run("batten", "wait", job)
    assert project.jobs()[job]["reason"] is None


def test_one_that_waits_is_suspended_and_activated(project):
    slurm = with_cluster(project)
    with Full(slurm):
        (job, ) = project.submit("shading", SPHERE, "--size", "32x32", "--on", "slurm")
        end.until(lambda: "waits: " in (project.jobs()[job]["reason"] or ""), "the reason")
        project.run("batten", "suspend", job)
        assert project.jobs()[job]["state"] == "suspended"
    end.until(lambda: not [line for line in slurm.queue() if "other" in line], "nodes are free")
    assert "JobHeld" in ours(slurm)[0], slurm.queue()
    project.run("batten", "activate", job)
    project.run("batten", "wait", job)


def test_one_that_waits_is_killed(project):
    slurm = with_cluster(project)
    with Full(slurm):
        (job, ) = project.submit("shading", SPHERE, "--size", "32x32", "--on", "slurm")
        end.until(lambda: ours(slurm), "it is in Slurm's queue")
        project.run("batten", "kill", job)
        assert project.jobs()[job]["state"] == "killed"
        end.until(lambda: not ours(slurm), "it is out of Slurm's queue")


def test_a_lost_node_costs_no_unit(project):
    slurm = with_cluster(project)
    job = start(project)
    node = project.jobs()[job]["host"]
    slurm.run("scontrol", "update", "nodename=" + node, "state=down", "reason=test")
    project.run("batten", "wait", job)
    log = project.run("batten", "log", job).stdout
    assert "Node failure on " + node in log and "going on: " in log, log
    slurm.run("scontrol", "update", "nodename=" + node, "state=resume")
    slurm.until(lambda: slurm.states() == ["idle", "idle"], "the node is back")
    same_as_here(project)


def test_a_lost_shard_is_done_again(project):
    slurm = with_cluster(project)
    job = start(project, "--shards", "3")
    end.kill(remote_workers(slurm)[0])
    project.run("batten", "wait", job)
    assert "begun again" in project.run("batten", "log", job).stdout
    same_as_here(project)


def test_a_killed_srun_costs_no_unit(project):
    slurm = with_cluster(project)
    job = start(project)
    end.kill(project.jobs()[job]["pid"])
    project.run("batten", "wait", job)
    assert project.jobs()[job]["state"] == "done"
    same_as_here(project)
    end.until(lambda: not ours(slurm), "nothing is left in Slurm")


def test_three_lost_processes_are_a_lost_job(project):
    with_cluster(project)
    job = start(project)
    for _ in range(3):
        pid = end.until(lambda: project.jobs()[job]["state"] == "running"
                        and project.jobs()[job]["pid"], "it runs")
        end.kill(pid)
        end.until(lambda: project.jobs()[job]["pid"] != pid, "it is seen")
    project.run("batten", "wait", job, status=1)
    j = project.jobs()[job]
    assert j["state"] == "lost" and "srun" in j["reason"] and "3 times" in j["reason"], j
    project.run("batten", "retry", job)
    project.run("batten", "wait", job)
    same_as_here(project)


def test_a_killed_service_leaves_no_orphan(project):
    slurm = with_cluster(project)
    job = start(project)
    end.kill(project.service_pid())
    project.run("batten", "wait", job)
    same_as_here(project)
    with Full(slurm):
        (waiting, ) = project.submit("shading", SPHERE, "--size", "32x32", "--on", "slurm")
        end.until(lambda: ours(slurm), "it is in Slurm's queue")
        (ghost, ) = ours(slurm)
        end.kill(project.service_pid())
        project.run("batten", "jobs")
        end.until(lambda: ghost.split()[0] not in [line.split()[0] for line in ours(slurm)],
                  "what the dead service asked for is gone")
    project.run("batten", "wait", waiting)


def test_shutdown_leaves_nothing_in_slurm(project):
    slurm = with_cluster(project)
    job = start(project, "--shards", "2")
    project.run("batten", "shutdown")
    end.until(lambda: not ours(slurm) and not remote_workers(slurm), "nothing is left")
    project.run("batten", "wait", job)
    same_as_here(project)


def test_what_slurm_refuses_says_why(project):
    slurm = with_cluster(project)
    # srun may end before its start has been seen, so it is asked several times
    for option, value, why in (("--partition", "nope", "Invalid partition"),
                               *(("--time", "nope", "--time"), ) * 8):
        (job,) = project.json("batten", "run", "shading", SPHERE, "--size", "32x32", "--on",
                              "slurm", option, value, status=1)["jobs"]
        assert job["state"] == "failed" and why in job["reason"], job
    job = start(project)
    slurm.run("scancel", "--user=root")
    project.run("batten", "wait", job, status=1)
    assert "cancelled in Slurm" in project.jobs()[job]["reason"], project.jobs()[job]


def test_without_slurm_it_is_said(project):
    project.environment["PATH"] = "/nonexistent"
    done = project.run("batten", "submit", "shading", SPHERE, "--on", "slurm", status=1)
    assert "srun" in done.stderr and "--on local" in done.stderr, done.stderr


if __name__ == "__main__":
    end.main()
