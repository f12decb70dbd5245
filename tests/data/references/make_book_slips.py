"""The numerical effect of each slip in listings 8.3 and 8.4 of Conger, Physics Modeling for Game Programmers.

The frame loop runs in double precision, operation by operation as here: its last digits depend on their order.
Everything else is a closed form. Velocities are by v = 5 m/s. The slips:
  1    e = (e0 e1) / 2, where the text says average;
  2    |d|^2 < (r0 + r0)^2, the first radius twice;
  3    the force is m v'/dt with the whole new velocity v', where the text means its change:
       A, the velocity is kept until the force acts; B, the velocity is set to v' before that;
  4    no test that the bodies approach.
"""
import math
import statistics
from dataclasses import dataclass
from fractions import Fraction

SPEED, MASS, RADIUS, FRAME = 5.0, 10.0, 0.11, 1 / 60  # m/s, kg, m, s
FRAMES, PHASES = 180, 200
START = 1.0  # m, from the origin, and up to two frames' way more
E_TEXT, E_LISTING = 0.9, 0.9 * 0.9 / 2


@dataclass(frozen=True)
class Variant:
    """Which slips a run has."""

    name: str
    e: float
    force: str  # "change": m (v' - v) / dt; "A" and "B": slip 3
    approach_test: bool


VARIANTS = [
    Variant("correct (time-stepped)", E_TEXT, "change", True),
    Variant("slip 1 only: e=(e1*e2)/2", E_LISTING, "change", True),
    Variant("slip 3 only, variant A: F=m v_out/dt, velocity kept", E_TEXT, "A", True),
    Variant("slip 3 only, variant B: velocity set AND F=m v_out/dt", E_TEXT, "B", True),
    Variant("slip 4 only: no approach check", E_TEXT, "change", False),
    Variant("slips 1+3A+4", E_LISTING, "A", False),
    Variant("slips 1+3B+4", E_LISTING, "B", False),
    Variant("slips 1+4", E_LISTING, "change", False),
    Variant("slips 1+3B", E_LISTING, "B", True),
    Variant("slips 1+3A", E_LISTING, "A", True),
]


