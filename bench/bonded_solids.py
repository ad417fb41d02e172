#!/usr/bin/env python3
"""Measures bonded solids and puts what it finds into docs/: the tables of bonded-solids.md (between its comments `<!-- table: NAME -->` and
`<!-- end -->`), bonded-solids.csv and bonded-solids.png.

    cmake --preset release && cmake --build --preset release --target bonded_solids

Three things: where the steps of each bond law blow up (bond_limits.cpp), the error of Young's modulus of a ball of lattice (elastic_sphere)
and that of the bulk modulus of random networks (amorphous_solid), both over their size. Errors do not depend on the machine. Run times are
seconds of one processor in the program, which count on an idle machine only; some five minutes in all.

With --full FOLDER instead: what the published sizes found, from FOLDER/NAME/result.json. Each NAME is the output of a run by hand, of
minutes to an hour:

    elastic_sphere --full --threads 1 --output FOLDER/elastic_sphere      (and core_shell_sphere, viscoelastic_sphere, amorphous_solid)
    viscoelastic_sphere --full --resolution 16 --threads 1 --output FOLDER/viscoelastic_sphere_16
"""
import csv
import json
import math
import re
import statistics
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from processes import Failure, draw, execute, new_parser, put_table, require_gnuplot, result_of, run_script

BALLS = (8, 12, 16, 24, 32)    # R/l
CUBES = (6, 8, 10, 14)        # edges [a0]
VARIANTS = ("k const", "kL const", "kL-tune", "ikL-tune")
TUNING_BOUNDS = {"kL-tune": 2, "ikL-tune": 10}  # of 57,000 springs, one thread [s]
PRESSURE = 3 * 100 * 0.01 / 1.01**2  # Cauchy stress of a cube with K = 100, expanded by 1 % [k0/a0]


@dataclass
class Point:
    curve: str
    size: float     # R/l, or the edge [a0]
    beads: int
    error: float    # |measured/theory - 1|
    scatter: float  # of the local stress, over the stress; NaN of balls
    seconds: float
    order: float | None = None  # to the point before, in the size


def with_order(points):
    for before, after in zip(points, points[1:]):
        after.order = math.log(before.error / after.error) / math.log(after.size / before.size)
    return points


def balls(program, folder):
    """A4, plates at a generic angle to the lattice."""
    points = []
    for size in BALLS:
        done = execute([program, "--resolution", str(size), "--threads", "1", "--output", folder], statuses=(0, 1))
        result = result_of(done)
        error = abs(result["errors"][f"A4, R = {size} l, q1: E/E_theory - 1"]["value"])
        points.append(Point("ball of lattice", size, result["particles"], error, math.nan, done.seconds))
        print(f"A4, R = {size} l: error {error:.3g}, {done.seconds:.3g} s", file=sys.stderr)
    return with_order(points)


def networks(program, folder):
    """B4 to B7: the mean of seeds; and what tuning takes (B12)."""
    curves = {variant: [] for variant in VARIANTS}
    tunings = []
    for edge in CUBES:
        execute([program, "--resolution", str(edge), "--threads", "1", "--output", folder], statuses=(0, 1))
        with open(Path(folder) / f"cube_{edge}.csv") as file:
            rows = list(csv.DictReader(file))
        for n, variant in enumerate(VARIANTS):
            seeds = [row for row in rows if int(row["variant [-]"]) == n]
            mean = lambda value: statistics.mean(map(value, seeds))
            error = mean(lambda row: abs(float(row["relaxed mean [k0/a0]"]) / PRESSURE - 1))
            scatter = mean(lambda row: float(row["Delta sigma22 [k0/a0]"]) / PRESSURE)
            seconds = mean(lambda row: float(row["processor [s]"]))
            curves[variant].append(Point(variant, edge, int(seeds[0]["beads [-]"]), error, scatter, seconds))
            print(f"{variant}, edge {edge} a0: error {error:.3g}, {seconds:.3g} s", file=sys.stderr)
            if variant.endswith("-tune"):
                tuning, rest = (mean(lambda row: float(row[name])) for name in ("tuning [s]", "state of rest [s]"))
                solves, iterations = (mean(lambda row: float(row[f"tuning {name} [-]"])) for name in ("solves", "iterations"))
                bound = f"{TUNING_BOUNDS[variant]} s" if edge == 10 else ""
                tunings.append(f"| {variant} | {seeds[0]['springs [-]']} | {solves:.0f} | {iterations / solves:.0f} | "
                               f"{tuning / rest:.1f} | {tuning:.2g} s | {bound} |")
    lines = ["| variant | springs | solves | iterations of each | states of rest that take as long | run time | specified (B12) |",
             "|---|---|---|---|---|---|---|", *sorted(tunings, reverse=True, key=lambda line: line.startswith("| kL"))]
    return [with_order(points) for points in curves.values()], "\n".join(lines)


def limits(program):
    lines = ["| body | bond law | stated bound | exact | measured | measured / stated |", "|---|---|---|---|---|---|"]
    for row in csv.DictReader(execute([program]).text.splitlines()):
        steps = (f"{float(row[name]):.4g}" for name in ("bound", "exact", "measured"))
        ratio = float(row["measured"]) / float(row["bound"])
        lines.append(f"| {row['body']} | {row['law']} | " + " | ".join(steps) + f" | {ratio:.2f} |")
    return "\n".join(lines)


