#!/usr/bin/env python3
"""Shows that the examples hold what their laws name and nothing else, in docs/lean.md (between its comments `<!-- table: NAME -->` and
`<!-- end -->`): what describe() says of every scene, and the names of absent laws, fields, lists and bonds that the symbols of each program
and of its unoptimised object hold (there must be none: else this ends with an error); and from the program `lean` what it would cost to
have more.

    cmake --preset release && cmake --build --preset release --target lean

Some minutes; the times count on an idle machine. `lean.py check`, the test symbols_examples, looks at the symbols of programs without
running them: what they hold is then what docs/lean.md describes.
"""
import re
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from processes import Failure, add_commands, execute, new_parser, put_table, run_script, table


# ---- What there is, and what an example names of it


@dataclass(frozen=True)
class Law:
    header: str   # below include/
    text: str     # of the header
    names: tuple  # family::Type, and what the header calls by other names: sph::Compressible, eos::liquid_water


def catalogue(root):
    """The laws of docs/laws.md by family::Type; but those that stand for nothing, None."""
    rows = re.findall(r"^\| \w+ \| \[`(\w+)::(\w+)[^`]*`\]\(\.\./include/([^)]+)\)", (root / "docs/laws.md").read_text(), re.MULTILINE)
    laws = {}
    for family, law, header in rows:
        text = (root / "include" / header).read_text()
        others = re.findall(rf"^(?:using (\w+) = {law}\b|inline constexpr {law} (\w+)\{{)", text, re.MULTILINE)
        if law != "None":
            laws[f"{family}::{law}"] = Law(header, text, tuple(f"{family}::{name}" for name in (law, *map("".join, others))))
    if len(laws) < 30:
        raise Failure("docs/laws.md has no rows such as | eos | [`eos::Tait`](../include/dmp/eos/tait.hpp) | ...")
    return laws


def source_of(example, root):
    """The text of an example and of the headers of its own that it includes, without comments."""
    text = (root / "examples" / f"{example}.cpp").read_text()
    headers = re.findall(r'^#include "(support/\w+\.hpp)"', text, re.MULTILINE)
    text += "".join((root / "examples" / header).read_text() for header in headers)
    return re.sub(r"(^|\s)//.*$", "", text, flags=re.MULTILINE)


def named_laws(source, laws):
    return {name for name, law in laws.items() if any(re.search(rf"\b{one}\b", source) for one in law.names)}


def fields_by_name(root):
    """Types of the library's fields, by the name that describe() prints."""
    text = (root / "include/dmp/core/field.hpp").read_text().split("namespace field {")[1]
    return {name: field for field, name in re.findall(r"^struct (\w+) \{.*?string_view name = \"(\w+)\"", text, re.MULTILINE | re.DOTALL)}


def absent_names(source, laws):
    """What may not occur in the symbols of an example."""
    named = named_laws(source, laws)
    parts = {name for name, law in laws.items()
             if any(f"#include <{law.header}>" in laws[one].text for one in named)}  # of a plane: its ramp
    absent = set(laws) - named - parts
    for item, names in (("interaction", ("simulation::Interaction", "neighbours::PairList", "neighbours::Ghosts")),
                        ("summed", ("simulation::Summed",)), ("bonds", ("simulation::Bonds", "neighbours::BondList"))):
        if not re.search(rf"\b(?:\w+_)?{item}<", source):  # also substepped_bonds<
            absent.update(names)
    return absent


# ---- Symbols


def check_symbols(path, absent, expected=()):
    """How many names of dmp a program or object file has. Raises if one of them holds what is absent, or none what is expected."""
    found = [line for line in execute(["nm", "-C", path]).text.splitlines() if "dmp::" in line]
    words = set(re.findall(r"\bdmp::(\w+::\w+)", "\n".join(found)))
    if not found:
        raise Failure(f"{path} has no symbols of dmp; is it stripped?")
    if absent & words:
        raise Failure(f"{path} has symbols of what neither its source nor docs/lean.md has: {', '.join(sorted(absent & words))}")
    unseen = set(expected) - words
    if unseen:
        raise Failure(f"{path} has no symbol of what its source names, so that this check sees nothing: {', '.join(sorted(unseen))}")
    return len(found)


# ---- Descriptions


@dataclass
class Scene:
    """What describe() says, as it is printed and in parts."""
    text: str

    def find(self, pattern):
        return re.findall(pattern, self.text, re.MULTILINE)

    @property
    def fields(self):
        """Names of the fields that it holds or sums; bonds sum forces."""
        lines = self.find(r" B in columns:(.*); \d+ ghosts$") + self.find(r", writes(.*)$")
        words = {name.removeprefix("previous_") for line in lines for name in re.findall(r"[a-z_]+", line)}
        return words | {"force"} if self.find(r"^  bonds ") else words

    def row(self):
        groups = [f"{name} {columns}" + (f" + {record}" if record else "")
                  for name, columns, record in
                  self.find(r"^  (.+): \d+ particles, .*?(\d+) B in columns:.*?; (?:(\d+) B record|no record)")]
        lists = self.find(r"^  pairs (.+): cut-off")
        bonds = [f"{between}{what}" for between, what in self.find(r"^  bonds (.+): \d+ bonds(.*)$")]
        summed = self.find(r"^  summed over neighbours: (.+?),")
        (passes, sweeps), = self.find(r"^each step: (\d+) pass.*?, (\d+) sweep")
        total, = self.find(r"^(\S+) bytes per particle$")
        return [", ".join(groups), f"{float(total):.0f}", ", ".join(lists) or "none", ", ".join(bonds) or "none", passes,
                sweeps + "".join(f" and one for {name}" for name in summed)]


