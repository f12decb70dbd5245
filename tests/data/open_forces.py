#!/usr/bin/python3
"""Writes open_forces.json: statically open contacts at rest, with the forces whose squares have the least sum.

The solver is independent of carom's: scipy's non-negative least squares guesses which contacts bear, least squares on
these gives the forces, and a linear program proves them: displacements d exist with N'd = x where a contact bears, and
N'd <= 0 elsewhere. Needs Debian's python3-scipy.
"""
import json
import pathlib

import numpy as np
from scipy.optimize import linprog, nnls

DOWN = np.array([0, -1.0, 0])
LOAD = 10.0  # m/s^2


def touching(x: np.ndarray, walls: bool) -> list:
    """Contacts of balls of radius 1 with each other, with a floor below them, and with walls around them."""
    low, high = x.min(0), x.max(0)
    contacts = []
    for i in range(len(x)):
        for j in range(i + 1, len(x)):
            if np.linalg.norm(x[j] - x[i]) < 2 + 1e-9:
                contacts.append((i, j, (x[j] - x[i]) / np.linalg.norm(x[j] - x[i])))
        for axis in range(3):
            unit = np.eye(3)[axis]
            wanted = axis == 1 or (walls and high[axis] > low[axis])
            if wanted and x[i][axis] < low[axis] + 1e-9:
                contacts.append((i, -1, -unit))
            if wanted and axis != 1 and x[i][axis] > high[axis] - 1e-9:
                contacts.append((i, -1, unit))
    return contacts


def slabs(count: int, legs: int) -> tuple:
    """A stack of slabs of 1, 2 and 3 kg in turn, the lowest on so many legs."""
    contacts = [(0, -1, DOWN)] * legs + [(i, i - 1, DOWN) for i in range(1, count)]
    return [1.0 + i % 3 for i in range(count)], contacts


def bricks(rows: int, columns: int) -> tuple:
    """A wall of bricks of 1 kg in running bond."""
    contacts = [(c, -1, DOWN) for c in range(columns)]
    for r in range(1, rows):
        for c in range(columns):
            for below in (c, c + 1) if r % 2 else (c - 1, c):
                if 0 <= below < columns:
                    contacts.append((r * columns + c, (r - 1) * columns + below, DOWN))
    return [1.0] * (rows * columns), contacts


def balls(places: list) -> tuple:
    """Balls of 1 kg between walls."""
    return [1.0] * len(places), touching(np.array(places, float), True)


def square(side: int) -> tuple:
    return balls([(2 * i, 2 * j, 0) for i in range(side) for j in range(side)])


def pyramid(rows: int) -> tuple:
    return balls([(2 * i + k, k * np.sqrt(3), 0) for k in range(rows) for i in range(rows - k)])


def lattice(cells: int) -> tuple:
    corners = ((0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5))
    edge = 2 * np.sqrt(2)
    return balls([edge * (np.array((i, j, k)) + c) for i in range(cells) for j in range(cells) for k in range(cells)
                  for c in corners])


CASES = {
    "slab on four legs": ([8.0], [(0, -1, DOWN)] * 4),
    "4 slabs on six legs": slabs(4, 6),
    "40 slabs on six legs": slabs(40, 6),
    "400 slabs on six legs": slabs(400, 6),
    "wall of 4 bricks": bricks(2, 2),
    "wall of 40 bricks": bricks(5, 8),
    "wall of 400 bricks": bricks(20, 20),
    "square of 4 balls between walls": square(2),
    "square of 400 balls between walls": square(20),
    "pyramid of 6 balls between walls": pyramid(3),
    "pyramid of 36 balls between walls": pyramid(8),
    "lattice of 4 balls in a box": lattice(1),
    "lattice of 32 balls in a box": lattice(2),
}


def least_forces(mass: list, contacts: list) -> list:
    """The forces (N) that hold all bodies at rest, with the least sum of squares."""
    pushes = np.zeros((3 * len(mass), len(contacts)))
    for k, (a, b, normal) in enumerate(contacts):
        pushes[3 * a:3 * a + 3, k] -= normal
        if b >= 0:
            pushes[3 * b:3 * b + 3, k] += normal
    needed = np.zeros(3 * len(mass))
    needed[1::3] = LOAD * np.array(mass)

    weight = 1e4
    guess, _ = nnls(np.vstack([weight * pushes, np.eye(len(contacts))]),
                    np.append(weight * needed, np.zeros(len(contacts))), maxiter=50 * len(contacts))
    bears = guess > 1e-7 * guess.max()
    force = np.zeros(len(contacts))
    force[bears] = np.linalg.lstsq(pushes[:, bears], needed, rcond=1e-11)[0]

    # The proof.
    assert (force >= 0).all() and abs(pushes @ force - needed).max() < 1e-11 * needed.max()
    others = pushes[:, ~bears].T
    proof = linprog(np.zeros(len(needed)), A_ub=others if len(others) else None,
                    b_ub=np.full(len(others), 1e-9) if len(others) else None, A_eq=pushes[:, bears].T,
                    b_eq=force[bears], bounds=[(None, None)] * len(needed), method="highs")
    assert proof.status == 0
    return force.tolist()


def main() -> None:
    entries = []
    for name, (mass, contacts) in CASES.items():
        flat = [[int(a), int(b), *map(float, normal)] for a, b, normal in contacts]
        entries.append({"name": name, "mass": mass, "contacts": flat, "force": least_forces(mass, contacts)})
    text = "[\n" + ",\n".join(json.dumps(entry) for entry in entries) + "\n]\n"
    pathlib.Path(__file__).with_suffix(".json").write_text(text)


if __name__ == "__main__":
    main()
