"""What the scripts of this folder share: their command line; running a program and measuring what it needs; tables in Markdown, put into a
page; figures."""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple


class Failure(Exception):
    """A text for the user: what went wrong, and what to do."""


def new_parser(description):
    return argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)


def add_commands(parser, **functions):
    """Lets `parser` take commands, which call the functions of their names; the parser of each, by name. All have --root."""
    commands = parser.add_subparsers(required=True)
    parsers = {}
    for name, function in functions.items():
        parsers[name] = commands.add_parser(name, help=function.__doc__)
        parsers[name].set_defaults(function=function)
        parsers[name].add_argument("--root", type=Path, required=True, help="folder of the repository")
    return parsers


def run_script(parser, function=None):
    """Calls `function`, or that of the command, with what the command line says. A Failure ends the script with its text."""
    options = parser.parse_args()
    try:
        (function or options.function)(options)
    except Failure as failure:
        sys.exit(f"{Path(sys.argv[0]).name}: {failure}")


class Finished(NamedTuple):
    """What a program printed, the most memory [bytes] that it had resident, and its processor time [s] outside the kernel."""
    text: str
    resident: float
    seconds: float


def execute(command, threads=None, folder=None, statuses=(0,)):
    """Runs `command` in `folder`. It must end with a status of these."""
    environment = dict(os.environ, **({} if threads is None else {"OMP_NUM_THREADS": str(threads)}))
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        try:
            process = subprocess.Popen(command, stdout=output, stderr=errors, stdin=subprocess.DEVNULL, cwd=folder, env=environment)
        except OSError as error:
            raise Failure(f"{command[0]} does not start: {error.strerror}") from None
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        errors.seek(0)
        text = output.read()
        if process.returncode not in statuses:
            last_lines = "\n".join((text + errors.read()).strip().splitlines()[-5:])
            raise Failure(f"{' '.join(map(str, command))}\nended with status {process.returncode}:\n{last_lines}")
    return Finished(text, 1024.0 * usage.ru_maxrss, usage.ru_utime)


def result_of(finished):
    """The line `result: {...}` with which an example ends, as a dictionary."""
    found = re.search(r"^result: (\{.*\})$", finished.text, re.MULTILINE)
    if not found:
        raise Failure(f"an example printed no result, but:\n{finished.text}")
    return json.loads(found.group(1))


def table(header, rows):
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [header, ["---"] * len(header), *rows])


def put_table(page, name, text):
    """Puts `text` between the comments <!-- table: name --> and <!-- end --> of a page."""
    pattern = re.compile(rf"(<!-- table: {re.escape(name)} -->\n).*?(<!-- end -->)", re.DOTALL)
    changed, count = pattern.subn(lambda found: found.group(1) + text + "\n" + found.group(2), page.read_text())
    if count != 1:
        raise Failure(f"{page} needs the comments <!-- table: {name} --> and <!-- end --> once")
    page.write_text(changed)


def require_gnuplot():
    """Raises if there is no gnuplot: before the long runs whose figures it is to draw."""
    try:
        execute(["gnuplot", "--version"])
    except Failure as failure:
        raise Failure(f"{failure}; it draws the figures (Debian: gnuplot-nox)") from None


def draw(script):
    """Has gnuplot run a script."""
    with tempfile.NamedTemporaryFile("w", suffix=".gp") as file:
        file.write(script)
        file.flush()
        execute(["gnuplot", file.name])
