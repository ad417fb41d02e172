#!/usr/bin/env python3
"""Runs examples over resolution (or over the time step) with one choice varied at a time, and puts error against run time into docs/:
accuracy.csv, accuracy_*.png and the tables of accuracy.md (between its comments `<!-- table: CASE -->` and `<!-- end -->`).

    cmake --preset release && cmake --build --preset release --target work_precision

The errors are those of the examples, against exact solutions or published ones, and do not depend on the machine. The run time is the
processor time of the steps on one thread (of the whole program where no scene runs), the least of up to three runs: other programs add to
it, none takes from it. The order of convergence is the slope of log error over log N, fitted by least squares, with its standard error.
"""
import csv
import math
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from processes import draw, execute, new_parser, put_table, require_gnuplot, result_of, run_script, table

RUNS, ENOUGH = 3, 2.0  # a point is run again until it has been run so often, or for so long [s]

KERNELS = ("Lucy", "CubicSpline", "WendlandC2", "WendlandC4")
INTEGRATORS = ("ExtrapolatedVerlet", "LammpsVerlet", "SymplecticEuler", "Leapfrog")
TIME_STEPS = ("0.9", "0.5", "0.25")  # fraction of the bound
COMPILED = ("kernel", "integrator", "precision")  # what CMakeLists.txt compiles an example with; the rest are options


@dataclass(frozen=True)
class Case:
    """An example's error over resolution. Of each kind of choice the first one is the example's own; they are varied one at a time."""
    name: str
    example: str
    what: str          # the error, in words: of what, which
    error: str         # its name in the result line, N for the resolution
    values: tuple      # resolutions, or bounds over the time step
    kinds: dict = field(default_factory=dict)
    sweep: str = "resolution"

    def heading(self, value):
        return f"N = {value}" if self.sweep == "resolution" else f"dt = bound/{value}"


CASES = (
    Case("NASG-1", "shock_tube", "shock tube of water, 1000 bar: L1 error of the pressure", "1000 bar, N = {N}: L1 of p over p_L",
         (100, 200, 400, 800, 1600),
         {"kernel": KERNELS, "support": ("2.6", "2.0", "3.2"), "integrator": INTEGRATORS, "time step": TIME_STEPS}),
    Case("VISC-1", "poiseuille", "start-up of Poiseuille flow: L2 error of the velocity", "Poiseuille, N = {N}: L2 of u",
         (10, 20, 40, 80),
         {"kernel": KERNELS, "support": ("2.6", "2.0", "3.2", "4.0"), "precision": ("Double", "Single"), "integrator": INTEGRATORS,
          "time step": TIME_STEPS}),
    Case("Taylor-Green", "taylor_green", "decaying vortices at Re = 100: L2 error of the velocity",
         "L2 of the velocity at t = L/U, N = {N}", (25, 35, 50, 71, 100),
         {"kernel": ("WendlandC2", "WendlandC4", "Lucy", "CubicSpline"), "support": ("growing from 5", "4.0", "5.0", "7.0"),
          "precision": ("Double", "Single"), "integrator": INTEGRATORS, "time step": TIME_STEPS}),
    Case("VISC-2", "variable_viscosity", "channel with a hot wall, viscosity ratio 3: L2 error of the velocity",
         "VISC-2, m = 3, N = {N}: L2 of u", (10, 20, 40), {"kernel": KERNELS}),
    Case("HX-2", "heat_conduction", "two half-spaces of unequal conductivity: L2 error of the temperature",
         "HX-2, harmonic mean, N = {N}: L2 of T", (10, 20, 40, 80), {"kernel": KERNELS}),
    Case("chain", "oscillator_chain", "waves on a ring of springs: error of the frequency", "frequency of wave 16, relative to the chain's",
         (1.25, 2.5, 5, 10, 20), {"integrator": ("Leapfrog", "SymplecticEuler", "ExtrapolatedVerlet")}, "time step"),
    Case("chain, energy", "oscillator_chain", "waves on a ring of springs: largest change of the energy", "energy, largest relative change",
         (1.25, 2.5, 5, 10, 20), {"integrator": ("Leapfrog", "SymplecticEuler", "ExtrapolatedVerlet")}, "time step"),
    Case("hydrostatic", "hydrostatic", "liquid at rest in a tank: L2 error of the pressure", "L2 of the pressure / rho g H, uniform start",
         (12, 16, 24, 32),
         {"kernel": ("WendlandC2", "WendlandC4", "Lucy", "CubicSpline"), "integrator": INTEGRATORS, "time step": TIME_STEPS}),
    Case("dam break", "dam_break", "collapse of a column of water: largest deviation of the front",
         "column: front, relative, Z = 1.67 to 3.67", (12, 18, 24, 36), {"resolution": ("as it is",)}),
    Case("membrane", "membrane", "liquid inflating a membrane: deviation of the tip", "tip at 0.2 s, relative",
         (1.25, 2.5, 5, 10), {"integrator": ("ExtrapolatedVerlet",)}, "time step"),
    Case("A8b", "viscoelastic_sphere", "ball of dashpots between plates: L2 error of the force",
         "A8b, lattice, 2 %, T = 10 tau: F(t) on the ramp, L2", (6, 8, 10, 13), {"resolution": ("as it is",)}),
)
FIGURES = {"NASG-1": ("NASG-1",), "VISC-1": ("VISC-1",), "Taylor-Green": ("Taylor-Green",),
           "hydrostatic": ("hydrostatic",),
           "others": ("VISC-2", "HX-2", "chain", "chain, energy", "dam break", "membrane", "A8b")}


