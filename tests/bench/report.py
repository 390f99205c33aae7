#!/usr/bin/env python3
"""Run the benchmarks of a build folder and write docs/benchmarks.md: report.py BUILD [--kept].

With --kept the last run's results are taken, nothing is run. The benchmarks should have the machine
to themselves; where they do not, their figures are CPU time and what depends on the clock says so.
"""
import json
import os
import platform
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PEERS = ["libsisl-dev", "libocct-modeling-algorithms-dev", "libembree-dev", "povray"]

# Why a row may not be met, by what a profile says (docs/performance.md has more): pattern of its name, the reason.
REASONS = [
    (r"2 threads / 1, CPU time, (teapot|wavy20|torus)",
     "The work does not grow: callgrind counts 1,311.763 million instructions for the view of wavy20 by one thread and "
     "1,311.767 by two, 1,317.787 and 1,317.791 for the torus; threads share nothing that is written. What is left is "
     "how fast the second processor is beside other work; 1.85 to 2.3 on a quieter machine."),
    (r"2 threads / 1, curvature",
     "Tiles that come before their turn go by a file beside the part file: a tenth of the CPU time now that one thread takes "
     "half of what it took; 1.78 to 1.86."),
    (r"part file of 1024 tiles made whole", "By the clock, bound by the disk; 20 ms where nothing else writes."),
    (r"^(packets|a ray a call), teapot",
     "Of a packet's time a fourth is the iteration, a fourth the tree, a seventh finish and evaluation in double: what "
     "triangles do not pay for. Their error is that of the mesh, ours 4e-16 of the size."),
    (r"preparing / triangles", "Two thirds of it cut the patches into leaves, a seventh builds their tree; triangles are only sorted."),
    (r"cylinders, 1e-6$",
     "4.7 to 5.2 ms where less other work shares the caches. No function stands out: sampling the form on boxes, making "
     "it and fitting and proving the pieces take a few parts of a hundred each."),
    (r"planes, 1e-", "As the cylinders: other work shares the caches."),
    (r"^frame while dragging",
     "Mesa's llvmpipe draws it on the processors: 36 % of the time is in it, 26 % in the code that it makes of the "
     "shaders, 23 % our own; a bare loop of it takes 35 ms."),
    (r"packing in a job",
     "What is left is deflate and, for values that do not shrink, the estimate that says so."),
    (r"START to the first part|CANCEL to the end|xargs|two at a time|power cut|submit to HELLO|start to the first frame",
     "By the clock: on a busy machine each step waits for a processor, or the disk."),
]

# Goals that nothing here can measure, since there is no such routine yet.
MISSING = [
    ("8", "approximate 10,000 points of a curve within 1e-3", "there is no approximation of curves with a checked error yet"),
    ("9", "approximate 100 x 100 points by a surface within 1e-3", "nor one of surfaces"),
    ("13", "intersect two surfaces, 16 loops, within 1e-6",
     "level curves on one surface are traced, curves of two are not"),
    ("16", "geodesics, fairing of surfaces", "reflection and highlight lines are there, with the error of each curve; these are not"),
    ("18", "offset of a curve of 200 points within 1e-4", "surfaces are offset, plane curves are not"),
]
BUSY = 1.3  # wall / CPU above which the machine was not alone


def read(path):
    with open(path, encoding="utf-8") as f:
        return f.read()


def run_benchmarks(build):
    # output in full, one at a time: two would disturb each other
    subprocess.run(["meson", "test", "-C", build, "--benchmark", "--num-processes", "1", "--logbase", "benchmarks"],
                   check=False)


def outputs(build):
    """Name and standard output of each benchmark of the last run."""
    found = []
    for line in read(os.path.join(build, "meson-logs", "benchmarks.json")).splitlines():
        test = json.loads(line)
        found.append((test["name"].split(" / ")[-1], test["result"], test.get("stdout") or ""))
    return sorted(found)


def machine():
    model = re.search(r"model name\s*: (.*)", read("/proc/cpuinfo"))
    cc = subprocess.run(["cc", "--version"], capture_output=True, text=True, check=False).stdout.splitlines()
    yield f"{model.group(1) if model else platform.machine()}, {os.cpu_count()} processors"
    yield f"{platform.system()} {platform.release()}, {cc[0] if cc else 'unknown compiler'}"
    for name in PEERS:
        r = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", name], capture_output=True, text=True,
                           check=False)
        if r.returncode == 0:
            yield f"{name} {r.stdout}"


def rows_of(text):
    """Rows as [row, what, ours, target, peers, ratio, met] from one benchmark's output."""
    for line in text.splitlines():
        if line.startswith("row "):
            yield [c.strip() for c in line[4:].split("|")]


def reason(what):
    return next((text for pattern, text in REASONS if re.search(pattern, what)), "")


def order(row):
    return (0, int(row[0]), "") if row[0].isdigit() else (1, 0, row[0])


def page(build):
    runs = outputs(build)
    rows = sorted((r for _, _, text in runs for r in rows_of(text)), key=order)
    out = ["# Benchmarks", "",
           "Made by `tests/bench/report.py BUILD`, which runs `meson test --benchmark`. Medians; sides of a comparison take",
           "turns in one run. Rates and times are CPU time of one thread unless a row says otherwise. The ratio is that to the",
           "better peer, above 1 where batten is ahead. Products and sums fuse in the kernels (`-ffp-contract=fast`); nothing",
           "is compiled with `-ffast-math`. One program holds kernels for several vector levels and chooses while running.", ""]
    out += [f"- {line}" for line in machine()]
    level = next((m.group(1) for _, _, t in runs for m in [re.search(r"vector level (\S+),", t)] if m), None)
    if level:
        out.append(f"- vector level {level}")
    waits = [float(x) for _, _, t in runs for x in re.findall(r"wall / CPU ([\d.]+)", t)]
    if waits and sorted(waits)[len(waits) // 2] > BUSY:
        out += ["", f"The machine was busy with other work in this run (wall / CPU up to {max(waits):.1f}). What goes by the",
                "clock (row 22, the jobs) is worse than on an idle one, and CPU times are, too, where two processors share a",
                "core. What a second thread or process brings is given by CPU time: that work divides without more of it, not",
                "that nothing waits; the clock's figures stand below."]
    out += ["", "| row | what | batten | target | peers | ratio | |", "| --- | --- | --- | --- | --- | --- | --- |"]
    out += ["| " + " | ".join(r) + " |" for r in rows]
    missed = [r for r in rows if r[6] == "not met"]
    if missed:
        out += ["", "## Not met", ""]
        out += [f"- {r[1]}: {r[2]}, target {r[3]}. {reason(r[1])}".rstrip() for r in missed]
    out += ["", "## Not measured", ""]
    out += [f"- Row {row}, {what}: {why}." for row, what, why in MISSING]
    out += ["", "## What the benchmarks said beside it", ""]
    for name, result, text in runs:
        rest = [line for line in text.splitlines() if line.strip() and not line.startswith("row ")]
        out += [f"{name}{'' if result == 'OK' else ' (' + result + ')'}:", "", "```", *rest, "```", ""]
    return "\n".join(out).rstrip() + "\n"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if "--kept" not in sys.argv:
        run_benchmarks(sys.argv[1])
    with open(os.path.join(ROOT, "docs", "benchmarks.md"), "w", encoding="utf-8") as f:
        f.write(page(sys.argv[1]))


main()
