"""Restitution of a pair from the coefficients of its two bodies, by each rule."""
from mpmath import mpf, sqrt

import reference_json  # sets 60 digits

PAIRS = [("0.9", "0.9"), ("0.9", "0.5"), ("1", "0"), ("1.1", "0.9")]


def row(e1: mpf, e2: mpf) -> dict:
    """(e1 + e2) / 2 is the text of Conger ch. 8, e1 e2 / 2 its listing 8.4; the other rules by their names."""
    return {
        "e1": e1,
        "e2": e2,
        "average": (e1 + e2) / 2,
        "product": e1 * e2,
        "minimum": min(e1, e2),
        "maximum": max(e1, e2),
        "geometric": sqrt(e1 * e2),
        "book_listing": e1 * e2 / 2,
    }


def compute() -> dict:
    """The content of restitution_rules.json."""
    return {
        "title": "Restitution combination rules",
        "provenance": "computed",
        "rows": [row(mpf(e1), mpf(e2)) for e1, e2 in PAIRS],
    }
