"""Programs of Slurm that refuse and hang, played by scripts: what is asked for comes to an end, and the state is true."""
import os

import end

TEAPOT = os.path.join(end.EXAMPLES, "teapot.igs")
LONG = ("raytrace", TEAPOT, "--size", "3000x3000", "--samples", "8")  # minutes: it ends by being killed
SRUN = """for a; do case $a in --job-name=*) name=${a#*=};; esac; worker=$a; done
echo $$ >"$PLAYED/$name.pid"; exec "$worker"
"""
SQUEUE = """for f in "$PLAYED"/batten-*.pid; do
    [ -e "$f" ] && kill -0 $(<"$f") 2>/dev/null || continue
    name=$(basename "$f" .pid)
    case "$*" in *--name=*$name*) echo 7 ;; *--name=*) ;; *) echo "$name|7|RUNNING|None" ;; esac
done
"""
SCANCEL = """signal=TERM
for a; do case $a in --signal=*) signal=${a#*=};; esac; done
grep -qx "$signal" "$PLAYED/refused" && exit 1
kill -$signal $(cat "$PLAYED"/batten-*.pid)
"""


def play(project, **programs):
    folder = os.path.join(project.root, "played")
    os.mkdir(folder)
    for name, text in dict({"srun": SRUN, "squeue": SQUEUE, "scancel": SCANCEL, "scontrol": "exit 1"}, **programs).items():
        path = os.path.join(folder, name)
        with open(path, "w") as f:
            f.write("#!/bin/bash\n" + text)
        os.chmod(path, 0o755)
    project.environment.update(PATH=folder + ":" + project.environment["PATH"], PLAYED=folder)


def refuse(project, *signals):
    with open(os.path.join(project.root, "played", "refused"), "w") as f:
        f.write("".join(s + "\n" for s in signals))


def running(project):
    job, = project.submit(*LONG, "--on", "slurm", "-o", "far")
    end.until(lambda: project.jobs()[job]["state"] == "running", "it runs")
    return job


def state(project, job):
    return project.jobs()[job]["state"], project.jobs()[job]["reason"]


def test_an_order_that_is_refused_is_said(project):
    play(project)
    refuse(project, "STOP")
    job = running(project)
    said = project.run("batten", "suspend", job, status=1).stderr
    assert f"job {job} goes on" in said and f"batten log {job}" in said, said
    assert state(project, job) == ("running", None)
    assert "does not take the order" in project.run("batten", "log", job).stdout
    # when it is taken again, all is as ever
    refuse(project, "CONT")
    project.run("batten", "suspend", job)
    assert state(project, job)[0] == "suspended"
    project.run("batten", "activate", job)
    end.until(lambda: state(project, job)[0] == "suspended", "it is seen that it does not go on")
    refuse(project)
    project.run("batten", "activate", job)
    assert state(project, job)[0] == "running"
    project.run("batten", "kill", job)


def test_a_kill_needs_none_of_them(project):
    play(project, scancel="exec sleep 100", squeue="exec sleep 100")
    job = running(project)
    project.run("batten", "kill", job)
    assert state(project, job)[0] == "killed"
    project.run("batten", "shutdown")


end.main()
