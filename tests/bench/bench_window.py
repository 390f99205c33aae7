#!/usr/bin/env python3
"""bench_window.py - how long the editor's window takes to stand, and what it costs while nothing happens."""
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "editor"), os.path.join(HERE, "..", "end")]
import end  # noqa: E402
import window  # noqa: E402

STARTS, IDLE_S = 5, 10


def cpu_seconds(pid):
    with open(f"/proc/{pid}/stat") as f:
        words = f.read().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def start_ms(project):
    """X server and editor, until the file is open and drawn."""
    begun = time.monotonic()
    with window.opened(project):
        return 1000 * (time.monotonic() - begun)


def main():
    project = end.Project()
    try:
        took = sorted(start_ms(project) for _ in range(STARTS))
        print(f"X server, window and torus drawn: {took[STARTS // 2]:.0f} ms (median of {STARTS})")
        with window.opened(project) as screen:
            pid, before = screen.editor.pid, cpu_seconds(screen.editor.pid)
            time.sleep(IDLE_S)
            share = (cpu_seconds(pid) - before) / IDLE_S
            print(f"idle: {100 * share:.3f} % of a processor over {IDLE_S} s")
    finally:
        project.close()


if __name__ == "__main__":
    main()
