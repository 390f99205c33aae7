#!/usr/bin/env python3
"""A worker for batten: lengths of a surface's isoparametric lines as a table."""
import json, os, struct, subprocess, sys

DESCRIPTION = {
    "name": "lengths", "title": "lengths of isoparametric lines", "version": 1, "scene": False,
    "help": "Lengths of lines of constant u or v, with the error they were checked to have.",
    "inputs": "surfaces", "parameters": [
        {"name": "along", "type": "choice", "default": "u", "choices": ["u", "v"], "help": "which runs along"},
        {"name": "lines", "type": "integer", "default": "11", "min": 2, "max": 1000, "help": "how many lines"},
        {"name": "tolerance", "type": "real", "default": "1e-6", "min": 1e-12, "max": 0.1, "help": "largest error, relative"}],
    "outputs": [{"extension": ".lengths.csv", "kind": "table"}]}

def send(number, **fields):
    text = json.dumps(fields).encode()
    os.write(1, struct.pack("<II", number, len(text)) + text)

def batten(*words, lines=""):
    program = os.environ.get("BATTEN_PROGRAM", "batten")
    done = subprocess.run([program, *words, "--json"], input=lines, text=True, capture_output=True)
    if done.returncode:
        raise ValueError(done.stderr.strip())
    return json.loads(done.stdout)

def length(path, point, a, b, tolerance):
    """Sums of chords, twice as many each time: the error falls to a quarter, so it is known."""
    last = 0
    for n in (32 << k for k in range(13)):
        lines = "\n".join(point(a + (b - a) * i / n) for i in range(n + 1))
        p = [q["point"] for q in batten("eval", path, "-", lines=lines)["points"]]
        now = sum(sum((x - y) ** 2 for x, y in zip(q, r)) ** 0.5 for q, r in zip(p, p[1:]))
        last, error = now, abs(now - last) / 3
        if error <= tolerance * now:
            return now + error, error
    raise ValueError("a line is too rough for --tolerance; take a larger one")

def work(job):
    value = {p["name"]: p["default"] for p in DESCRIPTION["parameters"]} | job["parameters"]
    path, n, name = job["inputs"][0]["path"], int(value["lines"]), job["output"] + ".lengths.csv"
    (a, b), (c, d) = batten("info", path)["entities"][0]["domain"][::1 if value["along"] == "u" else -1]
    rows = ["parameter,length,error"]
    for i in range(n):
        send(2, done=i, total=n, phase="measuring")
        at = c + (d - c) * i / (n - 1)
        point = (lambda t: f"{t!r} {at!r}") if value["along"] == "u" else (lambda t: f"{at!r} {t!r}")
        rows.append("%r,%r,%r" % (at, *length(path, point, a, b, float(value["tolerance"]))))
    print(*rows, sep="\n", file=open(name + ".tmp", "w"), flush=True)
    os.replace(name + ".tmp", name)
    send(5, path=name, kind="table", figures={"lines": n})
    send(7)

if sys.argv[1:] == ["--describe"]:
    sys.exit(print(json.dumps(DESCRIPTION)))
send(1, protocol=1, worker="lengths", host=os.environ.get("SLURMD_NODENAME"))
try:
    size = struct.unpack("<II", sys.stdin.buffer.read(8))[1]
    work(json.load(open(json.loads(sys.stdin.buffer.read(size))["job"])))
except (OSError, ValueError) as error:
    send(6, **{"class": "input", "text": str(error)})
    sys.exit(1)
