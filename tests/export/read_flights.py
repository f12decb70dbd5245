#!/usr/bin/env python3
"""Prints position and velocity of every body of a run at a time: read_flights.py flights.bin TIME

Lines of x y z vx vy vz in the form of float.hex(); a merged body has those of the whole. It has no paths under linear
drag, and none that are springs or attractors in closed form. The names are those of src/export/path_codec.cpp."""
import math
import struct
import sys
import zlib
from types import SimpleNamespace as Piece

SIGN = 1 << 63
IMPULSES = 1 << 62  # collisions have theirs
NAMES = "shape body time place velocity acceleration kick curve other".split()
ZERO = [0.0] * 3
NOTHING = Piece(known=False, start=(0.0, 0.0), x=ZERO, v=ZERO, a=ZERO, traits=0, half=0.0, kick=None, curve=None,
                rounding=0.0, extents=ZERO)


class Columns:
    def __init__(self, block):
        sizes, at = struct.unpack_from("<18IQ", block), 80
        self.bytes, self.at, self.bit = {}, dict.fromkeys(NAMES, 0), 0
        for k, name in enumerate(NAMES):
            size, packed = sizes[2 * k : 2 * k + 2]
            column = block[at : at + (packed or size)]
            self.bytes[name], at = zlib.decompress(column, -15) if packed else column, at + len(column)
        self.words = block[at:]

    def byte(self, name):
        self.at[name] += 1
        return self.bytes[name][self.at[name] - 1]

    def number(self, name):
        value = shift = 0
        while (byte := self.byte(name)) > 127:
            value, shift = value | (byte & 127) << shift, shift + 7
        return value | byte << shift

    def folded(self, name):
        value = self.number(name)
        return value >> 1 ^ -(value & 1)

    def bits(self, count):
        word = int.from_bytes(self.words[self.bit // 8 : self.bit // 8 + 9], "little") >> self.bit % 8
        self.bit += count
        return word & ((1 << count) - 1)

    def value(self, name, predicted):
        p = struct.unpack("<Q", struct.pack("<d", predicted))[0] if math.isfinite(predicted) else 0
        length = self.byte(name)
        if length == 128:
            return 0.0
        if length == 129:
            return struct.unpack("<d", struct.pack("<Q", self.bits(32) | self.bits(32) << 32))[0]
        sign, length = p & SIGN ^ (SIGN if length & 64 else 0), length & 63
        folded = self.bits(length - 1) | 1 << (length - 1) if length else 0
        return struct.unpack("<d", struct.pack("<Q", ((p & ~SIGN) + (folded >> 1 ^ -(folded & 1))) % SIGN | sign))[0]

    def vector(self, name, predicted):
        return [self.value(name, p) for p in predicted]


def seconds(start, end):
    return (end[0] - start[0]) + (end[1] - start[1])


def after(time, dt):
    s = time[0] + dt
    part = s - time[0]
    low = (time[0] - (s - part)) + (dt - part) + time[1]
    return s + low, low - (s + low - s)


def product(a, b):
    return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2])


def divided(a, b):
    return a / b if b else math.nan


def motion(piece, time):
    """Position and velocity at a time."""
    t = seconds(piece.start, time)
    if piece.traits & 384 == 384 and t >= -piece.rounding:
        return piece.x, piece.v
    if piece.curve:
        length, terms = piece.curve[:2]
        s, way, change = t / length, ZERO, ZERO
        for k in range(8, 0, -1):
            way = [w * s + c for w, c in zip(way, terms[k - 1])] if k < 8 else terms[7]
            if k > 1:
                change = [w * s + k * c for w, c in zip(change, terms[k - 1])] if k < 8 else [8 * c for c in terms[7]]
        return [x + w * s for x, w in zip(piece.x, way)], [
            v + w * s / length - ahead for v, w, ahead in zip(piece.v, change, piece.curve[2])]
    x = [x + t * (v + 0.5 * t * a) for x, v, a in zip(piece.x, piece.v, piece.a)]
    v = [v + t * a for v, a in zip(piece.v, piece.a)]
    return x, [v - seconds(time, piece.until) * k for v, k in zip(v, piece.kick)] if piece.kick else v


