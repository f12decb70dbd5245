"""A ball that bounces on a floor, or down a frictionless incline, until it rests.

Between impacts the ball is in free fall; an impact multiplies the normal speed by e. The times of the impacts are a
geometric series, which was summed in closed form and not impact by impact.
"""
import math

from mpmath import cos, mpf, radians, sin, sqrt

import reference_json  # sets 60 digits

VERTICAL = [
    # id, g, height, e, radius, upward speed, impacts, note
    ("dyadic_g8_e0.5", "8", "1", "0.5", "0.25", "0", [1, 2, 3, 4, 5, 10, 20, 30, 40, 50],
     "All impact times are dyadic: t_n = 1.5 - 2^(1-n) (n>=1). Exactly representable in binary64; a correct code gives "
     "bit-exact times. Zeno limit 1.5."),
    ("earth_e0.9", "9.81", "1", "0.9", "0.1", "0", [1, 2, 3, 4, 5, 10, 20, 50, 100, 200, 300], ""),
    ("earth_e0.5", "9.81", "1", "0.5", "0.1", "0", [1, 2, 3, 4, 5, 10, 20, 40], ""),
    ("earth_e0.8_up", "9.81", "1", "0.8", "0.1", "3", [1, 2, 3, 4, 5, 10, 20, 50], ""),
    ("earth_e1", "9.81", "1", "1", "0.1", "0", [1, 2, 3, 10, 100, 1000, 10000, 1000000], ""),
]
INCLINES = [
    # id, e, speed along the slope, times of states
    ("incline_30deg_e0.5", "0.5", "0", ["0.25", "0.5", "1", "2", "5"]),
    ("incline_30deg_e0.9", "0.9", "1", ["0.25", "1", "5", "6.4", "7", "10"]),
]
INCLINE_NOTE = ("Frictionless incline: motion along the slope is uniformly accelerated (g sin) for ever, independent "
                "of bounces; normal motion is a bouncing ball with g cos; after the Zeno time the ball slides in "
                "contact. Tests collapse -> contact state hand-over.")
EXPERIMENTS = [(8.0, 0.5), (9.81, 0.5), (9.81, 0.8), (9.81, 0.9), (9.81, 0.95), (9.81, 0.99), (9.81, 0.999)]


class Bouncing:
    """A ball dropped, or thrown upwards with v0, from the height h above contact."""

    def __init__(self, g: mpf, h: mpf, e: mpf, v0: mpf):
        self.g, self.h, self.e, self.v0 = g, h, e, v0

    def first_speed(self) -> mpf:
        """u1 = sqrt(v0^2 + 2 g h): energy of free fall."""
        return sqrt(self.v0**2 + 2 * self.g * self.h)

    def first_time(self) -> mpf:
        """t1 = (v0 + u1) / g: momentum of free fall."""
        return (self.v0 + self.first_speed()) / self.g

    def speed_before(self, n: int) -> mpf:
        """u_n = e^(n-1) u1: Newton's law of impact."""
        return self.first_speed() * self.e ** (n - 1)

    def time(self, n: int) -> mpf:
        """t_n = t1 + (2 u1 / g) (e + ... + e^(n-1)), since a flight that begins with u takes 2 u / g."""
        series = mpf(n - 1) if self.e == 1 else self.e * (1 - self.e ** (n - 1)) / (1 - self.e)
        return self.first_time() + 2 * self.first_speed() / self.g * series

    def zeno_time(self) -> mpf | None:
        """The limit of t_n: t1 + (2 u1 / g) e / (1 - e)."""
        if self.e == 1:
            return None
        return self.first_time() + 2 * self.first_speed() / self.g * self.e / (1 - self.e)

    def apex(self, n: int) -> mpf:
        """(e u_n)^2 / (2 g), the height of the flight after impact n."""
        return (self.e * self.speed_before(n)) ** 2 / (2 * self.g)

    def path(self) -> mpf | None:
        """Up by v0^2 / (2 g), down by H = u1^2 / (2 g), then up and down by H e^(2n): 2 H e^2 / (1 - e^2)."""
        if self.e == 1:
            return None
        top = self.first_speed() ** 2 / (2 * self.g)
        return self.v0**2 / (2 * self.g) + top + 2 * top * self.e**2 / (1 - self.e**2)

    def height_and_speed(self, t: mpf) -> tuple[mpf, mpf, str]:
        """Free fall since the last impact before t; at rest after the Zeno time."""
        if t >= self.zeno_time():
            return mpf(0), mpf(0), "sliding"
        flight = 0
        while self.time(flight + 1) <= t:
            flight += 1
        start, height, speed = mpf(0), self.h, self.v0
        if flight > 0:
            start, height, speed = self.time(flight), mpf(0), self.e * self.speed_before(flight)
        s = t - start
        return height + speed * s - self.g * s**2 / 2, speed - self.g * s, f"flight {flight}"


