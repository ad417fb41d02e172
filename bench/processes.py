"""What the scripts of this folder share: running a program, measuring what it needs, putting tables into a page."""

import os
import re
import subprocess
import tempfile


class Failure(Exception):
    """A text for the user: what went wrong, and what to do."""


def execute(command, threads=None, folder=None, statuses=(0,)):
    """Standard output of `command`, run in `folder`, and the most memory [bytes] that it had resident. It must end with a status of these."""
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
    return text, 1024.0 * usage.ru_maxrss


def put_tables(page, tables):
    """Puts each of `tables` {name: text} into the page, between its comments `<!-- table: NAME -->` and `<!-- end -->`."""
    text = page.read_text()
    for name, table in tables.items():
        text, count = re.subn(rf"(<!-- table: {re.escape(name)} -->\n).*?(<!-- end -->)", lambda found: found.group(1) + table + "\n" + found.group(2),
                              text, flags=re.DOTALL)
        if count != 1:
            raise Failure(f"{page} needs the comments <!-- table: {name} --> and <!-- end --> once")
    page.write_text(text)
