#!/usr/bin/env python3
"""One small picture of each scene of scenes/, and the page that shows them.

    gallery.py CAROM            all pictures, and the page
    gallery.py CAROM SCENE...   the pictures of these scenes, such as clay

A picture shows what follows the first collision, or the middle of a motion without one.
"""

import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes"
PICTURES = SCENES / "gallery"
SIZE = (256, 144)
COLUMNS = 3


def moment(summary):
    """The time of the picture in s, by a run's summary."""
    duration, first = float(summary["duration_s"]), summary["first_collision_s"]
    begin = float(first) if first else 0.4 * duration
    return begin + 0.15 * (duration - begin)


def draw(carom, scene):
    def run(only, name, *settings):
        subprocess.run([carom, "run", scene, "--only", only, *settings, "-q", "-o", f"{folder}/{name}"], check=True)
        return pathlib.Path(folder, name)

    with tempfile.TemporaryDirectory() as folder:
        with (run("energy", "motion") / "summary.csv").open() as file:
            time = moment(next(csv.DictReader(file)))
        values = [f"size=[{SIZE[0]},{SIZE[1]}]", "fps=50", f"from={time:.6f}", f"until={time + 0.02:.6f}"]
        settings = [word for value in values for word in ("--set", f"output.frames.{value}")]
        frames = run("frames", "pictures", *settings) / "frames"
        shutil.copyfile(min(frames.iterdir()), PICTURES / f"{scene.stem}.png")


def title_of(scene):
    line = next(line for line in scene.read_text().splitlines() if line.startswith("title:"))
    return line.removeprefix("title:").strip().strip("'\"")


def page(scenes):
    cells = [f"![{s.stem}](gallery/{s.stem}.png)<br>[{title_of(s)}]({s.name})" for s in scenes]
    cells += [""] * (-len(cells) % COLUMNS)
    rows = [" | ".join(cells[i : i + COLUMNS]) for i in range(0, len(cells), COLUMNS)]
    head = ["# Gallery", "", "What follows the first collision of each scene. `./dev gallery` draws the pictures.", ""]
    table = [f"| {' | '.join([' '] * COLUMNS)} |", f"| {' | '.join(['---'] * COLUMNS)} |"]
    return "\n".join(head + table + [f"| {row} |" for row in rows]) + "\n"


def main():
    carom, names = sys.argv[1], sys.argv[2:]
    PICTURES.mkdir(exist_ok=True)
    scenes = sorted(SCENES.glob("*.yaml"))
    for scene in scenes:
        if not names or scene.stem in names:
            draw(carom, scene)
    if not names:
        (SCENES / "gallery.md").write_text(page(scenes))


if __name__ == "__main__":
    main()
