#!/usr/bin/env python3
"""Runs the benchmarks in turn, several rounds of them, and prints Markdown tables: each bound with what was measured, where a step's
time goes, and how it depends on the skin and on the number of particles.

    cmake --preset release && cmake --build --preset release --target report

Linux only. It takes some ten minutes and counts only on an idle machine. A ratio is taken within each round; printed are the median over
the rounds and, in brackets, the least and the largest. Sweeps are timed as the yardstick does it, the best of 7 in succession, which find
in the cache what they left there. Steps are means over 40 and more of them: processor time where one thread is at work, else time on the
clock; how threads speed it up is all time on the clock.
The yardstick is a program apart, of plain and of hand-vectorised loops; what refers to it is left out without it. How much work several
threads can do at the best is measured as well: by as many programs of one thread, which share nothing but the machine.
"""
import argparse
import csv
import json
import os
import re
import shutil
import statistics
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

from processes import Failure, execute, put_table, table

THREADS = (2, 4)
SKINS = (50, 100, 125, 175, 200, 300)  # thousandths of the support
SIDES = (22, 50, 100)
LARGE_SIDE = 160
LAW_HEADERS = ("dmp/kernel/lucy.hpp", "dmp/bond/harmonic.hpp")  # the slower one counts


@dataclass
class Measured:
    """One quantity over the rounds."""
    values: list

    def __truediv__(self, other):
        return Measured([one / another for one, another in zip(self.values, other.values)])

    def __add__(self, other):
        return Measured([one + another for one, another in zip(self.values, other.values)])

    def times(self, factor):
        return Measured([factor * value for value in self.values])

    @property
    def median(self):
        return statistics.median(self.values)

    def text(self, digits):
        if min(self.values) == max(self.values):
            return f"{self.median:.{digits}f}"
        return f"{self.median:.{digits}f} ({min(self.values):.{digits}f} to {max(self.values):.{digits}f})"


@dataclass
class Bound:
    what: str
    measured: Measured
    sign: str  # <= or >=
    limit: float
    unit: str = ""

    def row(self):
        holds = self.measured.median <= self.limit if self.sign == "<=" else self.measured.median >= self.limit
        text = self.measured.text(0 if self.limit >= 100.0 else 2)
        return [self.what, text + self.unit, f"{self.sign} {self.limit:g}{self.unit}", "yes" if holds else "**no**"]


# ---- Programs


def time_of_others():
    """Processor seconds of everything on this machine but this program and what it has run; and the time of day, in seconds."""
    with open("/proc/stat") as file:
        user, nice, system, _, _, *interrupts_and_steal = map(int, file.readline().split()[1:9])
    busy = (user + nice + system + sum(interrupts_and_steal)) / os.sysconf("SC_CLK_TCK")
    own = os.times()
    return busy - sum(own[:4]), monotonic()


def run_yardstick(program):
    """Nanoseconds per directed pair, or per bond, by the name of the loop."""
    lines = re.findall(r"^(\S.*?) +(\S+) ns/item", execute([program]).text, re.MULTILINE)
    if not lines:
        raise Failure(f"--yardstick: {program} printed no times")
    return {f"yardstick, {name}": float(value) for name, value in lines}


