"""faults.py - what may go wrong. Each fault does its harm to a trial and returns what undoes it, or None."""
import contextlib
import fcntl
import os
import shutil
import signal

import trial as place
from trial import end

BIG = 1 << 20


def kill_service(t):
    pid = t.service()
    workers = t.workers(pid) if pid else []
    if pid and place.signal_quietly(pid, signal.SIGKILL):
        t.count["kills of the service"] += 1
        end.until(lambda: not any(t.is_ours(p) for p in [pid] + workers), "the workers end with the service")


def damage_parts(t):
    """As after a power cut on a bad disk: units that were done are torn or damaged."""
    kill_service(t)
    folder = t.path("project", ".batten", "parts")
    for name in os.listdir(folder) if os.path.isdir(folder) else ():
        with contextlib.suppress(OSError), open(os.path.join(folder, name), "r+b", buffering=0) as f:
            fcntl.flock(f, fcntl.LOCK_EX | fcntl.LOCK_NB)  # a client may have started the next service
            size = f.seek(0, os.SEEK_END)
            how = t.random.choice(("cut", "damage", "zeros"))
            if how == "cut" and size:
                f.truncate(t.random.randrange(size))
            elif how == "damage" and size > 8:
                f.seek(t.random.randrange(8, size))
                f.write(bytes([t.random.randrange(256)]))
            elif how == "zeros":
                f.truncate(0)
                f.truncate(size)
            t.count["part files damaged"] += 1


def kill_worker(t):
    pids = t.workers()
    if pids and place.signal_quietly(t.random.choice(pids), signal.SIGKILL):
        t.count["kills of workers"] += 1


def terminate_worker(t):
    pids = t.workers()
    if pids and place.signal_quietly(t.random.choice(pids), signal.SIGTERM):
        t.count["kills of workers"] += 1


def stop_and_go(t, pid, what):
    if not pid or not place.signal_quietly(pid, signal.SIGSTOP):
        return None
    t.count["stops of " + what] += 1
    return lambda: place.signal_quietly(pid, signal.SIGCONT) if t.is_ours(pid) else None


def stop_worker(t):
    pids = t.workers()
    return stop_and_go(t, t.random.choice(pids), "workers") if pids else None


def stop_service(t):
    return stop_and_go(t, t.service(), "the service")


def kill_client(t):
    if t.clients:
        client = t.random.choice(t.clients)
        client.hurt = True
        client.kill()
        t.count["kills of clients"] += 1


def stop_client(t):
    if not t.clients:
        return None
    client = t.random.choice(t.clients)
    client.send_signal(signal.SIGSTOP)
    t.count["stops of clients"] += 1
    return lambda: client.send_signal(signal.SIGCONT)


def fill_disk(t):
    path = t.path("filler")
    if not t.mounted or os.path.exists(path):
        return None
    left = t.random.choice((0, 0, 4096, 200000))
    free = shutil.disk_usage(t.root).free - left
    with open(path, "wb", buffering=0) as f, contextlib.suppress(OSError):
        while free > 0:
            free -= f.write(bytes(min(free, BIG)))
    t.count["disk filled"] += 1
    return lambda: os.unlink(path)


def small_files(t):
    """Beyond a size no file of that process grows."""
    pids = t.workers() + [t.service()]
    pid = t.random.choice(pids)
    if not pid:
        return None
    try:
        place.limit_files(pid, t.random.choice((0, 4096, 300000)))
    except OSError:
        return None
    t.count["files limited"] += 1

    def undo():
        if t.is_ours(pid):
            try:
                place.limit_files(pid, None)
            except ProcessLookupError:
                pass
    return undo


def no_writing(t):
    folder = t.random.choice((t.out, t.path("project", ".batten", "parts"), t.path("project", ".batten"),
                              t.path("project", ".batten", "logs")))
    if not os.path.isdir(folder):
        return None
    os.chmod(folder, 0o500)
    t.count["folders read-only"] += 1
    return lambda: os.chmod(folder, 0o700)


def swap_input(t):
    """The file that was submitted becomes another, or rubbish, and comes back."""
    name = t.random.choice(sorted(name for _, name, _ in place.KINDS.values()))
    path, kept = t.path("inputs", name), t.path("inputs", name + ".kept")
    if os.path.exists(kept) or any(client.words[0] == "submit" for client in t.clients):
        return None  # what is just being read may be either: no answer would be wrong
    os.rename(path, kept)
    with contextlib.suppress(OSError), open(path, "wb") as f:  # on a full disk nothing is rubbish enough
        f.write(b"rubbish" * 100)
        f.flush()
    t.swapped = True
    t.count["inputs swapped"] += 1

    def undo():
        os.rename(kept, path)
        t.swapped = False
    return undo


def step_clock(t):
    with contextlib.suppress(OSError):  # the disk may be full
        with open(t.clock, "w") as f:
            f.write(str(t.random.choice((0, -86400, 86400, -86400 * 400, 86400 * 4000))))
        t.count["clock stepped"] += 1


def verb(name):
    def ask(t):
        ids = sorted(t.acknowledged)
        if ids:
            t.count["user's orders"] += 1
            t.start(name, *t.random.sample(ids, min(len(ids), 3)))
    return ask


def hold_queue(t):
    t.count["user's orders"] += 1
    t.start("hold", "--after-current")
    return lambda: t.start("release", "--all")


def look(t):
    t.start(*t.random.choice((("jobs",), ("jobs", "--json", "--all"), ("wait", "--timeout", "1"),
                              ("jobs", "--follow", "--json"))))


def shutdown(t):
    t.count["shutdowns"] += 1
    t.start("shutdown")


# how often, against each other
FAULTS = (
    (3, kill_service), (2, damage_parts), (6, kill_worker), (2, terminate_worker), (4, stop_worker),
    (2, stop_service), (4, kill_client), (3, stop_client), (3, fill_disk), (3, small_files), (3, no_writing),
    (2, swap_input), (2, step_clock), (4, look), (1, shutdown), (3, verb("suspend")), (3, verb("activate")),
    (2, verb("hold")), (1, hold_queue), (2, verb("release")), (2, verb("kill")), (3, verb("retry")), (1, verb("priority")),
)
