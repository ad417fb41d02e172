#!/usr/bin/env python3
"""Runs every example and puts what it finds into docs/: validation.csv, all figures of the quick and of the usual run; and the tables of
validation.md (between its comments `<!-- table: NAME -->` and `<!-- end -->`), those of the usual run. The run times also go into the first
comments of the examples.

    cmake --preset release && cmake --build --preset release --target validation

One thread, one example at a time, some ten minutes; run times are processor times of the whole program and count on an idle machine.
`validation.py check` compares the result of one run with validation.csv: the tests documented_EXAMPLE_SIZE. An error may differ from the
documented one by 1 % of it, or by a thousandth of its bound if that is more; in the runs of CHAOTIC, which amplify rounding, and where the
bound itself is one of rounding (below 1e-9), by a quarter of the bound. The names and bounds of the errors and the number of particles must
be those documented, and so must what bound the time step, and how far: the shares of a bound that a given step takes to one percent of
it, the number of steps to 1 %, of CHAOTIC runs to 5 %. docs/validation.md says why.
"""
import csv
import json
import re
import sys
import tempfile
from pathlib import Path

from processes import Failure, add_commands, execute, new_parser, put_table, run_script, table

SIZES = {"quick": ["--quick"], "normal": []}  # and how to ask for them
TOLERANCE = 0.01
TOLERANCE_OF_BOUND, TOLERANCE_OF_CHAOTIC = 0.001, 0.25
TOLERANCE_OF_STEPS = 0.05  # of chaotic runs
SHARE = re.compile(r"(\d+) %")  # of a bound, in what bound the step
ROUNDING = 1e-9
DOI = r"doi:(10\.[^\s,;()]*(?:\([^\s()]*\)[^\s,;()]*)*[^\s,;().:])"  # without the full stop of a sentence
DURATIONS = r"\(\d+ s; \d+ s with --quick"  # in the first comment of an example
CHAOTIC = (("dam_break", "normal"), ("membrane", "normal"))
COLUMNS = ("example", "size", "case", "resolution", "particles", "steps", "run time [s]", "bytes per particle", "step bound by",
           "error", "value", "bound", "reference")


# ---- Running


def run(program, size, folder):
    """The result of one run, with its size and processor time."""
    seconds = execute([program, *SIZES[size], "--threads", "1", "--output", folder]).seconds
    result = json.loads((Path(folder) / "result.json").read_text())
    print(f"{program.name}, {size}: {len(result['errors'])} figures, {seconds:.1f} s", file=sys.stderr)
    return result | {"size": size, "seconds": seconds}


def rows_of(result):
    for name, error in result["errors"].items():
        yield [result["example"], result["size"], result["case"], result["resolution"], result["particles"], result["steps"],
               f"{result['seconds']:.2f}", f"{result['bytes_per_particle']:.1f}", result["step_bound_by"], name,
               *(f"{error[key]:.6g}" for key in ("value", "bound")), error["reference"]]


# ---- The page


def text(cell):
    return str(cell).replace("|", "\\|").replace("<", "&lt;")


def nearest(errors):
    """The error that uses most of its bound. Bounds of zero are met or not."""
    return max(errors.items(), key=lambda item: abs(item[1]["value"]) / item[1]["bound"] if item[1]["bound"] > 0.0 else 0.0)


def overview(results, programs):
    rows = []
    for result, program in zip(results, programs):
        name, error = nearest(result["errors"])
        example = result["example"]
        system = execute([program, "--help"]).text.splitlines()[0]
        rows.append([f"[{example}](#{example})", text(system), text(result["case"]), text(result["resolution"]), f"{result['particles']}",
                     f"{result['steps']}", f"{len(result['errors'])}", text(f"{name}: {abs(error['value']):.3g} of {error['bound']:.3g}"),
                     text(error["reference"]), f"{result['seconds']:.1f}", f"`build/release/examples/{example} --threads 1`"])
    return table(["example", "system", "case", "resolution", "particles", "steps", "errors", "nearest to its bound", "its reference",
                  "run time [s]", "command"], rows)


def figures(results, sources):
    """A section for each example: what its source says of it, and all its errors."""
    sections = []
    for result in results:
        example = result["example"]
        comment = []
        for line in (sources / f"{example}.cpp").read_text().splitlines():
            if not line.startswith("//"):
                break
            comment.append(line[2:].strip())
        about = re.sub(DOI, r"[doi:\1](https://doi.org/\1)", text(" ".join(comment)))
        rows = [[text(name), f"{error['value']:.3g}", f"{error['bound']:.3g}", text(error["reference"])]
                for name, error in result["errors"].items()]
        sections += [f"### {example}", f"[{example}.cpp](../examples/{example}.cpp): {about}",
                     table(["error", "value", "bound", "reference"], rows)]
    return "\n\n".join(sections)