FULL = ("elastic_sphere", "viscoelastic_sphere", "viscoelastic_sphere_16", "core_shell_sphere", "amorphous_solid")
CASES = {"HC-SS": "A10, A11", "SC-HS": "A12, A13", "plates": "plates differ in force"}  # of errors whose names do not begin with the case


def full_table(folder):
    """One line for each case of each run: how many bounds it has, how many hold, and the one that is nearest or missed by most."""
    lines = ["| run | case | bounds that hold | nearest to its bound | value | bound |", "|---|---|---|---|---|---|"]
    for run in FULL:
        path = folder / run / "result.json"
        if not path.exists():
            lines.append(f"| {run} | | not run | | | |")
            continue
        cases = {}
        for name, error in json.loads(path.read_text())["errors"].items():
            first = re.split("[ ,:]", name, maxsplit=1)[0]
            cases.setdefault(CASES.get(first, first), []).append((name, error["value"], error["bound"]))
        share = lambda one: abs(one[1]) / one[2] if one[2] > 0 else math.inf if one[1] else 0.0
        for case in sorted(cases, key=lambda case: [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", case)]):
            errors = cases[case]
            name, value, bound = max(errors, key=share)
            holds = sum(share(one) <= 1 for one in errors)
            short = name.removeprefix(case).lstrip(",: ")
            lines.append(f"| {run} | {case} | {holds} of {len(errors)} | {short} | {value:.3g} | {bound:.3g} |")
    if all("not run" in line for line in lines[2:]):
        raise Failure(f"{folder} holds no result.json of {', '.join(FULL)}")
    return "\n".join(lines)


def ball_table(points):
    lines = ["| R/l | beads | error of E | order | run time [s] |", "|---|---|---|---|---|"]
    for p in points:
        lines.append(f"| {p.size} | {p.beads} | {100 * p.error:.2g} % | {'' if p.order is None else f'{p.order:.1f}'} | {p.seconds:.3g} |")
    return "\n".join(lines)


def network_table(curves):
    lines = ["| beads | " + " | ".join(VARIANTS) + " |", "|---|" + "---|" * len(VARIANTS)]
    for points in zip(*curves):
        cells = (f"{100 * p.error:.2g} %, scatter {100 * p.scatter:.2g} %, in {p.seconds:.3g} s" for p in points)
        lines.append(f"| {points[0].beads} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def write_csv(curves, path):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["curve", "size", "beads", "error", "scatter of the stress", "run time [s]", "order"])
        for p in (point for points in curves for point in points):
            scatter = "" if math.isnan(p.scatter) else f"{p.scatter:.4g}"
            order = "" if p.order is None else f"{p.order:.2f}"
            writer.writerow([p.curve, p.size, p.beads, f"{p.error:.4g}", scatter, f"{p.seconds:.3g}", order])


def draw_errors(ball, nets, path):
    blocks = [f"${name} << EOD\n" + "\n".join(f"{p.seconds} {p.error}" for p in points) + "\nEOD" for name, points in
              [("ball", ball)] + [(f"net{n}", points) for n, points in enumerate(nets)]]
    curves = ", ".join(f"$net{n} with linespoints pt {n + 4} title '{variant}'" for n, variant in enumerate(VARIANTS))
    script = (f"set terminal pngcairo size 1400,520\nset output '{path}'\n" + "\n".join(blocks) +
              "\nset logscale\nset format '10^{%T}'\nset grid\nset xlabel 'run time, one thread [s]'\nset ylabel 'error'\n"
              "set multiplot layout 1,2\nset title 'Young modulus of a ball of lattice between plates (A4)'\n"
              "plot $ball with linespoints pt 4 title 'R/l = " + ", ".join(map(str, BALLS)) +
              "'\nset title 'bulk modulus of random networks (B4 to B7)'\nset key bottom left\nplot " + curves + "\nunset multiplot\n")
    draw(script)


def write(options):
    page = options.docs / "bonded-solids.md"
    if options.full:
        put_table(page, "full", full_table(options.full))
        return
    if not all((options.bond_limits, options.elastic_sphere, options.amorphous_solid)):
        raise Failure("give all three programs, or --full")
    require_gnuplot()
    put_table(page, "limits", limits(options.bond_limits))
    with tempfile.TemporaryDirectory() as folder:
        ball = balls(options.elastic_sphere, folder)
        nets, tunings = networks(options.amorphous_solid, folder)
    put_table(page, "ball", ball_table(ball))
    put_table(page, "networks", network_table(nets))
    put_table(page, "tuning", tunings)
    write_csv([ball, *nets], options.docs / "bonded-solids.csv")
    draw_errors(ball, nets, options.docs / "bonded-solids.png")


def main():
    parser = new_parser(__doc__)
    parser.add_argument("--docs", type=Path, required=True, help="folder of bonded-solids.md")
    for program in ("bond-limits", "elastic-sphere", "amorphous-solid"):
        parser.add_argument(f"--{program}", type=Path, help="the program")
    parser.add_argument("--full", type=Path, help="folder of results at full size; nothing else is done")
    run_script(parser, write)


if __name__ == "__main__":
    main()
