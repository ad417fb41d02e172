"""What the scripts of this folder share: running a program, measuring what it needs, and putting tables into pages."""

import json
import os
import re
import subprocess
import tempfile
from typing import NamedTuple


class Failure(Exception):
    """A text for the user: what went wrong, and what to do."""


class Run(NamedTuple):
    text: str       # standard output
    memory: float   # the most that was resident [bytes]
    seconds: float  # of a processor, in the program itself


def run(command, threads=None, folder=None, statuses=(0,)):
    """Runs `command` in `folder`. It must end with a status of these."""
    environment = dict(os.environ, **({} if threads is None else {"OMP_NUM_THREADS": str(threads)}))
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen(command, stdout=output, stderr=errors, stdin=subprocess.DEVNULL, cwd=folder, env=environment)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        errors.seek(0)
        text = output.read()
        if process.returncode not in statuses:
            last_lines = "\n".join((text + errors.read()).strip().splitlines()[-5:])
            raise Failure(f"{' '.join(map(str, command))}\nended with status {process.returncode}:\n{last_lines}")
    return Run(text, 1024.0 * usage.ru_maxrss, usage.ru_utime)


def execute(command, threads=None, folder=None, statuses=(0,)):
    """Standard output of `command` and the most memory [bytes] that it had resident, see run."""
    text, memory, _ = run(command, threads, folder, statuses)
    return text, memory


def result_of(text):
    """The line "result: {...}" with which an example ends."""
    found = re.search(r"^result: (\{.*\})$", text, re.MULTILINE)
    if not found:
        raise Failure(f"an example printed no result, but:\n{text}")
    return json.loads(found.group(1))


def replace_table(page, name, table):
    """Puts a table between the comments `<!-- table: NAME -->` and `<!-- end -->` of a page (its path)."""
    text, count = re.subn(rf"(<!-- table: {re.escape(name)} -->\n).*?(<!-- end -->)",
                          lambda found: found.group(1) + table + "\n" + found.group(2), page.read_text(), flags=re.DOTALL)
    if count != 1:
        raise Failure(f"{page} needs the comments <!-- table: {name} --> and <!-- end --> once")
    page.write_text(text)
