"""trial.py - one project under faults: its jobs, its clients, and what must be true of it.

What a job makes is known beforehand: each kind was run once, undisturbed and by hand.
"""
import collections
import ctypes
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "end"))
import end

# kind: worker, input, parameters
KINDS = {
    "shade": ("shading", "hull.igs", ("--size", "900x700")),
    "map": ("curvature", "torus.igs", ("--grid", "1200x1000")),
    "iso": ("isophotes", "wigley.base", ()),
    "trace": ("raytrace", "teapot.igs", ("--size", "400x300", "--samples", "3")),
    "trace2": ("raytrace", "torus.igs", ("--size", "300x250", "--samples", "4", "--threads", "2")),
}
DISK_MIB = 256
GUARD_S = 120
# Why a job may fail while these faults are about; anything else is untrue.
REASONS = re.compile("|".join((
    "killed from outside", "not enough room", "ended by signal 15", "does not take START", "No space left", "disk is full", "Read-only", "Permission denied", "Is a directory",
    "File too large", "stopped from outside", "is full", "no HELLO", "file size", "killed by you", "in use",
    "did not end within", "may not be written", "closed its pipe", "was cut short meanwhile", "not run: job [0-9]+", "times; 'batten retry",
)))
CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH, PR_CAPBSET_DROP, CLONE_NEWNS = 1, 2, 24, 0x20000


def private_mounts():
    """Mounts of our own, gone with this process; False where we are not allowed to."""
    libc = ctypes.CDLL(None, use_errno=True)
    if os.geteuid() != 0 or libc.unshare(CLONE_NEWNS):
        return False
    return subprocess.run(["mount", "--make-rprivate", "/"], capture_output=True).returncode == 0


def obey_permissions():
    """Programs that root starts from here obey read-only files and folders, too."""
    libc = ctypes.CDLL(None, use_errno=True)
    for capability in (CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH):
        libc.prctl(PR_CAPBSET_DROP, capability, 0, 0, 0)


