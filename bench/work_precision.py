#!/usr/bin/env python3
"""Runs examples over resolution and kernel, and puts error against run time into docs/: accuracy.csv, accuracy.png and the tables of
accuracy.md (between its comments `<!-- table: CASE -->` and `<!-- end -->`).

    cmake --preset release && cmake --build --preset release --target work_precision

The errors are those of the examples, against exact solutions, and do not depend on the machine. The run time is that of the steps, one
thread, the median of three runs; it counts on an idle machine only. The order of convergence is that between two resolutions. A support
radius is 2.6 spacings for every kernel.
"""
import argparse
import csv
import math
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from processes import Failure, execute, replace_table, result_of

KERNELS = ("Lucy", "CubicSpline", "WendlandC2", "WendlandC4")
RUNS = 3


@dataclass(frozen=True)
class Case:
    name: str
    example: str
    what: str       # the error, in words
    error: str      # its name in the result line, N for the resolution
    resolutions: tuple


CASES = (
    Case("NASG-1", "shock_tube", "shock tube of water, 1000 bar: L1 error of the pressure", "1000 bar, N = {N}: L1 of p over p_L",
         (100, 200, 400, 800, 1600)),
    Case("VISC-1", "poiseuille", "start-up of Poiseuille flow: L2 error of the velocity", "Poiseuille, N = {N}: L2 of u", (10, 20, 40, 80)),
    Case("VISC-2", "variable_viscosity", "channel with a hot wall, viscosity ratio 3: L2 error of the velocity",
         "VISC-2, m = 3, N = {N}: L2 of u", (10, 20, 40)),
    Case("HX-2", "heat_conduction", "two half-spaces of unequal conductivity: L2 error of the temperature",
         "HX-2, harmonic mean, N = {N}: L2 of T", (10, 20, 40, 80)),
)


@dataclass
class Point:
    case: str
    kernel: str
    resolution: int
    particles: int
    steps: int
    error: float
    seconds: float
    order: float | None = None


def measure(case, kernel, resolution, programs, folder):
    """One point of a curve: the error of a run, and the median time of several."""
    program = programs / f"work_precision_{case.example}_{kernel}"
    seconds = []
    for _ in range(RUNS):
        # Bounds are those of Lucy's kernel: others may miss them (status 1).
        text, _ = execute([program, "--resolution", str(resolution), "--threads", "1", "--output", folder], statuses=(0, 1))
        result = result_of(text)
        seconds.append(result["wall_seconds"])
    error = result["errors"][case.error.format(N=resolution)]["value"]
    return Point(case.name, kernel, resolution, result["particles"], result["steps"], error, statistics.median(seconds))


def curves(programs):
    points = []
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            for kernel in KERNELS:
                before = None
                for resolution in case.resolutions:
                    point = measure(case, kernel, resolution, programs, folder)
                    if before:
                        point.order = math.log(before.error / point.error) / math.log(resolution / before.resolution)
                    before = point
                    points.append(point)
                    print(f"{case.name}, {kernel}, N = {resolution}: error {point.error:.3g}, {point.seconds:.3g} s", file=sys.stderr)
    return points


def write_csv(points, path):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "kernel", "N", "particles", "steps", "error", "run time [s]", "order"])
        for p in points:
            writer.writerow([p.case, p.kernel, p.resolution, p.particles, p.steps, f"{p.error:.4g}", f"{p.seconds:.3g}",
                             "" if p.order is None else f"{p.order:.2f}"])


def draw(points, path):
    """Log-log, one panel per case, one curve per kernel."""
    blocks = []
    for case in CASES:
        for kernel in KERNELS:
            rows = [f"{p.seconds} {p.error}" for p in points if p.case == case.name and p.kernel == kernel]
            blocks.append(f"${case.name.replace('-', '_')}_{kernel} << EOD\n" + "\n".join(rows) + "\nEOD")
    panels = []
    for case in CASES:
        curve = ", ".join(f"${case.name.replace('-', '_')}_{kernel} with linespoints pt {n + 4} title '{kernel}'" for n, kernel in enumerate(KERNELS))
        panels.append(f"set title '{case.name}: {case.what.split(': ')[0]}'\nset ylabel '{case.what.split(': ')[1]}'\nplot {curve}")
    script = ("set terminal pngcairo size 1400,1000\nset output '" + str(path) + "'\n" + "\n".join(blocks) +
              "\nset logscale\nset format '10^{%T}'\nset grid\nset xlabel 'run time, one thread [s]'\nset multiplot layout 2,2\n" +
              "\n".join(panels) + "\nunset multiplot\n")
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def table(points, case):
    lines = ["| kernel | " + " | ".join(f"N = {n}" for n in case.resolutions) + " |", "|---|" + "---|" * len(case.resolutions)]
    for kernel in KERNELS:
        cells = []
        for p in points:
            if p.case == case.name and p.kernel == kernel:
                order = "" if p.order is None else f", order {p.order:.1f}"
                cells.append(f"{p.error:.2g} in {p.seconds:.2g} s{order}")
        lines.append(f"| {kernel} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=Path, required=True, help="folder of the programs work_precision_EXAMPLE_KERNEL")
    parser.add_argument("--docs", type=Path, required=True, help="folder of accuracy.md")
    options = parser.parse_args()
    try:
        points = curves(options.programs)
        page = options.docs / "accuracy.md"
        for case in CASES:
            replace_table(page, case.name, table(points, case))
        write_csv(points, options.docs / "accuracy.csv")
        draw(points, options.docs / "accuracy.png")
    except Failure as failure:
        sys.exit(f"work_precision: {failure}")


if __name__ == "__main__":
    main()