@dataclass(frozen=True)
class Point:
    """What one run of an example gives; no error if the run failed."""
    value: float
    particles: int
    steps: int
    particle_steps: float
    seconds: float
    error: float | None


@dataclass(frozen=True)
class Curve:
    case: Case
    kind: str
    choice: str
    points: list

    def good(self):
        return [p for p in self.points if p.error]

    def neighbours(self):
        """Per point the order between it and the coarser one before."""
        orders = [None]
        for a, b in zip(self.points, self.points[1:]):
            orders.append(math.log(a.error / b.error) / math.log(b.value / a.value) if a.error and b.error else None)
        return orders

    def order(self):
        """Slope of -log error over log N, and its standard error, from three or more points."""
        points = self.good()
        if len(points) < 3:
            return None
        x, y = [math.log(p.value) for p in points], [-math.log(p.error) for p in points]
        mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
        spread = sum((a - mean_x) ** 2 for a in x)
        slope = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / spread
        residuals = sum((b - mean_y - slope * (a - mean_x)) ** 2 for a, b in zip(x, y))
        return slope, math.sqrt(residuals / (len(x) - 2) / spread)

    def verdict(self):
        """The order in words. None where the error is at a floor, that is where the last refinement has gained next to nothing, and none
        where the points lie on no line."""
        if not self.order():
            return "fails" if len(self.good()) < len(self.points) else "-"
        slope, uncertainty = self.order()
        text = f"{slope:.2f} ± {uncertainty:.2f}"
        if self.neighbours()[-1] is None:
            return f"{text}, then fails"
        if self.neighbours()[-1] < 0.15:
            return f"no order: floor ({text})"
        return f"no order: no line ({text})" if uncertainty > 0.3 else text


class Runs:
    """Runs the programs, none of them twice for the same point."""

    def __init__(self, examples, variants):
        self.examples, self.variants, self.known = examples, variants, {}

    def result(self, program, arguments):
        key = (program, *arguments)
        if key not in self.known:
            self.known[key] = self.fresh([program, *arguments])
            took = f"{self.known[key]['processor_seconds']:.3g} s" if self.known[key] else "fails"
            print(f"{program.name} {' '.join(arguments)}: {took}", file=sys.stderr)
        return self.known[key]

    @staticmethod
    def fresh(command):
        best, spent = None, 0.0
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(RUNS):
                # Bounds are those of the example's own choices: others may miss them (status 1), or not last at all (2).
                finished = execute([*command, "--threads", "1", "--output", folder], statuses=(0, 1, 2))
                if "\nresult: " not in finished.text:
                    return None
                result = result_of(finished)
                result["processor_seconds"] = result["processor_seconds"] or finished.seconds  # of what is no scene: of the program
                if best is None or result["processor_seconds"] < best["processor_seconds"]:
                    best = result
                spent += finished.seconds
                if spent > ENOUGH:
                    break
        return best

    def point(self, case, kind, choice, value):
        own = choice == case.kinds[kind][0]
        program = self.examples / case.example
        if kind in COMPILED and not own:
            program = self.variants / f"work_precision_{case.example}_{choice}"
        arguments = ["--quick", "--safety", str(1.0 / value)] if case.sweep == "time step" else ["--resolution", str(value)]
        if case.sweep == "resolution" and "time step" in case.kinds or case.example == "variable_viscosity":
            arguments += ["--safety", choice if kind == "time step" else TIME_STEPS[0]]
        if kind == "support" and not own:
            arguments += ["--support", choice]
        result = self.result(program, arguments)
        if result is None:
            return Point(value, 0, 0, 0.0, 0.0, None)
        error = result["errors"][case.error.format(N=value)]["value"]
        particle_steps = result["particle_steps_per_second"] * result["wall_seconds"]
        return Point(value, result["particles"], result["steps"], particle_steps, result["processor_seconds"], error and abs(error))

    def curves(self):
        return [Curve(case, kind, choice, [self.point(case, kind, choice, value) for value in case.values])
                for case in CASES for kind, choices in case.kinds.items() for choice in choices]