def dot(a: list[float], b: list[float]) -> float:
    """a.b, summed from x to z."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def difference(a: list[float], b: list[float]) -> list[float]:
    """a - b"""
    return [p - q for p, q in zip(a, b)]


class Frames:
    """The loop of listing 8.3 with two balls, from one phase: clear the forces, test for overlap, handle, update."""

    def __init__(self, scene: str, variant: Variant, away: float):
        self.variant = variant
        self.x = [[-away, 0.0, 0.0], [away, 0.0, 0.0] if scene == "head" else [0.0, -away, 0.0]]
        self.v = [[SPEED, 0.0, 0.0], [-SPEED, 0.0, 0.0] if scene == "head" else [0.0, SPEED, 0.0]]
        self.force = [[0.0] * 3, [0.0] * 3]
        self.started, self.momentum = self.separation(), self.total_velocity()
        self.calls, self.deepest = 0, math.inf
        for _ in range(FRAMES):
            self.frame()

    def separation(self) -> list[float]:
        """d = x0 - x1"""
        return difference(self.x[0], self.x[1])

    def total_velocity(self) -> list[float]:
        """v0 + v1, the momentum by the mass."""
        return [p + q for p, q in zip(self.v[0], self.v[1])]

    def frame(self) -> None:
        """Listing 8.3; the update is a = F / m, v += a dt, x += v dt."""
        self.force = [[0.0] * 3, [0.0] * 3]
        d = self.separation()
        if dot(d, d) < (2 * RADIUS) ** 2:
            self.handle(d)
        for i in (0, 1):
            self.v[i] = [v + f / MASS * FRAME for v, f in zip(self.v[i], self.force[i])]
            self.x[i] = [x + v * FRAME for x, v in zip(self.x[i], self.v[i])]

    def handle(self, d: list[float]) -> None:
        """Listing 8.4 with equal masses: v' = v + (u' - u) n, u0' = ((m - e m) u0 + (1 + e) m u1) / 2 m.

        Where the centres coincide d / |d| is undefined, and so is everything after.
        """
        distance = math.sqrt(dot(d, d))
        self.deepest = min(self.deepest, distance - 2 * RADIUS)
        n = [q / distance if distance > 0 else math.nan for q in d]
        u0, u1 = dot(self.v[0], n), dot(self.v[1], n)
        if self.variant.approach_test and u0 - u1 >= 0:
            return
        self.calls += 1
        e = self.variant.e
        w0 = ((MASS - e * MASS) * u0 + (1 + e) * MASS * u1) / (MASS + MASS)
        w1 = ((MASS - e * MASS) * u1 + (1 + e) * MASS * u0) / (MASS + MASS)
        after = [[v + (w - u) * q for v, q in zip(self.v[i], n)] for i, u, w in ((0, u0, w0), (1, u1, w1))]
        whole = self.variant.force != "change"
        velocity = after if whole else [difference(p, q) for p, q in zip(after, self.v)]
        self.force = [[MASS * q / FRAME for q in v] for v in velocity]
        if self.variant.force == "B":
            self.v = after

    def energy_ratio(self) -> float:
        """(v0^2 + v1^2) / 2 v^2"""
        return (dot(self.v[0], self.v[0]) + dot(self.v[1], self.v[1])) / (2 * SPEED * SPEED)

    def overlaps(self) -> bool:
        """|d| < r0 + r1"""
        return math.sqrt(dot(self.separation(), self.separation())) < 2 * RADIUS

    def passed_through(self) -> bool:
        """The line of centres has turned by more than a right angle."""
        return dot(self.separation(), self.started) < 0


def known(value: float) -> float | None:
    """JSON has no NaN: null takes its place."""
    return None if math.isnan(value) else value


def median(values: list[float]) -> float | None:
    """The median, undefined where one of the values is."""
    return None if any(map(math.isnan, values)) else statistics.median(values)


def share(flags: list[bool]) -> float:
    """The fraction that is true."""
    return sum(flags) / len(flags)


def simulated(scene: str, variant: Variant) -> dict:
    """One variant from 200 phases, which cover two frames' way. min and max begin with the first phase's value."""
    runs = [Frames(scene, variant, START + 2 * ((k + 0.5) / PHASES) * SPEED * FRAME) for k in range(PHASES)]
    ratios = [run.energy_ratio() for run in runs]
    first = [known(q / SPEED) for q in difference(runs[0].total_velocity(), runs[0].momentum)]
    return {
        "scene": scene,
        "variant": variant.name,
        "KE_ratio_median": median(ratios),
        "KE_ratio_min": known(min(ratios)),
        "KE_ratio_max": known(max(ratios)),
        "fraction_multiple_calls": share([run.calls > 1 for run in runs]),
        "fraction_overlapping_at_end": share([run.overlaps() for run in runs]),
        "fraction_passed_through": share([run.passed_through() for run in runs]),
        "deepest_overlap": min(run.deepest for run in runs),
        "v0_single_call": next(([q / SPEED for q in run.v[0]] for run in runs if run.calls == 1), None),
        "v0_median": [median([run.v[0][axis] / SPEED for run in runs]) for axis in (0, 1)],
        "max_calls": max(run.calls for run in runs),
        "momentum_change": first[:2],
    }


def single_call() -> dict:
    """One handled collision of equal masses, exactly, in fractions; the doubles nearest to these are written.

    Head on u0' = -e v. At right angles v0' = v ((1 - e) / 2, (1 + e) / 2). Slip 3A adds v' to v, slip 3B doubles v'.
    """
    text, listing = Fraction(9, 10), Fraction(81, 200)

    def head_on(e: Fraction) -> list[Fraction]:
        return [-e]

    def right_angle(e: Fraction) -> list[Fraction]:
        return [(1 - e) / 2, (1 + e) / 2]

    def variants(after, before: list[int]) -> dict[str, list[Fraction]]:
        def kept(e: Fraction) -> list[Fraction]:
            return [p + q for p, q in zip(before, after(e))]

        def doubled(e: Fraction) -> list[Fraction]:
            return [2 * q for q in after(e)]

        return {"exact": after(text), "slip1": after(listing), "slip3A": kept(text), "slip3B": doubled(text),
                "slip1_3A": kept(listing), "slip1_3B": doubled(listing)}

    def doubles(v: list[Fraction]) -> list[float]:
        return [float(q) for q in v]

    def energies(cases: dict[str, list[Fraction]]) -> dict[str, float]:
        # By symmetry both balls have the same speed after as before: the ratio is that of one ball.
        return {name: float(sum(q**2 for q in v)) for name, v in cases.items()}

    head, right = variants(head_on, [1]), variants(right_angle, [1, 0])
    return {
        "note": "v = common speed, equal masses. Exact: head-on v0'=-e v; right angles v0'=v((1-e)/2,(1+e)/2,0).",
        "e_text": float(text),
        "e_listing": float(listing),
        "head_on": {name: float(v[0]) for name, v in head.items()},
        "right_angle": {name: doubles(v) for name, v in right.items()},
        "KE_ratio": {"head_on": energies(head), "right_angle": energies(right)},
        "e_table": [{"e": e, "average": (e + e) / 2, "listing": e * e / 2} for e in (0.0, 0.1, 0.5, 0.8, 0.9, 1.0)],
    }


def slip_of_radius(r0: float, r1: float) -> dict:
    """Contact at r0 + r1 is found at 2 r0.

    The gap closes at 2 v head on, and at sqrt(2) v at right angles.
    """
    true, listing = r0 + r1, 2 * r0
    return {
        "r0": r0,
        "r1": r1,
        "contact_distance_true": true,
        "contact_distance_listing": listing,
        "time_shift_head_on": (true - listing) / (2 * SPEED),
        "time_shift_right_angle": (true - listing) / (math.sqrt(2) * SPEED),
        "overlap_before_detection": max(0, r1 - r0),
        "gap_at_detection": max(0, r0 - r1),
    }


def offset_collision(r0: float, r1: float, b: float) -> dict:
    """Equal masses with v and -v along x, offset by b; the line of centres has the sine b / distance.

    v0' = v (1 - (1 + e) cos^2, (1 + e) cos sin), and v where the balls miss.
    """
    def velocity(distance: float) -> list[float]:
        if b >= distance:
            return [1.0, 0.0]
        sine = b / distance
        cosine = math.sqrt(1 - sine * sine)
        return [1 - (1 + E_TEXT) * cosine * cosine, (1 + E_TEXT) * cosine * sine]

    return {"r0": r0, "r1": r1, "b": b, "v0_true": velocity(r0 + r1), "v0_listing": velocity(2 * r0)}


OFFSETS = [(0.11, 0.2, b) for b in (0.0, 0.05, 0.1, 0.2, 0.25, 0.3)] + [(0.2, 0.11, b) for b in (0.1, 0.2, 0.3, 0.35)]


def compute() -> dict:
    """The content of book_slips.json."""
    return {
        "title": "Conger ch. 8 HandleCollision: numerical effect of each slip",
        "provenance": "computed from the arithmetic of listings 8.3 and 8.4 as printed (slip 3: the velocity is "
                      "overwritten and the whole outgoing velocity is added again as a force: reading B). Frame loop: "
                      "overlap test, HandleCollision, semi-implicit Euler; v=5 m/s, m=10 kg, r=0.11 m, dt=1/60 s, "
                      "200 starting phases",
        "closed_form_single_call": single_call(),
        "simulated": [simulated(scene, variant) for scene in ("head", "right") for variant in VARIANTS],
        "slip2_radius": [slip_of_radius(*radii) for radii in ((0.11, 0.11), (0.11, 0.2), (0.2, 0.11))],
        "slip2_offset_collision": [offset_collision(*case) for case in OFFSETS],
    }