# Rows of the program lean, by what it is that an example has if its source matches; the rest is in place of something else.
MATTERS = {
    "liquid": {"density diffusion": r"\bdiffusion::(?!None)", "energy equation": r"\bsph::Compressible\b|\bthermal::",
               "heat conduction": r"\bsph::HeatConduction\b", "viscosity of each particle, mu(T)": r"\brheology::(?!Constant\b)",
               "viscosity of each particle, mu(shear rate), a sum over neighbours": r"\bsummed<",
               "tensile correction": r"\btensile::(?!None)", "bonds: springs, 6 to each particle": r"\b(?:\w+_)?bonds<"},
    "solid of springs": {"neighbour lists and repulsion between beads": r"\binteraction<",
                         "pressure and viscosity of a liquid: density, neighbour lists": r"\beos::",
                         "bonds with velocity: spring and dashpot": r"\bbond::KelvinVoigt\b",
                         "bonds with memory: standard linear solid": r"\bbond::StandardLinearSolid\b",
                         "bonds that break": r"\bbond::Breaking\b"},
    "heat at rest": {"flow: motion, pressure, viscosity": r"\bforcing::|\bsph::(?:WeaklyC|C)ompressible\b"},
}


def left_out(source, costs):
    """What an example has not, and over that of its kind of scene the time of a step which has it: as text."""
    flows = re.search(r"\bsph::(?:WeaklyC|C)ompressible\b", source)
    kind = "liquid" if flows else "heat at rest" if re.search(r"\bsph::HeatConduction\b", source) else "solid of springs"
    ratios = {what: ratio for scene, what, *_, ratio, _, _ in costs if scene == kind}
    return [kind, "; ".join(f"{what}: {ratios[what]}" for what, pattern in MATTERS[kind].items() if not re.search(pattern, source))]


def scenes_of(text):
    return [Scene(found) for found in re.findall(r"^groups\n.*?bytes per particle$", text, re.MULTILINE | re.DOTALL)]


# ---- The check


def absent_fields(scenes, root):
    """Fields that none of the scenes holds. Position, velocity and mass are shown to every material law."""
    held = {"position", "velocity", "mass"}.union(*(scene.fields for scene in scenes))
    return {f"field::{field}" for name, field in fields_by_name(root).items() if name not in held}


def check(options):
    """look for absent names in the symbols of programs"""
    laws = catalogue(options.root)
    page = (options.root / "docs/lean.md").read_text()
    for program in options.programs:
        documented = re.search(rf"^### {program.name}$(.*?)(?:^### |^<!-- end -->)", page, re.MULTILINE | re.DOTALL)
        source = source_of(program.name, options.root)
        scenes = scenes_of(documented.group(1) if documented else "")
        absent = absent_names(source, laws) | absent_fields(scenes, options.root)
        print(f"{program.name}: none of {len(absent)} absent names in {check_symbols(program, absent)} symbols of dmp")


# ---- The page


def write(options):
    """run all and write docs/lean.md"""
    root, laws = options.root, catalogue(options.root)
    costs = [line.split("; ") for line in execute([options.lean]).text.splitlines()]
    held, absence, leaves, descriptions = [], [], [], []
    objects = {path.name.split(".")[0]: path for path in options.objects}
    with tempfile.TemporaryDirectory() as folder:
        for program in options.programs:
            example = program.name
            print(example, file=sys.stderr)
            scenes = scenes_of(execute([program, "--quick", "--threads", "1", "--output", folder]).text)
            source = source_of(example, root)
            absent = absent_names(source, laws) | absent_fields(scenes, root)
            expected = named_laws(source, laws)
            numbers = [check_symbols(program, absent), check_symbols(objects[example], absent, expected)]
            names = ", ".join(f"`{name}`" for name in sorted(expected))
            absence.append([example, names or "none", f"{len(absent)}", *map(str, numbers), "none"])
            held += dict.fromkeys((example, *scene.row()) for scene in scenes)  # each once
            if scenes:
                leaves.append([example, *left_out(source, costs)])
                descriptions.append(f"### {example}\n\n```\n" + "\n\n".join(dict.fromkeys(scene.text for scene in scenes)) + "\n```")
    page = root / "docs/lean.md"
    put_table(page, "held", table(["example", "bytes of columns + record, by group", "bytes per particle, all", "pair lists", "bonds",
                                   "passes", "sweeps"], held))
    put_table(page, "absent", table(["example", "laws that its source names", "absent names", "symbols", "symbols, unoptimised",
                                     "absent names found"], absence))
    put_table(page, "costs", table(["scene", "and", "bytes of columns", "of the record", "of all, per particle", "ns per particle-step",
                                    "time over that of the scene", "(least to largest)"],
                                   [[*cost[:7], f"{cost[7]} to {cost[8]}"] for cost in costs]))
    put_table(page, "left out", table(["example", "nearest to the scene", "left out, and the time of a step with it over that without"],
                                      leaves))
    put_table(page, "descriptions", "\n\n".join(descriptions))


def main():
    parser = new_parser(__doc__)
    commands = add_commands(parser, write=write, check=check)
    for command in commands.values():
        command.add_argument("--programs", type=Path, nargs="+", required=True, help="the examples")
    commands["write"].add_argument("--objects", type=Path, nargs="+", required=True, help="the same, compiled without optimisation")
    commands["write"].add_argument("--lean", required=True, help="the program lean")
    run_script(parser)


if __name__ == "__main__":
    main()