def digest(path):
    with open(path, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()


def brief(job):
    return {key: job[key] for key in ("id", "worker", "state", "reason", "output", "wall_s")}


def undisturbed():
    """{kind: {end of the name: digest}}"""
    project, known = end.Project(), {}
    for kind, (worker, name, parameters) in KINDS.items():
        project.run("batten-" + worker, os.path.join(end.EXAMPLES, name), *parameters, "-o", kind)
        known[kind] = {n[len(kind):]: digest(project.path(n)) for n in os.listdir(project.folder)
                       if re.fullmatch(kind + r"(-\d+)?\.[a-z.]+", n)}
        assert known[kind], kind
    shutil.rmtree(project.root)
    return known


class Trial:
    def __init__(self, random, known, mounts, clock):
        self.random, self.known, self.count = random, known, collections.Counter()
        self.root = tempfile.mkdtemp(prefix="batten-fault-")
        self.mounted = mounts and subprocess.run(
            ["mount", "-t", "tmpfs", "-o", f"size={DISK_MIB}m,mode=700", "none", self.root],
            capture_output=True).returncode == 0
        self.folder, self.out = self.path("project"), self.path("project", "out")
        for folder in (self.folder, self.out, self.path("run"), self.path("inputs")):
            os.mkdir(folder, 0o700)
        for name in {name for _, name, _ in KINDS.values()}:
            shutil.copy(os.path.join(end.EXAMPLES, name), self.path("inputs", name))
        self.clock = self.path("clock")
        self.environment = dict(
            os.environ, XDG_RUNTIME_DIR=self.path("run"), XDG_CONFIG_HOME=self.path("config"), NO_COLOR="1",
            BATTEN_JOBS="3", BATTEN_CANCEL_GRACE="0.3", BATTEN_TERM_GRACE="0.3", BATTEN_END_GRACE="1",
            BATTEN_HELLO_GRACE="5", BATTEN_DISK_FLOOR=random.choice(("0", "8")), BATTEN_FAULT_CLOCK=self.clock)
        if clock:
            self.environment["LD_PRELOAD"] = clock
            self.environment["ASAN_OPTIONS"] = os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"
        self.clients, self.acknowledged, self.submitted = [], set(), 0
        self.faults = []

    def path(self, *parts):
        return os.path.join(self.root, *parts)

    # Clients

    def start(self, *words):
        # what a client says goes to files: they stand outside the disk that is filled
        said = tempfile.TemporaryFile("w+")
        process = subprocess.Popen([end.BATTEN, *map(str, words)], cwd=self.folder, env=self.environment,
                                   stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT)
        process.said, process.words, process.until = said, words, time.monotonic() + GUARD_S
        process.hurt = False
        self.clients.append(process)
        return process

    def submit(self):
        kind = self.random.choice(list(KINDS))
        worker, name, parameters = KINDS[kind]
        self.submitted += 1
        more = ()
        ids = sorted(self.acknowledged)
        if ids and self.random.random() < 0.2:
            more = ("--after", self.random.choice(ids))
        self.start("submit", worker, self.path("inputs", name), *parameters, "-o",
                   os.path.join(self.out, f"{kind}_{self.submitted}"), *more, "--json")

    def collect(self, process):
        """A client has ended: by a signal only if we sent it one, with a sentence if it failed."""
        process.said.seek(0)
        text = process.said.read()
        process.said.close()
        self.count["clients"] += 1
        if process.hurt:
            return
        assert process.returncode in (0, 1, 2, 124), (process.words, process.returncode, text)
        if process.returncode and process.words[0] != "wait":
            assert text.strip(), ("failed without a word", process.words)
            assert "Sanitizer" not in text, text
            self.count["requests refused"] += 1
        elif process.words[0] == "submit":
            try:
                self.acknowledged |= {job["id"] for job in json.loads(text)["jobs"]}
            except json.JSONDecodeError:
                raise AssertionError((process.words, text))

    def reap(self):
        for process in self.clients[:]:
            if process.poll() is not None:
                self.clients.remove(process)
                self.collect(process)
            assert time.monotonic() < process.until, ("a client hangs", process.words)

    def ask(self, *words):
        """Run a client to its end and see its answer. The faults are over, or it may fail."""
        process = self.start(*words)
        self.clients.remove(process)
        process.wait(GUARD_S)
        process.said.seek(0)
        return process.returncode, process.said.read()

    def jobs(self):
        status, text = self.ask("jobs", "--all", "--json")
        assert status == 0, text
        return {job["id"]: job for job in json.loads(text)["jobs"]}

    # Processes

    def service(self):
        try:
            with open(self.path("project", ".batten", "lock")) as f:
                pid = int(f.readline().split()[-1])
        except (OSError, ValueError, IndexError):
            return None
        return pid if self.is_ours(pid) else None

    def is_ours(self, pid):
        """A live process in this project: the number may have come to mean another."""
        try:
            return os.readlink(f"/proc/{pid}/cwd").startswith(self.root) and end.process_state(pid) != "Z"
        except OSError:
            return False

    def workers(self, service=None):
        """All of the project, or those that one service started."""
        found = []
        for name in os.listdir("/proc"):
            if not name.isdigit() or not self.is_ours(int(name)):
                continue
            try:
                with open(f"/proc/{name}/cmdline") as f:
                    line = f.read()
            except OSError:
                continue
            if "/workers/batten-" in line.split("\0")[0] and service in (None, parent(name)):
                found.append(int(name))
        return found

    # What must be true

    def check_files(self):
        """Whatever stands under a final name is whole and right, at any time."""
        wrong = 0
        for name in os.listdir(self.out):
            found = re.fullmatch(r"([a-z0-9]+)_\d+((?:-\d+)?\.(?:map\.exr|shade\.exr|trace\.exr|isophote))", name)
            path = os.path.join(self.out, name)
            if not found or os.path.isdir(path):
                continue
            self.count["outputs looked at"] += 1
            if digest(path) != self.known[found[1]][found[2]]:
                wrong += 1
                print(f"# wrong bytes: {path}")
        return wrong

    def check_true(self, jobs):
        """Each job's state is true of what lies on the disk; how many were lost."""
        losses = len(self.acknowledged - set(jobs))
        for job in jobs.values():
            self.count["ended " + job["state"]] += 1
            if job["state"] == "done":
                for output in job["outputs"]:
                    losses += not os.path.isfile(output["path"])
                assert job["outputs"], brief(job)
            elif job["state"] in ("failed", "lost"):
                assert job["reason"] and REASONS.search(job["reason"]), brief(job)
            elif job["state"] == "killed":
                assert job["reason"], brief(job)
        return losses + self.check_files()

    def recover(self):
        """The faults are over: all jobs must come to their end, and what failed when tried again."""
        for _ in range(6):
            for verb in ("release", "activate", "retry"):
                self.ask(verb, "--all")
            killed = [j for j, job in self.jobs().items() if job["state"] in ("failed", "killed", "lost")]
            if killed:
                self.ask("retry", *killed)
            self.ask("wait", "--timeout", 20)
            jobs = self.jobs()
            if all(job["state"] == "done" for job in jobs.values()):
                return jobs
        raise AssertionError([brief(job) for job in jobs.values() if job["state"] != "done"])

    def finish(self):
        self.ask("prune")  # what could not be taken away while folders were read-only
        status, text = self.ask("shutdown")
        assert status == 0, text
        end.until(lambda: not self.workers(), "the workers end with the service")
        parts = os.listdir(self.path("project", ".batten", "parts"))
        assert not parts, parts
        self.count["temporary files left"] += len([n for n in os.listdir(self.out) if re.search(r"\.[A-Za-z0-9]{6}$", n)])

    def close(self):
        for process in self.clients:
            process.kill()
            process.wait()
        for pid in [self.service()] + self.workers():
            if pid:
                end.kill(pid)
        if self.mounted:
            subprocess.run(["umount", "-l", self.root], capture_output=True)
        shutil.rmtree(self.root, ignore_errors=True)


def parent(pid):
    try:
        with open(f"/proc/{pid}/stat") as f:
            return int(f.read().rsplit(")", 1)[1].split()[1])
    except OSError:
        return None


def limit_files(pid, bytes_):
    """What a process may write into one file; None: as much as it likes."""
    soft = resource.RLIM_INFINITY if bytes_ is None else bytes_
    resource.prlimit(pid, resource.RLIMIT_FSIZE, (soft, resource.RLIM_INFINITY))


def signal_quietly(pid, number):
    try:
        os.kill(pid, number)
        return True
    except ProcessLookupError:
        return False