def put_durations(source, usual, quick):
    """Puts run times [s], rounded, into the first comment of an example: "(60 s; 15 s with --quick"."""
    def rounded(seconds):
        return max(1, round(seconds)) if seconds < 20 else 5 * round(seconds / 5)

    source.write_text(re.sub(DURATIONS, f"({rounded(usual)} s; {rounded(quick)} s with --quick", source.read_text()))


def write(options):
    """run all examples and write docs/validation.csv and docs/validation.md"""
    sources = {program.name: options.root / f"examples/{program.name}.cpp" for program in options.programs}
    for source in sources.values():
        if len(re.findall(DURATIONS, source.read_text())) != 1:
            raise Failure(f"{source} needs its run times once, as in (60 s; 15 s with --quick)")
    with tempfile.TemporaryDirectory() as folder:
        results = [run(program, size, folder) for program in options.programs for size in SIZES]
    seconds = {(result["example"], result["size"]): result["seconds"] for result in results}
    usual = [result for result in results if result["size"] == "normal"]
    for name, source in sources.items():
        put_durations(source, seconds[name, "normal"], seconds[name, "quick"])
    page = options.root / "docs/validation.md"
    put_table(page, "overview", overview(usual, options.programs))
    put_table(page, "figures", figures(usual, options.root / "examples"))
    with open(options.root / "docs/validation.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for result in results:
            writer.writerows(rows_of(result))


# ---- The check


def is_same_bound(found, documented):
    """Whether the same bounds the step, to as much."""
    shares = [[int(share) for share in SHARE.findall(bound)] for bound in (found, documented)]
    return (SHARE.sub("", found) == SHARE.sub("", documented)
            and all(abs(one - other) <= max(1, TOLERANCE * other) for one, other in zip(*shares)))


def differences(result, size, documented):
    """What does not hold of the documented rows of this run."""
    errors = result["errors"]
    is_chaotic = (result["example"], size) in CHAOTIC
    for bound, steps in {(row["step bound by"], int(row["steps"])) for row in documented}:
        if not is_same_bound(result["step_bound_by"], bound):
            yield f"the step is bound by `{result['step_bound_by']}`, documented is `{bound}`"
        elif bound and abs(result["steps"] - steps) > (TOLERANCE_OF_STEPS if is_chaotic else TOLERANCE) * steps:
            yield f"{result['steps']} steps, documented are {steps}"
    names = [row["error"] for row in documented]
    yield from (f"{name}: measured, not documented" for name in errors if name not in names)
    for row in documented:
        name, value, bound, particles = row["error"], float(row["value"]), float(row["bound"]), int(row["particles"])
        share = TOLERANCE_OF_CHAOTIC if is_chaotic or bound < ROUNDING else TOLERANCE_OF_BOUND
        if name not in errors:
            yield f"{name}: documented, not measured"
        elif particles != result["particles"]:
            yield f"{name}: of {result['particles']} particles, documented are {particles}"
        elif abs(errors[name]["bound"] - bound) > TOLERANCE * bound:
            yield f"{name}: bound {errors[name]['bound']:.6g}, documented is {bound:.6g}"
        elif not abs(errors[name]["value"] - value) <= max(TOLERANCE * abs(value), bound * share):
            yield f"{name}: {errors[name]['value']:.6g}, documented is {value:.6g} of {bound:.6g}"


def check(options):
    """compare a result with docs/validation.csv"""
    result = json.loads(options.result.read_text())
    with open(options.root / "docs/validation.csv", newline="") as file:
        documented = [row for row in csv.DictReader(file) if (row["example"], row["size"]) == (result["example"], options.size)]
    found = list(differences(result, options.size, documented))
    if found:
        raise Failure("docs/validation.csv does not hold; if the change is meant, build the target validation\n  " + "\n  ".join(found))
    print(f"{len(documented)} documented errors hold")


def main():
    parser = new_parser(__doc__)
    commands = add_commands(parser, write=write, check=check)
    commands["write"].add_argument("--programs", type=Path, nargs="+", required=True, help="the examples")
    commands["check"].add_argument("--result", type=Path, required=True, help="result.json of a run")
    commands["check"].add_argument("--size", choices=SIZES, required=True, help="of that run")
    run_script(parser)


if __name__ == "__main__":
    main()
