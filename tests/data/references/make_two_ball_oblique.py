"""Two balls that meet obliquely: time of contact, normal, impulse, velocities after, and states later.

Vectors are lists of three numbers, mpf or Fraction; the same functions serve both.
"""
from dataclasses import dataclass, replace
from fractions import Fraction

from mpmath import mpf, sqrt

from reference_json import exact

RESTITUTIONS = ["0", "0.5", "0.9", "1", "1.1"]
Vector = list


@dataclass(frozen=True)
class Pair:
    """Two balls: masses, radii, positions and velocities."""

    m1: mpf
    m2: mpf
    R1: mpf
    R2: mpf
    p1: Vector
    v1: Vector
    p2: Vector
    v2: Vector


CASE_A = Pair(m1=mpf(1), m2=mpf(3), R1=mpf("0.5"), R2=mpf("0.25"),
              p1=[mpf(0), mpf(0), mpf(0)], v1=[mpf(2), mpf("0.5"), mpf("-0.25")],
              p2=[mpf(3), mpf("0.375"), mpf("0.25")], v2=[mpf(-1), mpf("0.25"), mpf("0.125")])
CASE_B = Pair(m1=mpf(1), m2=mpf(3), R1=mpf(3), R2=mpf(4),
              p1=[mpf(0), mpf(0), mpf(0)], v1=[mpf(1), mpf(1), mpf(1)],
              p2=[mpf(4), mpf(4), mpf(8)], v2=[mpf(-1), mpf(0), mpf(-1)])
NO_GRAVITY = [mpf(0)] * 3
GRAVITY = [mpf(0), mpf(0), mpf("-9.8125")]


def dot(a: Vector, b: Vector):
    """a.b"""
    return sum(p * q for p, q in zip(a, b))


def along(a: Vector, s, b: Vector) -> Vector:
    """a + s b"""
    return [p + s * q for p, q in zip(a, b)]


def difference(a: Vector, b: Vector) -> Vector:
    """a - b"""
    return [p - q for p, q in zip(a, b)]


def contact_time(pair: Pair) -> mpf:
    """|d + w t|^2 = (R1 + R2)^2, the first root; a common gravity drops out.

    t = c / (-b + sqrt(b^2 - a c)) with a = w.w, b = d.w < 0, c = d.d - (R1 + R2)^2.
    This form subtracts no near numbers.
    """
    d, w = difference(pair.p2, pair.p1), difference(pair.v2, pair.v1)
    a, b, c = dot(w, w), dot(d, w), dot(d, d) - (pair.R1 + pair.R2) ** 2
    return c / (-b + sqrt(b * b - a * c))


def normal(pair: Pair) -> Vector:
    """n = (x2 - x1) / (R1 + R2) of two balls that touch, from 1 to 2."""
    return [q / (pair.R1 + pair.R2) for q in difference(pair.p2, pair.p1)]


def impulse(pair: Pair, n: Vector, e):
    """J = -(1 + e) mu (v2 - v1).n with mu = m1 m2 / (m1 + m2): Newton's law of impact and momentum."""
    return -(1 + e) * pair.m1 * pair.m2 / (pair.m1 + pair.m2) * dot(difference(pair.v2, pair.v1), n)


def collide(pair: Pair, e) -> Pair:
    """v1' = v1 - J n / m1, v2' = v2 + J n / m2."""
    n = normal(pair)
    j = impulse(pair, n, e)
    return replace(pair, v1=along(pair.v1, -j / pair.m1, n), v2=along(pair.v2, j / pair.m2, n))


def fly(pair: Pair, t, g: Vector) -> Pair:
    """x + v t + g t^2 / 2 and v + g t: free fall."""
    return replace(pair, p1=along(along(pair.p1, t, pair.v1), t * t / 2, g), v1=along(pair.v1, t, g),
                   p2=along(along(pair.p2, t, pair.v2), t * t / 2, g), v2=along(pair.v2, t, g))


def kinetic_energy(pair: Pair):
    """m1 v1^2 / 2 + m2 v2^2 / 2"""
    return (pair.m1 * dot(pair.v1, pair.v1) + pair.m2 * dot(pair.v2, pair.v2)) / 2


def energy_change(pair: Pair, e):
    """-(1 - e^2) mu vn^2 / 2 with vn the approach along the normal."""
    vn = dot(difference(pair.v2, pair.v1), normal(pair))
    return -(1 - e * e) * pair.m1 * pair.m2 / (pair.m1 + pair.m2) * vn * vn / 2


def state(after: Pair, contact: mpf, t: mpf, g: Vector) -> dict:
    """Free fall from the contact to the time t."""
    later = fly(after, t - contact, g)
    return {"t": t, "p1": later.p1, "p2": later.p2, "v1": later.v1, "v2": later.v2}