def run_benchmarks(program, pattern, repetitions, least_seconds):
    """Counters by benchmark and name, the least of the repetitions; and the resident memory of the program."""
    command = [program, f"--benchmark_filter={pattern}", f"--benchmark_repetitions={repetitions}", f"--benchmark_min_time={least_seconds}",
               "--benchmark_format=json"]
    text, resident, _ = execute(command)
    result = {}
    for run in json.loads(text)["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        if run.get("error_occurred"):
            raise Failure(f"{run['name']}: {run.get('error_message')}")
        benchmark = re.sub(r"/(real_time|manual_time)$", "", run["run_name"])
        for name in ("ns/pair", "ns/bond", "ns/particle", "bytes/particle", "list builds/step", "sweep ns", "lists ns", "rest ns"):
            if name in run:
                key = f"{benchmark}, {name}"
                result[key] = min(result.get(key, float("inf")), run[name])
        if "ns/particle" in run:
            result[f"{benchmark}, processor ns/particle"] = run["ns/particle"] * run["cpu_time"] / run["real_time"]
    if not result:
        raise Failure(f"{program} has no benchmark {pattern}")
    return result, resident


def run_at_once(program, count):
    """Nanoseconds per particle and step of `count` programs of one thread each, the mean of them."""
    benchmark = "whole_step/63/1"
    with ThreadPoolExecutor(count) as pool:
        found = pool.map(lambda _: run_benchmarks(program, f"{benchmark}/", 1, 1.0)[0][f"{benchmark}, ns/particle"], range(count))
    return {f"{count} programs at once, ns/particle": statistics.mean(found)}


def run_round(options):
    """All quantities once."""
    result = run_yardstick(options.yardstick) if options.yardstick else {}
    for program in (options.pair_sweep, options.bond_sweep):  # an iteration is one sweep: repetitions of one iteration each
        result |= run_benchmarks(program, ".", 7, 0.001)[0]
    for side in SIDES[:1] + SIDES[2:] + ((LARGE_SIDE,) if options.large else ()):  # programs apart, for their memory
        found, resident = run_benchmarks(options.step, f"whole_step/{side}/", 1, 0.5)
        result |= found | {f"whole_step/{side}, resident bytes": resident}
    for count in THREADS:
        result |= run_at_once(options.step, count)
    return result | run_benchmarks(options.step, "parts_of_step|whole_step/(50|63)/", 1, 0.5)[0]


def run_compile_cost(program):
    """Seconds and MiB by header or example."""
    lines = re.findall(r"^(\S+) +(\S+) s +(\S+) MiB", execute([program]).text, re.MULTILINE)
    if not lines:
        raise Failure(f"--compile-cost: {program} printed no times")
    return {name: (float(seconds), float(mebibytes)) for name, seconds, mebibytes in lines}


# ---- Tables


def particles(side):
    return f"{side ** 3:,}".replace(",", " ")


def resident_per_particle(of):
    """What a million particles add to the memory of a program with few."""
    small, large = SIDES[0], SIDES[2]
    growth = of(f"whole_step/{large}, resident bytes") + of(f"whole_step/{small}, resident bytes").times(-1.0)
    return growth.times(1.0 / (large ** 3 - small ** 3))


def part(of, side, name, skin=0):
    """Nanoseconds of a part of a step, from one building of lists to another."""
    return of(f"parts_of_step/{side}/{skin}, {name} ns")


def whole(of, side, skin=0):
    """A step as the sum of its parts."""
    return part(of, side, "sweep", skin) + part(of, side, "lists", skin) + part(of, side, "rest", skin)


def bounds(of, compile_cost, has_yardstick):
    composed, by_hand = ({precision: of(f"pair_sweep_{how}<precision::{precision}>, ns/pair") for precision in ("Double", "Single")}
                         for how in ("composed", "by_hand"))
    full, half = ("yardstick, pair scalar full list", "yardstick, pair scalar half list")
    rows = []
    if has_yardstick:
        rows += [Bound("pair sweep, double: faster than the yardstick's scalar full list", of(full) / composed["Double"], ">=", 3.0),
                 Bound("pair sweep, double: faster than its half list", of(half) / composed["Double"], ">=", 2.0)]
        rows += [Bound(f"pair sweep, {name}: time over that of its AVX2 loop", composed[name.title()] / of(f"yardstick, pair AVX2 {name}"),
                       "<=", 1.3) for name in ("double", "single")]
    rows += [Bound(f"pair sweep, {name.lower()}: composed over written by hand", time / by_hand[name], "<=", 1.05)
             for name, time in composed.items()]
    for side in SIDES[1:]:
        sweep, lists = part(of, side, "sweep"), part(of, side, "lists")
        rows += [Bound(f"whole step over its sweep, {particles(side)} particles", whole(of, side) / sweep, "<=", 1.35),
                 Bound(f"list build per step over the sweep, {particles(side)} particles", lists / sweep, "<=", 0.15)]
    rows += [Bound(f"{threads} threads: whole step faster than with 1, {particles(63)} particles",
                   of("whole_step/63/1, ns/particle") / of(f"whole_step/63/{threads}, ns/particle"), ">=", least)
             for threads, least in zip(THREADS, (1.85, 3.5))]
    if has_yardstick:
        loop = of("yardstick, bond scalar, both sides")
        rows.append(Bound("bond sweep: faster than the yardstick's scalar loop", loop / of("bond_sweep_composed, ns/bond"), ">=", 2.0))
    rows.append(Bound("1.1 million bonds: whole step over the bond sweep", of("bond_step, ns/bond") / of("bond_sweep_composed, ns/bond"),
                      "<=", 1.3))
    large, small = (of(f"whole_step/{side}/1, processor ns/particle") for side in (SIDES[2], SIDES[0]))
    rows += [Bound(f"time per particle-step, {particles(SIDES[2])} particles over {particles(SIDES[0])}", large / small, "<=", 1.25),
             Bound(f"memory per particle, resident, {particles(SIDES[2])} particles", resident_per_particle(of), "<=", 600.0, " B"),
             Bound("compile `dam_break` at -O2", Measured([compile_cost["examples/dam_break.cpp"][0]]), "<=", 10.0, " s"),
             Bound("the same, memory", Measured([compile_cost["examples/dam_break.cpp"][1]]), "<=", 700.0, " MiB"),
             Bound("compile one law header alone", Measured([max(compile_cost[header][0] for header in LAW_HEADERS)]), "<=", 0.5, " s")]
    return table(["", "measured", "bound", "holds"], [row.row() for row in rows])


def threads(of):
    rows = []
    for count in THREADS:
        alone = of("whole_step/63/1, ns/particle")
        speedup = alone / of(f"whole_step/63/{count}, ns/particle")
        most = (alone / of(f"{count} programs at once, ns/particle")).times(count)
        rows.append([str(count), speedup.text(2), most.text(2), (speedup / most).text(2)])
    return table(["threads", "whole step faster than with 1", "work of as many programs of one thread at once", "share of it"], rows)


def sweeps(of, has_yardstick):
    lines = []
    for key in ["pair_sweep_composed<precision::Double>, ns/pair", "pair_sweep_by_hand<precision::Double>, ns/pair",
                "pair_sweep_composed<precision::Single>, ns/pair", "pair_sweep_by_hand<precision::Single>, ns/pair",
                "bond_sweep_composed, ns/bond", "bond_sweep_scalar, ns/bond"]:
        name, unit = key.rsplit(", ns/", 1)
        lines.append([f"`{name}`", unit, of(key).text(2)])
    if has_yardstick:
        for name in ("pair scalar full list", "pair scalar half list", "pair AVX2 double", "pair AVX2 single", "bond scalar, both sides"):
            lines.append([f"yardstick, {name}", name.split()[0], of(f"yardstick, {name}").text(2)])
    return table(["", "of one", "ns"], lines)


def profile(of):
    rows = []
    for name, meaning in (("sweep", "sweep over the pairs"), ("lists", "list build with sorting and ghosts, per step"),
                          ("rest", "rest: integration, material laws, records")):
        cells = [meaning]
        for side in SIDES[1:]:
            time = part(of, side, name)
            cells += [time.text(0), f"{(time / whole(of, side)).times(100.0).median:.0f} %"]
        rows.append(cells)
    total, builds = ["whole step"], ["steps between list builds"]
    for side in SIDES[1:]:
        total += [whole(of, side).text(0), "100 %"]
        builds += [steps_between_builds(of, f"parts_of_step/{side}/0"), ""]
    header = [""] + [text for side in SIDES[1:] for text in (f"{particles(side)} particles, ns", "")]
    return table(header, [*rows, total, builds])


def steps_between_builds(of, benchmark):
    return f"{1.0 / of(f'{benchmark}, list builds/step').median:.1f}"


def skins(of):
    rows = []
    for skin in (0, *SKINS):
        time, benchmark = whole(of, 50, skin), f"parts_of_step/50/{skin}"
        lists = part(of, 50, "lists", skin) / part(of, 50, "sweep", skin)
        rows.append([f"{skin / 1000:g}" if skin else "as a scene chooses it", time.text(0), (time / whole(of, 50)).text(2), lists.text(2),
                     steps_between_builds(of, benchmark), f"{of(f'{benchmark}, bytes/particle').median:.0f}"])
    return table(["skin / support", "ns per particle-step", "over the first line", "list build / sweep", "steps between list builds",
                  "bytes per particle"], rows)


def growth(of, large):
    rows, first = [], of(f"whole_step/{SIDES[0]}/1, processor ns/particle")
    for side in SIDES + ((LARGE_SIDE,) if large else ()):
        benchmark = f"whole_step/{side}/1"
        time = of(f"{benchmark}, processor ns/particle")
        rows.append([particles(side), time.text(0), (time / first).text(2), steps_between_builds(of, benchmark),
                     f"{of(f'{benchmark}, bytes/particle').median:.0f}"])
    return table(["particles", "ns per particle-step", "over the first line", "steps between list builds", "bytes per particle"], rows)


def compile_table(compile_cost):
    rows = [[f"`{name}`", f"{seconds:.2f}", f"{mebibytes:.0f}"] for name, (seconds, mebibytes) in compile_cost.items()]
    return table(["", "s", "MiB"], rows)


def report(rounds, compile_cost, options, others):
    def of(key):
        if any(key not in values for values in rounds):
            raise Failure(f"no benchmark measured: {key}; do the programs belong to this report?")
        return Measured([values[key] for values in rounds])

    has_yardstick = options.yardstick is not None
    conditions = (
        f"{options.repeats} rounds on {len(os.sched_getaffinity(0))} processors, of which others kept {others:.1f} busy meanwhile. Medians "
        "(least to largest); ratios are taken within a round. Sweeps: best of 7 in succession, as the yardstick. Steps: means over 40 or "
        "more, processor time, but for threads. Compiling: the better of two." + ("" if has_yardstick else " No yardstick was given."))
    return {"conditions": conditions, "bounds": bounds(of, compile_cost, has_yardstick), "threads": threads(of),
            "sweeps": sweeps(of, has_yardstick), "profile": profile(of), "skin": skins(of), "growth": growth(of, options.large),
            "compiling": compile_table(compile_cost)}


# ---- Command line


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("pair-sweep", "bond-sweep", "step", "compile-cost"):
        parser.add_argument(f"--{name}", required=True, help=f"the program {name.replace('-', '_')}")
    parser.add_argument("--yardstick", help="the yardstick's program; without it its rows are left out")
    parser.add_argument("--repeats", type=int, default=5, help="rounds (5)")
    parser.add_argument("--large", action="store_true", help=f"also {particles(LARGE_SIDE)} particles: 3 GiB, 2 minutes more per round")
    parser.add_argument("--output", type=Path, help="folder for all single values, runs.csv; without it they are not kept")
    parser.add_argument("--page", type=Path, help="page that gets the tables, between its comments; without it they are printed only")
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error("--repeats must be >= 1")
    for name in ("pair_sweep", "bond_sweep", "step", "compile_cost", "yardstick"):
        path = getattr(options, name)
        if path is not None and shutil.which(path) is None:
            parser.error(f"--{name.replace('_', '-')}: no such program: {path}")
    return options


def main():
    options = parse_arguments()
    if options.output is not None:
        options.output.mkdir(parents=True, exist_ok=True)
    start, rounds = time_of_others(), []
    for number in range(options.repeats):
        rounds.append(run_round(options))
        step = rounds[-1]["whole_step/50/1, ns/particle"]
        print(f"round {number + 1} of {options.repeats}: a step takes {step:.0f} ns per particle", file=sys.stderr)
    end = time_of_others()
    others = (end[0] - start[0]) / (end[1] - start[1])
    print("compiling", file=sys.stderr)
    compile_cost = run_compile_cost(options.compile_cost)
    for name, text in report(rounds, compile_cost, options, others).items():
        print(f"{name}\n\n{text}\n")
        if options.page is not None:
            put_table(options.page, name, text)
    if options.output is not None:
        with open(options.output / "runs.csv", "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["round", "quantity", "value"])
            writer.writerows([number, key, value] for number, values in enumerate(rounds) for key, value in values.items())
            for name, cost in compile_cost.items():
                writer.writerows(["", f"compile {name}, {unit}", value] for unit, value in zip(("s", "MiB"), cost))


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"report.py: {failure}")
