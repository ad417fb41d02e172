#!/usr/bin/env python3
"""Runs bench/stability.cpp and puts its tables into docs/stability.md.

    cmake --preset release && cmake --build --preset release --target stability

It takes some minutes. What it finds does not depend on the machine, but for the last digits.
"""
import argparse
import re
import sys
from pathlib import Path

from processes import Failure, execute, put_table


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, required=True, help="bench/stability.cpp, compiled")
    parser.add_argument("--page", type=Path, required=True, help="docs/stability.md")
    options = parser.parse_args()
    try:
        parts = re.split(r"^table: (\S+)\n", execute([options.program]).text, flags=re.MULTILINE)[1:]
        if not parts:
            raise Failure(f"{options.program} printed no tables")
        for name, text in zip(parts[::2], parts[1::2]):
            put_table(options.page, name, text.strip())
    except Failure as failure:
        sys.exit(f"stability: {failure}")


if __name__ == "__main__":
    main()