def vertical(case: tuple) -> dict:
    """A row of VERTICAL, by the closed forms of Bouncing."""
    name, g, h, e, radius, v0, counts, note = case
    ball = Bouncing(mpf(g), mpf(h), mpf(e), mpf(v0))
    return {
        "id": name,
        "g": ball.g,
        "height_above_contact": ball.h,
        "e": ball.e,
        "radius": mpf(radius),
        "vz0": ball.v0,
        "t_first": ball.first_time(),
        "speed_first_impact": ball.first_speed(),
        "zeno_time": ball.zeno_time(),
        "impacts": [
            {
                "n": n,
                "t": ball.time(n),
                "speed_before": ball.speed_before(n),
                "speed_after": ball.speed_before(n + 1),
                "apex_height_above_contact": ball.apex(n),
            }
            for n in counts
        ],
        "total_path_vertical": ball.path(),
        "note": note,
    }


def incline(case: tuple) -> dict:
    """A slope of 30 degrees: a bouncing ball with g cos along the normal, s = v0 t + g sin t^2 / 2 along the slope."""
    name, e, v_along, times = case
    g, angle, h, v0 = mpf("9.81"), mpf(30), mpf("0.5"), mpf(v_along)
    along, across = g * sin(radians(angle)), g * cos(radians(angle))
    ball = Bouncing(across, h, mpf(e), mpf(0))

    def s(t: mpf) -> mpf:
        return v0 * t + along * t**2 / 2

    def state(t: mpf) -> dict:
        height, speed, phase = ball.height_and_speed(t)
        return {"t": t, "s_along": s(t), "h_perp": height, "v_along": v0 + along * t, "v_perp": speed, "phase": phase}

    return {
        "id": name,
        "g": g,
        "angle_deg": angle,
        "h_perp0": h,
        "e": ball.e,
        "v_along0": v0,
        "t_first": ball.first_time(),
        "zeno_time": ball.zeno_time(),
        "s_at_zeno": s(ball.zeno_time()),
        "v_along_at_zeno": v0 + along * ball.zeno_time(),
        "normal_force_per_mass_after_zeno": across,
        "impacts": [{"n": n, "t": ball.time(n), "s_along": s(ball.time(n))} for n in (1, 2, 3, 5, 10, 20)],
        "states": [state(mpf(t)) for t in times],
        "note": INCLINE_NOTE,
    }


def experiment(g: float, e: float) -> dict:
    """Doubles alone: t += 2 u / g and u *= e, impact by impact, until t + 2 u / g rounds to t.

    The exact Zeno time is that of the doubles g and e, with 60 digits.
    """
    h = 1.0
    t = math.sqrt(2 * h / g)
    u = math.sqrt(2 * g * h) * e
    bounces = 1
    while t + 2 * u / g != t:
        t += 2 * u / g
        u *= e
        bounces += 1
    zeno = Bouncing(mpf(g), mpf(h), mpf(e), mpf(0)).zeno_time()
    return {
        "g": g,
        "h": h,
        "e": e,
        "bounces_until_t_plus_dt_equals_t": bounces,
        "t_reached": t,
        "zeno_exact": zeno,
        "abs_err": float(t - zeno),
        "dt_last": 2 * u / g,
    }


def compute() -> dict:
    """The content of bouncing_ball.json."""
    return {
        "title": "Bouncing ball with restitution; Zeno time; incline",
        "provenance": "computed (mpmath 60 digits) from closed forms; geometric series",
        "formulas": "t1=(v0+sqrt(v0^2+2gh))/g; u1=sqrt(v0^2+2gh); t_n=t1+(2u1/g) e(1-e^(n-1))/(1-e); "
                    "T_zeno=t1+(2u1/g) e/(1-e) [=t1(1+e)/(1-e) if v0=0]; apex_n=h e^(2n)",
        "vertical": [vertical(case) for case in VERTICAL],
        "incline": [incline(case) for case in INCLINES],
        "double_precision_experiment": [experiment(g, e) for g, e in EXPERIMENTS],
    }
