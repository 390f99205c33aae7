#!/usr/bin/env python3
"""window.py - the editor's window as a user has it: its own X server, a mouse and keys by xdotool.

Ends are looked up where they count: in the journal, in `batten jobs`, in the picture on the screen.
"""
import os
import shutil
import struct
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "end"))
import end  # noqa: E402

HULL = os.path.join(end.EXAMPLES, "torus.igs")
ROW, ROW_HEIGHT, PANEL = 126, 28, 1100  # of a menu at 1280 x 800


class Screen:
    """An X server, and the editor on it."""

    def __init__(self, project, *files, wait=True):
        for program in ("Xvfb", "xdotool"):
            if not shutil.which(program):
                raise end.Skip(f"{program} is not installed")
        self.project = project
        self.pixels = os.path.join(project.root, "screen")
        os.makedirs(self.pixels, exist_ok=True)
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp",
             "-noreset", "-fbdir", self.pixels], pass_fds=[write], stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        self.editor = None
        begun = False
        try:
            with os.fdopen(read) as f:
                number = f.readline().strip()
            assert number, "Xvfb did not start"
            project.environment.update(DISPLAY=f":{number}", LIBGL_ALWAYS_SOFTWARE="1")
            self.begun = time.monotonic()
            self.editor = project.start("batten", *files, stderr=subprocess.PIPE)
            self.window = end.until(self.find, "a window").split()[0] if wait else None
            begun = True
        finally:
            if not begun:
                self.finish()

    def find(self):
        assert self.editor.poll() is None, self.editor.stderr.read()
        return subprocess.run(["xdotool", "search", "--onlyvisible", "--class", "batten"], text=True,
                              env=self.project.environment, capture_output=True, check=False).stdout

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.finish()

    def finish(self):
        """No process stays behind, whatever had begun."""
        try:
            if self.editor:
                if self.editor.poll() is None:
                    self.editor.kill()
                self.editor.wait()
                self.editor.stderr.close()
        finally:
            if self.server.poll() is None:
                self.server.terminate()  # it takes its socket and lock away
            self.server.wait()

    def tool(self, *arguments):
        done = subprocess.run(["xdotool", *map(str, arguments)], env=self.project.environment,
                              capture_output=True, text=True, timeout=end.GUARD_S)
        assert done.returncode == 0, (arguments, done.stderr)
        return done.stdout

    def key(self, *names):
        self.tool("key", *names)

    def type(self, text, pace=20):
        self.tool("type", "--delay", pace, text)

    def click(self, x, y, button=1):
        self.tool("mousemove", "--window", self.window, x, y, "click", button)

    def row(self, number):
        self.click(PANEL, ROW + ROW_HEIGHT * (number - 1))

    def drag(self, *places):
        x, y = places[0]
        self.tool("mousemove", "--window", self.window, x, y, "mousedown", 1)
        for x, y in places[1:]:
            self.tool("mousemove", "--window", self.window, x, y)
        self.tool("mouseup", 1)

    def leaf(self, code):
        """By the search: to its form."""
        self.key("slash")
        self.type(code)
        self.key("Return")

    def picture(self):
        """Rows of the screen's pixels, 4 bytes each: the server keeps them as an xwd file."""
        with open(os.path.join(self.pixels, "Xvfb_screen0"), "rb") as f:
            data = f.read()
        head = struct.unpack(">25I", data[:100])
        size, height, line, colors = head[0], head[5], head[12], head[19]
        start = size + 12 * colors
        return [data[start + line * y:start + line * (y + 1)] for y in range(height)]

    def colors(self, x0, y0, x1, y1):
        rows = self.picture()[y0:y1]
        return {row[4 * x:4 * x + 3] for row in rows for x in range(x0, x1)}

    def settled(self, *box):
        """The colors there once something is drawn."""
        return end.until(lambda: len(c) > 8 and c if (c := self.colors(*box)) else None,
                         f"something drawn in {box}")

    def ends(self, status):
        assert self.editor.wait(timeout=end.GUARD_S) == status
        return self.editor.stderr.read()


def journal(project):
    try:
        with open(project.path(".batten", "journal"), encoding="utf-8") as f:
            return f.read()
    except FileNotFoundError:
        return ""


def done(project, line):
    end.until(lambda: line in journal(project), f"{line} in the journal:\n{journal(project)}")


def state(project, job):
    return project.jobs().get(job, {}).get("state")


def in_state(project, job, wanted):
    end.until(lambda: state(project, job) == wanted, f"job {job} {wanted}")


