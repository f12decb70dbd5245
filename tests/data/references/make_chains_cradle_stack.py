"""Balls in a row or a stack: cradles, chains of masses, collapse.

The rows are exact: positions, velocities and times are fractions, and the next collision is found by comparing
fractions. Roots occur in the stack and in the limit of collapse alone; mpmath computes these.
"""
from dataclasses import dataclass, field
from fractions import Fraction

from mpmath import log, mpf, sqrt

from reference_json import exact


def impact(m1, m2, v1, v2, e) -> tuple:
    """v1' = ((m1 - e m2) v1 + (1 + e) m2 v2) / (m1 + m2) (Conger ch. 8).

    v2' is the same with 1 and 2 exchanged.
    """
    return (((m1 - e * m2) * v1 + (1 + e) * m2 * v2) / (m1 + m2), ((m2 - e * m1) * v2 + (1 + e) * m1 * v1) / (m1 + m2))


@dataclass
class Row:
    """Balls of radius 1/2 on a line, in free motion. Pair i is balls i and i + 1."""

    m: list[Fraction]
    x: list[Fraction]
    v: list[Fraction]
    e: list[Fraction]  # of each pair
    t: Fraction = Fraction(0)  # of the last collision
    order: list[int] = field(default_factory=list)  # the pairs that collided

    def time_until(self, pair: int) -> Fraction | None:
        """(x2 - x1 - 2 R) / (v1 - v2) of a pair that approaches."""
        approach = self.v[pair] - self.v[pair + 1]
        return (self.x[pair + 1] - self.x[pair] - 1) / approach if approach > 0 else None

    def run(self) -> None:
        """Collision after collision until no pair approaches; of equal times the lowest pair is first."""
        while due := [(time, i) for i in range(len(self.e)) if (time := self.time_until(i)) is not None]:
            step, i = min(due)
            self.x = [x + step * v for x, v in zip(self.x, self.v)]
            self.v[i], self.v[i + 1] = impact(self.m[i], self.m[i + 1], self.v[i], self.v[i + 1], self.e[i])
            self.t += step
            self.order.append(i)


def struck_row(m: list[Fraction], x: list[Fraction], e: list[Fraction], moving: int = 1) -> Row:
    """A row whose first balls move with speed 1; the others are at rest."""
    return Row(m, x, [Fraction(int(i < moving)) for i in range(len(m))], e)


def elastic_cradle(moving: int) -> dict:
    """Five equal balls with e = 1, with gaps of 1/1024 and a gap of 1 before the balls at rest."""
    gap = Fraction(1, 1024)
    x = [i * (1 + gap) + (1 - gap if i >= moving else 0) for i in range(5)]
    row = struck_row([Fraction(1)] * 5, x, [Fraction(1)] * 4, moving)
    start = {"k_incoming": moving, "x0": row.x, "v0": list(row.v)}
    row.run()
    return start | {"n_collisions": len(row.order), "v_final": row.v, "order": row.order}


def inelastic_cradle(e: Fraction) -> dict:
    """Five equal balls with gaps of 1/1024; the first pass leaves ((1 + e) / 2)^4 with the last ball."""
    row = struck_row([Fraction(1)] * 5, [i * (1 + Fraction(1, 1024)) for i in range(5)], [e] * 4)
    row.run()
    return {
        "e": exact(e),
        "n_collisions": len(row.order),
        "v_final": [exact(v) for v in row.v],
        "first_pass_last_ball": exact(((1 + e) / 2) ** 4),
        "order_first40": row.order[:40],
        "t_last": exact(row.t),
    }


def in_turn(m: list[int], e: Fraction, v: list[int], pair: int) -> dict:
    """Three balls that touch: one pair collides, then the other, in turn, as long as they approach."""
    speeds, count = [Fraction(q) for q in v], 0
    while speeds[pair] > speeds[pair + 1]:
        speeds[pair], speeds[pair + 1] = impact(m[pair], m[pair + 1], speeds[pair], speeds[pair + 1], e)
        count += 1
        pair = 1 - pair
    return {"v": speeds, "n": count}