def write_csv(curves, path):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "kind", "choice", "N (or bound/dt)", "particles", "steps", "particle-steps", "error", "run time [s]",
                         "particle-steps/s", "order to the point before", "order of the curve", "its standard error"])
        for curve in curves:
            order = [f"{number:.3f}" for number in curve.order() or ()] or ["", ""]
            for p, before in zip(curve.points, curve.neighbours()):
                measured = [f"{p.error:.4g}", f"{p.seconds:.3g}", f"{p.particle_steps / p.seconds:.3g}"] if p.error else ["fails", "", ""]
                writer.writerow([curve.case.name, curve.kind, curve.choice, p.value, p.particles, p.steps, f"{p.particle_steps:.0f}",
                                 *measured, "" if before is None else f"{before:.2f}", *order])


def draw_curves(curves, names, path):
    """Log-log, one panel per case and kind, one curve per choice."""
    blocks, panels = [], []
    for case in (case for case in CASES if case.name in names):
        for kind in case.kinds:
            lines = []
            for n, curve in enumerate(c for c in curves if c.case == case and c.kind == kind and c.good()):
                block = f"$points_{len(blocks)}"
                blocks.append(f"{block} << EOD\n" + "\n".join(f"{p.seconds} {p.error}" for p in curve.good()) + "\nEOD")
                lines.append(f"{block} with linespoints lw 2 pt {n + 4} title '{curve.choice}'")
            of, error = case.what.split(": ")
            title = f"{case.name}: {kind}" if len(names) == 1 else f"{case.name}: {of}"
            panels.append(f"set title '{title}'\nset ylabel '{error}'\nplot {', '.join(lines)}")
    columns = min(3, len(panels))
    rows = math.ceil(len(panels) / columns)
    script = (f"set terminal pngcairo size {480 * columns},{400 * rows} font ',11'\nset output '{path}'\n" + "\n".join(blocks) +
              "\nset logscale\nset format x '10^{%T}'\nset format y '%.0e'\nset grid\nset key bottom left\n"
              "set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.25\n"
              f"set xlabel 'run time, one thread [s]'\nset multiplot layout {rows},{columns}\n" + "\n".join(panels) + "\nunset multiplot\n")
    draw(script)


def figure_path(docs, name):
    return docs / f"accuracy_{name.lower().replace('-', '_')}.png"


def table_of(curves, case):
    own, others = [], []
    for curve in (c for c in curves if c.case == case):
        is_own = curve.choice == case.kinds[curve.kind][0]
        cells = [f"{p.error:.2g} in {p.seconds:.2g} s" if p.error else "fails" for p in curve.points] + [curve.verdict()]
        label = "own: " + ", ".join(choices[0] for choices in case.kinds.values()) if is_own else f"{curve.kind} {curve.choice}"
        (own if is_own else others).append([label, *cells])
    return table(["choice", *map(case.heading, case.values), "order"], own[:1] + others)


def write(options):
    require_gnuplot()
    curves = Runs(options.examples, options.variants).curves()
    for case in CASES:
        put_table(options.docs / "accuracy.md", case.name, table_of(curves, case))
    write_csv(curves, options.docs / "accuracy.csv")
    for name, cases in FIGURES.items():
        draw_curves(curves, cases, figure_path(options.docs, name))


def main():
    parser = new_parser(__doc__)
    parser.add_argument("--examples", type=Path, required=True, help="folder of the examples")
    parser.add_argument("--variants", type=Path, required=True, help="folder of the programs work_precision_EXAMPLE_CHOICE")
    parser.add_argument("--docs", type=Path, required=True, help="folder of accuracy.md")
    run_script(parser, write)


if __name__ == "__main__":
    main()