def result(pair: Pair, e: mpf, g: Vector, times: list[mpf]) -> dict:
    """One collision with coefficient e, by the formulas of the functions above."""
    t = contact_time(pair)
    before = fly(pair, t, g)
    after = collide(before, e)
    n = normal(before)
    return {
        "e": e,
        "t_contact": t,
        "normal_1to2": n,
        "approach_speed": dot(difference(before.v1, before.v2), n),
        "impulse": impulse(before, n, e),
        "pos1_at_contact": before.p1,
        "pos2_at_contact": before.p2,
        "v1_before": before.v1,
        "v2_before": before.v2,
        "v1_after": after.v1,
        "v2_after": after.v2,
        "KE_before": kinetic_energy(before),
        "KE_after": kinetic_energy(after),
        "dKE": energy_change(before, e),
        "states": [state(after, t, u, g) for u in times],
    }


def results(pair: Pair, g: Vector, times: list[int]) -> list:
    """A result for each of RESTITUTIONS."""
    return [result(pair, mpf(e), g, [mpf(t) for t in times]) for e in RESTITUTIONS]


def params(pair: Pair) -> dict:
    """The members in the order of the file."""
    return {key: getattr(pair, key) for key in ("m1", "m2", "R1", "R2", "p1", "v1", "p2", "v2")}


def exact_rationals() -> list:
    """Case B in fractions: at t = 1 the balls touch, so that no root is needed."""
    whole = Pair(**{key: [Fraction(int(q)) for q in value] if isinstance(value, list) else Fraction(int(value))
                    for key, value in params(CASE_B).items()})
    touching = fly(whole, Fraction(1), [Fraction(0)] * 3)
    assert dot(difference(touching.p2, touching.p1), difference(touching.p2, touching.p1)) == (whole.R1 + whole.R2) ** 2
    rows = []
    for e in map(Fraction, RESTITUTIONS):
        after = collide(touching, e)
        rows.append({"e": e, "v1": after.v1, "v2": after.v2})
    return rows


def half_balls(m2: int, p2: list, v1: list) -> Pair:
    """Balls of radius 1/2, the first of mass 1 at the origin, the second at rest."""
    return Pair(mpf(1), mpf(m2), mpf("0.5"), mpf("0.5"), NO_GRAVITY, [exact(Fraction(q)) for q in v1],
                [exact(Fraction(q)) for q in p2], NO_GRAVITY)


def grazing(k: int) -> dict:
    """Equal balls with an impact parameter of 1 - 2^-k diameters, e = 1."""
    b = 1 - Fraction(1, 2**k)
    pair = half_balls(1, [4, b, 0], [1, 0, 0])
    t = contact_time(pair)
    touching = fly(pair, t, NO_GRAVITY)
    after = collide(touching, mpf(1))
    return {"k": k, "impact_parameter": exact(b), "t_contact": t, "v1_after": after.v1, "v2_after": after.v2,
            "normal": normal(touching)}


def near_touching(k: int) -> dict:
    """Balls with a gap of 2^-k diameters, masses 1 and 2, e = 1."""
    gap = Fraction(1, 2**k)
    pair = half_balls(2, [1 + gap, 0, 0], [1, 1, 0])
    t = contact_time(pair)
    after = collide(fly(pair, t, NO_GRAVITY), mpf(1))
    return {"k": k, "gap": exact(gap), "t_contact": t, "v1_after": after.v1, "v2_after": after.v2}


def compute() -> dict:
    """The content of two_ball_oblique.json."""
    return {
        "title": "Two-ball oblique collision in 3D",
        "provenance": "computed (mpmath 60 digits; case B also exact rational arithmetic)",
        "formulas": "n=(x2-x1)/(R1+R2) at contact; J=-(1+e) mu (v2-v1).n; v1-=J n/m1; v2+=J n/m2; "
                    "dKE=-(1-e^2) mu vn^2/2; t=c/(-b+sqrt(b^2-ac))",
        "case_A": {"params": params(CASE_A), "results": results(CASE_A, NO_GRAVITY, [1, 2])},
        "case_A_gravity": {
            "note": "same with uniform gravity (0,0,-9.8125): contact time and normal unchanged",
            "results": results(CASE_A, GRAVITY, [1, 2]),
        },
        "case_B_exact": {
            "params": params(CASE_B),
            "results": results(CASE_B, NO_GRAVITY, [2]),
            "exact_rationals": exact_rationals(),
            "note": "discriminant 1444=38^2; contact at exactly t=1; all inputs integers",
        },
        "case_C_grazing": {
            "note": "v1=(1,0,0), p1=0, p2=(4,b,0), b=1-2^-k, equal masses, e=1, R=0.5",
            "results": [grazing(k) for k in (2, 5, 10, 20, 30, 40, 52)],
        },
        "case_D_near_touching": {
            "note": "p2=(1+2^-k,0,0), v1=(1,1,0), m=1,2, e=1, R=0.5",
            "results": [near_touching(k) for k in (10, 20, 30, 40, 50)],
        },
    }