def read_piece(c, body, entry, present, sizes):
    """The next piece, by what the entries before say of it."""
    before, shape = present[body], c.byte("shape")
    if not before.known:
        sizes[body] = entry.sizes = [c.value("other", s) for s in entry.sizes]
    p = Piece(**vars(NOTHING), body=body, whole=body)
    p.known, p.traits = True, before.traits & 511
    if shape & 4:
        p.traits += c.folded("other")
    kicked, frame = p.traits & 1, p.traits & 384 == 384
    other = body + 1 + c.folded("body") if shape & 64 and not kicked else None

    since = before.start
    if other is not None and sum(since) < sum(present[other].start):
        since = present[other].start
    if shape & 3 == 0:
        p.start = entry.start
    elif shape & 3 == 1:
        p.start = after(before.start, 2 * before.half if before.kick else before.curve[0] if before.curve else 0.0)
    elif shape & 3 == 2:
        dt = seconds(since, entry.start)
        if other is not None:
            (xa, va), (xb, vb) = motion(before, since), motion(present[other], since)
            d, w = [b - a for a, b in zip(xa, xb)], [b - a for a, b in zip(va, vb)]
            size, closing = sizes[body][1] + sizes[other][1], product(d, w)
            gap = product(d, d) - size * size
            square = closing * closing - product(w, w) * gap
            dt = divided(gap, math.sqrt(square) - closing) if square >= 0 else math.nan
        p.start = after(since, c.value("time", dt))
    else:
        p.start = tuple(c.vector("time", entry.start))
    p.since = max(math.nextafter(p.start[0], math.inf) if p.start[1] > 0 else p.start[0], entry.since)
    if p.traits & 512:
        p.since = c.value("time", p.since)

    if frame:
        p.v = c.vector("velocity", before.v) if shape & 16 else before.v
        t = seconds(before.start, p.start)
        p.x = [x + t * v for x, v in zip(before.x, p.v)]
    else:
        p.x = motion(before, p.start)[0]
    if shape & 8:
        p.x = c.vector("place", p.x)
    p.a = before.a
    if before.curve:
        length, terms = before.curve[:2]
        t, p.a = seconds(before.start, p.start) / length, [56 * term for term in terms[7]]
        for k in range(7, 1, -1):
            p.a = [a * t + k * (k - 1) * term for a, term in zip(p.a, terms[k - 1])]
        p.a = [a / (length * length) for a in p.a]
    if shape & 32:
        p.a = c.vector("acceleration", p.a)
    ahead = ZERO
    if p.traits & 2:
        length = c.value("curve", before.curve[0] if before.curve else 0.0)
        ahead = [0.5 * length * a for a in p.a] if before.curve and any(before.curve[2]) else ZERO
        ahead = c.vector("curve", ahead)
        p.curve = length, [], ahead
    struck, entry.struck = entry.struck, None
    if kicked:
        same_step = p.start == entry.start and seconds(entry.start, entry.until) > 0
        usual = entry.until if same_step else after(p.start, before.half)
        p.until = tuple(c.vector("time", usual)) if shape & 128 else usual
        p.half, base = seconds(p.start, p.until), before.v if before.kick else motion(before, p.start)[1]
        time = p.half + before.half
        base = c.vector("kick", base) if shape & 64 else base
        p.v = [b + time * k for b, k in zip(base, before.kick or before.a)]
        p.v = c.vector("velocity", p.v) if shape & 16 else p.v
        p.kick = [divided(v - b, time) for v, b in zip(p.v, base)]
        p.kick = c.vector("kick", p.kick) if shape & 128 else p.kick
        entry.until = p.until
    elif not frame:
        v = struck[1] if struck and struck[0] == body else motion(before, p.start)[1]
        if other is not None:
            va, (xb, vb) = motion(before, p.start)[1], motion(present[other], p.start)
            d = [b - a for a, b in zip(p.x, xb)]
            n = [divided(k, math.sqrt(product(d, d))) for k in d]
            approach = -product([b - a for a, b in zip(va, vb)], n)
            entry.e = c.value("other", entry.e)
            ma, mb = sizes[body][0], sizes[other][0]
            impulse = (approach + entry.e * approach) / (1 / ma + 1 / mb)
            v = [u - impulse / ma * k for u, k in zip(va, n)]
            entry.struck = other, [u + impulse / mb * k for u, k in zip(vb, n)]
        if before.traits & 384 == 128 and v is not (struck and struck[1]):
            half = 0.5 * seconds(before.start, p.start)
            v = [u + half * (a - b) for u, a, b in zip(v, p.a, before.a)]
        v = [u + w for u, w in zip(v, ahead)] if any(ahead) else v
        p.v = c.vector("velocity", v) if shape & 16 else v
    return p