def opened(project):
    screen = Screen(project, HULL)
    # the title says what is open once the world is back from reading it
    end.until(lambda: "torus.igs" in screen.tool("getwindowname", screen.window), "the torus")
    return screen


LONG = "4000x4000"  # a trace of that size outlasts the test


def start_trace(screen):
    """From the form of CALCULATE TRACE; its number."""
    before = set(screen.project.jobs())
    screen.leaf("V76")
    screen.key("Tab", "ctrl+u")  # View, then Size
    screen.type(LONG)
    screen.key("Return")
    done(screen.project, f"size={LONG}")
    new = end.until(lambda: set(screen.project.jobs()) - before, "a job")
    return new.pop()


def test_something_is_on_the_screen(project):
    with opened(project) as screen:
        assert len(screen.settled(100, 100, 860, 700)) > 8  # the wire frame
        assert len(screen.settled(970, 60, 1270, 400)) > 8  # the menu
        screen.key("F10")
        end.until(lambda: b"\xfa\xf9\xf8" in screen.colors(970, 400, 980, 410), "the light theme")


def test_the_menus_are_walked_by_mouse_and_keys(project):
    with opened(project) as screen:
        screen.row(4)  # GEOMETRY INTERROGATION
        screen.key("3")  # SURFACE
        screen.key("0")  # SURFACE ON/OFF
        screen.key("Return")
        done(project, "V99 on=no")
        screen.key("Escape", "Escape", "5")  # GEOMETRY PROCESSING
        screen.leaf("V99")
        screen.key("Return")
        done(project, "V99 on=yes")


def test_utf8_is_typed(project):
    with opened(project) as screen:
        screen.leaf("V180")
        screen.key("ctrl+u")
        # xdotool gives a key a new meaning for such a letter, and takes it back after that time
        screen.type("Rümpfßä", pace=500)
        screen.key("BackSpace", "BackSpace", "Return")
        done(project, "V180 name=Rümpf")


def test_a_job_is_steered_from_the_world_menu(project):
    with opened(project) as screen:
        job = start_trace(screen)
        in_state(project, job, "running")
        screen.key("w", "4", "1")  # WORLD, STATUS ROUTINES, LIST JOBS
        screen.click(400, 146)
        screen.row(2)  # SUSPEND JOBS
        in_state(project, job, "suspended")
        # ACTIVATE JOBS, which takes effect once the window has heard of the suspension, too
        end.until(lambda: screen.key("3") or state(project, job) == "running", "the job running")
        screen.key("k", "n")
        screen.key("k", "Return")  # Return answers nothing
        assert state(project, job) in ("running", "starting")
        screen.key("y")
        in_state(project, job, "killed")
        assert "by you" in project.jobs()[job]["reason"]


def test_the_light_is_dragged(project):
    with opened(project) as screen:
        screen.leaf("V73")
        before = screen.settled(640, 400, 960, 740)  # the card
        assert before
        screen.drag((480, 394), (520, 300), (600, 394))  # to the right of the view's middle
        screen.key("Return")
        done(project, "azimuth=0")


def test_a_window_made_smaller_goes_on(project):
    with opened(project) as screen:
        screen.tool("windowsize", screen.window, 1000, 700)
        end.until(lambda: len(screen.colors(690, 60, 990, 400)) > 8 and
                  screen.colors(1010, 100, 1200, 600) == {b"\0\0\0"}, "the menu at its new place")
        screen.click(820, 118 + 24 * 3)  # GEOMETRY INTERROGATION, rows are lower now
        screen.key("3", "0", "Return")
        done(project, "V99 on=no")


def test_it_is_closed_with_jobs_running(project):
    with opened(project) as screen:
        job = start_trace(screen)
        in_state(project, job, "running")
        screen.key("ctrl+q", "n")
        assert screen.editor.poll() is None
        screen.key("ctrl+q", "l")
        assert screen.ends(0) == ""
    assert state(project, job) == "running"
    project.run("batten", "kill", job)
    with Screen(project) as screen:  # the session is there again
        screen.leaf("V99")
        screen.key("Return")
        done(project, "V99 on=no")


def test_a_display_that_goes_away_ends_the_editor_not_the_jobs(project):
    with opened(project) as screen:
        job = start_trace(screen)
        in_state(project, job, "running")
        screen.server.kill()
        said = screen.ends(1)
        assert "display went away" in said and said.count("\n") == 1, said
    assert state(project, job) == "running"
    project.run("batten", "kill", job)


if __name__ == "__main__":
    end.main()
