#!/usr/bin/env python3
"""Runs the scenes of this folder with LAMMPS and with dmp, in turn, and prints what each takes as a Markdown table.

    cmake --preset release && cmake --build --preset release --target lammps_scenes
    bench/lammps/compare.py --lmp PATH/TO/lmp --dmp build/release/bench/lammps_scenes --page docs/performance.md

lmp: any LAMMPS with the packages SPH and MOLECULE, compiled for this machine; for a fair comparison with the same flags as the scenes.
A comparison counts only on an idle machine. The time is that between the start and the end of the timed steps, after a warm-up, output off:
"Loop time" of LAMMPS, and the same span in dmp. The memory is what a run has resident at its peak, less that of a program without a scene:
for LAMMPS, of a run of a tiny scene. The results agree to rounding, but for the membrane: there `fix viscous` sees another velocity than
drag does in dmp, see in.membrane.
"""
import argparse
import csv
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent.parent))
from processes import Failure, execute, put_table

FOLDER = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Case:
    name: str
    scene: str
    size: dict  # options of both codes: -var n 24 for LAMMPS, --n 24 for dmp
    steps: int
    warm: int
    tiny: dict | None  # a size too small to take memory; None: the scene has one size, too small to tell its memory


TINY_DAM = {"n": 8, "w": 8}
CASES = [
    Case("dam break 3D, 31k", "dam3d", {"n": 24, "w": 32}, 300, 100, TINY_DAM),
    Case("dam break 3D, 252k", "dam3d", {"n": 56, "w": 63}, 160, 20, TINY_DAM),
    Case("dam break 3D, 1M", "dam3d", {"n": 90, "w": 106}, 90, 10, TINY_DAM),
    Case("Taylor-Green 2D, 100k", "tg2d", {"n": 316}, 150, 50, {"n": 16}),
    Case("springs 3D, 97k", "springs3d", {"n": 46}, 200, 50, {"n": 6}),
    Case("membrane 2D", "membrane", {}, 10000, 1000, None),
]
QUICK_CASES = [
    Case("dam break 3D, 31k", "dam3d", {"n": 24, "w": 32}, 100, 20, TINY_DAM),
    Case("Taylor-Green 2D, 10k", "tg2d", {"n": 100}, 200, 50, {"n": 16}),
    Case("springs 3D, 11k", "springs3d", {"n": 22}, 200, 50, {"n": 6}),
    Case("membrane 2D", "membrane", {}, 2000, 200, None),
]


@dataclass
class Run:
    particles: int
    wall_ns: float  # per particle and step
    processor_ns: float  # the same, of all threads together
    list_builds: int  # during the timed steps
    resident_bytes: float  # LAMMPS: of the whole process; dmp: what the scene added
    figures: dict


def run_lammps(lmp, case, size, steps, warm, ranks, folder):
    command = [lmp, "-in", FOLDER / f"in.{case.scene}", "-log", "none"]
    for name, value in {**size, "steps": steps, "warm": warm}.items():
        command += ["-var", name, str(value)]
    if ranks > 1:
        root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        command = ["mpirun", *root, "-np", str(ranks), *command]
    text, resident, _ = execute(command, 1, folder)
    pattern = r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms.*?(\S+)% CPU use with.*?Neighbor list builds = (\d+)"
    loops = [loop for loop in re.findall(pattern, text, re.DOTALL) if int(loop[1]) > 0]  # the warm-up and the timed steps
    if len(loops) != 2 or int(loops[1][1]) != steps:
        raise Failure(f"LAMMPS printed no time of {steps} steps of in.{case.scene}")
    seconds, particles, use = float(loops[-1][0]), int(loops[-1][2]), float(loops[-1][3])
    builds = int(loops[-1][4]) - int(loops[-2][4])  # LAMMPS goes on counting in a run that is started with `pre no`
    nanoseconds = 1e9 * seconds / (particles * steps)
    figures = {name: float(value) for name, value in re.findall(r"^figure (\S+) +(\S+)$", text, re.MULTILINE)}
    return Run(particles, nanoseconds, nanoseconds * use / 100.0 * ranks, builds, resident, figures)


def run_dmp(dmp, case, size, steps, warm, threads, folder):
    command = [dmp, "--scene", case.scene]
    for name, value in {**size, "steps": steps, "warm": warm}.items():
        command += [f"--{name}", str(value)]
    text = execute(command, threads, folder).text
    lines = re.findall(r"^result: (\{.*\})$", text, re.MULTILINE)
    if len(lines) != 1:
        raise Failure(f"{dmp} printed no result; is it the program lammps_scenes?")
    result = json.loads(lines[0])
    particles = result["particles"]
    return Run(particles, result["wall_ns"], result["processor_ns"], result["list_builds"], result["bytes_per_particle"] * particles,
               result["figures"])


def largest_difference(one, other):
    """Of the result figures, relative; and whose it is."""
    if one.keys() != other.keys() or not one:
        raise Failure(f"the codes print different figures: {sorted(one)} and {sorted(other)}")
    largest = max(one, key=lambda name: relative(one[name], other[name]))
    return relative(one[largest], other[largest]), largest


def relative(one, other):
    return 0.0 if one == other else abs(one - other) / max(abs(one), abs(other))


