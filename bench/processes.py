"""What the scripts of this folder share: running a program and measuring what it needs."""

import os
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
