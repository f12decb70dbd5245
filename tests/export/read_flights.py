#!/usr/bin/env python3
"""Prints position and velocity of every body of a run at a time: read_flights.py flights.bin TIME

Lines of x y z vx vy vz in the form of float.hex(); a merged body has those of the whole."""
import math
import struct
import sys

data, time, at = open(sys.argv[1], "rb").read(), float(sys.argv[2]), 32
magic, version, order, bodies, duration = struct.unpack_from("<8sIIQd", data)
assert (magic, version, order) == (b"caromfly", 6, 0x01020304)
(entries,) = struct.unpack_from("<Q", data, len(data) - 200)
path, whole, a = [None] * bodies, list(range(bodies)), [None] * bodies
for _ in range(entries):
    (body, has), at = struct.unpack_from("<II", data, at), at + 8

    def take(count, kind="d"):
        global at
        at += 8 * count
        return struct.unpack_from(f"<{count}{kind}", data, at - 8 * count)

    (hi, lo), x, v = take(2), take(3), take(3)
    a[body] = take(3) if has & 1 else a[body]
    since = take(1)[0] if has & 2 else math.nextafter(hi, math.inf) if lo > 0 else hi
    until, kick = (take(2), take(3)) if has & 4 else ((0, 0), None)
    if since > time:
        break
    whole[body] = take(1, "Q")[0] if has & 8 else whole[body]
    joint = take(5) if has & 16 else None  # mass, radius, half extents
    curve = (take(1)[0], [take(3) for _ in range(8)]) if has & 32 else None
    path[body] = hi, lo, x, v, a[body], until, kick, curve
for body in range(bodies):
    while whole[body] != body:
        body = whole[body]
    hi, lo, x, v, acceleration, until, kick, curve = path[body]
    s = (time - hi) + (0 - lo)
    if curve:
        length, terms = curve
        way, change = [0.0] * 3, [0.0] * 3
        for k in range(8, 0, -1):
            way = [w * (s / length) + c for w, c in zip(way, terms[k - 1])]
            change = [w * (s / length) + k * c for w, c in zip(change, terms[k - 1])] if k > 1 else change
        x = [p + w * (s / length) for p, w in zip(x, way)]
        v = [u + w * (s / length) / length for u, w in zip(v, change)]
    else:
        x = [p + s * (u + (0.5 * s) * g) for p, u, g in zip(x, v, acceleration)]
        v = [u + s * g for u, g in zip(v, acceleration)]
    if kick:
        v = [u - ((until[0] - time) + until[1]) * k for u, k in zip(v, kick)]
    print(*(number.hex() for number in x + v))
