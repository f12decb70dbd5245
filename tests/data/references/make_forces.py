"""Motion under drag and springs, with impacts, by closed forms.

Each closed form is held against a Taylor integration of its equation of motion, before its numbers are used.
"""
from collections.abc import Callable, Iterable

import mpmath
from mpmath import acos, asinh, atan, cos, exp, lambertw, log1p, mpf, sin, sqrt

import reference_json  # sets 60 digits

GRAVITY = mpf("9.81")
INTEGRATION_DIGITS = 25  # of the Taylor integration
INTEGRATION_ERROR = mpf("1e-24")  # relative above 1; the greatest difference is 7e-27


def integrate(equation: Callable, start: list[mpf], t: mpf) -> list[mpf]:
    """y' = equation(t, y) from y(0) = start to t, by mpmath's Taylor series."""
    with mpmath.workdps(INTEGRATION_DIGITS):
        return list(mpmath.odefun(equation, 0, start)(t))


def agree(closed_form: Iterable[mpf], integrated: Iterable[mpf]) -> None:
    """Raises ArithmeticError where a closed form does not solve its equation of motion."""
    for closed, numerical in zip(closed_form, integrated, strict=True):
        if abs(closed - numerical) > INTEGRATION_ERROR * max(1, abs(closed)):
            raise ArithmeticError(f"closed form {closed}, by integration {numerical}")


class LinearDrag:
    """Fall with drag -c v: z'' = -g - k z', k = c / m (Newton's second law). Terminal velocity: -g / k."""

    def __init__(self, k: mpf):
        self.k = k
        self.terminal = -GRAVITY / k

    def speed(self, v0: mpf, t: mpf, terminal: mpf) -> mpf:
        """v = vt + (v0 - vt) exp(-k t), along an axis with terminal velocity vt."""
        return terminal + (v0 - terminal) * exp(-self.k * t)

    def place(self, x0: mpf, v0: mpf, t: mpf, terminal: mpf) -> mpf:
        """x = x0 + vt t + (v0 - vt)(1 - exp(-k t)) / k"""
        return x0 + terminal * t + (v0 - terminal) * (1 - exp(-self.k * t)) / self.k

    def landing(self, z0: mpf, v0: mpf) -> mpf:
        """The root t > 0 of z(t) = 0.

        t = s + W0(-a k^2 / g exp(-k s)) / k with a = (v0 - vt) / k, s = (z0 + a) k / g and Lambert's W0.
        Root finding from a start 1 % away has to end there too.
        """
        a = (v0 - self.terminal) / self.k
        s = (z0 + a) * self.k / GRAVITY
        t = s + lambertw(-a * self.k**2 / GRAVITY * exp(-self.k * s)).real / self.k
        root = mpmath.findroot(lambda u: self.place(z0, v0, u, self.terminal), t * mpf("1.01"))
        agree([t], [root])
        return t


def check_linear_drag(drag: LinearDrag, z0: mpf, v0: mpf, t: mpf) -> None:
    """Closed forms against z' = v, v' = -g - k v."""
    integrated = integrate(lambda _, y: [y[1], -GRAVITY - drag.k * y[1]], [z0, v0], t)
    agree([drag.place(z0, v0, t, drag.terminal), drag.speed(v0, t, drag.terminal)], integrated)


def linear_drag_flight(k: mpf, p0: list[mpf], v0: list[mpf]) -> dict:
    """A throw in three dimensions; gravity acts along z, so that the terminal velocity is (0, 0, -g / k)."""
    drag = LinearDrag(k)
    terminal = [mpf(0), mpf(0), drag.terminal]

    def place(t: mpf) -> list[mpf]:
        return [drag.place(x, v, t, vt) for x, v, vt in zip(p0, v0, terminal)]

    def velocity(t: mpf) -> list[mpf]:
        return [drag.speed(v, t, vt) for v, vt in zip(v0, terminal)]

    landing = drag.landing(p0[2], v0[2])
    check_linear_drag(drag, p0[2], v0[2], landing)
    return {
        "k": k,
        "terminal_speed": -drag.terminal,
        "states": [{"t": t, "p": place(t), "v": velocity(t)} for t in map(mpf, ("0.5", "1", "2", "5"))],
        "t_impact_z0": landing,
        # z = 0 is what defines the landing.
        "x_impact": [*place(landing)[:2], mpf(0)],
        "v_impact": velocity(landing),
    }


def linear_drag_3d() -> dict:
    """Throws by LinearDrag with three values of k."""
    p0, v0 = [mpf(0), mpf(0), mpf(10)], [mpf(3), mpf(-1), mpf(4)]
    return {
        "params": {"p0": p0, "v0": v0, "g": GRAVITY},
        "formula": "v=vt+(v0-vt)e^{-kt}; x=x0+vt t+(v0-vt)(1-e^{-kt})/k; k=c/m; vt=g/k; "
                   "impact time closed form with Lambert W0",
        "cases": [linear_drag_flight(mpf(k), p0, v0) for k in ("0.1", "0.5", "2")],
    }


