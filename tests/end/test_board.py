"""The live board of `batten jobs --follow`: right with many jobs, in a narrow window, after a resize and a stop."""
import fcntl
import os
import re
import select
import signal
import struct
import termios

import end

TEAPOT = os.path.join(end.EXAMPLES, "teapot.igs")
SURFACES = 32
DRAWN = b"\x1b[J\x1b[?7h"  # the end of each drawing


class Board:
    """A terminal of a size, and what is drawn on it."""

    def __init__(self, project, rows, columns):
        self.leader, follower = end.terminal()
        self.resize(rows, columns)
        self.process = project.start("batten", "jobs", "--follow", stdout=follower, stderr=follower)
        os.close(follower)

    def resize(self, rows, columns):
        fcntl.ioctl(self.leader, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def next(self):
        """The next drawing, whole."""
        said = b""
        while not said.endswith(DRAWN):
            ready, _, _ = select.select([self.leader], [], [], end.GUARD_S / 2)
            assert ready, said
            said += os.read(self.leader, 1)
        return said.decode()

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self.leader)


def rows(drawing):
    return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", drawing).replace("\r", "").rstrip("\n").split("\n")


def test_the_board_follows_its_terminal(project):
    project.run("batten", "hold", "--after-current")
    for name in "abcdefg":
        project.submit("curvature", TEAPOT, "--grid", "8x8", "-o", name)
    board = Board(project, 24, 100)
    try:
        until = lambda wanted: end.until(lambda: wanted(board.next()), "the board is drawn so")
        until(lambda d: len(rows(d)) == 22 and rows(d)[-1] == f"and {7 * SURFACES - 21} more")
        until(lambda d: "\x1b[22F" in d and "2J" not in d)
        board.resize(12, 60)
        until(lambda d: d.find("\x1b[H\x1b[2J") >= 0 and "\x1b[22F" not in d and len(rows(d)) == 10)
        until(lambda d: "\x1b[10F" in d and d.startswith("\x1b[?7l"))  # lines are cut, not wrapped
        board.resize(300, 100)
        until(lambda d: "\x1b[2J" in d and len(rows(d)) == 7 * SURFACES)
        until(lambda d: f"\x1b[{7 * SURFACES}F" in d)
        # what the shell wrote meanwhile stays
        board.process.send_signal(signal.SIGSTOP)
        end.until(lambda: end.process_state(board.process.pid) == "T", "it is stopped")
        board.process.send_signal(signal.SIGCONT)
        until(lambda d: not re.search(r"\x1b\[[0-9]+F", d) and len(rows(d)) == 7 * SURFACES)
    finally:
        board.close()


end.main()
