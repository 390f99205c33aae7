"""fault.py [--long] [--seed N] - whatever goes wrong, all that could be done is done and nothing is lost.

For each seed a project of its own: jobs of all workers are submitted while faults.py does harm. Then the faults
end, and so must every job: in a true state, and each output byte for byte what an undisturbed run gives.
Prints TAP and the counts. The same seed makes the same choices; the machine's own timing remains.
"""
import argparse
import collections
import os
import random
import sys
import time
import traceback

import faults
import trial as place

SMALL, LONG = (2, 5.0), (40, 12.0)  # seeds, seconds of faults each


def harm(t, seconds):
    """Let jobs come and faults happen; whatever is undone is undone a moment later."""
    weights = [w for w, _ in faults.FAULTS]
    undo, stop, t.swapped = [], time.monotonic() + seconds, False
    while time.monotonic() < stop:
        t.reap()
        due = [u for u in undo if u[0] < time.monotonic()]
        undo = [u for u in undo if u not in due]
        for _, back in due:
            back()
        if t.random.random() < 0.35 and len(t.clients) < 8 and not t.swapped:
            t.submit()
        if t.random.random() < 0.35:
            (fault,) = t.random.choices([f for _, f in faults.FAULTS], weights)
            back = fault(t)
            t.count["faults"] += 1
            if back:
                undo.append((time.monotonic() + t.random.uniform(0.05, 1.2), back))
        time.sleep(t.random.uniform(0, 0.04))  # the pace of the harm, not a wait for anything
    for _, back in undo:
        back()


def run(seed, known, mounts, clock, seconds):
    t = place.Trial(random.Random(seed), known, mounts, clock)
    try:
        harm(t, seconds)
        while t.clients:
            t.reap()
            for client in t.clients:
                if client.words[0] == "jobs" and not client.hurt:
                    client.hurt = True  # it follows for as long as there are jobs
                    client.kill()
            time.sleep(0.01)
        losses = t.check_true(t.jobs())
        jobs = t.recover()
        losses += t.check_true(jobs) + t.check_files()
        t.count["jobs"] += len(jobs)
        t.count["losses"] += losses
        t.finish()
        assert not losses, f"{losses} losses"
    finally:
        t.close()
    return t.count


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--seed", type=int)
    parser.add_argument("--clock", help="library that steps the clock")
    options = parser.parse_args()
    n, seconds = LONG if options.long or os.environ.get("BATTEN_LONG") else SMALL
    seeds = range(1, n + 1) if options.seed is None else [options.seed]
    mounts = place.private_mounts()
    place.obey_permissions()
    known, total, failed = place.undisturbed(), collections.Counter(), False
    print(f"1..{len(seeds)}")
    if not mounts:
        print("# no disk is filled: that takes a mount, and root")
    for number, seed in enumerate(seeds, 1):
        try:
            total += run(seed, known, mounts, options.clock, seconds)
            print(f"ok {number} - seed {seed}")
        except Exception:
            failed = True
            print(f"not ok {number} - seed {seed}")
            for line in traceback.format_exc().splitlines():
                print("# " + line)
        sys.stdout.flush()
    for what in sorted(total):
        print(f"# {what}: {total[what]}")
    if "losses" not in total:
        print("# losses: 0")
    sys.exit(failed)


main()
