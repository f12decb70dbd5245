#!/usr/bin/python3
"""The program of src/README.md that uses carom as a library: installed, moved, built and run. Its numbers are those of
carom run, to the last bit.

library_test.py BUILD_FOLDER COMPILER CAROM
"""

import csv
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

build, compiler, carom = sys.argv[1:]
root = pathlib.Path(__file__).resolve().parents[2]


def run(*words, code=0):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == code, f"{words}\n{done.stdout}{done.stderr}"
    return done


def page_block(language):
    """The block of that language in the section on the library."""
    section = (root / "src/README.md").read_text().split("\n## As a library\n")[1].split("\n## ")[0]
    (block,) = re.findall(f"```{language}\n(.*?)```", section, re.DOTALL)
    return block


def configure(place, text, prefix, code=0):
    place.mkdir()
    (place / "CMakeLists.txt").write_text(text)
    return run("cmake", "-S", place, "-B", place / "build", f"-DCMAKE_PREFIX_PATH={prefix}",
               f"-DCMAKE_CXX_COMPILER={compiler}", code=code)


def check_headers(prefix):
    """They need nothing but one another, Eigen and the standard library."""
    headers = list((prefix / "include").rglob("*.h"))
    assert prefix / "include/carom/carom.h" in headers
    for header in headers:
        for mark, path in re.findall(r'^#include (["<])([^">]+)', header.read_text(), re.MULTILINE):
            if mark == '"':
                assert (prefix / "include" / path).exists(), f"{header}: {path}"
            else:
                assert path.startswith("Eigen/") or re.fullmatch("[a-z_]+", path), f"{header}: {path}"
    assert not (prefix / "bin").exists()  # the program is another component


def check_versions(place, prefix):
    """0.2 serves requests for 0.2 alone."""
    for number in ("0.1", "0.3", "1.0"):
        text = f"cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES NONE)\nfind_package(carom {number} REQUIRED)\n"
        refused = configure(place / number, text, prefix, code=1).stderr
        assert "0.2" in refused, refused


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_numbers(program, place):
    for name in ("two_bowling_balls", "balls_in_a_box"):
        scene = root / f"scenes/{name}.yaml"
        said = run(program, scene).stdout.splitlines()
        folder = place / name
        run(carom, "run", scene, "-q", "--only", "trajectory,collisions", "-o", folder)

        hits = [line.split() for line in said if " meets " in line]
        rows = [row for row in rows_of(folder / "collisions.csv")]
        assert [(h[0], h[2], float(h[4])) for h in hits] == [(r["a"], r["b"], float(r["time_s"])) for r in rows]
        assert hits

        ends = [line.split() for line in said if " ends at " in line]
        last = rows_of(folder / "trajectory.csv")[-len(ends):]
        assert [(e[0], [float(x) for x in e[3:6]]) for e in ends] == [
            (r["body"], [float(r[key]) for key in ("x_m", "y_m", "z_m")]) for r in last]


def main():
    with tempfile.TemporaryDirectory(prefix="carom-library-") as folder:
        place = pathlib.Path(folder)
        run("cmake", "--install", build, "--component", "development", "--prefix", place / "first")
        prefix = place / "moved"
        shutil.move(place / "first", prefix)
        check_headers(prefix)
        check_versions(place, prefix)

        example = place / "example"
        configure(example, page_block("cmake"), prefix, code=1)  # its source is missing
        (example / "last_places.cpp").write_text(page_block("cpp"))
        run("cmake", example / "build")
        run("cmake", "--build", example / "build")
        program = example / "build/last_places"
        check_numbers(program, place)

        wrong = place / "wrong.yaml"
        wrong.write_text("scene: 1\nbals: {}\nsimulate: {duration: 1}\n")
        refused = run(program, wrong, code=1).stderr
        assert "wrong.yaml:2:1: error: unknown key `bals`" in refused, refused


main()
