#!/usr/bin/python3
"""Comparisons in LibreOffice: the workbook as displayed, summary.csv as imported.

office_test.py CAROM: makes runs in a temporary folder. Every number of the CSV must be a number in LibreOffice, formulas
must give the table's values, and the first printed page must have what was found.
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
title: "=1+1"
gravity: [0, 0, 0]
balls:
  red: {mass: 10, radius: 0.11, position: [-1, 0, 0], velocity: [2, 0, 0]}
  blue: {mass: 10, radius: 0.11, position: [1, 0, 0], velocity: [-2, 0, 0]}
simulate: {duration: 1}
output: {trajectory: {every: 0.1}, collisions: true, energy: {every: 0.1}}
"""


def number(text):
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) else None


def main():
    carom = sys.argv[1]
    with tempfile.TemporaryDirectory(prefix="carom-office-") as name:
        folder = pathlib.Path(name)
        (folder / "scene.yaml").write_text(SCENE)
        runs = []
        for e in ("0.5", "0.75", "1"):
            for z in ("-0.025", "0.025"):
                runs.append(f"r{len(runs) + 1}")
                subprocess.run([carom, "run", "scene.yaml", "-q", "-o", f"runs/{runs[-1]}", "--set", f"restitution.default={e}",
                                "--set", f"balls.red.position.z={z}"], cwd=folder, check=True)
        subprocess.run([carom, "compare", *[f"runs/{run}" for run in runs], "-o", "out", "-q"], cwd=folder, check=True)

        # The table: read as CSV, stored as .xlsx, read by openpyxl.
        rows = list(csv.reader((folder / "out/summary.csv").open(newline="")))
        out = convert(folder, "xlsx", folder / "out/summary.csv", folder / "converted")
        sheet = openpyxl.load_workbook(out / "summary.xlsx").active
        numbers = 0
        for i, row in enumerate(rows):
            for k, text in enumerate(row):
                cell = sheet.cell(i + 1, k + 1)
                assert cell.data_type != "f", f"{cell.coordinate} is a formula"
                value = number(text) if i > 0 else None
                if value is None:
                    continue
                assert cell.data_type == "n" and math.isclose(cell.value, value, rel_tol=1e-14), (cell.coordinate, text, cell.value)
                numbers += 1
        assert numbers > 100, numbers

        # The workbook: recomputed, each sheet as CSV; the summary is the table, formulas have values.
        every_sheet = "csv:Text - txt - csv (StarCalc):44,34,76,1,,0,false,true,false,false,false,-1"
        out = convert(folder, every_sheet, folder / "out/comparison.xlsx", folder / "converted")
        sheets = {file.name: list(csv.reader(file.open(newline=""))) for file in out.glob("comparison-*.csv")}
        assert len(sheets) == 7, sorted(sheets)
        for file, lines in sheets.items():
            assert lines, file
            for line in lines:
                for text in line:
                    assert not text.startswith(("#DIV", "#VALUE", "#REF", "#NAME", "#N", "##", "Err:")), (file, line)
        summary = sheets["comparison-Summary.csv"]
        assert summary[0][0].startswith("The same in all runs: "), summary[0]
        assert len(summary) == len(rows) + 1
        heads = {"restitution.default": "restitution.default", "balls.red.position.z (m)": "balls.red.position.z",
                 "energy lost (J)": "energy_lost_J", "max speed (m/s)": "max_speed_m_per_s"}
        for told, shown in zip(rows[1:], summary[2:]):
            for head, column in heads.items():
                value, cell = number(told[rows[0].index(column)]), number(shown[summary[1].index(head)])
                assert math.isclose(cell, value, rel_tol=1e-4, abs_tol=1e-12), (column, value, cell)
        pivot = sheets["comparison-Pivot.csv"]
        assert math.isclose(number(pivot[5][1]), number(rows[1][rows[0].index("energy_lost_J")]), rel_tol=1e-4), pivot[5]

        # The heat map of the first sheet, whose formulas LibreOffice has recomputed.
        compare = sheets["comparison-Compare.csv"]
        head = next(i for i, line in enumerate(compare) if line[0] == "restitution.default \\ position.z")
        places = [k for k, text in enumerate(compare[head][:27]) if number(text) is not None]
        assert [number(compare[head][k]) for k in places] == [-0.025, 0.025], compare[head]
        cells = [number(line[k]) for line in compare[head + 1:head + 4] for k in places]
        lost = [number(row[rows[0].index("energy_lost_J")]) for row in rows[1:]]
        assert len(lost) == 6 and all(math.isclose(a, b, rel_tol=1e-4, abs_tol=1e-12) for a, b in zip(cells, lost)), cells

        # On paper: the first page has what varied, the highest and lowest runs, what matters, and the heat map.
        out = convert(folder, "pdf", folder / "out/comparison.xlsx", folder / "converted")
        page = subprocess.run(["pdftotext", "-l", "1", str(out / "comparison.pdf"), "-"], check=True, capture_output=True,
                              text=True).stdout
        for text in ("6 runs; varied: restitution.default 0.5, 0.75, 1; balls.red.position.z -0.025 m, 0.025 m",
                     "No run failed or is doubtful.", "highest", "lowest", "Spearman's rank correlation",
                     "energy lost (J): down restitution.default, across balls.red.position.z", "energy lost (J): all"):
            assert text in page, (text, page)
    print(f"{numbers} numbers, {len(sheets)} sheets")


main()