def linear_drag_impacts(k: mpf, e: mpf, h: mpf) -> dict:
    """Flight after flight by LinearDrag.landing; an impact multiplies the speed by -e."""
    drag, kept = LinearDrag(k), (1, 2, 3, 5, 10, 20)
    z, v, t = h, mpf(0), mpf(0)
    impacts = []
    for n in range(1, kept[-1] + 1):
        flight = drag.landing(z, v)
        before = drag.speed(v, flight, drag.terminal)
        if n <= 2:
            check_linear_drag(drag, z, v, flight)
        z, v, t = mpf(0), -e * before, t + flight
        if n in kept:
            impacts.append({"n": n, "t": t, "v_before": before, "v_after": v})
    return {"k": k, "e": e, "h": h, "impacts": impacts}


def linear_drag_bounce() -> dict:
    """Drops from 1 m by LinearDrag."""
    cases = [("0.5", "1"), ("0.5", "0.9"), ("2", "0.8")]
    return {"g": GRAVITY, "cases": [linear_drag_impacts(mpf(k), mpf(e), mpf(1)) for k, e in cases]}


class QuadraticDrag:
    """Drag by the square of the speed: v' = -g - g v |v| / vt^2 with the terminal speed vt."""

    def __init__(self, terminal: mpf):
        self.terminal = terminal

    def apex(self, u: mpf) -> mpf:
        """H = vt^2 / (2 g) ln(1 + u^2 / vt^2), the height that a launch with speed u reaches."""
        return self.terminal**2 / (2 * GRAVITY) * log1p((u / self.terminal) ** 2)

    def rise_time(self, u: mpf) -> mpf:
        """t = (vt / g) atan(u / vt)"""
        return self.terminal / GRAVITY * atan(u / self.terminal)

    def fall_speed(self, h: mpf) -> mpf:
        """v = vt sqrt(1 - exp(-2 g h / vt^2)) after a fall by h from rest."""
        return self.terminal * sqrt(-mpmath.expm1(-2 * GRAVITY * h / self.terminal**2))

    def fall_time(self, h: mpf) -> mpf:
        """t = (vt / g) acosh(exp(g h / vt^2))

        Computed as asinh(sqrt(exp(2 g h / vt^2) - 1)), which keeps the digits of small h.
        """
        return self.terminal / GRAVITY * asinh(sqrt(mpmath.expm1(2 * GRAVITY * h / self.terminal**2)))

    def check(self, u: mpf) -> None:
        """Rise and fall against z' = v, v' = -g -+ g v^2 / vt^2; two integrations, since |v| has a kink at the apex."""
        drag = GRAVITY / self.terminal**2
        top = self.apex(u)
        rise = integrate(lambda _, y: [y[1], -GRAVITY - drag * y[1] ** 2], [mpf(0), u], self.rise_time(u))
        agree([top, mpf(0)], rise)
        fall = integrate(lambda _, y: [y[1], -GRAVITY + drag * y[1] ** 2], [top, mpf(0)], self.fall_time(top))
        agree([mpf(0), -self.fall_speed(top)], fall)


def quadratic_drag_impacts(terminal: mpf, e: mpf, h: mpf) -> dict:
    """Fall, impact, rise and fall again, by the closed forms of QuadraticDrag; an impact multiplies the speed by -e."""
    drag, kept = QuadraticDrag(terminal), (1, 2, 3, 5, 10, 100, 1000)
    apex, t = h, drag.fall_time(h)
    impacts = []
    for n in range(1, kept[-1] + 1):
        before = drag.fall_speed(apex)
        after = e * before
        if n in kept:
            impacts.append({"n": n, "t": t, "v_before": -before, "v_after": after})
            if n > 1:
                impacts[-1]["apex_before"] = apex
        apex = drag.apex(after)
        t += drag.rise_time(after) + drag.fall_time(apex)
        if n == 1:
            drag.check(after)
        if e == 1:
            # 1 / u_n^2 = 1 / u_1^2 + (n - 1) / vt^2: a second way to the same speeds.
            law = 1 / sqrt(1 / drag.fall_speed(h) ** 2 + (n - 1) / terminal**2)
            agree([before], [law])
    return {"vt": terminal, "e": e, "h": h, "impacts": impacts}


def quadratic_drag_bounce() -> dict:
    """Drops from 1 m by QuadraticDrag."""
    cases = [("10", "1"), ("10", "0.9"), ("3", "1"), ("3", "0.8")]
    return {
        "g": GRAVITY,
        "formula": "dv/dt=-g-g v|v|/vt^2; fall: v=vt sqrt(1-exp(-2gh/vt^2)), t=(vt/g)acosh(exp(gh/vt^2)); "
                   "rise: t=(vt/g)atan(u/vt), H=vt^2/2g ln(1+u^2/vt^2); return speed u/sqrt(1+u^2/vt^2); "
                   "e=1: 1/u_n^2=1/u_1^2+(n-1)/vt^2",
        "cases": [quadratic_drag_impacts(mpf(vt), mpf(e), mpf(1)) for vt, e in cases],
    }


