#!/usr/bin/env python3
"""bench_window.py - how long the editor's window takes to stand, and what it costs while nothing happens."""
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "editor"), os.path.join(HERE, "..", "end")]
import end  # noqa: E402
import window  # noqa: E402

STARTS, IDLE_S = 10, 10


def cpu_seconds(pid):
    with open(f"/proc/{pid}/stat") as f:
        words = f.read().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def colors(screen):
    """Of a grid of pixels of the view: looking at all of them would take longer than what is measured."""
    rows = screen.picture()[100:700:12]
    return {row[4 * x:4 * x + 3] for row in rows for x in range(300, 900, 12)}


def first(screen, there):
    """ms from the editor's start until `there` is true of the colors in the view."""
    while not there(colors(screen)):
        assert screen.editor.poll() is None and time.monotonic() < screen.begun + end.GUARD_S
        time.sleep(0.002)
    return 1000 * (time.monotonic() - screen.begun)


def start_ms(project):
    """X server; from the editor's start its first picture, and the picture with the file in it."""
    begun = time.monotonic()
    with window.Screen(project, window.HULL, wait=False) as screen:
        server = 1000 * (screen.begun - begun)
        shown = first(screen, lambda found: len(found) > 1 or found != {b"\0\0\0"})
        return server, shown, first(screen, lambda found: len(found) > 8)


def row(what, shown, value, goal, limit):
    """As bench_print in bench.c has it."""
    print(f"row editor | {what} | {shown} | {goal} |  |  | {'met' if value <= limit else 'not met'}", flush=True)


def main():
    project = end.Project()
    try:
        took = [sorted(x)[STARTS // 2] for x in zip(*(start_ms(project) for _ in range(STARTS)))]
        row("start to the first frame, one surface", f"{took[1]:.4g} ms", took[1], "<= 300", 300)
        print(f"X server ready: {took[0]:.0f} ms; with the torus in the picture: {took[2]:.0f} ms (medians of {STARTS})")
        with window.opened(project) as screen:
            time.sleep(2)  # the service answers, the picture is drawn at its best
            pid, before = screen.editor.pid, cpu_seconds(screen.editor.pid)
            time.sleep(IDLE_S)
            share = (cpu_seconds(pid) - before) / IDLE_S
            row("idle editor", f"{100 * share:.3g} % of a core", 100 * share, "<= 0.1", 0.1)
    finally:
        project.close()


if __name__ == "__main__":
    main()