def at_once(m: list[int], e: Fraction, v: list[int]) -> dict:
    """Both relative velocities become -e times what they were, and momentum is conserved: three linear equations."""
    total = sum(m)
    a, b = -e * (v[0] - v[1]), -e * (v[1] - v[2])  # v0 - v1 and v1 - v2 after
    middle = (sum(Fraction(q * p) for q, p in zip(m, v)) - m[0] * a + m[2] * b) / total
    return {
        "v": [middle + a, middle, middle - b],
        "note": "solve both impulses together with v_rel+ = -e v_rel- on both contacts",
    }


def three_balls(m: list[int], e: Fraction) -> dict:
    """The outer balls strike the middle one at the same instant."""
    v = [1, 0, -1]
    return {
        "m": m,
        "e": exact(e),
        "v_in": v,
        "sequential_first_pair_0": in_turn(m, e, v, 0),
        "sequential_first_pair_1": in_turn(m, e, v, 1),
        "simultaneous_newton": at_once(m, e, v),
    }


def stacked_drop(tag: str, m1: str, m2: str, e_floor: str, e_ball: str) -> dict:
    """Two balls fall, the lower one from h, the upper one with a gap above it.

    The lower ball meets the floor at t1 = sqrt(2 h / g) with u = sqrt(2 g h), and leaves it with e u.
    Gravity is common, so that the gap closes at the speed (1 + e) u, tau = gap / ((1 + e) u) later.
    """
    ma, mb, ef, eb = map(mpf, (m1, m2, e_floor, e_ball))
    h, gap, R1, R2, g = map(mpf, ("1", "0.01", "0.12", "0.033", "9.81"))
    t1, u = sqrt(2 * h / g), sqrt(2 * g * h)
    tau = gap / ((1 + ef) * u)
    before = [ef * u - g * tau, -u - g * tau]
    z1 = R1 + ef * u * tau - g * tau**2 / 2
    z2 = 2 * R1 + R2 + h + gap - g * (t1 + tau) ** 2 / 2
    after = list(impact(ma, mb, *before, eb))
    top = z2 + after[1] ** 2 / (2 * g)
    return {
        "tag": tag,
        "m1": ma,
        "m2": mb,
        "e_floor": ef,
        "e_ball": eb,
        "h_bottom": h,
        "gap": gap,
        "R1": R1,
        "R2": R2,
        "g": g,
        "t_floor": t1,
        "t_ball_ball": t1 + tau,
        "v_before": before,
        "v_after": after,
        "z_at_ball_ball": [z1, z2],
        "z2_max": top,
        # Heights above the place of the upper ball when both balls stand on the floor.
        "rebound_height_ratio": (top - 2 * R1 - R2) / (h + gap),
        "zero_gap_speed_ratio": impact(ma, mb, ef, mpf(-1), eb)[1],
    }


def ladder(n: int) -> dict:
    """A stack of n balls, each far heavier than the next: v' = 2 v + 1 a ball, from 1, and the height is its square."""
    speed = 1
    for _ in range(n - 1):
        speed = 2 * speed + 1
    return {"n_balls": n, "speed_ratio": speed, "height_ratio": speed**2}


def mass_chain(n: int, q: Fraction, e: Fraction) -> dict:
    """Masses q^i: each impact passes (1 + e) / (1 + q) of the speed on, by the formula of impact().

    The last ball gets ((1 + e) / (1 + q))^(n - 1).
    """
    row = struck_row([q**i for i in range(n)], [Fraction(2 * i) for i in range(n)], [e] * (n - 1))
    row.run()
    formula = ((1 + e) / (1 + q)) ** (n - 1)
    return {
        "n": n,
        "q": exact(q),
        "e": exact(e),
        "n_collisions": len(row.order),
        "v_last_formula": exact(formula),
        "v_final": [exact(v) for v in row.v],
        "formula_holds": row.v[-1] == formula,
    }


def gauss_gun() -> dict:
    """The first pair has e = 3 and makes energy. KE_gain is the kinetic energy at the end by that at the start."""
    row = struck_row([Fraction(1)] * 4, [Fraction(2 * i) for i in range(4)], [Fraction(3), Fraction(1), Fraction(1)])
    row.run()
    return {
        "setup": "4 equal balls, R=1/2,x_i=2i, v0=(1,0,0,0); pair e=(3,1,1)",
        "v_final": row.v,
        "KE_gain": sum(v**2 for v in row.v),
    }


