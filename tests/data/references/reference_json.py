"""Numbers and layout of the reference files, shared by the programs that compute them.

An mpf is written with 25 digits, a float as Python's shortest text, a Fraction as the string "p/q".
json.dumps was not taken: it rounds every number to a double.
"""
import json
from fractions import Fraction
from typing import Any

import mpmath
from mpmath import mpf

DIGITS = 25  # significant digits of an mpf in a file
DOUBLE_ROUNDING = 4 * 2.0**-52  # relative; a few operations in double precision

mpmath.mp.dps = 60  # of every computation; the programs import this module before they make numbers


def exact(value: Fraction) -> mpf:
    """p / q as an mpf of 60 digits."""
    return mpf(value.numerator) / value.denominator


def number_text(x: mpf) -> str:
    """x with 25 digits, without trailing zeros; an exponent from 1e-6 down."""
    return mpmath.nstr(x, DIGITS, min_fixed=-6)


def scalar_text(value: Any) -> str:
    """The text of a value that is neither list nor object."""
    if isinstance(value, mpf):
        return number_text(value)
    if isinstance(value, Fraction):
        return json.dumps(str(value))
    return json.dumps(value, allow_nan=False)


def is_number(value: Any) -> bool:
    """Numbers of the file; a Fraction is text there."""
    return isinstance(value, (int, float, mpf)) and not isinstance(value, bool)


def json_text(value: Any, depth: int = 0) -> str:
    """The text of a file: one space a level; a list of numbers alone stands on one line."""
    if not isinstance(value, (dict, list)):
        return scalar_text(value)
    if isinstance(value, list) and all(map(is_number, value)):
        return "[" + ", ".join(map(scalar_text, value)) + "]"
    inside, outside = "\n" + " " * (depth + 1), "\n" + " " * depth
    if isinstance(value, list):
        return "[" + inside + ("," + inside).join(json_text(v, depth + 1) for v in value) + outside + "]"
    members = (json.dumps(k) + ": " + json_text(v, depth + 1) for k, v in value.items())
    return "{" + inside + ("," + inside).join(members) + outside + "}"


def parse(text: str) -> Any:
    """A stored file; a number with a point or an exponent becomes an mpf, which keeps all its digits."""
    return json.loads(text, parse_float=mpf)


def last_digit(x: mpf) -> mpf:
    """One unit of the 25th significant digit of x; 0 for x = 0."""
    if x == 0:
        return mpf(0)
    return mpf(10) ** (int(mpmath.floor(mpmath.log10(abs(x)))) - DIGITS + 1)


def numbers_agree(computed: mpf | float, stored: Any) -> bool:
    """|computed - stored| <= one unit of the last digit, or the rounding of doubles."""
    if not isinstance(stored, mpf):
        return False
    if isinstance(computed, float):
        return abs(mpf(computed) - stored) <= DOUBLE_ROUNDING * abs(stored)
    return abs(computed - stored) <= last_digit(stored)


def first_difference(computed: Any, stored: Any, place: str) -> str | None:
    """Names the first entry that differs, in the order of the file; None if all agree."""
    if isinstance(computed, dict):
        if not isinstance(stored, dict) or list(computed) != list(stored):
            return f"{place}: other keys"
        pairs = [(f"{place}.{key}", computed[key], stored[key]) for key in computed]
    elif isinstance(computed, list):
        if not isinstance(stored, list) or len(computed) != len(stored):
            return f"{place}: another length"
        pairs = [(f"{place}[{i}]", c, s) for i, (c, s) in enumerate(zip(computed, stored))]
    else:
        return scalar_difference(computed, stored, place)
    return next(filter(None, (first_difference(c, s, at) for at, c, s in pairs)), None)


def scalar_difference(computed: Any, stored: Any, place: str) -> str | None:
    """Names both values if they differ."""
    if isinstance(computed, (float, mpf)):
        same = numbers_agree(computed, stored)
    else:
        same = json.loads(scalar_text(computed)) == stored and isinstance(computed, bool) == isinstance(stored, bool)
    shown = number_text(stored) if isinstance(stored, mpf) else json.dumps(stored)
    return None if same else f"{place}: computed {scalar_text(computed)}, stored {shown}"