def measure(case, options, folder, log):
    """One row of the table."""
    lammps, dmp = [], []
    baseline = None
    if case.tiny is not None and options.threads == 1:
        baseline = run_lammps(options.lmp, case, case.tiny, 1, 1, 1, folder)
    for repeat in range(options.repeats):
        lammps.append(run_lammps(options.lmp, case, case.size, case.steps, case.warm, options.threads, folder))
        dmp.append(run_dmp(options.dmp, case, case.size, case.steps, case.warm, options.threads, folder))
        for code, run in (("LAMMPS", lammps[-1]), ("dmp", dmp[-1])):
            log.append([case.name, repeat, code, options.threads, run.particles, case.steps, run.list_builds, f"{run.wall_ns:.2f}",
                        f"{run.processor_ns:.2f}", f"{run.resident_bytes:.0f}", json.dumps(run.figures)])
        print(f"{case.name}, {repeat + 1} of {options.repeats}: LAMMPS {lammps[-1].wall_ns:.1f} ns, dmp {dmp[-1].wall_ns:.1f} ns",
              file=sys.stderr)
    if lammps[0].particles != dmp[0].particles:
        raise Failure(f"{case.name}: {lammps[0].particles} particles in LAMMPS, {dmp[0].particles} in dmp")
    times = [[run.wall_ns if options.clock == "wall" else run.processor_ns for run in runs] for runs in (lammps, dmp)]
    ratios = [one / other for one, other in zip(times[0], times[1])] + [one / other for one, other in zip(times[0][1:], times[1])]
    memory = "-", "-"
    if baseline is not None:
        growth = statistics.median(run.resident_bytes for run in lammps) - baseline.resident_bytes
        memory = (f"{growth / (lammps[0].particles - baseline.particles):.0f}",
                  f"{statistics.median(run.resident_bytes for run in dmp) / dmp[0].particles:.0f}")
    difference, figure = max(largest_difference(one.figures, other.figures) for one, other in zip(lammps, dmp))
    return [case.name, str(lammps[0].particles), *(f"{statistics.median(values):.1f}" for values in times),
            f"{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})", *memory,
            f"{lammps[-1].list_builds} / {dmp[-1].list_builds}", f"{difference:.0e} ({figure.replace('_', ' ')})"]


def check_programs(options):
    for name, path in (("--lmp", options.lmp), ("--dmp", options.dmp)):
        if shutil.which(path) is None:
            raise Failure(f"{name}: no such program: {path}")
    options.lmp, options.dmp = (str(Path(shutil.which(path)).resolve()) for path in (options.lmp, options.dmp))
    help_text = subprocess.run([options.lmp, "-h"], capture_output=True, text=True, check=False).stdout
    for style, package in (("sph/taitwater", "SPH"), ("bond", "MOLECULE")):
        if not re.search(rf"(^|\s){re.escape(style)}(\s|$)", help_text):
            raise Failure(f"--lmp: {options.lmp} has no style {style}; build LAMMPS with -D PKG_{package}=on")
    if options.threads > 1 and shutil.which("mpirun") is None:
        raise Failure("--threads: LAMMPS needs mpirun for more than one thread, and there is none")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", required=True, help="LAMMPS executable")
    parser.add_argument("--dmp", required=True, help="the program lammps_scenes")
    parser.add_argument("--repeats", type=int, default=5, help="pairs of runs of each scene (5)")
    parser.add_argument("--threads", type=int, default=1, help="MPI ranks of LAMMPS, OpenMP threads of dmp (1); memory is told for 1 only")
    parser.add_argument("--scene", action="append", choices=["dam3d", "tg2d", "springs3d", "membrane"],
                        help="only this one; may be repeated")
    parser.add_argument("--clock", choices=["wall", "processor"], default="wall", help="processor: time of all threads together (wall)")
    parser.add_argument("--quick", action="store_true", help="small scenes, few steps: whether it works and agrees, not how fast it is")
    parser.add_argument("--output", type=Path, help="folder for all single runs; without it they are not kept")
    parser.add_argument("--page", type=Path, help="page that gets the table, between its comments; without it it is printed only")
    options = parser.parse_args()
    if options.repeats < 1 or options.threads < 1:
        parser.error("--repeats and --threads must be >= 1")
    return options


HEADER = ["scene", "particles", "LAMMPS, ns", "dmp, ns", "LAMMPS / dmp", "LAMMPS, bytes", "dmp, bytes", "list builds",
          "largest difference of a result"]
RUN_HEADER = ["case", "repeat", "code", "threads", "particles", "steps", "list builds", "wall ns", "processor ns", "resident bytes",
              "figures"]


def main():
    options = parse_arguments()
    check_programs(options)
    cases = [case for case in (QUICK_CASES if options.quick else CASES) if not options.scene or case.scene in options.scene]
    if options.output is not None:
        options.output.mkdir(parents=True, exist_ok=True)
    log = [RUN_HEADER]
    lines = [f"Nanoseconds ({options.clock} time) per particle and step, bytes per particle; threads: {options.threads}; medians of "
             f"{options.repeats}; ratios of adjacent runs: median (least to largest).", "",
             "| " + " | ".join(HEADER) + " |", "|" + "---|" * len(HEADER)]
    with tempfile.TemporaryDirectory() as folder:
        for case in cases:
            lines.append("| " + " | ".join(measure(case, options, Path(folder), log)) + " |")
    table = "\n".join(lines)
    print(table)
    if options.page is not None:
        put_table(options.page, "lammps", table)
    if options.output is not None:
        with open(options.output / "runs.csv", "w", newline="") as file:
            csv.writer(file).writerows(log)


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"compare.py: {failure}")
