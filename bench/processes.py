"""What the scripts of this folder share: running a program and measuring what it needs; tables in Markdown, put into a page."""

import os
import re
import subprocess
import tempfile
from typing import NamedTuple


class Failure(Exception):
    """A text for the user: what went wrong, and what to do."""


class Finished(NamedTuple):
    """What a program printed, the most memory [bytes] that it had resident, and its processor time [s] outside the kernel."""
    text: str
    resident: float
    seconds: float


def execute(command, threads=None, folder=None, statuses=(0,)):
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
    return Finished(text, 1024.0 * usage.ru_maxrss, usage.ru_utime)


def table(header, rows):
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [header, ["---"] * len(header), *rows])


def put_table(page, name, text):
    """Puts `text` between the comments <!-- table: name --> and <!-- end --> of a page."""
    pattern = re.compile(rf"(<!-- table: {name} -->\n).*?(<!-- end -->)", re.DOTALL)
    changed, count = pattern.subn(lambda found: found.group(1) + text + "\n" + found.group(2), page.read_text())
    if count != 1:
        raise Failure(f"{page} needs the comments <!-- table: {name} --> and <!-- end --> once")
    page.write_text(changed)
