#!/usr/bin/python3
"""Reads the tables of runs by pandas, and compares each bit of their numbers with those of CSV.

Run in a folder with the runs csv, gz, german, german_gz and xlsx of one scene. Prints how many numbers are the same.
"""
import math
import struct

import pandas

TABLES = ["summary", "trajectory", "collisions", "energy", "contacts", "regions"]
EXACT = {"float_precision": "round_trip"}


def same(a, b):
    """Whether two cells hold the same text, nothing, or the same double."""
    if isinstance(a, str) or isinstance(b, str):
        return a == b
    if math.isnan(a) or math.isnan(b):
        return math.isnan(a) and math.isnan(b)
    return struct.pack("d", a) == struct.pack("d", b)


def main():
    numbers = tables = 0
    for name in TABLES:
        right = pandas.read_csv(f"csv/{name}.csv", **EXACT)
        packed = "" if name == "summary" else ".gz"
        others = {
            "gz": pandas.read_csv(f"gz/{name}.csv{packed}", **EXACT),
            "german": pandas.read_csv(f"german/{name}.csv", sep=";", decimal=",", **EXACT),
            "german_gz": pandas.read_csv(f"german_gz/{name}.csv{packed}", sep=";", decimal=",", **EXACT),
            "xlsx": pandas.read_excel("xlsx/tables.xlsx", sheet_name=name.capitalize()),
        }
        for form, table in others.items():
            assert list(table.columns) == list(right.columns), (name, form, list(table.columns))
            assert len(table) == len(right), (name, form, len(table), len(right))
            for column in right.columns:
                for row, (a, b) in enumerate(zip(right[column], table[column])):
                    assert same(a, b), (name, form, column, row, a, b)
                    numbers += not isinstance(a, str)
            tables += 1
    print(f"{numbers} numbers in {tables} tables")


main()
