"""cluster.py - a Slurm of its own for a test: several nodes on this one machine, in one folder.

Needs root and the programs of Slurm and munge (Debian: slurm-wlm, munge); Missing says what is not
there. Every daemon runs in the foreground as our child, so that nothing outlives the test.
"""
import os
import shutil
import signal
import socket
import subprocess
import time

GUARD_S = 60
PROGRAMS = ("munged", "slurmctld", "slurmd", "srun", "scancel", "squeue", "sinfo", "scontrol")


class Missing(Exception):
    pass


def find(program):
    path = shutil.which(program, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")
    if not path:
        raise Missing(f"{program} is not installed")
    return path


def free_ports(n):
    """Ports that nobody has; held together so that they differ."""
    sockets = [socket.socket() for _ in range(n)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Cluster:
    def __init__(self, folder, nodes=2, cpus=2):
        if os.geteuid() != 0:
            raise Missing("a test cluster needs root")
        self.programs = {name: find(name) for name in PROGRAMS}
        self.folder, self.nodes, self.cpus = folder, nodes, cpus
        self.daemons = {}
        os.makedirs(self.path("state"))
        os.chmod(folder, 0o755)
        self.environment = dict(os.environ, SLURM_CONF=self.path("slurm.conf"))
        for name in [n for n in self.environment if n.startswith("SLURM_") and n != "SLURM_CONF"]:
            del self.environment[name]
        try:
            self.start()
        except BaseException:
            self.stop()
            raise

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def write(self, name, text, mode=0o644):
        with open(self.path(name), "wb") as f:
            os.fchmod(f.fileno(), mode)
            f.write(text if isinstance(text, bytes) else text.encode())

    def configure(self):
        host = socket.gethostname().split(".")[0]
        ports = free_ports(self.nodes + 1)
        lines = {
            "ClusterName": "test", "SlurmctldHost": f"{host}(127.0.0.1)", "SlurmctldPort": ports[0],
            "SlurmUser": "root", "SlurmdUser": "root",
            "AuthType": "auth/munge", "CredType": "cred/munge",
            "AuthInfo": "socket=" + self.path("munge.socket"),
            "StateSaveLocation": self.path("state"), "SlurmdSpoolDir": self.path("spool-%n"),
            "SlurmctldPidFile": self.path("slurmctld.pid"), "SlurmdPidFile": self.path("%n.pid"),
            "SlurmctldLogFile": self.path("slurmctld.log"), "SlurmdLogFile": self.path("%n.log"),
            "ProctrackType": "proctrack/linuxproc", "TaskPlugin": "task/none",
            "SelectType": "select/cons_tres", "SelectTypeParameters": "CR_CPU",
            "SlurmdParameters": "config_overrides", "JobAcctGatherType": "jobacct_gather/none",
            "AccountingStorageType": "accounting_storage/none", "MpiDefault": "none",
            "SwitchType": "switch/none", "PlugStackConfig": self.path("plugins"),
            "ReturnToService": 2, "KillWait": 2, "MinJobAge": 10, "InactiveLimit": 0,
            "SlurmdTimeout": 5, "SchedulerParameters": "sched_interval=1",
        }
        text = "".join(f"{key}={value}\n" for key, value in lines.items())
        for i in range(1, self.nodes + 1):
            text += (f"NodeName=n{i} NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[i]} "
                     f"CPUs={self.cpus} State=UNKNOWN\n")
        text += "PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n"
        self.write("slurm.conf", text)
        self.write("plugins", "")
        self.write("munge.key", os.urandom(128), 0o600)

    def daemon(self, name, *command):
        with open(self.path(name + ".out"), "wb") as out:
            self.daemons[name] = subprocess.Popen(
                [self.programs[command[0]], *command[1:]], stdin=subprocess.DEVNULL, stdout=out,
                stderr=out, env=self.environment, start_new_session=True)

    def start(self):
        self.configure()
        self.daemon("munged", "munged", "--foreground", "--force", "--num-threads=2",
                    "--key-file=" + self.path("munge.key"), "--socket=" + self.path("munge.socket"),
                    "--pid-file=" + self.path("munged.pid"), "--log-file=" + self.path("munged.log"),
                    "--seed-file=" + self.path("munge.seed"))
        self.until(lambda: os.path.exists(self.path("munge.socket")), "munged listens")
        self.daemon("slurmctld", "slurmctld", "-D", "-c")
        for i in range(1, self.nodes + 1):
            self.start_node(i)
        self.until(lambda: self.states().count("idle") == self.nodes, "all nodes are idle")

    def start_node(self, i):
        self.daemon(f"n{i}", "slurmd", "-D", "-N", f"n{i}")

    def lose_node(self, i):
        """As if its power went: slurmd and all that it started are gone at once."""
        daemon = self.daemons.pop(f"n{i}")
        doomed = [daemon.pid]
        for pid in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{pid}/cmdline", "rb") as f:
                    line = f.read().replace(b"\0", b" ").decode(errors="replace")
                with open(f"/proc/{pid}/environ", "rb") as f:
                    environment = f.read().split(b"\0")
            except OSError:
                continue
            ours = f"SLURM_CONF={self.path('slurm.conf')}".encode() in environment
            if ours and (f"SLURMD_NODENAME=n{i}".encode() in environment
                         or (line.startswith("slurmstepd") and self.step_node(pid) == i)):
                doomed.append(int(pid))
        for pid in doomed:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        daemon.wait()

    def step_node(self, pid):
        """The node whose spool folder a slurmstepd has a file open in, 0: none."""
        folder = f"/proc/{pid}/fd"
        for fd in os.listdir(folder):
            try:
                target = os.readlink(os.path.join(folder, fd))
            except OSError:
                continue
            for i in range(1, self.nodes + 1):
                if target in (self.path(f"n{i}.log"),) or target.startswith(self.path(f"spool-n{i}")):
                    return i
        return 0

    def run(self, *command):
        return subprocess.run([self.programs.get(command[0], command[0]), *command[1:]],
                              env=self.environment, text=True, capture_output=True,
                              timeout=GUARD_S)

    def start_program(self, *command):
        return subprocess.Popen([self.programs[command[0]], *command[1:]], env=self.environment,
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL)

    def states(self):
        return self.run("sinfo", "-h", "-N", "-o", "%T").stdout.split()

    def queue(self):
        return self.run("squeue", "-h", "-o", "%i %j %T %N %r").stdout.splitlines()

    def until(self, condition, what):
        stop = time.monotonic() + GUARD_S
        while not condition():
            for name, daemon in self.daemons.items():
                if daemon.poll() is not None:
                    with open(self.path(name + ".out")) as f:
                        raise AssertionError(f"{name} ended: {f.read()[-2000:]}")
            if time.monotonic() > stop:
                raise AssertionError(f"waited in vain: {what}")
            time.sleep(0.02)

    def stop(self):
        """Jobs first, so that no step outlives its node."""
        if "slurmctld" in self.daemons and self.daemons["slurmctld"].poll() is None:
            self.run("scancel", "--signal=KILL", "--user=root")
            self.run("scancel", "--user=root")
            stop = time.monotonic() + 10
            while self.queue() and time.monotonic() < stop:
                time.sleep(0.05)
        for daemon in reversed(list(self.daemons.values())):
            daemon.terminate()
        for daemon in self.daemons.values():
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        self.daemons = {}
