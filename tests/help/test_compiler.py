"""The help compiler: its three outputs, and that it fails on every gap between menus and help."""
import os
import shutil
import subprocess
import tempfile
import traceback

SOURCE = os.environ["BATTEN_SOURCE"]
MENUS = ["main", "uv", "cosfair", "world"]
V79 = "@V79 Title\nPurpose.\n:arguments\ngrid | NxM | what\n:result\nR.\n:example\nV79 grid=4x4\n"


def compile_with(change_help=lambda s: s, change_menu=lambda s: s):
    """Exit status, what it said, and the files it wrote, of a source and a main menu changed so."""
    folder = tempfile.mkdtemp(prefix="batten-help-")
    try:
        with open(os.path.join(SOURCE, "help", "batten.help")) as f:
            text = change_help(f.read())
        with open(os.path.join(folder, "x.help"), "w") as f:
            f.write(text)
        for name in MENUS:
            with open(os.path.join(SOURCE, "menus", name + ".menu")) as f:
                text = f.read()
            with open(os.path.join(folder, name + ".menu"), "w") as f:
                f.write(change_menu(text) if name == "main" else text)
        outputs = ["m", "p", "i"]
        done = subprocess.run([os.environ["HELP_COMPILER"], "x.help"] + [n + ".menu" for n in MENUS] + outputs,
                              cwd=folder, capture_output=True, text=True, timeout=60)
        made = {}
        for name in outputs:
            path = os.path.join(folder, name)
            if os.path.exists(path):
                with open(path, "rb") as f:
                    made[name] = f.read().decode()
        return done.returncode, done.stderr, made
    finally:
        shutil.rmtree(folder)


def replaced(old, new):
    def change(text):
        assert old in text, old
        return text.replace(old, new, 1)
    return change


def cut(code):
    """The text of a code taken out."""
    def change(text):
        begin = text.index(f"@{code} ")
        return text[:begin] + text[text.index("\n@", begin) + 1:]
    return change


def test_three_files_fit_each_other():
    status, said, made = compile_with()
    assert status == 0 and not said, said
    message, pointer, include = made["m"].encode(), made["p"].splitlines(), made["i"]
    rows = [line.split() for line in pointer[1:]]
    assert len(rows) == 244 and f"#define HELP_TEXTS {len(rows)}\n" in include
    end = 0
    for k, (code, start, n) in enumerate(rows):
        text = message[int(start):int(start) + int(n)].decode()
        assert int(start) == end and text.startswith(f"@{code} "), (code, text)
        assert f"#define HELP_{code} {k}\n" in include and f'\t"{code}",\n' in include
        end += int(n)
    assert end == len(message)


def test_gaps_fail_the_build():
    for name, help_change, menu_change, says in (
            ("entry without text", cut("V79"), str, "'ALL CURVATURES' (V79) has no text"),
            ("menu without text", cut("N31"), str, "'CURVATURE' (N31) has no text"),
            ("text without entry", str, replaced("V79\n", "V979\n"), "V79 is in no menu"),
            ("reference to nothing", replaced(":see V80 V81", ":see V980 V81"), str, "an index without a text"),
            ("unlisted argument", replaced("V79 grid=400x200", "V79 gird=400x200"), str, "V79 has an example with an argument"),
            ("example of another", replaced("\nV182\n:see", "\nV183\n:see"), str, "V182 has an example without itself"),
            ("example of nothing", replaced("\nV182\n:see", "\nundo\n:see"), str, "does not begin with a routine"),
            ("twice", lambda s: s + V79, str, "found V79 a second time"),
            ("broken source", lambda s: s + ":nonsense\n", str, "found ':nonsense'"),
            ("broken menu", str, replaced("1\n", "\n"), "found a blank line")):
        status, said, made = compile_with(help_change, menu_change)
        assert status != 0 and says in said, (name, said)
        assert "line " in said, (name, said)
        assert not made, (name, "outputs were written")


def test_all_gaps_are_told_at_once():
    status, said, _ = compile_with(lambda s: cut("V1")(cut("V5")(s)))
    assert status == 1 and "(V1) has no text" in said and "(V5) has no text" in said, said


def test_usage():
    done = subprocess.run([os.environ["HELP_COMPILER"]], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and done.stderr.startswith("usage: "), done


def main():
    tests = [(n, f) for n, f in globals().items() if n.startswith("test_")]
    print(f"1..{len(tests)}")
    for k, (name, run) in enumerate(tests, 1):
        try:
            run()
            print(f"ok {k} {name}")
        except Exception:
            print("".join("# " + line + "\n" for line in traceback.format_exc().splitlines()), end="")
            print(f"not ok {k} {name}")


main()
