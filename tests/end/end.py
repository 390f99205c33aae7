"""end.py - what the end-to-end tests share: a throw-away project folder, running batten, TAP output.

A test file defines functions test_...(project) and ends in end.main(). The build folder comes in
BATTEN_BUILD. A test that cannot run here raises end.Skip with the reason.
"""
import contextlib
import json
import os
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback

BUILD = os.environ["BATTEN_BUILD"]
BATTEN = os.path.join(BUILD, "executive", "batten")
EXAMPLES = os.path.join(BUILD, "examples")
GUARD_S = 240  # nothing here takes that long: a hang becomes a failure


class Skip(Exception):
    pass


class Project:
    """A folder of its own, with a runtime folder of its own for the socket."""

    def __init__(self):
        self.root = tempfile.mkdtemp(prefix="batten-end-")
        self.folder = os.path.join(self.root, "project")
        run = os.path.join(self.root, "run")
        for path in (self.folder, run):
            os.mkdir(path, 0o700)
        self.environment = dict(os.environ, XDG_RUNTIME_DIR=run, NO_COLOR="1",
                                XDG_CONFIG_HOME=os.path.join(self.root, "config"))

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def command(self, arguments):
        program = arguments[0]
        if program == "batten":
            program = BATTEN
        elif program.startswith("batten-"):
            program = os.path.join(BUILD, "workers", program)
        return [program] + [str(a) for a in arguments[1:]]

    def start(self, *arguments, **options):
        return subprocess.Popen(self.command(arguments), cwd=self.folder, env=self.environment,
                                text=True, **options)

    def run(self, *arguments, status=0, stdin=None):
        """Run to the end; the exit status must be `status` (None: any)."""
        done = subprocess.run(self.command(arguments), cwd=self.folder, env=self.environment,
                              text=True, input=stdin if stdin is not None else "",
                              capture_output=True, timeout=GUARD_S)
        if status is not None and done.returncode != status:
            raise AssertionError(f"{' '.join(map(str, arguments))}: exit status {done.returncode}, "
                                 f"expected {status}\n{done.stdout}{done.stderr}")
        return done

    def json(self, *arguments, status=0, stdin=None):
        done = self.run(*arguments, "--json", status=status, stdin=stdin)
        o = json.loads(done.stdout)
        assert o["version"] == 1, o
        return o

    def jobs(self, *arguments):
        return {job["id"]: job for job in self.json("batten", "jobs", "--all", *arguments)["jobs"]}

    def submit(self, *arguments):
        return [job["id"] for job in self.json("batten", "submit", *arguments)["jobs"]]

    def service_pid(self):
        """As the lock file names it: "host NAME, process NUMBER"."""
        with open(self.path(".batten", "lock")) as f:
            return int(f.readline().split()[-1])

    def close(self):
        if os.path.exists(self.path(".batten")):
            subprocess.run([BATTEN, "shutdown"], cwd=self.folder, env=self.environment,
                           capture_output=True, timeout=GUARD_S)
        shutil.rmtree(self.root, ignore_errors=True)


def process_state(pid):
    """The letter of /proc: R, S, T, ...; None when there is no such process."""
    try:
        with open(f"/proc/{pid}/stat") as f:
            return f.read().rsplit(")", 1)[1].split()[0]
    except FileNotFoundError:
        return None


def kill(pid, number=signal.SIGKILL):
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, number)


def until(condition, what):
    """Look again and again until it is so; the limit is a guard against hangs."""
    stop = time.monotonic() + GUARD_S / 2
    while time.monotonic() < stop:
        x = condition()
        if x:
            return x
        time.sleep(0.01)
    raise AssertionError(f"waited in vain: {what}")


def terminal():
    """Both ends of a new terminal."""
    try:
        return pty.openpty()
    except OSError as why:
        raise Skip(f"there is no terminal to be had: {why}") from why


def data_folder():
    folder = os.environ.get("BATTEN_DATA")
    if not folder:
        raise Skip("BATTEN_DATA is not set")
    return folder


def main():
    module = sys.modules["__main__"]
    tests = [(name, f) for name, f in vars(module).items() if name.startswith("test_")]
    print(f"1..{len(tests)}")
    failed = False
    for number, (name, f) in enumerate(tests, 1):
        project = Project()
        try:
            f(project)
            print(f"ok {number} - {name}")
        except Skip as why:
            print(f"ok {number} - {name} # SKIP {why}")
        except BaseException:
            failed = True
            print(f"not ok {number} - {name}")
            for line in traceback.format_exc().splitlines():
                print("# " + line)
        finally:
            project.close()
        sys.stdout.flush()
    sys.exit(failed)