def read_rest(c, p, before, sizes):
    """What few pieces have."""
    if p.traits & 2:
        length, terms, _ = p.curve
        ratio = length / before.curve[0] if before.curve else 0.0
        power = ratio * ratio
        for k in range(8):
            term, power = ZERO, power * ratio if k > 1 else power
            if k == 0:
                term = [length * v for v in p.v]
            elif k == 1:
                term = [0.5 * length * length * a if p.traits & 4 else 0.5 * length * (length * a) for a in p.a]
            elif before.curve:
                term = [power * t for t in before.curve[1][k]]
            terms.append(c.vector("curve", term))
    if p.traits & 384 == 384:
        p.rounding = c.value("other", before.rounding)
    if p.traits & 8:
        p.whole = c.folded("other")
    if p.traits & 16:
        sizes[p.body] = [c.value("other", s) for s in sizes[p.body]]
        p.extents = c.vector("other", before.extents)


def read_until(data, time):
    """The present piece of each body."""
    magic, version, order, bodies, duration = struct.unpack_from("<8sIIQd", data)
    assert (magic, version, order) == (b"caromfly", 8, 0x01020304)
    present, sizes, at = [NOTHING] * (bodies % IMPULSES), {}, 32
    (left,) = struct.unpack_from("<Q", data, len(data) - 200)
    while left:
        kind, entries, size, checksum, begin = struct.unpack_from("<IIIId", data, at)
        c, at = Columns(data[at + 24 : at + 24 + size]), at + 24 + size
        if kind:
            continue
        left -= entries
        entry = Piece(body=-1, start=(begin, 0.0), until=(begin, 0.0), since=begin, e=0.0, struck=None, mark=0.0,
                      impulse=0.0, sizes=(0.0, 0.0))
        for _ in range(entries):
            body = c.number("body")
            if body == 0:
                c.byte("shape"), c.number("other"), c.number("other")
                entry.mark = c.value("time", entry.mark)
                if bodies & IMPULSES:
                    entry.impulse = c.value("velocity", entry.impulse)
                continue
            body = entry.body + 1 + (body - 1 >> 1 ^ -(body - 1 & 1))
            p = read_piece(c, body, entry, present, sizes)
            read_rest(c, p, present[body], sizes)
            if p.since > time:
                return present
            present[body] = p
            entry.body, entry.start, entry.since = body, p.start, p.since
    return present


def main():
    time = float(sys.argv[2])
    with open(sys.argv[1], "rb") as file:
        present = read_until(file.read(), time)
    for piece in present:
        while piece.whole != piece.body:
            piece = present[piece.whole]
        x, v = motion(piece, (time, 0.0))
        print(*(number.hex() for number in x + v))


main()
