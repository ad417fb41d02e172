#!/usr/bin/env python3
"""Runs bench/stability.cpp and puts its tables into docs/stability.md.

    cmake --preset release && cmake --build --preset release --target stability

It takes some minutes. What it finds does not depend on the machine, but for the last digits.
"""
import re
from pathlib import Path

from processes import Failure, execute, new_parser, put_table, run_script


def write(options):
    parts = re.split(r"^table: (\S+)\n", execute([options.program]).text, flags=re.MULTILINE)[1:]
    if not parts:
        raise Failure(f"{options.program} printed no tables")
    for name, text in zip(parts[::2], parts[1::2]):
        put_table(options.page, name, text.strip())


def main():
    parser = new_parser(__doc__)
    parser.add_argument("--program", type=Path, required=True, help="bench/stability.cpp, compiled")
    parser.add_argument("--page", type=Path, required=True, help="docs/stability.md")
    run_script(parser, write)


if __name__ == "__main__":
    main()
