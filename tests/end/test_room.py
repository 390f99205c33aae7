"""On a disk too small for its output a job does not do its work in vain: it says how much room it wants."""
import ctypes
import filecmp
import os
import re
import subprocess

import end

HULL = os.path.join(end.EXAMPLES, "hull.igs") + "#1"
MAP = ("--grid", "1000x800")  # 22 MB; the part file becomes the output
CLONE_NEWNS = 0x20000


def small_disk(project, mib):
    """A disk of its own, in mounts of our own."""
    libc = ctypes.CDLL(None, use_errno=True)
    folder = os.path.join(project.root, "disk")
    if os.geteuid() != 0 or libc.unshare(CLONE_NEWNS):
        raise end.Skip("no disk is made small: that takes a mount, and root")
    os.mkdir(folder)
    for words in (("--make-rprivate", "/"), ("-t", "tmpfs", "-o", f"size={mib}m", "none", folder)):
        if subprocess.run(["mount", *words], capture_output=True).returncode:
            raise end.Skip("no disk is made small: mount refuses")
    return folder


def grow(folder, mib):
    subprocess.run(["mount", "-o", f"remount,size={mib}m", folder], check=True)


def wanted(text):
    """As said: MiB wanted and MiB free."""
    found = re.search(r"not enough room: about ([0-9]+) MiB more are wanted in '[^']*' and ([0-9]+) MiB are free", text)
    assert found, text
    return int(found[1]), int(found[2])


def test_by_hand(project):
    disk = small_disk(project, 15)
    project.run("batten-curvature", HULL, *MAP, "-o", "whole")
    there = os.path.join(disk, "small")
    try:
        said = project.run("batten-curvature", HULL, *MAP, "-o", there, status=1).stderr
        more, free = wanted(said)
        size = os.path.getsize(project.path("whole.map.exr")) / (1 << 20)
        assert 0.85 * size < more < 1.1 * size and 12 <= free <= 15, (said, size)
        parts = sorted(os.listdir(disk))  # tiles from all over were done first, to know what all take
        assert parts == ["small.map.exr.part", "small.map.exr.part.ahead"], parts
        assert sum(os.path.getsize(os.path.join(disk, name)) for name in parts) < (4 << 20)  # found out early
        grow(disk, 30)
        assert "going on" in project.run("batten-curvature", HULL, *MAP, "-o", there).stderr
        assert filecmp.cmp(there + ".map.exr", project.path("whole.map.exr"), shallow=False)
        assert os.listdir(disk) == ["small.map.exr"]
    finally:
        subprocess.run(["umount", "-l", disk])


def test_as_a_job(project):
    disk = small_disk(project, 16)
    project.run("batten", "config", "disk-floor", "4")
    try:
        (job,) = project.submit("curvature", HULL, *MAP, "-o", os.path.join(disk, "small"))
        project.run("batten", "wait", job, status=1)
        j = project.jobs()[job]
        more, free = wanted(j["reason"])
        assert more > free and not os.listdir(disk), j
        grow(disk, 60)
        project.run("batten", "retry", job)
        project.run("batten", "wait", job)
        j = project.jobs()[job]
        assert j["bytes"] == os.path.getsize(os.path.join(disk, "small.map.exr")), j
        # one like it is not begun where that much is not left
        grow(disk, 40)
        (later,) = project.submit("curvature", HULL, *MAP, "-o", os.path.join(disk, "other"))
        j = project.jobs()[later]
        assert j["state"] == "queued" and "by what its like took" in j["reason"], j
        grow(disk, 80)
        project.run("batten", "wait", later)
    finally:
        subprocess.run(["umount", "-l", disk])


end.main()