def most_collisions(e: Fraction, cap: int) -> int:
    """The greatest number of collisions of three equal balls, up to cap.

    The two pairs approach at a and b. A collision of the first makes a' = -e a and b' = b + (1 + e) a / 2.
    Pairs collide in turn, so that the number depends on b / a alone, and grows with it. In the limit of large b / a the
    first collision changes b by nothing, and leaves a = 0.
    """
    a, b, count = Fraction(0), Fraction(1), 1
    while b > 0 and count < cap:
        # The pairs exchange their names after each collision.
        a, b = -e * b, a + (1 + e) / 2 * b
        count += 1
    return count


def collapse() -> dict:
    """A collision multiplies (a, b) of most_collisions by a matrix of trace (1 + e) / 2 and determinant e.

    Collisions need not end where its eigenvalues are real: (1 + e)^2 / 4 >= 4 e, which is e <= 7 - 4 sqrt(3).
    """
    return {
        "e_c": 7 - 4 * sqrt(mpf(3)),
        "source": "McNamara & Young 1992 (abstract read via look-up): r<7-4*sqrt(3)~0.0718; "
                  "re-derived: product matrix eigenvalues real iff e<=7-4sqrt3",
        "search": [
            {"e": exact(e), "max_collisions_found_cap60": most_collisions(e, 60)}
            for e in map(Fraction, ("0.07", "0.071", "0.072", "0.073", "0.08"))
        ],
    }


def estimate(e: str) -> dict:
    """ln(4 / (1 - e)) / (1 - e), after Bernu & Mazighi, J. Phys. A 23 (1990) 5745: balls needed for a collapse."""
    loss = 1 - mpf(e)
    return {"e": e, "N_min_formula_ln4": log(4 / loss) / loss}


STACKS = [
    ("basketball+tennis elastic", "0.624", "0.0577", "1", "1"),
    ("basketball+tennis lossy", "0.624", "0.0577", "0.76", "0.8"),
    ("mass 3:1 elastic (classic: lower ball stops, upper leaves at 2v)", "3", "1", "1", "1"),
    ("mass 1e6:1", "1e6", "1", "1", "1"),
]
CHAINS = [(10, "1/2", "1"), (10, "1/2", "9/10"), (10, "1/2", "1/2"), (10, "2", "1"), (20, "3/4", "1"), (5, "1/10", "1")]


def compute() -> dict:
    """The content of chains_cradle_stack.json."""
    half, one = Fraction(1, 2), Fraction(1)
    return {
        "newton_cradle_elastic": {
            "R": half,
            "gap": Fraction(1, 1024),
            "cases": [elastic_cradle(moving) for moving in (1, 2, 3, 4)],
            "note": "elastic equal masses: velocities are permuted into increasing order whatever the order of "
                    "simultaneous impacts",
        },
        "newton_cradle_inelastic": {
            "setup": "N=5, R=1/2, x_i=i*(1+1/1024), v0=(1,0,0,0,0), m=1",
            "cases": [inelastic_cradle(Fraction(e)) for e in ("0.9", "0.5", "0.95")],
        },
        "simultaneous_three_ball": {
            "note": "three touching balls hit at the same instant: answer is NOT unique unless all masses are equal "
                    "and e=1; a tool must document its rule",
            "cases": [three_balls(m, e) for m in ([1, 1, 1], [1, 2, 1], [2, 1, 2], [1, 3, 1]) for e in (one, half)],
        },
        "stacked_drop": {
            "note": "centres: z1=R1+h, z2=2R1+R2+h+gap at t=0, at rest; events: floor hit of ball 1 then ball-ball. "
                    "Height limit for m1>>m2, e=1, gap->0: speed 3v, height 9h; n balls: (2^n-1) v",
            "cases": [stacked_drop(*case) for case in STACKS],
            "infinite_mass_ladder": [ladder(n) for n in range(1, 8)],
        },
        "geometric_mass_chain": {
            "formula": "v_last=((1+e)/(1+q))^(n-1) v0, no re-collision iff e>=q (q<=1); "
                       "ball i keeps (1-e q)/(1+q) of the speed it got",
            "setup": "m_i=q^i, R=1/2, x_i=2i, v0=(1,0,..)",
            "cases": [mass_chain(n, Fraction(q), Fraction(e)) for n, q, e in CHAINS],
        },
        "gauss_gun_e_gt_1": gauss_gun(),
        "three_ball_collapse": collapse(),
        "n_ball_collapse_estimates": [estimate(e) for e in ("0.9", "0.95", "0.99")],
    }