def oscillator_impacts(omega: mpf, wall: mpf, amplitude: mpf, e: mpf) -> dict:
    """x'' = -w^2 x from rest at x = A0, with a wall at x = a that multiplies the speed by -e.

    First impact: acos(a / A) / w. Speed there: w sqrt(A^2 - a^2). Later flights: (2 / w) acos(a / A) with
    A^2 = a^2 + (u / w)^2.
    """
    first, kept = amplitude, (1, 2, 3, 5, 10, 20)
    t = acos(wall / amplitude) / omega
    agree([wall, -omega * sqrt(amplitude**2 - wall**2)],
          integrate(lambda _, y: [y[1], -omega**2 * y[0]], [amplitude, mpf(0)], t))
    impacts = []
    for n in range(1, kept[-1] + 1):
        before = omega * sqrt(amplitude**2 - wall**2)
        after = e * before
        if n in kept:
            impacts.append({"n": n, "t": t, "speed_before": before, "speed_after": after, "amplitude": amplitude})
        amplitude = sqrt(wall**2 + (after / omega) ** 2)
        t += 2 / omega * acos(wall / amplitude)
    return {"omega": omega, "wall_at": wall, "A0": first, "e": e, "impacts": impacts}


def impact_oscillator() -> dict:
    """A wall at the centre, behind it and before it."""
    cases = [("0", "0.5"), ("-0.5", "1"), ("-0.5", "0.9"), ("0.5", "0.8")]
    return {
        "formula": "x''=-w^2 x for x>=-d; flight time between impacts (2/w) acos(-d/A), A^2=d^2+(u/w)^2, "
                   "speed multiplied by e each impact",
        "cases": [oscillator_impacts(mpf(2), mpf(wall), mpf(1), mpf(e)) for wall, e in cases],
    }


def damped_spring() -> dict:
    """m x'' + c x' + k x = 0 from rest: x = x0 exp(-d t)(cos w t + (d / w) sin w t).

    d = c / 2m and w^2 = k / m - d^2.
    """
    m, k, c, x0 = mpf(2), mpf(40), mpf(1), mpf(1)
    d = c / (2 * m)
    w = sqrt(k / m - d**2)

    def x(t: mpf) -> mpf:
        return x0 * exp(-d * t) * (cos(w * t) + d / w * sin(w * t))

    times = [mpf(t) for t in (1, 2, 5, 10)]
    agree([x(times[1])], integrate(lambda _, y: [y[1], -(c * y[1] + k * y[0]) / m], [x0, mpf(0)], times[1])[:1])
    return {"m": m, "k": k, "c": c, "x0": x0, "v0": mpf(0), "states": [{"t": t, "x": x(t)} for t in times]}


def two_ball_spring() -> dict:
    """mu r'' = -k (r - l) from rest: r = l + (r0 - l) cos w t, w = sqrt(k / mu), mu = m1 m2 / (m1 + m2)."""
    m1, m2, k, rest, r0 = mpf(1), mpf(3), mpf(12), mpf(2), mpf("2.5")
    w = sqrt(k * (m1 + m2) / (m1 * m2))

    def r(t: mpf) -> mpf:
        return rest + (r0 - rest) * cos(w * t)

    # Both balls, each with the spring's force on it.
    force = lambda y: k * (y[1] - y[0] - rest)
    ends = integrate(lambda _, y: [y[2], y[3], force(y) / m1, -force(y) / m2], [mpf(0), r0, mpf(0), mpf(0)], mpf(1))
    agree([r(mpf(1))], [ends[1] - ends[0]])
    return {
        "m1": m1,
        "m2": m2,
        "k": k,
        "rest_length": rest,
        "note": "relative coordinate r(t)=l0+(r0-l0)cos(w t), w=sqrt(k/mu), mu=3/4 -> w=4; centre of mass free; "
                "r0=2.5, at rest",
        "states": [{"t": t, "r": r(t)} for t in map(mpf, ("0.25", "1", "10"))],
    }


def compute() -> dict:
    """The content of forces.json."""
    return {
        "title": "Exact solutions with other forces (drag, springs) incl. impacts",
        "provenance": "computed, mpmath; each trajectory checked against mpmath.odefun / taylor integration",
        "linear_drag_3d": linear_drag_3d(),
        "linear_drag_bounce": linear_drag_bounce(),
        "quadratic_drag_bounce_1d": quadratic_drag_bounce(),
        "impact_oscillator": impact_oscillator(),
        "damped_spring": damped_spring(),
        "two_ball_spring": two_ball_spring(),
    }
