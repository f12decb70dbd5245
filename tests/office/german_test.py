#!/usr/bin/python3
"""Tables with decimal commas in a LibreOffice that reads German numbers, and tables.xlsx in any.

german_test.py CAROM: makes a run and a sweep in a temporary folder, imports each of their CSV files by the filter of German
(language 1031), and opens the workbook of a run. Every number must be a number there, the same one.
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

import openpyxl

from office import convert

SCENE = """scene: 1
title: "Kugeln; 1,5 m"
seed: 2
restitution: 0.8
groups: {gas: {count: 12, ball: {mass: 1, radius: 0.05}, in: {min: [0, 0, 0], max: [1, 1, 1]}, speed: 1}}
room: {min: [0, 0, 0], max: [1, 1, 1]}
regions: {low: {position: [0.5, 0.1, 0.5], box: [1, 0.2, 1]}}
simulate: {duration: 1}
output:
  trajectory: {every: 0.05}
  collisions: true
  energy: {every: 0.02}
  contacts: {every: 0.1}
  regions: true
  tables: {separator: ";", decimal: ","}
"""
TABLES = ["summary", "trajectory", "collisions", "energy", "contacts", "regions"]
# Semicolons, quotes, UTF-8, from line 1 on, columns as they are, German, quoted cells not as text, special numbers.
GERMAN = "CSV:59,34,76,1,,1031,false,true"


def sheets_of(folder, file, out, *options):
    """A file as a workbook by LibreOffice."""
    return openpyxl.load_workbook(convert(folder, "xlsx", file, out, *options) / f"{file.stem}.xlsx")


def number(text):
    """A number with a decimal comma; None: a text."""
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def numbers_of(file, sheet, head=1):
    """Compares a sheet with a CSV file, and gives how many numbers are the same."""
    same = 0
    for i, row in enumerate(csv.reader(file.open(newline=""), delimiter=";")):
        for k, text in enumerate(row):
            cell = sheet.cell(i + head, k + 1)
            value = None if i == 0 else number(text)
            if value is None:
                assert text == "" or str(cell.value) == text, (file.name, cell.coordinate, text, cell.value)
                continue
            assert cell.data_type == "n", (file.name, cell.coordinate, text, cell.data_type, cell.value)
            # LibreOffice stores 15 digits.
            assert math.isclose(cell.value, value, rel_tol=1e-14, abs_tol=1e-320), (file.name, cell.coordinate, text, cell.value)
            same += 1
    return same


def misread(file, sheet):
    """How many numbers of a plain CSV file, with points and commas, are other numbers, texts or dates in a sheet."""
    wrong = 0
    for i, row in enumerate(csv.reader(file.open(newline=""))):
        for k, text in enumerate(row):
            value, cell = number(text) if i > 0 and "." in text else None, sheet.cell(i + 1, k + 1)
            wrong += value is not None and (cell.data_type != "n" or not math.isclose(cell.value, value, rel_tol=1e-14))
    return wrong


def main():
    carom = sys.argv[1]
    with tempfile.TemporaryDirectory(prefix="carom-german-") as name:
        folder = pathlib.Path(name)
        (folder / "scene.yaml").write_text(SCENE)

        def run(*words):
            subprocess.run([carom, *words, "-q"], cwd=folder, check=True)

        run("run", "scene.yaml", "-o", "run")
        run("run", "scene.yaml", "-o", "book", "--set", "output.tables.format=xlsx")
        run("sweep", "scene.yaml", "--grid", "restitution.default=0.5:1:3", "--repeat", "2", "-o", "sweep")

        files = [folder / f"run/{table}.csv" for table in TABLES] + [folder / "sweep/summary.csv", folder / "sweep/repeats.csv"]
        numbers = sum(numbers_of(file, sheets_of(folder, file, folder / "converted" / file.parent.name, f"--infilter={GERMAN}").active)
                      for file in files)
        assert numbers > 3000, numbers

        # Without the dialect most of them are wrong.
        run("run", "scene.yaml", "-o", "plain", "--only", "energy", "--set", "output.tables=csv")
        plain = folder / "plain/energy.csv"
        wrong = misread(plain, sheets_of(folder, plain, folder / "converted/plain", f"--infilter={GERMAN.replace('59', '44', 1)}").active)
        assert wrong > 100, wrong

        # The workbook, as LibreOffice stores it again.
        book = sheets_of(folder, folder / "book/tables.xlsx", folder / "converted")
        assert book.sheetnames == [table.capitalize() for table in
                                   ["summary", "energy", "collisions", "contacts", "regions", "trajectory"]], book.sheetnames
        in_book = sum(numbers_of(folder / f"book/{table}.csv", book[table.capitalize()]) for table in TABLES)
        assert in_book > 2000, in_book
    print(f"{numbers} German numbers, {in_book} in the workbook, {wrong} wrong without the dialect")


main()
