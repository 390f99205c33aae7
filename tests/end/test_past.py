"""A project of many jobs that ended long ago: they cost nothing until they are asked for, and then all is there."""
import json
import os
import sqlite3
import subprocess
import time

import end

HULL = os.path.join(end.EXAMPLES, "hull.igs") + "#1"
MAP = ("--grid", "20x20")
PAST = 20000
OVER = ("done", "failed", "killed", "lost")


def make_past(project, n=PAST):
    """As many records as n in a ledger of version 1, the last of an hour that is long over; what runs goes on."""
    job, = project.submit("curvature", HULL, *MAP, "-o", "first")
    project.run("batten", "wait", job)
    record = project.jobs()[job]
    project.run("batten", "shutdown")
    db = sqlite3.connect(project.path(".batten", "jobs.db"))
    db.executescript("DROP INDEX live; DROP INDEX over; DROP INDEX grouped; ALTER TABLE jobs DROP COLUMN ended;"
                     "ALTER TABLE jobs DROP COLUMN grp; PRAGMA user_version=1;")
    now = time.time()
    for i in range(2, n + 1):
        state = OVER[i % 4]
        db.execute("INSERT INTO jobs VALUES(?,0,0,?,?)",
                   (i, state, json.dumps(dict(record, id=i, state=state, group=f"g{i % 1000}", output=project.path(f"o{i}"),
                                              outputs=[], reason="of old", submitted=now - 9000 - n + i,
                                              started=now - 8000 - n + i, ended=now - 7200 - n + i))))
    db.commit()
    db.close()


def listed(project, *words):
    return [job["id"] for job in project.json("batten", "jobs", *words)["jobs"]]


def test_the_past_is_there_when_it_is_asked_for(project):
    make_past(project)
    assert listed(project) == [1]
    every = project.json("batten", "jobs", "--all")["jobs"]
    assert [job["id"] for job in every] == list(range(1, PAST + 1))
    keys = set(every[0])
    assert all(set(job) == keys and job["state"] == OVER[job["id"] % 4] for job in every[1:])
    assert project.run("batten", "jobs", "--all").stdout.count("\n") == PAST + 1
    of_group = list(range(7, PAST + 1, 1000))
    assert listed(project, "--group", "g7", "--all") == of_group and listed(project, "--group", "g7") == []
    assert listed(project, "5000", "17") == [17, 5000]
    assert "there is no job 20001" in project.run("batten", "jobs", "20001", status=1).stderr
    assert "there is no group 'none'" in project.run("batten", "jobs", "--group", "none", status=1).stderr
    # 8 is done, 9 failed, 10 was killed
    project.run("batten", "wait", "8")
    project.run("batten", "wait", "9", status=1)
    said = project.run("batten", "wait", "--group", "g7", "--json", status=1).stdout
    assert [job["id"] for job in json.loads(said)["jobs"]] == of_group
    assert listed(project, "--follow", "9") == [9]
    assert "job 8 is done and cannot be" in project.run("batten", "retry", "8", status=1).stderr
    for verb in ("kill", "hold", "suspend"):
        assert "job 9 is failed and cannot be" in project.run("batten", verb, "9", status=1).stderr


def test_the_past_can_go_on(project):
    make_past(project)
    # what waits for jobs of the past: one that is done, one that failed, and that one's any end
    after_done, = project.submit("curvature", HULL, *MAP, "-o", "a", "--after", "8")
    after_failed, = project.submit("curvature", HULL, *MAP, "-o", "b", "--after", "9")
    after_any, = project.submit("curvature", HULL, *MAP, "-o", "c", "--after", "9:any")
    project.run("batten", "wait", after_done, after_any)
    project.run("batten", "wait", after_failed, status=1)
    assert "not run: job 9" in project.jobs(after_failed)[after_failed]["reason"]
    assert "there is no such job" in project.run("batten", "submit", "curvature", HULL, "--after", "30000", status=2).stderr
    # one that failed long ago is tried again, and outlasts the service
    project.run("batten", "hold", "--after-current")
    project.run("batten", "retry", "9")
    end.kill(project.service_pid())
    assert project.jobs("9")[9]["state"] == "held"
    project.run("batten", "release", "--all")
    project.run("batten", "wait", "9")
    assert os.path.exists(project.path("o9.map.exr"))
    # a group: those that failed or were lost, not those that were killed
    project.run("batten", "retry", "--group", "g11")
    project.run("batten", "wait", "--group", "g11")
    project.run("batten", "retry", "--group", "g10", status=None)
    assert project.jobs("10")[10]["state"] == "killed"


def test_prune_forgets_all_of_it_and_nothing_else(project):
    make_past(project)
    for name in ("17.log", "20000.log", "20001.log", "30000.log"):
        open(project.path(".batten", "logs", name), "w").close()
    project.run("batten", "hold", "--after-current")
    waiting, = project.submit("curvature", HULL, *MAP, "-o", "w", "--after", "12")
    assert waiting == PAST + 1
    assert len(project.json("batten", "prune")["jobs"]) == PAST
    assert listed(project, "--all") == [waiting]
    left = {name for name in os.listdir(project.path(".batten", "logs")) if name != "service.log"}
    assert left == {"20001.log"}, left
    project.run("batten", "release", "--all")
    project.run("batten", "wait", waiting)
    assert project.run("batten", "prune").stdout == "1 ended jobs forgotten\n"


def test_a_long_list_comes_as_it_is_read(project):
    """Neither end holds all of it: when the service dies half way, the first half has been printed."""
    make_past(project)
    project.run("batten", "jobs")
    lister = project.start("batten", "jobs", "--all", "--json", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    first = [lister.stdout.readline() for _ in range(3)]
    end.kill(project.service_pid())
    rest, said = lister.communicate(timeout=end.GUARD_S)
    assert lister.returncode == 1 and "the service went away" in said
    assert first[0] == '{"version":1,"jobs":[\n' and [json.loads(line[:-2])["id"] for line in first[1:]] == [1, 2]
    assert rest.count("\n") < PAST / 2
    # what fails before much is there prints nothing
    for words in (["--json"], []):
        done = project.run("batten", "jobs", "1", "2", "30000", *words, status=1)
        assert done.stdout == "" and "there is no job 30000" in done.stderr


def test_a_damaged_record_costs_one_job(project):
    make_past(project, 200)
    project.run("batten", "jobs")  # takes the ledger over
    project.run("batten", "shutdown")
    db = sqlite3.connect(project.path(".batten", "jobs.db"))
    for i, text in {9: "3", 13: "{}", 17: '{"id":17,"state":"failed","outputs":[{}]}', 21: '{"id":21,"state":"running"}',
                    25: '{"id":25,"state":"failed","x":1e999}', 29: '{"id":29,"state":"faile'}.items():
        db.execute("UPDATE jobs SET record=? WHERE id=?", (text, i))
    db.execute("UPDATE jobs SET record=CAST(? AS TEXT) WHERE id=33", (b'{"id":33,"state":"failed","host":"\xf5"}',))
    db.commit()
    db.close()
    damaged = {9, 13, 17, 21, 25, 29, 33}
    jobs = project.jobs()
    assert list(jobs) == list(range(1, 201))
    assert {i for i in jobs if "damaged" in (jobs[i]["reason"] or "")} == damaged
    assert all(jobs[i]["state"] == "lost" for i in damaged)
    assert project.run("batten", "jobs", "--all").stdout.count("\n") == 201
    assert project.run("batten", "jobs").stdout.count("\n") == 2
    project.run("batten", "wait", "13", status=1)


end.main()
