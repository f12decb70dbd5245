#!/usr/bin/python3
"""Computes the reference values in this folder from first principles, by mpmath with 60 digits.

usage: make.py [--check] [NAME...]

NAME.json comes from make_NAME.py; without NAME, all files. --check writes nothing: it compares what it computes with
the stored files. It exits with 1 at the first entry that differs by more than the digits stored, and names the entry.
Without mpmath (Debian: python3-mpmath) it exits with 77.
"""
import argparse
import importlib
import pathlib
import sys

sys.dont_write_bytecode = True  # the folder holds sources and data only

FOLDER = pathlib.Path(__file__).resolve().parent
NAMES = sorted(path.stem.removeprefix("make_") for path in FOLDER.glob("make_*.py"))


def arguments() -> argparse.Namespace:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description="Computes the reference values of the tests.")
    parser.add_argument("--check", action="store_true", help="compare with the stored files; write nothing")
    parser.add_argument("names", metavar="NAME", nargs="*", help=", ".join(NAMES))
    parsed = parser.parse_args()
    if unknown := set(parsed.names) - set(NAMES):
        parser.error(f"no reference {', '.join(sorted(unknown))}; there are: {', '.join(NAMES)}")
    return parsed


def main() -> int:
    """Writes or compares the files; returns the exit code."""
    options = arguments()
    try:
        import reference_json
    except ModuleNotFoundError as missing:
        print(f"make.py: no module {missing.name}; Debian's package is python3-mpmath")
        return 77
    for name in options.names or NAMES:
        computed = importlib.import_module(f"make_{name}").compute()
        file = FOLDER / f"{name}.json"
        if not options.check:
            file.write_text(reference_json.json_text(computed) + "\n")
        elif difference := reference_json.first_difference(computed, reference_json.parse(file.read_text()), name):
            print(difference)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
